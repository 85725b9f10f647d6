"""A flexible joint, which is no biped: observers of the package against python-control.

    J_m q_m'' = u - k (q_m - q_l) - c (q_m' - q_l'),   J_l q_l'' = k (q_m - q_l) + c (q_m' - q_l') + d

A motor (q_m) turns a load (q_l) through a spring; a torque d acts on the load. ADRC measures q_m alone and
knows kappa = 1/J_m: the spring is a disturbance to it. Its law, stepped tick by tick under d = sin(w t), and
python-control with the law's transfer function have to find the same amplitude of q_m.

Run: pip install control, then python examples/flexible_joint.py
"""

import control
import numpy as np

import biped_adrc as ba
from biped_adrc.analysis.observer.transfer import transfer_functions

J_m, J_l, k, c = 0.4, 0.4, 2000.0, 1.0  # [kg m^2], [N m/rad], [N m s/rad]
T, gains = 1e-3, ba.Gains(K_p=400.0, K_d=40.0)
A = np.array(
    [
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [-k / J_m, k / J_m, -c / J_m, c / J_m],
        [k / J_l, -k / J_l, c / J_l, -c / J_l],
    ]
)
B = np.array([[0.0, 0.0], [0.0, 0.0], [1.0 / J_m, 0.0], [0.0, 1.0 / J_l]])  # of (u, d)
plant = control.c2d(control.ss(A, B, [[1.0, 0.0, 0.0, 0.0]], 0.0), T)  # both held over T


def stepped(observer: ba.Observer, w: float, ticks: int = 8000) -> float:
    """Amplitude [rad] of q_m under d = sin(w t), by the package's own law."""
    o = observer.at_ticks(T)
    z, x, q_m = o.initial_state(np.zeros(1), np.zeros(1), np.zeros(1)), np.zeros(4), []
    for t in T * np.arange(ticks):
        q_m.append(x[0])
        z = o.correct(z, x[:1])
        e = o.estimate(z)
        a = -gains.K_p * e.position - gains.K_d * e.velocity - e.disturbance
        z = o.predict(z, a)
        x = plant.A @ x + plant.B @ [J_m * a[0], np.sin(w * t)]
    t = T * np.arange(ticks // 2, ticks)  # without the transient
    waves = np.array([np.cos(w * t), np.sin(w * t)]).T
    return float(np.linalg.norm(np.linalg.lstsq(waves, q_m[ticks // 2 :], rcond=None)[0]))


observers = {f"GPI, m = {m}": ba.GPIObserver.from_bandwidth(150.0, m) for m in (0, 1, 2)}
print("observer     w [rad/s]   stepped [rad]  python-control [rad]")
for name, observer in observers.items():
    law = transfer_functions(observer, gains, T)
    C = J_m * control.tf(law.num, law.den, T)  # from q_m to -u
    for w in (3.0, 30.0, 100.0):
        G_u, G_d = plant(np.exp(1j * w * T)).ravel()
        expected = abs(G_d / (1.0 + G_u * C(np.exp(1j * w * T))))
        found = stepped(observer, w)
        print(f"{name}  {w:9g}   {found:13.6e}  {expected:.6e}")
        assert abs(found - expected) < 1e-6 * expected

# To try: the load's angle is measured in place of the motor's. Which bandwidth is then stable?
