"""Sizes of the project beside their goals, a column for each git revision or of the working tree.

Code lines have no docstring, comment or blank; imports and the texts below fields count. Lines of a room
have docstrings. Words of docs: no notebooks, no api. Data: no gifs. A goal that is missed has its reason."""

import argparse
import ast
import re
import sys
import tempfile
import tomllib
from collections import Counter
from io import StringIO
from pathlib import Path
from subprocess import check_output, run
from tokenize import COMMENT, generate_tokens

ROOT = Path(__file__).resolve().parents[1]
git = lambda *words: check_output(["git", *words], cwd=ROOT)  # noqa: E731
COMMANDS = """
from typer.main import get_command
from biped_adrc.cli import app
def leaves(c): return sum(map(leaves, c.commands.values()), []) if hasattr(c, "commands") else [c]
print(len(x := leaves(get_command(app))), sum(p.param_type_name == "option" for c in x for p in c.params))
"""
GOALS = {
    "code lines of the package": (
        29_900,
        "imports and texts below fields are 5 300 of them; the rest are features that stay",
    ),
    "modules": (
        265,
        "an idea of control, observers, hardware, gait or view is one file, and a folder has an __init__",
    ),
    "rooms": (18, "17 folders, and __init__.py, __init__.pyi, __main__.py and py.typed"),
    "code lines of tests": (
        16_500,
        "each error, law and feature has its proof, and of faults at random nine in ten are noticed",
    ),
    "... of benchmarks and validation": (
        2_700,
        "searches, six questions and eleven findings are made by code, and three more publications are walked",
    ),
    "... of scripts in docs": (500, "the API as text, the notebook, and README's sampled headline"),
    "leaf commands": (18, ""),
    "options": (113, ""),
    "make targets": (11, ""),
    "extras": (7, ""),
    "dependencies": (14, "platformdirs came in place of code for folders of the user's"),
    "public names": (86, ""),
    "words of README": (600, ""),
    "words of docs": (32_000, ""),
    "data in docs [MB]": (2.0, ""),
    "raise statements": (460, "each names a mistake of a user's and is proved by a test"),
    "lines of control": (2_750, "PID as flown and ADRC with b_0 alone came for the comparison"),
    "... of hardware": (900, ""),
    "... of closed_loop": (1_800, "a signal of a sample instant has its text beside it"),
    "names in several modules": (40, "29 are the march's twins, in Python and compiled"),
}
"""The most that each should be, and why it is more where it is."""
DOCUMENTED = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def code_lines(text):
    """Of one module."""
    nodes = [x for x in ast.walk(ast.parse(text)) if isinstance(x, DOCUMENTED)]
    docs = [x.body[0] for x in nodes if ast.get_docstring(x) is not None]
    other = {i for x in docs for i in range(x.lineno, x.end_lineno + 1)}
    comments = [t for t in generate_tokens(StringIO(text).readline) if t.type == COMMENT]
    other |= {t.start[0] for t in comments if t.line.lstrip()[0] == "#"}
    return len({i for i, line in enumerate(text.splitlines(), 1) if line.strip()} - other)


def defined(tree):
    """Public names that a module defines."""
    for node in tree.body:
        targets = getattr(node, "targets", [getattr(node, "target", node)])
        for name in (getattr(x, "id", getattr(x, "name", "_")) for x in targets):
            if not name.startswith("_"):
                yield name


def sizes(root, listed):
    """By measure, of the files below `root` that git has listed."""
    paths = [p for p in map(Path, listed.decode().split()) if (root / p).is_file()]
    texts = {p: (root / p).read_text() for p in paths if p.suffix in (".py", ".md", ".pyi")}
    package = [p for p in texts if p.suffix == ".py" and p.parts[0] == "biped_adrc"]
    code, docs = Counter(), [p for p in paths if p.parts[0] == "docs"]
    for p in texts:
        code[p.parts[0]] += code_lines(texts[p]) if p.suffix == ".py" else 0
    project = tomllib.loads((root / "pyproject.toml").read_text())["project"]
    targets = re.search(r"^\.PHONY:(.*)$", (root / "Makefile").read_text(), re.M)[1]
    made = run([sys.executable, "-c", COMMANDS], cwd=root, capture_output=True, text=True)
    commands, options = map(int, made.stdout.split() or (0, 0))
    pages = [p for p in docs if p.suffix == ".md" and p.parts[1] not in ("api", "notebooks")]
    data = sum((root / p).stat().st_size for p in docs if p.suffix not in (".py", ".md", ".gif"))
    trees = {p: ast.parse(texts[p]) for p in package}
    nodes = [x for tree in trees.values() for x in ast.walk(tree)]
    names = Counter(x for tree in trees.values() for x in set(defined(tree)))
    lines = Counter()
    for p in package:
        lines[p.parts[1]] += sum(bool(x.strip()) for x in texts[p].splitlines())
    return {
        "code lines of the package": code["biped_adrc"],
        "modules": len(package),
        "rooms": len({p.parts[1] for p in paths if p.parts[0] == "biped_adrc"}),
        "code lines of tests": code["tests"],
        "... of benchmarks and validation": code["benchmarks"] + code["validation"],
        "... of scripts in docs": code["docs"],
        "leaf commands": commands,
        "options": options,
        "make targets": len(targets.split()),
        "extras": len(project["optional-dependencies"]),
        "dependencies": len(project["dependencies"]),
        "public names": texts[Path("biped_adrc/__init__.pyi")].count(" import "),
        "words of README": len(texts[Path("README.md")].split()),
        "words of docs": sum(len(texts[p].split()) for p in pages),
        "data in docs [MB]": round(1e-6 * data, 1),
        "raise statements": sum(isinstance(x, ast.Raise) for x in nodes),
        "lines of control": lines["control"],
        "... of hardware": lines["hardware"],
        "... of closed_loop": lines["closed_loop"],
        "names in several modules": sum(count > 1 for count in names.values()),
    }


parser, columns = argparse.ArgumentParser(description=__doc__), {}
parser.add_argument("revisions", nargs="*", metavar="REV")
for rev in parser.parse_args().revisions:
    with tempfile.TemporaryDirectory() as folder:
        run(["tar", "-x", "-C", folder], input=git("archive", rev), check=True)
        columns[rev] = sizes(Path(folder), git("ls-tree", "-r", "--name-only", rev))
if not columns:
    columns["now"] = sizes(ROOT, git("ls-files", "-co", "--exclude-standard"))
for row, (goal, reason) in GOALS.items():
    values = [column[row] for column in columns.values()]
    print(f"{row:33}{goal:>9}", *(f"{x!s:>9}" for x in values), reason if values[-1] > goal else "")
