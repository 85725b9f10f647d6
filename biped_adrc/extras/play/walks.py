"""The walks of the page on which a user pushes the robot, as numbers that the script machine.js reads.

The block is the memory of a compiled run, cells of 8 bytes (`engine.kernels.record`); a plan is the block of a
run that has not begun. Some of the cells are the numbers (parameters) of the walker, which sliders of the page
change. The structure of a walker is all of it but the values of these numbers: it decides the machine code. A
delay of the torque changes the structure, so a walk has several variants, one for each range of delays.

The hand is the push of the user: two terms of the disturbance, a torque on the coordinates and a force on a
link. The page writes their numbers into the block before each sample.

The force acts on a point of a link, whose place from the stance foot is the real and the imaginary part of
the sum over k of (re_k + i im_k) exp(i a_k), where a = A q (n,) [rad] are the absolute angles of the links that
follow from the coordinates q (n,). re and im (n,) [m] are affine in the place (x, z) on the link: for each link
that is drawn, the page gets their values at (0, 0) and their slopes along x and z. turn (n,) is the derivative
of the link's angle by q.
"""

import base64
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self, cast

import numpy as np

from biped_adrc.closed_loop.instant_signals import signals_at
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.footstep import Footstep
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Sum
from biped_adrc.disturbances.force import OnLink
from biped_adrc.disturbances.waves import TorqueStep
from biped_adrc.engine.kernels.compiled_run import STATUS
from biped_adrc.engine.kernels.record import FUNCTIONS, PLACES, Ints
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.program import CompiledWalker
from biped_adrc.engine.structure import paths
from biped_adrc.extras.play.sliders import Form, Slider, forms_of, numbers_at, sliders
from biped_adrc.extras.play.webassembly import WebWalker, web_walkers
from biped_adrc.hardware.motors import whole_and_part
from biped_adrc.hybrid.constants import STRUCK
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import link_point, point, turned
from biped_adrc.model.robots.urdf import twins
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, limits
from biped_adrc.scenario.integration import methods_of
from biped_adrc.scenario.scenario import Scenario, scenario_lines
from biped_adrc.studies.build import scene_of
from biped_adrc.view.meshcat.objects import visual_links
from biped_adrc.view.placement import exchanged, joint_values

MOST = {"force": 300.0, "torque": 200.0}
"""Largest force [N] of a hand, about the weight of RABBIT, and largest torque on one coordinate [N m]."""
SPRING = {"stiffness": 1500.0, "damping": 40.0}
"""Spring from the mouse (anchor) to the point p: F = k (anchor - p) - d p', at most MOST, k [N/m], d [N s/m]. F
is constant over a sample T [s], which reduces the damping by k T / 2."""
DELAY, FRICTION = "hardware.delay", "hardware.friction"
"""Names of two values of a scenario whose sliders are made apart from all others."""
_SAME = 1e-9
"""Largest distance [m] between two points that are taken for one."""


