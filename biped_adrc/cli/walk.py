"""`biped-adrc simulate`, `poincare`, `animate`, `plot` and `play`: one walk, its stability, and its pictures.

`simulate` and `poincare` make a `Scenario` of the options. `simulate` walks it with `scenario.walk`, once more
at half the integration step to say how far the numbers can be trusted, judges every walking step by the limits
of ground and motors (`analysis.feasibility`) and stores the run. `poincare` finds the fixed point of the return
map from impact to impact, and its multipliers (`analysis.stability`).

`animate` draws the robot (`view.export`), `plot` its signals (`view.plots`). Both read a stored run and do not
walk again, so they need no class of the controller that made it. `play` writes a page on which one pushes a
robot by hand (`extras.play.page`).

`target` checks the name of an output file, which may not be one of the files that the command reads (`inputs`).
FIGURES are the suffixes that figures may have, WALKS the short options on what walks.
A command's docstring is its help text; its arguments are described in options.toml. `values` are values of a
scenario by dotted name, such as "hardware.period", from short options; `sets` are texts NAME=VALUE of --set.
"""

from __future__ import annotations

import tempfile
import webbrowser
from collections.abc import Sequence
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.table import Column

import biped_adrc as ba
from biped_adrc.cli.app import FIGURES, ExitCode, app, console, inputs, target
from biped_adrc.cli.options import WALKS, options, scenario_from, with_sets
from biped_adrc.core.errors import InputError, RaisedError
from biped_adrc.core.types import Array, PlainRecord

if TYPE_CHECKING:
    from biped_adrc.analysis.certificate import Certificate, Support
    from biped_adrc.analysis.soft_steps import SoftStep


@app.command()
@options("simulate", *WALKS, "impacts", "period", "torque_limit", "plant", "engine")
def simulate(
    values: PlainRecord,
    push: list[str] | None = None,
    sets: list[str] | None = None,
    scenario: Path | None = None,
    end_infeasible: bool = False,
    out: Path | None = None,
    log: Path | None = None,
) -> None:
    """Walk, and print what each step needed of the ground and of the motors."""
    from biped_adrc.scenario.build import limits

    s = scenario_from(values, sets, scenario, push)
    read = inputs(s.robot.name, s.gait.name)
    out, log = target(out, (".npz", ".mat", ".csv"), read), target(log, (".csv",), read)
    if log is not None and s.hardware.period is None:
        raise InputError("--log needs sample instants; give a --period, such as '1 ms'")
    _walk(s, limits(s), end_infeasible, out, log)


def _walk(
    s: ba.Scenario, limits: ba.Limits, end_infeasible: bool, out: Path | None, log: Path | None
) -> None:
    """Walk a scenario, print the walk, and write it to `out` and `log`; None for no file. Ends the command with
    ExitCode.FELL if the robot fell.

    limits: of ground and motors, for the judgement of each step; with end_infeasible the walk is cut where it
    first breaks one. A walk with motors is made again at half the integration step, for the error of
    integration, and from a start that differs by ASIDE, to see whether rounding decides it. Only the first walk
    is stored, before the others begin.
    """
    from biped_adrc.scenario.integration import ASIDE, DECIDES
    from biped_adrc.scenario.walk import halved

    name, total = f"walking, {s.controller.name}", s.run.impacts
    with console.bar(name) as shown:
        full = ba.walk_scenario(s, lambda t, n: shown(n, total, name))
        # half: the walk at half the integration step; near: what the other start changes [rad, s]; whole: the
        # walk before it is cut
        half, near, run, whole = None, 0.0, full.trajectory, full
        if run.status is ba.Status.RAISED:
            raise RaisedError(f"{run.status.value}, after {run.t_end:.4g} s:\n{run.detail}")
        full = full.until_infeasible(limits) if end_infeasible else full
        if out is not None:
            (full.save if out.suffix.lower() == ".npz" else full.export)(out)
        if log is not None:
            from biped_adrc.extras.logs.log_file import write_log
            from biped_adrc.extras.logs.robot_log import logged

            write_log(logged(full), log, full.walker.nominal)
        if full.gait is not None:  # a robot without motors has no gait
            # the walker says which integration steps the walk had, so that each can be halved
            finer, text = halved(s, full.walker), "the same at half the step"
            half = ba.walk_scenario(finer, lambda t, n: shown(n, total, text))
            # a walk on soft ground has no parts, from which it could be walked again
            near = whole.rounding() if whole.parts else 0.0
            half = half.until_infeasible(limits) if end_infeasible else half
    _print_on_ground(full.soft_steps)
    _print_end(full, half, limits)
    settings = full.trajectory.settings
    why = settings.get("why")
    console.print(f"engine {settings['engine']}" + (f": {why}" if why else ""))
    for remark in full.remarks:
        console.say(f"note: {remark}")
    if near > DECIDES:
        away = f"from a start {ASIDE:g} aside it ends {near:.1e} rad or s away"
        console.say(f"note: rounding decides digits of this walk: {away}, and so at any step")
    console.written(out, log)
    if not full.trajectory.status.ok:
        raise typer.Exit(ExitCode.FELL)


