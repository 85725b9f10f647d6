"""What is recorded of a file: its content where that is small, otherwise what tells two of them apart."""

from __future__ import annotations

import hashlib
import json
import re
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

VOLATILE = frozenset(
    ("versions", "seconds", "wall_time_s", "seconds_writing", "command", "platform", "date")
)
"""Keys and columns that no two runs have in common."""
LONGEST = 60_000
"""Characters of a text that is stored in full."""
TAGS = re.compile(r"<(script|style)\b.*?</\1>|<[^>]*>|data:[\w/+;=,.-]*", re.DOTALL)


def content(path: Path, clean: Any) -> Any:
    """By the kind of file; `clean` makes a text the same in every run."""
    kind = path.suffix.lower()
    reader = READERS.get(kind)
    if reader is None:
        return {"bytes": hashed(path.read_bytes())}
    return reader(path, clean)


def hashed(data: bytes | str) -> str:
    """Its hash."""
    raw = data.encode() if isinstance(data, str) else data
    return hashlib.sha256(raw).hexdigest()[:16]


def text_of(text: str) -> Any:
    """A text in full, or its beginning with its length and hash."""
    if len(text) <= LONGEST:
        return text
    return {"begins": text[:2000], "characters": len(text), "hash": hashed(text)}


def stable(tree: Any, clean: Any = str) -> Any:
    """Without what is volatile, its texts made alike by `clean`."""
    if isinstance(tree, dict):
        return {str(k): stable(x, clean) for k, x in tree.items() if k not in VOLATILE}
    if isinstance(tree, list | tuple):
        return [stable(x, clean) for x in tree]
    return clean(tree) if isinstance(tree, str) else tree


def digest(tree: Any) -> Any:
    """Long lists of numbers by their length, ends, sum and largest value."""
    if isinstance(tree, dict):
        return {k: digest(x) for k, x in tree.items()}
    if isinstance(tree, list):
        if len(tree) > 12 and all(isinstance(x, int | float) for x in tree):
            return array(np.array(tree, dtype=float))
        return [digest(x) for x in tree]
    return text_of(tree) if isinstance(tree, str) else tree


def array(a: Any) -> dict[str, Any]:
    """Shape, and a few numbers that any change would show in."""
    found: dict[str, Any] = {"shape": list(a.shape)}
    if a.dtype.kind in "fiub" and a.size:
        x = np.nan_to_num(np.asarray(a, dtype=float), posinf=0.0, neginf=0.0).ravel()
        weights = np.cos(np.arange(x.size))
        found["numbers"] = [float(v) for v in (x[0], x[-1], np.max(np.abs(x)), weights @ x)]
    elif a.dtype.kind in "US":
        found["text"] = text_of(str(a.tolist()))
    return found


# -- by kind ---------------------------------------------------------------------------------------
def _json(path: Path, clean: Any) -> Any:
    return digest(stable(json.loads(path.read_text(encoding="utf-8")), clean))


def _text(path: Path, clean: Any) -> Any:
    return text_of(clean(path.read_text(encoding="utf-8")))


def _npz(path: Path, clean: Any) -> Any:
    with np.load(path, allow_pickle=False) as data:
        found = {name: data[name] for name in sorted(data.files)}
    meta = found.pop("meta", None)
    arrays = {name: array(a) for name, a in joined(found).items()}
    if meta is None:
        return arrays
    return {"meta": digest(stable(json.loads(str(meta)), clean)), "arrays": arrays}


def joined(arrays: dict[str, Any]) -> dict[str, Any]:
    """Arrays whose names differ by a number, such as those of the arcs of a run, one behind the other."""
    groups: dict[str, list[Any]] = {}
    for name, a in arrays.items():
        groups.setdefault(name.rstrip("0123456789"), []).append(a)
    return {
        name: parts[0] if len(parts) == 1 else np.concatenate([np.ravel(a) for a in parts])
        for name, parts in groups.items()
    }


def _mat(path: Path, clean: Any) -> Any:
    from scipy.io import loadmat

    data = loadmat(path)
    return {name: array(np.asarray(a)) for name, a in sorted(data.items()) if name[:2] != "__"}


def _page(path: Path, clean: Any) -> Any:
    text = TAGS.sub(" ", path.read_text(encoding="utf-8"))
    return text_of(clean(" ".join(text.split())))


def _svg(path: Path, clean: Any) -> Any:
    text = path.read_text(encoding="utf-8")
    words = [clean(word) for word in re.findall(r"<!-- (.*?) -->", text)]
    return {"text": words, "paths": text.count("<path"), "uses": text.count("<use")}


def _picture(path: Path, clean: Any) -> Any:
    from PIL import Image

    with Image.open(path) as image:
        frames = getattr(image, "n_frames", 1)
        pixels = np.asarray(image.convert("RGB"))
    coarse = [float(round(x, 1)) for x in pixels.reshape(-1, 3).mean(axis=0)]
    return {"size": list(pixels.shape[:2]), "frames": frames, "mean": coarse}


def _sqlite(path: Path, clean: Any) -> Any:
    with closing(sqlite3.connect(path)) as base:
        base.row_factory = sqlite3.Row
        names = [r[0] for r in base.execute("select name from sqlite_master where type = 'table'")]
        return {name: _table(base, name, clean) for name in sorted(names)}


def _table(base: sqlite3.Connection, name: str, clean: Any) -> Any:
    rows = [dict(row) for row in base.execute(f"select * from {name}")]
    kept = [{k: _cell(x, clean) for k, x in row.items() if k not in VOLATILE} for row in rows]
    return sorted(kept, key=lambda row: json.dumps(row, sort_keys=True))


def _cell(x: Any, clean: Any) -> Any:
    if isinstance(x, str) and x[:1] in "{[":
        return stable(json.loads(x), clean)
    return {"bytes": len(x)} if isinstance(x, bytes) else clean(x) if isinstance(x, str) else x


READERS = {
    ".json": _json,
    ".npz": _npz,
    ".mat": _mat,
    ".html": _page,
    ".svg": _svg,
    ".png": _picture,
    ".gif": _picture,
    ".sqlite": _sqlite,
    **dict.fromkeys((".csv", ".toml", ".urdf", ".txt", ".md"), _text),
}
