"""The page of the first walk as a notebook, without outputs: python docs/make_notebook.py

Blocks of Python are its code cells, and what stands between them its text, with links from where it lies.
"""

import json
import re
from pathlib import Path

PAGE = Path(__file__).parent / "first_walk.md"
NOTEBOOK = PAGE.parents[1] / "examples" / "first_walk.ipynb"
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def notebook(page: str) -> str:
    """The notebook's JSON (format 4.4) of a page."""
    cells = []
    for i, text in enumerate(re.split(r"^```python\n(.*?)^```$", page, flags=re.M | re.S)):
        if i % 2:
            more = {"cell_type": "code", "execution_count": None, "outputs": []}
        else:
            more = {"cell_type": "markdown"}
            text = re.sub(r"\]\((?!https?:|#)", "](../docs/", text)
        lines = text.strip().splitlines(keepends=True)
        cells += [more | {"metadata": {}, "source": lines}] if lines else []
    whole = {"cells": cells, "metadata": {"kernelspec": KERNEL}, "nbformat": 4, "nbformat_minor": 4}
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    NOTEBOOK.write_text(notebook(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
