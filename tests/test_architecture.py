"""The page on architecture says something of every room, and its picture is that of the import contract."""

import importlib.util
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def script():
    """docs/draw_architecture.py as a module."""
    import sys

    sys.path.insert(0, str(ROOT / "docs"))
    try:
        where = ROOT / "docs" / "draw_architecture.py"
        spec = importlib.util.spec_from_file_location("draw_architecture", where)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(ROOT / "docs"))
    return module


def rooms():
    """Folders with modules."""
    found = {p.parent.name for p in (ROOT / "biped_adrc").glob("*/__init__.py")}
    return found | {"validation"}


def test_every_room_is_in_the_contract_and_in_the_list_of_the_page():
    drawn = script()
    layered = {name for row in drawn.layers() for name in row}
    assert layered == rooms() == set(drawn.WORDS)
