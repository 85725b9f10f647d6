"""Sphinx configuration. Build: sphinx-build -W --keep-going -n -E -b html docs docs/_build/html

Neither the build nor a page that is read needs a network: MathJax lies beside the pages.
"""

import importlib.util
import pkgutil
import sys
from pathlib import Path

import biped_adrc

sys.path.insert(0, str(Path(__file__).parent))

import docstrings
import expand

docstrings.name_array_types()  # before any other module of the package is imported

project = "biped_adrc"
copyright = "the biped_adrc authors, BSD-3-Clause"
version = release = biped_adrc.__version__
html_title = f"biped_adrc {release}"

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx-mathjax-offline"]
exclude_patterns = ["_build"]
nitpicky = True
nitpick_ignore_regex = [(r"py:.*", r"(?!biped_adrc\b).*")]  # no network, hence no inventories

# -- docstrings: plain text with indented equations ---------------------------------------------
autodoc_member_order = "bysource"
autodoc_default_options = {
    "members": True,
    "undoc-members": True,
    "show-inheritance": True,
    "special-members": "__call__",
}
autodoc_typehints_format = "short"
autodoc_docstring_signature = False  # "output -> u." is a sentence
autodoc_preserve_defaults = True
autodoc_use_type_comments = False  # there are none to look for

# -- Markdown ----------------------------------------------------------------------------------
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist", "attrs_inline"]
myst_heading_anchors = 3
myst_dmath_double_inline = True
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
html_search_scorer = str(Path(__file__).parent / "scorer.js")


def exists(name):
    """Whether a dotted name of the package is there; fields of records count."""
    owner, _, last = name.rpartition(".")
    try:
        thing = pkgutil.resolve_name(owner)
    except (ImportError, AttributeError):
        return False
    module = importlib.util.find_spec(name) if hasattr(thing, "__path__") else None
    return module or hasattr(thing, last) or last in getattr(thing, "__annotations__", {})


def by_home(app, env, node, contnode):
    """A link to the public name of what lives in a module; what is not public is text, if it exists."""
    target = node.get("reftarget", "")
    if node.get("refdomain") != "py" or not target.startswith("biped_adrc."):
        return None
    for name, home in biped_adrc._HOMES.items():
        long = f"biped_adrc.{home}.{name}"
        if target == long or target.startswith(f"{long}."):
            short = f"biped_adrc.{name}" + target.removeprefix(long)
            domain, doc = env.get_domain("py"), node["refdoc"]
            found = domain.resolve_xref(env, doc, app.builder, "obj", short, node, contnode)
            return found or (contnode if exists(target) else None)
    return contnode if exists(target) else None


def setup(app):
    app.config.mathjax_path = (
        "mathjax/tex-svg.js"  # fonts inside: browsers refuse those of other files
    )
    app.connect("autodoc-process-docstring", docstrings.plain)
    app.connect("autodoc-process-signature", docstrings.signature)
    app.connect("autodoc-process-bases", docstrings.bases)
    app.connect("autodoc-skip-member", docstrings.skip)
    app.connect("source-read", expand.for_sphinx)
    app.connect("missing-reference", by_home)
