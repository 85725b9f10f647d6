"""Gaits for any robot: own coordinates, names and structs of other tools, samples over time, own cycles.

biped and gait are RABBIT and its published gait. Fixtures: step, samples (t, q, v) of one simulated step of
this gait; turned, a robot whose phase grows. close(h, gait, within): the curves have the same coefficients to
`within`.
"""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import replace

import numpy as np
import pytest
from scipy.io import savemat

import biped_adrc as ba
from biped_adrc.core.files import data_folder
from biped_adrc.gait.conventions import convention
from biped_adrc.gait.curves import Bezier
from biped_adrc.gait.exchange.importing import read_mat, write_record
from biped_adrc.gait.exchange.record import GaitFile, record_of
from biped_adrc.gait.exchange.samples import Samples, with_legs
from biped_adrc.gait.gait import onto_section
from biped_adrc.gait.zero_dynamics import (
    ZeroDynamics,
    configuration,
    impact_jump,
    invariant_constraint,
)


@pytest.fixture(scope="module")
def turned(tmp_path_factory):
    """RABBIT with a phase that grows, in none of the conventions."""
    folder = tmp_path_factory.mktemp("turned") / "r"
    shutil.copytree(data_folder("urdf") / "rabbit", folder)
    record = folder / "robot.toml"
    text = record.read_text()
    for old, new in (
        ("name = ", 'name = "mine" # '),
        ("[1.0, 0.0, 0.5, 0.0, 1.0]", "[-1.0, 0.0, -0.5, 0.0, -1.0]"),
    ):
        assert old in text
        text = text.replace(old, new, 1)
    record.write_text(text)
    return ba.Biped.load(record)


@pytest.fixture(scope="module")
def step(biped, gait):
    """Samples of a step under NPD, which tracks to 1e-8 rad."""
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1)
    t, once = np.unique(walk.signals.t, return_index=True)
    return Samples(t, walk.signals.q[once], walk.signals.v[once])


def close(h, gait, within=1e-6):
    return np.allclose(
        h.constraint.curve.coefficients, gait.constraint.curve.coefficients, rtol=0.0, atol=within
    )


# -- robots that are not of the package ------------------------------------------------------------


def turned_gait(gait, biped):
    c = gait.constraint
    h = ba.VirtualConstraint(c.curve, -c.phase, -c.theta_plus, -c.theta_minus)
    return replace(gait, robot="mine", constraint=h).check(biped)


@pytest.mark.parametrize("kind", ["json", "mat"])
def test_a_robot_of_its_own_coordinates_gives_and_takes_gaits(turned, gait, tmp_path, kind):
    """`turned` is RABBIT under another name with the phase -Theta, which no convention has. In the convention
    "own" its gait is written and read: phase, q- and curves are the same to the last bit.
    """
    biped = turned
    own, path = turned_gait(gait, biped), tmp_path / f"own.{kind}"
    own.save(tmp_path / "stored.json")
    ba.export_gait(own, path, "own", biped)
    again = ba.import_gait(path, biped)
    assert close(again, own, 0.0)
    assert np.array_equal(again.constraint.phase, own.constraint.phase)
    assert np.array_equal(again.q_minus, own.q_minus)
    assert close(ba.import_gait(tmp_path / "stored.json", biped), own, 0.0)


def test_what_is_wrong_with_an_own_gait_is_said_with_its_own_joints(turned, gait):
    """Row 3 of the curves is the right knee's: 0.1 rad more at its start and the error names this joint, not
    one of a convention. The same record in another convention, or with three rows for four motors, is refused
    too; so is the gait's export in another convention.
    """
    biped = turned
    own = turned_gait(gait, biped)
    c, a = own.constraint, own.constraint.curve.coefficients.copy()
    a[3, 0] += 0.1
    record = GaitFile("own", a, c.theta_plus, c.theta_minus)
    with pytest.raises(ba.BipedError, match="right_knee"):
        ba.import_gait(record, biped)
    for wrong in ({"convention": "paper"}, {"coefficients": a[:3]}):
        with pytest.raises(ba.BipedError):
            ba.import_gait(replace(record, **wrong), biped)
    with pytest.raises(ba.BipedError):
        ba.export_gait(own, "x.json", "frost", biped)


