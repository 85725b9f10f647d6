"""Curves, constraints, zero dynamics, gait files, and the gait through x*.

biped and gait are RABBIT and its published gait; any_biped is RABBIT with each preset of its masses.
"""

import json
from math import comb
from pathlib import Path

import numpy as np
import pytest
from scipy import interpolate

import biped_adrc as ba
from biped_adrc.core.errors import GaitError, OutputError
from biped_adrc.gait.curves import Bezier, BSpline, Polynomial, knots
from biped_adrc.gait.published import X_STAR


@pytest.mark.parametrize("kind", [Bezier, Polynomial])
def test_curves_are_the_sums_that_define_them(kind):
    """At s inside and beyond the ends of the phase, 0 and 1, a curve is the sum of its coefficients times
    Bernstein polynomials, or times powers of s.
    """
    a = np.random.default_rng(0).normal(size=(3, 7))
    curve = kind(a)
    for s in (-0.1, 0.0, 0.3, 1.0, 1.2):
        k = np.arange(7)
        if kind is Bezier:
            weights = [comb(6, j) * s**j * (1 - s) ** (6 - j) for j in k]
        else:
            weights = [s**j for j in k]
        assert curve(s)[0] == pytest.approx(a @ weights, abs=1e-12)


@pytest.mark.parametrize("kind", [Bezier, BSpline])
@pytest.mark.parametrize("degree", [3, 4, 9])
def test_coefficients_at_the_abscissae_are_the_straight_line(kind, degree):
    """Linear precision: sum_k s_k N_k(s) = s with slope 1 and no curvature, where s_k are the abscissae.
    B-splines are compared with SciPy's, of pieces of degree 3, on the same knots too.
    """
    line = kind(kind.abscissae(degree)[np.newaxis])
    for s in (0.0, 0.137, 0.5, 0.9, 1.0):
        assert np.ravel(line(s)) == pytest.approx([s, 1.0, 0.0], abs=1e-12)
    if kind is BSpline:
        a = np.random.default_rng(degree).normal(size=degree + 1)
        s = np.linspace(0.0, 1.0, 41)
        theirs = interpolate.BSpline(knots(degree), a, 3)(s)
        ours = kind(a[np.newaxis])
        np.testing.assert_allclose([ours(x)[0][0] for x in s], theirs, rtol=0.0, atol=1e-12)


def test_curves_that_are_no_curves():
    """Coefficients have to be finite and (outputs, at least 2), and the phase needs two different ends."""
    for bad in (np.zeros(3), np.zeros((2, 1)), np.full((2, 3), np.nan)):
        with pytest.raises(GaitError, match="curve coefficients"):
            Bezier(bad)
    with pytest.raises(GaitError, match="two different ends"):
        ba.VirtualConstraint(Bezier(np.zeros((4, 3))), np.ones(5), 1.0, 1.0)


def test_published_gait_closes_on_the_published_state(any_biped):
    """x* is printed to three decimals, hence 5e-4; under NPD the walk stays within 1e-7 rad of the curve.

    The impulse, which leaves the friction cone with some presets, is not looked at here.
    """
    g = ba.load_gait("published", any_biped)
    x = np.append(g.q_minus, g.v_minus)
    assert np.max(np.abs(x - X_STAR)) < 5e-4
    walk = ba.walk(ba.Walker(any_biped, ba.NPDController(g.constraint)), g, 2, ba.RK4(2.5e-4))
    assert np.max(np.abs(walk.trajectory.before("foot_strike")[-1] - x)) < 2e-8
    assert np.max(np.abs(walk.signals.error)) < 1e-7
    assert not walk.certificates[-1].violations(but=("impulse",))


@pytest.mark.parametrize(
    "changes",
    [
        {"period": None},
        {"q_minus": [1.0, 2.0]},
        {"v_minus": [float("nan")] * 5},
        {"v_minus": [0.0] * 5},
        {"format": "other"},
        {"curve": "spline"},
        {"theta_plus": 3.0},
        {"period": -1.0},
    ],
)
def test_wrong_gait_files_are_refused_by_name(tmp_path, biped, gait, changes):
    """changes: of the entries of a sound file; None takes the entry away. The message names the file."""
    path = tmp_path / "bad.json"
    gait.save(path)
    record = {**json.loads(path.read_text()), **changes}
    path.write_text(json.dumps({key: x for key, x in record.items() if x is not None}))
    with pytest.raises(GaitError, match=r"bad\.json"):
        ba.load_gait(path, biped)


def test_missing_and_unreadable_gaits(tmp_path, biped, gait):
    """An unknown name is answered with a known one, "published"; no file, a file that is no JSON, and a file in
    place of a folder are refused.
    """
    (tmp_path / "text.json").write_text("hello")
    for name, word in (
        ("run", "published"),
        (tmp_path / "none.json", "not found"),
        (tmp_path / "text.json", "JSON"),
    ):
        with pytest.raises(GaitError, match=word):
            ba.load_gait(name, biped)
    with pytest.raises(OutputError):
        gait.save(tmp_path / "text.json" / "g.json")


def test_commands_that_stored_gaits_name_run():
    """The command line of each is read without an error, and its limits and numbers are taken; a module has a
    main part.
    """
    import shlex

    import typer

    from biped_adrc.cli.app import app

    root = Path(__file__).resolve().parents[2]
    group = typer.main.get_command(app)
    for path in sorted((root / "gaits").rglob("*.json")):
        command = json.loads(path.read_text())["provenance"]["command"]
        if command.startswith("python -m "):
            module = command.removeprefix("python -m ").replace(".", "/")
            assert '__name__ == "__main__"' in (root / f"{module}.py").read_text(), path.name
            continue
        words = shlex.split(command)
        assert words[:3] == ["biped-adrc", "gait", "design"], path.name
        context = group.make_context("biped-adrc", words[1:], resilient_parsing=False)
        inner = group.get_command(context, "gait").get_command(context, "design")
        assert inner.make_context("design", words[3:]).params["minimise"] == "torque"
