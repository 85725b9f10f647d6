"""Walks in the browser while this process runs: the page of `meshcat.view` without the samples of the motion.

`play` shows it from a `server`, whose pages get one message for each frame, at the pace of the clock: t [s],
and the pose of every walk.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Mapping

from biped_adrc.viz.meshcat.frames import pose
from biped_adrc.viz.meshcat.server import Say, ServerState, run
from biped_adrc.viz.meshcat.view import Look, captions, scene_settings
from biped_adrc.viz.pages import player
from biped_adrc.viz.placement import Recorded, WalkScene

REST = 1.0
"""Time [s] between the end of the walks and their next start."""


def play(
    walks: Mapping[str, Recorded],
    look: Look,
    *,
    port: int = 0,
    open_browser: bool = True,
    wait: float = 120.0,
    say: Say = print,
) -> str:
    """Show the walks in the browser until the page is closed or the process is told to stop; returns why.

    walks: name -> walk. look: as for a page. port: 0 for a free one. open_browser: open the user's
    browser there.
    wait [s]: how long to wait for the first page. say: is given the address.
    Raises InputError for a port that is in use, and inside a running event loop, as that of a
    notebook.
    """
    scenes = {name: WalkScene.of(walks[name]) for name in look.order(walks)}
    settings = {**scene_settings(scenes, look), "live": True}
    html = player(settings, " and ".join(walks), captions(scenes))
    return run(
        html,
        lambda session: _stream(session, scenes, look.fps),
        port=port,
        open_browser=open_browser,
        wait=wait,
        say=say,
    )


async def _stream(session: ServerState, scenes: Mapping[str, WalkScene], fps: float) -> str:
    """Send a message for each frame while a page is open, by the clock; from the start again after the end.

    fps [1/s]: frames per second at most. It ends only by being cancelled or by an error.
    """
    start = min(scene.trajectory.t_start for scene in scenes.values())
    end = max(scene.trajectory.t_end for scene in scenes.values())
    began = time.monotonic()
    while True:
        await session.arrived.wait()
        t = start + time.monotonic() - began
        if session.restart or t > end + REST:
            began, t, session.restart = time.monotonic(), start, False
            session.send({"t": start, "restart": True, "poses": _poses(scenes, start)})
        else:
            t = min(t, end)
            session.send({"t": t, "poses": _poses(scenes, t)})
        await asyncio.sleep(1.0 / fps)


def _poses(scenes: Mapping[str, WalkScene], t: float) -> list[dict[str, object]]:
    """The pose of every walk at t [s], as plain values; of a walk that has ended, its last one."""
    found = []
    for scene in scenes.values():
        at = min(max(t, scene.trajectory.t_start), scene.trajectory.t_end)
        i = scene.arc_at(at)
        p = pose(scene, i, at)
        shown = {
            name: getattr(p, name).tolist() for name in ("joints", "loads", "points", "contact")
        }
        found.append({"arc": i, **shown})
    return found
