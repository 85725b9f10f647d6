"""Install the lowest versions that pyproject.toml allows into a fresh environment, and try what uses them.

    .venv/bin/python benchmarks/lower_bounds.py [FOLDER]

FOLDER is where the environment is made, by default a temporary one that is removed. It prints a table:
package, bound, version that was there; then each command of the smoke set
with its exit code. Exit code 1 where the bounds cannot be installed or a command fails. It needs pip's index.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import time
import tomllib
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXTRAS = ("robots", "control", "tables")
BOUND = re.compile(r"([\w-]+)>=([\d.]+)")
STUDY = """
[study]
name = "smoke"
[fixed]
controller = "NPD"
impacts = 1
[grid]
period = ["1 ms", "2 ms"]
"""
COMMANDS = (
    "simulate --impacts 2 -o walk.npz",
    "simulate --engine pinocchio --controller NPD --impacts 1 -o slow.npz",
    "simulate --controller CLF-QP --impacts 1 -o qp.csv",
    "simulate --robot compass --impacts 1",
    "plot walk.npz -o figure.svg",
    "animate walk.npz -o walk.html",
    "animate walk.npz --to 0.1 -o walk.gif",
    "gait design --speed 0.6 --degree 6 -o designed.json",
    "gait export published -o gait.mat",
    "gait import gait.mat -o back.json",
    "gait zero --plot zero.png",
    "poincare --samples 5",
    "observer -o observer.png",
    "robot list",
    "robot check {urdf}",
    "sweep study.toml --out sweep --export csv --export parquet",
)


def bounds() -> dict[str, str]:
    """The lower bound of each package that the command and these extras need, by name."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    wanted = list(project["dependencies"])
    wanted += [text for extra in EXTRAS for text in project["optional-dependencies"][extra]]
    return dict(match.groups() for text in wanted if (match := BOUND.fullmatch(text)))


def main(folder: Path) -> int:
    """Install, run, and print; the exit code."""
    lowest = bounds()
    venv.create(folder / "env", with_pip=True)
    python = folder / "env" / "bin" / "python"
    pins = [f"{name}=={bound}" for name, bound in lowest.items()]
    pip = [python, "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
    if subprocess.run([*pip, *pins, ROOT], check=False).returncode:
        print("the lower bounds cannot be installed together")
        return 1
    listed = subprocess.run([*pip[:3], "list", "--format", "json"], capture_output=True, check=True)
    found = {one["name"].lower(): one["version"] for one in json.loads(listed.stdout)}
    print(f"Python {sys.version.split()[0]}, {time.strftime('%Y-%m-%d')}\n")
    print("| package | bound | tried |\n|---|---|---|")
    for name, bound in lowest.items():
        print(f"| {name} | {bound} | {found[name.lower()]} |")
    print("\n| command | exit code | seconds |\n|---|---|---|")
    work = folder / "work"
    work.mkdir()
    (work / "study.toml").write_text(STUDY, encoding="utf-8")
    environment = {k: x for k, x in os.environ.items() if k != "PYTHONPATH"}
    environment |= {"BIPED_ADRC_CACHE": str(folder / "cache"), "MPLBACKEND": "agg"}
    failed = 0
    for line in COMMANDS:
        began = time.perf_counter()
        words = line.format(urdf=ROOT / "urdf" / "rabbit" / "floating.urdf").split()
        command = [folder / "env" / "bin" / "biped-adrc", *words]
        done = subprocess.run(
            command, cwd=work, env=environment, capture_output=True, text=True, check=False
        )
        print(
            f"| `{line.format(urdf='RABBIT.urdf')}` | {done.returncode} | {time.perf_counter() - began:.0f} |"
        )
        if done.returncode:
            failed += 1
            print(done.stderr[-2000:], file=sys.stderr)
    return min(failed, 1)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        sys.exit(main(Path(sys.argv[1]).absolute()))
    with tempfile.TemporaryDirectory() as place:
        sys.exit(main(Path(place)))
