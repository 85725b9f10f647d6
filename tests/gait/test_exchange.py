"""Gaits and runs from and to arrays, JSON and MATLAB files, in every angle convention."""

import ast
import dataclasses
import inspect
import itertools
import json
import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.io import loadmat, savemat

import biped_adrc as ba
from biped_adrc.analysis.signals import Signals
from biped_adrc.errors import GaitError, InputError, OutputError
from biped_adrc.gait.conventions import CONVENTIONS, convention
from biped_adrc.gait.curves import Bezier, Polynomial
from biped_adrc.gait.exchange.closure import check, closing_conventions
from biped_adrc.gait.exchange.convert import mapped, record_of
from biped_adrc.gait.exchange.files import (
    RUN_UNITS,
    export_run,
    read_mat,
    read_record,
    write_mat,
    write_record,
)
from biped_adrc.gait.exchange.importing import export_gait, import_gait
from biped_adrc.gait.exchange.record import GaitRecord


def assert_same(one, other, abs=1e-13):
    """Two gaits, to round-off."""
    a, b = one.constraint, other.constraint
    assert type(a.curve) is type(b.curve)
    for x, y in (
        (a.curve.coefficients, b.curve.coefficients),
        (a.phase, b.phase),
        ((a.theta_plus, a.theta_minus), (b.theta_plus, b.theta_minus)),
        (one.q_minus, other.q_minus),
        (one.v_minus, other.v_minus),
        (one.period, other.period),
    ):
        assert np.asarray(x) == pytest.approx(np.asarray(y), abs=abs)


@pytest.fixture(scope="module")
def recipe(biped):
    return ba.load_gait("recipe", biped)


@pytest.fixture
def record(gait):
    """The published gait as arrays without state, period or origin."""
    c = gait.constraint
    return GaitRecord("paper", c.curve.coefficients, c.theta_plus, c.theta_minus, name="arrays")


# -- round trips ---------------------------------------------------------------------------------
@pytest.mark.parametrize("suffix", [".json", ".mat"])
@pytest.mark.parametrize("name", CONVENTIONS)
def test_published_gait_through_every_convention_and_file(name, suffix, biped, gait, tmp_path):
    path = tmp_path / f"gait{suffix}"
    export_gait(gait, path, name)
    back = import_gait(path, biped)
    assert_same(gait, back)
    assert (back.name, back.robot, back.preset) == (gait.name, gait.robot, gait.preset)
    assert dict(back.provenance) == dict(gait.provenance)


@pytest.mark.parametrize("name", CONVENTIONS)
def test_polynomials_that_are_not_hybrid_invariant(name, biped, recipe, tmp_path):
    path = tmp_path / "recipe.mat"
    export_gait(recipe, path, name)
    assert_same(recipe, import_gait(path, biped, slopes=False))
    with pytest.raises(GaitError, match=r"slope of the .* through the impact.*slopes=False"):
        import_gait(path, biped)


@pytest.mark.parametrize("suffix", [".json", ".mat"])
def test_in_this_paper_s_convention_not_a_bit_changes(suffix, biped, gait, tmp_path):
    export_gait(gait, tmp_path / f"gait{suffix}")
    back = import_gait(tmp_path / f"gait{suffix}", biped)
    for key in ("q_minus", "v_minus"):
        assert np.array_equal(getattr(gait, key), getattr(back, key))
    one, other = gait.constraint, back.constraint
    assert np.array_equal(one.curve.coefficients, other.curve.coefficients)
    assert (one.theta_plus, one.theta_minus) == (other.theta_plus, other.theta_minus)


def test_a_stored_gait_is_a_record(biped, gait, tmp_path):
    gait.save(tmp_path / "stored.json")
    assert_same(gait, import_gait(tmp_path / "stored.json", biped))


def test_other_numbers_are_another_gait(biped, gait, tmp_path):
    """The comparison of the round trips sees a difference of 1e-12 rad."""
    a = np.array(gait.constraint.curve.coefficients)
    a[1, 3] += 1e-12
    moved = replace(gait, constraint=replace(gait.constraint, curve=Bezier(a)))
    export_gait(moved, tmp_path / "moved.mat", "frost")
    with pytest.raises(AssertionError):
        assert_same(gait, import_gait(tmp_path / "moved.mat", biped))


