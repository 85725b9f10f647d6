"""An exported controller as an FMU of FMI 2.0: FMPy steps it beside the C, call by call.

An FMU is a zip with a description and a program. Its inputs are q, v and the switch `touchdown`, its outputs
the torque u and `flag`; U, TOUCHDOWN and FLAG are their numbers. It steps every 1.5 ms. `folder` is the FMU
unpacked, `loaded` the same controller as C without FMI, `calls` its calls in a walk with two touchdowns and
`torques` what it returns for them. A `Stepped` is an instance of the FMU: `given` sets inputs, `run(calls)`
steps, `made` are flag and torque, `said` is what it logged.
"""

import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    defaultCallbacks,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2OK,
    fmi2Warning,
)
from fmpy.validation import validate_fmu

from biped_adrc.extras.export import loaded as loading
from biped_adrc.extras.export.export import contents, fmu_of
from biped_adrc.extras.export.loaded import NOT_MEASURED, OK
from tests.export.calls import recorded

N, P, PERIOD = 5, 4, 1.5e-3
U = 2 * N
TOUCHDOWN, FLAG = U + P, U + P + 1


@pytest.fixture(scope="module")
def loaded():
    """The exported controller in this process, without FMI."""
    return recorded("on a robot")[0]


@pytest.fixture(scope="module")
def calls():
    """Its calls in a walk with two touchdowns that are noticed."""
    return recorded("on a robot")[1]


@pytest.fixture(scope="module")
def torques(loaded, calls):
    """Torques (K, p) of the calls of step through the C, where init is at the first of them, as in FMI."""
    steps = [call for call in calls if call.kind == "step"]
    flag, x = loaded.init(loaded.measured(*steps[0][1:4]))
    out = []
    for call in calls[1:]:
        m = loaded.measured(*call[1:4])
        assert flag == OK
        if call.kind == "touchdown":
            flag = loaded.touchdown(x, m)
        else:
            flag, u = loaded.step(x, m)
            out.append(u)
    return np.array(out)


@pytest.fixture(scope="module")
def folder(loaded, tmp_path_factory):
    """The FMU as a folder."""
    return unpacked(fmu_of(loaded.source), tmp_path_factory.mktemp("fmu"))


def unpacked(fmu, place):
    """The folder of an FMU, which is written as a file beside it."""
    (place / fmu.name).write_bytes(fmu.data)
    return Path(fmpy.extract(place / fmu.name, unzipdir=place / "fmu"))


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
        guid = fmpy.read_model_description(folder).guid
        of = {"guid": guid, "modelIdentifier": "controller", "instanceName": "a"}
        self.slave = FMU2Slave(unzipDirectory=folder, **of)
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
    """FMPy's own check finds nothing; ports are q, v, u, touchdown and flag in this order, with units and names
    of joints, and the step is the period of 1.5 ms.
    """
    assert validate_fmu(str(folder.parent / "controller.fmu")) == []
    found = fmpy.read_model_description(folder, validate_model_structure=True)
    ports = {x.name: (x.causality, x.variability, x.unit) for x in found.modelVariables}
    assert ports["q[4]"] == ("input", "continuous", "rad")
    assert ports["u[3]"] == ("output", "discrete", "N.m")
    assert ports["touchdown"][:2] == ("input", "discrete")
    assert [x.valueReference for x in found.modelVariables] == list(range(len(ports)))
    names = [*(f"q[{i}]" for i in range(N)), *(f"v[{i}]" for i in range(N))]
    assert [*ports] == [*names, *(f"u[{i}]" for i in range(P)), "touchdown", "flag"]
    assert "left_hip" in found.modelVariables[0].description
    assert float(found.defaultExperiment.stepSize) == PERIOD
    assert all(x.dependencies == [] for x in found.outputs)  # u is of the sample before


