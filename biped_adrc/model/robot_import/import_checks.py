"""Laws of mechanics an imported biped must obey, each with the number it was measured at.

An import has many ways to be subtly wrong: a sense, an offset, an inertia in the wrong frame. These
laws hold for every planar biped, so they need no reference values. At random states, against the
floating model, with H_c the angular momentum about a point c taken from masses, COM velocities and
spins of the bodies (`contact.LinkMotion`):

    D_s, Omega = Z' M Z, Z' (nle + M Z')      pinned = floating, constrained at the foot
    E_2 q_e+' = 0,  H_c+ = H_c-,  T+ <= T-    the plastic impact at c = p_2
    Theta' = -1                               while the robot topples forwards at 1 rad/s

That D_s is well conditioned and that the legs are alike is checked for every robot, by `Biped.check`.
`import_robot.derive` runs them; `biped_from_urdf` refuses a robot for which one is broken.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pinocchio as pin

from biped_adrc.core.types import Array
from biped_adrc.core.verdict import Check, at_most
from biped_adrc.model.biped import Biped
from biped_adrc.model.contact import LinkMotion
from biped_adrc.model.pinned import XZ, frame_index

STATES, SEED = 20, 0
LIMIT = 1e-9
"""Largest relative gap of a law; double precision leaves about 1e-12."""


def checks(biped: Biped) -> tuple[Check, ...]:
    """The laws at `STATES` random states drawn with `SEED`: angles in +-pi, rates of 3 rad/s.

    One `Check` per law, with the largest gap over the states. A NaN counts as broken.
    """
    random = np.random.default_rng(SEED)
    laws: dict[str, float] = {}
    for _ in range(STATES):
        q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(0.0, 3.0, biped.n)
        for law, gap in (*_single_support(biped, q, v), *_impact(biped, q, v)):
            # np.maximum keeps a nan
            laws[law] = float(np.maximum(laws.get(law, 0.0), gap))
    return tuple(at_most(law, "law", gap, LIMIT) for law, gap in laws.items())


def _gap(found: Array, expected: Array) -> float:
    """Largest difference of two arrays relative to the largest entry of the expected one."""
    return float(np.max(np.abs(found - expected)) / np.max(np.abs(expected)))


def _single_support(b: Biped, q: Array, v: Array) -> Iterator[tuple[str, float]]:
    """Laws of single support at q, v (n,) [rad, rad/s], each with its gap.

    D_s and Omega, places of hip and foot, and the direction of the phase.
    """
    D, Omega = b.floating.projected(q, v)
    yield "D_s of the pinned model is the floating one's, constrained", _gap(b.inertia(q), D)
    yield "Omega of the pinned model is the floating one's, constrained", _gap(b.bias(q, v), Omega)
    f = b.floating
    pin.framesForwardKinematics(f.model, f.data, f.configuration(q))
    frames = (frame_index(f.model, name) for name in (b.description.hip, b.description.swing_foot))
    places = np.array([f.data.oMf[frame].translation[XZ] for frame in frames])
    gap = _gap(np.array((b.hip(q), b.swing_foot(q))), places)
    yield "hip and swing foot are where the floating model has them", gap
    topple = np.zeros(b.n)
    topple[-1] = 1.0
    x, z = b.hip(q)
    forwards = np.sign(b.hip_velocity(q, topple) @ np.array([z, -x]))
    yield "Theta falls as the robot topples forwards", abs(float(forwards * b.phase[-1]) + 1.0)


def _impact(b: Biped, q: Array, v: Array) -> Iterator[tuple[str, float]]:
    """Laws of the plastic impact at q, v (n,) [rad, rad/s], each with its gap; H relative to a
    momentum of the same energy.
    """
    hit, contact = b.impact(q, v), b.swing_foot(q)
    before, after = b.kinetic_energy(q, v), b.kinetic_energy(hit.q, hit.v)
    foot = b.E_2(q) @ hit.v_e
    yield "impact: the new stance foot is at rest", float(np.max(np.abs(foot)) / np.linalg.norm(v))
    yield "impact: kinetic energy does not grow", float(np.maximum(0.0, after / before - 1.0))
    H_before, H_after = (
        LinkMotion(b.floating, q, rates).about(contact)
        for rates in (np.append(v, [0.0, 0.0]), hit.v_e)
    )
    scale = np.sqrt(2.0 * before * b.mass) * max(np.linalg.norm(contact), np.linalg.norm(b.hip(q)))
    law = "impact: angular momentum about the new foot is kept"
    yield law, float(abs(H_after - H_before) / scale)
