"""The core by values written out: sentences of errors, checks, texts, files, trees, small linear systems.

`said(error, call, *arguments)` is the sentence of the error with which a call is refused.
"""

from __future__ import annotations

import dataclasses
import math
import os
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core import checks, errors, files, processes, registry, tree, versions
from biped_adrc.core.errors import InputError, OutputError, SingularError, unknown
from biped_adrc.core.linear import solve_positive
from biped_adrc.core.part import content, setup, with_fields
from biped_adrc.core.shown import LONGEST, ByValue, call_text, columns, short
from biped_adrc.core.timing import check_ends
from biped_adrc.core.verdict import at_least, at_most, below, between
from biped_adrc.gait.reference import ReferencePoint

UP = math.nextafter(2.0, 3.0)


def said(error, call, *arguments, **more):
    """The sentence with which a call is refused."""
    with pytest.raises(error) as found:
        call(*arguments, **more)
    return str(found.value)


# -- sentences -------------------------------------------------------------------------------------
MANY = [f"r{k}.x" for k in range(10)] + [f"r{k}.y" for k in range(11)]


@pytest.mark.parametrize(
    ("name", "known", "text"),
    [
        ("speeed", ["speed", "step"], "did you mean 'speed'?"),
        ("gain", ["law.gain", "observer.gain", "run.h"], "mean 'law.gain' or 'observer.gain'?"),
        ("law.gian", ["law.gain", "run.gain"], "did you mean 'law.gain'?"),
        ("law.zzz", ["law.gain", "law.mass", "run.h"], "choose from ['law.gain', 'law.mass']"),
        ("zzz", ["law.gain", "run.h"], "choose from ['law.gain', 'run.h']"),
        ("zzz", MANY[:20], f"choose from {MANY[:20]}"),
        ("zzz", MANY, f"choose from {[f'r{k}' for k in range(11)]}"),
        ("zzz", [], "leave it out"),
    ],
)
def test_an_unknown_name_is_answered_with_near_ones(name, known, text):
    """A near name if there is one, with or without its prefix; else the names with the same prefix, or all of
    them; of more than 20 the prefixes alone."""
    assert unknown(name, known).endswith(text)


def test_errors_of_records_and_of_numbers_are_put_in_words():
    """`found` is an error as pydantic gives it: of its place ("a", "int", 1) the type's name is left out.
    True is a number to Python and no count here."""
    found = {
        "msg": "Input should be a valid tuple",
        "input": 3,
        "loc": ("a", "int", 1),
        "type": "x",
    }
    assert errors.problem(found) == "a.1: found 3, should be a valid list"
    assert errors.problem({**found, "msg": "Value error, odd"}) == "a.1: odd"
    assert errors.problem({**found, "type": "missing"}) == "the key 'a.1' is missing"
    for check, value, end in (
        (errors.check_whole, True, ", expected a whole number, at least 0"),
        (errors.check_whole, -1, ", expected a whole number, at least 0"),
        (errors.check_count, 0, ", expected a whole number, at least 1"),
        (errors.check_positive, 0.0, ", expected a positive number"),
        (errors.check_positive, math.inf, ", expected a positive number"),
        (errors.check_positive, "4", " ('4' is a str), expected a positive number"),
    ):
        assert said(InputError, check, value, "n") == f"n{end}"
    errors.check_whole(0, "n")
    errors.check_count(np.int64(1), "n")


# -- checks ----------------------------------------------------------------------------------------
@dataclasses.dataclass(frozen=True)
class Ranges(checks.Checked):
    finite: checks.FiniteFloat = 0.0
    positive: checks.PositiveFloat = 1e-300
    not_below: checks.NonNegativeFloat = 0.0
    count: checks.PositiveInt = 1
    whole: checks.NonNegativeInt = 0
    two: checks.TwoFloats = (0.0, 0.0)
    row: checks.PositiveFloats = ()
    word: Annotated[str, checks.one_of(("a", "b"))] = "a"
    perhaps: checks.PositiveFloat | None = None


