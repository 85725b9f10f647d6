"""Values of a scenario that are given and do nothing in its walk."""

from __future__ import annotations

from biped_adrc.scenario.scenario import Scenario

RANDOM = (
    *("noise", "pitch_noise", "rate_noise", "sensor", "mass_error", "com_error", "inertia_error"),
    *("friction_error", "impact_error", "ground_rms"),
    *("start_speed_spread", "start_spread", "start_rate_spread"),
)
"""Fields that make something random in a walk; a push of noise, on random joints or without onset does too."""


def idle(s: Scenario) -> tuple[str, ...]:
    """Sentences on values that are given and do nothing in this walk.

    They are said and not refused: a study gives every walk a seed, and old files of runs have such values.
    """
    pushed = s.push != "none"
    drawn_push = pushed and (s.onset is None or s.push == "noise" or s.on == "random joints")
    own = not s.own.keys().isdisjoint(("seed", "touchdown_missed", "missed"))
    random = drawn_push or own or any(map(s.given, RANDOM))
    moved = pushed or s.ground_step != 0.0
    found = (
        ("seed", random, "nothing in this walk is random"),
        ("pushed_step", moved, "there is neither a push nor a step of the ground"),
        ("fine", pushed or s.pushes, "no push switches"),
    )
    return tuple(
        f"{name} = {getattr(s, name)} does nothing: {because}"
        for name, acts, because in found
        if not acts and s.given(name)
    )
