"""Walk, push, plot and animate: writes walk.png and walk.html to the folder given.

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

walk.plot("NPD under a 5 Hz sine").savefig(folder / "walk.png")
walk.animate(folder / "walk.html")
for step in walk.certificates:
    print(
        f"step {step.step}: {step.duration:.3f} s, friction {step.friction:.2f}", step.violations()
    )
print("written to", folder)

# To try: the same with ba.ADRCController; which of the four joints shows the sine now?
