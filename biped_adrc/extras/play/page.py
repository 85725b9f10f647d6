"""A page on which a user pushes and pulls a walking robot with the mouse: `ba.play`, `biped-adrc play`.

    ba.play("walk.html", ba.Scenario("ADRC", hardware="ideal"))

The page has controllers, robot and integration as WebAssembly (`extras.play.webassembly`). Its scripts move the
walk sample by sample (from one sample instant to the next), compute the push of the user, which is called the
hand, go back in time, and show a ghost, which is a second walk for comparison. The user can choose among the
scenarios with which the page was made, on the rigid plant: that of `play`, the same one with other controllers
or observers (OTHERS, if the caller names none), and the stations of a tour, each a text with values of a
scenario. A walk that is chosen begins anew.

The walk has no end and its ground is not known beforehand: the page moves the ground and a few footprints along
with it.
"""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import output_path, packaged, write_text
from biped_adrc.extras.play.walks import MOST, PageWalk, page_numbers, variants
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.scenario.dotted import merged, tables
from biped_adrc.scenario.scenario import ObserverRecord, Scenario
from biped_adrc.view.colours import TORQUE
from biped_adrc.view.meshcat import objects as draw
from biped_adrc.view.meshcat.view import captions, scene_settings
from biped_adrc.view.pages import with_viewer
from biped_adrc.view.placement import Clip, WalkScene, placed

FIRST = Scenario("ADRC", hardware={"profile": "ideal", "torque_limit": 150.0})
"""Scenario of a page if the caller gives none: that of the tour."""
OTHERS: Mapping[str, Mapping[str, object]] = {
    **{name: {"controller.name": name} for name in ("NPD", "NPID", "ADRC")},
    **{
        f"ADRC, m = {m}, 300 rad/s": {
            "controller": {"name": "ADRC", "observer": {"order": m, "bandwidth": 300.0}}
        }
        for m in (1, 2, 3, 7)
    },
}
"""Name -> fields by which a walk to choose from differs from the page's scenario."""
_SAMPLES = 2
"""Largest delay of the torque that the page's slider reaches [sampling periods]."""
_HERE = "biped_adrc.extras.play"
_AROUND = 4.0
"""Length of the ground before and behind the robot [m]."""
PRINTS = 12
"""Number of footprints that are drawn at the same time."""
NEARER = -0.15
"""Distance of the hand's arrow from the plane of the walk [m], negative towards the camera."""


def play(
    path: Path | str,
    scenario: Scenario | None = None,
    others: Mapping[str, Mapping[str, object]] | None = None,
) -> Path:
    """Write a page on which a walking robot is pushed with the mouse, one file without server or network;
    returns its path.

    path: of the page, .html. scenario: in sampled time on the rigid plant; FIRST if None. others: the walks to
    choose from, by name the fields in which each differs from `scenario`; OTHERS if None. The first of them is
    the ghost. Raises InputError for a walk that a page cannot compute, and OutputError.

    >>> page = ba.play(folder / "walk.html", ba.Scenario("NPD", hardware="ideal"), others={})
    >>> page.name
    'walk.html'
    """
    scenario = FIRST if scenario is None else scenario
    check_part(scenario, "what is to walk on a page", Scenario)
    check_part(others, "the walks to choose from", Mapping, type(None))
    path, others = output_path(Path(path), (".html",)), OTHERS if others is None else others
    for name, values in others.items():
        check_part(values, f"the walk '{name}'", Mapping)
    write_text(path, page(scenario, others))
    return path


def page(
    scenario: Scenario, others: Mapping[str, Mapping[str, object]], samples: int = _SAMPLES
) -> str:
    """HTML text of the page.

    others: name -> fields in which a walk to choose from differs from `scenario`. samples: the largest delay
    that the slider reaches [sampling periods], 0 for no such slider. Raises InputError for a walk that a page
    cannot compute.
    """
    # first: name of the walk of `scenario` itself; that of an equal one of the others if there is one
    scenarios = {name: revised(scenario, x) for name, x in others.items()}
    own = (name for name, x in scenarios.items() if x == scenario)
    first = next(own, f"{scenario.controller.name}, as given")
    scenarios[first] = scenario
    chosen = set(scenarios)  # walks of the tour are added below, and have no slider of the delay
    stations = guided(scenario, scenarios)
    walks = {first: variants(first, scenario, samples)}
    for name, s in scenarios.items():
        try:
            walks[name] = walks.get(name) or variants(name, s, samples if name in chosen else 0)
        except InputError as error:
            raise InputError(f"the walk '{name}' to choose or as a ghost: {error}") from error
    # [0] is the walk itself, behind which its variants follow; laid_out: its scene at the start
    scene = laid_out(walks[first][0])
    content = settings(walks[first][0], scene) | {
        "tour": stations,
        "numbers": page_numbers(walks) | {"first": first, "ghost": next(iter(others), None)},
    }
    title = f"{scenario.robot.name}, live"
    # without the line that names the walk, which a user may change
    legend = captions({"walk": scene})[1:]
    if scenario.hardware.torque_limit is None:
        legend.append(("", "motors without a torque limit: set hardware.torque_limit for one"))
    return with_viewer("play", content, _HERE, title=title, captions=legend, style="play.css")


