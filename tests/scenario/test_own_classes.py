"""Classes of one's own by module:Class: on the command line, in studies, comparisons and other processes."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.bench.compare_study import run_comparison
from biped_adrc.bench.settings import AS_PUBLISHED
from biped_adrc.bench.study_file import read_study
from biped_adrc.bench.sweep import sweep
from biped_adrc.campaign.workers import Processes, Threads
from biped_adrc.cli import app
from biped_adrc.errors import InputError
from biped_adrc.scenario import registry
from biped_adrc.scenario.build import build

FAST = {"engine": "compiled", "impacts": 1, "hardware": "ideal"}


def command(*arguments: str) -> str:
    done = CliRunner().invoke(app, arguments, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return " ".join(done.output.split())


def peak(**values: object) -> float:
    return ba.walk_scenario(ba.Scenario(**{**FAST, **values})).signals.peak_error


def test_an_own_controller_walks_as_the_one_that_it_copies(own: str) -> None:
    usual = peak(controller="NPD")
    assert peak(controller=f"{own}:Mine") == pytest.approx(usual, rel=1e-6)
    softer = peak(controller=f"{own}:Mine", own={"gain": 0.5})
    assert softer == pytest.approx(peak(controller="NPD", K_p=2500.0, K_d=25.0), rel=1e-6)
    assert softer > 1.2 * usual


def test_on_the_command_line(own: str) -> None:
    name = f"{own}:Mine"
    done = command(
        "simulate", "--controller", name, "--set", "gain=0.5", "--impacts", "1", "--engine",
        "compiled", "--period", "0.001", "--set", "delay=1 ms", "-o", "mine.npz",
    )  # fmt: skip
    assert "1 impacts" in done
    record = json.loads(Path("mine.json").read_text())["settings"]["scenario"]
    assert record["own"] == {"gain": 0.5}
    assert record["delay"] == 1e-3
    leso = command(
        "simulate", "--controller", "leso", "--impacts", "1", "--engine", "compiled",
        "--hardware", "ideal",
    )  # fmt: skip
    assert "1 impacts" in leso


def test_an_observer_and_a_push_of_ones_own(own: str) -> None:
    push = build(ba.Scenario(push=f"{own}:Shove", amplitude=3.0)).disturbance
    assert type(push).__name__ == "Shove"
    assert push.amplitude[0] == 3.0
    seen = build(ba.Scenario(observer="high gain", own={"epsilon": 2e-3}, order=2)).controller
    assert (type(seen.observer).__name__, seen.observer.m) == ("HighGainObserver", 2)


@pytest.mark.parametrize(
    ("crew", "name"), [(Processes(1), ""), (Threads(1), ""), (Processes(1), "of mine")]
)
def test_a_sweep_over_its_own_gain(own: str, tmp_path, monkeypatch, crew, name: str) -> None:
    if name:
        monkeypatch.setattr(registry, "REGISTRY", {k: {**v} for k, v in registry.REGISTRY.items()})
        ba.register("controller", name, registry.own("controller", f"{own}:Mine"))
    tables = {
        "study": {"name": "gains"},
        "fixed": {"controller": name or f"{own}:Mine", "impacts": 1},
        "grid": {"own.gain": [0.5, 1.0]},
    }
    table = sweep(read_study(tables), tmp_path / "out", crew).table()
    assert list(table["own.gain"]) == [0.5, 1.0]
    assert all(table["survived"] == 1)
    assert table["peak_error"][0] > 1.2 * table["peak_error"][1]


def test_its_source_belongs_to_the_numbers(own: str, tmp_path) -> None:
    study = read_study(
        {"study": {"name": "a"}, "fixed": {"controller": f"{own}:Mine", "impacts": 1}}
    )
    sweep(study, tmp_path / "out", Threads(1))
    path = tmp_path / f"{own}.py"
    path.write_text(path.read_text().replace("a gain of its own", "another gain"))
    del sys.modules[own]
    with pytest.raises(InputError, match=rf"other versions.*source {own}:Mine"):
        sweep(study, tmp_path / "out", Threads(1))


def test_a_comparison_with_it(own: str, tmp_path) -> None:
    name = f"{own}:Mine"
    asked = ["NPD", name], ["nothing"], 1, False, Threads(1)
    summary = run_comparison(tmp_path / "out", "compare", *asked, settings=AS_PUBLISHED)
    assert summary["controllers"][name] == "NPD of one page, with a gain of its own."
    one, other = summary["cells"]
    assert other["peak_error"][0] == pytest.approx(one["peak_error"][0], rel=1e-3)


def test_a_class_that_is_registered_has_a_name(own: str, monkeypatch) -> None:
    monkeypatch.setattr(registry, "REGISTRY", {k: dict(v) for k, v in registry.REGISTRY.items()})
    Mine = registry.own("controller", f"{own}:Mine")
    ba.register("controller", "mine", Mine)
    assert isinstance(build(ba.Scenario("Mine")).controller, Mine)
    for taken in ("mine", "npd", "ADRC-output", "a.b:C", " "):
        with pytest.raises(InputError, match="taken or reads as module:Class"):
            ba.register("controller", taken, Mine)
    with pytest.raises(InputError, match="no kind 'law'"):
        ba.register("law", "mine", Mine)
    with pytest.raises(InputError, match="expected a class or a function"):
        ba.register("controller", "other", 3)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"controller": "nowhere_at_all.x:Mine"}, "no module 'nowhere_at_all'.*installed"),
        ({"controller": "OWN:Mien"}, "no class 'Mien'; it has .'Mine'"),
        ({"controller": "OWN:Lawless"}, "neither a method output.*nor laws"),
        (
            {"controller": "OWN:NoController"},
            "made a NoController, expected one of class Controller",
        ),
        ({"controller": "OWN:Outer.Wrong"}, "no class 'Outer.Wrong'"),
        ({"controller": "collections:ChainMap.get"}, "a function that has to make a Controller"),
        ({"controller": "json:loads"}, "a function that has to make a Controller, needs s"),
        ({"controller": "fractions:Fraction.numerator"}, "no class 'Fraction.numerator'"),
        ({"controller": "zipfile:ZipFile"}, "is no Controller; expected a class below it"),
        ({"controller": "builtins:dict"}, "no signature found"),
        ({"controller": "OWN:Needy"}, "needs stiffness; give --set stiffness="),
        ({"controller": "OWN:Mine", "own": {"gian": 1.0}}, "'gian'.*did you mean 'gain'"),
        ({"controller": "OWN:Mine", "K_p": 3.0}, "takes no K_p: this would do nothing"),
        ({"controller": "NPD", "bandwidth": 3.0}, "takes no bandwidth: this would do nothing"),
        ({"poles": "-9,-9,-9", "order": 1}, "poles and an order: this would do nothing"),
        *(
            (
                {"first_step": 5, "pushed_step": 4, **of},
                "pushed_step = 4 before first_step = 5: this",
            )
            for of in ({"push": "pulse", "amplitude": 9.0}, {"ground_step": 0.01})
        ),
        ({"delay": 1e-3}, "delay without a period: this would do nothing"),
        ({"lag": 1e-3}, "lag without a period: this would do nothing"),
        ({"frequency": 3.0}, "frequency without a push: this would do nothing"),
        (
            {"push": "pulse", "amplitude": 9.0, "frequency": 3.0},
            "'pulse' on 'q1,q2,q3,q4' takes no frequency: this would do nothing",
        ),
        ({"controller": "NPD", "own": {"bandwith": 3}}, "own value 'bandwith'"),
        *(
            ({"controller": "NPD", "own": {name: 3}}, f"'{name}'.*from {source} of the scenario")
            for name, source in {
                "reference": "gait",
                "gait": "gait",
                "outputs": "gait",
                "biped": "robot",
                "gains": "K_p and K_d",
                "K_p": "K_p",
                "torque_limit": "torque_limit",
            }.items()
        ),
        ({"own": {"reset": "none"}}, "'reset'.*from reset of the scenario"),
        ({"own": {"observer": "GPI"}}, "'observer'.*from observer of the scenario"),
        ({"own": {"poles": [-1.0]}, "poles": "-9,-9,-9"}, "'poles'.*from poles of the scenario"),
        ({"own": {"solve_theta": "no"}}, "'solve_theta'.*from solve_theta of the scenario"),
        ({"push": "pulse", "own": {"amplitude": [9.0]}}, "'amplitude'.*from amplitude of the"),
        ({"push": "pulse", "own": {"step": 1}}, "'step'.*from pushed_step of the scenario"),
        ({"push": "pulse", "own": {"stop": 1}}, "'stop'.*from duration of the scenario"),
        ({"controller": "CLF-QP", "solve_theta": False}, "takes no solve_theta"),
        ({"controller": "ADRC", "order": 3}, "m = 3 has 5 poles, found 9"),
        ({"controller": "ADCR"}, "did you mean 'ADRC'"),
        ({"controller": "stride PI", "own": {"inner": "stride pi"}}, "around an inner controller"),
        ({"controller": "passive"}, "does not fit robot 'rabbit' with 4 motors"),
        ({"robot": "compass"}, "'ADRC' does not fit robot 'compass' with 0 motors"),
        ({"observer": "luenberger"}, "observer 'luenberger' is unknown"),
        ({"push": "gust"}, "disturbance 'gust' is unknown"),
        ({"push": "pulse", "force": 3.0}, "write on = 'link NAME'"),
    ],
)
def test_what_is_wrong_is_said(own: str, values: dict, message: str) -> None:
    values = {k: x.replace("OWN", own) if isinstance(x, str) else x for k, x in values.items()}
    with pytest.raises(InputError, match=message):
        build(ba.Scenario(**values))


def test_a_module_that_does_not_import(own: str, tmp_path) -> None:
    (tmp_path / f"{own}_broken.py").write_text("1 / 0\n")
    with pytest.raises(InputError, match=r"failed with ZeroDivisionError.*python -c"):
        build(ba.Scenario(f"{own}_broken:Mine"))


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("import sys\nsys.exit(0)\n", "importing '.*' failed with SystemExit: 0"),
        (
            "class Mine:\n    def __init__(self):\n        raise SystemExit(0)\n",
            "could not be made: SystemExit: 0",
        ),
    ],
)
def test_a_module_or_a_class_that_exits(own: str, tmp_path, code: str, message: str) -> None:
    """It ends no command: one that walked nothing would end with exit code 0."""
    (tmp_path / f"{own}_exits.py").write_text(code)
    with pytest.raises(InputError, match=message):
        build(ba.Scenario(f"{own}_exits:Mine"))
    done = CliRunner().invoke(app, ["simulate", "--controller", f"{own}_exits:Mine"])
    assert isinstance(done.exception, InputError)


PARTS = """
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