def test_what_a_mat_file_holds(gait, tmp_path):
    export_gait(gait, tmp_path / "gait.mat", "frost")
    raw = loadmat(tmp_path / "gait.mat")
    assert raw["coefficients"].shape == (4, 7)
    assert raw["phase"].tolist() == [[1.0, 1.0, 0.5, 0.0, 0.0]]
    assert raw["q_minus"].shape == (1, 5)
    units = read_mat(tmp_path / "gait.mat")["units"]
    assert (units["coefficients"], units["v_minus"], units["period"]) == ("rad", "rad/s", "s")
    hips = raw["coefficients"][[0, 2]][:, [0, -1]]  # right and left hip, at both ends
    assert hips == pytest.approx(2 * np.pi - gait.constraint.curve.coefficients[:2, [0, -1]])
    assert raw["theta_plus"].item() < raw["theta_minus"].item()


# -- what comes from elsewhere -------------------------------------------------------------------
def test_state_and_period_come_from_the_zero_dynamics(biped, gait, record):
    found = import_gait(record, biped)
    assert_same(gait, found, abs=1e-9)
    assert found.provenance == {
        "method": "imported from convention 'paper'",
        "source": "arrays",
    }
    assert np.array_equal(check(record).constraint.phase, biped.phase)


@pytest.mark.parametrize("factor", [-1.0, 2.0, -0.25])
def test_phase_that_runs_the_other_way_or_in_other_units(factor, biped, gait, record):
    other = replace(
        record,
        phase=factor * biped.phase,
        theta_plus=factor * record.theta_plus,
        theta_minus=factor * record.theta_minus,
    )
    assert_same(gait, import_gait(other, biped), abs=1e-9)
    assert np.array_equal(check(other).constraint.phase, biped.phase)


def test_phase_that_is_not_the_virtual_leg(biped, gait, record):
    """h over the absolute angle of the stance thigh, which is no multiple of Theta."""
    curve = gait.constraint.curve
    row = np.array([1.0, 0, 0, 0, 1.0])
    ends = [t - 0.5 * curve(s)[0][2] for s, t in ((0, record.theta_plus), (1, record.theta_minus))]
    other = replace(record, phase=row, theta_plus=ends[0], theta_minus=ends[1])
    constraint = check(other).constraint
    assert np.array_equal(constraint.phase, row)
    assert (constraint.theta_plus, constraint.theta_minus) == pytest.approx(tuple(ends))


@pytest.mark.parametrize("degree", [5, 6])
def test_curves_given_from_the_end_of_the_step(degree, biped, gait, record):
    curve = gait.constraint.curve
    backwards = replace(record, coefficients=curve.coefficients[:, ::-1], reverse=True)
    assert_same(gait, import_gait(backwards, biped), abs=1e-9)
    rng = np.random.default_rng(degree)
    for kind in (Bezier, Polynomial):
        h = kind(rng.normal(size=(3, degree + 1)))
        A, b = rng.normal(size=(2, 3)), rng.normal(size=2)
        for s in rng.uniform(0, 1, 5):
            assert h.reversed()(s)[0] == pytest.approx(h(1 - s)[0], abs=1e-12)
            assert mapped(h, A, b)(s)[0] == pytest.approx(A @ h(s)[0] + b, abs=1e-12)
            assert mapped(h, A, b)(s)[2] == pytest.approx(A @ h(s)[2], abs=1e-10)
            line = kind(kind.ramp(degree, 3.4, 2.9)[np.newaxis])
            assert line(s)[0] == pytest.approx(3.4 - 0.5 * s, abs=1e-13)


