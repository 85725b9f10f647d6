"""Whole figures made of the plots in `biped_adrc.view.plots`: data in, Figure out, in this package's style.

`Walk.plot`, the reproduction of the paper and `biped-adrc plot` draw these. With a push they show the time
around it, and most of them the milliseconds after each of its edges, the times at which it begins and ends, in
which a fast observer acts. A column is a list of panels above one another with one time axis; the grid `spec`
of a figure has four columns, so that one panel takes all, two or one of them. In figures that compare
controllers the i-th one has the i-th colour and mark in all panels. `Signals` are angles, torques, errors and
forces over time, at the stored instants of a walk.

Symbols: zeta, torque from outside on each coordinate [N m]; xi of (13) of the paper, total disturbance of a
joint [rad/s^2], and xi^, an observer's estimate of it; Theta, phase of the gait [rad], and its rate Theta'.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase
from matplotlib.gridspec import SubplotSpec
from numpy.typing import ArrayLike

from biped_adrc.analysis.loops.gang import GANG_UNITS, Gang
from biped_adrc.analysis.signals import Signals
from biped_adrc.core.errors import InputError
from biped_adrc.view.placement import Drawable
from biped_adrc.view.plots import over_time
from biped_adrc.view.plots.over_time import Window
from biped_adrc.view.style import GREY, PALETTE, label, literal, new_figure

BEFORE, AFTER = 0.3, 0.6
"""Time shown before and after a push [s]."""
EDGE_BEFORE, EDGE_AFTER = 1e-3, 6e-3
"""Time shown before and after either edge of a push [s]."""

_MARKERS = "ox^s"
"""Marks of the points, one for each method of computing multipliers."""

Panel = Callable[[Axes], object]
"""A function that draws one panel on the axes it is given."""


def tracking_figure(
    signals: Signals, title: str, push: Window | None = None, torque_limit: float | None = None
) -> Figure:
    """Draw the paper's figures 4 and 5: references and angles [rad], torques [N m], and the tracking error.

    signals: of a walk with motors. title: above all panels. push: (start, stop) [s]; the figure then shows the
    time around it, shaded, and the milliseconds after either edge, but for angles, as these do not move within
    milliseconds. torque_limit [N m]: drawn as a dotted line.
    """
    p = signals.q_d.shape[1]  # number of joints with motors
    # two panels of angles: of the five-link robot RABBIT hips and knees
    halves = [half.tolist() for half in np.array_split(np.arange(p), min(2, p))]
    below: list[Panel] = [
        partial(over_time.torques, s=signals, limit=torque_limit, push=push),
        partial(over_time.tracking_errors, s=signals, push=push),
    ]
    with new_figure(10.0, 7.2, _titled(title, signals, push)) as figure:
        # row 0 of the grid for the angles, 1 and 2 for `below`; _zoom: the time axis around the push
        spec = figure.add_gridspec(3, 4)
        width = 4 // len(halves)  # of a panel, in columns of the grid
        for k, joints in enumerate(halves):
            axes = figure.add_subplot(spec[0, k * width : (k + 1) * width])
            _zoom([over_time.joint_tracking(axes, signals, joints, push)], signals, push)
        _around_and_edges(spec, (1, 2), below, signals, push)
        return figure


def _titled(title: str, s: Signals, push: Window | None) -> str:
    """The title; with a push followed by the external torque on each joint [N m] where its magnitude is
    largest, such as "ADRC: 30 N m on $q_1$, $q_2$".
    """
    if push is None:
        return title
    # per joint the torque, with its sign, at the instant at which it is largest
    peaks = s.zeta[np.argmax(np.abs(s.zeta), axis=0), np.arange(s.zeta.shape[1])]
    joints: dict[str, list[str]] = {}
    for i in np.flatnonzero(peaks):
        joints.setdefault(f"{peaks[i]:.3g} N m", []).append(f"$q_{i + 1}$")
    words = "; ".join(f"{torque} on {', '.join(names)}" for torque, names in joints.items())
    return f"{title}: {words}" if words else title


def _column(
    figure: FigureBase, places: Sequence[SubplotSpec], draws: Sequence[Panel]
) -> list[Axes]:
    """Draw panels one above the other, draws[i] at places[i], that share one time axis, labelled below the
    lowest; returns their axes.
    """
    column: list[Axes] = []
    for place, draw in zip(places, draws, strict=True):
        column.append(figure.add_subplot(place, sharex=column[0] if column else None))
        draw(column[-1])
    for axes in column[:-1]:
        axes.tick_params(labelbottom=False)
        axes.set_xlabel("")
    return column


def _around_and_edges(
    spec: Any, rows: Sequence[int], draws: Sequence[Panel], s: Signals, push: Window | None
) -> list[list[Axes]]:
    """Draw each of `draws` in a row of three columns: around the push, where it begins, and where it ends.

    The columns of the edges of the push have their time axis in [ms] from the edge; the label of their values
    is at the left end of the row. Without a push there is one column, with the whole walk. rows: numbers of the
    rows of the grid `spec`, which has four columns: two for the time around the push, one for either edge.
    Returns for each column drawn the list of its axes.
    """
    places = (slice(0, 2), slice(2, 3), slice(3, 4)) if push else (slice(0, 4),)
    cells = ([spec[row, place] for row in rows] for place in places)
    around, *edges = (_column(spec.figure, each, draws) for each in cells)
    _zoom(around, s, push)
    at = np.arange(0.0, EDGE_AFTER + 1e-9, 2e-3)  # a tick every 2 ms, the end included
    for column, edge, name in zip(edges, push or (), ("begins", "ends"), strict=False):
        _limits(column, max(edge - EDGE_BEFORE, s.t[0]), min(edge + EDGE_AFTER, s.t[-1]))
        for axes in column:
            axes.legend().remove()
            axes.set_xticks(edge + at, [f"{1e3 * t:g}" for t in at])
            axes.set_ylabel("")
        column[0].set_title(f"push {name}", loc="left")
        column[-1].set_xlabel("after the edge [ms]")
    return [around, *edges]


def _zoom(column: Sequence[Axes], s: Signals, push: Window | None) -> None:
    """Set the time axis of a column to the time around the push, of the whole walk if None, and each value axis
    to the range of the data shown there.
    """
    # within the walk
    start, stop = push or (s.t[0], s.t[-1])
    _limits(column, max(start - BEFORE, s.t[0]), min(stop + AFTER, s.t[-1]))


def _limits(column: Sequence[Axes], low: float, high: float) -> None:
    """Set the time axis from low to high [s], and each value axis to the range of the data shown there.

    A panel without data there, or with a constant, keeps its limits.
    """
    for axes in column:
        axes.set_xlim(low, high)
        shown = [np.asarray(line.get_data(), dtype=float) for line in axes.get_lines()]
        # lines of two points are marks, such as that of an impact, and no data
        inside = (y[(t >= low) & (t <= high)] for t, y in shown if len(t) > 2)
        values = np.concatenate([np.zeros(0), *inside])
        values = values[np.isfinite(values)]
        least, most = values.min(initial=np.inf), values.max(initial=-np.inf)
        # a margin: a factor of two on a logarithmic axis, else 6 % of the range
        if most > least:
            pad, log = 0.06 * (most - least), axes.get_yscale() == "log"
            axes.set_ylim((0.5 * least, 2.0 * most) if log else (least - pad, most + pad))


def passive_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """Draw a walk without motors: its angles [rad] and energies [J] over time [s], and Theta' over Theta.

    push: (start, stop) [s], shaded.
    """
    with new_figure(10.5, 5.6, title) as figure:
        parts = figure.subplot_mosaic(
            [["angles", "phase"], ["energy", "phase"]], width_ratios=(3, 2)
        )
        over_time.angles(parts["angles"], signals, push).set_xlabel("")
        over_time.energy(parts["energy"], signals, push)
        over_time.phase_portrait(parts["phase"], signals)
        return figure


def phase_figure(walks: Mapping[str, Signals]) -> Figure:
    """Draw the paper's figure 6: Theta' [rad/s] over Theta [rad], in a panel for each controller.

    walks: name of the controller -> signals. Lines break at impacts.
    """
    with new_figure(4.6 * len(walks), 4.2) as figure:
        row = figure.subplots(1, len(walks), squeeze=False, sharex=True, sharey=True)[0]
        for i, (axes, (name, s)) in enumerate(zip(row, walks.items(), strict=True)):
            over_time.phase_portrait(axes, s, name, i).set_title(name, loc="left")
        return figure


def disturbance_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """Draw the total disturbance of every actuated joint, and the external torque, against their estimates.

    Above: xi of (13) [rad/s^2], a panel for each joint. Below: the torque zeta on each joint and the torque
    that its estimate xi^ is equivalent to [N m], a colour for each torque; joints with the same torque share
    the line. push: (start, stop) [s]; the time around it is shown, below also either edge.
    """
    p = signals.q_d.shape[1]  # number of joints with motors
    with new_figure(10.0, 5.2, _titled(title, signals, push)) as figure:
        parts: Any = figure.subfigures(2, 1)
        above, below = parts
        for i, axes in enumerate(above.subplots(1, p, squeeze=False, sharex=True)[0]):
            _zoom([over_time.total_disturbance(axes, signals, i, push)], signals, push)
        # a row, number 0, of three panels: around the push, where it begins, where it ends
        draw = partial(over_time.matched_disturbance, s=signals, push=push)
        _around_and_edges(below.add_gridspec(1, 4), (0,), [draw], signals, push)
        return figure


def ground_figure(
    signals: Signals, title: str, mu: float, slope: float, push: Window | None
) -> Figure:
    """Draw the ground reaction [N] over time, and its tangential against its normal part in the friction cone.

    mu [1]: coefficient of friction. slope [rad]: of the ground, positive downhill. push: (start, stop) [s],
    shaded; the time around it is shown.
    """
    with new_figure(10.0, 4.0, _titled(title, signals, push)) as figure:
        forces, cone = figure.subplots(1, 2, width_ratios=(3, 2))
        _zoom([over_time.ground_reaction(forces, signals, push, slope)], signals, push)
        over_time.friction_cone(cone, signals, mu, slope)
        return figure


def energy_figure(signals: Signals, title: str = "", push: Window | None = None) -> Figure:
    """Draw kinetic, potential and total energy [J] over time [s].

    push: (start, stop) [s], shaded; the time around it is shown.
    """
    with new_figure(7.0, 3.4, _titled(title, signals, push)) as figure:
        _zoom([over_time.energy(figure.subplots(), signals, push)], signals, push)
        return figure


def multiplier_plane(axes: Axes, found: Mapping[str, ArrayLike]) -> Axes:
    """Draw Floquet multipliers in the complex plane with the unit circle; returns the axes.

    found: name of a method -> its multipliers (k,), complex, dimensionless.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(np.cos(angle), np.sin(angle), color="black", lw=1.0, label="unit circle")
    for i, (name, values) in enumerate(found.items()):
        z = np.atleast_1d(np.asarray(values, dtype=complex))
        _plot(axes, i, name, z.real, z.imag, 7 + 2 * i)  # marks of later methods are larger
    axes.set_aspect("equal")
    label(axes, r"Re $\lambda$ [-]", r"Im $\lambda$ [-]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=3, frameon=False)
    return axes


def magnitudes(axes: Axes, found: Mapping[str, ArrayLike], published: ArrayLike | None) -> Axes:
    """Draw |lambda| of multipliers, in decreasing order, on a logarithmic scale; returns the axes. A walk is
    stable when all are below 1.

    found: name of a method -> its multipliers (k,), dimensionless. Zeros have no place on that scale:
    the legend counts them. published (k,): magnitudes printed in the paper; they come from a regression
    and are shown for comparison only.
    """
    axes.axhline(1.0, color="black", lw=1.0, label="unit circle")
    for i, (name, values) in enumerate(found.items()):
        size = np.sort(np.abs(np.atleast_1d(np.asarray(values, dtype=complex))))[::-1]
        zeros = int(np.sum(size == 0.0))  # a logarithmic scale has no place for them
        size = size[size > 0.0]
        name = f"{name}, {zeros} more are 0" if zeros else name
        _plot(axes, i, name, 1.0 + np.arange(len(size)), size, 6)
    if published is not None:
        size = np.sort(np.abs(np.asarray(published)))[::-1]
        name = "printed in the paper (regression)"
        axes.plot(1 + np.arange(len(size)), size, "+", color=GREY, ms=8, label=name)
    axes.set_yscale("log")
    label(axes, "number in decreasing order [-]", r"$|\lambda|$ [-]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=2, frameon=False)
    return axes


def _plot(axes: Axes, i: int, name: str, x: ArrayLike, y: ArrayLike, size: int) -> None:
    """Draw y (k,) over x (k,) as open marks of the i-th kind and colour, `size` [pt] large, so that marks at
    the same place are seen; name: in the legend.
    """
    marker, colour = _MARKERS[i % 4], PALETTE[i]
    axes.plot(x, y, marker=marker, ls="", mec=colour, mfc="none", ms=size, label=name)


def multiplier_figure(multipliers: Mapping[str, ArrayLike], published: ArrayLike | None) -> Figure:
    """Draw Floquet multipliers in the unit circle, and beside it their magnitudes in decreasing order: a walk
    is stable if all are inside.

    multipliers: name of a method or a controller -> (k,), complex. published (k,): magnitudes printed in the
    paper, shown for comparison; see `magnitudes`.
    """
    with new_figure(9.5, 4.4) as figure:
        circle, sizes = figure.subplots(1, 2)
        multiplier_plane(circle, multipliers).set_title("multipliers", loc="left")
        magnitudes(sizes, multipliers, published).set_title("magnitudes", loc="left")
        return figure


def comparison_figure(walks: Mapping[str, Signals], push: Window | None = None) -> Figure:
    """Draw controllers side by side: tracking error over time, peak and rms of the
    error, and the peak torques.

    walks: name of the controller -> signals. push: (start, stop) [s]; the time around it is shown, and the
    milliseconds after either edge. The title names the torques of the first walk, the same in all.
    """
    first = next(iter(walks.values()))
    with new_figure(10.0, 5.8, _titled(" and ".join(walks), first, push)) as figure:
        spec = figure.add_gridspec(2, 4)
        draw = partial(over_time.error_over_time, walks=walks, push=push)
        # one row, (0,), of up to three panels: around the push, and behind each of its edges
        (around,), *edges = _around_and_edges(spec, (0,), [draw], first, push)
        for (axes,) in edges:  # the same scale in all three panels
            axes.set_ylim(around.get_ylim())
        # two panels in row 1 of the grid
        sizes, motors = figure.add_subplot(spec[1, :2]), figure.add_subplot(spec[1, 2:])
        over_time.error_sizes(sizes, walks)
        over_time.torque_sizes(motors, walks)
        return figure


SIX = {
    "S": "sensitivity",
    "T": "complementary sensitivity",
    "P S": "load torque to error",
    "C S": "angle's error to torque",
    "y/r": "reference to joints",
    "u/r": "reference to torque",
}
"""Titles of the panels of `gang_figure`."""


def gang_figure(gang: Gang, title: str = "") -> Figure:
    """Draw the gang of six of a loop over frequency [rad/s], each the largest singular value over the joints.

    Dotted: half the sampling frequency; in the panels of S, T and y/r the level 1.
    """
    with new_figure(9.0, 5.0, title) as figure:
        for axes, (name, what) in zip(figure.subplots(2, 3).flat, SIX.items(), strict=True):
            unit = GANG_UNITS[name]
            label(axes, "frequency [rad/s]", f"|{name}|" + f" [{unit}]" * bool(unit), what)
            axes.loglog(gang.frequencies, gang.responses[name], color=PALETTE[0])
            axes.axvline(np.pi / gang.period, color=GREY, lw=0.8, ls=":")
            if not unit:
                axes.axhline(1.0, color=GREY, lw=0.8, ls=":")
        return figure


NAMES = ("tracking", "disturbance", "ground", "energy", "phase", "comparison")
"""Figures that can be asked for."""


def walk_figure(walk: Drawable, title: str = "", push: Window | None = None) -> Figure:
    """Draw a walk as `tracking_figure` does, and one of a robot without motors as `passive_figure`.

    push: (start, stop) [s], shaded.
    """
    if walk.walker.plant.p == 0:
        return passive_figure(walk.signals, title, push)
    return tracking_figure(walk.signals, title, push, walk.walker.torque_limit)


def draw(name: str, walks: Mapping[str, Drawable]) -> Figure:
    """Draw the figure `name`, one of NAMES: of the first walk, of all walks for "phase" and "comparison".

    walks: name, for titles and legend -> walk. The time around the first walk's push is shown. Raises
    InputError for an unknown name, or a robot without motors where the figure shows motors.
    """
    if name not in NAMES:
        raise InputError(f"there is no figure '{name}'; choose one of {list(NAMES)}")
    # `literal`: matplotlib would read dollars in a name as formulas
    walks = {literal(n): w for n, w in walks.items()}
    title, walk = next(iter(walks.items()))
    signals = {n: w.signals for n, w in walks.items()}
    first, push = signals[title], push_window(signals[title])
    if name in ("disturbance", "comparison") and any(s.u.shape[1] == 0 for s in signals.values()):
        raise InputError(
            f"figure '{name}' shows what motors do and these walks have a robot without; choose one of "
            "'tracking', 'ground', 'energy', 'phase'"
        )
    mu, slope = walk.walker.plant.description.friction_coefficient, walk.walker.ground_slope
    return {
        "tracking": partial(walk_figure, walk, title, push),
        "disturbance": partial(disturbance_figure, first, title, push),
        "ground": partial(ground_figure, first, title, mu, slope, push),
        "energy": partial(energy_figure, first, title, push),
        "phase": partial(phase_figure, signals),
        "comparison": partial(comparison_figure, signals, push),
    }[name]()


def push_window(s: Signals) -> tuple[float, float] | None:
    """First and last time [s] at which an external torque acts in the first single support that has one; None
    where no torque acts. A push that goes on over an impact ends here with that single support.
    """
    pushed = np.any(s.zeta != 0.0, axis=1)
    if not pushed.any():
        return None
    t = s.t[pushed & (s.step == s.step[pushed][0])]
    return float(t[0]), float(t[-1])
