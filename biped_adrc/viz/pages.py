"""Pages from templates: each one offline file that holds all it needs and asks no network for anything."""

from __future__ import annotations

import base64
import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader
from markupsafe import Markup

from biped_adrc.errors import InputError

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
    "img-src data: blob:; worker-src blob:"
)
"""Content security policy of a page: the browser itself refuses every load from a network."""
MAGIC = {b"\x89PNG": "image/png", b"<?xml": "image/svg+xml", b"<svg": "image/svg+xml"}

Captions = dict[str, tuple[str, str]]
"""Heading of each figure and what to look for in it, by name."""


@cache
def captions(page: str) -> Captions:
    """Those of a page, from captions.toml."""
    found = tomllib.loads(files("biped_adrc.viz").joinpath("captions.toml").read_text("utf-8"))
    return {name: (x["title"], " ".join(x["text"].split())) for name, x in found[page].items()}


def rendered(template: str, **values: Any) -> str:
    """The text of a page; every value is escaped, numbers are shown to four significant digits."""
    return _environment().get_template(f"{template}.html.j2").render(values)


@cache
def _environment() -> Environment:
    loader = PackageLoader("biped_adrc.viz")
    made = Environment(
        loader=loader, autoescape=True, finalize=plain, trim_blocks=True, lstrip_blocks=True
    )
    made.globals |= {"policy": POLICY, "style": "report.css", "file": own_file}
    return made


def own_file(name: str) -> Markup:
    """A style or script of this package, as it is."""
    return Markup(files("biped_adrc.viz").joinpath(name).read_text(encoding="utf-8"))


def plain(value: Any) -> str:
    """A value as text."""
    if isinstance(value, str):
        return value
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, Mapping):
        return ", ".join(f"{key}: {plain(item)}" for key, item in value.items())
    if isinstance(value, Sequence):
        return ", ".join(plain(item) for item in value)
    return str(value)


def data_uri(title: str, source: str | bytes | Path) -> str:
    """A figure as a data URI: nothing in an SVG can run or clash with the page. Raises InputError."""
    data = source.read_bytes() if isinstance(source, Path) else source
    data = data.encode("utf-8") if isinstance(data, str) else data
    kinds = [kind for start, kind in MAGIC.items() if data.lstrip().startswith(start)]
    if not kinds:
        raise InputError(
            f"figure '{title}' is neither PNG nor SVG; give SVG text or a Path to a file"
        )
    return f"data:{kinds[0]};base64,{base64.b64encode(data).decode('ascii')}"
