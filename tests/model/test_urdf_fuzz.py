"""URDFs mutated at random: each is a physical robot, or is refused with one message that names something of it.

More of them by hand: python tests/model/test_urdf_fuzz.py 2000
"""

import copy
import re
import sys
import tempfile
import xml.etree.ElementTree as ET
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.resources import data_folder
from biped_adrc.robots.robot_toml import load_description, robot_names

NUMBERS = ("xyz", "rpy", "value", "size", "radius", "length", "lower", "upper", "effort", "rgba")
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
BAD = (
    *(
        "nan",
        "-nan",
        "inf",
        "-inf",
        "1e400",
        "1e308",
        "1e300",
        "-1e300",
        "1e160",
        "1e30",
        "1e-30",
        "1e-160",
    ),
    *("1e-300", "5e-324", "0", "-0", "-1", "1", "3.14159", "0.123456", "1.5kg", "", " ", "1,5"),
    *("0x10", "1_0", "one", "None", "1 2", "--1", "1e", "\u0661", "\u00b2", "2**3"),
)
NAMES = ("", " ", "world", "base_x", "universe", "root_joint", "ground", "stance_pin", "torso")
NAMES += (
    "a" * 3000,
    "t\u00f6rso",
    "q\"u<o>t&e's",
    "left foot",
    "0",
    "-1",
    "nan",
    "../x",
    "left_foot\n",
)
TAGS = (
    "link",
    "joint",
    "inertial",
    "origin",
    "mass",
    "inertia",
    "parent",
    "child",
    "axis",
    "limit",
)
TAGS += ("visual", "geometry", "mimic", "robot", "collision", "box", "Link", "gazebo", "dynamics")
TYPES = ("fixed", "prismatic", "continuous", "floating", "planar", "spherical", "", "REVOLUTE")


class Mutant:
    """The parsed URDF of a robot, changed at random places."""

    def __init__(self, text, random):
        self.root, self.random = ET.fromstring(text), random

    def pick(self, found):
        found = list(found)
        return found[self.random.integers(len(found))] if found else None

    def elements(self, *tags):
        return [e for e in self.root.iter() if not tags or e.tag in tags]

    def parents(self):
        return [(e, child) for e in self.root.iter() for child in e]

    def number(self):
        """One number becomes another, or none."""
        places = [(e, k) for e in self.root.iter() for k in e.attrib if k in (*NUMBERS, *MOMENTS)]
        e, key = self.pick(places)
        words = e.get(key).split()
        at = self.random.integers(len(words) + 1)
        if at == len(words):
            words += [self.pick(BAD)]
        else:
            scaled = f"{self.random.normal() * 10.0 ** self.random.integers(-12, 12):g}"
            words[at] = self.pick((*BAD, scaled, scaled, scaled))
        e.set(key, " ".join(words))

    def drop(self):
        parent, child = self.pick(self.parents())
        parent.remove(child)

    def double(self):
        _, child = self.pick(self.parents())
        self.pick([self.root, self.root, *self.elements()]).append(copy.deepcopy(child))

    def rename_tag(self):
        self.pick(self.elements()).tag = self.pick(TAGS)

    def attribute(self):
        """An attribute is lost, or gets another's name or a text."""
        e, key = self.pick((e, key) for e in self.root.iter() for key in e.attrib)
        value = e.attrib.pop(key)
        if self.random.uniform() < 0.6:
            e.set(self.pick((*NUMBERS, *MOMENTS, "name", "link", "type", key)), value)

    def name(self):
        e = self.pick(self.elements("link", "joint", "parent", "child", "robot"))
        known = [x.get("name", "") for x in self.elements("link", "joint")]
        e.set("link" if e.tag in ("parent", "child") else "name", self.pick([*NAMES, *known]))

    def kind(self):
        e = self.pick(self.elements("joint"))
        if e is not None:
            e.set("type", self.pick((*TYPES, "revolute")))

    def swap(self):
        """Two links, joints or ends of joints change places; this makes circles too."""
        tag = self.pick(("parent", "child", "link", "joint", "axis", "origin", "inertial"))
        found = self.elements(tag)
        one, other = self.pick(found), self.pick(found)
        if one is not None:
            one.attrib, other.attrib = dict(other.attrib), dict(one.attrib)
            one[:], other[:] = list(other), list(one)

    def circle(self):
        joint = self.pick(self.elements("joint"))
        link = self.pick(self.elements("link"))
        end = None if joint is None else joint.find(self.pick(("parent", "child")))
        if end is not None and link is not None:
            end.set("link", link.get("name", ""))

    def text(self):
        return ET.tostring(self.root)


