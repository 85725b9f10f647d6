"""Values of a drawn scenario by the dotted names that they have in `biped_adrc.scenario`."""

from __future__ import annotations

from typing import Any

NAMES = {
    "controller": "controller.name",
    "robot": "robot.name",
    "preset": "robot.preset",
    "gait": "gait.name",
    "impacts": "run.impacts",
    "first_step": "run.first_step",
    "continued": "gait.continued",
    "seed": "run.seed",
    "K_p": "controller.K_p",
    "K_d": "controller.K_d",
    "observer": "controller.observer.name",
    "poles": "controller.observer.poles",
    "bandwidth": "controller.observer.bandwidth",
    "order": "controller.observer.order",
    "reset": "controller.observer.reset",
    "contact": "controller.contact.name",
    "contact_window": "controller.contact.window",
    "prediction": "controller.prediction",
    "feedforward": "controller.feedforward",
    "solve_theta": "controller.solve_theta",
    "hardware": "hardware.profile",
    "period": "hardware.period",
    "delay": "hardware.delay",
    "delay_known": "hardware.delay_known",
    "counts": "hardware.encoders.counts",
    "noise": "hardware.encoders.noise",
    "pitch_noise": "hardware.encoders.pitch_noise",
    "rate_noise": "hardware.encoders.rate_noise",
    "velocity": "hardware.encoders.velocity",
    "filter_time": "hardware.encoders.filter_time",
    "sensor": "hardware.sensor.name",
    "touchdown": "hardware.touchdown.name",
    "torque_limit": "hardware.torque_limit",
    "rate_limit": "hardware.rate_limit",
    "lag": "hardware.lag",
    "friction": "hardware.friction",
    "push": "pushes.0.shape",
    "on": "pushes.0.joints",
    "amplitude": "pushes.0.torque",
    "force": "pushes.0.force",
    "direction": "pushes.0.direction",
    "pushed_step": "pushes.0.step",
    "onset": "pushes.0.onset",
    "duration": "pushes.0.duration",
    "frequency": "pushes.0.frequency",
    "mass": "errors.mass",
    "inertia": "errors.inertia",
    "mass_error": "errors.mass_width",
    "com_error": "errors.com_width",
    "inertia_error": "errors.inertia_width",
    "friction_error": "errors.friction_width",
    "trunk_load": "errors.trunk_load",
    "impact_error": "errors.impact_width",
    "plant": "ground.plant",
    "ground_friction": "ground.friction",
    "time_constant": "ground.time_constant",
    "damping_ratio": "ground.damping_ratio",
    "plant_step": "ground.plant_step",
    "slope": "ground.slope",
    "ground_step": "ground.drop",
    "ground_rms": "ground.rms",
    "start_speed": "start.speed",
    "start_speed_spread": "start.speed_spread",
    "start_spread": "start.spread",
    "start_rate_spread": "start.rate_spread",
    "friction_limit": "limits.friction",
    "force_window": "limits.window",
    "method": "run.method",
    "h": "run.h",
    "fine": "run.fine",
    "tolerance": "run.tolerance",
    "engine": "run.engine",
    "max_step_time": "run.max_step_time",
    "runaway_speed": "run.runaway_speed",
    "runaway_torque": "run.runaway_torque",
}


def dotted(fields: dict[str, Any]) -> dict[str, Any]:
    """The fields of a drawn scenario by dotted name; a step of the ground and a push share theirs."""
    made: dict[str, Any] = {}
    pushed = fields.get("push", "none") != "none"
    for name, x in fields.items():
        new = NAMES.get(name, name)
        if name == "on" and x.startswith("link "):
            made["pushes.0.link"] = x.removeprefix("link ")
        elif name == "on" and x == "random joints":
            made[new] = "random"
        elif name == "pushed_step" and "ground_step" in fields:
            made["ground.drop_step"] = x
            made |= {new: x} if pushed else {}
        elif not new.startswith("pushes.") or pushed:
            made[new] = x
    return made
