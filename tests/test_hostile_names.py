"""Names from the files of a robot stay names in C, XML, HTML, MJCF, URDF, TOML and CSV.

A robot may come from a stranger. `HOSTILE` has names that try to end a comment or a string and to plant
something, which is always called "planted"; `hostile` is RABBIT with such a name for robot, source and joint,
`exported` the folder of a controller in C for it, with an FMU. `preprocessed(text)` is C without comments.
A name that is not escaped shows as something planted.
"""

from __future__ import annotations

import csv
import shutil
import subprocess
import tomllib
import xml.etree.ElementTree as ET
import zipfile
from html.parser import HTMLParser
from types import SimpleNamespace

import pytest

import biped_adrc as ba
import biped_adrc.view.meshcat.objects
from biped_adrc.core.files import c_comment, data_folder, toml_key, toml_value, write_csv
from biped_adrc.extras.export import loaded as loading
from biped_adrc.extras.export.export import export_c
from biped_adrc.extras.mujoco.mjcf import mjcf
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.model.robot_import.import_robot import to_toml
from biped_adrc.model.robots.urdf import to_xml
from biped_adrc.model.robots.urdf_reader import read
from biped_adrc.view.pages import with_viewer

PLANTED = "\n#error planted\nint planted;\n"
HOSTILE = {
    "end of a comment": f'*/{PLANTED}#include "secret" /*',
    "end of a comment across lines": f"*\\\n/{PLANTED}/*",
    "end of a comment by a trigraph": f"*??/\n/{PLANTED}/*",
    "comments in comments": f"/*/**/*/{PLANTED}//\\",
    "end of a string": f'";{PLANTED}"\\',
    "XML": '--->\'"><planted a="1"/><!--- ]]>',
    "HTML": "</title></script></pre><planted></planted><script>planted</script>",
    "TOML and make": '"\nplanted = 1\n[planted]\n$(planted)\t`planted`\x7f\x01',
    "other letters": 'éß€\U0001f916\u202e\u2028\x85 "\\',
}
"""What a robot may be called, by what it tries."""
OF_A_JOINT = {key: "".join(filter(str.isprintable, text)) for key, text in HOSTILE.items()}
"""The same without what the reader of a URDF refuses."""


@pytest.fixture(scope="module", params=HOSTILE)
def hostile(request, tmp_path_factory):
    """RABBIT with a hostile name for the robot, its preset's source and a joint."""
    folder = tmp_path_factory.mktemp("robot") / "own"
    shutil.copytree(data_folder("urdf") / "rabbit", folder)
    record = tomllib.loads((folder / "robot.toml").read_text())
    old, joint = record["actuated"][0], OF_A_JOINT[request.param]
    root = ET.parse(folder / record["urdf"]).getroot()
    for element in root.iter("joint"):
        element.attrib["name"] = element.get("name").replace(old, joint)
    ET.ElementTree(root).write(folder / record["urdf"])
    name = HOSTILE[request.param]
    record["name"] = record["presets"][record["default_preset"]]["source"] = name
    text = to_toml(renamed(record, old, joint))
    assert tomllib.loads(text) == renamed(record, old, joint)
    (folder / "robot.toml").write_text(text)
    biped = ba.Biped.load(folder / "robot.toml")
    return SimpleNamespace(biped=biped, name=name, joint=joint, folder=folder)


def renamed(tables, old, new):
    """TOML's tables with another name for a joint, in keys and values."""
    if isinstance(tables, dict):
        return {new if key == old else key: renamed(x, old, new) for key, x in tables.items()}
    if isinstance(tables, list):
        return [renamed(x, old, new) for x in tables]
    return new if tables == old else tables


