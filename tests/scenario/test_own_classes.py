"""Classes of one's own by module:Class: on the command line, in studies, and in other processes.

The fixture own is the name of a module in the working directory, with the controllers Mine (NPD with a factor
`gain`), Needy and Lawless, and a push Shove. peak(**values) is the largest tracking error of a walk of one
step.
"""

from __future__ import annotations

import pytest

import biped_adrc as ba
from biped_adrc.core import registry
from biped_adrc.core.errors import InputError
from biped_adrc.scenario.build import build
from tests.commands import command

FAST = {"run.engine": "compiled", "run.impacts": 1, "hardware.profile": "ideal"}


def peak(**values: object) -> float:
    return ba.walk_scenario(ba.Scenario(**{**FAST, **values})).signals.peak_error


def test_an_own_controller_walks_as_the_one_that_it_copies(own: str) -> None:
    """`Mine`, a class in a module of the working directory, is NPD by other words: the same largest error. Half
    its gain is half of K_p = 5000 and K_d = 50.
    """
    usual = peak(controller="NPD")
    assert peak(controller=f"{own}:Mine") == pytest.approx(usual, rel=1e-6)
    softer = peak(controller={"name": f"{own}:Mine", "gain": 0.5})
    assert softer == pytest.approx(
        peak(controller={"name": "NPD", "K_p": 2500.0, "K_d": 25.0}), rel=1e-6
    )
    assert softer > 1.2 * usual


def test_an_own_controller_and_its_gain_are_taken_on_the_command_line(own: str) -> None:
    """The gain of the class Mine is in the stored scenario like a value of the package's own."""
    name = f"{own}:Mine"
    done = command(
        "simulate", "--controller", name, "--set", "controller.gain=0.5", "--impacts", "1", "--engine",
        "compiled", "--period", "0.001", "--set", "hardware.delay=1 ms", "-o", "mine.npz",
    )  # fmt: skip
    assert "1 impact," in " ".join(done.split())
    record = ba.load_walk("mine.npz").trajectory.settings["scenario"]
    assert record["controller"]["gain"] == 0.5
    assert record["hardware"]["delay"] == 1e-3


def test_a_push_of_ones_own_and_an_observer_of_the_package_are_built_by_their_names(
    own: str,
) -> None:
    """The scenario's torque reaches the push and its order the observer, which takes epsilon too."""
    push = build(ba.Scenario(pushes=[{"shape": f"{own}:Shove", "torque": 3.0}])).disturbance
    assert type(push).__name__ == "Shove"
    assert push.amplitude[0] == 3.0
    seen = build(
        ba.Scenario({"observer": {"name": "high gain", "epsilon": 2e-3, "order": 2}})
    ).controller
    assert (type(seen.observer).__name__, seen.observer.m) == ("HighGainObserver", 2)


@pytest.mark.parametrize("name", ["", "of mine"])
def test_a_study_of_its_own_gain(own: str, tmp_path, monkeypatch, name: str) -> None:
    """name: that by which the class is registered, or "" for module:Class. A grid over its gain has both gains
    in its rows, and half the gain has a larger error.
    """
    if name:
        # a copy, so that the name is forgotten after the test
        monkeypatch.setattr(registry, "REGISTRY", {k: {**v} for k, v in registry.REGISTRY.items()})
        ba.register("controller", name, registry.find("controller", f"{own}:Mine").load())
    tables = {
        "name": "gains",
        "base": {"controller.name": name or f"{own}:Mine", "run.impacts": 1},
        "grid": {"controller.gain": [0.5, 1.0]},
    }
    low, high = ba.study(tables, tmp_path / "out", 1).rows()
    assert (low["controller.gain"], high["controller.gain"]) == (0.5, 1.0)
    assert low["survived"] == high["survived"] == 1
    assert low["peak_error"] > 1.2 * high["peak_error"]