def test_rows_that_are_other_outputs(biped, gait, record):
    """y = H0 q: torso, angle between the thighs, knees."""
    H0 = np.array(
        [[0, 0, 0, 0, 1], [-1, 1, 0, 0, 0], [0, 0, 1, 0, 0], [0, 0, 0, 1, 0]], dtype=float
    )
    curve = check(record).curve
    other = replace(record, coefficients=H0 @ curve.coefficients, outputs=H0)
    assert_same(gait, import_gait(other, biped), abs=1e-9)
    with pytest.raises(
        GaitError, match=r"do not determine all 5 coordinates .* rank 4, expected 5"
    ):
        check(replace(record, outputs=np.eye(5)[[0, 1, 2, 2]]))


def test_whole_turns(biped, gait, record):
    a = np.array(record.coefficients)
    a[:2] -= 2 * np.pi
    turned = replace(
        record,
        coefficients=a,
        theta_plus=record.theta_plus - 2 * np.pi,
        theta_minus=record.theta_minus - 2 * np.pi,
    )
    found = import_gait(turned, biped)
    assert_same(gait, found, abs=1e-9)
    assert found.provenance["whole turns added to q"] == "1, 1, 0, 0, 0"


def test_a_file_with_names_of_its_own(biped, gait, tmp_path):
    words = record_of(gait, "tac2003")
    assert words.theta_plus < words.theta_minus
    path = tmp_path / "theirs.mat"
    savemat(path, {"alpha": words.coefficients, "thp": words.theta_plus, "thm": words.theta_minus})
    names = {"coefficients": "alpha", "theta_plus": "thp", "theta_minus": "thm"}
    assert_same(gait, import_gait(path, biped, "tac2003", names), abs=1e-9)
    with pytest.raises(GaitError, match="does not say its angle convention"):
        import_gait(path, biped, names=names)
    with pytest.raises(GaitError, match=r"theirs.mat.*\['coefficients', .* are missing.*'alpha'"):
        import_gait(path, biped, "tac2003")
    with pytest.raises(GaitError, match=r"no entries \['beta'\]; the file has \['alpha'"):
        import_gait(path, biped, "tac2003", {**names, "coefficients": "beta"})
    with pytest.raises(GaitError, match=r"names gives \['alfa'\]"):
        read_record(path, "tac2003", {"alfa": "alpha"})


def test_walker_without_knees():
    """The straight-legged walker: closes as arrays in every convention."""
    leg = np.array([[3.40, 3.3, 3.1, 2.93], [2.88, 3.0, 3.2, 3.35]])  # absolute, stance and swing
    leg[1, [0, -1]] = leg[0, [-1, 0]]
    torso = -0.1
    record = GaitRecord("paper", leg - torso, leg[0, 0], leg[0, -1], outputs=np.eye(3)[:2])
    rows = np.vstack((np.linspace(leg[0, 0], leg[0, -1], 4), leg[1], np.full(4, torso)))
    rows[:2] -= torso
    full = check(GaitRecord("paper", rows, rows[0, 0] + torso, rows[0, -1] + torso))
    for name in ("tac2003", "frost", "optimtraj"):
        c = convention(name, knees=False)
        own = mapped(full.curve, c.to_paper.inverse.A, c.to_paper.inverse.b)
        ends = c.sense * (np.array([leg[0, 0], leg[0, -1]]) - c.paper_phase @ c.to_paper.b)
        along = check(GaitRecord(name, own.coefficients, ends[0], ends[1]))
        assert along.curve.coefficients == pytest.approx(full.curve.coefficients, abs=1e-13)
    with pytest.raises(GaitError, match="found a gait of 2 actuated joints and 3 coordinates"):
        check(record, ba.Biped.load("rabbit"))


# -- gaits that do not close ---------------------------------------------------------------------
def test_published_gait_closes_and_a_damaged_one_does_not(any_biped):
    gait = ba.load_gait("published", any_biped)
    record = record_of(gait, "frost")
    check(record, any_biped)
    damaged = np.array(record.coefficients)
    damaged[3, -1] += 0.01  # left knee at the end
    with pytest.raises(GaitError) as error:
        check(replace(record, coefficients=damaged))
    text = str(error.value)
    assert "gait 'published' in convention 'frost'" in text
    assert "stance knee q3 across the impact: found -0.64407 rad" in text
    assert "expected -0.65407 rad, the end of the step with the legs changed over" in text
    assert "a coefficient of this joint is damaged" in text
    assert "closes in none of the conventions" in text