# -- names and structs ------------------------------------------------------------------------------
def entries(gait):
    c = gait.constraint
    return c.curve.coefficients, float(c.theta_plus), float(c.theta_minus)


def test_entries_of_a_struct_are_named(biped, gait, tmp_path):
    """`names` says where in the file an entry of a gait is. Without it, or with a name that the file does not
    have, the message lists what is there, such as "first".
    """
    alpha, plus, minus = entries(gait)
    path = tmp_path / "R.mat"
    savemat(path, {"R": {"alpha": alpha, "th": {"first": plus, "last": minus}}})
    names = {"coefficients": "R.alpha", "theta_plus": "R.th.first", "theta_minus": "R.th.last"}
    assert close(ba.import_gait(path, biped, "paper", names), gait)
    for names in (None, {"coefficients": "R.beta"}):
        with pytest.raises(ba.BipedError, match="first"):
            ba.import_gait(path, biped, "paper", names)


def structs(*rows):
    """A MATLAB array of structs."""
    array = np.empty((1, len(rows)), dtype=[(name, object) for name in rows[0]])
    for place, row in enumerate(rows):
        for name, x in row.items():
            array[0, place][name] = x
    return array


def cells(*rows):
    """A MATLAB cell."""
    array = np.empty((1, len(rows)), dtype=object)
    for place, x in enumerate(rows):
        array[0, place] = x
    return array


@pytest.mark.parametrize("suffix", ["mat", "json"])
def test_elements_of_arrays_are_named(suffix, biped, gait, tmp_path):
    """Places are MATLAB's, counted from 1: element 2 of R, since element 1 has other numbers; curves stacked
    column by column. From JSON only wrong places are tried.
    """
    alpha, plus, minus = entries(gait)
    path, column = tmp_path / f"R.{suffix}", alpha.ravel(order="F")
    steps = [{"a": 0.0 * column, "p": [9.0, 9.0]}, {"a": column, "p": [minus, plus]}]
    if suffix == "mat":
        savemat(path, {"R": structs(*steps), "one": structs({"x": 1.0})})
        assert read_mat(path)["one"] == {"x": 1.0}  # an array of one struct is read as the struct
    else:
        path.write_text(json.dumps({"R": [dict(s, a=[*s["a"]]) for s in steps]}))
    names = {"theta_plus": "R{2}.p(2)", "theta_minus": "R(1,2).p(1)", "coefficients": "R(2).a"}
    if suffix == "mat":
        assert close(ba.import_gait(path, biped, "paper", names), gait)
    for wrong in ("R(3).p(1)", "R(2).p(0)", "R(2).p(3)", "R(2).b"):
        with pytest.raises(ba.BipedError, match=re.escape(wrong)):
            ba.import_gait(path, biped, "paper", names | {"theta_plus": wrong})


def test_rows_of_an_array_are_named_as_optimtraj_stacks_them(step, biped, gait, tmp_path):
    """OptimTraj has one array of angles over rates: rows 1 to 5 are q and 6 to 10 are q', in its own angles."""
    back, path = convention("optimtraj").to_paper.inverse, tmp_path / "soln.mat"
    state = np.column_stack((back.angles(step.q), back.rates(step.v))).T
    savemat(path, {"soln": structs({"grid": {"time": step.t, "state": state}})})
    names = {
        "t": "soln(1).grid.time(:)",
        "q": "soln.grid.state(1:5,:)",
        "v": "soln.grid.state(6:10,:)",
    }
    assert close(ba.import_gait(path, biped, "optimtraj", names), gait)