@pytest.fixture(scope="module")
def exported(hostile, tmp_path_factory):
    """The folder of an exported controller, with the files of its FMU in `fmu`."""
    kind = type(hostile.name, (ba.NPDController,), {})  # a class of one's own is named too
    law = kind(ba.load_gait("published", ba.Biped.load("rabbit")).constraint)
    folder = tmp_path_factory.mktemp("c") / "c"
    walker = ba.Walker(hostile.biped, law, timing=ba.SampledTime(1e-3))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loading.shutil, "which", lambda name: None)  # the C is read, not compiled
        export_c(walker, folder, fmu=True)
    with zipfile.ZipFile(folder / "controller.fmu") as archive:
        archive.extractall(folder / "fmu")
    return folder


def test_in_c_they_are_comments(exported):
    """The preprocessor takes the comments of the C away, and with them all that the names would plant."""
    sources = [*exported.glob("*.[ch]"), *(exported / "fmu" / "sources").iterdir()]
    assert len(sources) >= 7
    for path in sources:
        assert "planted" not in preprocessed(path.read_text(), path.parent)
    assert "planted" not in (exported / "Makefile").read_text()


@pytest.mark.parametrize("name", ["*\\", "*??/", *HOSTILE.values()])
def test_the_line_after_a_name_in_c_is_not_joined_to_it(name, tmp_path):
    """A backslash at the end of a comment (??/ is its trigraph) would join the next line to it: here that
    would end the comment before "planted"."""
    assert "planted" not in preprocessed(f"/* {c_comment(name)}\n/ planted */", tmp_path)


def preprocessed(text, folder):
    """A text of C without its comments, with trigraphs replaced."""
    command = ["gcc", "-std=c99", "-Wall", "-E", "-P", "-x", "c", "-", f"-I{folder}"]
    done = subprocess.run(command, input=text, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_in_the_description_of_an_fmu_they_are_text(exported, hostile):
    """No element "planted" in its XML or HTML, and the joint's name is read back from the description of a
    port."""
    root = ET.parse(exported / "fmu" / "modelDescription.xml").getroot()
    assert "planted" not in {element.tag for element in root.iter()}
    ports = root.findall("ModelVariables/ScalarVariable")
    assert hostile.joint in ports[0].get("description")
    assert not planted((exported / "fmu" / "documentation" / "index.html").read_text())


def test_in_mjcf_and_urdf_they_are_attributes(hostile):
    """Both are read back: no element is planted, and the joint has its name."""
    root = ET.fromstring(mjcf(MuJoCoPlant(hostile.biped)))
    assert "planted" not in {element.tag for element in root.iter()}
    assert hostile.joint in {joint.get("name") for joint in root.iter("joint")}
    tree = hostile.biped.tree
    (hostile.folder / "again.urdf").write_text(to_xml(tree))
    assert read(hostile.folder / "again.urdf").tree.joints == tree.joints


def test_in_pages_they_are_text(hostile):
    """In the settings, which are a script, in the title and in the legend: an HTML parser finds no planted
    element or script."""
    settings = {"live": False, "fps": 20.0, "names": [hostile.name, hostile.joint]}
    assert not planted(
        with_viewer(
            "player",
            settings,
            title=hostile.name,
            captions=[("red", hostile.joint)],
            style="player.css",
        )
    )


class _Elements(HTMLParser):
    """Elements of a page, and scripts that have the planted text."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        self.found.append(tag)

    def handle_data(self, data):
        if self.found and self.found[-1] == "script" and data.strip() == "planted":
            self.found.append("planted")


def planted(page):
    """Whether a page has the planted element or script."""
    parser = _Elements()
    parser.feed(page)
    assert "body" in parser.found
    return "planted" in parser.found


@pytest.mark.parametrize("name", HOSTILE)
def test_in_toml_and_csv_they_are_read_back(name, tmp_path):
    """Names that are a key, value or cell come back as they were, by Python's own readers of TOML and CSV."""
    text = HOSTILE[name]
    assert tomllib.loads(f"{toml_key(text)} = {toml_value([text, {text: text}])}") == {
        text: [text, {text: text}]
    }
    path = write_csv({text: [text]}, tmp_path / "a.csv")
    with open(path, newline="", encoding="utf-8") as file:
        assert list(csv.reader(file)) == [[text], [text]]
