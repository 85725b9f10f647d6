"""Help of every command, and what calls print, return and write. Times, folders and versions are made alike."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from tests.photograph import files
from tests.photograph.adapter import commands as adapter
from tests.photograph.calls import CHAINS, STUDY, WRONG_STUDY, Call

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PLAIN = {"NO_COLOR": "1", "COLUMNS": "100", "TERM": "dumb", "TZ": "UTC", "LC_ALL": "C.UTF-8"}
SUMMARY = "summary.json"
ALIKE = (
    (re.compile(r"\d+:\d\d:\d\d"), "<clock>"),
    (re.compile(r"designed in [\d.]+ s"), "designed in <seconds> s"),
    (re.compile(r"(?m)^.*\d+/(?:\d+|\?) <clock>.*$"), "<progress>"),
    (re.compile(r"(?m)^(│ \d\.\d{3} │ \d\.\d{3} │.*│) +[\d.]+ +│$"), r"\1 <seconds> │"),
    (re.compile(r"It took \d+ s"), "It took <seconds> s"),
    (re.compile(r"Time by task .*"), "Time by task <seconds>"),
    (re.compile(r"Linux-\S+"), "<platform>"),
    (re.compile(r"(source of biped-adrc\W+)[0-9a-f]{12}"), r"\1<hash>"),
    (re.compile(r"[ \t]+(?=\n|$)"), ""),
)

Plain = dict[str, Any]


def environment() -> dict[str, str]:
    """That of a call."""
    kept = {k: x for k, x in os.environ.items() if k not in ("FORCE_COLOR", "PYTHONWARNINGS")}
    path = os.pathsep.join((str(ROOT), *filter(None, [kept.get("PYTHONPATH")])))
    return {**kept, **PLAIN, "PYTHONPATH": path}


def started(arguments: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    """A call, to its end."""
    return subprocess.run(
        [*adapter.PROGRAM, *arguments],
        cwd=folder,
        env=environment(),
        capture_output=True,
        text=True,
        timeout=900,
        check=False,
        stdin=subprocess.DEVNULL,
    )


def cleaner(folder: Path) -> Any:
    """Makes a text of this folder the same in every run."""

    def clean(text: str) -> str:
        text = text.replace(str(folder), "<folder>").replace(str(ROOT), "<root>")
        for pattern, word in ALIKE:
            text = pattern.sub(word, text)
        return text

    return clean


def help_texts() -> dict[str, str]:
    """In full, by command."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for words in adapter.tree():
            done = started([*words, "--help"], Path(folder))
            found[" ".join(words) or "(itself)"] = cleaner(Path(folder))(done.stdout)
    return found


def prepared(folder: Path) -> None:
    """The files that are there from the beginning."""
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    (folder / "wrong.toml").write_text(WRONG_STUDY, encoding="utf-8")
    shutil.copy(HERE / "data" / "scout.urdf", folder)


def chain(name: str) -> Plain:
    """The calls of a chain by name; the reproduction's summary is beside, under its own name."""
    with tempfile.TemporaryDirectory(prefix="photograph") as place:
        folder = Path(place).resolve()
        prepared(folder)
        seen = stamps(folder)
        found: Plain = {}
        for call in CHAINS[name]:
            found[f"{name}/{call.name}"] = called(call, folder, seen)
            seen = stamps(folder)
    return found


def called(call: Call, folder: Path, seen: dict[str, tuple[int, int]]) -> Plain:
    """What one call leaves."""
    done, clean = started(shlex.split(call.text), folder), cleaner(folder)
    new = [path for path, stamp in stamps(folder).items() if seen.get(path) != stamp]
    record: Plain = {
        "arguments": call.text,
        "exit": done.returncode,
        "stdout": clean(done.stdout),
        "stderr": clean(done.stderr),
        "files": {path: files.content(folder / path, clean) for path in new if not _own(path)},
    }
    for path in new:
        if path.endswith(f"out/{SUMMARY}"):
            record[SUMMARY] = files.stable(
                json.loads((folder / path).read_text(encoding="utf-8")), clean
            )
            record["files"][path] = "in full in the summary of the photograph"
    return record


def stamps(folder: Path) -> dict[str, tuple[int, int]]:
    """Files below a folder, with what shows that one has changed."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            stat = path.stat()
            found[path.relative_to(folder).as_posix()] = (stat.st_mtime_ns, stat.st_size)
    return found


def _own(path: str) -> bool:
    """Whether a file is the database's own, and gone with the process."""
    return path.endswith(("-wal", "-shm", "-journal"))
