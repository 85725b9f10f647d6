"""A gait from samples of one step: t (K,) [s], q (K, n) [rad], and optionally q' (K, n) [rad/s].

The first sample is just after an impact, the last one just before the next. For each actuated joint a Bezier
curve q_b = h(Theta), Theta = c q, is fitted by least squares. Value and slope at both ends of the step, Theta+
at its start and Theta- at its end, are prescribed and not fitted, so that the gait closes and is
hybrid-invariant. R q + r are the angles after relabelling, q(K) is the last sample, and _b its actuated joints:

    h(Theta-) = q_b(K),  h(Theta+) = (R q(K) + r)_b,  h'(Theta-): of the samples,  h'(Theta+): after the impact

The orbit and its period then come from the zero dynamics of the robot. A convention (`layout` in arguments)
says which angles the coordinates are, with order, zeros and signs.

Samples that the robot's dynamics do not give are told by *cause*, one change of the robot that would explain
them. From angles over time alone, gravity and a scale of all lengths cannot be told apart (q(t) depends on
g / L), so the candidates are gravity, the length of the legs with their masses as they are, and masses and
inertias of one body. For each candidate the factor k is solved for with which the step lasts as long as the
samples do. Then the candidates are compared by what k leaves: the largest distance of the samples q(t) from the
orbit of that robot [rad].
"""

import math
import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import newton

from biped_adrc.core.checks import numbers
from biped_adrc.core.errors import BipedError, GaitError, InputError
from biped_adrc.core.files import CsvTable, reading
from biped_adrc.core.shown import shown
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.conventions import OWN, Convention
from biped_adrc.gait.curves import Bezier, basis_at
from biped_adrc.gait.exchange.record import NEAR, foot_down, whole_turns
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics, invariant_constraint
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.robots.urdf import vector

_LARGEST = 4.0 * np.pi
"""Largest angle of a sample [rad]; a larger one is probably in degrees."""
FITS = 5e-3
"""Largest distance of a sample from the curve in a good fit, or from the orbit of its robot [rad]."""
LASTS = 0.05
"""Largest relative difference of the duration of the samples and the period of the zero dynamics."""
DEGREES = range(4, 13)
"""Degrees of the curves that can be fitted."""


@shown
class Samples(NamedTuple):
    """Samples of one step: t (K,) [s], q (K, n) [rad], and rates v (K, n) [rad/s] or None.

    They are in the coordinates of any angle convention until `poses` has brought them to the robot's. Arrays
    (n, K), and n + 2 coordinates with the position of the base first, are read too.
    """

    t: Array
    q: Array
    v: Array | None = None


def gait_of_samples(
    samples: Samples,
    biped: Biped,
    layout: Convention,
    degree: int = 6,
    slope: float = 0.0,
    name: str = "samples",
    source: str = "arrays",
) -> Gait:
    """Fit a gait with curves of this degree to samples, which are in the coordinates of the convention
    `layout`.

    slope [rad]: of the ground, positive downhill. name, source: of the gait, and what its provenance says of
    the samples. Raises InputError for arrays that are no samples of a step, and GaitError where the fit is bad,
    or where impact or zero dynamics of this robot do not fit the samples.
    """
    s, remarks = poses(samples, biped, layout, degree, slope)  # in the robot's coordinates
    fitted = fit(s, biped, degree)
    # distance of each sample (row) of each joint (column) from its curve, and the largest one
    gaps = np.abs([fitted.h(x)[0] for x in s.q @ fitted.phase] - s.q[:, : biped.p])
    k, joint = np.unravel_index(int(np.argmax(gaps)), gaps.shape)
    said = f"{gaps[k, joint]:.2g} rad, {biped.description.joints[joint]} at {s.t[k]:.4g} s"
    if gaps[k, joint] > FITS:
        raise GaitError(
            f"the fit is bad: curves of degree {degree} miss the samples by {said}, expected at most {FITS:g} "
            f"rad; try a degree up to {DEGREES[-1]}. The first sample has to be just after an impact, the last "
            "just before the next, of this robot's masses"
        )
    provenance = {
        "method": f"Bezier curves of degree {degree} fitted to {len(s.t)} samples over time",
        "source": source,
        "misses the samples by at most": said,
        **remarks,
    }
    gait = Gait.of_cycle(name, ZeroDynamics.of(biped, fitted), provenance, slope)
    lasted = float(s.t[-1] - s.t[0])
    if abs(gait.period - lasted) > LASTS * lasted:
        raise GaitError(
            f"the samples last {lasted:.4g} s, and this robot takes {gait.period:.4g} s for the same curves, "
            f"expected the same within {100.0 * LASTS:g} %; the fit is good, so lengths, masses or gravity "
            "differ, or it is no periodic step"
        )
    return gait.check(biped)


