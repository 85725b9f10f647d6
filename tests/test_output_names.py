"""What a command writes: the name that was given, or a refusal; never a file that it reads.

`folder` is the current folder, with a gait, a link to it, a run, and a robot of one's own. `command` runs a
command in this process; `WALK` is a walk of one step.
"""

from __future__ import annotations

import io
import os
import re
import shutil
from contextlib import suppress
from pathlib import Path

import pytest
from rich.table import Table

import biped_adrc as ba
from biped_adrc.cli import main
from biped_adrc.cli.app import Terminal
from biped_adrc.core.errors import InputError, OutputError
from biped_adrc.core.files import data_folder, one_line, output_path, write_text
from biped_adrc.hybrid.storage import load, save

from .commands import command

WALK = ("simulate", "--engine", "compiled", "--controller", "NPD", "--impacts", "1")


@pytest.fixture(scope="session")
def walked(gait, biped):
    """The trajectory of a walk of one step."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    return ba.walk(walker, gait, impacts=1, engine="compiled").trajectory


@pytest.fixture
def folder(tmp_path, monkeypatch, gait, walked):
    """Here: a gait, a link to it, a run, and a robot of one's own with its gait."""
    monkeypatch.chdir(tmp_path)
    gait.save("keep.json")
    Path("link.json").symlink_to("keep.json")
    save(walked, "run.npz")
    Path("run.html").write_bytes(Path("run.npz").read_bytes())
    shutil.copytree(data_folder("urdf") / "rabbit", "own")
    return tmp_path


def contents(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize(
    ("line", "names"),
    [
        ("gait export keep.json -o keep.json", ["keep.json"]),
        ("gait import keep.json -o link.json", ["link.json", "keep.json"]),
        ("animate run.html -o run.html", ["run.html"]),  # a stored run, called like a page
        ("gait show keep.json --plot keep.json", ["keep.json", ".png or .svg"]),
        ("robot new own/floating.urdf -o own", ["own/floating.urdf", "exist already"]),
    ],
)
def test_nothing_that_is_read_is_overwritten(line, names, folder, monkeypatch):
    """Each line would write over its own input, also by a link or by its plot. It is refused before a walk is
    made, and every file has the bytes it had."""
    # one more file that has to keep its bytes
    shutil.copy("keep.json", "published-identified.json")
    before = contents(folder)
    walk = "biped_adrc.scenario.walk.in_parts"
    monkeypatch.setattr(walk, lambda *_, **__: pytest.fail("walked before the name was looked at"))
    with pytest.raises((InputError, OutputError)) as error:
        command(*line.split())
    message = str(error.value)
    assert all(name in message for name in names), message
    assert contents(folder) == before


@pytest.mark.parametrize(
    ("out", "written"),
    [("push_0.1", "push_0.1.npz"), ("a.b/push 2", "a.b/push 2.npz"), ("push.mat", "push.mat")],
)
def test_a_run_goes_where_it_is_said_to_be(out, written, folder):
    """A name without one of the known suffixes gets .npz, as ".1" is no suffix; one file is new and none
    beside it."""
    assert f"written to {written}\n" in command(*WALK, "-o", out)
    new = {str(path.relative_to(folder)) for path in contents(folder)}
    old = {"keep.json", "link.json", "run.npz", "run.html"}
    assert {name for name in new if not name.startswith("own/")} - old == {written}


def test_a_reader_of_the_old_file_is_not_disturbed(tmp_path):
    """A file is replaced by another one: whoever has it open reads the old one to its end."""
    path = tmp_path / "a.json"
    write_text(path, "old" * 100_000)
    with path.open() as reader:
        assert reader.read(3) == "old"
        write_text(path, "new")
        assert reader.read() == "old" * 99_999
    assert path.read_text() == "new"
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


def test_a_link_a_pipe_and_a_device_stay_what_they_are(folder):
    """A file is replaced by renaming another one onto it, which would turn a link, a pipe or /dev/full into a
    plain file."""
    os.mkfifo("pipe.npz")
    Path("dangling.npz").symlink_to("nowhere.npz")
    Path("full.npz").symlink_to("/dev/full")
    for name, found in (
        ("link.json", "a link"),
        ("dangling.npz", "a link"),
        ("pipe.npz", "not a regular"),
    ):
        kind = Path(name).lstat().st_mode
        with pytest.raises(OutputError, match=f"'{name}' is {found}"):
            write_text(Path(name), "taken")
        assert Path(name).lstat().st_mode == kind
    with pytest.raises(OutputError, match=r"'link\.json' is a link to 'keep\.json', expected"):
        output_path("link.json", (".json",))
    with pytest.raises(OutputError, match="is a link to '/dev/full'"):
        command(*WALK, "-o", "full.npz")


@pytest.mark.parametrize("broken", ["full", "closed"])
def test_a_result_is_there_though_nothing_can_be_printed(broken, folder, monkeypatch, capfd):
    """`> /dev/full`, where printing fails (exit code 5), and `| head -0`, where nobody reads (0): the walk is
    stored before its result is printed."""
    if broken == "full":
        output = open("/dev/full", "w")  # noqa: SIM115
    else:
        reader, writer = os.pipe()
        os.close(reader)
        output = os.fdopen(writer, "w")
    monkeypatch.setattr("sys.stdout", output)
    monkeypatch.setattr("sys.argv", ["biped-adrc", *WALK, "-o", "kept.npz"])
    with pytest.raises(SystemExit) as stop:
        main()
    assert stop.value.code == (5 if broken == "full" else 0)
    assert load("kept.npz").status.ok
    said = capfd.readouterr().err
    assert ("No space left on device; files that were to be written are complete" in said) == (
        broken == "full"
    )
    monkeypatch.undo()
    with suppress(OSError):
        output.close()


def test_text_of_files_is_no_command_to_the_terminal(monkeypatch):
    """A file may hold text such as "[red]", ":bomb:" or an escape sequence. In a line, and as title, head and
    cell of a table (4 times), it is printed as it stands, with control characters written as \\x1b."""
    text = "a[/b] [red]c :bomb: \x1b]0;title\x07 \x9b31m \u202ed \udcff"
    monkeypatch.setattr("sys.stdout", out := io.StringIO())
    terminal = Terminal()
    table = Table(text, title=text)
    table.add_row(text)
    for shown in (text, table):
        terminal.print(shown, width=200)
    found = out.getvalue()
    assert found.count("a[/b] [red]c :bomb: ") == 4
    assert not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202e\ud800-\udfff]", found)
    assert "\\x1b]0;title" in found
    assert one_line("a\tb\nc é ≥", keep="\n\t") == "a\tb\nc é ≥"
