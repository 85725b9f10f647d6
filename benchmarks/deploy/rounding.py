"""The tables of docs/guide/robot.md: exported controllers beside Python, what rounding does, what a tick costs.

Run: python benchmarks/deploy/rounding.py

Each row is one controller on RABBIT's published gait at 1 kHz, two steps. It walks under a push for the
proof, undisturbed for the ripple. Times are of this machine.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from pathlib import Path

import biped_adrc as ba
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.loaded import FLAGS, Loaded, compiled
from biped_adrc.deploy.records import recorded
from biped_adrc.deploy.ripple import ripple
from biped_adrc.deploy.rounding import proof
from biped_adrc.deploy.source import Source, source_of
from biped_adrc.scenario.build import RobotAndGait, build, start

PAGE = Path(__file__).resolve().parents[2] / "docs" / "guide" / "robot.md"
PUSH = "q1,q2=20@1:0.1-0.3"
CASES = {
    "PD": ba.Scenario("PD", hardware="ideal", impacts=2),
    "NPD": ba.Scenario("NPD", hardware="ideal", impacts=2),
    "NPID": ba.Scenario("NPID", hardware="ideal", impacts=2),
    "super twisting": ba.Scenario("super twisting", hardware="ideal", impacts=2),
    "ADRC, Table I": ba.Scenario("ADRC", hardware="ideal", impacts=2),
    "ADRC output, Table I": ba.Scenario("ADRC output", hardware="ideal", impacts=2),
    "LESO, 160 rad/s": ba.Scenario("LESO", hardware="ideal", impacts=2, bandwidth=160.0),
    "LESO, 500 rad/s": ba.Scenario("LESO", hardware="ideal", impacts=2),
    "ADRC output, m = 1, 160 rad/s": ba.Scenario(
        "ADRC output", hardware="ideal", impacts=2, bandwidth=160.0, order=1
    ),
    "ADRC assisted, 160 rad/s": ba.Scenario(
        "ADRC assisted", hardware="ideal", impacts=2, bandwidth=160.0
    ),
    "high gain, 0.01 s": ba.Scenario(
        "LESO", hardware="ideal", impacts=2, observer="high gain", own={"epsilon": 0.01}
    ),
    "Kalman": ba.Scenario(
        "LESO",
        hardware="ideal",
        impacts=2,
        observer="Kalman",
        own={"drift": 1e4, "measurement": 1e-4},
    ),
    "DOB, 160 rad/s": ba.Scenario("DOB", hardware="ideal", impacts=2, bandwidth=160.0),
}
"""Rows of the tables."""
HOLDS = 0.01
"""Largest ripple, of the torque's root mean square, with which floats are said to do."""
TICKS = 1_000_000
TIMER = r"""
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "controller.h"
#define TICKS %d
static double took[TICKS];
static int above(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}
static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}
int main(void)
{
  controller_state x, first;
  controller_measurement m = { 0, { %s }, { %s } };
  CONTROLLER_REAL u[CONTROLLER_P];
  int i, bad = controller_init(&first, &m);
  x = first;
  for (i = 0; i < TICKS; ++i) {
    double t;
    x = first;
    t = now();
    bad += controller_step(&x, &m, u);
    took[i] = now() - t;
  }
  qsort(took, TICKS, sizeof *took, above);
  printf("%%g %%g %%g %%d %%d\n", took[TICKS / 2], took[TICKS - TICKS / 1000], took[TICKS - 1],
         (int)sizeof x, bad);
  return 0;
}
"""
HAND = r"""
#include "controller.h"
int controller_init(controller_state *x, const controller_measurement *m)
{
  x->step = 1;
  x->start = m->t;
  return 0;
}
int controller_step(controller_state *x, const controller_measurement *m, double u[4])
{
  int i;
  (void)x;
  for (i = 0; i < 4; ++i) u[i] = -3000.0 * m->q[i] - 250.0 * m->v[i];
  return 0;
}
"""
"""A PD of the joints to a fixed pose, as one writes it by hand."""


