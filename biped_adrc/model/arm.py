"""A fully actuated arm on a fixed base: every joint has a motor, so p = n and no row is unactuated.

    D(q) q'' + Omega(q, q') = u + zeta,   q'' = kappa u + xi,   kappa = D^-1,   xi = -D^-1 Omega

This is (11)-(15) with p = n, so the controllers of the biped run on an arm unchanged
(`closed_loop.arm` closes the loop). The URDF may be any tree of revolute and prismatic joints; it
is checked as strictly as a biped's URDF, and then given to Pinocchio as it is written, because no
re-rooting and no planar closed form is needed here. A payload is a homogeneous ball fixed to the
tool; the controller's nominal model is usually the arm without it.
"""

from __future__ import annotations

import math
import sysconfig
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from biped_adrc.errors import InputError, ModelError
from biped_adrc.model.pinned import finite_angles, frame_index
from biped_adrc.model.reduction import Reduction, reduce
from biped_adrc.robots.robot_toml import GRAVITY
from biped_adrc.robots.urdf import Vector
from biped_adrc.robots.urdf_reader import numbers, place_of, straightened
from biped_adrc.robots.urdf_xml import parse
from biped_adrc.shown import Shown
from biped_adrc.types import Array

UR5 = ("ur_description/urdf/ur5_robot.urdf", "tool0")
"""Path below the robot folder of example-robot-data, and the name of the tool's link."""
ACCURACY = 1e-9
"""Largest relative round-off that D^-1 may have: eps times the condition number of D, dimensionless."""


class Payload(NamedTuple):
    """A homogeneous solid ball that is fixed to the tool; its inertia about the centre is 2/5 m r^2."""

    mass: float
    """[kg]."""
    com: Vector
    """Centre (x, y, z) in the frame of the tool [m]."""
    radius: float
    """[m]."""