def frost_domains(step, biped, left):
    """A step and an impact as FROST's exportSolution hands them out: the base first, time along the rows."""
    back = convention("frost").to_paper.inverse
    q, v = (x @ biped.R.T if left else x for x in (step.q, step.v))
    hips = (
        [biped.hip(x) for x in step.q],
        [biped.hip_velocity(x, w) for x, w in zip(step.q, step.v, strict=True)],
    )
    x, dx = (
        np.column_stack(both).T for both in zip(hips, (back.angles(q), back.rates(v)), strict=True)
    )
    params = {"atime": np.arange(24.0)[:, np.newaxis], "ptime": [[step.t[-1]], [0.0]]}
    course = {"tspan": step.t[np.newaxis], "states": {"x": x, "dx": dx}, "params": params}
    return course, {"tspan": [], "states": {"x": x[:, -1:], "xn": x[:, :1]}, "params": {"a": 1.0}}


@pytest.mark.parametrize("left", [False, True])
@pytest.mark.parametrize(
    ("form", "where"),
    [
        ("structs", "gait(1); left out: gait(3)"),
        ("cells", "states(1); left out: states(3)"),
        ("library", "all(2,1)(3); left out: all(1,1)(1)"),
    ],
)
def test_results_of_frost_as_they_are(form, where, left, step, biped, gait, tmp_path):
    """form: how the file holds domains (a step, an impact, a step); where: which one the import says that it
    took. With `left`, the left leg stands in FROST's names of right and left, which the import remarks. The
    gait is that of the samples each time.
    """
    course, impact = frost_domains(step, biped, left)
    # the name is "all(2,1)(3)": row 2 of the cell, and in it the third domain
    domains, names = (
        (course, impact, course),
        {"step": "all{2,1}(3)".replace("{", "(").replace("}", ")")},
    )
    content = {
        "structs": lambda: {"gait": structs(*domains)},
        "cells": lambda: {name: cells(*(d[name] for d in domains)) for name in course},
        # two equal rows of a gait and a number, such as its speed
        "library": lambda: {"all": np.vstack([cells(structs(*domains), 0.8)] * 2)},
    }
    savemat(tmp_path / "walk.mat", content[form]())
    found = ba.import_gait(tmp_path / "walk.mat", biped, names=names if form == "library" else None)
    assert close(found, gait)
    assert found.provenance["source"].startswith(f"walk.mat, {where}")
    assert found.provenance["left out"] == "position of the base"
    assert ("stance leg" in found.provenance) is left


# -- samples over time ------------------------------------------------------------------------------
@pytest.mark.parametrize("rates", [True, False])
def test_samples_give_back_the_gait_they_were_made_with(step, rates, biped, gait):
    """Angles over time, with or without rates, determine curves, period and fit of the gait that was walked."""
    found = ba.import_gait(step if rates else step._replace(v=None), biped)
    assert close(found, gait, 1e-6)
    assert found.period == pytest.approx(gait.period, abs=1e-6)
    assert float(found.provenance["misses the samples by at most"].split()[0]) < 1e-7


