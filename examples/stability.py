"""Poincare's test: fixed point, multipliers, and the closed form they must agree with.

Run: python examples/stability.py
"""

import numpy as np

import biped_adrc as ba

biped = ba.Biped.load("rabbit")
gait = ba.load_gait("published", biped)
walker = ba.Walker(biped, ba.NPDController(gait.constraint))

P = ba.ReturnMap(walker, ba.RK4(1e-3))
orbit = P.fixed_point(np.concatenate((gait.q_minus, gait.v_minus)))
zero = ba.ZeroDynamics.of(biped, gait.constraint)

print("stable" if orbit.stable else "unstable", "residual", orbit.residual)
print("|lambda| =", np.abs(orbit.multipliers).round(6))
print("delta^2 of the zero dynamics =", round(zero.delta**2, 6))

# To try: halve K_d in ba.Gains(5000, 25). Which multipliers move, and which one does not?
