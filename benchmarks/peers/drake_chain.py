"""Drake's MultibodyPlant on the pinned chain: error-controlled, fixed-step and discrete.

Rotors are those of joint actuators with a gear ratio of 1, the reflected inertia.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from peers.chains import Chain, Coordinates, H, Simulate
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator

from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.urdf import Inertial, Joint, Link, Tree, Triple, to_xml

LONGEST = 0.1  # [s], of steps under error control


class DrakeChain(Chain):
    """MultibodyPlant of the pinned tree's URDF."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        self.plant = plant_of(biped, 0.0)
        self.context = self.plant.CreateDefaultContext()
        order: dict[int, str] = {
            self.plant.get_joint(j).velocity_start(): self.plant.get_joint(j).name()
            for j in self.plant.GetJointIndices()
            if self.plant.get_joint(j).num_velocities()
        }
        self.coordinates = Coordinates(biped, [order[j] for j in sorted(order)])

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        T, context = self.coordinates.T, self.context
        self.plant.SetPositionsAndVelocities(context, np.concatenate((T @ q, T @ v)))
        port = self.plant.get_applied_generalized_force_input_port()
        port.FixValue(context, self.coordinates.force(force))
        derivatives = self.plant.EvalTimeDerivatives(context).CopyToVector()
        return self.coordinates.inverse @ derivatives[self.biped.n :]

    def methods(self) -> Mapping[str, Simulate]:
        discrete = Simulator(plant_of(self.biped, H))
        return {
            "RK3 1 ms": self._simulate(self._integrating("runge_kutta3", None)),
            "RK3 1e-5": self._simulate(self._integrating("runge_kutta3", 1e-5)),
            "RK5 1e-6": self._simulate(self._integrating("runge_kutta5", 1e-6)),
            "discrete, 1 ms": self._simulate(discrete),
        }

    def _integrating(self, scheme: str, accuracy: float | None) -> Simulator:
        """Under error control, or with steps of H when no accuracy is asked for."""
        simulator = Simulator(self.plant)
        method = ResetIntegratorFromFlags(simulator, scheme, H if accuracy is None else LONGEST)
        if accuracy is None:
            method.set_fixed_step_mode(True)
        else:
            method.set_target_accuracy(accuracy)
        return simulator

    def _simulate(self, simulator: Simulator) -> Simulate:
        context, plant = simulator.get_mutable_context(), simulator.get_system()
        T, inverse, n = self.coordinates.T, self.coordinates.inverse, self.biped.n

        def simulate(q: Array, v: Array, duration: float) -> Array:
            context.SetTime(0.0)
            plant.SetPositionsAndVelocities(context, np.concatenate((T @ q, T @ v)))
            simulator.Initialize()
            simulator.AdvanceTo(duration)
            return inverse @ plant.GetPositions(context)[:n]

        return simulate


def plant_of(biped: Biped, time_step: float) -> MultibodyPlant:
    """The finalised plant; time_step 0 is continuous."""
    plant = MultibodyPlant(time_step)
    Parser(plant).AddModelsFromString(to_xml(welded(biped.pinned_tree)), "urdf")
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("ground"))
    for name in biped.description.actuated:
        actuator = plant.AddJointActuator(f"{name}_rotor", plant.GetJointByName(name))
        actuator.set_default_rotor_inertia(biped.armature)
        actuator.set_default_gear_ratio(1.0)
    for index in plant.GetJointIndices():
        joint = plant.get_joint(index)
        free = np.full(joint.num_positions(), np.inf)
        joint.set_position_limits(-free, free)
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -biped.description.gravity])
    plant.Finalize()
    return plant


def welded(tree: Tree) -> Tree:
    """The same robot with fixed joints taken out, so that no peer pays for links that do not move.

    Raises ModelError where both links of a fixed joint have a mass.
    """
    for joint in tree.joints:
        if joint.type == "fixed":
            return welded(_without(tree, joint))
    return tree


def _without(tree: Tree, weld: Joint) -> Tree:
    one, other = tree.links[weld.parent], tree.links[weld.child]
    if one.inertial is not None and other.inertial is not None:
        raise ModelError(
            f"URDF '{tree.source}', joint '{weld.name}': both '{one.name}' and '{other.name}' have a mass; "
            "expected one of them to be a frame"
        )
    body = one.inertial or _moved(other.inertial, weld.origin)
    links = {name: link for name, link in tree.links.items() if name != other.name}
    links[one.name] = Link(one.name, body, ())
    joints = [
        replace(j, parent=one.name, origin=_sum(j.origin, weld.origin))
        if j.parent == other.name
        else j
        for j in tree.joints
        if j is not weld
    ]
    return replace(tree, links=links, joints=tuple(joints))


def _moved(body: Inertial | None, by: Triple) -> Inertial | None:
    return None if body is None else replace(body, com=_sum(body.com, by))


def _sum(a: Triple, b: Triple) -> Triple:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])
