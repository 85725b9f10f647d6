"""Placements of the drawn robot by Pinocchio."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from biped_adrc.model.biped import Biped


def floating(biped: Biped, values: Mapping[str, float]) -> dict[str, np.ndarray]:
    """Placements (4, 4) of the links by Pinocchio."""
    model = biped.floating.model
    data = model.createData()
    x = np.zeros(model.nq)
    for name, value in values.items():
        x[model.joints[model.getJointId(name)].idx_q] = value
    pin.framesForwardKinematics(model, data, x)
    return {n: data.oMf[model.getFrameId(n)].homogeneous.copy() for n in biped.tree.links}