@pytest.mark.parametrize(
    ("field", "value", "end"),
    [
        ("finite", math.inf, "inf, expected a finite number"),
        ("positive", 0.0, "0.0, expected a positive number"),
        ("positive", math.inf, "inf, expected a positive number"),
        ("not_below", -1e-300, "-1e-300, expected zero or a positive number"),
        ("count", 0, "0, expected a whole number, at least 1"),
        ("count", True, "True, expected a whole number, at least 1"),
        ("whole", -1, "-1, expected a whole number >= 0"),
        ("whole", 1.0, "1.0 (a float), expected a whole number"),
        ("two", (1.0,), "(1.0,), expected two finite numbers"),
        ("row", (1.0, 0.0), "(1.0, 0.0), expected positive numbers"),
        ("word", "c", "'c', expected one of ['a', 'b']"),
        ("perhaps", -1.0, "-1.0, expected a positive number or None"),
    ],
)
def test_a_field_is_in_its_range(field, value, end):
    """Each row is just outside of a range of `Ranges`, whose fields are named for it: zero where positive is
    asked for, 1.0 where a whole number is."""
    assert said(InputError, Ranges, **{field: value}) == f"{field} of Ranges is {end}"


class Own:
    def output(self):
        return None


def test_arguments_and_results_are_named_with_what_was_expected():
    """Each row: the sentence, then its argument. A text of 59 letters is too long to be shown, one of 58 is
    shown. What a user's method returned wrongly is named with its file and line."""
    for begin, *arguments in (
        ("x is 1.0 (a float), expected a Gait, such as load_gait('pub", 1.0, "x", ba.Gait),
        ("x is None, expected a Biped, such as Biped.load('rabbit')", None, "x", ba.Biped),
        ("x is the class Gait, not made as Gait(...), expected a text", ba.Gait, "x", str),
        ("x is 'a' (a str), expected a number", "a", "x", float, type(None)),
        ("x is a str, expected a number", "y" * 59, "x", float),
        (f"x is {'y' * 58!r} (a str), expected", "y" * 58, "x", float),
        ("x is 1 (an int), expected a GPIObserver or an RK4", 1, "x", ba.GPIObserver, ba.RK4),
    ):
        assert said(InputError, checks.check_part, *arguments).startswith(begin)
    line = f"Own.output (test_core.py:{Own.output.__code__.co_firstlineno}) returned"
    for found, shape, end in (
        (None, (2,), " None, expected (2,), real numbers; is a return statement missing?"),
        (np.array([1j]), None, " complex128 numbers, expected a row of real numbers"),
        ([[1], [1, 2]], None, " [[1], [1, 2]] (a list), expected a row of real numbers"),
        (np.zeros((1, 2)), None, " an array of shape (1, 2), expected a row of real numbers"),
        (np.zeros(3), (2,), " an array of shape (3,), expected (2,), real numbers"),
    ):
        assert said(InputError, checks.returned, found, shape, Own(), "output") == line + end
    assert math.isnan(checks.returned([math.nan], None, Own(), "output", finite=False)[0])
    assert said(InputError, checks.numbers, [[1], 2], "x") == (
        "x is [[1], 2] (a list), expected numbers in equal rows"
    )


def test_an_exception_of_a_user_s_code_is_told_with_its_line():
    """The sentence ends with the source line that raised. `handing_out`, around each call of a user's method,
    raises the error again as a RaisedError, which is a ValueError as well."""
    with pytest.raises(ValueError, match="odd") as found:
        raise ValueError("odd")
    end = ', `raise ValueError("odd")`) raised ValueError: odd'
    assert checks.sentence_of(found.value).endswith(end)
    with pytest.raises(ValueError, match="invalid literal") as found, checks.handing_out():
        int("x")
    assert type(found.value) is errors.RaisedError


def test_a_point_of_another_class_or_shape_is_named():
    """A reference of `Own` gives its point of 2 joints and 3 coordinates, where the robot has 4 coordinates,
    or 4 joints."""
    check, still = checks.point_returned, np.zeros(2)
    point = ReferencePoint(still, still, still, np.zeros((2, 3)))
    assert said(InputError, check, 1, ReferencePoint, Own(), 3) == (
        "Own gives 1 (an int), expected a ReferencePoint(q_d, dq_d, drift, H)"
    )
    assert "H of shape (2, 3), expected (2, 4)" in said(
        InputError, check, point, type(point), Own(), 4
    )
    assert "q_d of shape (2,), expected (4," in said(
        InputError, check, point, type(point), Own(), 3, 4
    )