def _print_end(walk: ba.Walk, half: ba.Walk | None, limits: ba.Limits) -> None:
    """Print what every step needed of ground and motors, and how the walk ended.

    half: the same walk at half the integration step; None without motors, where there is no tracking error.
    limits: by which each step is judged.
    """
    from biped_adrc.analysis.half_step import error_text
    from biped_adrc.analysis.signals import FALLS
    from biped_adrc.scenario.walk import step_options

    feasibility, certificates = walk.feasible_within(limits), walk.certified(limits)
    _print_steps(feasibility.supports, certificates)
    run, about = walk.trajectory, walk.note
    # a walk that ended at its start has no tracking error
    if half is not None and run.t_end > run.t_start:
        each = (walk, half)
        # of both walks: largest tracking error [rad], status at the end, number of impacts
        ends = [(w.signals.peak_error, w.trajectory.status.name, w.impacts) for w in each]
        fall = " up to the fall" if run.status in FALLS else ""
        error = f"largest tracking error {error_text(step_options(*each), *ends)}{fall}"
        about = f"{error}, peak torque {walk.peak_torque:.1f} N m, {run.settings['method']}"
    console.print(f"{run.status.name}: {run.status.value} {run.detail}".strip())
    console.print(f"{walk.impacts_text}, {about}\n{feasibility.text()}")
    # `not >` also takes a NaN; of robots without motors, where `half` is None, it is not said
    stays = [c.step for c in certificates if not c.old_foot_velocity > 0.0]
    if stays and half is not None:
        console.print(f"the old stance foot does not lift off after steps {stays}")


def _print_steps(supports: Sequence[Support], certificates: Sequence[Certificate]) -> None:
    """Print a table of what walking steps needed of ground and motors, a row each, and the limits that each
    breaks.

    supports: numbers of each single support; certificates: of those that ended in an impact. The last step of a
    walk may have none, and so no length and no impact; on soft ground no step has one.
    """
    from biped_adrc.analysis.certificate import ratio_text

    rows = [
        {
            "step": f"{s.step}",
            "time [s]": f"{s.duration:.4f}",
            "length [m]": f"{c.step_length:.4f}" if c else "",
            "torque [N m]": f"{s.peak_torque:.1f}",
            "F_N [N]": f"{s.mean_normal_force:.1f}",
            "friction": ratio_text(s.mean_friction),
            "at impact": ratio_text(s.impulse_ratio) if c else "",
            "scuffs [mm]": f"{1e3 * s.scuffing:.2g}",
            "breaks": ", ".join(name.replace("_", " ") for name in s.infeasible()),
        }
        for s, c in zip_longest(supports, certificates)
    ]
    widths = {"friction": 8, "breaks": 8}
    header = (Column(name, min_width=widths.get(name)) for name in rows[0])
    cells = (row.values() for row in rows)
    console.table(header, cells, box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0))
    # one window [s], as all steps have the same limits; none where there is no step
    for window in {s.limits.window for s in supports}:
        console.print(f"F_N and friction: least and largest mean over {1e3 * window:g} ms")


def _print_on_ground(steps: tuple[SoftStep, ...]) -> None:
    """Print a table of what the feet did on soft ground, a row per single support; nothing for no steps."""
    header = "step", "slip [mm]", "in the air [ms]", "on both feet [ms]", "depth [mm]", "friction"
    rows = []
    for k, s in enumerate(steps, 1):
        # slip: of the foot that slips more
        slip, depth = f"{1e3 * max(s.slip):.2g}", f"{1e3 * s.depth:.2g}"
        flight, both = f"{1e3 * s.flight:.1f}", f"{1e3 * s.double_support:.1f}"
        rows.append((f"{k}", slip, flight, both, depth, f"{s.friction_used:.3f}"))
    if rows:
        console.table(header, rows)


