"""Draws of what a walker is put together from: controller, observer, pushes, hardware, ground, errors.

Every part is a dict of plain values with its `kind`. Some do not fit together: what is said then is recorded.
"""

from __future__ import annotations

from typing import Any

from tests.photograph.draws import Draw

Part = dict[str, Any]

CONTROLLERS = {
    "NPD": 16.0,
    "ADRC": 34.0,
    "ADRC output": 9.0,
    "DOB": 9.0,
    "PD gravity": 6.0,
    "CLF-QP": 4.0,
    "passive": 2.0,
    "output NPD": 4.0,
    "finite time": 4.0,
    "own PD": 3.0,
    "own integral": 3.0,
    "own continuous": 1.5,
    "own ticks": 2.0,
    "own laws": 3.0,
    "own raises": 1.0,
    "unknown": 0.5,
}
OBSERVERS = {
    "table I": 22.0,
    "poles": 10.0,
    "bandwidth": 40.0,
    "high gain": 12.0,
    "own": 8.0,
    "own laws": 8.0,
    "unstable": 1.0,
}
RESETS = ("none", "relabel", "measured", "model", "model", "model")
PUSHES = {
    "pulse": 20.0,
    "step": 8.0,
    "sine": 10.0,
    "noise": 10.0,
    "link pulse": 8.0,
    "link step": 4.0,
    "link sine": 5.0,
    "link noise": 5.0,
    "link own": 3.0,
    "hip": 9.0,
    "own": 4.0,
    "own laws": 4.0,
}
LINKS = ("torso", "left_thigh", "right_shin", "left_shin", "right_thigh")


# -- controllers -----------------------------------------------------------------------------------
def observer(d: Draw) -> Part:
    """An observer of ADRC."""
    kind = d.weighted(OBSERVERS)
    part: Part = {"kind": kind}
    if kind == "poles":
        low = d.log(100.0, 400.0)
        part["poles"] = [round(-low * (1.0 + 0.4 * i), 3) for i in range(d.whole(2, 5))]
        part["pair"] = d.even(10.0, 80.0) if d.chance(0.3) else 0.0
    elif kind in ("bandwidth", "own", "own laws", "unstable"):
        part["bandwidth"] = d.log(80.0, 800.0) * (-1.0 if kind == "unstable" else 1.0)
        part["order"] = d.one(0, 1, 1, 1, 2, 3) if kind == "bandwidth" else 1
    elif kind == "high gain":
        part["epsilon"] = d.log(1.5e-3, 1e-2)
        part["order"] = d.one(1, 1, 2)
    return part


def gains(d: Draw, p: int, unit: float = 1.0) -> list[Any] | None:
    """K_p and K_d, numbers or one for each joint; None for the controller's own."""
    if d.chance(0.5):
        return None
    if d.chance(0.04):
        return [-100.0, 10.0]
    if d.chance(0.3):
        return [
            [d.log(1500.0, 8000.0) * unit for _ in range(p)],
            [d.log(30.0, 150.0) * unit for _ in range(p)],
        ]
    return [d.log(1500.0, 9000.0) * unit, d.log(30.0, 200.0) * unit]


def controller(d: Draw, p: int, sampled: bool, linear_outputs_only: bool) -> Part:
    """A controller, perhaps with an outer loop or a delay around it."""
    kind = d.weighted(CONTROLLERS)
    if linear_outputs_only:
        kind = d.one("NPD", "output NPD", "finite time", "PD gravity", "ADRC")
    part: Part = {"kind": kind, "gains": gains(d, p)}
    if kind in ("ADRC", "ADRC output"):
        part |= {"observer": observer(d), "reset": d.one(*RESETS)}
    if kind == "DOB":
        part |= {"bandwidth": d.log(60.0, 500.0), "order": 1 if d.chance(0.04) else d.one(2, 2, 3)}
        part["reset"] = d.one(*RESETS)
    if kind in ("NPD", "ADRC", "DOB"):
        part["solve_theta"] = not d.chance(0.15)
    if kind == "CLF-QP":
        part |= {"epsilon": d.log(5e-3, 5e-2), "limit": d.one(None, 100.0, 150.0)}
    if kind in ("output NPD", "finite time"):
        part["outputs"] = "linear" if linear_outputs_only else d.one("linear", "function")
    if kind == "finite time":
        part |= {"alpha": d.one(0.9, 0.8, 0.95), "eps": d.one(0.1, 0.05)}
    if kind in ("NPD", "ADRC", "ADRC output", "DOB", "PD gravity"):
        part["reference"] = d.weighted({"constraint": 94.0, "own": 4.0, "time": 2.0})
    part["around"] = around(d, sampled)
    return part


