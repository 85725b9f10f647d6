"""A walker of the package from the plain values of a scenario."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

import biped_adrc as ba
from biped_adrc.control.clf_qp import CLFQPController
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.finite_time import FiniteTimeController
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.pd_gravity import JointGains, PDGravityController
from biped_adrc.disturbances.base import Sum
from biped_adrc.disturbances.link import OnLink
from biped_adrc.errors import InputError
from biped_adrc.gait.curves import Polynomial
from biped_adrc.observers.high_gain import HighGainObserver
from biped_adrc.observers.momentum import MomentumObserver
from tests.photograph.adapter import own
from validation import three_link

Plain = dict[str, Any]


# -- robot and gait --------------------------------------------------------------------------------
@lru_cache(maxsize=16)
def robot(name: str, preset: str | None, friction: bool) -> Any:
    """The nominal robot."""
    return ba.Biped.load(name, preset, friction)


def gait(s: Plain, biped: Any) -> Any:
    """Its gait, with the curve as the scenario wants it."""
    found = three_link_gait() if s["gait"] == "three-link" else ba.load_gait(s["gait"], biped)
    h = found.constraint
    if s["curve"] == "polynomial":
        h = replace(h, curve=Polynomial(h.curve.power_coefficients))
    return replace(found, constraint=ba.continued(h) if s["continued"] else h)


def three_link_gait() -> Any:
    """The published outputs of the three-link walker, in joint form; its feet pass through the ground."""
    q, v = three_link.before_impact(1.55)
    h = three_link.outputs().as_virtual_constraint()
    return ba.Gait("three-link", "three_link", "westervelt2007", h, q, v, 1.146, {})


def plant(s: Plain, nominal: Any) -> Any:
    """The robot that walks."""
    e = s["errors"]
    if e is None:
        return nominal
    if e["kind"] == "factors":
        return nominal.with_errors(mass=e["mass"], inertia=e["inertia"])
    if e["kind"] == "relative":
        return ba.ModelErrors(mass=e["mass"], com=e["com"]).apply(nominal)
    return ba.ModelErrors.drawn(nominal, e["seed"], *e["widths"]).apply(nominal)


# -- controllers -----------------------------------------------------------------------------------
def gains(c: Plain, default: Any = None) -> Any:
    """Those of the part, or the controller's own."""
    kind = ba.Gains if default is None else type(default)
    if c["gains"] is None:
        return ba.Gains() if default is None else default
    return kind(*(np.array(x) if isinstance(x, list) else x for x in c["gains"]))


def observer(o: Plain) -> Any:
    """An observer of ADRC."""
    kind = o["kind"]
    if kind == "table I":
        return ba.GPIObserver.from_poles(ba.TABLE_I)
    if kind == "poles":
        poles: list[complex] = [*o["poles"]]
        if o["pair"]:
            poles += [complex(poles[0], o["pair"]), complex(poles[0], -o["pair"])]
        return ba.GPIObserver.from_poles(poles)
    if kind in ("bandwidth", "unstable"):
        return ba.GPIObserver.from_bandwidth(o["bandwidth"], o["order"])
    if kind == "high gain":
        return HighGainObserver.from_epsilon(o["epsilon"], m=o["order"])
    made = own.OwnObserver if kind == "own" else own.OwnLawObserver
    return made(w=o["bandwidth"])


def reference(c: Plain, g: Any, biped: Any) -> Any:
    """What a tracking controller follows."""
    kind = c.get("reference", "constraint")
    if kind == "own":
        return own.OwnReference(g.constraint)
    if kind == "time":
        return ba.TimeReference(own.Still(g.start(biped)[0][: biped.p]))
    return g.constraint


def outputs(c: Plain, g: Any, biped: Any) -> Any:
    """Outputs for feedback linearisation."""
    if c["outputs"] == "function":
        return ba.FunctionOutputs(own.CurvedOutput(g.constraint, biped.p))
    if biped.description.name == "three_link":
        return three_link.outputs()
    return ba.LinearOutputs(np.eye(biped.p, biped.n), g.constraint)


def _adrc(c: Plain, g: Any, b: Any) -> Any:
    reset = ba.ResetPolicy.named(c.get("reset", "model"))
    seen = observer(c.get("observer", {"kind": "table I"}))
    solve = c.get("solve_theta", True)
    return ba.ADRCController(reference(c, g, b), seen, gains(c), solve, reset)


def _output_adrc(c: Plain, g: Any, b: Any) -> Any:
    reset = ba.ResetPolicy.named(c["reset"])
    return OutputADRCController(reference(c, g, b), observer(c["observer"]), gains(c), reset)


def _dob(c: Plain, g: Any, b: Any) -> Any:
    seen = MomentumObserver.from_bandwidth(c["bandwidth"], c["order"])
    reset = ba.ResetPolicy.named(c["reset"])
    return MomentumDOBController(reference(c, g, b), seen, gains(c), c["solve_theta"], reset)


def _clf_qp(c: Plain, g: Any, b: Any) -> Any:
    return CLFQPController(g.constraint, c["epsilon"], c["limit"])


def _pd_gravity(c: Plain, g: Any, b: Any) -> Any:
    return PDGravityController(reference(c, g, b), gains(c, JointGains()))


