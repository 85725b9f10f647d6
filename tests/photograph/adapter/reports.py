"""One run of every kind as it comes back from its file, reports of the studies, rows of the verification."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

import biped_adrc as ba
from biped_adrc.analysis.observer.report import observer_report
from tests.photograph import files
from tests.photograph.adapter import walkers
from tests.photograph.adapter.names import dotted
from validation.groups import groups

Plain = dict[str, Any]
PUSH = "q1,q2,q3,q4=30@2:0.1-0.2"

STORED: dict[str, Plain] = {
    "ADRC": {"pushes": [PUSH]},
    "ADRC on Pinocchio": {"engine": "pinocchio", "impacts": 1},
    "ADRC sampled": {"period": 1e-3, "torque_limit": 150.0, "bandwidth": 500.0},
    "ADRC with friction": {
        "friction": True,
        "bandwidth": 400.0,
        "order": 2,
        "mass": {"torso": 1.1},
    },
    "NPD": {"controller": "NPD", "pushes": [PUSH, "q5=-5@1:0.2-"]},
    "NPD sampled": {"controller": "NPD", "period": 2e-3, "gait": "v0.8", "preset": "tac2003"},
    "NPD as printed": {"controller": "NPD", "solve_theta": False, "method": "adaptive"},
    "NPD that falls": {"controller": "NPD", "torque_limit": 5.0},
}
"""Fields of a run, three impacts, compiled, if nothing else is said."""
PASSIVE = ("compass", "rimless_wheel", "simplest")

_PART: Plain = {
    "robot": "rabbit",
    "preset": None,
    "joint_friction": False,
    "gait": "published",
    "curve": "stored",
    "continued": False,
    "controller": {"kind": "NPD", "gains": None, "around": []},
    "timing": None,
    "hardware": {"sensors": None, "motors": None, "meter": None},
    "errors": None,
    "pushes": [],
    "ground": {"slope": 0.0, "steps": [], "uneven": None},
    "torque_limit": None,
    "impact_gain": [],
    "fall_height": 0.35,
    "max_step_time": 2.0,
    "method": None,
}
_LINK = {"link": "torso", "at": [0.0, 0.2], "amplitude": [40.0, 0.0, 1.0], "step": 1, "rise": 0.01}
_ESO = {"kind": "bandwidth", "bandwidth": 400.0, "order": 1}
_SENSORS = {"counts": 8192.0, "noise": 1e-5, "velocity": "gyro", "seed": 3}
MADE: dict[str, Plain] = {
    "pushed on a link": {"pushes": [{"kind": "link pulse", "start": 0.1, "stop": 0.2, **_LINK}]},
    "pulled at the hip": {
        "pushes": [{"kind": "hip", "force": [-3.0, 0.0], "steps": None}],
        "controller": {
            "kind": "NPD",
            "gains": None,
            "around": [{"kind": "stride", "gains": [-1.0, -0.4], "speed": None}],
        },
    },
    "with sensors and motors": {
        "timing": {"period": 1e-3, "restart": True, "delay": 5e-4, "delay_known": True},
        "controller": {"kind": "ADRC", "gains": None, "observer": _ESO, "around": []},
        "hardware": {
            "sensors": _SENSORS,
            "motors": {"rate_limit": 1e5, "lag": 1e-3},
            "meter": {"window": 5e-3, "friction": None},
        },
    },
    "own controller on uneven ground": {
        "controller": {"kind": "own PD", "around": []},
        "ground": {"slope": 0.0, "steps": [["down", 2, 0.01]], "uneven": None},
    },
    "ADRC with a delay": {
        "method": {"kind": "rk4", "h": 5e-4},
        "controller": {
            "kind": "ADRC",
            "gains": None,
            "observer": _ESO,
            "around": [
                {"kind": "delayed", "delay": 1e-3, "order": 4, "known": True, "limit": None}
            ],
        },
    },
}
"""Walks that no command makes; what differs from `_PART`."""


def stored(name: str) -> Plain:
    """A run, written and read again."""
    given = dotted({"engine": "compiled", "impacts": 3, **STORED[name]})
    return reread(ba.walk_scenario(ba.Scenario(**given)))


def stored_passive(robot: str) -> Plain:
    """The same of a robot without motors."""
    return reread(ba.walk_scenario(ba.Scenario("passive", robot=robot, run={"impacts": 2})))


def reread(walk: ba.Walk) -> Plain:
    """What `load_walk` makes of a run."""
    with tempfile.TemporaryDirectory() as folder:
        return walk_report(ba.load_walk(walk.save(Path(folder) / "run.npz")))


def made(name: str) -> Plain:
    """A walk of parts."""
    s = {**_PART, **MADE[name]}
    biped = walkers.robot(s["robot"], s["preset"], s["joint_friction"])
    g = walkers.gait(s, biped)
    w = walkers.walker(s, biped, g)
    return walk_report(ba.walk(w, g, 3, walkers.method(s["method"]), engine="compiled"))


def walk_report(walk: Any) -> Plain:
    """Signals in a few numbers each, certificates, and what is said of the walk."""
    t, s = walk.trajectory, walk.signals
    settings = {k: t.settings[k] for k in ("method", "engine", "why") if k in t.settings}
    return {
        "status": t.status.name,
        "detail": t.detail,
        "settings": settings,
        "note": walk.note,
        "remarks": list(walk.remarks),
        "controller": walk.controller_name,
        "peak error": [s.peak_error],
        "peak torque": [float(np.max(np.abs(s.u), initial=0.0))],
        "signals": {f.name: files.array(np.asarray(getattr(s, f.name))) for f in fields(s)},
        "certificates": [plain(c.record()) for c in walk.certificates],
        "legality": walk.feasibility.text(),
    }


def plain(record: Plain) -> Plain:
    """Numbers as floats."""
    return {k: float(x) if isinstance(x, int | float) else str(x) for k, x in record.items()}


# -- studies ---------------------------------------------------------------------------------------
def cycle(robot: str, controller: str | None, gait: str = "published") -> Plain:
    """A return map's fixed point and its multipliers."""
    found = ba.cycle_stability(ba.find_cycle(robot, None, gait, controller))
    rows = {row.method.value: [float(x) for x in row.magnitudes] for row in found.table.rows}
    return {"x_minus": [float(x) for x in found.orbit.x_minus], "multipliers": rows}