# -- texts -----------------------------------------------------------------------------------------
def test_texts_of_values():
    """Up to 6 numbers, 2 keys and 48 characters are shown whole, more by shape, count or start."""
    for x, text in (
        (np.array([1, 2.5]), "[1 2.5]"),
        (np.zeros(6), "[0 0 0 0 0 0]"),
        (np.zeros(7), "array(7,)"),
        (np.zeros((1, 2)), "array(1, 2)"),
        (True, "True"),
        (np.float64(1.5), "1.5"),
        (math.hypot, "hypot"),
        ({"a": 1, "b": 2}, "{'a': 1, 'b': 2}"),
        ({"a": 1, "b": 2, "c": 3}, "{3 keys}"),
        ("x" * 46, repr("x" * 46)),
        ("x" * 47, repr("x" * 43 + "...")),
        ({*range(40)}, "set(...)"),
    ):
        assert short(x) == text
    # F(a=yy...y) of exactly LONGEST characters, and one longer
    whole, cut = (call_text("F", [("a", "y" * (LONGEST - k))]) for k in (5, 4))
    assert (len(whole), whole[-3:], len(cut), cut[-5:]) == (LONGEST, "yy)", LONGEST, "y...)")


def test_columns_are_as_wide_as_their_widest_cell():
    """A row of one cell is a heading: it goes over all columns and widens none. least: of a column's width,
    gap: between columns."""
    rows = [("a", "bbb", "c"), ("a heading that counts for no width",), ("aa", "b", "")]
    assert columns(rows) == ["a   bbb  c", rows[1][0], "aa  b"]
    assert columns(rows, least=4, gap=1) == ["a    bbb c", rows[1][0], "aa   b"]


def test_verdicts_at_their_limits():
    """<= and >= hold at the limit itself, < does not. UP is the next float above 2: one digit beyond is
    broken."""
    assert str(at_most("x [m]", "law", 2.0, 2.0)) == "x [m]: 2.0e+00 <= 2"
    assert str(below("x", "law", 2.0, 2.0)) == "x: 2.0e+00 is not < 2"
    # the value, then its limit or limits
    kept = at_least("x", "law", UP, UP), between("x", "law", 2.0, 2.0, 2.0)
    assert [(x.holds, x.limit) for x in kept] == [(True, ">= 2"), (True, "in [2, 2]")]
    found = [at_least("x", "law", 2.0, UP), between("x", "law", UP, 1.0, 2.0)]
    found += [at_most("x", "law", UP, 2.0), between("x", "law", 2.0, UP, 3.0)]
    assert not any(x.holds for x in found)


# -- files -----------------------------------------------------------------------------------------
class Pair(NamedTuple):
    a: object
    b: object


def test_values_in_other_languages():
    """JSON has no inf and no arrays, TOML no None, quotes and control characters are escaped, and no text may
    end a comment of C or XML."""
    x = {1: Pair(math.inf, (1, 2)), "g": ba.Gains(1.0, np.array([2.0, 3.0])), "n": np.int64(3)}
    gains = {"K_p": 1.0, "K_d": [2.0, 3.0]}
    assert files.plain(x) == {"1": {"a": "inf", "b": [1, 2]}, "g": gains, "n": 3}
    toml = {"a b": [1, 2.0, True], "c-1_D": None, "é": {"q": 'x"\x7f'}}
    text = '{ "a b" = [1, 2.0, true], c-1_D = "none", "é" = { q = "x\\"\\u007f" } }'
    assert files.toml_value(toml) == text
    assert files.one_line("a\tb\nü\x1b", keep="\t") == "a\tb\\nü\\x1b"
    assert files.c_comment("a*/ b/* c??/ \\ ü") == "a* / b/ * c? ?/ \\x5c \\xfc"
    assert files.xml_comment("a---b\n") == "a- - -b\\n"


