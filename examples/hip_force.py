"""A constant force of 3.5 N pulls at the hip: tracking alone stops, a loop around the steps walks on.

Run: python examples/hip_force.py
"""

import biped_adrc as ba
from biped_adrc.analysis.forced_steps import forced_walk, stopping_force
from biped_adrc.analysis.stride_gain import direction_merits

biped = ba.Biped.load("rabbit", "identified-bare")
gait = ba.load_gait("v0.5", biped)
force = ba.HipForce(biped, (-3.5, 0.0))  # [N], backwards
print(f"by quadrature {stopping_force(gait, biped, steps=25):.2f} N stop the gait within 25 steps")

best = direction_merits(gait, biped)[0]  # where the speed costs the least torque
print("corrected:", best.name, f"{best.static_gain:.2f} m/s per rad, {best.torque:.0f} N m per rad")
gains = ba.stride_response(gait, biped, best.direction).gains()
tracking = ba.NPDController(gait.constraint)
stride = ba.StridePI.on_gait(tracking, gait, biped, gains, direction=best.direction)

for name, controller in (("NPD", tracking), ("NPD with PI", stride)):
    walk = ba.walk(ba.Walker(biped, controller, force), gait, impacts=8, method=ba.RK4(2e-3))
    speeds = [step.step_length / step.duration for step in walk.certificates]
    print(f"{name:12s}", *(f"{v:.3f}" for v in speeds), "m/s", walk.trajectory.status.name)
expected = forced_walk(gait, biped, -3.5, steps=8, stride=stride)
print("quadrature  ", *(f"{step.speed:.3f}" for step in expected), "m/s")

# To try: how large may the force be with the loop, and how much larger if half of it comes five steps later?
