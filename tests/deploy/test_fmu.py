"""An exported controller as an FMU of FMI 2.0: FMPy steps it beside the C, call by call."""

import ctypes
import os
import shutil
import subprocess
import sysconfig
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.build import build_platform_binary
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    defaultCallbacks,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2CoSimulation,
    fmi2LastSuccessfulTime,
    fmi2ModelExchange,
    fmi2OK,
    fmi2Warning,
)
from fmpy.validation import validate_fmu

import biped_adrc as ba
from biped_adrc.deploy import loaded as loading
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.export import export_c, write_folder
from biped_adrc.deploy.fmu import Fmu, contents, fmu_of
from biped_adrc.deploy.loaded import FLAGS, NOT_MEASURED, OK, Loaded
from biped_adrc.deploy.records import fed, recorded
from biped_adrc.deploy.source import source_of
from biped_adrc.errors import OutputError

SCENARIO = ba.Scenario(  # on a free-running clock: touchdowns are noticed at sample instants
    "LESO",
    hardware="rabbit",
    counts=1e5,
    filter_time=1e-3,
    delay=2e-3,
    delay_known=True,
    rate_limit=3e4,
    bandwidth=100.0,
    contact="hold",
    contact_window=0.015,
    touchdown="kinematics",
    pushes="q1,q2=20@1:0.1-0.3",
    impacts=3,
)
N, P, PERIOD = 5, 4, 1.5e-3
U = 2 * N
TOUCHDOWN, FLAG = U + P, U + P + 1


@pytest.fixture(scope="module")
def computer():
    """The robot's computer of the scenario, and the calls of its walk."""
    walk = ba.walk_scenario(SCENARIO)
    return Computer(walk.walker), recorded(walk.walker, walk.trajectory)


@pytest.fixture(scope="module")
def calls(computer):
    """The calls of the walk."""
    return computer[1]


@pytest.fixture(scope="module")
def loaded(computer):
    """The exported controller in this process, without FMI."""
    return Loaded(source_of(computer[0], scenario=['pushes = "<&>"']))


@pytest.fixture(scope="module")
def torques(loaded, calls):
    """Torques (K, p) of the calls of step through the C, with FMI's order of them."""
    made = fed(loaded, in_order(calls))
    assert not any(made.flags)
    return made.u[~np.isnan(made.u[:, 0])]


@pytest.fixture(scope="module")
def folder(loaded, tmp_path_factory):
    """The FMU as a folder."""
    return unpacked(fmu_of(loaded.source), tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="module")
def leg(tmp_path_factory):
    """The folder and the source of another controller with its FMU, of another prefix and type."""
    place = tmp_path_factory.mktemp("other") / "c"
    return place, export_c(ba.Scenario("NPD", hardware="ideal"), place, "leg", "float32", fmu=True)


def unpacked(fmu, place):
    """The folder of an FMU, which is written as a file beside it."""
    (place / fmu.name).write_bytes(fmu.data)
    return Path(fmpy.extract(place / fmu.name, unzipdir=place / "fmu"))


def in_order(calls):
    """The calls with init at the measurement of the first step."""
    first = next(call for call in calls if call.kind == "step")
    return [first._replace(kind="init"), *calls[1:]]


