"""Sphinx configuration. Build: sphinx-build -W --keep-going -n -E -b html docs docs/_build/html

Neither the build nor a page that is read needs a network: MathJax lies beside the pages.
"""

import sys
from pathlib import Path

import biped_adrc

sys.path.insert(0, str(Path(__file__).parent))

import docstrings
import expand
from sphinx import addnodes
from sphinx.domains.python import PythonDomain

docstrings.name_array_types()  # before any other module of the package is imported

project = "biped_adrc"
copyright = "the biped_adrc authors, BSD-3-Clause"
version = release = biped_adrc.__version__
html_title = f"biped_adrc {release}"

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx-mathjax-offline"]
exclude_patterns = ["_build", "**/.ipynb_checkpoints", "jupyter_execute"]
nitpicky = True
nitpick_ignore_regex = [
    # no network, hence no inventories of these projects
    (r"py:.*", r"(numpy|np|scipy|matplotlib|pin|pinocchio|meshcat|typer|rich|xml|ET)\b.*"),
    (r"py:.*", r"_?(asyncio|collections|pathlib|enum|abc|concurrent|functools|types|typing)\b.*"),
    (r"py:.*", r"(socket|subprocess)\b.*"),
    (r"py:.*", r"(Figure|Axes|ArrayLike|NDArray|Path|Callable|Mapping|Sequence|Iterator|Iterable)"),
    (r"py:.*", r"StateSpace"),
    (r"py:.*", r"Ints|Value|Scale"),  # aliases
    (r"py:.*", r"(annotated_types|pydantic|sqlite3|distributed|inspect|markupsafe)\b.*"),
    (r"py:.*", r"(ca|casadi|numba|llvmlite|pandas|signal|binding|gymnasium)\b.*"),
    (r"py:.*", r"biped_adrc\.[a-z_.]+\.[A-Z](_co)?"),  # of a generic class
    (r"py:.*", r"tuple\[.*"),
    (r"py:.*", r"[-0-9.e+]+"),  # bounds of a field
    (r"py:.*", r"(.*\.)?_[A-Za-z]\w*"),  # private names in signatures
]

# -- docstrings: plain text with indented equations ---------------------------------------------
autodoc_member_order = "bysource"
autodoc_default_options = {
    "members": True,
    "undoc-members": True,
    "show-inheritance": True,
    "special-members": "__call__",
}
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
autodoc_use_type_comments = False  # there are none to look for

# -- Markdown and notebooks -----------------------------------------------------------------------
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist", "attrs_inline"]
myst_heading_anchors = 3
myst_dmath_double_inline = True
nb_execution_mode = "force"
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_merge_streams = True
nb_mime_priority_overrides = [("html", "image/svg+xml", 0)]

highlight_language = "text"  # indented equations of docstrings; fences say what they are
smartquotes = False  # q'' is a second derivative

# -- pages ------------------------------------------------------------------------------------------
html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["extra.css"]
html_last_updated_fmt = None
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {"top_of_page_buttons": []}


def titles(toc):
    """Of the contents of a page its title and the pages below it, which is all that the sidebar shows."""
    short = toc.deepcopy()
    for entry in short.children:
        if len(entry) > 1:
            if below := list(entry.findall(addnodes.toctree)):
                entry[1][:] = below
            else:
                entry.pop(1)
    return short


def light_sidebar(app, pagename, templatename, context, doctree):
    """Otherwise every name of the reference is copied for every page, and thrown away."""
    env, toctree = app.env, context["toctree"]
    if not hasattr(app, "short_tocs"):
        app.short_tocs = {name: titles(toc) for name, toc in env.tocs.items()}

    def with_titles(**options):
        whole, env.tocs = env.tocs, app.short_tocs
        try:
            return toctree(**options)
        finally:
            env.tocs = whole

    context["toctree"] = with_titles


class IndexedNames(PythonDomain):
    """Looks for a name among the objects that end with it; otherwise every link searches all of them."""

    def find_obj(self, env, modname, classname, name, type, searchmode=0):
        whole = self.data["objects"]
        if getattr(self, "indexed", 0) != len(whole):
            self.indexed, self.by_end = len(whole), {}
            for full in whole:
                self.by_end.setdefault(full.rpartition(".")[2], {})[full] = whole[full]
        end = name.removesuffix("()").rpartition(".")[2]
        try:
            self.data["objects"] = self.by_end.get(end, {})
            return super().find_obj(env, modname, classname, name, type, searchmode)
        finally:
            self.data["objects"] = whole


def setup(app):
    app.add_domain(IndexedNames, override=True)
    app.config.mathjax_path = (
        "mathjax/tex-svg.js"  # fonts inside: browsers refuse those of other files
    )
    app.connect("autodoc-process-docstring", docstrings.plain)
    app.connect("autodoc-process-signature", docstrings.signature)
    app.connect("autodoc-process-bases", docstrings.bases)
    app.connect("autodoc-skip-member", docstrings.skip)
    app.connect("source-read", expand.placeholders)
    app.connect("html-page-context", light_sidebar, priority=400)  # before the theme asks for it