def test_the_c_is_unchanged_and_the_archive_is_the_same_each_time(loaded, folder):
    """Sources are those of the export; made again, the archive has the same bytes, as its files have a fixed
    date. The description comes first, as the standard asks.
    """
    for name in ("controller.c", "controller.h"):
        assert (folder / "sources" / name).read_text() == loaded.source.files[name]
    assert fmu_of(loaded.source).data == (folder.parent / "controller.fmu").read_bytes()
    with zipfile.ZipFile(folder.parent / "controller.fmu") as archive:
        assert archive.namelist()[0] == "modelDescription.xml"
        assert {x.date_time for x in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_the_torques_are_those_of_the_c_bit_for_bit(folder, calls, torques):
    """The walk goes over two touchdowns, with torques beyond 90 N m, so that there is something to differ."""
    assert [call.kind for call in calls].count("touchdown") == 2
    assert np.max(np.abs(torques)) > 90.0
    with Stepped(folder) as fmu:
        np.testing.assert_array_equal(fmu.run(calls), torques)
        assert not fmu.said


def test_without_a_compiler_it_has_its_sources_alone(loaded, monkeypatch):
    """`which` finds no compiler: the archive has no folder of binaries, and says so."""
    assert contents() == "sources, and a binary for linux64"
    monkeypatch.setattr(loading.shutil, "which", lambda name: None)
    assert "sources alone, since there is no C compiler" in contents()
    assert not any("binaries" in path for path in fmu_of(loaded.source).files)


def test_a_state_that_was_saved_goes_on_equally_also_in_another_instance(folder, calls, torques):
    """Saved three calls after the first touchdown: the first instance goes on, returns to the saved state and
    goes on again, a second one takes it as bytes. Bytes that are cut off are refused.
    """
    half = next(i for i, call in enumerate(calls) if call.kind == "touchdown") + 3
    done = sum(call.kind == "step" for call in calls[:half])
    with Stepped(folder) as fmu, Stepped(folder) as other:
        fmu.run(calls[:half])
        state = fmu.slave.getFMUstate()
        fmu.run(calls[half - 1 :])  # - 1: `run` leaves out the first of its calls
        fmu.slave.setFMUstate(state)
        data = fmu.slave.serializeFMUstate(state)
        other.slave.setFMUstate(other.slave.deSerializeFMUstate(data))
        for again in (fmu, other):
            np.testing.assert_array_equal(again.run(calls[half - 1 :]), torques[done:])
        fmu.slave.freeFMUstate(state)
        with pytest.raises(FMICallException):
            fmu.slave.deSerializeFMUstate(data[:-1])
        assert "not as many bytes" in fmu.said[-1][1]


WRONG = {
    "two periods": (0.0, 2 * PERIOD, "the communication step is 0.003 s"),
    "a point left out": (PERIOD, PERIOD, "the communication point is 0.0015 s, expected 0 s"),
    "no time": (np.nan, PERIOD, "the communication point is nan"),
    "beyond the end": (0.0, PERIOD, "beyond the end"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_step_is_refused_until_reset(folder, calls, torques, name):
    """WRONG: time and length of the step, words of the error. After it any step is refused; after a reset the
    torques are those from the start again.
    """
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
    """At 1e4 s sums of 1.5 ms are off by 1e-12 s; no step is refused, as `do_step` would raise."""
    with Stepped(folder, start=1e4) as fmu:
        t = 1e4
        for call in calls[1:200]:
            fmu.given(call.q, call.v)
            fmu.do_step(t, (t + PERIOD) - t)
            t += PERIOD


def test_what_is_not_measured_ends_in_the_safe_torque_and_a_touchdown_then_waits(
    folder, loaded, calls
):
    """Without a measurement the last torque is held for five samples and is then zero, as in C. The switch that
    goes on meanwhile is the touchdown of the first sample that is measured again.
    """
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
            # in C the time is NaN in place of an angle: the sample is lost in the same way
            assert loaded.step(x, loaded.measured(np.nan, q, q))[0] == NOT_MEASURED
        for i, call in enumerate(calls[landing + 8 : landing + 12]):
            t += PERIOD
            m = loaded.measured(t, call.q, call.v)
            fmu.given(call.q, call.v, touchdown=True)
            assert fmu.do_step(t) == fmi2OK
            assert i > 0 or loaded.touchdown(x, m) == OK  # in C called once, at the first of them
            assert fmu.made == (OK, loaded.step(x, m)[1].tolist())
        assert x["step"] == 2
        assert {x for x, _ in fmu.said} == {fmi2Warning}


def test_a_switch_that_is_on_from_the_start_is_no_touchdown(folder, calls, torques):
    """A touchdown is the switch's going on; here it never does, so the torques are those of step 1."""
    with Stepped(folder) as fmu:
        for i, call in enumerate(calls[1:20]):
            fmu.given(call.q, call.v, touchdown=True)
            fmu.do_step(call.t)
            assert fmu.made == (OK, torques[i].tolist())


def after_the_end(fmu):
    fmu.slave.terminate()
    fmu.slave.setReal([0], [0.0])


def not_measured(fmu):
    fmu.given(np.full(N, np.nan), np.zeros(N))
    fmu.do_step(0.0)


CALLS = {
    "an input after the end": after_the_end,
    "a start without a measurement": not_measured,
    "a step before the start": lambda fmu: fmu.do_step(0.0),
    "a second start": lambda fmu: fmu.initialized(),
    "a torque as input": lambda fmu: fmu.slave.setReal([U], [1.0]),
    "no such number": lambda fmu: fmu.slave.getReal([TOUCHDOWN]),
    "a derivative": lambda fmu: fmu.slave.getDirectionalDerivative([U], [0], [1.0]),
    "an end that is no time": lambda fmu: fmu.slave.setupExperiment(startTime=np.nan),
}


@pytest.mark.parametrize("name", CALLS)
def test_what_fmi_does_not_allow_is_refused(folder, name):
    """name: of a call in CALLS that the standard forbids in this state; two of them need an instance that has
    not started. Each logs one message.
    """
    with Stepped(folder) as fmu:
        if name in ("a step before the start", "an end that is no time"):
            fmu.slave.reset()
        with pytest.raises(FMICallException):
            CALLS[name](fmu)
        assert len(fmu.said) == 1


COMPILERS = ["gcc -std=c99", "g++ -x c++", *(["clang -std=c99"] if shutil.which("clang") else [])]
"""The first two are wherever packages are built; the third is asked where it is."""
HEADERS = Path(fmpy.__file__).parent / "c-code"
"""The standard's own, as FMPy brings them."""


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize(("headers", "real"), [([], "float"), ([f"-I{HEADERS}"], "double")])
def test_no_compiler_warns(folder, compiler, headers, real):
    """The FMU's source is compiled with all warnings as errors: with its own declarations in float, and with
    the standard's headers in double.
    """
    program, *flags = compiler.split()
    strict = ["-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-DCONTROLLER_REAL={real}"]
    files = [*headers, "-c", "-o", os.devnull, str(folder / "sources" / "controller_fmu.c")]
    subprocess.run([program, *flags, *strict, *files], check=True)