def test_names_of_outputs(tmp_path, monkeypatch):
    """A name gets its suffix if it has none of those allowed. What is no place for a file (a link, a folder
    below a file, too long a name, one of the inputs) is refused; 240 bytes leave room for a temporary
    name."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a").write_text("")
    os.symlink("there", "link.csv")
    os.link("a", "b")
    csv, name = (".csv",), "x" * 236 + ".csv"
    found = [str(files.output_path(x, csv, default=True)) for x in ("push_0.1", "a.CSV", name)]
    assert found == ["push_0.1.csv", "a.CSV", name]
    assert files.beside(tmp_path / "a", "b") == tmp_path / "b"
    for part, error, call, *arguments in (
        ("expected .csv at its end", InputError, files.output_path, "push_0.1", csv),
        ("with its '~'; take Path", InputError, files.output_path, "~/x.csv", csv),
        ("241 bytes of at most 240", OutputError, files.output_path, "x" + name, csv),
        ("'link.csv' is a link to 'there'", OutputError, files.output_path, "link.csv", csv),
        ("name too long", OutputError, files.check_place, Path("x" * 256)),
        ("/a' is a file, expected a folder", InputError, files.check_folder, "a/b"),
        ("'a' would overwrite", InputError, files.keep_inputs, [Path("a")], [Path("b")]),
        ("its own folder or below; copy it", InputError, files.beside, tmp_path / "a", "../a"),
    ):
        # "File name too long" is the system's own sentence
        assert part in said(error, call, *arguments).replace("File", "file")


def test_a_file_that_is_no_json_is_named_with_its_kind(tmp_path):
    """The reader is told that the file should be a walk, and says so."""
    (tmp_path / "a.json").write_text("{")
    text = said(InputError, files.read_json, tmp_path / "a.json", "walk")
    assert text.startswith(f"walk '{tmp_path / 'a.json'}' is not valid JSON: Expecting")


def test_stored_gaits_are_names_of_gaits_alone():
    """Kinds of things that have names are gaits, controllers and others: a stored gait is known as a gait and
    as nothing else."""
    kinds = [kind for kind in registry.REGISTRY if "published-tac2003" in registry.names(kind)]
    assert kinds == ["gait"]


def test_a_failed_write_leaves_the_old_file(tmp_path):
    """An error inside `replacing` leaves the old text, no temporary file beside it, and the rights that the
    umask 027 gave."""
    path, umask = tmp_path / "sub" / "x.txt", os.umask(0o027)
    try:
        files.write_text(path, "old")
    finally:
        os.umask(umask)
    with pytest.raises(ZeroDivisionError), files.replacing(path):
        raise ZeroDivisionError
    # a file in the place of a folder
    assert ": File exists; choose another" in said(OutputError, files.write_text, path / "y", "new")
    assert (path.read_text(), os.listdir(path.parent)) == ("old", ["x.txt"])
    assert path.stat().st_mode & 0o777 == 0o640


def test_tables_of_text(tmp_path):
    """A CSV table comes back to the last digit; entries and rows that are wrong are named by their line in
    the file, empty lines counted."""
    path = files.write_csv({"a": np.array([0.1, 1e-300]), "b": ["x", "y"]}, tmp_path / "t")
    table = files.CsvTable.read(path)
    assert table == (["a", "b"], [(2, ["0.1", "x"]), (3, ["1e-300", "y"])])
    assert table.numbers(0).tolist() == [0.1, 1e-300]
    assert said(InputError, table.numbers, 1).startswith("line 2, column 'b': found 'x', expected")
    path.write_text("a, b\n\n1\n")
    assert said(InputError, files.CsvTable.read, path).startswith(
        "line 3 has 1 entries, not 2: ['a'"
    )


# -- parts, trees and values -----------------------------------------------------------------------
STATE = Pair(Pair(np.array([1.0, 2.0]), 3.0), Pair(None, np.array([[4.0, 5.0]])))


def test_a_tree_is_a_vector_and_back():
    """Nested tuples of arrays (STATE) become one row of numbers and back, also many rows at once; another
    shape than that of the layout is refused by its place."""
    x, layout = tree.flatten(STATE), tree.Layout.of(STATE)
    # the leaves of STATE in order; None has no numbers
    assert x.tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert layout.size == 5
    assert [*layout.names()] == ["a.a[0]", "a.a[1]", "a.b", "b.b[0, 0]", "b.b[0, 1]"]
    # place("a", "b"): of field b of field a
    assert [layout.place(*"ab"), layout.place(*"bb")] == [slice(2, 3), slice(3, 5)]
    many, zeros = layout.tree(np.array([x, -x])), tree.zeros_like(STATE)
    assert (many.a.b.tolist(), many.b.a, many.b.b.shape) == ([3.0, -3.0], None, (2, 1, 2))
    for which, end in ((1.0, x), (0.0, 0.0 * x)):
        assert tree.flatten(tree.chosen(which, STATE, zeros)).tolist() == end.tolist()
    assert tree.flatten(()).shape == (0,)
    right = tree.returned_tree(STATE, layout, Own(), "output")
    assert (right.b.a, tree.flatten(right).tolist()) == (None, x.tolist())
    for wrong, text in (
        ((1.0, 2.0), "returned a tuple of 2, expected a Pair as at the start"),
        (STATE._replace(a=Pair(np.zeros(3), 3.0)), "an array of shape (3,), expected (2,)"),
        (STATE._replace(a=None), "returned a NoneType, expected a Pair"),
    ):
        assert text in said(InputError, tree.returned_tree, wrong, layout, Own(), "output")


@dataclasses.dataclass(frozen=True)
class Damper(ba.Controller):
    K: float = 4
    table: tuple[float, ...] = (1, 2)
    order: int = 2
    seed: int = setup(0)

    @ba.derived
    def root(self):
        return np.sqrt(self.K) * np.ones(1)

    def output(self, s, m):
        return 0.0


def test_numbers_of_a_part_are_floats_and_structure_is_whole():
    """A field declared float is one, though 4 was written; an int is structure; `setup` marks what only
    prepares a run. A derived value is computed once, read-only, and again for changed fields."""
    x, part = content(Damper()), Damper()
    assert [type(y) for y in (x["K"], x["table"][0], x["order"])] == [float, float, int]
    assert type(x["seed"]).__name__ == "Setup"
    # Damper.root: of the class it is the definition itself, with its name
    assert (part.root, part.root.flags.writeable, Damper.root.attrname) == (2.0, False, "root")
    # an annotation that names nothing there is: no field can be checked
    assert checks.hints_of(type("Unread", (), {"__annotations__": {"x": "Nowhere"}})) == {}
    assert (with_fields(part, K=9).root, with_fields(part, K=9).K) == (2.0, 9)


@dataclasses.dataclass(frozen=True)
class Valued(ByValue):
    x: object
    note: object = dataclasses.field(default=0, compare=False)


def test_equal_values_are_equal_with_one_hash():
    """Objects are compared by value and not by identity: arrays too, NaN equals NaN, -0 equals 0; other shapes
    and types differ. A field with compare=False does not count."""
    same = [(np.array([0.0]), np.array([-0.0])), (math.nan, float("nan")), ({1: [2]}, {1: [2]})]
    other = [
        (1.0, 2.0),
        (np.zeros(2), np.zeros((1, 2))),
        ((1,), [1]),
        (np.zeros(1), np.zeros(1, int)),
    ]
    for a, b in same:
        assert (Valued(a), hash(Valued(a))) == (Valued(b, note=1), hash(Valued(b)))
    assert [Valued(a) == Valued(b) for a, b in other] == [False] * 4
    assert Valued(1) != 1


def test_systems_of_few_equations():
    """No equation at all, a triangular system solved by hand (x = 1, 2), and a singular matrix, whose zero
    pivot is named."""
    assert solve_positive(np.zeros((0, 0)), np.zeros((0, 2)), "A").shape == (0, 2)
    assert ba.solve(np.array([[2.0, 1.0], [0.0, 4.0]]), np.array([4.0, 8.0]), "A").tolist() == [
        1,
        2,
    ]
    assert said(SingularError, ba.solve, np.ones((2, 2)), np.ones(2), "A").startswith(
        "A is singular: pivot 2 of its LU factors is zero"
    )


# -- the rest --------------------------------------------------------------------------------------
def test_sampling_and_ends_at_the_ends_of_their_ranges():
    """Each range holds at its ends and not a digit beyond: period 1 ns to 0.1 s, delay up to 100 periods; the
    ends of a run are positive, the fall's height a share below 1."""
    for period, delay in ((1e-9, 0.0), (0.1, 10.0), (1e-3, 0.1)):
        assert ba.SampledTime(period, delay=delay).restart
    for period in (math.nextafter(1e-9, 0.0), math.nextafter(0.1, 1.0)):
        assert "at least 1e-09 s, at most 0.1 s" in said(InputError, ba.SampledTime, period)
    for delay in (-1e-9, 0.1 + 1e-9, math.nan):
        assert "0 to 100 periods" in said(InputError, ba.SampledTime, 1e-3, delay=delay)
    check_ends(1e-9, 0.999, math.inf, math.inf)
    for wrong in (
        (0.0, 0.5, 1.0, 1.0),
        (1.0, 1.0, 1.0, 1.0),
        (1.0, 0.5, 0.0, 1.0),
        (1.0, 0.5, 1.0, 0.0),
    ):
        assert "a share below 1 of the height" in said(InputError, check_ends, *wrong)


