"""Walks side by side have the bits that each has alone, whatever their number, neighbours and the width are."""

import re
from dataclasses import dataclass, replace
from itertools import product

import casadi as ca
import numpy as np
import pytest
from llvmlite import binding

import biped_adrc as ba
from biped_adrc.engine import ir, lanes
from biped_adrc.engine.batch import Preparation, Ready, simulate_many, strides, walks_of
from biped_adrc.engine.calls import FUNCTION
from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.lanes import SIDE_BY_SIDE, Lanes
from biped_adrc.engine.machine import load_or_compile
from biped_adrc.engine.program import CompiledWalker
from biped_adrc.studies.build import trial_of

SAMPLED = {"hardware.period": "1 ms", "run.impacts": 2}
BEHIND_ENCODERS = {"hardware.profile": "rabbit", "hardware.delay": "2 ms", "run.h": "0.5 ms"}
SETTINGS = {
    "pushes": {"pushes": "q1,q2=20@1:0.1-0.2:rise=0.01", **SAMPLED},
    "a period of 1.5 ms, and a torque that waits for a part of it": {
        "controller.name": "NPD",
        **BEHIND_ENCODERS,
    },
    "lagging motors, each with a time of its own": {
        "hardware.lag": None,
        "controller.name": "NPID",
        **SAMPLED,
    },
    "lagging motors": {"hardware.lag": "2 ms", "controller.name": "NPID", **SAMPLED},
    "torques beyond their bound at a sample instant": {"hardware.lag": "3 ms", **SAMPLED},
    "a force on the hip": {
        "pushes": [{"shape": "hip force", "force": 5.0}],
        **SAMPLED,
    },
    "steps shorter than the period": {"run.h": "0.4 ms", "ground.drop": 0.004, **SAMPLED},
    "touchdowns noticed by kinematics": {"hardware.touchdown.name": "kinematics", **SAMPLED},
}

KEPT = [*SETTINGS][:-1]
"""Those of which nodes are kept: where a touchdown is noticed late a batch leaves the whole run."""


@dataclass(frozen=True)
class Bent(ba.NPDController):
    """NPD whose torque is bent by functions of the C library."""

    def output(self, s, m):
        u = super().output(s, m)
        return 150.0 * np.tanh(u / 150.0) + np.exp(-np.abs(u)) + np.arctan(u) ** 3


def cases(values, count=6, curve=True):
    """Walks of a scenario with masses, starts and numbers of impacts of their own; the last two fail."""
    factors = [*(1.0 + 0.01 * k for k in range(count - 2)), 3.0, 0.2]
    for k, factor in enumerate(factors):
        more = {"run.seed": k, "errors.mass_width": 0.05, "run.impacts": 1 + k % 3}
        if "hardware.lag" in values and values["hardware.lag"] is None:
            more["hardware.lag"] = 1e-3 + 2e-4 * k
        case = trial_of(ba.Scenario("ADRC").replace(values | more)).case
        yield replace(case, v=factor * case.v, curve=case.curve if curve else None)


def same(one, other):
    """Whether two walks are equal to the last bit."""
    names = ("times", "x_minus", "final_state", "t_end", "table")
    pairs = ((getattr(one, x), getattr(other, x)) for x in names)
    equal = (np.array_equal(a, b, equal_nan=True) if a is not None else b is None for a, b in pairs)
    return one.status is other.status and all(equal)


def beside(ready, width):
    """The walks of cases that are ready, in so many lanes."""
    walks = [one.going() for one in ready]
    code = Lanes.of(ready[0].compiled, bool(ready[0].read), width)
    while going := [walk for walk in walks if walk.left > 0]:
        for walk, status in zip(going, code.run([walk.next() for walk in going]), strict=True):
            walk.add(status)
    return [walk.walk() for walk in walks]


@pytest.mark.parametrize(("name", "curve"), [*product(SETTINGS, [False]), *product(KEPT, [True])])
def test_walks_side_by_side_are_those_alone(name, curve):
    """Statuses, times, states and tables of walks with other masses, starts and ends, for 1, 2 and 4 lanes."""
    ready = [Preparation()(case) for case in cases(SETTINGS[name], curve=curve)]
    assert all(isinstance(one, Ready) for one in ready)
    assert len({one.key for one in ready}) == 1
    assert ready[0].key is not None
    alone = [one() for one in ready]
    assert any(walk.status is not ba.Status.COMPLETED for walk in alone)
    for width in (1, 2, 4):
        assert all(map(same, alone, beside(ready, width)))