@pytest.mark.parametrize("with_robot", [True, False])
@pytest.mark.parametrize(
    ("made", "claimed"),
    [
        ("paper", "frost"),
        ("frost", "paper"),
        ("paper", "tac2003"),
        ("tac2003", "paper"),
        ("tac2003", "frost"),
        ("frost", "tac2003"),
        ("optimtraj", "paper"),
        ("optimtraj", "frost"),
    ],
)
def test_wrong_convention_is_recognised(made, claimed, with_robot, biped, gait):
    words = replace(record_of(gait, made), phase=None)  # each with its own phase
    check(words)
    wrong = replace(words, convention=claimed)
    robot = biped if with_robot else None
    assert made in closing_conventions(wrong, robot)
    with pytest.raises(GaitError, match=f"would close in .*'{made}'.* Try convention="):
        check(wrong, robot)


def test_wrong_convention_whose_phase_says_nothing(gait):
    with pytest.raises(GaitError, match=r"rank 4, expected 5.*would close in 'frost'"):
        check(replace(record_of(gait, "frost"), convention="paper"))


def test_wrong_number_of_rows(gait, record):
    with pytest.raises(
        GaitError, match=r"4 joints \(rows\), expected 5 or 3; the conventions .*'paper'"
    ):
        replace(record, convention="optimtraj")
    with pytest.raises(GaitError, match=r"7 joints .* 4 columns, so it may be transposed"):
        replace(record, coefficients=gait.constraint.curve.coefficients.T)
    with pytest.raises(GaitError, match=r"6 joints .*the matrix `outputs`"):
        replace(record, coefficients=np.zeros((6, 8)))
    with pytest.raises(GaitError, match=r"phase has 4 numbers, expected 5: q1, q2, q3, q4, q5"):
        replace(record, phase=np.ones(4))
    with pytest.raises(GaitError, match=r"outputs have shape \(3, 5\) for 4 rows"):
        replace(record, outputs=np.eye(5)[:3])
    with pytest.raises(GaitError, match="no angle convention 'kelly'"):
        replace(record, convention="kelly")


def test_numbers_that_are_none(record):
    a = np.array(record.coefficients)
    a[2, 4] = np.nan
    with pytest.raises(GaitError, match=r"joint 3, column 5 \(counted from 1\) is nan"):
        replace(record, coefficients=a)
    with pytest.raises(GaitError, match="theta_plus is inf, expected one finite number"):
        replace(record, theta_plus=np.inf)
    with pytest.raises(GaitError, match=r"theta_plus and theta_minus are both 3\.0 rad"):
        replace(record, theta_plus=3.0, theta_minus=3.0)
    with pytest.raises(GaitError, match="not an array of real numbers: its numbers are complex"):
        replace(record, coefficients=a + 1j)
    with pytest.raises(GaitError, match="not an array of real numbers"):
        replace(record, coefficients=[[1.0, 2.0], [3.0]])
    with pytest.raises(GaitError, match=r"has shape \(4, 1\), expected \(joints, degree"):
        replace(record, coefficients=np.ones((4, 1)))
    with pytest.raises(GaitError, match=r"period is -1\.0 s"):
        replace(record, period=-1.0)
    with pytest.raises(GaitError, match="only one of q_minus and v_minus"):
        replace(record, q_minus=np.zeros(5))
    with pytest.raises(GaitError, match="curve is 'spline'"):
        replace(record, curve="spline")


def test_degrees(record):
    degrees = replace(
        record,
        coefficients=np.degrees(record.coefficients),
        theta_plus=np.degrees(record.theta_plus),
        theta_minus=np.degrees(record.theta_minus),
    )
    with pytest.raises(GaitError, match=r"row 2 .* an angle of 210.* the angles are degrees"):
        check(degrees)


