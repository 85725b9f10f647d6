"""Walk, push, plot and animate: writes sine.png and sine.html to the folder given.

Run: python examples/plot_and_animate.py [FOLDER]
"""

import sys
from pathlib import Path

import biped_adrc as ba

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)

biped = ba.Biped.load("rabbit", "identified-bare")
gait = ba.load_gait("published", biped)
push = ba.TorqueSine([40, 40, 40, 40, 0], step=2, start=0.05, stop=0.3, frequency=5.0)
walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint), push), gait, impacts=4)

walk.plot("NPD under a 5 Hz sine").savefig(folder / "sine.png")
walk.animate(folder / "sine.html")
for step in walk.certificates:  # the ground is judged by the mean force over 5 ms
    asks = f"friction {step.mean_friction:.2f} over 5 ms"
    print(f"step {step.step}: {step.duration:.3f} s, {asks}", step.violations())
print("written to", folder)

# To try: the same with ba.ADRCController; which of the four joints shows the sine now?
