"""Laws as C functions against the Python they are made from."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from ctypes import CFUNCTYPE, POINTER, c_double
from typing import Generic, NamedTuple, TypeVar

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc import linear
from biped_adrc.control.passive import Passive
from biped_adrc.engine import native
from biped_adrc.engine import native_source as source
from biped_adrc.engine.native import flatten, native_law
from biped_adrc.engine.store import VARIABLE
from biped_adrc.errors import InputError
from biped_adrc.linear import solve
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array
from biped_adrc.walker import Mode

SWAP = np.array([1, 0, 3, 2])
DOUBLES = POINTER(c_double)
T = TypeVar("T")


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, str(folder))
        yield folder


def call(law, size, *arguments):
    """The result of the C function, through its address alone."""
    f = CFUNCTYPE(None, DOUBLES, DOUBLES, DOUBLES)(law.address)
    K, inp, out = flatten(arguments[0]), flatten(arguments[1:]), np.full(size, 7.0)
    f(*(x.ctypes.data_as(DOUBLES) for x in (K, inp, out)))
    return out


def agree(law, examples, tolerance=1e-13):
    """The C function made from the first of these lists of arguments, at all of them, to Python's."""
    expected = [flatten(law(*arguments)) for arguments in examples]
    made = native_law(law, examples[0], len(expected[0]))
    for arguments, numbers in zip(examples, expected, strict=True):
        gap = np.abs(call(made, len(numbers), *arguments) - numbers)
        assert np.max(gap, initial=0.0) <= tolerance * np.max(np.abs(numbers), initial=0.0)
    return made


CONTROLLERS = {
    "NPD as printed": lambda c: ba.NPDController(c, solve_theta=False),
    "ADRC in discrete time": lambda c: ba.ADRCController(
        c, GPIObserver.from_bandwidth(300.0, 1), ba.Gains([4e3, 5e3, 6e3, 7e3], 50.0)
    ).sampled(1e-3),
    "passive": lambda c: Passive(),
}


@pytest.mark.parametrize("name", list(CONTROLLERS))
def test_controllers(biped, gait, name):
    controller = CONTROLLERS[name](gait.constraint)
    laws, walker = controller.laws, ba.Walker(biped, Passive())
    k, random = laws.parameters, np.random.default_rng(3)
    q, v = gait.start(biped)
    found = {key: [] for key in ("initial_state", "output", "flow", "jump", "correct", "predict")}
    for _ in range(5):
        x = q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5)
        m = walker.measure(0.1, *x, Mode())._replace(body=biped.body_terms(*x))
        s = controller.initial_state(m)
        s = s * (1.0 + 0.01 * random.normal(size=len(s)))
        u = 20.0 * random.normal(size=4)
        found["initial_state"].append((k, m))
        found["output"].append((k, s, m))
        found["correct"].append((k, s, m))
        found["jump"].append((k, s, m, SWAP))
        for key in ("flow", "predict"):
            found[key].append((k, s, m, u))
    for key, examples in found.items():
        if getattr(laws, key):
            agree(getattr(laws, key), examples)


@pytest.mark.parametrize(
    "make",
    [
        lambda a: ba.TorquePulse(a, step=2, start=0.1, stop=0.2),
        lambda a: ba.TorqueStep(a, step=2, start=0.1),
        lambda a: ba.TorqueSine(a, start=1.05, frequency=5.0),
    ],
    ids=["pulse", "step", "sine"],
)
def test_disturbances(make):
    (law,) = make(np.array([30.0, -20.0, 5.0, 0.0, 1.0])).laws
    q = np.zeros(5)
    times = (1.0, 1.1, float(np.nextafter(1.2, 0.0)), 1.2, 1.34)
    examples = [(law.parameters, t, step, 1.0, q, q) for step in (1, 2, 3) for t in times]
    agree(law.torque, examples)
    on = [bool(np.any(law.torque(*example))) for example in examples]
    assert any(on)
    assert not all(on)


class Pair(NamedTuple, Generic[T]):
    """Of whatever."""

    left: T
    right: Array
    count: int = 2


class K(NamedTuple):
    """Parameters of the laws below, by a name that the entry uses as well."""

    A: Array
    pair: Pair[Array]
    on: bool
    none: Array


