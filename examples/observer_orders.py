"""What the order m of the GPI observer buys: one push, observers of the same bandwidth.

Run: python examples/observer_orders.py
"""

import biped_adrc as ba

biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
push = ba.TorqueSine([40, 40, 40, 40, 0], step=2, start=0.05, stop=0.3, frequency=5.0)

print(" m  largest tracking error [rad]")
for m in (1, 3, 5):
    observer = ba.GPIObserver.from_bandwidth(500.0, m)  # all poles at -500 rad/s
    controller = ba.ADRCController(gait.constraint, observer)
    walk = ba.walk(ba.Walker(biped, controller, push), gait, impacts=3)
    print(f"{m:2d}  {walk.signals.peak_error:.1e}  {walk.trajectory.status.name}")

# To try: sample at 1 kHz (Walker(..., timing=ba.SampledTime(1e-3))). Does a higher m still help?
