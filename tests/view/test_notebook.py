"""What a notebook shows of a walk and of its trajectory."""

from __future__ import annotations

import base64
import html
import re

from biped_adrc.scenario.recording import Walk
from biped_adrc.view.meshcat.view import animation_html


def test_a_walk_shows_its_animation_and_its_figures(walks: dict[str, Walk]) -> None:
    shown = walks["ADRC"]._repr_html_()
    frame = re.search(r'<iframe[^>]*sandbox="allow-scripts"[^>]*srcdoc="([^"]*)"', shown)
    assert frame is not None
    assert html.unescape(frame.group(1)) == animation_html({"ADRC": walks["ADRC"]})
    pictures = re.findall(r'src="data:image/png;base64,([^"]*)"', shown)
    assert [base64.b64decode(p)[:4] for p in pictures] == [b"\x89PNG"]
    assert shown.startswith("<p>ADRC: 3 impacts. COMPLETED")