MAKERS: dict[str, Callable[[Plain, Any, Any], Any]] = {
    "NPD": lambda c, g, b: ba.NPDController(
        reference(c, g, b), gains(c), c.get("solve_theta", True)
    ),
    "ADRC": _adrc,
    "ADRC output": _output_adrc,
    "DOB": _dob,
    "PD gravity": _pd_gravity,
    "CLF-QP": _clf_qp,
    "passive": lambda c, g, b: ba.Passive(),
    "output NPD": lambda c, g, b: ba.OutputNPDController(outputs(c, g, b), gains(c)),
    "finite time": lambda c, g, b: FiniteTimeController(outputs(c, g, b), c["alpha"], c["eps"]),
    "own PD": lambda c, g, b: own.OwnPD(g.constraint),
    "own integral": lambda c, g, b: own.OwnIntegral(g.constraint),
    "own continuous": lambda c, g, b: own.OwnContinuous(g.constraint),
    "own ticks": lambda c, g, b: own.OwnTicks(g.constraint),
    "own laws": lambda c, g, b: own.OwnLaws(g.constraint),
    "own raises": lambda c, g, b: own.OwnRaises(g.constraint),
}


def controller(c: Plain, g: Any, biped: Any) -> Any:
    """The controller with what is around it."""
    if c["kind"] not in MAKERS:
        raise InputError(f"there is no controller '{c['kind']}'")
    law = MAKERS[c["kind"]](c, g, biped)
    for a in c["around"]:
        if a["kind"] == "delayed":
            law = Delayed(law, a["delay"], a["order"], a["known"], a["limit"])
        elif a["kind"] == "stride":
            lean = (1.0, 1.0, 0.0, 0.0)[: biped.p]
            K = ba.StrideGains(*a["gains"])
            law = ba.StridePI.on_gait(law, g, biped, K, a["speed"], lean)
        else:
            law = ba.ReferenceReset(law, a["share"])
    return law


# -- pushes ----------------------------------------------------------------------------------------
def wave(d: Plain) -> Any:
    """The window of a push, on joints or (F_x, F_z, M) for a link."""
    kind, window = d["kind"].removeprefix("link "), (d["amplitude"], d["step"], d["start"])
    if kind == "pulse":
        return ba.TorquePulse(*window, d["stop"], rise=d["rise"])
    if kind == "step":
        return ba.TorqueStep(*window)
    if kind == "sine":
        return ba.TorqueSine(*window, d["stop"], d["frequency"])
    if kind == "noise":
        return ba.TorqueNoise(*window, d["stop"], bandwidth=d["bandwidth"], seed=d["seed"])
    return own.OwnWave(*window, d["stop"])


def push(d: Plain, biped: Any) -> Any:
    """One disturbance of `biped`, the plant."""
    kind = d["kind"]
    if kind == "hip":
        steps = None if d["steps"] is None else tuple(d["steps"])
        return ba.HipForce(biped, tuple(d["force"]), steps)
    if kind in ("own", "own laws"):
        made = own.OwnPush if kind == "own" else own.OwnLawPush
        return made(np.array(d["amplitude"]), d["rate"])
    if not kind.startswith("link"):
        return wave(d)
    return OnLink(biped, d["link"], wave(d), None if d["at"] is None else tuple(d["at"]))


def disturbance(s: Plain, biped: Any) -> Any:
    """The sum of all pushes; None without."""
    parts = tuple(push(d, biped) for d in s["pushes"])
    if not parts:
        return None
    return parts[0] if len(parts) == 1 else Sum(parts)


# -- time, hardware, ground ------------------------------------------------------------------------
def timing(s: Plain) -> Any:
    """The clock."""
    t = s["timing"]
    if t is None:
        return ba.ContinuousTime()
    return ba.SampledTime(t["period"], t["restart"], t["delay"], t.get("delay_known", False))


def hardware(s: Plain) -> Plain:
    """Sensors and motors by the walker's names for them."""
    h = s["hardware"]
    found: Plain = {}
    if h["sensors"] is not None:
        found["sensors"] = ba.Sensors(**h["sensors"])
    if h["motors"] is not None:
        found["motors"] = ba.Motors(**h["motors"])
    return found


def ground_steps(s: Plain) -> Any:
    """Where the ground falls or rises."""
    made = {"down": ba.StepDown, "up": ba.StepUp}
    steps = tuple(made[way](step, height) for way, step, height in s["ground"]["steps"])
    u = s["ground"]["uneven"]
    return steps if u is None else (*ba.uneven_ground(u["seed"], u["rms"], 3), *steps)


def walker(s: Plain, nominal: Any, g: Any) -> Any:
    """All of it."""
    made = plant(s, nominal)
    return ba.Walker(
        made,
        controller(s["controller"], g, nominal),
        disturbance(s, made),
        timing(s),
        model=None if made is nominal else nominal,
        torque_limit=s["torque_limit"],
        fall_height=s["fall_height"],
        max_step_time=s["max_step_time"],
        slope=g.slope + s["ground"]["slope"],
        ground_steps=ground_steps(s),
        impact_gain=tuple(s["impact_gain"]),
        **hardware(s),
    )


def method(m: Plain | None) -> Any:
    """A one-step method; None for the default."""
    if m is None:
        return None
    if m["kind"] == "rk4":
        return ba.RK4(m["h"])
    if m["kind"] in ("exponential", "feedback"):
        return ba.Exponential(m["h"])
    made = ba.Adaptive if m["kind"] == "adaptive" else ba.Stiff
    return made(m["tolerance"], m["tolerance"])


def start(s: Plain, g: Any, biped: Any) -> tuple[Any, Any]:
    """(q, v) after the impact of the gait, with what is added."""
    q, v = g.start(biped)
    a = s["start"]
    return q + np.array(a["q"]), (v + np.array(a["v"])) * (1.0 + a["speed"])