def test_phase_range_the_wrong_way_round(biped, record):
    swapped = replace(record, theta_plus=record.theta_minus, theta_minus=record.theta_plus)
    with pytest.raises(GaitError, match=r"phase range: found Theta from 2.92597 .*are exchanged"):
        check(swapped, biped)
    assert closing_conventions(swapped, biped) == ()
    # Theta+ + Theta- is nearly a whole turn: without a robot these are a gait of the other sense, whose torso
    # leans by one degree more; the message gives both readings
    assert closing_conventions(swapped) == ("tac2003",)
    with pytest.raises(GaitError, match=r"close in 'tac2003'.* If not: .*are exchanged"):
        check(swapped)


def test_curves_over_another_phase(gait):
    words = record_of(gait, "optimtraj")
    bent = np.array(words.coefficients)
    bent[:, 3] += 0.05  # closes, but theta of the rows is no longer s
    with pytest.raises(GaitError, match=r"phase at s = 0.\d\d: .*over time or over another phase"):
        check(replace(words, coefficients=bent))


def test_curves_over_time_miss_the_ground(biped, gait, record):
    with pytest.raises(GaitError, match=r"swing foot at the start of the step: found .* a time"):
        check(replace(record, theta_plus=0.0, theta_minus=-0.4138030549), biped)


def test_gait_that_walks_backwards(biped, record):
    """The mirror image: every angle and the phase with the other sign."""
    mirror = replace(
        record,
        coefficients=-record.coefficients,
        theta_plus=-record.theta_plus,
        theta_minus=-record.theta_minus,
    )
    with pytest.raises(GaitError, match="phase range: found Theta"):
        check(mirror, biped)
    thigh = check(record).curve.coefficients[0] + check(record).curve.coefficients[4]
    by_thigh = replace(  # a phase whose direction is not known beforehand
        mirror, phase=np.array([1.0, 0, 0, 0, 1.0]), theta_plus=-thigh[0], theta_minus=-thigh[-1]
    )
    check(by_thigh)
    with pytest.raises(GaitError, match=r"found -0.31.* m from the stance foot.*walks to -x"):
        check(by_thigh, biped)


def test_gait_of_another_preset(gait):
    words = record_of(gait, "tac2003")
    heavier = ba.Biped.load("rabbit", "tac2003")
    with pytest.raises(GaitError, match=r"slope of .*gait for rabbit, preset identified; robot"):
        check(words, heavier)
    check(words, heavier, slopes=False)
    check(words)


@pytest.mark.parametrize(("key", "unit"), [("q_minus", "rad"), ("v_minus", "rad/s")])
def test_state_that_is_not_on_the_curve(key, unit, gait):
    words = record_of(gait, "frost")
    state = np.array(getattr(words, key))
    state[3] += 0.02  # left hip: the swing hip
    with pytest.raises(GaitError, match=rf"{key} of the swing hip q2: found .* {unit}, expected"):
        check(replace(words, **{key: state}))


# -- files ---------------------------------------------------------------------------------------
def test_files_that_cannot_be_read(tmp_path, record):
    missing = tmp_path / "none.mat"
    with pytest.raises(InputError, match=r"none.mat' not found"):
        read_record(missing)
    with pytest.raises(InputError, match=r"expected .json, .mat or .csv"):
        read_record(tmp_path / "gait.txt")
    with pytest.raises(InputError, match=r"expected .json or .mat"):
        write_record(record, tmp_path / "gait.csv")
    damaged = tmp_path / "damaged.mat"
    damaged.write_bytes(b"not a MATLAB file")
    with pytest.raises(InputError, match=r"damaged.mat' cannot be read"):
        read_record(damaged)
    new = tmp_path / "new.mat"
    new.write_bytes(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + b"\x89HDF\r\n\x1a\n" * 64)
    with pytest.raises(InputError, match=r"version 7.3 .*'-v7'"):
        read_record(new)
    for text, message in (
        ("{", "not valid JSON"),
        ("[1]", "holds a list, expected an object"),
        ('{"coefficients": 1}', "are missing"),
    ):
        path = tmp_path / "bad.json"
        path.write_text(text)
        with pytest.raises(InputError, match=f"bad.json.*{message}"):
            read_record(path)
    with pytest.raises(OutputError):
        write_record(record, damaged / "below.mat")


