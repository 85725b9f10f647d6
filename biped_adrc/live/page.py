"""A session in the browser: `ba.play`.

    ba.play(ba.Scenario("ADRC", hardware="ideal"), ghost={"controller": "NPD"})
    ba.play(walker, gait)

The page (viz/play) draws with the scripts of stored walks, from one `frame` after the other; its server is
`viz.meshcat.server`, with a `Stage` that hears the pages. A live walk has no end and its ground is not known
beforehand: the page moves the ground and a few footprints along with it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import cast

import numpy as np

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.live.controls import controls, tour
from biped_adrc.live.driver import Driver
from biped_adrc.live.frame import limits_of
from biped_adrc.live.hand import MOST_FORCE, MOST_TORQUE
from biped_adrc.live.live_walk import LiveWalk
from biped_adrc.live.of_walker import scenario_of
from biped_adrc.live.session import Session
from biped_adrc.live.stage import Stage
from biped_adrc.model.biped import Biped
from biped_adrc.parts import check_part
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz.meshcat import objects as draw
from biped_adrc.viz.meshcat.server import Say, run
from biped_adrc.viz.meshcat.view import LANE, Look, captions, scene_settings
from biped_adrc.viz.pages import with_viewer
from biped_adrc.viz.placement import WalkScene
from biped_adrc.viz.style import TORQUE

AROUND = 4.0
"""How far [m] the ground reaches before and behind the robot."""
SLOW = 0.9
"""Share of the pace asked for below which a walk is said not to have kept up."""
PRINTS = 12
"""Footprints that are there at once."""
GHOSTS = ("NPD", "NPID", "ADRC")
"""Controllers of a ghost to choose from."""
NEARER = -0.15
"""Where the arrow of the hand is [m], from the plane of the walk towards the camera."""


def play(
    scenario: Scenario | Walker,
    gait: Gait | None = None,
    *,
    ghost: Mapping[str, object] | None = None,
    out: Path | str = ".",
    port: int = 0,
    open_browser: bool = True,
    wait: float = 120.0,
    say: Say = print,
) -> str:
    """A walk live in the browser, under one's own hand, until the page is closed; returns why it ended.

    scenario: in sampled time, such as hardware = "ideal"; or a walker, with its gait, all of which a scenario
    can say (`of_walker`). ghost: values by which a walk beside it differs.
    out: folder for sessions that are saved. port: 0 for a free one. open_browser: open the user's browser
    there. wait [s]: how long to wait for the first page. say: is given the address, and other sentences.
    Raises InputError for what cannot walk live, a folder that is none, a port that is in use, and inside a
    running event loop.
    """
    check_part(scenario, "what is to walk live", Scenario, Walker)
    if isinstance(scenario, Walker):
        check_part(gait, "the gait of the walker", Gait)
        scenario = scenario_of(scenario, cast(Gait, gait))
    elif gait is not None:
        raise InputError("a scenario has its gait; leave the other one out")
    folder = Path(out)
    if not folder.is_dir():
        raise InputError(f"'{folder}' is no folder; sessions are saved in one that there is")
    stage = Stage(Driver(Session(scenario, ghost)), folder)
    stage.ready()
    html = page(stage.driver.session)
    why = run(
        html, stage.stream, listener=stage, port=port, open_browser=open_browser, wait=wait, say=say
    )
    if (kept := stage.driver.kept) < SLOW:
        say(f"this walk did not keep up with the clock: {kept:.2f} of the pace asked for")
    return why


def page(session: Session) -> str:
    """The text of the page of a session."""
    scenes = {name: laid_out(live) for name, live in zip(NAMES, with_ghost(session), strict=True)}
    legend = captions({"walk": scenes["walk"]})[1:]
    title = f"{session.walking[0].scenario.robot}, live"
    return with_viewer(
        "play",
        settings(session.walking[0].scenario, scenes),
        title=title,
        captions=legend,
        style="play/play.css",
    )


NAMES = ("walk", "ghost")
"""Of the robots on the page."""


def with_ghost(session: Session) -> tuple[LiveWalk, LiveWalk]:
    """The walk, and the ghost or, without one, the walk again: the page may ask for a ghost later."""
    return session.walking[0], session.walking[-1]


def laid_out(live: LiveWalk) -> WalkScene:
    """A live walk where it is now, with as much ground and as many footprints as are seen at once.

    The ground is drawn without its steps: the page moves it under the foot that stands.
    """
    walker = replace(live.moving.walker, ground_steps=())
    x = live.now.x[None, :]
    arc = Arc(live.now.mode, np.array([live.now.t]), x, np.zeros_like(x))
    footholds = np.linspace(-AROUND, AROUND, PRINTS)
    run = Trajectory((arc,) * PRINTS, Status.COMPLETED)
    return WalkScene(walker, run, footholds, -math.tan(walker.slope) * footholds)


def settings(s: Scenario, scenes: Mapping[str, WalkScene]) -> dict[str, object]:
    """What the scripts of a page are told: as `scene_settings` has it, and what a session has besides.

    links       (path, link): the drawn parts of the walk, and the link that each belongs to
    hand        paths of the arrow and of the line of the spring
    robot       coordinates, links and trunk by name, motors p
    limits      friction, torque [N m]; most: force [N] and torque [N m] of a hand
    controls    sliders and choices; ghosts: names to choose from; tour: its stations
    """
    biped = scenes["walk"].biped
    d = biped.description
    told = scene_settings(scenes, Look(solid="walk"))
    commands = told["commands"]
    assert isinstance(commands, list)
    return told | {
        "live": True,
        "commands": [*commands, *hand_commands()],
        "lane": LANE,
        "links": drawn_links(biped),
        "hand": {"arrow": "meshcat/hand/arrow", "line": "meshcat/hand/line"},
        "robot": {
            "coordinates": [f"q{k}" for k in range(1, biped.n + 1)],
            "links": [*dict.fromkeys(link for _, link in drawn_links(biped))],
            "trunk": d.trunk,
            "p": biped.p,
        },
        "limits": limits_of(s, d),
        "most": {"force": MOST_FORCE, "torque": MOST_TORQUE},
        "controls": controls(),
        "ghosts": GHOSTS,
        "tour": tour(),
    }


def drawn_links(biped: Biped) -> list[tuple[str, str]]:
    """(path, link) of every primitive of the walk's robot."""
    tree = biped.tree
    return [
        (f"meshcat/robots/walk/{draw.joint_path(tree, joint)}/visual_{k}", joint.child)
        for joint in tree.joints
        for k in range(len(tree.links[joint.child].visuals))
    ]


def hand_commands() -> list[str]:
    """Meshcat's commands for the arrow of the hand and the line of its spring."""
    window = draw.MemoryWindow("hand")
    window.viewer["hand"].set_transform(draw.shift((0.0, NEARER, 0.0)))
    draw.add_arrow(window.viewer["hand/arrow"], TORQUE, 1.0)
    draw.add_trace(window.viewer["hand/line"], 2, draw.DARK, 1.0)
    return window.packed
