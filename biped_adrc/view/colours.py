"""Colours of robot and arrows, and sizes of these: the views from the side and in Meshcat share them."""

STANCE, SWING, TRUNK = "#0072B2", "#E69F00", "#333333"
"""Colours of stance leg, swing leg and trunk: blue, orange, dark grey; in grey print dark, light and black."""
REACTION, TORQUE = "#009E73", "#CC79A7"
"""Colours of the ground reaction, bluish green, and of a torque from outside, reddish purple."""
WEIGHT_LENGTH = 0.4
"""Length [m] of the arrow of a ground reaction that is as large as the robot's weight."""
METRES_PER_NEWTON_METRE = 0.004
"""Radius of the ring that shows an external torque, per torque [m / N m]; the same for all robots."""