class Stepped:
    """An instance of an FMU that FMPy steps, and what it said."""

    def __init__(self, folder, stop=None, start=0.0):
        self.said = []
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(
            lambda _, name, status, category, text: self.said.append((status, text.decode()))
        )
        self.callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self.callbacks.freeMemory = defaultCallbacks.freeMemory
        description = fmpy.read_model_description(folder)
        identifier = description.coSimulation.modelIdentifier
        self.slave = FMU2Slave(
            guid=description.guid,
            modelIdentifier=identifier,
            unzipDirectory=folder,
            instanceName="a",
        )
        self.slave.instantiate(callbacks=self.callbacks)
        self.initialized(start, stop)

    def initialized(self, start=0.0, stop=None):
        self.slave.setupExperiment(startTime=start, stopTime=stop)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.slave.freeInstance()

    def given(self, q, v, touchdown=False):
        self.slave.setReal(range(2 * N), [*q, *v])
        self.slave.setBoolean([TOUCHDOWN], [touchdown])

    def do_step(self, t, step=PERIOD):
        return self.slave.fmi2DoStep(self.slave.component, t, step, 1)

    @property
    def made(self):
        """The flag and the torque (p,) [N m]."""
        return self.slave.getInteger([FLAG])[0], self.slave.getReal(range(U, U + P))

    def run(self, calls):
        """Torques of the calls of step, each of which has a result."""
        out = []
        for i, call in enumerate(calls[1:]):
            if call.kind == "step":
                before = {x.kind for x in calls[max(0, i - 3) : i + 1]}  # a switch stays on
                self.given(call.q, call.v, "touchdown" in before)
                assert self.do_step(call.t) == fmi2OK
                flag, u = self.made
                assert flag == OK
                out.append(u)
        return np.array(out)


def test_the_description_is_valid_and_says_what_there_is(folder):
    assert validate_fmu(str(folder.parent / "controller.fmu")) == []
    found = fmpy.read_model_description(folder, validate_model_structure=True)
    ports = {x.name: (x.causality, x.variability, x.unit) for x in found.modelVariables}
    assert ports["q[4]"] == ("input", "continuous", "rad")
    assert ports["v[0]"] == ("input", "continuous", "rad/s")
    assert ports["u[3]"] == ("output", "discrete", "N.m")
    assert ports["touchdown"][:2] == ("input", "discrete")
    assert ports["flag"][:2] == ("output", "discrete")
    assert [x.valueReference for x in found.modelVariables] == list(range(len(ports)))
    names = [*(f"q[{i}]" for i in range(N)), *(f"v[{i}]" for i in range(N))]
    assert [*ports] == [*names, *(f"u[{i}]" for i in range(P)), "touchdown", "flag"]
    assert "left_hip" in found.modelVariables[0].description
    assert float(found.defaultExperiment.stepSize) == PERIOD
    assert all(x.dependencies == [] for x in found.outputs)  # u is of the sample before
    exponents = {x.name: x.baseUnit for x in found.unitDefinitions}
    assert (exponents["N.m"].kg, exponents["N.m"].m, exponents["N.m"].s) == (1, 2, -2)
    assert '"&lt;&amp;&gt;"' in (folder / "documentation" / "index.html").read_text().replace(
        "&#34;", '"'
    )


