"""Random scenarios: walks as dicts of plain values, drawn without any code of the package.

A scenario has a `kind`: "walker" is put together from parts, "trial" is a walk of the bench, "run" one of the
reproduction and of the command `simulate`, "passive" a robot without motors. `moved` is the direction in which
the start is moved by 1e-14 of itself, to see what a change of round-off does to this walk.
"""

from __future__ import annotations

from typing import Any

from tests.photograph import parts
from tests.photograph.draws import Draw

SEED = 20_261
NUMBER = 300
KINDS = {"walker": 52.0, "trial": 24.0, "run": 17.0, "passive": 7.0}
PRESETS = ("identified", "identified", "identified", "identified-bare", "tac2003")
GAITS = ("published", "published", "recipe", "v0.4", "v0.6", "v0.8", "v1")
DIRECTIONS = 10
"""Numbers of a direction; a walk takes as many as its start has."""

Scenario = dict[str, Any]


def scenario(k: int, seed: int = SEED) -> Scenario:
    """Scenario number k."""
    d = Draw(seed, k)
    kind = d.weighted(KINDS)
    drawn = {"walker": walker, "trial": trial, "run": run, "passive": passive}[kind](d)
    return {"kind": kind, "moved": d.normal(1.0, DIRECTIONS), **drawn}


def impacts(d: Draw) -> int:
    """One to three, mostly one."""
    return int(d.one(1, 1, 1, 1, 1, 2, 2, 2, 3))


def walker(d: Draw) -> Scenario:
    """A walker of any parts."""
    three_link = d.chance(0.07)
    n, p = (3, 2) if three_link else (5, 4)
    clock = parts.timing(d)
    sampled, friction = clock is not None, d.chance(0.12)
    law = parts.controller(d, p, sampled, three_link)
    stiff = not sampled and law["kind"] in ("ADRC", "ADRC output", "DOB")
    method = parts.method(d, stiff)
    if stiff and method is None and law["kind"] == "ADRC output":
        method = (
            {"kind": "rk4", "h": 2e-4} if d.chance(0.7) else {"kind": "stiff", "tolerance": 1e-6}
        )
    return {
        "robot": "three_link" if three_link else "rabbit",
        "preset": None if three_link else d.one(*PRESETS),
        "joint_friction": friction and not three_link,
        "gait": "three-link" if three_link else d.one(*GAITS),
        "curve": "polynomial" if d.chance(0.1) else "stored",
        "continued": d.chance(0.2),
        "controller": law,
        "timing": clock,
        "hardware": parts.hardware(d, sampled),
        "errors": None if three_link else parts.model_errors(d, friction),
        "pushes": parts.pushes(d, n, three_link),
        "ground": parts.ground(d),
        "start": parts.start(d, n),
        "torque_limit": d.one(None, None, None, 150.0, 80.0, 30.0),
        "impact_gain": d.normal(0.02, n) if d.chance(0.08) else [],
        "fall_height": d.one(0.35, 0.35, 0.6),
        "max_step_time": d.one(2.0, 0.9, 0.9, 0.7),
        "method": method,
        "impacts": impacts(d),
        "first_step": d.one(1, 1, 1, 2, 19),
    }


BENCH = ("PD", "NPD", "ADRC", "ADRC", "ADRC output", "LESO", "LESO", "DOB", "CLF-QP")
ON = ("q1,q2,q3,q4", "random joints", "q5", "q1,-q4", "link torso", "link left_shin", "q9")
OFF = {
    "delay": (5e-4, 1e-3, 2.6e-3),
    "counts": (8192.0, 65536.0),
    "noise": (1e-5, 1e-4),
    "velocity": ("differences", "gyro"),
    "torque_limit": (150.0, 60.0),
    "rate_limit": (2e4, 1e5),
    "lag": (1e-3, 4e-3),
    "mass_error": (0.1, 0.3),
    "com_error": (0.1,),
    "inertia_error": (0.2,),
    "trunk_load": (0.2, -0.1),
    "impact_error": (0.02, 0.1),
    "slope": (0.02, -0.03),
    "ground_step": (0.01, -0.01),
    "ground_rms": (2e-3, 1e-2),
    "start_speed": (0.05, -0.1),
    "start_speed_spread": (0.02,),
    "start_spread": (1e-3, 0.05),
    "start_rate_spread": (0.05,),
    "friction": (True,),
    "friction_error": (0.3,),
    "filter_time": (2e-3,),
    "rate_noise": (1e-3,),
    "pitch_noise": (1e-4,),
    "friction_limit": (0.5,),
    "force_window": (1e-2,),
    "delay_known": (True,),
    "reset": ("none", "relabel", "measured"),
    "hardware": ("rabbit",),
    "h": (5e-4,),
    "period": (1.5e-3, 2e-3, 5e-4),
    "max_step_time": (0.8,),
    "K_p": (2500.0, 8000.0),
    "K_d": (40.0, 150.0),
}
"""Fields of a trial that are given at times, and their values."""