def around(d: Draw, sampled: bool) -> list[Part]:
    """Outer loops and delays, from the inside outwards."""
    if d.chance(0.07 if sampled else 0.18) and not (sampled and d.chance(0.7)):
        return [
            {
                "kind": "delayed",
                "delay": d.log(2e-4, 4e-3),
                "order": d.one(1, 2, 4, 4, 11),
                "known": d.chance(0.5),
                "limit": d.one(None, None, 150.0),
            }
        ]
    loops: list[Part] = []
    if d.chance(0.08):
        loops.append({"kind": "reference reset", "share": d.one(0.5, 0.3, 0.9)})
    if d.chance(0.08):
        K = [d.even(-1.0, -0.05), d.even(-0.4, -0.01)]
        loops.append({"kind": "stride", "gains": K, "speed": d.one(None, None, 0.7)})
    return loops


# -- pushes ----------------------------------------------------------------------------------------
def push(d: Draw, n: int, three_link: bool) -> Part:
    """One disturbance."""
    kind = d.weighted(PUSHES)
    if three_link and kind.startswith("link"):
        kind = kind.removeprefix("link ").replace("own", "pulse")
    part: Part = {"kind": kind}
    if kind == "hip":
        part |= {"force": d.normal(8.0, 2), "steps": d.one(None, [1, 1], [2, 3])}
        return part
    if kind in ("own", "own laws"):
        return part | {"amplitude": d.normal(4.0, n), "rate": d.even(0.5, 5.0)}
    on_link = kind.startswith("link")
    part["amplitude"] = [*d.normal(25.0, 2), *d.normal(6.0, 1)] if on_link else _torques(d, n)
    if on_link:
        part |= {"link": d.one(*LINKS), "at": d.one(None, [0.05, -0.1])}
    start, width = d.even(0.0, 0.3), d.even(0.01, 0.15)
    part |= {"step": d.one(None, 1, 1, 2), "start": start}
    shape = kind.removeprefix("link ")
    if shape != "step":
        part["stop"] = round(start + width, 6)
    if shape == "pulse":
        part["rise"] = d.one(0.0, 0.0, 0.01, 0.004)
    if shape == "sine":
        part["frequency"] = d.log(1.0, 40.0)
    if shape == "noise":
        part |= {"bandwidth": d.log(5.0, 80.0), "seed": d.whole(0, 10_000)}
    return part


def _torques(d: Draw, n: int) -> list[float]:
    """On all coordinates, on the joints, or too few of them."""
    torques = d.normal(15.0, n)
    if d.chance(0.6):
        torques[-1] = 0.0
    return torques[:-1] if d.chance(0.02) else torques


def pushes(d: Draw, n: int, three_link: bool) -> list[Part]:
    """None, one, or the sum of two or three."""
    number = d.one(0, 0, 1, 1, 1, 1, 2, 3)
    return [push(d, n, three_link) for _ in range(number)]


# -- time and hardware -----------------------------------------------------------------------------
def timing(d: Draw) -> Part | None:
    """A clock; None for continuous time."""
    if d.chance(0.42):
        return None
    period = d.one(1e-3, 1e-3, 1.5e-3, 5e-4, 2e-3, 3e-3)
    part: Part = {"period": period, "restart": not d.chance(0.15), "delay": 0.0}
    if d.chance(0.35):
        part["delay"] = round(period * d.one(1.0, 2.0, 0.4, 1.6, 0.25), 9)
        part["delay_known"] = d.chance(0.5)
    if d.chance(0.02):
        part["period"] = d.one(-1e-3, 0.5)
    return part


