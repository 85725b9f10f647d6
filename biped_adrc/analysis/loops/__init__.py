"""The sampled loop of a whole walker at frozen phases of its gait: stability, margins
and ripple before any walk.

- `specification`  margins and ripple: any controller, sensors, clock, motors
- `walker_loop`    the loop as matrices, with its responses
- `frozen_gait`    the robot along a gait and its like with other inertias, and the sample instant, linearised
"""