def revised(s: Scenario, values: Mapping[str, object]) -> Scenario:
    """A copy of the scenario s with other values by name; with another controller, the values of the observer
    of s are dropped.

    Raises InputError for values that it does not take.
    """
    name = tables(values).get("controller", {})
    name = name if isinstance(name, str) else name.get("name", s.controller.name)
    if name != s.controller.name:
        s = s.replace({"controller.observer": ObserverRecord()})
    return s.replace(values)


def tour() -> list[dict[str, Any]]:
    """The stations of tour.toml, each with title, text and all `values` of the scenario that it sets; the value
    "none" stands for None.
    """
    table = packaged(_HERE, "tour.toml")
    return [x | {"values": merged(table["base"], x["values"])} for x in table["station"]]


def guided(scenario: Scenario, scenarios: dict[str, Scenario]) -> list[dict[str, Any]]:
    """The stations of the tour for the page of `scenario`, each with the name of its walk.

    A walk that is not yet in `scenarios`, which has those of the page by name, is added there under the title
    of the station. Stations whose values the scenario does not take are left out.
    """
    stations = []
    for station in tour():
        try:
            s = revised(scenario, station.pop("values"))
        except InputError:
            continue
        name = next((name for name, x in scenarios.items() if x == s), station["title"])
        scenarios[name] = s
        stations.append(station | {"walk": name})
    return stations


def laid_out(walk: PageWalk) -> WalkScene:
    """Scene of a walk at its start, for the viewer, with as much ground and as many footprints as are visible
    at the same time.

    Its trajectory is artificial: PRINTS arcs (single supports) with the state of the start, one for each
    footprint, as the viewer draws one for each single support. The page moves the footprints along with the
    walk.
    """
    x = walk.x[None, :]
    arc = Arc(walk.mode, np.zeros(1), x, np.zeros_like(x))
    # _AROUND: length of the ground before and behind the robot
    footholds = np.linspace(-_AROUND, _AROUND, PRINTS)
    run = Trajectory((arc,) * PRINTS, Status.COMPLETED)
    return WalkScene(walk.walker, run, footholds, -math.tan(walk.walker.ground_slope) * footholds)


def settings(walk: PageWalk, scene: WalkScene) -> dict[str, object]:
    """The settings that the scripts of a page read: those of `scene_settings`, and besides

    links       (path, link): the drawn shapes of the walk, by path in the viewer's scene, and the link of each
    hand        paths of the arrow of the hand's force and of the line of its spring
    robot       coordinates, links and trunk by name, number p of motors
    most        largest force [N] and torque [N m] of the hand

    The scene is drawn twice, for the walk and for the ghost.
    """
    biped = walk.walker.plant
    # Clip(): the usual choice of time, frames and camera
    content = scene_settings({"walk": scene, "ghost": scene}, Clip())
    robot = "meshcat/robots/0"  # the walk; its ghost is robots/1
    links = [(f"{robot}/{path}", link) for path, link in draw.visual_links(biped.tree)]
    return content | {
        "commands": [*content["commands"], *hand_commands()],
        "links": links,
        "hand": {"arrow": "meshcat/hand/arrow", "line": "meshcat/hand/line"},
        "robot": {
            "coordinates": [f"q{k}" for k in range(1, biped.n + 1)],
            "links": [*dict.fromkeys(link for _, link in links)],
            "trunk": biped.description.trunk,
            "p": biped.p,
        },
        "most": MOST,
    }


def hand_commands() -> list[str]:
    """Commands of the viewer Meshcat that draw the arrow of the hand's force and the line of its spring."""
    window = draw.MemoryWindow("hand")
    # NEARER: towards the camera, so that no link covers them
    window.viewer["hand"].set_transform(placed((0.0, NEARER, 0.0)))
    # in the colour of torques from outside, and opaque; the line has two points
    draw.add_arrow(window.viewer["hand/arrow"], TORQUE, 1.0)
    draw.add_trace(window.viewer["hand/line"], 2, draw.DARK, 1.0)
    return window.packed