KINDS = (
    *(Mutant.number,) * 5,
    *(Mutant.drop, Mutant.double, Mutant.rename_tag, Mutant.attribute, Mutant.name),
    *(Mutant.kind, Mutant.swap, Mutant.circle),
)


def mutated(text, random):
    """The bytes of a URDF with one to three changes, or with some bytes lost or changed."""
    if random.uniform() < 0.05:
        data = bytearray(text)
        for _ in range(random.integers(1, 4)):
            data[random.integers(len(data))] = random.integers(256)
        return bytes(data[: random.integers(1, len(data))] if random.uniform() < 0.2 else data)
    mutant = Mutant(text, random)
    for _ in range(random.integers(1, 4)):
        KINDS[random.integers(len(KINDS))](mutant)
    return mutant.text()


def check_physical(biped, random):
    """D_s, Omega, the impact and the split are numbers, masses and D_s are positive."""
    assert 0.0 < biped.mass < np.inf
    for _ in range(3):
        q, v = random.uniform(-3.0, 3.0, biped.n), random.normal(0.0, 3.0, biped.n)
        D, hit = biped.inertia(q), biped.impact(q, v)
        terms = biped.reduction(q, v)
        a = biped.acceleration(q, v, np.ones(biped.n))
        for found in (D, *hit, *terms, a, biped.swing_foot(q), biped.gravity(q)):
            assert np.all(np.isfinite(found)), found
        assert np.min(np.linalg.eigvalsh(0.5 * (D + D.T))) > 0.0
        assert np.max(np.abs(D - D.T)) <= 1e-9 * np.max(np.abs(D))


def tried(robot, seed, folder, derived):
    """What became of one mutant: 'loaded', or the message."""
    random = np.random.default_rng([seed, derived])
    urdf = data_folder("urdf") / robot / "floating.urdf"
    path = Path(folder) / "floating.urdf"
    path.write_bytes(mutated(urdf.read_bytes(), random))
    record = Path(folder) / "robot.toml"
    record.write_text(urdf.with_name("robot.toml").read_text())
    d = load_description(robot)
    feet = (d.stance_foot, d.swing_foot)
    try:
        biped = ba.biped_from_urdf(path, feet, hip=d.hip) if derived else ba.Biped.load(record)
    except ba.BipedError as refused:
        text = str(refused)
        data = path.read_bytes().decode(errors="ignore")
        named = [
            name for name in re.findall("'([^']+)'", text) if name in data or name in str(path)
        ]
        assert named or "floating.urdf" in text, text
        assert "Traceback" not in text
        assert len(text.splitlines()) == 1, text
        return text
    check_physical(biped, random)
    return "loaded"


@pytest.mark.parametrize("derived", [False, True], ids=["record", "urdf alone"])
@pytest.mark.parametrize("robot", robot_names())
def test_mutants_are_physical_or_refused(robot, derived, tmp_path):
    found = Counter(tried(robot, seed, tmp_path, derived) for seed in range(60))
    wheel = robot == "rimless_wheel" and derived  # without its record it is no biped with two legs
    assert (found["loaded"] > 0) is not wheel
    assert len(found) > 10, "the mutants are refused for many reasons"


def main(count):
    """Mutants of every robot, with what goes wrong printed."""
    found, wrong = Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        for robot in robot_names():
            for derived in (False, True):
                for seed in range(count):
                    try:
                        text = tried(robot, seed, folder, derived)
                    except Exception as error:
                        wrong += 1
                        print(f"{robot} {seed} {derived}: {type(error).__name__}: {error!s:.300}")
                        continue
                    found["loaded" if text == "loaded" else "refused"] += 1
    print(dict(found), "wrong:", wrong)


if __name__ == "__main__":
    main(int(sys.argv[1]))