@dataclass(frozen=True)
class PageWalk:
    """One variant of a walk of a page, with its own machine code, at its start at 0 s."""

    scenario: Scenario
    scene: RobotAndGait
    walker: Walker
    """The walker without the hand; with joint friction, if the robot's record has some, so that its slider can
    change it even where the scenario has none."""
    code: CompiledWalker
    """The compiled walker, with the hand as its whole disturbance."""
    x: Array
    """State at the start (nx,)."""

    @classmethod
    def of(cls, name: str, s: Scenario, scene: RobotAndGait | None = None) -> Self:
        """Build and compile the walk of a scenario; name: for messages. scene: its robot and gait, built if
        None.

        Raises InputError, with the name, for a walk that a page cannot compute.
        """
        # rubbed: the scenario with joint friction, taken if the robot has coefficients of friction; these are
        # without error, since the slider scales them
        plant, fine = s.ground.plant, s.run.fine
        if plant != RIGID or fine is not None:
            raise InputError(
                f"the walk '{name}' is on plant '{plant}' with run.fine = {fine}; a page takes '{RIGID}' and "
                "steps of one length"
            )
        rubbed = s.replace({"hardware.friction": True, "errors.friction": 0.0})
        if scene is None:
            scene = scene_of(s)
            scene.walked  # noqa: B018  # a robot without motors is refused
            if any(map(np.any, scene.biped.friction_coefficients)):
                scene = scene_of(rubbed)
        walker = build(rubbed if scene.biped.friction else s, scene)
        law = walker.controller
        if isinstance(law, Footstep) and not law.speeds:
            # the slider of the speed leaves the first step, with which the walk begins, as it is
            return cls.of(name, s.replace({"controller.speeds": [law.speed]}), scene)
        if not walker.sampled:
            raise InputError(
                f"the walk '{name}' is controlled at every instant, and that of a page at sample instants; "
                "give a period, as hardware = 'ideal' or hardware.period = '1 ms'"
            )
        if walker.disturbance is not None:
            raise InputError(f"the walk '{name}' has a push of its own; leave it out")
        x = walker.initial_state(*scene.start(s), Mode(s.run.first_step))
        try:
            code = walk_code(s, scene, with_hand(walker), x)
        except NotCompiled as reason:
            raise InputError(
                f"the walk '{name}' does not run in machine code as a whole: {reason}"
            ) from reason
        return cls(s, scene, walker, code, x)

    @property
    def mode(self) -> Mode:
        """The first single support of the walk."""
        return Mode(self.scenario.run.first_step)

    @cached_property
    def names(self) -> dict[str, int]:
        """Name of each number (parameter) of the walker -> the index of its cell in the block."""
        # cell of the first parameter; `paths` names them in their order
        first = self.code.plan.place("K")
        return {name: first + k for k, name in enumerate(paths(self.code.program.numbers))}

    @cached_property
    def numbers(self) -> Array:
        """All cells of the block at the start of the walk, as floats; `names` has the indices of parameters."""
        return self._block(self.code)

    @cached_property
    def rubbed(self) -> Scenario:
        """The scenario with joint friction on, if `walker` has it."""
        return self.scenario.replace({FRICTION: self.walker.plant.friction})

    def at(self, values: Mapping[str, object]) -> Array:
        """All cells of this walk's block, as floats, for other values of its scenario, by name.

        Raises InputError for values that give the machine code another structure.
        """
        s = self.rubbed.replace(values)  # the scenario, with joint friction if the robot has some
        # with the hand of the present walker
        walker = replace(build(s, self.scene), disturbance=self.code.walker.disturbance)
        code = walk_code(s, self.scene, walker, self.x)
        # key: the structure that decides the machine code
        if code.program.key != self.code.program.key:
            raise InputError("another structure")
        return self._block(code)

    def _block(self, code: CompiledWalker) -> Array:
        """The block at the start of a walk of a compiled walker, as floats, with 0 in place of addresses.

        Blocks are compared to find the numbers that a slider changes.
        """
        # from x at 0 s in the single support (number, start); the page itself sets the end, here 0 s
        result = code.plan.start(self.x, 0.0, *self.mode, 0.0).block.view(np.float64).copy()
        # FUNCTIONS: fields with addresses of functions; PLACES: field -> cell
        for name in FUNCTIONS:
            result[PLACES[name]] = 0.0  # an address, which differs from process to process
        return np.nan_to_num(result)  # cells of whole numbers may read as NaN, which equals nothing

    def sliders(self) -> dict[str, tuple[Slider, dict[str, Form]]]:
        """Sliders of the walk by name, without that of the delay: (slider, name of each parameter that it
        changes -> dependence on the slider's value, a `Form`).
        """
        # a slider that also changes cells without a name is left out. rubbed: the scenario with joint friction;
        # at: all cells of the block for other values of it
        law, named = self.walker.controller, {k: name for name, k in self.names.items()}
        result = {
            name: (one, {named[k]: form for k, form in forms.items()})
            for name, (one, forms) in sliders(self.rubbed, law, self.numbers, self.at).items()
            if forms.keys() <= named.keys()
        }
        # coefficients of friction are proportional to their slider: a + b s^k with a = 0, k = 1
        rubbing = {
            name: (0.0, float(self.numbers[k]), 1)
            for name, k in self.names.items()
            if name.startswith("plant.friction[") and self.numbers[k] != 0.0
        }
        if rubbing:
            s = self.scenario
            share = 1.0 + s.errors.friction if s.hardware.friction else 0.0
            # from 0 to 3 times the robot's friction, linear, in units of 1; share: that of the scenario, with
            # which the walk begins; True: for both walks of the page
            one = Slider(FRICTION, 0.0, 3.0, False, "×", 1.0, share, True)
            result[FRICTION] = one, cast(dict[str, Form], rubbing)
        return result

    def delay(self) -> dict[int, Form]:
        """Index of each cell of the block that changes with the delay within `delays` -> its form over the
        delay [s]; empty for a delay of whole periods.
        """
        low, high = self.delays
        if low == high:
            return {}
        # away from both ends, at which the machine code has another structure; False: not logarithmic
        inside = Slider(DELAY, low + 0.1 * (high - low), high - 0.1 * (high - low), False)
        # at(values): all cells of the block for these values of the scenario
        return forms_of(inside, self.numbers, numbers_at(inside, self.at))

    @property
    def delays(self) -> tuple[float, float]:
        """Range of delays [s] for which this variant is right: between two multiples of the period, or its own
        delay twice where that is a multiple.
        """
        period, delay = self.walker.clock.period, self.walker.clock.delay
        whole, part = whole_and_part(delay, period)
        return (whole * period, (whole + 1) * period) if part > 0.0 else (delay, delay)


