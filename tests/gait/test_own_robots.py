"""Gaits for any robot: its own coordinates, names and structs of other tools, samples over time, own cycles."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest
from scipy.io import savemat

import biped_adrc as ba
from biped_adrc.core.files import data_folder
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.gait.exchange.samples import Samples


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
        h.constraint.curve.coefficients, gait.constraint.curve.coefficients, atol=within
    )


# -- robots that are not of the package ------------------------------------------------------------


def turned_gait(gait, biped):
    c = gait.constraint
    h = ba.VirtualConstraint(c.curve, -c.phase, -c.theta_plus, -c.theta_minus)
    return replace(gait, robot="mine", constraint=h).check(biped)


@pytest.mark.parametrize("kind", ["json", "mat"])
def test_a_robot_of_its_own_coordinates_gives_and_takes_gaits(turned, gait, tmp_path, kind):
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
    biped = turned
    own = turned_gait(gait, biped)
    c, a = own.constraint, own.constraint.curve.coefficients.copy()
    a[3, 0] += 0.1
    record = GaitRecord("own", a, c.theta_plus, c.theta_minus)
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
    alpha, plus, minus = entries(gait)
    path = tmp_path / "R.mat"
    savemat(path, {"R": {"alpha": alpha, "th": {"first": plus, "last": minus}}})
    names = {"coefficients": "R.alpha", "theta_plus": "R.th.first", "theta_minus": "R.th.last"}
    assert close(ba.import_gait(path, biped, "paper", names), gait)
    for names in (None, {"coefficients": "R.beta"}):
        with pytest.raises(ba.BipedError, match="first"):
            ba.import_gait(path, biped, "paper", names)


# -- samples over time ------------------------------------------------------------------------------
@pytest.mark.parametrize("rates", [True, False])
def test_samples_give_back_the_gait_they_were_made_with(step, rates, biped, gait):
    found = ba.import_gait(step if rates else step._replace(v=None), biped)
    assert close(found, gait, 1e-6)
    assert found.period == pytest.approx(gait.period, abs=1e-6)
    assert float(found.provenance["misses the samples by at most"].split()[0]) < 1e-7


def test_a_fit_that_is_not_exact_closes_with_the_slopes_of_the_impact(step, biped):
    """Degree 5 misses the samples by millimetres; ends and slopes are set, so the gait is still invariant."""
    found = ba.import_gait(step, biped, degree=5)
    h, n = found.constraint, biped.n
    impact = biped.impact(found.q_minus, found.v_minus)
    assert np.allclose(h.h(h.theta_plus)[0], impact.q[: n - 1], atol=1e-12)
    after = impact.v[: n - 1] / (h.phase @ impact.v)
    assert np.allclose(h.h(h.theta_plus)[1], after, atol=1e-9)


@pytest.mark.parametrize("kind", ["mat", "json"])
def test_samples_in_files(step, kind, biped, gait, tmp_path):
    path = tmp_path / f"step.{kind}"
    if kind == "mat":
        savemat(path, step._asdict())
    else:
        path.write_text(json.dumps({name: x.tolist() for name, x in step._asdict().items()}))
    found = ba.import_gait(path, biped)
    assert close(found, gait, 1e-6)
    assert found.provenance["source"] == path.name


def test_a_bad_fit_is_said_to_be_one(step, biped):
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
    with pytest.raises(ba.BipedError):
        ba.import_gait(change(step), biped)


def test_masses_that_differ_are_told_from_a_bad_fit(step, biped):
    """Without rates the curves fit, and the time of the step gives it away; with rates the impact does."""
    heavy = ba.ModelErrors(mass={"torso": 2.0}, inertia={"torso": 2.0}).apply(biped)
    with pytest.raises(ba.BipedError, match="masses"):
        ba.import_gait(step, heavy)
