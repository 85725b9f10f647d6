"""Random scenarios: those of the photograph, of which many are driven further than one would walk."""

from __future__ import annotations

from typing import Any

from tests.photograph.draws import Draw
from tests.photograph.scenarios import scenario

SEED = 16_001
Plain = dict[str, Any]


def wild(k: int, seed: int = SEED) -> Plain:
    """Scenario k of the photograph's kinds, half of them with larger pushes, shorter lags and longer steps."""
    drawn, d = scenario(k, seed), Draw(seed + 1, k)
    if d.chance(0.5):
        {"walker": _walker, "trial": _trial, "run": _run, "passive": _passive}[drawn["kind"]](
            drawn, d
        )
    return drawn


def _walker(s: Plain, d: Draw) -> None:
    factor = d.log(1.0, 300.0)
    for push in s["pushes"]:
        for name in ("amplitude", "force"):
            if name in push:
                push[name] = [factor * x for x in push[name]]
        if d.chance(0.3) and "stop" in push:
            push["stop"] += d.even(0.0, 1.0)
    motors = s["hardware"]["motors"]
    if motors is not None:
        motors["lag"] = d.log(1e-8, 1e-1)
    if s["timing"] is not None and d.chance(0.3):
        s["timing"]["period"] = d.log(2e-4, 2e-2)
        s["timing"]["delay"] = round(s["timing"]["period"] * d.even(0.0, 3.0), 9)
    if s["method"] is not None and "h" in s["method"]:
        s["method"]["h"] = d.log(2e-4, 1e-2)
    if d.chance(0.3):
        s["ground"]["slope"] = d.even(-0.3, 0.3)
    if d.chance(0.2):
        s["torque_limit"] = d.log(1.0, 1e4)


def _trial(s: Plain, d: Draw) -> None:
    fields = s["fields"]
    for name in ("amplitude", "force"):
        if name in fields:
            fields[name] = d.log(1.0, 1e4)
    if "lag" in fields or d.chance(0.2):
        fields["lag"] = d.log(1e-8, 1e-1)
    if d.chance(0.2):
        fields |= {"K_p": d.log(1.0, 1e7), "K_d": d.log(0.1, 1e4)}
    if d.chance(0.2):
        fields["period"] = d.log(2e-4, 2e-2)
    if d.chance(0.2):
        fields["start_rate_spread"] = d.log(0.01, 5.0)


def _run(s: Plain, d: Draw) -> None:
    factor = d.log(1.0, 300.0)
    told = []
    for push in s["pushes"]:
        joints, _, rest = push.partition("=")
        torque, _, window = rest.partition("@")
        told.append(f"{joints}={factor * float(torque):.6g}@{window}")
    s["pushes"] = told
    if "h" in s["fields"]:
        s["fields"]["h"] = d.log(2e-4, 1e-2)


def _passive(s: Plain, d: Draw) -> None:
    s["slope"], s["speed"] = d.even(-0.3, 0.3), d.even(-0.9, 3.0)
    if s["hip"] is not None:
        s["hip"] = [100.0 * x for x in s["hip"]]
