"""Which observer does a robot allow? Delay margins, one encoder count, and a walk that has the last word.

Run: python examples/observer_design.py
"""

import biped_adrc as ba
from biped_adrc.analysis.observer.report import observer_report
from biped_adrc.control.delayed import Delayed

PERIOD, COUNTS = 1.5e-3, 8192  # [s], per revolution: RABBIT's

biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
observers = [
    ba.GPIObserver.from_poles(),  # Table I
    ba.GPIObserver.from_bandwidth(500.0, m=1),
    ba.GPIObserver.from_bandwidth(150.0, m=1),
]

for observer in observers:
    report = observer_report(observer, period=PERIOD, counts=COUNTS, robot=biped, gait=gait)
    print(report.verdict)
    law = ba.ADRCController(gait.constraint, observer)
    encoders, clock = ba.Sensors(counts=COUNTS, velocity="measured"), ba.SampledTime(PERIOD)
    walk = ba.walk(
        ba.Walker(biped, law, timing=clock, sensors=encoders, torque_limit=150.0), gait, 6
    )
    print(f"  a walk with these encoders: {walk.trajectory.status.name}")

    margin = report.loop.delay_margin().delay
    print(f"  delay margin {1e6 * margin:.4g} us; a torque so much late:")
    for share in (0.95, 1.05):
        walk = ba.walk(ba.Walker(biped, Delayed(law, share * margin)), gait, 12)
        print(f"    {share:.2f} of it {walk.trajectory.status.name}")

print("largest bandwidths that RABBIT allows:")
for r in report.recommended:
    print(f"  m = {r.m}: {r.bandwidth:5.0f} rad/s, limited by {r.because}")

# To try: how many counts per revolution would let Table I run, and how short a period? Is there any?