def test_versions_and_their_differences(tmp_path):
    """What a stored walk says of its origin. The hash of the sources depends on code (.py, .ll) and not on
    .txt: four files written one after the other give three hashes."""
    found = versions.packages(("biped-adrc", "no-such-package"))
    assert found == {"biped-adrc": ba.__version__, "no-such-package": "none"}
    texts = versions.differences({"a": 1, "b": 2, "d": 0}, {"b": 3, "c": 4, "d": 0})
    assert texts == "a 1 there, None here; b 2 there, 3 here; c None there, 4 here"
    assert {"python", "platform", "pin", "matplotlib"} <= versions.versions().keys()
    assert {"machine", "llvmlite", "daqp"} <= versions.numerical_versions().keys()
    assert len(versions.numerical_versions()[versions.SOURCE]) == 12
    hashes = set()
    for name, text in (("a.py", "1"), ("a.py", "2"), ("b.ll", "2"), ("c.txt", "3")):
        (tmp_path / name).write_text(text)
        hashes.add(versions.source_hash(tmp_path))
    assert len(hashes) == 3


def test_tasks_in_this_process_come_back_in_order():
    """With one worker the tasks run here: values come in order, and progress as (number done, of all, name)."""
    shown, tasks = [], [processes.Task(name, abs, (x,)) for name, x in (("a", -1), ("b", -2))]
    done = processes.run_tasks(tasks, 1, (), lambda *progress: shown.append(progress))
    assert ([x.value for x in done], shown) == ([1, 2], [(1, 2, "a"), (2, 2, "b")])
    for count in (0, 1025):
        assert "1 to 1024" in said(InputError, processes.processes, count, ())