def walk_code(s: Scenario, scene: RobotAndGait, walker: Walker, x: Array) -> CompiledWalker:
    """Compile a walker that has a hand, for states of the layout of x (nx,), with the scenario's method of
    integration and the errors of its signals from the gait. Raises NotCompiled.
    """
    # [0]: the method; [1] would be a finer step where a push switches. 0.0: the run begins at 0 s
    method = methods_of(s.run, walker)[0]
    # loaded=False: no machine code is put into memory here, since the page runs WebAssembly
    layout, curve = walker.layout_of(x), scene.walked.constraint
    return CompiledWalker.of(walker, method, layout, 0.0, curve, loaded=False)


def variants(name: str, s: Scenario, samples: int) -> list[PageWalk]:
    """The walk of a scenario, followed by its variants for other ranges of the delay, up to `samples` periods.

    name: for messages. samples = 0: no other delay. A walk whose parts take no delay has no variants.
    """
    # delays 0 and within each period: see `PageWalk.delays`
    result = [PageWalk.of(name, s)]
    period = result[0].walker.clock.period
    for delay in (0.0, *((k + 0.5) * period for k in range(samples))) if samples else ():
        try:
            one = PageWalk.of(name, s.replace({DELAY: delay}), result[0].scene)
        except InputError:
            continue  # a part of this walk takes no delay
        if one.delays not in [x.delays for x in result]:
            result.append(one)
    return result


def with_hand(walker: Walker) -> Walker:
    """The walker with the hand as its disturbance: a torque on the coordinates and a force on the trunk, both
    zero; the page changes values and link.
    """
    # amplitudes: (F_x, F_z, moment) of the force, n torques of the other term
    force = OnLink(walker.plant, walker.plant.description.trunk, TorqueStep(np.zeros(3)))
    return replace(walker, disturbance=Sum() + TorqueStep(np.zeros(walker.plant.n)) + force)


