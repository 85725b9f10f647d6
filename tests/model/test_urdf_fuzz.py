"""URDFs mutated at random: each is a physical robot, or is refused by a message that names something of it."""

import copy
import re
import shutil
import tomllib
import xml.etree.ElementTree as ET
from collections import Counter

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.files import data_folder, toml_key, toml_value
from biped_adrc.model.robots.robot_toml import load_description

NUMBERS = ("xyz", "rpy", "value", "lower", "upper", "effort", "ixx", "ixy", "ixz", "iyy", "izz")
BAD = ("nan", "inf", "-1e400", "1e300", "1e-300", "0", "-1", "1.5kg", "", "1 2", "\u0661", "2**3")
NAMES = ("", " ", "world", "base_x", "root_joint", "torso", "a" * 3000, "t\u00f6rso", "q\"u<o>'s")


def number(root, pick, random):
    """One number becomes another, or none."""
    e, key = pick((e, k) for e in root.iter() for k in e.attrib if k in NUMBERS)
    words = e.get(key).split() or [""]
    scaled = f"{random.normal() * 10.0 ** random.integers(-12, 12):g}"
    words[random.integers(len(words))] = pick((*BAD, scaled, scaled, scaled))
    e.set(key, " ".join(words))


def drop(root, pick, random):
    parent, child = pick((e, child) for e in root.iter() for child in e)
    parent.remove(child)


def double(root, pick, random):
    pick((root, *root.iter())).append(
        copy.deepcopy(pick(child for e in root.iter() for child in e))
    )


def lose(root, pick, random):
    e, key = pick((e, key) for e in root.iter() for key in e.attrib)
    del e.attrib[key]


def name(root, pick, random):
    e = pick(e for e in root.iter() if e.tag in ("link", "joint", "parent", "child", "robot"))
    known = [x.get("name", "") for x in root.iter() if x.tag in ("link", "joint")]
    e.set("link" if e.tag in ("parent", "child") else "name", pick((*NAMES, *known)))


def kind(root, pick, random):
    joint = pick(e for e in root.iter() if e.tag in ("joint", "link"))
    joint.set("type", pick(("fixed", "prismatic", "continuous", "floating", "", "REVOLUTE")))


KINDS = (number, number, number, drop, double, lose, name, kind)


def mutated(text, random):
    """A URDF with one to three changes."""

    def pick(found):
        found = list(found)
        return found[random.integers(len(found))]

    root = ET.fromstring(text)
    for _ in range(random.integers(1, 4)):
        KINDS[random.integers(len(KINDS))](root, pick, random)
    return ET.tostring(root)


def check_physical(biped, random):
    """D_s, the impact and the split are numbers, masses and D_s are positive."""
    assert 0.0 < biped.mass < np.inf
    q, v = random.uniform(-3.0, 3.0, biped.n), random.normal(0.0, 3.0, biped.n)
    D = biped.inertia(q)
    for found in (D, *biped.impact(q, v), *biped.reduction(q, v), biped.swing_foot(q)):
        assert np.all(np.isfinite(found)), found
    assert np.min(np.linalg.eigvalsh(0.5 * (D + D.T))) > 0.0
    assert np.max(np.abs(D - D.T)) <= 1e-9 * np.max(np.abs(D))


def tried(robot, seed, folder, derived):
    """What became of one mutant: 'loaded', or the message."""
    random = np.random.default_rng([seed, derived])
    urdf, d = data_folder("urdf") / robot / "floating.urdf", load_description(robot)
    path, record = folder / "floating.urdf", folder / "robot.toml"
    path.write_bytes(mutated(urdf.read_bytes(), random))
    record.write_text(urdf.with_name("robot.toml").read_text())
    try:
        feet = (d.stance_foot, d.swing_foot)
        biped = ba.biped_from_urdf(path, feet, hip=d.hip) if derived else ba.Biped.load(record)
    except ba.BipedError as refused:
        text, data = str(refused), path.read_bytes().decode(errors="ignore")
        named = [x for x in re.findall("'([^']+)'", text) if x in data or x in str(path)]
        assert named or "floating.urdf" in text, text
        assert len(text.splitlines()) == 1, text
        return text
    check_physical(biped, random)
    return "loaded"


@pytest.mark.parametrize("derived", [False, True], ids=["record", "urdf alone"])
@pytest.mark.parametrize("robot", ["rabbit", "compass"])
def test_mutants_are_physical_or_refused(robot, derived, tmp_path):
    """60 URDFs with one to three random changes, read with the robot's record or alone (`derived`): each is
    refused by one line that names something of the file, or has positive masses, a positive D_s and finite
    numbers. Some load and more than ten messages differ, so that the changes try something.
    """
    found = Counter(tried(robot, seed, tmp_path, derived) for seed in range(60))
    assert found["loaded"] > 0
    assert len(found) > 10, "the mutants are refused for many reasons"


ODD = ("", "torso", "left_shn", "../x", 1, -1.0, 1e300, float("nan"), True, [], ["left_shin"], {})
"""What a value of a record becomes: names that there are not, numbers, lists and tables."""


def places(x, at=()):
    """The keys to all values of nested tables and lists."""
    pairs = x.items() if isinstance(x, dict) else enumerate(x) if isinstance(x, list) else ()
    for key, y in pairs:
        yield (*at, key)
        yield from places(y, (*at, key))


def inside(x, way):
    for key in way:
        x = x[key]
    return x


def edited(record, random):
    """A record with one value gone, doubled, exchanged for another one's, or odd."""
    record = copy.deepcopy(record)
    ways = list(places(record))
    (*way, last), other = (ways[random.integers(len(ways))] for _ in range(2))
    table, kind = inside(record, way), random.integers(4)
    if kind == 0:
        del table[last]
    elif kind == 1 and isinstance(table, list):
        table.append(table[last])
    else:
        odd = ODD[random.integers(len(ODD))]
        table[last] = odd if kind == 2 else copy.deepcopy(inside(record, other))
    return record


@pytest.mark.parametrize("robot", ["rabbit", "compass"])
def test_edited_records_are_physical_or_refused(robot, tmp_path):
    """80 records robot.toml with one value gone, doubled, exchanged or odd: each refusal is one line, and what
    loads has positive masses and D_s. More than 20 outcomes show that the changes try something.
    """
    source, found = data_folder("urdf") / robot, Counter()
    whole = tomllib.loads((source / "robot.toml").read_text())
    shutil.copy(source / "floating.urdf", tmp_path)
    file = tmp_path / "robot.toml"
    for seed in range(80):
        random = np.random.default_rng([seed, 2])
        record = edited(whole, random)
        file.write_text("\n".join(f"{toml_key(k)} = {toml_value(x)}" for k, x in record.items()))
        try:
            check_physical(ba.Biped.load(file, friction=True), random)
            found["loaded"] += 1
        except ba.BipedError as refused:
            found[str(refused)] += 1
    assert all(len(text.splitlines()) == 1 for text in found)
    assert found["loaded"] > 0
    assert len(found) > 20, "the records are refused for many reasons"