def failing(x):
    raise ZeroDivisionError("no")


@pytest.mark.parametrize(
    ("text", "call", "arguments"),
    [
        (
            "law needs x; give at.x",
            "construct",
            (failing, {}, str, "at"),
        ),
        ("law could not be made: ZeroDivisionError: no", "construct", (failing, {"x": 1}, str)),
        ("law made a int, expected a str", "construct", (lambda x, y=2, **k: x, {"x": 1}, str)),
        ("expected a class or a function written in", "construct", (dict, {}, str)),
        ("no kind 'law' of things; choose one of ['c", "register", ("x", abs)),
    ],
)
def test_what_cannot_be_made_or_registered_is_said(text, call, arguments):
    """`call` is the function of the registry: it makes an object of a class from values, or registers a class
    under a kind of things."""
    assert text in said(InputError, getattr(registry, call), "law", *arguments)


@pytest.mark.parametrize(
    ("name", "thing", "text"),
    [
        (3, abs, "the name of a controller is 3 (an int), expected a text"),
        ("x", 3, "'x' is registered as 3, expected a class or a function"),
        ("output_npd", abs, "controller 'output_npd' is taken or reads as module:Class"),
        ("a:b", abs, "controller 'a:b' is taken or reads as module:Class"),
        (" ", abs, "controller ' ' is taken or reads as module:Class"),
    ],
)
def test_a_name_that_cannot_be_registered(name, thing, text):
    """Refused are a name that is no text, a thing that is no class, a name that a controller has already
    (output_npd), a name that reads as a file's class, and a blank."""
    assert said(InputError, registry.register, "controller", name, thing).startswith(text)
