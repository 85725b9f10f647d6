"""Random walks with touchdowns that are told, policies across contact and soft ground, in both engines.

As `engines`, over the fields of a scenario that have to do with contact. On soft ground the engines differ in
what happens at a sample instant alone, since MuJoCo steps both.
"""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import biped_adrc as ba
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, plant_step, start
from biped_adrc.scenario.run import parts_of
from tests.photograph.draws import Draw
from tests.photograph.scenarios import GAITS, PRESETS, trial_push
from tests.robustness.engines import ENGINES, FAULTS, MOVE, Plain, compared, faults, table

__all__ = ["FAULTS", "drawn", "faults", "judged", "table"]
SEED = 16_003
CONTROLLERS = (
    "ADRC",
    "ADRC",
    "ADRC",
    "LESO",
    "DOB",
    "NPD",
    "ADRC output",
    "stride PI",
    "CLF-QP",
    "PD",
)
POLICIES = ("hold", "fade", "freeze", "keep torque", "impact invariant")
OFF = {
    "delay": (5e-4, 1e-3, 2.6e-3),
    "counts": (8192.0, 65536.0),
    "noise": (1e-5, 1e-4),
    "velocity": ("differences", "gyro"),
    "torque_limit": (150.0, 60.0, 5.0),
    "rate_limit": (2e4, 1e5),
    "lag": (1e-8, 1e-4, 1e-3, 4e-3, 0.1),
    "friction": (True,),
    "mass_error": (0.1, 0.3),
    "impact_error": (0.05,),
    "slope": (0.02, -0.03, 0.2),
    "ground_step": (0.01, -0.01, 0.05),
    "ground_rms": (2e-3, 2e-2),
    "start_speed": (0.05, -0.3),
    "start_rate_spread": (0.05, 1.0),
    "first_step": (2, 19),
    "continued": (True,),
    "reset": ("none", "relabel", "measured"),
    "hardware": ("rabbit",),
    "K_p": (2500.0, 1e6),
    "K_d": (40.0, 2000.0),
}
"""Fields of any walk that are given at times, and their values."""
WINDOWS = (0.0, 1e-9, 1e-3, 0.015, 0.06, 1.0)
Fields = dict[str, Any]


def drawn(k: int) -> Plain:
    """Fields of walk k, two in three of them on soft ground, and the kind."""
    d = Draw(SEED, k)
    kind = d.one("told", "soft", "soft")
    fields: Fields = {"controller": d.one(*CONTROLLERS), "impacts": d.one(1, 2, 2, 3)}
    fields |= {"preset": d.one(*PRESETS), "gait": d.one(*GAITS), "seed": d.whole(0, 9999)}
    fields |= {"period": d.one(1e-3, 1e-3, 2e-3, 5e-4, d.log(2e-4, 1e-2)), "max_step_time": 0.9}
    fields |= {name: d.one(*x) for name, x in OFF.items() if d.chance(0.06)}
    if d.chance(0.5):
        fields |= trial_push(d)
        if "first_step" in fields:
            fields["pushed_step"] = fields["first_step"]
    own = _across_contact(d, fields) | _touchdown(d, fields, kind)
    if kind == "soft":
        own |= _ground(d, fields)
    if "ground_step" in fields:
        fields["pushed_step"] = fields.get("first_step", 1)
    return {"kind": kind, "fields": fields | {"own": own}}


def _across_contact(d: Draw, fields: Fields) -> Fields:
    """A policy and its window, and the own values."""
    if d.chance(0.3):
        return {}
    fields["contact"] = d.one(*POLICIES)
    if fields["contact"] != "keep torque" and d.chance(0.7):
        fields["contact_window"] = d.one(*WINDOWS, d.log(1e-4, 1.0))
    if fields["contact"] == "impact invariant" and d.chance(0.6):
        return {"innovation": d.chance(0.7), "rates": d.chance(0.5)}
    return {}


def _touchdown(d: Draw, fields: Fields, kind: str) -> Fields:
    """How a touchdown is told, and the own values."""
    if d.chance(0.3 if kind == "soft" else 0.1):
        return {}
    fields["touchdown"] = name = d.one("told", "force", "kinematics")
    late, usual = (0.0, 1e-3, 2e-3, 5e-3, 0.05, 1.0), d.one(0.1, 0.0, -0.2)
    gate = {"touchdown_ahead": usual, "after": d.one(0.1, 0.2, 0.0, 2.0), "touchdown_slope": 0.01}
    own = {
        "told": {
            "late": d.one(*late),
            "missed": d.one(0.0, 0.0, 0.3, 1.0),
            "false_at": d.one(None, [1, 0.0], [1, 0.2], [2, 0.1], [3, 1.5]),
        },
        "force": gate
        | {
            "on": d.one(50.0, 50.0, 20.0, 300.0, 1e5),
            "off": 0.0 if d.chance(0.5) else None,
            "debounce": d.one(0.0, 2e-3, 0.02),
            "touchdown_delay": d.one(*late),
        },
        "kinematics": gate | {"height": d.one(0.0, 2e-3, -5e-3, 0.05)},
    }[name]
    return {x: y for x, y in own.items() if y is not None and d.chance(0.6)}


def _ground(d: Draw, fields: Fields) -> Fields:
    """Soft ground, its engine, and the own values."""
    fields |= {"plant": "mujoco", "ground_friction": d.one(0.6, 0.8, 1.0, d.log(0.01, 3.0))}
    fields |= {"time_constant": d.one(2e-3, 5e-3, 0.02, d.log(3e-4, 0.2))}
    if d.chance(0.3):
        fields["damping_ratio"] = d.log(0.05, 5.0)
    if d.chance(0.4):
        fields["plant_step"] = d.one(1e-4, 2e-4, 3.7e-4, d.log(1e-4, 5e-3))
    own = {
        "integrator": d.one("rk4", "leapfrog"),
        "touchdown_force": d.one(1.0, 20.0, 100.0, 1e4),
        "flight_height": d.one(1e-3, 0.05, 1.0),
        "impratio": d.log(1.0, 100.0),
        "foot_radius": d.log(1e-5, 0.02),
        "impedance": d.one([0.9, 0.95], [0.99, 0.99], [1e-3, 0.5]),
    }
    return {x: y for x, y in own.items() if d.chance(0.5 if x == "integrator" else 0.2)}


def judged(k: int) -> Plain:
    """The word for walk k, what it is from, and the statuses of its walks."""
    drawing = drawn(k)
    word, why, status = compared(lambda *given: walked(drawing["fields"], *given))
    return {"k": k, "kind": drawing["kind"], "word": word, "why": why, "status": status}


def walked(fields: Fields, engine: str, moved: Any = None, share: float = 1.0) -> ba.Walk:
    """One walk. moved: random numbers, by which the start is moved. share: of the step's length."""
    s = ba.Scenario(**fields, engine=engine)
    if moved is not None:
        q, v = start(s, RobotAndGait.of(s))
        found = {"q": q * MOVE * moved[: len(q)], "v": v * MOVE * moved[-len(v) :]}
        added = {f"{x}{i + 1}": float(y) for x, row in found.items() for i, y in enumerate(row)}
        s = replace(s, start={name: s.start.get(name, 0.0) + y for name, y in added.items()})
    if s.plant == RIGID:  # of both, since the default steps of the engines differ
        usual = replace(s, engine=ENGINES[0])
        step = getattr(parts_of(usual, build(usual))[0].method, "h", 0.0)
        s = replace(s, h=share * step) if step else s
    elif share != 1.0:
        s = replace(s, plant_step=share * plant_step(s))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ba.walk_scenario(s)
