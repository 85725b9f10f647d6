"""Words and numbers of the page of a tuning study, from its summary."""

from __future__ import annotations

from collections.abc import Sequence

from biped_adrc.types import PlainRecord


def held_out_texts(row: PlainRecord) -> list[str]:
    """The cells of a measure on the test set: its words, chosen, as published, ratio of the two."""
    ratio = row["ratio"]
    told = [row["words"], interval_text(row["chosen"]), interval_text(row["published"])]
    return [*told, "–" if ratio is None else interval_text(ratio)]


def candidate_texts(c: PlainRecord) -> list[str]:
    """The cells of a candidate: number, setting, objectives, and whether it keeps the limits."""
    setting = ", ".join(f"{name} = {number_text(x)}" for name, x in c["chosen"].items())
    missed = sum(x > 0.0 for x in c["excess"])
    kept = "kept" if not missed else f"{missed} missed"
    name = "as published" if c["number"] == 0 else str(c["number"])
    objectives = [number_text(x) if c["walked"] else "–" for x in c["objectives"]]
    return [name, setting, *objectives, kept if c["walked"] else f"{kept}, not walked"]


def interval_text(x: PlainRecord | Sequence[float | str]) -> str:
    """A number with its interval: "0.012 (0.011 to 0.013)"; a single number where both ends are it."""
    value, low, high = (number_text(v) for v in (x.values() if isinstance(x, dict) else x))
    return value if low == value == high else f"{value} ({low} to {high})"


def number_text(x: object) -> str:
    """A number with four digits; other values as they are."""
    return f"{x:.4g}" if isinstance(x, float) else "none" if x is None else str(x)
