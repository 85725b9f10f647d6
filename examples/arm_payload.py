"""An arm carries what it does not know: the walker's observer and controller on a UR5; writes arm.png.

Run: python examples/arm_payload.py [FOLDER]      (needs pip install 'biped-adrc[robots]')
"""

import sys
from pathlib import Path

import matplotlib
import numpy as np

import biped_adrc as ba
from biped_adrc.closed_loop.arm import ArmSystem
from biped_adrc.model.arm import Arm

matplotlib.use("Agg")
from matplotlib import pyplot as plt

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
try:
    arm = Arm.ur5()
except ba.BipedError as missing:
    print(missing)
    sys.exit(0)
loaded = arm.with_payload(3.0, com=(0.0, 0.0, 0.1))  # [kg], [m] in front of the flange

q_0, A = np.array([0.0, -1.2, 1.5, -0.5, 0.8, 0.2]), np.array([0.6, 0.3, -0.4, 0.5, -0.4, 0.8])
w = 2.0 * np.pi * 0.4  # [rad/s]


def swing(t):
    """q_d, q_d', q_d'' at t [s]; it starts from rest."""
    return q_0 + A * (1.0 - np.cos(w * t)), A * w * np.sin(w * t), A * w**2 * np.cos(w * t)


reference, gains = ba.TimeReference(swing), ba.Gains(K_p=400.0, K_d=40.0)
observer = ba.GPIObserver.from_bandwidth(200.0, m=2)
controllers = {
    "NPD": ba.NPDController(reference, gains),
    "ADRC, GPI m = 2": ba.ADRCController(reference, observer, gains),
}
figure, axes = plt.subplots(figsize=(7, 4))
for name, controller in controllers.items():
    system = ArmSystem(loaded, controller, ba.SampledTime(1e-3), model=arm)  # 3 kg are not known
    run = system.run(q_0, np.zeros(6), duration=3.0, method=ba.RK4(1e-3))
    error = np.linalg.norm(system.error(run, reference), axis=1)
    axes.semilogy(run.arcs[0].t, error + 1e-9, label=name)
    print(f"{name:16s} {run.status.name}  rms {np.sqrt(np.mean(error**2)):.1e} rad")
axes.set(xlabel="t [s]", ylabel="|q - q_d| [rad]", title="UR5 with 3 kg that it does not know")
axes.legend()
folder.mkdir(parents=True, exist_ok=True)
figure.savefig(folder / "arm.png")

# To try: a payload of 6 kg, or m = 1. Which joint reaches its torque limit first?
