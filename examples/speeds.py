"""Speed while walking: random schedules from 0.4 to 1.0 and back to 0.4 m/s within 20 steps, at 1 kHz."""

import numpy as np

import biped_adrc as ba

biped = ba.Biped.load("rabbit")
gait = ba.load_gait("v0.6", biped)
random, feasible = np.random.default_rng(18000), 0
COUNT = 10  # 200 for the number in docs/guide/footstep.md
for _ in range(COUNT):
    up = np.sort(random.uniform(0.4, 1.0, 8))
    down = np.sort(random.uniform(0.4, 1.0, 9))[::-1]
    speeds = (0.4, *up, 1.0, 1.0, *down)  # [m/s], one for each step
    inner = ba.NPDController(gait.constraint, ba.Gains(600.0, 30.0))
    law = ba.Footstep.on_gait(inner, gait, biped, speed=0.4, step=0.4, speeds=speeds)
    walker = ba.Walker(biped, law, timing=ba.SampledTime(1e-3), torque_limit=150.0)
    feasible += ba.walk(walker, gait, impacts=24).feasibility.outcome == "feasible"
print(f"{feasible} of {COUNT} schedules are walked feasibly")
