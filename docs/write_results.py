"""Write docs/results.md and the findings in README.md from the summary of a reproduction.

Run: python docs/write_results.py OUT [--check]

OUT: folder of `biped-adrc reproduce`, or docs/results. --check: write nothing, and fail if a file would change.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from biped_adrc.errors import InputError
from biped_adrc.files import write_text
from biped_adrc.viz.pages import CLAIM_COLUMNS, KINDS, captions, plain

ROOT = Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- results: begin -->", "<!-- results: end -->"
SHOWN = ("figure1", "figure4", "figure5", "figure6", "comparison", "disturbance")
"""Figures of the page of results; the others are in the report."""


LEFT_OUT = ("push_map", "nominal", "convergence", "seconds")
"""Of the summary, what no page shows; the rest is kept in docs/results/summary.json."""


def cell(value: Any) -> str:
    """A value inside a table of Markdown."""
    text = plain(value).replace("\\", "\\\\").replace("|", "\\|").replace("\n", " ")
    for character in "*_<$`[":
        text = text.replace(character, f"\\{character}")
    return text


def table(columns: list[str], rows: list[list[Any]]) -> str:
    """A table of Markdown."""
    lines = ["| " + " | ".join(cell(c) for c in columns) + " |", "|---" * len(columns) + "|"]
    return "\n".join([*lines, *("| " + " | ".join(cell(v) for v in row) + " |" for row in rows)])


def results(summary: dict[str, Any]) -> str:
    """The page."""
    checks = summary["checks"]
    held = sum(check["holds"] for check in checks)
    parts = [
        "# Results of the reproduction",
        f"Written by `python docs/write_results.py` from the run of `{summary['command']}`, preset "
        f"`{summary['preset']}`, {summary['wall_time_s']:.0f} s. **{held} of {len(checks)} checks hold.**",
        bullets(summary["findings"]),
        "## The claims of the paper",
        cell(summary["claims_preface"]),
        "\n".join(f"- **{word}**: {cell(m)}" for word, m in summary["claims_words"].items()),
        table(list(CLAIM_COLUMNS), [[c[key] for key in CLAIM_COLUMNS] for c in summary["claims"]]),
        "## Figures",
        *(figure(name) for name in SHOWN),
        "## Checks",
        *(part for kind in KINDS for part in kind_of_checks(kind, checks)),
        "## Tables",
        *(
            f"### {title}\n\n{table(found['columns'], found['rows'])}"
            for title, found in summary["tables"].items()
        ),
        "## Notes",
        bullets(summary["notes"]),
        "## Versions",
        table(["part", "version"], [[k, v] for k, v in summary["versions"].items()]),
    ]
    if summary["left_out"]:
        parts.insert(2, f"Left out of this run: {'; '.join(summary['left_out'])}.")
    return "\n\n".join(parts) + "\n"


def bullets(items: list[str]) -> str:
    """A list of Markdown."""
    return "\n".join(f"- {cell(item)}" for item in items)


def figure(name: str) -> str:
    """A figure with what to look for in it."""
    title, caption = captions("report")[name]
    return f"### {title}\n\n![{title}](results/{name}.svg)\n\n{caption}"


def kind_of_checks(kind: str, checks: list[dict[str, Any]]) -> list[str]:
    """The checks of one kind."""
    rows = [
        [c["name"], c["value"], c["limit"], "holds" if c["holds"] else "does not hold"]
        for c in checks
        if c["kind"] == kind
    ]
    head = f"### {kind.capitalize()}: {KINDS[kind]}"
    return [f"{head}\n\n{table(['check', 'value', 'limit', 'verdict'], rows)}"] if rows else []


def with_findings(readme: str, summary: dict[str, Any]) -> str:
    """README.md with the findings between its markers. Raises InputError without markers."""
    if readme.count(BEGIN) != 1 or readme.count(END) != 1:
        raise InputError(f"README.md needs one line '{BEGIN}' and, below it, one line '{END}'")
    before, rest = readme.split(BEGIN)
    return f"{before}{BEGIN}\n{bullets(summary['findings'])}\n{END}{rest.split(END)[1]}"


def files(out: Path, root: Path = ROOT) -> dict[Path, str]:
    """Path -> text of everything this script writes."""
    source = out / "summary.json"
    if not source.is_file():
        raise InputError(f"'{source}' is not there; run 'make reproduce' first")
    summary = json.loads(source.read_text(encoding="utf-8"))
    texts = {
        root / "docs" / "results.md": results(summary),
        root / "README.md": with_findings(
            (root / "README.md").read_text(encoding="utf-8"), summary
        ),
    }
    kept = {key: value for key, value in summary.items() if key not in LEFT_OUT}
    texts[root / "docs" / "results" / "summary.json"] = json.dumps(kept, indent=1) + "\n"
    for name in [f"{name}{suffix}" for name in SHOWN for suffix in (".svg", ".json")]:
        text = (out / name).read_text(encoding="utf-8")
        texts[root / "docs" / "results" / name] = text
    return texts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path, help="folder of 'biped-adrc reproduce'")
    parser.add_argument("--check", action="store_true", help="fail if a file would change")
    arguments = parser.parse_args()
    try:
        texts = files(arguments.out)
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    old = [p for p, t in texts.items() if not p.is_file() or p.read_text(encoding="utf-8") != t]
    if arguments.check:
        for path in old:
            print(f"would change: {path.relative_to(ROOT)}")
        return int(bool(old))
    for path, text in texts.items():
        write_text(path, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