def poses(
    samples: Samples, biped: Biped, layout: Convention, degree: int, slope: float
) -> tuple[Samples, dict[str, str]]:
    """The samples in the robot's coordinates with the foot on the ground at the end, and remarks on what was
    changed, for the provenance.

    layout: convention of the samples. degree: of the curves, to check that there are more samples than that.
    slope [rad]: of the ground, positive downhill. Raises InputError and GaitError for samples that are
    no step of legs of these lengths, whatever their masses.
    """
    s, remarks = _in_robot(_checked(samples, layout.n, degree), layout, biped)
    if layout.n + 2 in np.shape(samples.q):  # two coordinates more: the position of the base
        remarks["left out"] = "position of the base"
    c, q, joints = biped.phase, s.q, biped.description.joints
    # the last pose, with the legs exchanged, has to be the first, and its swing foot on the ground
    gaps = np.abs(biped.relabel(q[-1]) - q[0])
    joint, height = int(np.argmax(gaps)), float(ground_axes(slope)[1] @ biped.swing_foot(q[-1]))
    if gaps[joint] > FITS:
        raise GaitError(
            f"the samples: {joints[joint]} of the last one, relabelled, is {gaps[joint]:.3g} rad from the "
            f"first, expected at most {FITS:g}: the first is not just after an impact or the last not just "
            "before one, or a sign, the order of joints or the convention is another"
        )
    if abs(height) > NEAR:
        raise GaitError(
            f"the samples: the swing foot ends {1e3 * height:.3g} mm above the ground, expected at most "
            f"{1e3 * NEAR:g}: thighs or shins of other lengths, another slope, or a last sample too early"
        )
    # the last pose is moved by dq and the first by R dq; along: share of Theta's way, 0 to 1, for those between
    dq, remark = foot_down(biped, q[-1], slope)
    along = ((q - q[0]) @ c / ((q[-1] - q[0]) @ c))[:, np.newaxis]
    first = biped.R @ dq
    q = q + first + (dq - first) * along**2 * (3.0 - 2.0 * along)  # slopes at the ends stay
    return s._replace(q=q), remarks | remark


def _checked(samples: Samples, n: int, degree: int) -> Samples:
    """The samples as float arrays t (K,), q and v (K, n); arrays (n, K) are transposed, and the position of the
    base, the first two of n + 2 coordinates, is left out.

    degree: of the curves that will be fitted. Raises InputError for what is no such samples.
    """
    t, q = numbers(samples.t, "t of the samples"), numbers(samples.q, "q of the samples")
    v = None if samples.v is None else numbers(samples.v, "q' of the samples")
    if q.shape in ((n, t.size), (n + 2, t.size)):
        q, v = q.T, None if v is None else v.T
    if q.shape == (t.size, n + 2):
        q, v = q[:, 2:], None if v is None else v[..., 2:]
    shapes, largest = {x.shape for x in (q, v) if x is not None}, np.max(np.abs(q), initial=0.0)
    finite = all(np.all(np.isfinite(x)) for x in (t, q, v) if x is not None)
    rising = t.ndim == 1 and degree in DEGREES and len(t) > degree and np.all(np.diff(t) > 0.0)
    if not (shapes == {(t.size, n)} and finite and rising and largest <= _LARGEST):
        raise InputError(
            f"the samples are {t.size} times and rows of shape {sorted(shapes)}, angles up to {largest:.5g}, "
            f"the degree is {degree}; expected a degree of {DEGREES[0]} to {DEGREES[-1]}, more finite numbers "
            f"t (K,) that grow, {n} coordinates for each, in radians, at most {_LARGEST:.4g}"
        )
    return Samples(t, q, v)


