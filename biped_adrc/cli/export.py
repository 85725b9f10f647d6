"""`biped-adrc export`: the controller of a scenario as a folder of C files.

The work is that of `extras.export.export`. Where there is a C compiler the files are compiled once, so that
what is printed has been seen; without one they are written all the same, and that is said.
"""

from __future__ import annotations

from pathlib import Path

from biped_adrc.cli.app import app, say
from biped_adrc.cli.options import options, scenario_from

SLOW = 10.0
"""[1/s]; several integrators in a row seem to grow by less than this, from round-off."""


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
    from biped_adrc.extras.export.export import export_c
    from biped_adrc.extras.export.fmu import contents
    from biped_adrc.extras.export.loaded import tried
    from biped_adrc.scenario.build import RobotAndGait, build

    s = scenario_from({}, sets, scenario)
    source = export_c(s, out, prefix, real, fmu)
    step, files = source.written["step"], list(source.files)
    say(
        f"step: {step.operations} operations, {step.doubles} of them in double always; {source.numbers} "
        f"constants; state {', '.join(f'{x.name} {x.size}' for x in source.fields) or 'none'}"
    )
    say(tried(source))
    if fmu:
        files.append(f"{source.prefix}.fmu")
        say(f"{files[-1]}, for co-simulation by FMI 2.0: {contents()}")
    say(f"written to {out}: {', '.join(files)}")
    scene = RobotAndGait.of(s)
    if (growth := Computer(build(s, scene)).growth(*scene.on_orbit)) > SLOW:
        say(
            f"by itself this controller is unstable, its fastest mode grows by {growth:.0f} /s: on a recorded "
            "walk the least difference grows too, so compare it in closed loop"
        )
