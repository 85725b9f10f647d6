"""Laws of mechanics that a robot read from a file has to keep.

An import has many ways to be subtly wrong: a sense, an offset, an inertia in the wrong frame. These
laws hold for every planar biped, so they need no reference values. They are checked at random states q (n,)
[rad], q' (n,) [rad/s]; - and + stand for just before and just after an impact:

    D_s = Z^T M Z,  Omega = Z^T (nle + M dZ/dt q')    pinned = floating, constrained at the stance foot
    E_2 q_e+' = 0,  H+ = H-,  T+ <= T-                the plastic impact
    Theta' = -1 rad/s                                 while the robot topples forwards at 1 rad/s

    D_s, Omega    inertia matrix [kg m^2], Coriolis and gravity terms [N m] of the pinned model
    M, nle        the same of Pinocchio's floating model, which has n + 2 velocities
    Z             (n + 2, n), from q' to these velocities with the stance foot at rest
    q_e           (q, p_e), with the stance foot p_e (2,) [m]
    E_2           (2, n + 2), Jacobian of the swing foot p_2 by q_e
    H             angular momentum about p_2 [kg m^2/s], from masses, COM velocities and spins of the bodies
                  (`contact.LinkMotion`), counter-clockwise with x to the right and z up
    T             kinetic energy [J]
    Theta         phase of the gait [rad], c q with the row c of `Biped.phase`

Also checked are the places of hip and swing foot, and at an impact the angular momentum of the old leg about
its joints and the linear momentum. That D_s is well conditioned and that the legs are alike is checked for
every robot, by `Biped.check`. `import_robot.derive` runs these laws; `biped_from_urdf` refuses a robot
for which one of them is broken. The reproduction of the paper checks them for its robots too.
"""

from collections.abc import Iterator

import numpy as np
import pinocchio as pin

from biped_adrc.core.types import Array
from biped_adrc.core.verdict import Check, at_most
from biped_adrc.model.biped import Biped
from biped_adrc.model.contact import Impact, LinkMotion
from biped_adrc.model.pinned import XZ, frame_index


def physical_checks(biped: Biped) -> tuple[Check, ...]:
    """Check the laws at 20 random states: one `Check` per law, which holds if its relative gap is at most 1e-9
    everywhere; double precision leaves about 1e-12. A NaN counts as violated.
    """
    laws = largest_gaps(biped, 20, 0)  # 20 states, drawn with the seed 0
    return tuple(at_most(law, "law", gap, 1e-9) for law, gap in laws.items())


def largest_gaps(biped: Biped, states: int, seed: int) -> dict[str, float]:
    """Largest relative gap [1] of each law, by its sentence, over `states` random states.

    Angles are uniform in +-pi, rates normal with standard deviation 3 rad/s.
    """
    random, laws = np.random.default_rng(seed), dict[str, float]()
    for _ in range(states):
        q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(0.0, 3.0, biped.n)
        for law, gap in (*_single_support(biped, q, v), *_impact(biped, q, v)):
            # np.maximum keeps a NaN, max() might lose it
            laws[law] = float(np.maximum(laws.get(law, 0.0), gap))
    return laws


def _gap(found: Array, expected: Array) -> float:
    """Largest difference of two arrays over the largest entry of the expected one [1]."""
    return float(np.max(np.abs(found - expected)) / np.max(np.abs(expected)))


def _single_support(b: Biped, q: Array, v: Array) -> Iterator[tuple[str, float]]:
    """Yield the sentence of each law of single support, and its relative gap [1] at q, v (n,) [rad, rad/s].

    They are D_s and Omega, the places of hip and foot, and the direction of the phase.
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
    topple[-1] = 1.0  # the whole robot turns about the stance foot, by +1 rad/s of its pitch
    x, z = b.hip(q)
    # (z, -x) is the direction of the hip in a clockwise turn, forwards; -1: a positive pitch rate is backwards
    forwards = np.sign(b.hip_velocity(q, topple) @ np.array([z, -x]))
    # phase[-1] is Theta' [rad/s] at the rates topple; the gap is 0 where Theta' = -1 in a topple forwards
    yield "Theta falls as the robot topples forwards", abs(float(forwards * b.phase[-1]) + 1.0)


def _impact(b: Biped, q: Array, v: Array) -> Iterator[tuple[str, float]]:
    """Yield the sentence of each law of the plastic impact, and its relative gap [1] at q, v (n,) [rad, rad/s]
    just before it.

    Changes of momenta are divided by sqrt(2 m T-) [N s], the momentum of the mass m with the energy T- in
    translation; changes of angular momenta also by a length of the robot, `reach` [m].
    """
    hit, reach = b.impact(q, v), max(np.linalg.norm(b.swing_foot(q)), np.linalg.norm(b.hip(q)))
    before, after = b.kinetic_energy(q, v), b.kinetic_energy(hit.q, hit.v)
    foot = b.E_2(q) @ hit.v_e
    yield "impact: the new stance foot is at rest", float(np.max(np.abs(foot)) / np.linalg.norm(v))
    yield "impact: kinetic energy does not grow", float(np.maximum(0.0, after / before - 1.0))
    momentum = np.sqrt(2.0 * before * b.mass)
    whole, leg, linear = impact_momenta(b, q, v, hit) / (momentum * np.array([reach, reach, 1.0]))
    yield "impact: angular momentum about the new foot is kept", float(whole)
    yield "impact: angular momentum of the old leg about its joints is kept", float(leg)
    yield "impact: momentum, pinned at the new foot, is the floating one's", float(linear)


def impact_momenta(b: Biped, q: Array, v: Array, hit: Impact) -> Array:
    """Absolute changes of conserved quantities (3,) [kg m^2/s, kg m^2/s, kg m/s]; zero up to round-off.

    q, v: (n,) before the impact [rad, rad/s]; hit: its result. The first is the angular momentum of all links
    about the new foot, since the only impulse acts there; the second that of the old leg about its hip and its
    knee, the larger change, since ideal joints transmit no impulsive torque. The third compares the linear
    momentum after the impact in two ways: floating before the relabelling, and pinned at the new foot after it.
    """
    # [0, 0]: the old stance foot is at rest before the impact
    before = LinkMotion(b.floating, q, np.append(v, [0.0, 0.0]))
    after, foot = LinkMotion(b.floating, q, hit.v_e), b.swing_foot(q)
    whole = abs(after.about(foot) - before.about(foot))
    # outboard(j): angular momentum about joint j of all links that it carries
    leg = [abs(after.outboard(j) - before.outboard(j)) for j in before.old_leg()]
    linear = b.momentum(hit.q, hit.v) - after.momentum().linear[XZ]
    # initial: 0 for an old leg without joints
    return np.array([whole, np.max(leg, initial=0.0), np.max(np.abs(linear))])