def test_a_fit_that_is_not_exact_closes_with_the_slopes_of_the_impact(step, biped):
    """Curves of degree 5 do not meet the samples exactly. Values and slopes at the ends are set and not fitted,
    so that after the impact the robot is on the curve again, with its slope: the gait is hybrid-invariant.
    """
    found = ba.import_gait(step, biped, degree=5)
    h, n = found.constraint, biped.n
    impact = biped.impact(found.q_minus, found.v_minus)
    assert np.allclose(h.h(h.theta_plus)[0], impact.q[: n - 1], rtol=0.0, atol=1e-12)
    after = impact.v[: n - 1] / (h.phase @ impact.v)
    assert np.allclose(h.h(h.theta_plus)[1], after, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("kind", ["mat", "json"])
def test_samples_in_files(step, kind, biped, gait, tmp_path):
    """Samples t, q, v of a step in a file give the gait that was walked, which names the file as its source."""
    path = tmp_path / f"step.{kind}"
    if kind == "mat":
        savemat(path, step._asdict())
    else:
        path.write_text(json.dumps({name: x.tolist() for name, x in step._asdict().items()}))
    found = ba.import_gait(path, biped)
    assert close(found, gait, 1e-6)
    assert found.provenance["source"] == path.name


def test_a_bad_fit_is_said_to_be_one(step, biped):
    """Degree 4 is too low for these samples."""
    with pytest.raises(ba.BipedError, match="try a degree up to 12"):
        ba.import_gait(step, biped, degree=4)


@pytest.mark.parametrize(
    "change",
    [
        lambda s: s._replace(q=s.q[:-30], t=s.t[:-30], v=s.v[:-30]),
        lambda s: s._replace(q=np.degrees(s.q)),
        lambda s: s._replace(q=s.q[:, :4]),
        lambda s: s._replace(t=s.t[::-1]),
        lambda s: s._replace(v=s.v[:, ::-1]),
        lambda s: s._replace(t=1.5 * s.t),
    ],
)
def test_samples_that_are_no_step_of_this_robot(step, biped, change):
    """Cut off before the impact, in degrees, with four coordinates, backwards in time, with rates in another
    order, and slower than the robot falls: each is refused.
    """
    with pytest.raises(ba.BipedError):
        ba.import_gait(change(step), biped)


def test_masses_that_differ_are_told_from_a_bad_fit(step, biped):
    """A torso three times as heavy has another impact than the rates of the samples show; the message names
    masses, as the curves themselves fit.
    """
    heavy = ba.ModelErrors(mass={"torso": 2.0}, inertia={"torso": 2.0}).apply(biped)
    with pytest.raises(ba.BipedError, match="masses"):
        ba.import_gait(step, heavy)


# -- a foot that is nearly on the ground, and robots that are other ones -----------------------------
def low(biped, step, height):
    """The step with its foot this much [m] above the ground at both ends."""
    dq = np.zeros(biped.n)
    for _ in range(9):
        q = step.q[-1] + dq
        J = biped.swing_foot_jacobian(q)[1, : biped.p]
        dq[: biped.p] += J * (height - biped.swing_foot(q)[1]) / (J @ J)
    theta = step.q @ biped.phase
    along = ((theta - theta[0]) / (theta[-1] - theta[0]))[:, np.newaxis]
    return step._replace(q=step.q + biped.R @ dq + along * (dq - biped.R @ dq))


@pytest.mark.parametrize("height", [-3e-3, -1.27e-3, 3e-3, 4e-3])
def test_a_foot_near_the_ground_is_put_onto_it_and_that_is_said(height, step, biped, gait):
    """height [m] of the foot above the ground at both ends of the samples: up to 5 mm it is put onto the
    ground, and 7 mm are refused.
    """
    found = ba.import_gait(low(biped, step, height), biped)
    assert abs(biped.swing_foot(found.q_minus)[1]) < 1e-9
    assert found.period == pytest.approx(gait.period, abs=4e-3)
    said = found.provenance["swing foot put onto the ground"]
    assert said == f"it ended {1e3 * height:g} mm above it"
    beyond = 7e-3 * np.sign(height)
    with pytest.raises(ba.BipedError, match=f"ends {1e3 * beyond:g} mm above the ground"):
        ba.import_gait(low(biped, step, beyond), biped)


@pytest.mark.parametrize("height", [-4.9e-3, -3e-3, 3e-3, 4.9e-3, -7e-3, 7e-3])
def test_a_gait_tilted_about_its_stance_foot_is_put_onto_the_ground(height, biped, gait, tmp_path):
    """The last joint, q_N, is shifted by asin(height / length) through the step, so that the foot ends `height`
    [m] above the ground; up to 5 mm are taken away, more is refused. The impact does not know of the tilt, so
    slopes that close still do. The trunk keeps the pitch of the file.
    """
    tilt = np.arcsin(height / gait.step_length(biped)) * np.array([0.0, 0.0, 0.0, 0.0, 1.0])
    record, path = record_of(gait, biped), tmp_path / "tilted.json"
    ends = (end + biped.phase @ tilt for end in (record.theta_plus, record.theta_minus))
    write_record(GaitFile("paper", record.coefficients, *ends), path)
    assert biped.swing_foot(gait.q_minus + tilt)[1] == pytest.approx(height, abs=1e-12)
    if abs(height) > 5e-3:
        with pytest.raises(ba.BipedError, match=f"swing foot ends {height:.4g} m above"):
            ba.import_gait(path, biped)
        return
    found = ba.import_gait(path, biped)
    said = found.provenance["swing foot put onto the ground"]
    assert said == f"it ended {1e3 * height:.2g} mm above it"
    assert abs(biped.swing_foot(found.q_minus)[1]) < 1e-9
    assert found.q_minus[-1] == pytest.approx((gait.q_minus + tilt)[-1], abs=1e-9)
    jump = impact_jump(biped, found.constraint, found.q_minus, found.v_minus)[1]
    assert np.max(np.abs(jump)) < 1e-6


@pytest.mark.parametrize("k", [0.165, 0.378, 1.6])
def test_another_gravity_is_told_from_other_masses_and_lengths(k, step, biped):
    """q(t) in k times the gravity is q(sqrt(k) t): samples on the Moon (0.165), on Mars (0.378) and in 1.6 g
    are explained by gravity and by nothing else.
    """
    there = Samples(step.t / np.sqrt(k), step.q, step.v * np.sqrt(k))
    with pytest.raises(
        ba.BipedError, match=rf"fit with gravity \(or one over all lengths\) times {k:g}"
    ):
        ba.import_gait(there, biped)


def of_robot(biped, gait):
    """Samples at the nodes of the zero dynamics of a robot with the poses of a gait, whose impact it has."""
    h = gait.constraint
    q, dq, _ = configuration(h.phase, h.h, h.theta_minus)
    h = invariant_constraint(Bezier, biped, onto_section(biped, q), dq, 6)
    zero = ZeroDynamics.of(biped, h)
    cycle = zero.cycle
    t = zero.cumulative @ (1.0 / (cycle.v @ h.phase))
    last = zero.end_state(1.0)[0]
    q = np.vstack((biped.relabel(last), cycle.q, last))
    return Samples(np.array([0.0, *t, cycle.period]), q)


OTHERS = {
    "the length of the legs times 1.3$": lambda b: with_legs(b, 1.3),
    "masses and inertias of torso times 1.5$": lambda b: ba.ModelErrors(
        {"torso": 0.5}, inertia={"torso": 0.5}
    ).apply(b),
    'close in .*tac2003.*preset="tac2003"': lambda b: ba.Biped.load("rabbit", "tac2003"),
}


@pytest.mark.parametrize("cause", OTHERS)
def test_lengths_and_masses_are_told_apart_before_one_is_named(cause, biped, gait):
    """OTHERS: text of the message -> robot that made the samples. That robot takes them; RABBIT refuses them
    and names the one change that explains them.
    """
    other = OTHERS[cause](biped)
    samples = of_robot(other, gait)
    ba.import_gait(samples, other)
    with pytest.raises(ba.BipedError, match=cause):
        ba.import_gait(samples, biped)


def test_another_convention_of_samples_is_named(step, biped):
    """Samples in OptimTraj's angles, taken for the paper's, are refused with the convention in which they
    close.
    """
    there = convention("optimtraj").to_paper.inverse
    with pytest.raises(ba.BipedError, match=r"close in .*optimtraj"):
        ba.import_gait(Samples(step.t, there.angles(step.q)), biped)