def sensors(d: Draw) -> Part:
    """Encoders and gyros, at the limit of what a walk survives."""
    noisy = d.chance(0.4)
    return {
        "counts": d.one(None, 8192.0, 65536.0),
        "pitch_resolution": d.one(None, None, 1e-4),
        "noise": d.log(1e-6, 1e-4) if noisy else 0.0,
        "pitch_noise": d.log(1e-6, 1e-4) if noisy else 0.0,
        "rate_noise": d.one(0.0, 1e-3) if noisy else 0.0,
        "velocity": d.one("differences", "differences", "measured", "gyro", "tachometer")
        if d.chance(0.05)
        else d.one("differences", "differences", "measured", "gyro"),
        "filter_time": d.one(0.0, 0.0, 2e-3),
        "seed": d.whole(0, 10_000),
    }


def motors(d: Draw) -> Part:
    """Rate limit and lag."""
    return {"rate_limit": d.one(None, 2e4, 1e5), "lag": d.one(0.0, 1e-3, 3e-3)}


def hardware(d: Draw, sampled: bool) -> Part:
    """What is between controller and plant; in continuous time it is refused, which is tried at times."""
    share = 1.0 if sampled else 0.05
    return {
        "sensors": sensors(d) if d.chance(0.35 * share) else None,
        "motors": motors(d) if d.chance(0.3 * share) else None,
        "meter": {"window": d.one(5e-3, 1e-2), "friction": d.one(None, 0.5)}
        if d.chance(0.35 * share)
        else None,
    }


# -- plant, ground and start -----------------------------------------------------------------------
def model_errors(d: Draw, friction: bool) -> Part | None:
    """What is wrong with the nominal model."""
    if d.chance(0.72):
        return None
    kind = d.one("factors", "relative", "drawn")
    if kind == "factors":
        return {"kind": kind, "mass": {"torso": d.even(0.9, 1.2)}, "inertia": {"shin": 1.2}}
    if kind == "relative":
        return {"kind": kind, "mass": {"thigh": d.even(-0.1, 0.2)}, "com": {"shin": 0.05}}
    widths = [d.even(0.0, 0.15) for _ in range(3)] + [0.3 if friction else 0.0]
    return {"kind": kind, "seed": d.whole(0, 1000), "widths": widths}


def ground(d: Draw) -> Part:
    """Slope beside the gait's, and steps."""
    slope = d.one(-0.03, 0.02, 0.05) if d.chance(0.2) else 0.0
    steps: list[list[Any]] = []
    if d.chance(0.15):
        steps = [[d.one("down", "up"), d.one(1, 1, 2), d.log(1e-3, 3e-2)]]
    uneven = {"seed": d.whole(0, 1000), "rms": d.log(1e-4, 1e-2)} if d.chance(0.1) else None
    return {"slope": slope, "steps": steps, "uneven": uneven}


def start(d: Draw, n: int) -> Part:
    """Added to the start of the gait."""
    if d.chance(0.6):
        return {"q": [0.0] * n, "v": [0.0] * n, "speed": 0.0}
    return {
        "q": d.normal(d.one(1e-3, 1e-2, 0.1), n),
        "v": d.normal(d.one(1e-2, 0.1, 1.0), n),
        "speed": d.one(0.0, 0.02, -0.05, 0.1),
    }


# -- methods ---------------------------------------------------------------------------------------
def method(d: Draw, stiff: bool) -> Part | None:
    """A one-step method; None for the default."""
    weights = {"default": 40.0, "rk4": 30.0, "adaptive": 12.0, "exponential": 3.0, "feedback": 3.0}
    if stiff:
        weights |= {"exponential": 22.0, "feedback": 12.0, "rk4": 8.0, "stiff": 8.0}
    kind = d.weighted(weights)
    if kind == "default":
        return None
    if kind in ("adaptive", "stiff"):
        return {"kind": kind, "tolerance": d.one(1e-6, 1e-8) if kind == "stiff" else 1e-8}
    h = d.one(1e-3, 1e-3, 5e-4, 7e-4)
    return {"kind": kind, "h": -h if d.chance(0.015) else h}
