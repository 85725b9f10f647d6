"""A constant force of 3.5 N pulls at the hip: tracking alone stops, a loop around the steps walks on.

Run: python examples/hip_force.py
"""

import biped_adrc as ba

STANCE_KNEE = (0.0, 0.0, 1.0, 0.0)  # the joint that the loop bends in the middle of a step

biped = ba.Biped.load("rabbit", "identified-bare")
gait = ba.load_gait("v0.5", biped)
force = ba.HipForce(biped, (-3.5, 0.0))  # [N], backwards

response = ba.stride_response(gait, biped, STANCE_KNEE)
print(f"the loop changes the speed by {response.static_gain:.2f} m/s per rad")
tracking = ba.NPDController(gait.constraint)
stride = ba.StridePI.on_gait(tracking, gait, biped, response.gains(), direction=STANCE_KNEE)

for name, controller in (("NPD", tracking), ("NPD with PI", stride)):
    walk = ba.walk(ba.Walker(biped, controller, force), gait, impacts=8, method=ba.RK4(2e-3))
    speeds = [step.step_length / step.duration for step in walk.certificates]
    print(f"{name:12s}", *(f"{v:.3f}" for v in speeds), "m/s", walk.trajectory.status.name)

# To try: how large may the force be with the loop, and how much larger if half of it comes five steps later?