def test_functions_of_the_C_library_are_called_lane_by_lane(biped, gait):
    walker = ba.Walker(biped, Bent(gait.constraint), timing=ba.SampledTime(1e-3))
    plain = ba.Case(walker, gait=gait, method=ba.RK4(1e-3), impacts=1)
    ready = [Preparation()(replace(plain, v=plain.v * (1.0 + 0.01 * k))) for k in range(5)]
    assert all(map(same, (one() for one in ready), beside(ready, 4)))


@pytest.mark.parametrize("push", [None, ba.TorquePulse((20.0, -10.0, 0.0, 0.0, 0.0), 1, 0.1, 0.2)])
def test_steps_in_continuous_time_are_those_of_walks_alone(biped, gait, push):
    """RK4 under NPD, with starts of their own; two do not complete."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), push)
    one = ba.Case(walker, gait=gait, method=ba.RK4(1e-3), impacts=2)
    factors = (1.0, 1.01, 1.02, 0.98, 0.99, 3.0, 0.2)
    ready = [Preparation()(replace(one, v=factor * one.v)) for factor in factors]
    alone = [run() for run in ready]
    assert {walk.status for walk in alone} >= {ba.Status.COMPLETED, ba.Status.RAN_AWAY}
    for width in (1, 2, 4):
        assert all(map(same, alone, beside(ready, width)))


def test_most_samples_are_made_side_by_side():
    """Of a walk of some 400 samples no more than a tenth is walked by itself."""
    ready = [Preparation()(case) for case in cases(SETTINGS["pushes"], 4)][:3]
    going = [one.going() for one in ready]  # they own the memory of their runs
    runs = [one.next() for one in going]
    code = Lanes.of(ready[0].compiled, True, 4)
    team, walks = code.team(runs[0]), np.array([run.address for run in runs])
    codes = np.zeros_like(walks)
    made = lanes.kernels().side_by_side(
        team.run.address, walks.ctypes.data, len(walks), codes.ctypes.data
    )
    longest = max(run["t"] for run in runs) / 1e-3
    assert 0.9 * longest <= made <= longest, (made, longest)


def test_a_batch_of_all_kinds_is_that_of_walks_alone(biped, gait):
    """Two structures side by side, one in continuous time, one in Python; in threads, or in none."""
    some = [*cases(SETTINGS["pushes"], SIDE_BY_SIDE + 3), *cases(SAMPLED, SIDE_BY_SIDE, False)]
    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    some.insert(5, ba.Case(walker, gait=gait, method=ba.RK4(2e-3), impacts=1))
    alone = [Preparation()(case)() for case in some]
    prepare = Preparation()
    assert all(map(same, alone, walks_of([prepare(case) for case in some])()))
    many = [case for case in some for _ in range(2)]
    for threads in (1, 2):
        walks = [*simulate_many(many, threads)]
        assert all(same(alone[k // 2], walk) for k, walk in enumerate(walks))


def test_a_return_map_of_many_starts_is_that_of_each():
    """One single support from each of 21 states, in sampled and in continuous time."""
    case = next(cases(SAMPLED, curve=False))
    for walker in (case.walker, replace(case.walker, timing=ba.ContinuousTime())):
        x = walker.initial_state(case.q, case.v, case.mode)
        compiled = CompiledWalker.of(walker, ba.RK4(1e-4), walker.layout_of(x))
        random = np.random.default_rng(2).normal(0.0, 1e-3, (21, len(x)))
        starts = [(x + d * (np.arange(len(x)) < 10), case.mode) for d in random]
        many = strides(compiled, starts, 2.0)
        each = [strides(compiled, [start], 2.0)[0] for start in starts]
        assert all(map(same, many, each))
        assert not walker.sampled or any(walk.impacts for walk in many)


def test_a_name_that_begins_as_another_one_is_not_taken_for_it():
    """The operands of a function of the C library are lanes of its two values, whatever their numbers are."""
    for count in range(2000):
        listing = ir.Listing("v", 4)
        listing._count = count
        listing.new("call double @pow(double %v1, double %v12)")
        known = {line.partition(" ")[0] for line in listing.lines} | {"%v1", "%v12"}
        names = {name for line in listing.lines for name in re.findall(r"%\w+", line)}
        assert names == known


def test_a_walk_of_another_curve_is_restored_among_many(biped, gait):
    """It has more numbers than the lanes have room for, and goes by itself; the others stay as they are."""
    scenario = ba.Scenario("NPD", hardware={"period": 1e-3})
    other = ba.Stepper(scenario, 1)
    other.reset(seed=1)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=ba.SampledTime(1e-3))
    samples = []
    for count in (SIDE_BY_SIDE, 2):
        stepper = ba.Stepper(walker, count)
        stepper.reset(start=gait.start(biped))
        stepper.restore(1, other.save())
        for _ in range(50):
            sample = stepper.step()
        samples.append(sample.x[:2])
    assert np.array_equal(*samples)


def test_a_stepper_of_many_is_that_of_few():
    """Forces that come and go, a reset and a restore, and verdicts: each of 17 walks, as in pairs."""
    scenario = ba.Scenario("ADRC", hardware={"period": 1e-3}, pushes="q1=20@1:0.1-0.2")

    def run(count, first):
        stepper, random = ba.Stepper(scenario, count, within=ba.Limits()), np.random.default_rng(1)
        for i in range(count):
            stepper.reset(i, seed=first + i)
        kept = list[object]()
        for k in range(430):
            torque, force = random.normal(0.0, 0.5, (17, 4)), random.normal(0.0, 2.0, (17, 2))
            one = slice(first, first + count)
            sample = stepper.step(torque[one], force[one] * (k // 50 % 2))
            if k == 100 and first == 0:
                stepper.reset(1, seed=1)
                stepper.restore(0, stepper.save(1))
            over = [(i + first, repr(x)) for i, x in stepper.over]
            kept.append((sample.t, sample.x, over))
        return kept

    many = run(17, 0)
    for first in (0, 8, 15):
        for all_of, two in zip(many, run(2, first), strict=True):
            one = slice(first, first + 2)
            assert np.array_equal(all_of[0][one], two[0])
            assert np.array_equal(all_of[1][one], two[1])
            assert [x for x in all_of[2] if first <= x[0] < first + 2] == two[2]


@pytest.mark.parametrize("code", sorted(ir._PATTERNS))
def test_each_operation_in_lanes_has_the_bits_of_one(code):
    """On numbers of all sizes, zero, infinities and NaN, by a function of 1, 2, 4 and 8 lanes."""
    x = ca.SX.sym("x", 3)
    a, b, c = x[0], x[1], x[2]
    out = ca.if_else(a, b, c) if code == ir.CHOICE else None
    if code == ca.OP_IF_ELSE_ZERO:
        out = ca.if_else(a, b, 0.0)
    elif out is None:
        out = ca.SX.binary(code, a, b) if "{b}" in ir._PATTERNS[code] else ca.SX.unary(code, a)
    f = SymbolicFunction(ca.SX.sym("K", 0), x, ca.vertcat(out, a))
    ends = [0.0, -0.0, 1.0, -2.5, np.inf, -np.inf, np.nan, 1e300]
    rows = np.array([(p, q, 3.0) for p in ends for q in ends])

    def found(width):
        text = ir.module_text({"f": f}, width)
        call = FUNCTION(load_or_compile(text, ["f"])["f"])
        result = np.zeros((len(rows), 2))
        for i in range(0, len(rows), width):
            inp = np.ascontiguousarray(rows[i : i + width].T)
            part = np.zeros((2, width))
            call(inp.ctypes.data, inp.ctypes.data, part.ctypes.data)
            result[i : i + width] = part.T
        return result

    one = found(1)
    for width in (2, 4, 8):
        assert np.array_equal(found(width), one, equal_nan=True)


@pytest.mark.parametrize(("has", "width"), [({}, 2), ({"avx": True}, 4), ({"avx512f": True}, 8)])
def test_a_processor_has_the_lanes_of_its_registers(monkeypatch, has, width):
    monkeypatch.setattr(binding, "get_host_cpu_features", lambda: has)
    assert lanes.width.__wrapped__() == width
