"""`biped-adrc simulate` and `poincare`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from biped_adrc.cli.app import (
    EXIT_FELL,
    Pushes,
    Robot,
    RobotPreset,
    app,
    bar,
    console,
    parse_pushes,
)
from biped_adrc.cli.output import inputs, run_path, say_written, write_run
from biped_adrc.cli.passive import simulate_passive
from biped_adrc.errors import InputError

if TYPE_CHECKING:
    from biped_adrc.analysis.certificate import Certificate
    from biped_adrc.analysis.legality import Legality
    from biped_adrc.model.limits import Limits
    from biped_adrc.studies.runs import Outcome, Run


Controller = Annotated[str, typer.Option(help="ADRC or NPD; passive for robots without motors.")]
Gait = Annotated[
    str,
    typer.Option(
        help="published (through x*), recipe (section IV), v0.4 to v1.1 (by speed), or a .json file."
    ),
]
Impacts = Annotated[int, typer.Option(help="Impacts to walk (12.5 steps of the paper are 25).")]
Period = Annotated[
    float | None,
    typer.Option(help="Sampling period [s] of the controller; continuous if left out."),
]
TorqueLimit = Annotated[float | None, typer.Option(help="Saturation of the motors [N m].")]
Poles = Annotated[
    str | None,
    typer.Option(help="m + 2 observer poles [rad/s], comma separated; by default Table I."),
]
Bandwidth = Annotated[
    float | None, typer.Option(help="Observer bandwidth [rad/s] instead of poles.")
]
Order = Annotated[int, typer.Option(help="Order m of the observer, with --bandwidth.")]
Reset = Annotated[str, typer.Option(help="Observer at impact: none, relabel, measured or model.")]
AsPrinted = Annotated[
    bool, typer.Option("--as-printed", help="Drop h' Theta'' from (20) and (28), as printed.")
]
Friction = Annotated[bool, typer.Option("--friction", help="Add the robot's joint friction.")]
Method = Annotated[str | None, typer.Option(help="rk4, exponential, feedback, adaptive or stiff.")]
Engine = Annotated[str, typer.Option(help="pinocchio, or compiled: the same walk, much faster.")]
StepSize = Annotated[float | None, typer.Option(help="Step of rk4 and exponential [s].")]
FrictionLimit = Annotated[
    float | None,
    typer.Option(help="Friction of the ground for a legal step; the robot's record without."),
]
ForceWindow = Annotated[
    float, typer.Option(help="Over which the force of the ground is averaged for that [s].")
]
EndIllegal = Annotated[
    bool,
    typer.Option(
        "--end-illegal",
        help="End at the first step that ground or motors could not carry; exit code 4, as for a fall.",
    ),
]
Out = Annotated[
    Path | None, typer.Option("--out", "-o", help="Write the run (.npz), or its signals (.mat).")
]


@app.command()
def simulate(
    context: typer.Context,
    controller: Controller = "ADRC",
    gait: Gait = "published",
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
    push: Pushes = None,
    impacts: Impacts = 25,
    period: Period = None,
    torque_limit: TorqueLimit = None,
    poles: Poles = None,
    bandwidth: Bandwidth = None,
    order: Order = 1,
    reset: Reset = "model",
    as_printed: AsPrinted = False,
    friction: Friction = False,
    method: Method = None,
    step: StepSize = None,
    engine: Engine = "pinocchio",
    friction_limit: FrictionLimit = None,
    force_window: ForceWindow = 5e-3,
    end_illegal: EndIllegal = False,
    out: Out = None,
) -> None:
    """Walk, and print what each step needed of the ground and of the motors."""
    from biped_adrc.model.limits import Limits
    from biped_adrc.model.robots import load_description
    from biped_adrc.studies.runs import Run

    limits = Limits(friction_limit, None, force_window)
    description = load_description(robot)
    if not description.actuated:
        simulate_passive(context, robot, preset, impacts, limits, out)
        return
    extra: dict[str, Any] = {}
    if poles is not None:
        extra["poles"] = _numbers(poles, "--poles")
    run = Run(
        controller.upper(),
        robot,
        description.preset(preset).name,
        gait=gait,
        pushes=parse_pushes(push),
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
        engine=engine,
        **extra,
    )
    _walk(run, limits, end_illegal, run_path(out, inputs(robot, gait)))


def _walk(run: Run, limits: Limits, end_illegal: bool, out: Path | None) -> None:
    """Carry out a run, print it, and write it where it is asked for."""
    from biped_adrc.engine.choice import COMPILED
    from biped_adrc.studies.runs import execute_fully

    with bar() as shown:
        task = shown.add_task(f"walking, {run.controller}", total=run.impacts)
        full = execute_fully(run, lambda t, n: shown.update(task, completed=n))
        shown.update(task, description="the same at half the step", completed=0)
        finer = replace(run.halved(), engine=COMPILED)
        half = execute_fully(finer, lambda t, n: shown.update(task, completed=n))
    if end_illegal:
        full, half = full.until_illegal(limits), half.until_illegal(limits)
    o = replace(full.outcome, half=half.outcome)
    if out is not None:
        write_run(full, out, {"run": run.record()})  # first, as printing may fail
    _print_steps(o, full.legal_within(limits))
    if "why" in full.trajectory.settings:
        console.print(full.trajectory.settings["why"])
    for remark in full.remarks:
        console.print(f"note: {remark}", markup=False, highlight=False, soft_wrap=True)
    say_written(out)
    if not o.walked:
        raise typer.Exit(EXIT_FELL)


def _print_steps(o: Outcome, legality: Legality) -> None:
    from biped_adrc.analysis.certificate import Certificate, ratio_text
    from biped_adrc.studies.convergence import error_text

    names = ("step", "time [s]", "length [m]", "torque [N m]", "F_N [N]", "friction", "at impact")
    table = Table(*map(escape, names), escape("scuffs [mm]"), "not legal")
    for s in legality.supports:
        c = s if isinstance(s, Certificate) else None
        table.add_row(
            f"{s.step}",
            f"{s.duration:.4f}",
            f"{c.step_length:.4f}" if c else "",
            f"{s.peak_torque:.1f}",
            f"{s.mean_normal_force:.1f}",
            ratio_text(s.mean_friction),
            ratio_text(c.impulse_ratio) if c else "",
            f"{1e3 * s.scuffing:.2g}",
            ", ".join(name.replace("_", " ") for name in s.illegal()),
        )
    console.print(table)
    console.print(
        f"F_N and friction: least and largest mean over {1e3 * legality.limits.window:g} ms; "
        f"{_instants(legality)}\n"
        f"{o.status}: {o.message}\n{o.impacts} impacts, largest tracking error {error_text(o)}, "
        f"peak torque {o.peak_torque:.1f} N m, {o.method}, engine {o.engine}\n{legality.text()}"
    )
    stays = [c.step for c in o.certificates if not c.old_foot_velocity > 0.0]
    if stays:
        console.print(f"the old stance foot does not lift off after steps {stays}")


def _instants(needed: Legality | Certificate) -> str:
    """What no mean hides."""
    return (
        f"at an instant F_N is {needed.least_normal_force:.1f} N at least, and the force is outside the "
        f"friction cone for {100.0 * needed.share_outside:.2g} % of the time"
    )


def _nominal(c: Certificate) -> str:
    """What the step of a cycle needs, in a line."""
    from biped_adrc.analysis.certificate import ratio_text

    missed = "; ".join(c.illegal().values())
    return (
        f"its step: {c.step_length:.4f} m in {c.duration:.4f} s, peak torque {c.peak_torque:.1f} N m; in the "
        f"mean of {1e3 * c.window:g} ms friction {ratio_text(c.mean_friction)}, "
        f"F_N {c.mean_normal_force:.1f} N; {_instants(c)}; the swing foot scuffs by {1e3 * c.scuffing:.2g} mm; "
        f"friction at impact {ratio_text(c.impulse_ratio)}, limit {c.friction_limit:g}; "
        f"{'not legal: ' + missed if missed else 'legal'}"
    )


def _numbers(text: str, what: str) -> tuple[float, ...]:
    try:
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise InputError(f"{what} is '{text}', expected numbers separated by commas") from None


@app.command()
def poincare(
    robot: Robot = "rabbit",
    preset: RobotPreset = None,
    gait: Annotated[
        str, typer.Option(help="A stored gait by name, or a .json file.")
    ] = "published",
    controller: Annotated[
        str | None, typer.Option(help="NPD (default) or ADRC; passive for robots without motors.")
    ] = None,
    slope: Annotated[
        float | None, typer.Option(help="Of the ground [rad], positive downhill.")
    ] = None,
    observer_states: Annotated[
        bool, typer.Option(help="Count the observer's states among the coordinates.")
    ] = True,
    samples: Annotated[
        int, typer.Option(help="Impacts of the walk for the paper's regression; 0 leaves it out.")
    ] = 25,
) -> None:
    """Fixed point of the return map, and its multipliers by every method beside each other."""
    from biped_adrc.studies.cycle_stability import (
        PASSIVE,
        cycle_stability,
        find_cycle,
        nominal_step,
    )

    known = {"npd": "NPD", "adrc": "ADRC", PASSIVE: PASSIVE}
    name = None if controller is None else known.get(controller.lower(), controller)
    cycle = find_cycle(robot, preset, gait, name, observer_states, slope)
    with console.status("Newton on the return map"):
        found = cycle_stability(cycle, samples)
    walker, o = cycle.P.walker, found.orbit
    law = type(walker.controller).__name__.removesuffix("Controller")
    lines = (
        f"{robot}, {walker.plant.preset}, {law}, slope {walker.slope:g} rad, {cycle.P.method.label}",
        "x- = " + " ".join(f"{value:.6f}" for value in o.x_minus[: 2 * walker.plant.n]),
        _nominal(nominal_step(cycle, o)),
        f"residual {o.residual:.1e}; |lambda| by every method:",
        found.table.text(),
    )
    console.print("\n".join(lines), markup=False, highlight=False, soft_wrap=True)