def main() -> None:
    """Make all rows and write them into the page."""
    rounding, cost = [], []
    for name, scenario in CASES.items():
        rounded, costs = row(name, scenario)
        rounding.append(rounded)
        cost.append(costs)
    cost.append(["PD of the joints, by hand", "12", "0", *timed(None, CASES["NPD"])])
    text = PAGE.read_text()
    text = filled(text, "rounding", ROUNDING, rounding)
    PAGE.write_text(filled(text, "ticks", COSTS, cost))


ROUNDING = (
    "controller",
    "one ulp, double [N m]",
    "C - Python [N m]",
    "ripple in double: predicted",
    "measured [N m]",
    "in float: predicted",
    "measured [N m]",
    "float",
)
COSTS = (
    "controller",
    "operations",
    "in double always",
    "median [us]",
    "99.9 % [us]",
    "worst [us]",
    "state [bytes]",
    "code [bytes]",
)


def row(name: str, scenario: ba.Scenario) -> tuple[list[str], list[str]]:
    """The cells of a controller in both tables."""
    walk = ba.walk_scenario(ba.Scenario(**{"pushes": PUSH, **scenario.record()}))
    computer = Computer(walk.walker)
    source = source_of(computer)
    found = proof(computer, Loaded(source), recorded(walk.walker, walk.trajectory))
    r = ripple(build(scenario), start(scenario, RobotAndGait.of(scenario)))
    print(name, found, r, flush=True)
    holds = r.same_status and r.single < HOLDS * r.torque
    numbers = (
        found.amplification,
        found.difference,
        r.predicted_double,
        r.double,
        r.predicted_single,
        r.single,
    )
    said = "holds" if holds else f"does not hold: {r.single / r.torque:.0%} of the torque"
    step = source.written["step"]
    costs = [name, str(step.operations), str(step.doubles), *timed(source, scenario)]
    return [name, *(f"{x:.1e}" for x in numbers), said], costs


def timed(source: Source | None, scenario: ba.Scenario) -> list[str]:
    """Median, 99.9 % and worst time of step [us], bytes of state and of code; None: the one by hand."""
    q, v = start(scenario, RobotAndGait.of(scenario))
    made = source or source_of(Computer(build(scenario)))
    files = dict(made.files)
    if source is None:
        files["controller.c"] = HAND
    files["timer.c"] = TIMER % (TICKS, *(", ".join(map(repr, x.tolist())) for x in (q, v)))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in files.items():
            (folder / file).write_text(text)
        compiled(folder, ["timer.c", "controller.c"], folder / "timer", FLAGS)
        compiled(folder, ["controller.c"], folder / "controller.o", (*FLAGS, "-c"))
        printed = subprocess.run([folder / "timer"], capture_output=True, text=True, check=True)
        size = subprocess.run(
            ["size", folder / "controller.o"], capture_output=True, text=True, check=True
        )
    median, late, worst, state, bad = printed.stdout.split()
    assert bad == "0", printed.stdout
    times = [f"{float(x) / 1e3:.2f}" for x in (median, late, worst)]
    return [*times, state, size.stdout.splitlines()[1].split()[0]]


def filled(
    text: str, name: str, header: tuple[str, ...], rows: list[list[str]], by: str = "rounding"
) -> str:
    """The page with a table between its marks, which say by which script it is."""
    lines = [header, ("---",) * len(header), *rows]
    table = "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
    begin, end = (
        f"<!-- {name}: made by benchmarks/deploy/{by}.py -->",
        f"<!-- end of {name} -->",
    )
    found = re.sub(
        f"{re.escape(begin)}.*{re.escape(end)}", f"{begin}\n{table}\n\n{end}", text, flags=re.S
    )
    assert found != text or table in text, f"{PAGE} has no place for the table {name}"
    return found


if __name__ == "__main__":
    main()
