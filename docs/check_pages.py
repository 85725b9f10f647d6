"""Look through built pages for what a reader without a network would miss: python docs/check_pages.py FOLDER

Nothing that a browser loads by itself (scripts, styles, fonts, pictures, frames) may lie on another host or be
missing, and no text may have become an e-mail address. Links that a reader follows may lead anywhere.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADS = {"script": "src", "img": "src", "iframe": "src", "source": "src", "video": "src"}
LINKS = {"stylesheet", "preload", "modulepreload", "icon", "shortcut", "preconnect", "dns-prefetch"}
IN_TEXT = re.compile(
    r"""(?:url\(|@import|import\(|\.src\s*=|fetch\()\s*["']?((?:https?:)?//[^"')\s]+)"""
)
"""An address that a style or a script loads."""


class _Page(HTMLParser):
    """Collects the addresses that a page loads, and its mailto links."""

    def __init__(self) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.mails: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = {name: value or "" for name, value in attrs}
        if LOADS.get(tag) in found:
            self.loaded.append(found[LOADS[tag]])
        if tag == "link" and LINKS & set(found.get("rel", "").split()):
            self.loaded.append(found.get("href", ""))
        if tag == "a" and found.get("href", "").startswith("mailto:"):
            self.mails.append(found["href"])
        self.loaded += IN_TEXT.findall(found.get("style", ""))
        if "srcdoc" in found:
            inner = _Page()
            inner.feed(found["srcdoc"])
            self.loaded += inner.loaded

    def handle_data(self, data: str) -> None:
        if self.cdata_elem in ("script", "style"):
            self.loaded += IN_TEXT.findall(data)


def faults(folder: Path) -> list[str]:
    """One line for everything that is loaded from elsewhere, missing, or a mailto link."""
    found = []
    for path in sorted(folder.rglob("*.html")):
        page = _Page()
        page.feed(path.read_text(encoding="utf-8"))
        name = path.relative_to(folder)
        for address in page.loaded:
            parts = urlsplit(address)
            if parts.netloc:
                found.append(f"{name} loads {address}")
            elif not parts.scheme and not (path.parent / unquote(parts.path)).exists():
                found.append(f"{name} loads {address}, which is missing")
        found += [f"{name} has the link {mail}" for mail in page.mails]
    for path in sorted(folder.rglob("*.css")):
        for address in IN_TEXT.findall(path.read_text(encoding="utf-8")):
            found.append(f"{path.relative_to(folder)} loads {address}")
    return found


def main() -> None:
    found = faults(Path(sys.argv[1]))
    print("\n".join(found), file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