def _in_robot(s: Samples, layout: Convention, biped: Biped) -> tuple[Samples, dict[str, str]]:
    """The samples in the robot's coordinates, with whole turns as in the gaits of the package (hips near pi),
    and remarks for the provenance.

    In a convention that names legs by side ("frost") the legs are exchanged if the left one stands, which is
    seen from the sense of Theta. Raises GaitError where Theta turns back.
    """
    q, v = layout.to_paper.angles(s.q), None if s.v is None else layout.to_paper.rates(s.v)
    if layout.name != OWN:
        q = q + 2.0 * np.pi * whole_turns(q[len(q) // 2])  # by the pose in the middle of the step
    theta, remark = q @ layout.paper_phase, dict[str, str]()
    # with the paper's stance leg Theta falls in a walk to +x; it grows where the left leg stands
    if layout.name == "frost" and theta[-1] > theta[0]:
        q, v, remark = q @ biped.R.T, None if v is None else v @ biped.R.T, {"stance leg": "left"}
        theta = q @ layout.paper_phase
    along = np.diff(theta) * np.sign(theta[-1] - theta[0])
    if not np.all(along > 0.0):
        k = int(np.argmin(along))
        raise GaitError(
            f"the samples: Theta turns back at t = {s.t[k]:.4g} s ({theta[k]:.5g} to {theta[k + 1]:.5g} rad), "
            "expected one step in which it only grows or falls; leave out samples of other steps, and look at "
            "order and sign of the joints"
        )
    return Samples(s.t, q, v), remark


def fit(s: Samples, biped: Biped, degree: int) -> VirtualConstraint:
    """The constraint whose curve has the ends and end slopes of the step, and the inner coefficients that fit
    the samples (and their rates, where they have some) by least squares.

    s: samples in the robot's coordinates, as `poses` returns them. degree: of the Bezier curves.
    """
    c, p = biped.phase, biped.p
    minus = s.q[-1]
    ends = float(c @ biped.relabel(minus)), float(c @ minus)
    span = ends[1] - ends[0]
    x = (s.q @ c - ends[0]) / span  # normalised phase of each sample
    H, dH, _ = basis_at(Bezier, degree, x)
    if s.v is None:
        rows, goal = H, s.q
        # without rates the slope dq/ds at the end is that of a fit without prescribed ends
        free = np.linalg.lstsq(rows, goal, rcond=None)[0]
        last = np.asarray(degree * (free[-1] - free[-2]))
    else:
        # dq/ds = span q' / Theta'
        slopes = span * s.v / (s.v @ c)[:, np.newaxis]
        rows, goal, last = np.vstack((H, dH)), np.vstack((s.q, slopes)), slopes[-1]
    # the constraint with the prescribed ends and slopes; last / span is dq/dTheta before impact
    h = invariant_constraint(Bezier, biped, minus, last / span, degree)
    a = np.array(h.curve.coefficients.T)
    inner = slice(2, degree - 1)  # the two outer coefficients at either end are prescribed
    a[inner] = 0.0
    a[inner] = np.linalg.lstsq(rows[:, inner], goal[:, :p] - rows @ a, rcond=None)[0]
    return replace(h, curve=Bezier(a.T))


def read_csv(path: Path) -> Samples:
    """Read the samples in a CSV file with a first line of names.

    Columns are t, q1 .. qn and perhaps v1 .. vn, with or without units behind a space; others
    are ignored. Raises InputError.
    """
    with reading("samples", path, InputError):
        table = CsvTable.read(path)
        names = [name.partition(" ")[0] for name in table.head]
        if not {"t", "q1"} <= set(names) or not table.rows:
            raise InputError(
                f"its first line is {table.head} with {len(table.rows)} rows below, expected names t, q1, q2, "
                "... and perhaps v1, v2, ..., and numbers below"
            )

        def joints(letter: str) -> Array:
            """Columns letter1, letter2, ... (such as q1, q2) of the CSV table, whose columns are called
            `names`, in the order of their numbers, (K, n); empty if there are none.
            """
            of = sorted(int(x[1:]) for x in names if re.fullmatch(f"{letter}[1-9][0-9]*", x))
            return np.array([table.numbers(names.index(f"{letter}{i}")) for i in of]).T

        v = joints("v")
        return Samples(table.numbers(names.index("t")), joints("q"), v if v.size else None)


# -- samples that do not fit the robot -----------------------------------------------------------------
def explained(samples: Samples, biped: Biped, layout: Convention, degree: int, slope: float) -> str:
    """The end of an error message, from "; " on, that names the causes: each of these changes of the robot
    alone would explain samples that its dynamics do not give; or that says that there is none.

    samples: in the convention `layout`. degree: of the curves that are fitted. slope [rad]: of the ground,
    positive downhill. Raises InputError and GaitError where already the poses do not fit the robot.
    """
    # in the robot's coordinates; [1] are remarks
    s = poses(samples, biped, layout, degree, slope)[0]

    def orbit(make: Callable[[float], Biped], k: float) -> ZeroDynamics:
        """The zero dynamics of the robot make(k), the one that factor k changes, on the curves (of this degree)
        that are fitted to the samples s for it.
        """
        return ZeroDynamics.of(make(k), fit(s, make(k), degree))

    def late(log_k: float, make: Callable[[float], Biped]) -> float:
        """log(period of the robot make(k) / duration of the samples s), k = exp(log_k); 0 at the factor k that
        is searched.
        """
        # factors from 1/10 to 10
        k = math.exp(np.clip(log_k, -math.log(10.0), math.log(10.0)))
        return math.log(orbit(make, k).cycle.period / float(s.t[-1] - s.t[0]))

    # makes: name of a change -> the robot by its factor k; found: name -> distance [rad] and k
    d, found = biped.description, dict[str, tuple[float, float]]()
    makes: dict[str, Callable[[float], Biped]] = {
        "gravity (or one over all lengths)": lambda k: replace(
            biped, description=replace(d, gravity=k * d.gravity)
        ),
        "the length of the legs": lambda k: with_legs(biped, k),
    } | {f"masses and inertias of {x}": partial(_heavier, biped, x) for x in d.links}
    for name, make in makes.items():
        with suppress(BipedError, RuntimeError):  # no factor gives the duration
            # secant method on log k, from factors of 1 and exp(0.05); over log k the logarithm of the period is
            # a straight line with gravity, which makes it fast
            k = math.exp(newton(late, 0.0, x1=0.05, tol=1e-6, args=(make,)))
            found[name] = _distance(s, orbit(make, k)), k
    best = min((gap for gap, _ in found.values()), default=math.inf)
    if best > FITS:
        return "; no other gravity, length of the legs or mass of one body alone explains them"
    # also those that fit not much worse: their distance is at most 3 times that of the best one
    causes = [f"{x} times {k:.4g}" for x, (gap, k) in found.items() if gap <= 3.0 * best]
    return f"; they would fit with {' or '.join(causes)}"


def with_legs(biped: Biped, k: float) -> Biped:
    """The robot with legs k times as long, and the COMs of their links k times as far out along them; masses
    and inertias stay.
    """
    tree, d = biped.tree, biped.description
    legs = {j.child for foot in d.feet for j in tree.path_below(foot, d.trunk) or ()}
    com = {link: k for link in legs if tree.links[link].inertial is not None}
    # com: factor of the place of the COM by link; a link without masses has none
    # the origin of a joint lies in the frame of its parent link, so the hips, on the trunk, stay
    joints = tuple(
        replace(j, origin=vector(k * np.array(j.origin))) if j.parent in legs else j
        for j in tree.joints
    )
    return replace(biped, tree=replace(biped.scaled({"com": com}), joints=joints))


def _heavier(biped: Biped, body: str, k: float) -> Biped:
    """The robot with k times the masses and inertias of a body."""
    return replace(biped, tree=biped.scaled({"mass": {body: k}, "inertia": {body: k}}))


def _distance(s: Samples, zero: ZeroDynamics) -> float:
    """Largest distance of the samples from the periodic orbit of `zero` at equal times [rad], over all joints.

    Both begin at the time of the first sample. Nodes of the orbit outside of the samples' time are left out.
    """
    # time of each node: the integral of 1 / Theta' over Theta
    times = s.t[0] + zero.cumulative @ (1.0 / (zero.cycle.v @ zero.constraint.phase))
    inside = (times > s.t[0]) & (times < s.t[-1])
    return float(np.max(np.abs(CubicSpline(s.t, s.q)(times) - zero.cycle.q)[inside]))
