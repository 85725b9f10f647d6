"""Colours of robot and arrows, and sizes of these: the views from the side and in Meshcat share them."""

import numpy as np

from biped_adrc.core.types import Array

STANCE, SWING, TRUNK = "#0072B2", "#E69F00", "#333333"
"""Colours of stance leg, swing leg and trunk: blue, orange, dark grey; in grey print dark, light and black."""
REACTION, TORQUE = "#009E73", "#CC79A7"
"""Colours of the ground reaction, bluish green, and of a torque from outside, reddish purple."""
WEIGHT_LENGTH = 0.4
"""Length [m] of the arrow of a ground reaction that is as large as the robot's weight."""
LONGEST_ARROW = 1.2
"""Longest arrow of a ground reaction [m]; that of a larger one is cut, and the picture says so."""
METRES_PER_NEWTON_METRE = 0.004
"""Radius of the ring that shows an external torque, per torque [m / N m]; the same for all robots."""


def bent_arrow(radius: float) -> Array:
    """Outline (63, 2), x and z [m], of an arrow bent around the origin, counter-clockwise for a positive radius
    [m] and mirrored, so clockwise, for a negative one.

    The points are those of the outer rim, the head and the inner rim, from -60 to 240 degrees: the opening
    below leaves a joint visible.
    """
    angle, tip = np.radians(np.linspace(-60.0, 200.0, 30)), np.radians(240.0)
    rim = np.column_stack((np.cos(angle), np.sin(angle)))
    head = 1.3 * rim[-1], (np.cos(tip), np.sin(tip)), 0.7 * rim[-1]
    # shares of the radius: rims at 1.12 and 0.88, head from 1.3 to 0.7; a negative radius mirrors x
    return np.vstack((1.12 * rim, head, 0.88 * rim[::-1])) * [radius, abs(radius)]