def test_a_class_that_is_registered_has_a_name(own: str, monkeypatch) -> None:
    """The name is found in any case of letters. Names that are taken, read as module:Class or are empty, kinds
    that do not exist, and what is no class are refused.
    """
    # a copy, so that the names are forgotten after the test
    monkeypatch.setattr(registry, "REGISTRY", {k: dict(v) for k, v in registry.REGISTRY.items()})
    Mine = registry.find("controller", f"{own}:Mine").load()
    ba.register("controller", "mine", Mine)
    assert isinstance(build(ba.Scenario("Mine")).controller, Mine)
    # "ADRC-output" is the package's "ADRC output": case, spaces and hyphens do not count
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
        ({"controller": "nowhere_at_all.x:Mine"}, "No module named 'nowhere_at_all'.*installed"),
        ({"controller": "OWN:Mien"}, "has no attribute 'Mien'"),
        ({"controller.name": "NPD", "controller.Kp": 0.1}, "did you mean 'K_p'"),
        ({"controller": "OWN:Lawless"}, "Lawless has no method output"),
        ({"controller": "OWN:Needy"}, "needs stiffness; give controller.stiffness"),
        ({"controller": "finite time"}, "give controller.alpha, controller.eps"),
        (
            {"controller": "OWN:Mine", "controller.gian": 1.0},
            "controller.gian.*did you mean 'gain'",
        ),
        (
            {"controller.name": "OWN:Mine", "controller.K_p": 3.0},
            "controller.K_p: .* does not take it",
        ),
        ({"pushes.0.gain": 1.0}, "pushes.0.gain: unknown name"),
        (
            {"controller.name": "CLF-QP", "controller.solve_theta": False},
            "solve_theta: 'CLF-QP' does not take it",
        ),
    ],
)
def test_wrong_classes_of_the_user_s_are_refused_with_the_reason(
    own: str, values: dict, message: str
) -> None:
    """OWN stands for the module of the fixture `own`, whose classes Lawless (no output) and Needy (an argument
    that no scenario has) are wrong on purpose.
    """
    values = {k: x.replace("OWN", own) if isinstance(x, str) else x for k, x in values.items()}
    with pytest.raises(InputError, match=message):
        ba.walk_scenario(ba.Scenario(**values))


def test_a_controller_is_made_of_the_scenarios_values_and_of_its_own_defaults() -> None:
    """What a scenario names is set and the rest is the class's own: order m and poles of observers, gains, and
    the inner controller of an outer loop.
    """

    def made(**values):
        return build(ba.Scenario(**values)).controller

    leso = made(controller="LESO")
    assert (leso.observer.m, set(leso.observer.poles)) == (1, {-500.0})
    assert made(controller={"name": "LESO", "observer": {"bandwidth": 300.0}}).observer.m == 1
    # an observer of order m has m + 2 poles
    poles = {"controller": "LESO", "controller.observer.poles": "-10,-20,-30,-40"}
    assert made(**poles).observer.m == 2
    assert made(controller="ADRC").observer == ba.GPIObserver.from_poles(ba.TABLE_I)
    assert made(controller={"name": "PD", "K_d": 9.0}).gains == type(made(controller="PD").gains)(
        K_d=9.0
    )
    npd = {"name": "NPD", "K_p": 9.0, "solve_theta": False}
    assert made(controller=npd).gains == ba.Gains(9.0, 50.0)
    dob = {"name": "DOB", "observer": {"bandwidth": 99.0}}
    around = made(controller={"name": "stride PI", "limit": 0.4, "inner": dob})
    assert type(around.inner.observer).__name__ == "MomentumObserver"
    assert set(around.inner.observer.poles) == {-99.0}
    assert around.gains.limit == 0.4
    assert made(controller="DOB").observer == type(made(controller="DOB"))(leso.reference).observer
    assert made(controller={"name": "CLF-QP", "epsilon": 0.02}).torque_limit is None
    adrc = {"observer": {"bandwidth": 300.0, "order": 1}}
    late = made(controller={"name": "delayed", "delay": 1e-3, "order": 2, "inner": adrc})
    assert (late.order, late.inner.observer.m) == (2, 1)


def test_a_robot_and_a_gait_may_come_from_functions_of_ones_own(own: str, tmp_path) -> None:
    """Both are named by module:function; that of the robot is called with preset and friction, that of the gait
    with the robot.
    """
    (tmp_path / f"{own}_parts.py").write_text(
        "import biped_adrc as ba\n"
        "def robot(preset=None, friction=False):\n"
        "    return ba.Biped.load('rabbit', preset, friction)\n"
        "def gait(biped):\n"
        "    return ba.load_gait('v0.5', biped)\n"
    )
    s = ba.Scenario("NPD", robot=f"{own}_parts:robot", gait=f"{own}_parts:gait", **FAST)
    assert ba.walk_scenario(s).gait.name == "v0.5"