@dataclass(frozen=True)
class Arm(Shown):
    """An arm with its payload, if any. Make it with `Arm.load` or `Arm.ur5`.

    Coordinates q (n,) are [rad] for revolute and [m] for prismatic joints, from the base outwards.
    Pinocchio's work data inside is overwritten by every call: use one Arm per thread, as with a
    Biped.
    """

    source: str
    """Path of the URDF, for error messages."""
    text: str
    """URDF as text, without the <inertial> elements whose mass is zero."""
    tool: str
    """Name of the link that carries the payload and whose position is `tool_position`."""
    effort: Array
    """Largest torque of each motor from <limit effort> (n,) [N m] or [N]; infinite without a limit."""
    payload: Payload | None = None
    """What the tool carries; None for the bare arm."""

    @classmethod
    def load(cls, urdf: Path | str, tool: str) -> Arm:
        """Read an arm from a URDF; `tool` is the link at its end.

        Raises ModelError that names the file and the element for a body that is not physical, an
        unknown tool, and an inertia matrix that is not positive definite.
        """
        source, root = str(urdf), parse(urdf)
        _strip(root, source)
        straightened(root, source)  # refuses what is not physical
        moving = (joint for joint in root.findall("joint") if joint.get("type") != "fixed")
        efforts = {joint.get("name", ""): _effort(joint, source) for joint in moving}
        arm = cls(source, ET.tostring(root, encoding="unicode"), tool, np.zeros(0))
        effort = np.array([efforts[name] for name in arm.joints])
        return replace(arm, effort=effort)._checked()

    @classmethod
    def ur5(cls) -> Arm:
        """The UR5 of example-robot-data, with 6 joints and the tool frame `tool0`.

        Raises ModelError where the extra `robots` is not installed.
        """
        path, tool = UR5
        for folder in _data_folders():
            if (folder / path).is_file():
                return cls.load(folder / path, tool)
        raise ModelError(
            f"'{path}' of example-robot-data not found; install it by pip install 'biped-adrc[robots]'"
        )

    def with_payload(self, mass: float, com: Vector = (0.0, 0.0, 0.0), radius: float = 0.05) -> Arm:
        """The same arm with a ball of `mass` [kg] at `com` (x, y, z) [m] in the tool's frame; a
        payload it had before is replaced. radius [m] gives the ball's inertia.

        Raises InputError for a mass or radius that is not positive, or a place that is not finite.
        """
        if not (0.0 < mass < math.inf and 0.0 < radius < math.inf and all(map(math.isfinite, com))):
            raise InputError(
                f"the payload is {mass} kg, radius {radius} m, at {com} m; expected positive numbers and a "
                "finite place"
            )
        return replace(self, payload=Payload(mass, com, radius))._checked()

    @cached_property
    def model(self) -> pin.Model:
        """Pinocchio's model, payload included, with gravity along -z.

        Raises ModelError for a URDF that Pinocchio refuses, and for joints with more numbers than
        velocities (`continuous` ones are stored as sine and cosine).
        """
        try:
            model = pin.buildModelFromXML(self.text)
        except (ValueError, RuntimeError) as error:
            raise ModelError(f"URDF '{self.source}': Pinocchio refuses it: {error}") from error
        if model.nq != model.nv or model.nv == 0:
            raise ModelError(
                f"URDF '{self.source}': nq = {model.nq} and nv = {model.nv}, expected one number per joint "
                "and one joint at least; give a 'continuous' joint as 'revolute' with wide limits"
            )
        if self.payload is not None:
            frame = model.frames[frame_index(model, self.tool)]
            mass, com, radius = self.payload
            ball = pin.Inertia.FromSphere(mass, radius)
            ball.lever = np.array(com)
            model.appendBodyToJoint(frame.parentJoint, ball, frame.placement)
        model.gravity.linear = np.array([0.0, 0.0, -GRAVITY])
        return model

    @cached_property
    def _data(self) -> pin.Data:
        return self.model.createData()

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """Names of q1, ..., qn, from the base outwards."""
        return tuple(self.model.names)[1:]

    @property
    def n(self) -> int:
        """Number of joints; all have motors."""
        return int(self.model.nv)

    @property
    def p(self) -> int:
        """Number of motors, equal to n."""
        return self.n

    # -- dynamics ----------------------------------------------------------------------------------
    def inertia(self, q: Array) -> Array:
        """Inertia matrix D(q) (n, n) [kg m^2] for revolute joints, by the composite rigid body algorithm."""
        return np.array(pin.crba(self.model, self._data, self._finite(q)))

    def bias(self, q: Array, v: Array) -> Array:
        """Omega(q, q') = C q' + G (n,) [N m]: Coriolis, centrifugal and gravity torques."""
        x, dx = self._finite(q), self._finite(v)
        return np.array(pin.nonLinearEffects(self.model, self._data, x, dx))

    def reduction(self, q: Array, v: Array) -> Reduction:
        """D, Omega, kappa and xi of (11)-(15) at (q, q') (n,) [rad, rad/s].

        All coordinates are actuated, so the rows A_N (0, n) and a_N (0,) of the unactuated ones are
        empty.
        """
        return reduce(self.inertia(q), self.bias(q, v), self.n)

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force u + zeta (n,) [N m], by the articulated body
        algorithm.
        """
        x, dx = self._finite(q), self._finite(v)
        return np.array(pin.aba(self.model, self._data, x, dx, force))

    def kinetic_energy(self, q: Array, v: Array) -> float:
        """q'^T D q' / 2 [J]."""
        return float(pin.computeKineticEnergy(self.model, self._data, self._finite(q), v))

    def potential_energy(self, q: Array) -> float:
        """V(q) [J], zero for masses at the height of the base."""
        return float(pin.computePotentialEnergy(self.model, self._data, self._finite(q)))

    def tool_position(self, q: Array) -> Array:
        """Place (x, y, z) of the tool's frame in the frame of the base (3,) [m]."""
        pin.forwardKinematics(self.model, self._data, self._finite(q))
        frame = frame_index(self.model, self.tool)
        return np.array(pin.updateFramePlacement(self.model, self._data, frame).translation)

    def _finite(self, q: Array) -> Array:
        """q (n,) itself after a check of its shape and that all its numbers are finite."""
        return finite_angles(q, (self.n,))

    def _checked(self) -> Arm:
        """Itself, once the tool is there and D is positive definite at random states. Raises ModelError."""
        frame_index(self.model, self.tool)
        random = np.random.default_rng(5)
        for _ in range(4):
            D = self.inertia(random.uniform(-np.pi, np.pi, self.n))
            least, most = np.linalg.eigvalsh(D)[[0, -1]] if np.all(np.isfinite(D)) else (0.0, 1.0)
            if not most * np.finfo(float).eps <= ACCURACY * least:
                raise ModelError(
                    f"URDF '{self.source}': D has eigenvalues from {least:.2g} to {most:.2g}, expected "
                    "positive ones; look for a last link without mass, and for masses far apart"
                )
        return self


def _strip(root: ET.Element, source: str) -> None:
    """Remove the <inertial> of links whose mass and moments are all written as 0.

    Many URDFs mark pure frames in this way; the strict reader takes a mass of 0 for an error.
    """
    for link in root.findall("link"):
        inertial, where = link.find("inertial"), place_of(link, source)
        mass = None if inertial is None else inertial.find("mass")
        if inertial is None or mass is None:
            continue
        moments = inertial.find("inertia")
        written = () if moments is None else tuple(moments.attrib)
        values = [numbers(mass, "value", "", 1, where)[0]]
        values += [numbers(moments, key, "", 1, where)[0] for key in written]
        if not any(values):
            link.remove(inertial)


def _effort(joint: ET.Element, source: str) -> float:
    """<limit effort> of a joint [N m], infinite where it is not given. Raises ModelError unless it is
    positive: an arm has no passive joints.
    """
    limit = joint.find("limit")
    if limit is None or "effort" not in limit.attrib:
        return math.inf
    where = f"{place_of(joint, source)} <limit>"
    effort = numbers(limit, "effort", "", 1, where)[0]
    if not effort > 0.0:
        raise ModelError(
            f"{where}: effort is {effort:g}, expected a positive number; every joint has a motor"
        )
    return effort


def _data_folders() -> Iterator[Path]:
    """Folders where example-robot-data may lie: below the prefix that its wheel shares with Pinocchio's."""
    here = (Path(sysconfig.get_path(key)) for key in ("platlib", "purelib"))
    for place in [*(path / "cmeel.prefix" for path in here), *Path(pin.__file__).parents]:
        yield place / "share" / "example-robot-data" / "robots"