def _named(letter: str, x: Array) -> str:
    """Text of the numbers x (K,) with their names, a letter and a count from 1: "q1 = 0.123000, q2 = .."."""
    return ", ".join(f"{letter}{i} = {value:.6f}" for i, value in enumerate(x, 1))


@app.command()
@options("poincare", *WALKS, controller="NPD, or passive")
def poincare(
    values: PlainRecord,
    sets: list[str] | None = None,
    scenario: Path | None = None,
    observer_states: bool = True,
) -> None:
    """Find the fixed point of the return map, and print its multipliers by every method side by side."""
    from biped_adrc.analysis.stability import nominal_step
    from biped_adrc.scenario.build import limits
    from biped_adrc.scenario.cycle import cycle_of

    # usual: the controller where none is named. observer_states: whether the controller's own states count
    # among those of the return map; else they begin anew after each impact
    s = scenario_from(values, sets, scenario, usual="NPD")
    cycle = cycle_of(s, observer_states)
    with console.status("Newton on the return map"):
        result = ba.cycle_stability(cycle)
    walker, o = cycle.P.walker, result.orbit  # P: the return map
    law = type(walker.controller).__name__.removesuffix("Controller")
    # x-: (q-, q'-), before the states of controller and observer
    q, v = np.split(o.x_minus[: 2 * walker.plant.n], 2)
    about = f"{s.robot.name}, {walker.plant.preset}, {law}"
    console.say(f"{about}, slope {walker.ground_slope:g} rad, {cycle.P.method.label}")
    console.say(f"x-: {_named('q', q)} [rad], {_named('v', v)} [rad/s]")
    step = nominal_step(cycle, o, limits(s))
    # the table takes numbers of single supports and certificates of impacts; `step`, a certificate, has both
    _print_steps([step], [step])
    console.say(f"residual {o.residual:.1e}; |lambda| by every method:\n{result.table.text()}")


# -- pictures of walks, and a page to push one ------------------------------------------------------
@app.command()
@options("animate")
def animate(
    run: Path,
    ghost: list[Path] | None = None,
    out: Path = Path("walk.html"),
    start: float | None = None,
    stop: float | None = None,
    sets: list[str] | None = None,
) -> None:
    """Write a stored walk as an HTML page, a moving picture, or a strip of poses."""
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.view.export import SUFFIXES, export
    from biped_adrc.view.placement import Clip

    # ghost: runs that are drawn translucent beside the first; clip: the time [s] that is drawn, and how
    runs, clip = [run, *(ghost or [])], with_sets(Clip, sets, start=start, stop=stop)
    out = target(out, SUFFIXES, runs)
    walks = load_walks(runs)
    first, *others = walks
    export(out, {name: walks[name] for name in (*others, first)}, clip)  # the last is drawn solid
    console.written(out)


@app.command()
@options("plot")
def plot(
    run: Path,
    beside: list[Path] | None = None,
    figure: str = "tracking",
    out: Path = Path("figure.png"),
) -> None:
    """Draw the signals of a run."""
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.view.plots.figures import draw

    runs = [run, *(beside or [])]
    out = target(out, FIGURES, runs)
    console.draw(out, draw(figure, load_walks(runs)))


@app.command("play")
@options("play", *WALKS)
def play_command(
    values: PlainRecord,
    scenario: Path | None = None,
    sets: list[str] | None = None,
    ghost: str | None = None,
    out: Path | None = None,
) -> None:
    """Push a walk yourself, on a page with a guided tour; sampled at 1 kHz if not said otherwise."""
    from biped_adrc.extras.play.page import OTHERS

    out = target(out, (".html",), () if scenario is None else (scenario,))
    s = scenario_from(values, sets, scenario)
    if s.hardware.period is None:
        s = s.replace({"hardware.period": 1e-3})
    # the walk beside: another controller than the scenario's
    ghost = ghost or ("ADRC" if s.controller.name == "NPD" else "NPD")
    # walks to choose from on the page, by name; OTHERS: those that each page has
    others = {ghost: {"controller.name": ghost}, **OTHERS}
    # without a name a page in a temporary folder, opened in the browser
    path = Path(tempfile.mkdtemp(prefix="biped-adrc-")) / "walk.html" if out is None else out
    ba.play(path, s, others)
    console.written(path)
    if out is None and not webbrowser.open(path.as_uri()):
        console.say("no browser could be opened here: open the page in one")