import biped_adrc as ba
from biped_adrc.gait.reference import ReferenceLaws, ReferencePoint
from biped_adrc.observers.chain import chain_laws


class K(NamedTuple):
    {parameters}
    scale: float = 1.0


@dataclass(frozen=True)
class Seen(ba.Observer):
    @property
    def laws(self):
        return chain_laws(K(), lambda k, Z, y, u: np.zeros((3, 4)))


def point(k, t, q, v):
    {point}


@dataclass(frozen=True)
class Tracked(ba.Reference):
    @property
    def laws(self):
        return ReferenceLaws(K(), point)


def tracking(gait):
    return ba.NPDController(Tracked())
"""


@pytest.mark.parametrize(
    ("parameters", "message"),
    [("other: int = 3", "order = None"), ("order: float = 3.0", "order = 3.0")],
)
def test_an_observer_without_an_order(tmp_path, own: str, parameters: str, message: str) -> None:
    text = PARTS.format(parameters=parameters, point="return None")
    (tmp_path / f"{own}_seen.py").write_text(text)
    with pytest.raises(InputError, match=rf"Seen.laws have {message}.*expected a whole number"):
        build(ba.Scenario("ADRC", observer=f"{own}_seen:Seen"))


@pytest.mark.parametrize(
    ("point", "message"),
    [
        ("return ReferencePoint(*np.zeros((3, 3)), np.zeros((3, 5)))", r"q_d of shape \(3,\)"),
        ("return ReferencePoint(*np.zeros((3, 4)), np.zeros((4, 4)))", r"H of shape \(4, 4\)"),
        ("return (*np.zeros((3, 4)), np.zeros((4, 5)))", "gives a tuple"),
    ],
)
@pytest.mark.parametrize("around", [False, True])
def test_a_reference_of_another_shape(tmp_path, own: str, point, message, around: bool) -> None:
    (tmp_path / f"{own}_tracked.py").write_text(
        PARTS.format(parameters="order: int = 3", point=point)
    )
    name = f"{own}_tracked:tracking"
    values = {"controller": name, "own": {}}
    if around:
        values = {"controller": "delayed", "own": {"inner": name, "delay": 1e-3}}
    with pytest.raises(InputError, match=f"Tracked gives.* {message}|Tracked {message}"):
        ba.walk_scenario(ba.Scenario(impacts=1, **values))


def test_what_is_made_of_the_scenarios_values() -> None:
    def made(**values):
        return build(ba.Scenario(**values)).controller

    leso = made(controller="LESO")
    assert (leso.observer.m, set(leso.observer.poles)) == (1, {-500.0})
    assert made(controller="LESO", bandwidth=300.0).observer.m == 1
    assert made(controller="LESO", poles="-10,-20,-30,-40").observer.m == 2
    assert made(controller="ADRC").observer == ba.GPIObserver.from_poles(ba.TABLE_I)
    assert made(controller="PD", K_d=9.0).gains == type(made(controller="PD").gains)(K_d=9.0)
    assert made(controller="NPD", K_p=9.0, solve_theta=False).gains == ba.Gains(9.0, 50.0)
    around = made(controller="stride PI", own={"inner": "DOB", "limit": 0.4}, bandwidth=99.0)
    assert type(around.inner.observer).__name__ == "MomentumObserver"
    assert set(around.inner.observer.poles) == {-99.0}
    assert around.gains.limit == 0.4
    assert made(controller="DOB").observer == type(made(controller="DOB"))(leso.reference).observer
    assert made(controller="CLF-QP", own={"epsilon": 0.02}).torque_limit is None
    late = made(controller="delayed", own={"delay": 1e-3, "order": 2}, bandwidth=300.0, order=1)
    assert (late.order, late.inner.observer.m) == (2, 1)


def test_a_class_inside_a_class(own: str, tmp_path: Path) -> None:
    (tmp_path / f"{own}_outer.py").write_text(
        f"from {own} import Mine\nclass Outer:\n    class Inner(Mine):\n        pass\n"
    )
    walk = ba.walk_scenario(ba.Scenario(f"{own}_outer:Outer.Inner", **FAST))
    Inner = type(walk.walker.controller)
    assert Inner.__qualname__ == walk.controller_name == "Outer.Inner"
    again = ba.load_walk(walk.save(tmp_path / "a.npz"), controller=Inner)
    assert isinstance(again.walker.controller, Inner)


def test_the_working_directory_is_looked_in_for_names_of_the_user_alone(own: str) -> None:
    build(ba.Scenario("LESO"))
    assert str(Path.cwd()) not in sys.path
    build(ba.Scenario(f"{own}:Mine"))
    assert str(Path.cwd()) == sys.path[-1]


def test_choices_are_those_of_the_package() -> None:
    from biped_adrc.engine.run import ENGINES
    from biped_adrc.scenario.run import METHODS
    from biped_adrc.scenario.scenario import CHOICES

    assert set(CHOICES["engine"]) == set(ENGINES)
    assert set(CHOICES["method"]) == set(METHODS)
    assert set(CHOICES["reset"]) == {policy.value for policy in ba.ResetPolicy}


def test_a_robot_and_a_gait_of_ones_own(own: str, tmp_path) -> None:
    (tmp_path / f"{own}_parts.py").write_text(
        "import biped_adrc as ba\n"
        "def robot(preset=None, friction=False):\n"
        "    return ba.Biped.load('rabbit', preset, friction)\n"
        "def gait(biped):\n"
        "    return ba.load_gait('v0.5', biped)\n"
    )
    s = ba.Scenario("NPD", robot=f"{own}_parts:robot", gait=f"{own}_parts:gait", **FAST)
    assert ba.walk_scenario(s).gait.name == "v0.5"
