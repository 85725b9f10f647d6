"""The picture of docs/architecture.md: rooms of the package in layers, as the import contract has them.

Run: python docs/draw_architecture.py
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from diagrams import BLUE, GREY, INK, ORANGE, Diagram

ROOT = Path(__file__).resolve().parents[1]
LEAVES = {"control", "hardware", "observers", "disturbances", "gait"}
"""Where a research idea is one file."""
PAGE = Path(__file__).resolve().parent / "architecture.md"
WORDS = dict(re.findall(r"^- \*\*(\w+)\*\*: (.+?)\.", PAGE.read_text("utf-8"), re.MULTILINE))
"""What a room is for: the first sentence of its paragraph on the page."""


def layers() -> list[list[str]]:
    """Rooms from top to bottom, those beside each other in one list."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    contract = tomllib.loads(text)["tool"]["importlinter"]["contracts"][0]
    rows = ([name.strip() for name in layer.split("|")] for layer in contract["layers"])
    return [[name.rpartition(".")[2] for name in row] for row in rows]


def main() -> None:
    """Draw it."""
    rows = layers()
    high, wide = 2.8, 40.0
    d = Diagram(wide, high * len(rows) + 1.2)
    for i, row in enumerate(rows):
        y = high * (len(rows) - i) - 1.4
        for j, name in enumerate(row):
            x = wide / 2 + (j - (len(row) - 1) / 2) * 12.4
            d.box(x, y, 11.6, 2.0, "", ORANGE if name in LEAVES else BLUE)
            d.text(x, y + 0.4, name)
            d.text(x, y - 0.5, WORDS[name], GREY, 8)
        if i:
            d.arrow((wide / 2, y + high - 1.0), (wide / 2, y + 1.02), colour=GREY)
    d.text(
        wide - 0.4,
        high * len(rows) + 0.6,
        "a room may import what lies below it; orange: an idea is one file",
        INK,
        9,
        ha="right",
    )
    d.save("architecture.svg")


if __name__ == "__main__":
    main()
