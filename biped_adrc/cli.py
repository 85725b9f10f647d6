"""The command `biped-adrc`.

Exit codes: 0 all is well (for `reproduce`: every check holds); 1 a check of `reproduce` does not hold;
2 the command line is wrong; 3 bad input (robot, gait, poles, duration, file); 4 the robot fell or did not
come back; 5 a result cannot be written; 130 interrupted with Ctrl-C.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TextColumn,
    TimeElapsedColumn,
)
from rich.table import Table

from biped_adrc.errors import BipedError, InputError

if TYPE_CHECKING:
    from biped_adrc.studies.push import Push
    from biped_adrc.studies.runs import Outcome

EXIT_CHECK_FAILED, EXIT_FELL, EXIT_INTERRUPTED = 1, 4, 130

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Underactuated walking with active disturbance rejection control (ADRC with a GPI observer).\n\n"
    "Exit codes: 0 all is well, 1 a check of 'reproduce' does not hold, 2 wrong command line, 3 bad input, "
    "4 the robot fell, 5 cannot write, 130 interrupted.",
)
gait_app = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="Regenerate or show the stored gaits."
)
app.add_typer(gait_app, name="gait")
console = Console()

Preset = Annotated[
    str, typer.Option(help="Parameters of RABBIT: identified, identified-bare or tac2003.")
]
Pushes = Annotated[
    list[str] | None,
    typer.Option(
        "--push",
        help="Torque [N m] on joints in one single support, JOINTS=TORQUE@STEP:START-STOP [s]; e.g. "
        "'q1,q2=30@19:0.1-0.3'. End with ':sine=5' for a sine of 5 Hz, or give 'START-' for one that stays. "
        "Joints are q1..q5 or names of the URDF; q5 is the unactuated torso. May be repeated; "
        "several joints with different torques: 'q1=30,q3=-20@19:0.1-0.3'.",
    ),
]


def _parse_pushes(texts: list[str] | None) -> tuple[Push, ...]:
    from biped_adrc.studies.push import parse_push

    return tuple(parse_push(text) for text in texts or ())


def _command() -> str:
    return "biped-adrc " + " ".join(sys.argv[1:])


def _bar() -> Progress:
    return Progress(
        SpinnerColumn(),
        TextColumn("{task.description:<44.44}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=console,
    )


@app.command()
def reproduce(
    out: Annotated[
        Path, typer.Option(help="Folder for figures, runs, tables and the report.")
    ] = Path("out"),
    preset: Preset = "identified",
    push: Pushes = None,
    full: Annotated[
        bool,
        typer.Option("--full", help="A finer map of pushes: 8 onsets, 5 amplitudes."),
    ] = False,
    quick: Annotated[
        bool,
        typer.Option(
            "--quick", help="A first look: no map of pushes, one preset, no multipliers of ADRC."
        ),
    ] = False,
    workers: Annotated[int | None, typer.Option(help="Processes; by default one per core.")] = None,
) -> None:
    """Reproduce the paper: runs, figures 1, 4, 5, 6, Tables I and II, stability, and a verdict."""
    from biped_adrc.model.robots import load_description
    from biped_adrc.studies.plan import PAPER_PUSH, Plan
    from biped_adrc.studies.reproduction import failed, main_table
    from biped_adrc.studies.reproduction import reproduce as run

    pushes = _parse_pushes(push)
    description = load_description("rabbit")
    description.preset(preset)
    for joint in (joint for p in pushes for joint in p.torque):
        description.joint_index(joint)
    plan = Plan(preset, pushes=pushes or (PAPER_PUSH,), full=full, quick=quick)
    with _bar() as bar:
        task = bar.add_task("starting", total=None)

        def progress(done: int, total: int, name: str) -> None:
            bar.update(task, completed=done, total=total, description=name)

        summary = run(plan, out, _command(), workers, progress)
    table = Table("", "paper", "here", "verdict", title="Reproduction")
    for row in main_table(summary):
        table.add_row(*row)
    console.print(table)
    if plan.left_out:
        console.print(f"left out of this run: {', '.join(plan.left_out)}")
    broken = failed(summary["checks"])
    console.print(f"{len(summary['checks']) - len(broken)} of {len(summary['checks'])} checks hold")
    for check in broken:
        console.print(f"does not hold: {check['name']}: {check['value']} {check['limit']}")
    console.print(f"written to {out}: report.html, walk.html, summary.json, figures and runs")
    if broken:
        raise typer.Exit(EXIT_CHECK_FAILED)


@app.command()
def simulate(
    controller: Annotated[str, typer.Option(help="ADRC or NPD.")] = "ADRC",
    gait: Annotated[
        str, typer.Option(help="published (through x*), recipe (section IV), or a .json file.")
    ] = "published",
    preset: Preset = "identified",
    push: Pushes = None,
    impacts: Annotated[
        int, typer.Option(help="Impacts to walk (12.5 steps of the paper are 25).")
    ] = 25,
    period: Annotated[
        float | None,
        typer.Option(help="Sampling period [s] of the controller; continuous if left out."),
    ] = None,
    torque_limit: Annotated[
        float | None, typer.Option(help="Saturation of the motors [N m].")
    ] = None,
    poles: Annotated[
        str | None,
        typer.Option(help="m + 2 observer poles [rad/s], comma separated; by default Table I."),
    ] = None,
    bandwidth: Annotated[
        float | None, typer.Option(help="Observer bandwidth [rad/s] instead of poles.")
    ] = None,
    order: Annotated[int, typer.Option(help="Order m of the observer, with --bandwidth.")] = 1,
    reset: Annotated[
        str, typer.Option(help="Observer at impact: none, relabel, measured or model.")
    ] = "model",
    as_printed: Annotated[
        bool, typer.Option("--as-printed", help="Drop h' Theta'' from (20) and (28), as printed.")
    ] = False,
    friction: Annotated[
        bool, typer.Option("--friction", help="Add RABBIT's joint friction.")
    ] = False,
    method: Annotated[str | None, typer.Option(help="rk4, exponential, adaptive or stiff.")] = None,
    step: Annotated[float | None, typer.Option(help="Step of rk4 and exponential [s].")] = None,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Write the run (.npz, .json).")
    ] = None,
) -> None:
    """Walk, and print what each step needed."""
    from biped_adrc.hybrid.storage import save
    from biped_adrc.studies.runs import Run, execute_fully
    from biped_adrc.studies.versions import versions

    extra: dict[str, Any] = {}
    if poles is not None:
        extra["poles"] = _numbers(poles, "--poles")
    run = Run(
        controller.upper(),
        preset=preset,
        gait=gait,
        pushes=_parse_pushes(push),
        period=period,
        torque_limit=torque_limit,
        friction=friction,
        impacts=impacts,
        bandwidth=bandwidth,
        order=order,
        solve_theta=not as_printed,
        reset=reset,
        method=method,
        h=step,
        **extra,
    )
    with _bar() as bar:
        task = bar.add_task(f"walking, {run.controller}", total=impacts)
        full = execute_fully(run, lambda t, n: bar.update(task, completed=n))
    o = full.outcome
    _print_steps(o)
    if out is not None:
        save(full.trajectory, out, {"run": run.record(), "versions": versions()})
        console.print(f"written to {out.with_suffix('.npz')}")
    if not o.walked:
        raise typer.Exit(EXIT_FELL)


def _print_steps(o: Outcome) -> None:
    table = Table("step", "time [s]", "length [m]", "torque [N m]", "friction", "F_N [N]", "remark")
    for c in o.certificates:
        table.add_row(
            f"{c.step}",
            f"{c.duration:.4f}",
            f"{c.step_length:.4f}",
            f"{c.peak_torque:.1f}",
            f"{c.friction:.3f}",
            f"{c.least_normal_force:.1f}",
            "; ".join(c.violations()),
        )
    console.print(table)
    console.print(
        f"{o.status}: {o.message}\n{o.impacts} impacts, largest tracking error {o.peak_error:.3e} rad, "
        f"peak torque {o.peak_torque:.1f} N m, {o.method}"
    )


def _numbers(text: str, what: str) -> tuple[float, ...]:
    try:
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise InputError(f"{what} is '{text}', expected numbers separated by commas") from None


@app.command()
def poincare(
    controller: Annotated[str, typer.Option(help="ADRC or NPD.")] = "NPD",
    gait: Annotated[str, typer.Option(help="published, recipe, or a .json file.")] = "published",
    preset: Preset = "identified",
    observer_states: Annotated[
        bool, typer.Option(help="Count the observer's states among the coordinates.")
    ] = True,
) -> None:
    """Fixed point of the return map and its multipliers, by central differences."""
    from biped_adrc.studies.poincare import poincare as find
    from biped_adrc.studies.runs import Run

    run = Run(controller.upper(), preset=preset, gait=gait)
    with console.status("Newton on the return map"):
        found = find(run, observer_states)
    o = found.orbit
    console.print("x- =", " ".join(f"{value:.6f}" for value in o.x_minus[:10]))
    console.print("|lambda| =", " ".join(f"{abs(value):.4g}" for value in o.multipliers))
    console.print(
        f"delta^2 of the zero dynamics {found.delta_squared:.6f}, residual {o.residual:.1e}, "
        f"{'stable' if o.stable else 'unstable'}"
    )


@app.command()
def animate(
    run: Annotated[Path, typer.Argument(help="A run written by 'simulate' or 'reproduce' (.npz).")],
    ghost: Annotated[
        list[Path] | None,
        typer.Option(help="Another run, drawn translucent beside the first. May be repeated."),
    ] = None,
    out: Annotated[
        Path,
        typer.Option(
            "--out",
            "-o",
            help="What to write: .html (offline page), .gif, or .png or .svg (strip).",
        ),
    ] = Path("walk.html"),
    view: Annotated[
        str, typer.Option(help="side (orthographic) or perspective; of the page.")
    ] = "side",
    start: Annotated[
        float | None, typer.Option("--from", help="Start of a .gif or strip [s].")
    ] = None,
    stop: Annotated[float | None, typer.Option("--to", help="End of a .gif or strip [s].")] = None,
    fps: Annotated[
        float | None, typer.Option(help="Frames per second; 60, or 25 for a .gif.")
    ] = None,
    live: Annotated[
        bool,
        typer.Option("--live", help="Show it in the browser from a server on 127.0.0.1 instead."),
    ] = False,
    port: Annotated[int, typer.Option(help="Port of --live; 0 takes a free one.")] = 0,
    browser: Annotated[
        bool, typer.Option(help="Open the browser with --live, or only print the address.")
    ] = True,
    wait: Annotated[
        float, typer.Option(help="How long --live waits for the first page [s].")
    ] = 120.0,
) -> None:
    """Write the walk as a page, a picture or a strip; or show it live."""
    from biped_adrc.studies.runs import load_walks
    from biped_adrc.viz.export import Clip, check_suffix, export

    if not live:
        check_suffix(out)
    walks = load_walks([*(ghost or []), run])
    if live:
        from biped_adrc.viz.live import play
        from biped_adrc.viz.meshcat import Look

        look = Look(fps=60.0 if fps is None else fps, view=view)
        console.print(
            play(walks, look, port=port, open_browser=browser, wait=wait, say=console.print)
        )
        return
    export(out, walks, Clip(start, stop, fps, view))
    console.print(f"written to {out}")


@app.command()
def plot(
    run: Annotated[Path, typer.Argument(help="A run written by 'simulate' or 'reproduce' (.npz).")],
    beside: Annotated[
        list[Path] | None, typer.Option("--with", help="Another run to compare. May be repeated.")
    ] = None,
    figure: Annotated[
        str,
        typer.Option(
            help="tracking, disturbance, ground, energy; phase or comparison of all runs."
        ),
    ] = "tracking",
    out: Annotated[Path, typer.Option("--out", "-o", help="What to write: .png or .svg.")] = Path(
        "figure.png"
    ),
) -> None:
    """Draw the signals of a run."""
    from biped_adrc.files import write_bytes
    from biped_adrc.studies.figures import draw
    from biped_adrc.studies.runs import load_walks
    from biped_adrc.viz.style import render

    walks = load_walks([run, *(beside or [])])
    write_bytes(out, render(draw(figure, walks), out.suffix.lower().removeprefix(".")))
    console.print(f"written to {out}")


@gait_app.command("published")
def gait_published(
    preset: Preset = "identified",
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Where to write it (.json).")
    ] = None,
) -> None:
    """Design gait (a): the constraint of least torque whose orbit passes through the published x*."""
    from biped_adrc.gait.published import design_published_gait
    from biped_adrc.model.biped import Biped

    _save(design_published_gait(Biped.load("rabbit", preset)), out)


@gait_app.command("recipe")
def gait_recipe(
    preset: Preset = "identified",
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Where to write it (.json).")
    ] = None,
) -> None:
    """Design gait (b): hip sine, inverse kinematics and polynomial regression, section IV."""
    from biped_adrc.model.biped import Biped
    from biped_adrc.studies.recipe_orbit import design_recipe_orbit

    _save(design_recipe_orbit(Biped.load("rabbit", preset)), out)


@gait_app.command("show")
def gait_show(
    gait: Annotated[str, typer.Argument(help="published, recipe, or a .json file.")] = "published",
    preset: Preset = "identified",
) -> None:
    """Print a stored gait's provenance and its zero dynamics."""
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.gait.zero_dynamics import ZeroDynamics
    from biped_adrc.model.biped import Biped

    biped = Biped.load("rabbit", preset)
    found = load_gait(gait, biped)
    for key, value in found.provenance.items():
        console.print(f"{key}: {value}")
    zero = ZeroDynamics.of(biped, found.constraint)
    console.print(f"period {found.period:.6f} s, delta^2 {zero.delta**2:.6f}")


def _save(gait: Any, out: Path | None) -> None:
    path = out or Path(f"{gait.name}-{gait.preset}.json")
    gait.save(path)
    console.print(f"period {gait.period:.6f} s; written to {path}")


def _say_interrupted() -> None:
    Console(stderr=True).print("interrupted; what was already written is complete")


def main() -> None:
    """Entry point: errors become one message and an exit code."""
    try:
        app(standalone_mode=True)
    except BipedError as error:
        Console(stderr=True).print(f"error: {error}", markup=False, highlight=False, soft_wrap=True)
        sys.exit(error.exit_code)
    except SystemExit as stop:
        if stop.code == EXIT_INTERRUPTED:
            _say_interrupted()
        raise
    except KeyboardInterrupt:
        _say_interrupted()
        sys.exit(EXIT_INTERRUPTED)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)


if __name__ == "__main__":
    main()
