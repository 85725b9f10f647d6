"""HTML pages from Jinja2 templates: each is one offline file that holds all it needs.

The pages are the report of a reproduction, a study, the player of animated walks, and a walk inside a
notebook; their templates are in the folder `templates`. Figures go in as data URIs, scripts and styles as
text, and a content security policy makes the browser refuse every load from a network. All values are
escaped, unless they are `Markup` made here. The same values give the same text, byte for byte.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from jinja2 import Environment, FileSystemLoader
from markupsafe import Markup

from biped_adrc.core.files import packaged
from biped_adrc.core.types import PlainRecord

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_HERE = "biped_adrc.view"
"""The package with the templates shared by all pages."""
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
    "img-src data: blob:; worker-src blob:"
)
"""Content security policy of a page: the browser itself refuses every load from a network."""
CLAIM_COLUMNS = ("claim", "where", "word", "number", "limit", "share", "reason")
"""Columns of the table of claims in the report, by their key in the summary."""
HEIGHT = 480
"""[px] of the animation in a notebook."""


def rendered(template: str, package: str = _HERE, **values: object) -> str:
    """Fill in a page's template; returns the text of the page.

    template: name of the file without .html.j2, in `package` or in `view`. values: by the names in the
    template. Every value is escaped as HTML, and written by `as_text`: floats with four significant digits.
    """
    return _environment(package).get_template(f"{template}.html.j2").render(values)


@cache
def _environment(package: str) -> Environment:
    """Jinja's environment for the templates of `package` and of `view`, made once, since it compiles them.

    Templates have the policy, the name of the style sheet, and file(name): the text of a file beside them.
    """
    places = [files(package), files(_HERE), files(_HERE) / "templates"]
    loader = FileSystemLoader([str(place) for place in places])
    environment = Environment(
        loader=loader, autoescape=True, finalize=as_text, trim_blocks=True, lstrip_blocks=True
    )
    # POLICY: the content security policy
    environment.globals |= {
        "policy": POLICY,
        "style": "report.css",
        # a style or script as it is, trusted and not escaped
        "file": lambda name: Markup(loader.get_source(environment, name)[0]),
    }
    return environment


def as_text(value: object) -> str:
    """Text of a value on a page: texts as they are, a dash for None, yes or no, floats with 4 significant
    digits.

    Entries of mappings and lists are joined with commas, recursively.
    """
    if isinstance(value, str):
        return value
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, Mapping):
        return ", ".join(f"{key}: {as_text(item)}" for key, item in value.items())
    if isinstance(value, Sequence):
        return ", ".join(as_text(item) for item in value)
    return str(value)


def data_uri(picture: bytes) -> str:
    """Encode a PNG or SVG as a data URI for the source of an <img>.

    There an SVG can neither run scripts nor clash with the ids of another one.
    """
    kind = "png" if picture.startswith(b"\x89PNG") else "svg+xml"
    return f"data:image/{kind};base64,{base64.b64encode(picture).decode('ascii')}"


def report_html(
    summary: PlainRecord, figures: Mapping[str, bytes], animation: str | None = None
) -> str:
    """Text of the page of a reproduction (report.html).

    summary: as in summary.json; parts that are missing are left out of the page. figures: name -> an
    SVG or PNG; the name selects the caption. animation: text of the page of
    `meshcat.view.animation_html`, shown in a frame; no frame if None.
    """
    drawn = [_figure(name, picture) for name, picture in figures.items()]
    return rendered("report", s=summary, figures=drawn, animation=animation, columns=CLAIM_COLUMNS)


def _figure(name: str, picture: bytes) -> tuple[str, str, str]:
    """Heading, caption and data URI of one figure of the report.

    The caption is that entry of captions.toml whose name the figure's name is, or begins with before a "_". The
    rest of the name, such as the preset in "push_map_tac2003", follows in the heading. A figure without a
    caption has its name as heading.
    """
    known = packaged(_HERE, "captions.toml")["report"]
    key = next((key for key in known if name == key or name.startswith(f"{key}_")), "")
    caption = known.get(key, {"title": name, "text": ""})
    rest = name.removeprefix(key).replace("_", " ").strip() if key else ""
    title = f"{caption['title']}, {rest}" if rest else caption["title"]
    return title, caption["text"], data_uri(picture)


def with_viewer(
    template: str, settings: Mapping[str, object], package: str = _HERE, **values: object
) -> str:
    """Text of a page that draws in Meshcat's viewer and whose scripts read the settings as JSON.

    template: name of the page's template, in `package`. settings: as `meshcat.view.scene_settings` returns
    them. values: other names in the template. A template takes the JSON as text (`data`) or deflated in base64
    (`packed`), which is shorter.
    """
    viewer = files("meshcat").joinpath("viewer", "dist", "main.min.js").read_text(encoding="utf-8")
    text = json.dumps(settings)
    values |= {"s": settings, "viewer": Markup(viewer)}
    # no "</script>" in a text may end the script
    values["data"] = Markup(text.replace("<", "\\u003c"))
    values["packed"] = base64.b64encode(zlib.compress(text.encode(), 9)).decode("ascii")
    return rendered(template, package, **values)


def inline(summary: str, animation: str, figures: Sequence[Figure] = ()) -> str:
    """HTML of the output of a notebook's cell: the line `summary`, the page `animation` in a frame, then
    figures.

    The frame has the page as its source text, so the scripts of the notebook and of the page cannot meet.
    """
    from biped_adrc.view.style import render  # loads matplotlib, which other pages do not need

    uris = [data_uri(render(figure, "png", dpi=80.0)) for figure in figures]
    return rendered("notebook", summary=summary, animation=animation, figures=uris, height=HEIGHT)