def page_numbers(walks: Mapping[str, list[PageWalk]]) -> dict[str, Any]:
    """The settings about walks that machine.js reads, by name; vectors are in base64. Raises InputError.

    walks: name -> the walk with its variants, the first one at the delay of its scenario.

    walks       by name the result of `walk_numbers`: scenario as lines, sliders, variants
    code        bytes of the WebAssembly module; functions: names in the order of their numbers (`webassembly`)
    links       `link_numbers`; twins: link -> the same link of the other leg; trunk: its name
    n, R        number of coordinates; relabelling q+ = R q- of the legs at an impact
    joints      for each drawn joint the index of its coordinate, or -1, -2 for x and z of the trunk
    exchanged   whether legs are drawn with exchanged names, in odd and in even single supports
    spring      stiffness [N/m] and damping [N s/m] of the hand's spring
    places      name of a field of the block -> its cell; struck: code of a flow that ends in an impact
    status      text of each status, by code; signals: `signal_places`
    """
    # structures: all variants of all walks; blocks: id of a variant -> its `WebWalker`
    structures = [one for result in walks.values() for one in result]
    first = structures[0]
    code, names, walkers = web_walkers([one.code for one in structures])
    blocks = dict(zip(map(id, structures), walkers, strict=True))
    plant = first.walker.plant
    # SPRING: stiffness and damping between mouse and point; STRUCK: code of an impact
    return {
        "code": packed(code),
        "functions": names,
        "walks": {
            name: walk_numbers(result, [blocks[id(one)] for one in result])
            for name, result in walks.items()
        },
        "n": plant.n,
        "links": link_numbers(plant, [link for _, link in visual_links(plant.tree)]),
        "twins": twins(plant.tree, plant.description.feet),
        "trunk": trunk_of(plant),
        "joints": joint_places(plant),
        "exchanged": [exchanged(plant, step) for step in (1, 2)],
        "R": plant.R.tolist(),
        "spring": SPRING,
        "places": PLACES,
        "struck": STRUCK,
        # name and first words of the text of each status
        "status": [(x.name.lower().replace("_", " "), x.value.split(";")[0]) for x in STATUS],
        "signals": signal_places(first),
    }


def packed(data: bytes | Ints) -> str:
    """Encode bytes, or the bytes of a vector of whole numbers, as text in base64."""
    return base64.b64encode(data if isinstance(data, bytes) else data.tobytes()).decode("ascii")


def walk_numbers(walk: list[PageWalk], blocks: list[WebWalker]) -> dict[str, Any]:
    """The numbers of one walk for machine.js: its scenario as lines, first single support, sliders, variants.

    walk: the walk and its variants, of which the first has the scenario's delay. blocks: the `WebWalker` of
    each.
    """
    first, result = walk[0], walk[0].sliders()
    shown = [one._asdict() for one, _ in result.values()]
    if len(walk) > 1:
        high, delay = max(one.delays[1] for one in walk), first.walker.clock.delay
        # from 0 to the longest delay of a variant [s], linear, displayed in ms, for both walks of the page
        shown.append(Slider(DELAY, 0.0, high, False, "ms", 1e3, delay, True)._asdict())
    return {
        "lines": scenario_lines(first.scenario),
        "firstStep": first.mode.step,
        "sliders": shown,
        "variants": [
            structure_numbers(one, web, result) | {"asGiven": one is first}
            for one, web in zip(walk, blocks, strict=True)
        ],
    }


def structure_numbers(
    walk: PageWalk, web: WebWalker, found: Mapping[str, tuple[Slider, dict[str, Form]]]
) -> dict[str, Any]:
    """The numbers of one variant of a walk for machine.js: the block, clock, limits of ground and motors, and
    the indices in the block of the numbers that the hand and the sliders change.

    found: result of `PageWalk.sliders` of the first variant; its indices are found here by name.
    """
    # start: (state, time, number of the single support, its start, end of the run), here all times 0 s
    s, block = walk.scenario, web.plan.start(walk.x, 0.0, *walk.mode, 0.0).block
    # the machine code has full friction; the walk begins with the share of its slider
    if FRICTION in found:
        slider, forms = found[FRICTION]
        for name in forms:
            block.view(np.float64)[walk.names[name]] *= cast(float, slider.value)
    known, limit = limits(s).of(walk.walker.plant.description), s.hardware.torque_limit
    moved = {
        name: (one.table, [(walk.names[at], form) for at, form in forms.items()])
        for name, (one, forms) in found.items()
    }
    return {
        "cells": packed(block),
        # indices of the cells with the place of a vector in the block; the page adds the block's address
        "pointers": web.plan.pointers.tolist(),
        "nx": web.plan.nx,
        "observe": web.observe,  # number of the function of all signals
        "period": walk.walker.clock.period,
        "restart": walk.walker.clock.restart,
        "delays": walk.delays,
        "slope": walk.walker.ground_slope,
        "limits": {"friction": known.friction, "torque": known.torque if limit is None else limit},
        "hand": hand_places(walk.code),
        # of each slider its table (none for the delay), and pairs (index in the block, form)
        "sliders": moved | {DELAY: ((), [*walk.delay().items()])},
    }