def zero(gait: str) -> Plain:
    """The zero dynamics of a gait."""
    biped = ba.Biped.load("rabbit")
    r = ba.zero_report(biped, ba.load_gait(gait, biped).constraint)
    numbers = [r.zeta_star, r.impulse_ratio, *r.speeds, *r.energies, r.orbits.delta, r.orbits.v_end]
    return {"text": r.text(), "numbers": [float(x) for x in numbers]}


def observer(period: float, **how: Any) -> Plain:
    """The tables of the assistant that chooses an observer."""
    biped = ba.Biped.load("rabbit")
    g = ba.load_gait("published", biped)
    seen = ba.GPIObserver.from_bandwidth(**how) if how else ba.GPIObserver.from_poles(ba.TABLE_I)
    r = observer_report(seen, ba.TABLE_II, period, robot=biped, gait=g)
    return {"verdict": r.verdict, "sections": {s.title: s.lines() for s in r.sections}}


def verification(group: str) -> Plain:
    """Rows of one group of the verification by system and quantity."""
    found: Plain = {}
    for chosen in groups():
        for maker in chosen.makers if chosen.name == group else ():
            for row in maker():
                key = f"{row.system}: {row.quantity}"
                while key in found:
                    key += " again"
                words = {"source": row.source, "note": row.note, "verdict": row.verdict}
                limit = {"tolerance": row.tolerance, "measure": row.measure.value}
                timed = "[s]" in row.quantity and group == "design"
                value = {} if timed else {"found": [float(row.found)]}
                found[key] = {**words, **limit, "expected": [float(row.expected)], **value}
    return found


def reports() -> dict[str, Callable[[], Plain]]:
    """All of them by name; each is made by itself."""
    found: dict[str, Callable[[], Plain]] = {}
    for name in STORED:
        found[f"run/{name}"] = lambda name=name: stored(name)
    for name in PASSIVE:
        found[f"run/{name}"] = lambda name=name: stored_passive(name)
    for name in MADE:
        found[f"walk/{name}"] = lambda name=name: made(name)
    found |= {
        "cycle/compass": lambda: cycle("compass", None),
        "cycle/NPD": lambda: cycle("rabbit", "NPD", "v0.8"),
        "cycle/ADRC": lambda: cycle("rabbit", "ADRC"),
        "zero/published": lambda: zero("published"),
        "zero/v0.5": lambda: zero("v0.5"),
        "observer/Table I": lambda: observer(5e-4),
        "observer/bandwidth": lambda: observer(1.5e-3, bandwidth=500.0, m=1),
    }
    for group in groups():
        found[f"verification/{group.name}"] = lambda name=group.name: verification(name)
    return found