def test_cut_off_mat_files_are_input_errors(gait, tmp_path):
    export_gait(gait, tmp_path / "gait.mat")
    data = (tmp_path / "gait.mat").read_bytes()
    for length in range(0, len(data) - 1, 97):
        cut = tmp_path / "cut.mat"
        cut.write_bytes(data[:length])
        with pytest.raises(InputError):
            read_record(cut)


def test_a_file_says_its_convention_once(gait, tmp_path):
    path = tmp_path / "gait.json"
    export_gait(gait, path, "frost")
    with pytest.raises(GaitError, match="convention is 'paper', but the file says 'frost'"):
        read_record(path, "paper")
    entries = json.loads(path.read_text())
    path.write_text(json.dumps({**entries, "curve": 3}))
    with pytest.raises(GaitError, match="curve is 3, expected text"):
        read_record(path)
    path.write_text(json.dumps({**entries, "reverse": "no"}))
    with pytest.raises(GaitError, match="reverse is 'no'"):
        read_record(path)
    path.write_text(json.dumps({**entries, "coefficients": [[1, 2], [3]]}))
    with pytest.raises(GaitError, match="coefficients is not an array of real numbers"):
        read_record(path)
    path.write_text(json.dumps({**entries, "theta_plus": None}))
    with pytest.raises(GaitError, match="theta_plus is None"):
        read_record(path)
    path.write_text(json.dumps({**entries, "provenance": [1]}))
    with pytest.raises(GaitError, match="provenance is a list"):
        read_record(path)
    path.write_text(json.dumps({**entries, "provenance": "by hand"}))
    assert read_record(path).provenance == {"source": "by hand"}


def test_run_as_mat_comes_back_equal(biped, gait, tmp_path):
    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    columns = vars(ba.walk(walker, gait, 1).signals)
    assert set(columns) == set(RUN_UNITS)
    path = tmp_path / "run.mat"
    export_run(columns, path, note="one step")
    back = read_mat(path)
    for name, column in columns.items():
        assert np.array_equal(back[name], column, equal_nan=True), name
    raw = loadmat(path, simplify_cells=True)
    assert (raw["units"]["ground_reaction"], raw["note"]) == ("N", "one step")
    assert loadmat(path)["t"].shape == (len(columns["t"]), 1)


def test_runs_that_cannot_be_exported(tmp_path):
    t = np.arange(3.0)
    path = tmp_path / "run.mat"
    with pytest.raises(InputError, match=r"'temperature'.* have no unit"):
        export_run({"t": t, "temperature": t}, path)
    export_run({"t": t, "temperature": t}, path, {"temperature": "K"})
    assert np.array_equal(read_mat(path)["temperature"], t)
    with pytest.raises(InputError, match="one length for all"):
        export_run({"t": t, "q": np.zeros((4, 5))}, path)
    with pytest.raises(InputError, match=r"expected .mat"):
        export_run({"t": t}, tmp_path / "run.csv")
    with pytest.raises(InputError, match="'2q' cannot be a variable"):
        write_mat(path, {"2q": t}, {"2q": "rad"})


def test_a_run_is_exported_in_the_units_of_its_signals():
    """The docstring of each field of `Signals` ends with its unit; whole numbers and shares have none."""
    body = ast.parse(inspect.getsource(Signals)).body[0].body
    for field, text in itertools.pairwise(body):
        if not isinstance(field, ast.AnnAssign) or field.target.id not in RUN_UNITS:
            continue
        units = re.findall(r"\[([^\]]+)\]", text.value.value)
        assert set(units) == {RUN_UNITS[field.target.id]} - {"1"}, field.target.id
    assert set(RUN_UNITS) == {f.name for f in dataclasses.fields(Signals)}