BIAS, TABLE, LIMITS = 0.25, np.array([[1.0, -2.0], [0.5, np.inf]]), Pair(3.0, np.array([4.0]))


def total(k: K, x: Array) -> Array:
    """A name that is also NumPy's, and a @ b in its four forms."""
    return k.A @ x + (x @ k.A) * (x @ x) + (k.A @ k.A)[0] * BIAS


def branching(k: K, x: Array, i: int) -> Pair[Array]:
    """Branches on the data, loops, and every kind of argument and constant."""
    sum: Array = total(k, x)
    if x[0] > 0.0 and k.on:
        sum *= TABLE[0, 1] * LIMITS.left
    elif i > 3:
        sum = np.array([y * y for y in sum]) + LIMITS.right[0]
    for _ in range(k.pair.count):
        sum = np.minimum(np.cos(sum), TABLE[1, 1]) + len(k.none)
    return Pair(sum, np.outer(sum, k.pair.right), i // 2)


def own(random, on):
    A, left, right = random.normal(size=(3, 3)), random.normal(size=2), random.normal(size=4)
    return K(A, Pair(left, right), on, np.zeros((0, 3)))


def test_a_law_that_branches_on_data():
    random = np.random.default_rng(5)
    examples = [
        (own(random, bool(i % 2)), random.normal(size=3), int(random.integers(0, 8)))
        for i in range(20)
    ]
    agree(branching, examples)


def test_flatten():
    tree = (Pair(np.array([[1.0, 2.0], [3.0, 4.0]]).T, np.zeros((0, 2)), 5), True, np.int64(7))
    np.testing.assert_array_equal(flatten(tree), [1.0, 3.0, 2.0, 4.0, 5.0, 1.0, 7.0])
    assert flatten(()).shape == (0,)
    for value in ("word", None, [1.0], 1j, np.array(["a"]), np.array([1j])):
        with pytest.raises(InputError, match=r"argument right of a law is .* expected numbers"):
            flatten(Pair(1.0, value))


def solving(k: Pair[Array], b: Array) -> Array:
    return solve(k.left, b, "k") + linear.solve(k.left, k.right, "k")[:, 0]


def picky(k: Pair[Array], b: Array) -> Array:
    if b[0] < 0.0:
        raise ValueError("negative")
    return b


def test_a_system_solved_in_the_law_and_one_that_is_singular():
    random = np.random.default_rng(6)
    examples = [
        (Pair(random.normal(size=(4, 4)), random.normal(size=(4, 3))), random.normal(size=4))
        for _ in range(20)
    ]
    made = agree(solving, examples, 1e-11)  # some are badly conditioned
    permuted = np.eye(4)[[2, 0, 3, 1]]
    k, b = Pair(permuted, np.zeros((4, 3))), np.arange(4.0)
    np.testing.assert_array_equal(call(made, 4, k, b), solving(k, b))
    with pytest.raises(ba.BipedError, match="singular"):
        solving(k._replace(left=np.ones((4, 4))), b)
    assert np.all(np.isnan(call(made, 4, k._replace(left=np.ones((4, 4))), b)))
    empty = Pair(np.zeros((0, 0)), np.zeros((0, 2))), np.zeros(0)
    agree(solving_nothing, [empty])


def solving_nothing(k: Pair[Array], b: Array) -> Array:
    return solve(k.left, b, "k")


def test_what_raises_in_python_is_nan(capfd):
    k, b = Pair(0.0, np.ones(1)), np.ones(3)
    made = agree(picky, [(k, b)])
    assert np.all(np.isnan(call(made, 3, k, -b)))
    assert capfd.readouterr().err == ""


def factorial(k: Pair[float], i: int) -> float:
    return 1.0 if i < 2 else i * factorial(k, i - 1)


def test_a_law_that_calls_itself():
    agree(factorial, [(Pair(0.0, np.ones(1)), i) for i in range(6)])


def inner_of(gain):
    def law(k, x):
        return gain * x

    return law


def test_a_law_inside_a_function_has_the_numbers_around_it():
    examples = [(Pair(0.0, np.ones(1)), np.arange(3.0))]
    for gain in (2.0, 3.0):
        made = agree(inner_of(gain), examples)
        np.testing.assert_array_equal(call(made, 3, *examples[0]), gain * np.arange(3.0))


def word(k, x):
    return k.left


def table(k, x):
    return x * os.environ


def attribute(k, x):
    return np.array([k.mean])


def short(k, x):
    return x[:2]


FROM_TEXT = {}
exec("def typed(k, x): return x", FROM_TEXT)


@pytest.mark.parametrize(
    ("law", "reason"),
    [
        (lambda k, x: x, "a lambda has no source"),
        (FROM_TEXT["typed"], "typed has no source; write it in a file"),
        (table, "its global 'environ' is .* expected a number, an array, a NamedTuple"),
        (attribute, "Unknown attribute 'mean' of type Pair.* in 'return np.array"),
        (short, "it gives 2 numbers, expected 3"),
        (np.sin, "expected a function"),
    ],
)
def test_what_cannot_be_compiled_says_so_in_one_line(law, reason):
    with pytest.raises(InputError, match=reason) as info:
        native_law(law, (Pair(0.0, np.ones(1)), np.ones(3)), 3)
    said = str(info.value)
    assert "\n" not in said
    assert law.__qualname__ in said if law is not np.sin else "sin" in said
    assert "then runs in Python on the compiled plant" in said


def test_arguments_that_are_no_numbers_are_refused():
    with pytest.raises(InputError, match="argument left of a law is 'word'"):
        native_law(word, (Pair("word", np.ones(1)), np.ones(3)), 3)


def test_code_that_differs_from_python_is_refused(monkeypatch):
    monkeypatch.setattr(source, "ENTRY", source.ENTRY.replace("({arguments})", "({arguments}) + 1"))
    with pytest.raises(InputError, match=r"the code gives .* Python"):
        native_law(doubled, (Pair(0.0, np.ones(1)), np.ones(3)), 3)


def doubled(k, x):
    return 2.0 * x


MODULE = """
import numpy as np
GAIN = {gain}
def scaled(k, x):
    return GAIN * x + {shift}
"""


def imported(path, name="edited_law"):
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_law_that_is_edited_gives_the_new_numbers(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    path, k, x = tmp_path / "edited_law.py", Pair(0.0, np.ones(1)), np.arange(3.0)
    seen = set()
    for gain, shift in ((2.0, 1.0), (3.0, 1.0), (3.0, 4.0)):
        path.write_text(MODULE.format(gain=gain, shift=shift))
        law = imported(path).scaled
        made = agree(law, [(k, x)])
        np.testing.assert_array_equal(call(made, 3, k, x), gain * x + shift)
        seen.add(made.keep.__wrapped__.__module__)
    assert len(seen) == 3
    path.write_text(MODULE.format(gain=3.0, shift=5.0))
    with pytest.raises(InputError, match="has changed since it was imported"):
        native_law(law, (k, x), 3)


def test_a_second_process_takes_it_from_the_disk(tmp_path, cache):
    path = tmp_path / "edited_law.py"
    path.write_text(MODULE.format(gain=8.0, shift=9.0))
    lines = (
        "import numpy as np; from biped_adrc.engine.native import native_law; from edited_law import scaled; "
        "print(native_law(scaled, ((), np.ones(3)), 3).keep.cache_hits)"
    )
    said = [
        subprocess.run(
            [sys.executable, "-c", lines],
            capture_output=True,
            text=True,
            check=True,
            timeout=120,
            env={**os.environ, "PYTHONPATH": str(tmp_path)},
        ).stdout.strip()
        for _ in range(2)
    ]
    assert said == ["0", "1"]


def test_damaged_machine_code_is_compiled_again(cache):
    k, x = Pair(0.0, np.ones(1)), np.ones(3)
    first = agree(inner_of(5.0), [(k, x)])
    folder = (
        cache
        / first.keep.__wrapped__.__module__.removeprefix("biped_adrc_kernels_")
        / "__pycache__"
    )
    broken = [*folder.glob("*.nbc"), *folder.glob("*.nbi")]
    assert broken
    for path in broken:
        path.write_bytes(b"broken")
    native._compiled.cache_clear()
    agree(inner_of(5.0), [(k, x)])
