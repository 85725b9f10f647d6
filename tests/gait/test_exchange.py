"""Gaits and runs from and to arrays, JSON and MATLAB files, in every angle convention.

Fixtures: biped and gait, RABBIT and its published gait; record, this gait as arrays without state and period;
recipe, a gait that is not hybrid-invariant. assert_same compares all numbers of two gaits.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.io import loadmat, savemat

import biped_adrc as ba
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.gait.conventions import CONVENTIONS, OWN, layout_of
from biped_adrc.gait.curves import Bezier, Polynomial
from biped_adrc.gait.exchange.entries import entry
from biped_adrc.gait.exchange.importing import (
    RUN_UNITS,
    export_gait,
    export_run,
    import_gait,
    read_mat,
    read_record,
)
from biped_adrc.gait.exchange.record import GaitFile, coordinates, mapped, record_of


def assert_same(one, other, abs=1e-13):
    """Two gaits are equal to round-off."""
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
    return GaitFile("paper", c.curve.coefficients, c.theta_plus, c.theta_minus, name="arrays")


# -- round trips ---------------------------------------------------------------------------------
@pytest.mark.parametrize("suffix", [".json", ".mat"])
@pytest.mark.parametrize("name", CONVENTIONS)
def test_published_gait_through_every_convention_and_file(name, suffix, biped, gait, tmp_path):
    """A gait that is written in the angles of a convention and read back is the same: to the last bit in the
    paper's own angles, to round-off after a map there and back.
    """
    path = tmp_path / f"gait{suffix}"
    export_gait(gait, path, name)
    back = import_gait(path, biped)
    assert_same(gait, back, abs=0.0 if name == "paper" else 1e-13)
    assert (back.name, back.robot, back.preset) == (gait.name, gait.robot, gait.preset)
    assert dict(back.provenance) == dict(gait.provenance)


def test_polynomials_that_are_not_hybrid_invariant(biped, recipe, tmp_path):
    """The impact leaves the curves of the gait 'recipe', so that reading refuses them unless slopes=False
    waives this check; then its polynomials come back.
    """
    path = tmp_path / "recipe.mat"
    export_gait(recipe, path, "frost")
    assert_same(recipe, import_gait(path, biped, slopes=False))
    with pytest.raises(GaitError, match="slopes=False"):
        import_gait(path, biped)


def test_an_exported_mat_file_has_curves_phase_and_units(gait, tmp_path):
    """The file has, as MATLAB reads it, a row for each motor's joint, FROST's own phase row, and units by name.
    FROST's hip angles are 2 pi less the paper's, since they count clockwise, and its phase grows where the
    paper's falls.
    """
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
    """Of curves and Theta alone the state before impact and the period are computed, and are those stored with
    the gait.
    """
    found = import_gait(record, biped)
    assert_same(gait, found, abs=1e-9)
    assert found.provenance == {
        "method": "imported from convention 'paper'",
        "source": "arrays",
    }
    assert np.array_equal(found.constraint.phase, biped.phase)


@pytest.mark.parametrize("factor", [-1.0, 2.0, -0.25])
def test_phase_that_runs_the_other_way_or_in_other_units(factor, biped, gait, record):
    """A file may have any multiple of the robot's phase, also a negative one: the gait is the same, in the
    robot's phase.
    """
    ends = {name: factor * getattr(record, name) for name in ("theta_plus", "theta_minus")}
    found = import_gait(replace(record, phase=factor * biped.phase, **ends), biped)
    assert_same(gait, found, abs=1e-9)
    assert np.array_equal(found.constraint.phase, biped.phase)


@pytest.mark.parametrize("kind", [Bezier, Polynomial])
def test_curves_under_affine_maps(kind):
    """mapped(h, A, b) is A h + b: [0] is the value and [2] the second derivative, from which b is gone.
    ramp(degree, 3.4, 2.9) is the straight line from 3.4 to 2.9.
    """
    rng, degree = np.random.default_rng(5), 5
    h = kind(rng.normal(size=(3, degree + 1)))
    A, b = rng.normal(size=(2, 3)), rng.normal(size=2)
    line = kind(kind.ramp(degree, 3.4, 2.9)[np.newaxis])
    for s in rng.uniform(0, 1, 5):
        assert mapped(h, A, b)(s)[0] == pytest.approx(A @ h(s)[0] + b, abs=1e-12)
        assert mapped(h, A, b)(s)[2] == pytest.approx(A @ h(s)[2], abs=1e-10)
        assert line(s)[0] == pytest.approx(3.4 - 0.5 * s, abs=1e-13)


def test_rows_that_are_other_outputs(biped, gait, record):
    """A file may have outputs y = H0 q (torso, angle between the thighs, knees) in place of the joint angles:
    solved for the angles, it is the same gait.
    """
    H0 = np.array(
        [[0, 0, 0, 0, 1], [-1, 1, 0, 0, 0], [0, 0, 1, 0, 0], [0, 0, 0, 1, 0]], dtype=float
    )
    # curves of all five angles; the record has those of the four motors
    curve = coordinates(record, layout_of(OWN, biped))[0].curve
    other = replace(record, coefficients=H0 @ curve.coefficients, outputs=H0)
    assert_same(gait, import_gait(other, biped), abs=1e-9)


def test_whole_turns_of_the_angles_are_taken_out_of_an_imported_gait(biped, gait, record):
    """Both hips, and with them Theta, are a whole turn less in the file: the same gait, and it is remarked."""
    a = np.array(record.coefficients)
    a[:2] -= 2 * np.pi
    ends = {name: getattr(record, name) - 2 * np.pi for name in ("theta_plus", "theta_minus")}
    found = import_gait(replace(record, coefficients=a, **ends), biped)
    assert_same(gait, found, abs=1e-9)
    assert found.provenance["whole turns added to q"] == "1, 1, 0, 0, 0"


# -- gaits that do not close ---------------------------------------------------------------------
def changed(key, place, by):
    """A record with one number of an array changed."""

    def change(record):
        array = np.array(getattr(record, key))
        array[place] += by
        return replace(record, **{key: array})

    return change


def turned(record):
    """The mirror image over the stance thigh, a phase whose direction is not known beforehand."""
    knee = record.coefficients[2, [0, -1]]  # thigh = Theta - q3 / 2
    return replace(
        record,
        coefficients=-record.coefficients,
        phase=np.array([1.0, 0, 0, 0, 1.0]),
        theta_plus=0.5 * knee[0] - record.theta_plus,
        theta_minus=0.5 * knee[1] - record.theta_minus,
    )


def in_degrees(record):
    names = ("coefficients", "theta_plus", "theta_minus")
    return replace(record, **{name: np.degrees(getattr(record, name)) for name in names})


OPEN = {
    "damaged": ("frost", changed("coefficients", (3, -1), 0.01), "knee at the"),
    # entry 3 is FROST's left hip: the swing leg's, which is the right one here
    "state": ("frost", changed("q_minus", 3, 0.02), "right_hip"),
    "rates": ("frost", changed("v_minus", 3, 0.02), "v_minus of right_hip"),
    # all five angles are off in mid-step, so that the phase c q(s) of the curves is no straight line
    "another phase": (
        "optimtraj",
        changed("coefficients", (slice(None), 3), 0.05),
        "another phase",
    ),
    # Theta changes by -0.4138 rad as in the gait, but begins at 0, as a time does
    "time": ("paper", lambda r: replace(r, theta_plus=0.0, theta_minus=-0.4138030549), "a time"),
    "exchanged": (
        "paper",
        lambda r: replace(r, theta_plus=r.theta_minus, theta_minus=r.theta_plus),
        "Theta",
    ),
    "backwards": ("paper", turned, "walks to -x"),
    "degrees": ("paper", in_degrees, "degrees"),
    "half a state": ("paper", lambda r: replace(r, q_minus=np.zeros(5)), "both left out"),
    "a row too many": ("paper", lambda r: replace(r, coefficients=np.zeros((6, 8))), "6 rows"),
    "another phase row": ("paper", lambda r: replace(r, phase=np.ones(4)), "5 numbers"),
    "too few outputs": ("paper", lambda r: replace(r, outputs=np.eye(5)[:3]), "outputs"),
    "no phase": ("paper", lambda r: replace(r, theta_plus=3.0, theta_minus=3.0), "Theta|ends"),
    "no convention": ("paper", lambda r: replace(r, convention="kelly"), "kelly"),
    "no curve": ("paper", lambda r: replace(r, curve="spline"), "spline"),
}


@pytest.mark.parametrize("name", OPEN)
def test_a_gait_that_is_not_one_of_the_robot_is_refused(name, biped, gait, record):
    """OPEN[name] is (convention, change of the record, word of the message). The unchanged record is imported
    first, so that it is the change that is refused.
    """
    convention, change, word = OPEN[name]
    sound = record if convention == "paper" else record_of(gait, biped, convention)
    import_gait(sound, biped)
    with pytest.raises(GaitError, match=word):
        import_gait(change(sound), biped)


@pytest.mark.parametrize(
    ("made", "claimed"), [("frost", "paper"), ("paper", "tac2003"), ("optimtraj", "frost")]
)
def test_wrong_convention_is_recognised(made, claimed, biped, gait):
    """made: the convention that the numbers are in; claimed: the one that the record states. The error names
    the true one, in which the gait would close.
    """
    # phase None: the row of the convention that the record states
    right = replace(record_of(gait, biped, made), phase=None)
    wrong = replace(right, convention=claimed)
    with pytest.raises(GaitError, match=made):
        import_gait(wrong, biped)


def test_gait_of_another_preset(gait):
    """With other masses the impact leaves the curves, and the error names the preset that they were made for;
    slopes=False waives the check.
    """
    heavier = ba.Biped.load("rabbit", "tac2003")
    with pytest.raises(GaitError, match="preset identified"):
        import_gait(record_of(gait, heavier, "tac2003"), heavier)
    import_gait(record_of(gait, heavier, "tac2003"), heavier, slopes=False)


@pytest.mark.parametrize(
    "wrong",
    [
        {"coefficients": np.full((4, 7), np.nan)},
        {"coefficients": [[1.0, 2.0], [3.0]]},
        {"coefficients": None},
        {"coefficients": np.ones((4, 7)) * 1j},
        {"theta_plus": np.inf},
        {"period": "long"},
    ],
)
def test_what_is_no_number_is_refused(record, wrong):
    """wrong: one field of the record and a bad value of it; the error names the field."""
    with pytest.raises(GaitError, match=next(iter(wrong))):
        replace(record, **wrong)


# -- files ---------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("name", "data", "word"),
    [
        ("none.mat", None, "not found"),  # None: no file is written
        ("gait.txt", b"", "expected"),
        ("damaged.mat", b"not a MATLAB file", "MATLAB file"),
        (
            "new.mat",
            # the header of a MAT-file, of 128 bytes, then HDF5's own first bytes
            b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + b"\x89HDF\r\n\x1a\n" * 64,
            "-v7'",
        ),
        ("bad.json", b"{", "JSON"),
        ("bad.json", b'{"coefficients": 1}', "missing"),
    ],
)
def test_files_that_cannot_be_read(tmp_path, name, data, word):
    """Each message names the file and says why; for a file of MATLAB 7.3, which is HDF5, that it has to be
    saved with '-v7'.
    """
    path = tmp_path / name
    if data is not None:
        path.write_bytes(data)
    with pytest.raises(InputError, match=word) as caught:
        read_record(path)
    assert name in str(caught.value)


def test_cut_off_mat_files_are_input_errors(gait, tmp_path):
    """Wherever the file ends too early (every 97 bytes), the error is the package's own and none of SciPy's."""
    export_gait(gait, tmp_path / "gait.mat")
    data = (tmp_path / "gait.mat").read_bytes()
    for length in range(0, len(data) - 1, 97):
        cut = tmp_path / "cut.mat"
        cut.write_bytes(data[:length])
        with pytest.raises(InputError):
            read_record(cut)


def test_a_run_comes_back_from_its_mat_file_with_units_and_note(biped, gait, tmp_path):
    """Each signal comes back to the last bit. In MATLAB a vector is a column, (K, 1), with a row per time. A
    name that ends with .csv is refused.
    """
    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    columns = vars(ba.walk(walker, gait, 1).signals)
    assert set(columns) == set(RUN_UNITS)
    path = tmp_path / "run.mat"
    export_run(columns, path, note="one step")
    back = read_mat(path)
    for name, column in columns.items():
        assert np.array_equal(back[name], column, equal_nan=True), name
    raw = loadmat(path, simplify_cells=True)
    assert (raw["units"]["ground_reaction"], raw["units"]["u"]) == ("N", "N m")
    assert raw["note"] == "one step"
    assert loadmat(path)["t"].shape == (len(columns["t"]), 1)
    with pytest.raises(InputError):
        export_run(columns, tmp_path / "run.csv")


def test_a_file_says_its_convention_once(gait, tmp_path):
    """The file states "frost"; the argument "paper" contradicts it and is refused."""
    path = tmp_path / "gait.json"
    export_gait(gait, path, "frost")
    with pytest.raises(GaitError, match="frost"):
        read_record(path, "paper")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        *(("row(1,2)", 4.0), ("row(2)", 4.0), ("column(2,1)", 4.0), ("row(1,:)", [3.0, 4.0])),
        *(("matrix(2,1)", 7.0), ("matrix(:,2)", [6.0, 8.0]), ("matrix(2)", 7.0)),
    ],
)
def test_an_element_has_the_name_that_matlab_gives_it(tmp_path, name, expected):
    """Also in a row or a column, which is read as a list of numbers; one index counts down the columns."""
    arrays = {"row": [[3.0, 4.0]], "column": [[3.0], [4.0]], "matrix": [[5.0, 6.0], [7.0, 8.0]]}
    savemat(tmp_path / "arrays.mat", arrays)
    np.testing.assert_array_equal(entry(read_mat(tmp_path / "arrays.mat"), name), expected)