def hand_places(code: CompiledWalker) -> dict[str, Any]:
    """Indices in the block of the hand's torque (n,) and force (2,), and the first ones of re, im and turn (n,)
    of its point.
    """
    # the hand has the terms of `with_hand`: [0] a torque on the coordinates, [1] a force on a link
    hand, first = code.walker.disturbance, code.plan.place("push")
    assert hand is not None
    # from the cell "push" on stand the numbers of the disturbance, in the order of `paths`
    at = {name: first + k for k, name in enumerate(paths(hand.terms))}
    return {
        "torque": [at[f"[0].amplitude[{k}]"] for k in range(code.walker.plant.n)],
        # (F_x, F_z); the moment behind them stays zero
        "force": [at[f"[1].wave.amplitude[{k}]"] for k in range(2)],
        **{name: at[f"[1].point.{name}[0]"] for name in ("re", "im", "turn")},
    }


def link_numbers(plant: Biped, links: list[str]) -> dict[str, Any]:
    """A (n, n), and for each link by name the formula of its points, as in the module.

    re, im (3, n) [m]: at the link's (0, 0), and their slopes along x and z [1]; turn (n,).
    """
    result, places = dict[str, Any](), ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
    for link in dict.fromkeys(links):
        # affine in (x, z): the values at the origin, and the differences to 1 m along x and along z
        corner, *others = (link_point(plant, link, at) for at in places)
        result[link] = {
            name: [getattr(corner, name).tolist()]
            + [(getattr(other, name) - getattr(corner, name)).tolist() for other in others]
            for name in ("re", "im")
        } | {"turn": corner.turn.tolist()}
    return {"A": link_point(plant, links[0]).A.tolist(), "of": result}


def trunk_of(plant: Biped) -> str:
    """Name of the trunk, the link whose origin is the floating base of the drawn robot.

    Raises InputError for a robot whose trunk lies elsewhere.
    """
    # at a posture without symmetry, the link's origin and the base agree only if they are the same point
    q = np.random.default_rng(0).standard_normal(plant.n)
    # values: of all joints of the URDF by name, with the stance foot at (0, 0)
    # k: the link's origin from the stance foot; turned(A, q): the exp(i a_k) of the module; base: place (x, z)
    # of the floating base
    values, trunk = joint_values(plant, q), plant.description.trunk
    k = link_point(plant, trunk)
    base = np.array([values[name] for name in plant.description.base])
    if np.max(np.abs(point(turned(k.A, q), k.re, k.im) - base)) > _SAME:
        raise InputError(
            f"robot '{plant.description.name}' is drawn from a base that is not the origin of its trunk "
            f"'{trunk}'; a page expects that"
        )
    return trunk


def joint_places(plant: Biped) -> list[int]:
    """For each joint that moves, in the tree's order, the index of its coordinate, or -1 and -2 for x and z of
    the floating base.
    """
    d = plant.description
    places = {name: k for k, name in enumerate(d.joints)} | {d.base[0]: -1, d.base[1]: -2}
    return [places[joint.name] for joint in plant.tree.joints if joint.type != "fixed"]


def signal_places(walk: PageWalk) -> dict[str, tuple[int, int]]:
    """Name of each signal -> where it begins and ends (index, index) in the result of the function
    `WebWalker.observe`, found by one evaluation at the start of the walk.
    """
    h = walk.scene.walked.constraint
    # the last argument: the reference, from its arguments s (the controller's state) and m (the measurement)
    result = signals_at(walk.walker, 0.0, walk.x, walk.mode, lambda s, m: h(m.t, m.q, m.v))
    ends = np.cumsum([np.size(part) for part in result]).tolist()
    return dict(zip(result._fields, zip([0, *ends[:-1]], ends, strict=True), strict=True))
