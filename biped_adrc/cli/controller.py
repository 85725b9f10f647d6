"""`biped-adrc observer`, `export` and `replay`: commands on a controller that simulate no walk.

`observer` prints the gang of six of a walker's loop (`analysis.loops.gang`), and what a GPI observer asks of
encoders, clock and motors, from the linear loop of one joint (`analysis.observer.report`). `export` writes the
controller of a scenario as C (`extras.export.export`); where there is a C compiler, the files are compiled once
as a trial, and its warnings are printed. `replay` runs the controller of a scenario on a robot's log:
measurements and torques are those of the log, so the controller does not move the robot (`extras.logs.replay`).

`target` checks the name of an output file, which may not be one of the files that the command reads (`inputs`).
FIGURES are the suffixes that figures may have, WALKS the short options on what walks.
A command's docstring is its help text; its arguments are described in options.toml. `values` are values of a
scenario by dotted name, such as "hardware.period", from short options; `sets` are texts NAME=VALUE of --set.
"""

from pathlib import Path
from typing import Any

import biped_adrc as ba
from biped_adrc.cli.app import FIGURES, app, console, inputs, target
from biped_adrc.cli.options import WALKS, assignments, options, scenario_from
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import check_folder, write_text
from biped_adrc.core.types import PlainRecord


@app.command("observer")
@options("observer", *WALKS, "period", "poles", "bandwidth", "order", period="1.5 ms, RABBIT's")
def observer_command(
    values: PlainRecord, sets: list[str] | None = None, out: Path | None = None
) -> None:
    """Say what a controller's loop does at a robot's clock and encoders, and which observer these allow.

    Encoders and clock are RABBIT's if not said otherwise.
    """
    from biped_adrc.analysis.loops.gang import GANG_COLUMNS
    from biped_adrc.analysis.observer.report import observer_report
    from biped_adrc.scenario.build import RobotAndGait
    from biped_adrc.scenario.controllers import controller
    from biped_adrc.scenario.cycle import gang_of

    out = target(out, FIGURES)
    # RABBIT's hardware, unless --set names the hardware as a whole or its profile; options come on top
    if not {"hardware", "hardware.profile"} & assignments(sets).keys():
        values = {"hardware.profile": "rabbit", **values}
    s = scenario_from(values, sets)
    # the period is None in continuous time, counts for exact encoders; a report needs numbers: 1 ms, 8192
    h, scene = s.hardware, RobotAndGait.of(s)
    law: Any = controller(s, scene.walked, scene.biped)  # scene.walked is the gait
    observer: Any = getattr(law, "observer", None)
    # the report is of a loop whose kappa is exact, which a law with a constant b_0 has not
    gpi = isinstance(observer, ba.GPIObserver) and not hasattr(law, "b_0")
    if gpi:
        report = observer_report(
            observer,
            law.gains,
            robot=scene.biped,
            gait=scene.walked,
            period=h.period or 1e-3,
            counts=h.encoders.counts or 8192.0,
            delay=h.delay,
            known=h.delay_known,
        )
        console.say(report.verdict)
        for section in report.sections:
            console.table(section.header, section.rows, title=section.title)
    try:
        spec, gang = gang_of(s, scene)
    except InputError as error:
        if out is not None or not gpi:
            raise
        console.say(f"no loop of the walker: {error}")
        return
    if observer is not None and not gpi:
        console.say(
            f"no verdict on the observer of '{s.controller.name}': it is for GPI and an exact kappa"
        )
    title = f"loop of '{s.controller.name}' on {scene.biped.description.name}"
    console.say(f"{title}: {spec}")
    console.table(
        GANG_COLUMNS, gang.rows(spec), title="Gang of six, of the walker's loop on the gait"
    )
    if out is not None:
        from biped_adrc.view.plots.figures import gang_figure

        console.draw(out, gang_figure(gang, title))


@app.command("export")
@options("export")
def export_command(
    scenario: Path,
    out: Path,
    sets: list[str] | None = None,
    prefix: str = "controller",
    real: str = "float64",
    fmu: bool = False,
) -> None:
    """Write the controller of a scenario as C99 that needs no library, for a robot's computer."""
    from biped_adrc.extras.export.computer import Computer
    from biped_adrc.extras.export.export import contents
    from biped_adrc.extras.export.loaded import tried
    from biped_adrc.scenario.build import RobotAndGait, build

    s = scenario_from({}, sets, scenario)
    source = ba.export_c(s, out, prefix, real, fmu)
    # step: the C function that runs at each sample instant
    step, files = source.written["step"], list(source.files)
    console.say(
        f"step: {step.operations} operations, {step.doubles} of them in double always; {source.numbers} "
        f"constants; state {', '.join(f'{x.name} {x.size}' for x in source.fields) or 'none'}"
    )
    console.say(tried(source))  # compiles the files as a trial
    if fmu:
        files.append(f"{source.prefix}.fmu")
        # contents(): whether the FMU has a binary for this machine, or sources alone
        console.say(f"{files[-1]}, for co-simulation by FMI 2.0: {contents()}")
    console.say(f"written to {out}: {', '.join(files)}")
    # rate [1/s] at which the controller's own state grows while it measures the same q and v at all sample
    # instants, those at the start of the gait (on_orbit)
    scene = RobotAndGait.of(s)
    # several integrators in a row, which do not grow, have computed rates below 10 /s, from round-off
    if (growth := Computer(build(s, scene)).growth(*scene.on_orbit)) > 10.0:
        console.say(
            f"by itself this controller is unstable ({growth:.0f} /s): compare it in closed loop, not on a log"
        )


@app.command("replay")
@options("replay", *WALKS)
def replay_command(
    values: PlainRecord,
    log: Path,
    sets: list[str] | None = None,
    scenario: Path | None = None,
    window: float = 0.02,
    out: Path | None = None,
) -> None:
    """Run a controller and its observer on a robot's log, and print estimates and torques of each step."""
    from biped_adrc.extras.logs.replay import HEADER, cells
    from biped_adrc.view.style import write_figure

    s, paths = scenario_from(values, sets, scenario), list[Path]()
    if out is not None:
        check_folder(out)
        # what the command reads, which none of its outputs may overwrite
        read = (log, *inputs(s.robot.name, s.gait.name))
        names = ("replay.csv", "steps.txt", "replay.svg")
        paths = [target(out / name, (Path(name).suffix,), read) for name in names]
    # window [s]: for so long after a touchdown an estimated disturbance counts as contact, not as a push
    result = ba.replay(log, s, window)
    if paths:
        result.to_csv(paths[0])
        write_text(paths[1], f"{result.text()}\n")
        write_figure(paths[2], result.plot())
    console.table(HEADER, map(cells, result.rows))
    for remark in result.remarks:
        console.say(f"note: {remark}")
    console.written(*paths)