def test_the_c_is_unchanged_and_the_archive_is_the_same_each_time(loaded, folder):
    for name in ("controller.c", "controller.h"):
        assert (folder / "sources" / name).read_text() == loaded.source.files[name]
    assert fmu_of(loaded.source).data == (folder.parent / "controller.fmu").read_bytes()
    with zipfile.ZipFile(folder.parent / "controller.fmu") as archive:
        assert archive.namelist()[0] == "modelDescription.xml"
        assert {x.date_time for x in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_the_torques_are_those_of_the_c_bit_for_bit(folder, calls, torques):
    assert [call.kind for call in calls].count("touchdown") == 2
    assert np.max(np.abs(torques)) > 90.0
    with Stepped(folder) as fmu:
        np.testing.assert_array_equal(fmu.run(calls), torques)
        last = ctypes.c_double()
        fmu.slave.fmi2GetRealStatus(fmu.slave.component, fmi2LastSuccessfulTime, ctypes.byref(last))
        assert last.value == pytest.approx(calls[-1].t + PERIOD, abs=1e-12)
        assert not fmu.said


def test_from_the_sources_alone_the_torques_are_the_same(
    loaded, calls, torques, tmp_path, monkeypatch
):
    monkeypatch.setattr(loading.shutil, "which", lambda name: None)
    assert "sources alone, since there is no C compiler" in contents()
    folder = unpacked(fmu_of(loaded.source), tmp_path)
    monkeypatch.undo()
    assert contents() == "sources, and a binary for linux64"
    assert not (folder / "binaries").exists()
    monkeypatch.setenv("PATH", sysconfig.get_path("scripts"), prepend=os.pathsep)  # has cmake
    (tmp_path / "build").mkdir()
    options = {"CMAKE_C_FLAGS:STRING": "-ffp-contract=off -Werror"}
    build_platform_binary(folder, tmp_path / "build", all_warnings=True, cmake_options=options)
    with Stepped(folder) as fmu:
        np.testing.assert_array_equal(fmu.run(calls), torques)


def test_fmus_side_by_side_do_not_disturb_each_other(folder, leg, calls, torques):
    place, source = leg
    beside = Loaded(source, "float32")
    steps = [call for call in calls if call.kind == "step"][:200]
    _, x = beside.init(beside.measured(*steps[0][1:4]))
    unpacked(fmu_of(source), place.parent)
    with Stepped(folder) as one, Stepped(folder) as still, Stepped(place.parent / "fmu") as other:
        for i, call in enumerate(steps):
            one.given(call.q, call.v)
            one.do_step(call.t)
            other.given(call.q, call.v)
            other.do_step(i * 1e-3, 1e-3)
            if i == 100:
                still.given(steps[0].q, steps[0].v)
                still.do_step(0.0)
            assert one.made == (OK, torques[i].tolist())
            flag, u = beside.step(x, beside.measured(i * 1e-3, call.q, call.v))
            assert other.made == (flag, u.tolist()) == (OK, u.tolist())
        assert still.made == (OK, torques[0].tolist())


@pytest.mark.parametrize("serialized", [False, True])
def test_a_state_that_was_saved_goes_on_equally(folder, calls, torques, serialized):
    half = next(i for i, call in enumerate(calls) if call.kind == "touchdown") + 3
    done = sum(call.kind == "step" for call in calls[:half])
    with Stepped(folder) as fmu, Stepped(folder) as other:
        fmu.run(calls[:half])
        state = fmu.slave.getFMUstate()
        fmu.run(calls[half - 1 :])
        again = other if serialized else fmu
        if serialized:
            data = fmu.slave.serializeFMUstate(state)
            fmu.slave.freeFMUstate(state)
            state = other.slave.deSerializeFMUstate(data)
            with pytest.raises(FMICallException):
                fmu.slave.deSerializeFMUstate(data[:-1])
            assert "not as many bytes" in fmu.said[-1][1]
        again.slave.setFMUstate(state)
        again.slave.freeFMUstate(state)
        u = again.run(calls[half - 1 :])
    np.testing.assert_array_equal(u, torques[done:])


WRONG = {
    "half a period": (0.0, PERIOD / 2, "expected the sample period, 0.0015 s"),
    "two periods": (0.0, 2 * PERIOD, "the communication step is 0.003 s"),
    "no step": (0.0, np.nan, "the communication step is nan"),
    "a point left out": (PERIOD, PERIOD, "the communication point is 0.0015 s, expected 0 s"),
    "no time": (np.nan, PERIOD, "the communication point is nan"),
    "beyond the end": (0.0, PERIOD, "beyond the end"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_step_is_refused_until_reset(folder, calls, torques, name):
    t, step, words = WRONG[name]
    with Stepped(folder, stop=PERIOD / 2 if name == "beyond the end" else 1.0) as fmu:
        fmu.given(calls[1].q, calls[1].v)
        for _ in range(2):
            with pytest.raises(FMICallException, match="error"):
                fmu.do_step(t, step)
        assert words in fmu.said[0][1]
        assert "fmi2DoStep: FMI 2.0 does not allow" in fmu.said[1][1]
        for _ in range(2):  # a second time after steps
            fmu.slave.reset()
            fmu.initialized()
            np.testing.assert_array_equal(fmu.run(calls[:50]), torques[:49])


def test_rounding_of_the_clock_is_no_wrong_step(folder, calls):
    with Stepped(folder, start=1e4) as fmu:
        t = 1e4
        for call in calls[1:200]:
            fmu.given(call.q, call.v)
            fmu.do_step(t, (t + PERIOD) - t)
            t += PERIOD


def test_what_is_not_measured_ends_in_the_safe_torque_and_a_touchdown_then_waits(
    folder, loaded, calls
):
    landing = next(i for i, call in enumerate(calls) if call.kind == "touchdown")
    _, x = loaded.init(loaded.measured(*calls[1][1:4]))
    with Stepped(folder) as fmu:
        fmu.run(calls[:landing])
        for call in calls[1:landing]:
            _, u = loaded.step(x, loaded.measured(*call[1:4]))
        for i in range(7):
            t = calls[landing + 1].t + i * PERIOD
            q = calls[landing + 1].q
            fmu.given([np.nan, *q[1:]], np.zeros(N), touchdown=True)
            assert fmu.do_step(t) == fmi2Warning
            assert fmu.made == (NOT_MEASURED, u.tolist() if i < 5 else [0.0] * P)
            assert loaded.step(x, loaded.measured(np.nan, q, q))[0] == NOT_MEASURED
        for i, call in enumerate(calls[landing + 8 : landing + 12]):
            t += PERIOD
            m = loaded.measured(t, call.q, call.v)
            fmu.given(call.q, call.v, touchdown=True)
            assert fmu.do_step(t) == fmi2OK
            assert i > 0 or loaded.touchdown(x, m) == OK
            assert fmu.made == (OK, loaded.step(x, m)[1].tolist())
        assert x["step"] == 2
        assert {x for x, _ in fmu.said} == {fmi2Warning}


def test_a_switch_that_is_on_from_the_start_is_no_touchdown(folder, calls, torques):
    with Stepped(folder) as fmu:
        for i, call in enumerate(calls[1:20]):
            fmu.given(call.q, call.v, touchdown=True)
            fmu.do_step(call.t)
            assert fmu.made == (OK, torques[i].tolist())


def test_a_start_without_a_measurement_is_refused(folder):
    with Stepped(folder) as fmu:
        fmu.given(np.full(N, np.nan), np.zeros(N))
        with pytest.raises(FMICallException):
            fmu.do_step(0.0)
        assert "controller_init has no result" in fmu.said[0][1]
        assert fmu.made[1] == [0.0] * P


def after_the_end(fmu):
    fmu.slave.terminate()
    fmu.slave.setReal([0], [0.0])


CALLS = {
    "an input after the end": after_the_end,
    "a step before the start": lambda fmu: fmu.do_step(0.0),
    "a second start": lambda fmu: fmu.initialized(),
    "a torque as input": lambda fmu: fmu.slave.setReal([U], [1.0]),
    "no such number": lambda fmu: fmu.slave.getReal([TOUCHDOWN]),
    "no such yes or no": lambda fmu: fmu.slave.setBoolean([0], [True]),
    "a flag as input": lambda fmu: fmu.slave.setInteger([FLAG], [1]),
    "a text": lambda fmu: fmu.slave.getString([0]),
    "a derivative": lambda fmu: fmu.slave.getDirectionalDerivative([U], [0], [1.0]),
    "an end that is no time": lambda fmu: fmu.slave.setupExperiment(startTime=np.nan),
}


@pytest.mark.parametrize("name", CALLS)
def test_what_fmi_does_not_allow_is_refused(folder, name):
    with Stepped(folder) as fmu:
        if name in ("a step before the start", "an end that is no time"):
            fmu.slave.reset()
        with pytest.raises(FMICallException):
            CALLS[name](fmu)
        assert len(fmu.said) == 1


def test_another_description_model_exchange_and_a_tool_without_memory_are_refused(folder):
    with Stepped(folder) as fmu:

        def made(guid, kind):
            given = b"a", kind, guid.encode(), b"", ctypes.byref(fmu.callbacks), 0, 0
            return fmu.slave.fmi2Instantiate(*given)

        assert made("{another}", fmi2CoSimulation) is None
        assert made(fmu.slave.guid, fmi2ModelExchange) is None
        assert ["GUID" in fmu.said[0][1], "co-simulation" in fmu.said[1][1]] == [True, True]
        fmu.callbacks.allocateMemory = type(fmu.callbacks.allocateMemory)()
        assert made(fmu.slave.guid, fmi2CoSimulation) is None


def test_the_folder_of_the_c_may_hold_its_fmu_and_no_other_file(leg):
    place, source = leg
    assert {x.name for x in place.iterdir()} == {*source.files, "leg.fmu"}
    write_folder(place, source, Fmu("leg.fmu", {}))
    with pytest.raises(OutputError, match=r"leg\.fmu"):
        write_folder(place, source)


COMPILERS = ["gcc -std=c99", "g++ -x c++", *(["clang -std=c99"] if shutil.which("clang") else [])]
"""The first two are wherever packages are built; the third is asked where it is."""
HEADERS = Path(fmpy.__file__).parent / "c-code"
"""The standard's own, as FMPy brings them."""


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize(("headers", "real"), [([], "float"), ([f"-I{HEADERS}"], "double")])
def test_no_compiler_warns(folder, compiler, headers, real):
    program, *flags = compiler.split()
    strict = ["-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-DCONTROLLER_REAL={real}"]
    files = [*headers, "-c", "-o", os.devnull, str(folder / "sources" / "controller_fmu.c")]
    subprocess.run([program, *flags, *strict, *files], check=True)


TOOL = """
#include "controller_fmu.c"
#include <stdlib.h>

int main(void)
{
  const fmi2CallbackFunctions tool = { NULL, calloc, free, NULL, NULL };
  const fmi2ValueReference q[N] = { 0, 1, 2, 3, 4 };
  const fmi2Real x[N] = { QS };
  fmi2Byte bytes[sizeof(kept_type)];
  fmi2FMUstate state = NULL, again = NULL;
  const char *name = "a name that is longer than all the place that a fmu has for names of its own";
  fmi2Component c = fmi2Instantiate(name, fmi2CoSimulation, GUID, NULL, &tool, 0, 0);
  fmi2SetupExperiment(c, 0, 0, 0, 0, 0);
  fmi2EnterInitializationMode(c);
  fmi2SetReal(c, q, N, x);
  fmi2ExitInitializationMode(c);
  if (fmi2DoStep(c, 0, CONTROLLER_PERIOD, 0) != fmi2OK) return 1;
  fmi2GetFMUstate(c, &state);
  fmi2SerializeFMUstate(c, state, bytes, sizeof bytes);
  fmi2DeSerializeFMUstate(c, bytes, sizeof bytes, &again);
  fmi2SetFMUstate(c, again);
  if (fmi2DoStep(c, CONTROLLER_PERIOD, CONTROLLER_PERIOD, 0) != fmi2OK) return 2;
  if (fmi2DoStep(c, 0, 1e300, 0) != fmi2Error || fmi2DoStep(NULL, 0, 0, 0) != fmi2Error) return 3;
  fmi2FreeFMUstate(c, &state);
  fmi2FreeFMUstate(c, &again);
  fmi2FreeInstance(c);
  return 0;
}
"""


def test_sanitizers_find_nothing_in_a_small_tool(folder, calls, tmp_path):
    for path in (folder / "sources").iterdir():
        shutil.copy(path, tmp_path)
    q = ", ".join(map(repr, calls[1].q.tolist()))
    (tmp_path / "tool.c").write_text(TOOL.replace("QS", q))
    flags = (*FLAGS, "-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    assert loading.compiled(tmp_path, ["tool.c", "controller.c"], tmp_path / "tool", flags) == ""
    subprocess.run([tmp_path / "tool"], check=True)
