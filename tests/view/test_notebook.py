"""What a notebook shows of a walk and of its trajectory."""

from __future__ import annotations

import base64
import html
import pickle
import re
from dataclasses import replace

import pytest

from biped_adrc.core.errors import InputError
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


def test_a_trajectory_without_a_robot_says_what_to_do(walks: dict[str, Walk], tmp_path) -> None:
    bare = replace(walks["NPD"].trajectory, viewer=None)
    assert bare._repr_html_() is None
    with pytest.raises(InputError, match=r"biped_adrc\.walk"):
        bare.animate(tmp_path / "walk.html")
    sent = pickle.loads(pickle.dumps(walks["NPD"].trajectory))
    assert sent.viewer is None
    assert sent.t_end == bare.t_end