def trial(d: Draw) -> Scenario:
    """A walk of the bench, from the fields of its record."""
    controller = d.one(*BENCH)
    fields: Scenario = {"controller": controller, "impacts": impacts(d), "seed": d.whole(0, 9999)}
    fields |= {"preset": d.one(*PRESETS), "gait": d.one(*GAITS), "max_step_time": 0.9}
    for name, values in OFF.items():
        if d.chance(0.12):
            fields[name] = d.one(*values)
    if d.chance(0.85):
        fields = {name: x for name, x in fields.items() if _does_something(name, fields)}
    if controller == "PD":
        fields = {name: x for name, x in fields.items() if name not in ("K_p", "K_d")}
    if controller in ("LESO", "DOB", "ADRC") and d.chance(0.4):
        fields["bandwidth"] = d.log(60.0, 700.0)
        if controller != "DOB":
            fields["order"] = d.whole(0, 3)
    if d.chance(0.6):
        fields |= trial_push(d)
    if d.chance(0.2):
        fields["start"] = {f"q{d.whole(1, 5)}": d.even(-0.05, 0.05), "v5": d.even(-0.3, 0.3)}
    if d.chance(0.04):
        fields |= d.one({"order": 2, "bandwidth": None}, {"lag": -1.0}, {"robot": "roomba"})
    return {"fields": fields}


def _does_something(name: str, fields: Scenario) -> bool:
    """Whether a field of a trial is not refused as one that would do nothing."""
    seen = "differences" if fields.get("hardware") == "rabbit" else "measured"
    velocity = fields.get("velocity", seen)
    idle = {
        "filter_time": velocity == "measured",
        "rate_noise": velocity == "differences",
        "friction_error": not (fields.get("friction") or fields.get("hardware") == "rabbit"),
    }
    return not idle.get(name, False)


def trial_push(d: Draw) -> Scenario:
    """Fields of a push."""
    on, kind = (
        d.one(*ON[:-1]) if d.chance(0.97) else ON[-1],
        d.one("pulse", "step", "sine", "noise"),
    )
    size = {"force": d.log(3.0, 60.0)} if on.startswith("link") else {"amplitude": d.log(1.0, 60.0)}
    fields: Scenario = {"push": kind, "on": on, "pushed_step": 1, **size}
    if on.startswith("link"):
        fields["direction"] = d.even(-3.0, 3.0)
    if d.chance(0.7):
        fields |= {"onset": d.even(0.0, 0.3), "duration": d.even(0.02, 0.3)}
    if kind in ("sine", "noise"):
        fields["frequency"] = d.log(1.0, 40.0)
    return fields


def run(d: Draw) -> Scenario:
    """A run of the reproduction, from the fields of its record."""
    controller = d.one("ADRC", "ADRC", "NPD", "NPD", "ADRC")
    fields: Scenario = {"controller": controller, "impacts": d.one(1, 1, 1, 2)}
    fields |= {"preset": d.one(*PRESETS), "gait": d.one(*GAITS)}
    optional = {
        "period": (1e-3, 1.5e-3),
        "torque_limit": (150.0, 40.0),
        "friction": (True,),
        "K_p": (2500.0, 8000.0),
        "K_d": (40.0, 120.0),
        "continued": (True,),
        "solve_theta": (False,),
        "reset": ("none", "relabel", "measured", "sometimes"),
        "first_step": (2, 19),
        "mass": ({"torso": 1.1}, {"thigh": 1.2, "shin": 0.9}),
        "inertia": ({"shin": 1.3},),
    }
    for name, values in optional.items():
        if d.chance(0.2):
            fields[name] = d.one(*values)
    if controller == "ADRC" and d.chance(0.5):
        fields |= {"bandwidth": d.log(80.0, 800.0), "order": d.whole(0, 3)}
    elif controller == "ADRC" and d.chance(0.3):
        fields["poles"] = [-200.0, -300.0, -450.0, -675.0]
    return {"fields": fields | run_method(d, controller), "pushes": run_pushes(d, fields)}


def run_method(d: Draw, controller: str) -> Scenario:
    """How it is integrated."""
    method = d.one(None, None, "rk4", "exponential", "feedback", "adaptive", "stiff")
    if controller == "NPD" and method in ("exponential", "feedback") and d.chance(0.8):
        method = "rk4"
    fields: Scenario = {} if method is None else {"method": method}
    if method in ("adaptive", "stiff"):
        fields["tolerance"] = 1e-7
    elif d.chance(0.3):
        fields["h"] = d.one(1e-3, 5e-4)
    if d.chance(0.15) and method in ("exponential", "rk4"):
        fields["fine"] = 2e-4
    return fields


def run_pushes(d: Draw, fields: Scenario) -> list[str]:
    """Pushes as the command line has them."""
    first = fields.get("first_step", 1)
    many = d.one(0, 1, 1, 2)
    found = []
    for _ in range(many):
        joints = d.one("q1,q2,q3,q4", "q5", "q1,q3", "torso_pitch") if d.chance(0.97) else "q8"
        torque, start = d.even(-40.0, 40.0), round(d.even(0.01, 0.25), 4)
        stop = round(start + d.even(0.02, 0.12), 4)
        end = d.one("", "", ":sine=7", ":rise=0.005")
        window = f"{start}-" if d.chance(0.15) else f"{start}-{stop}{end}"
        found.append(f"{joints}={torque}@{first}:{window}")
    return found


def passive(d: Draw) -> Scenario:
    """A robot without motors on its slope, perhaps pushed at the hip."""
    robot = d.one("compass", "compass", "rimless_wheel", "simplest")
    return {
        "robot": robot,
        "slope": d.one(0.0, 0.0, 2e-3, 0.01, -0.02),
        "speed": d.one(0.0, 0.0, 0.02, -0.05),
        "hip": d.one(None, None, [0.5, 0.0], [-0.3, 0.2]) if robot == "compass" else None,
        "method": d.one(
            {"kind": "rk4", "h": 1e-3},
            {"kind": "adaptive", "tolerance": 1e-9},
            {"kind": "stiff", "tolerance": 1e-7},
            None,
        ),
        "impacts": impacts(d),
    }
