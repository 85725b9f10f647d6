"""What an idea costs: the files of the commit that added each leaf of the registry, from git's history.

    python benchmarks/ideas.py [NAME ...]

A leaf is a line of scenario/registry.toml; a commit that added several leaves, or moved them, is named beside.
"""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def git(*arguments: str) -> list[str]:
    """Lines that git prints."""
    command = ["git", "-C", str(ROOT), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")


def leaves() -> dict[str, Path]:
    """Name -> file of every line of the registry."""
    path = ROOT / "biped_adrc" / "scenario" / "registry.toml"
    registry = tomllib.loads(path.read_text(encoding="utf-8"))
    return {
        f"{kind} {name}": Path(entry["home"].partition(":")[0].replace(".", "/") + ".py")
        for kind, entries in registry.items()
        for name, entry in entries.items()
    }


def adding(path: Path) -> tuple[str, list[str]]:
    """The commit that added a file, with its subject, and the files of that commit."""
    found = [
        line for line in git("log", "--diff-filter=A", "--format=%h %s", "--", str(path)) if line
    ]
    if not found:
        return "not committed", []
    commit = found[-1].partition(" ")[0]
    return found[-1], [line for line in git("show", "--format=", "--name-only", commit) if line]


def main(names: list[str]) -> None:
    """Print the table."""
    for name, path in leaves().items():
        if names and not any(asked.casefold() in name.casefold() for asked in names):
            continue
        commit, files = adding(path)
        print(f"{name:28} {len(files):4} files  {commit[:90]}")
        for file in files if names else ():
            print(f"{'':33}{file}")


if __name__ == "__main__":
    main(sys.argv[1:])
