"""The sampled loop of a whole walker at frozen phases of its gait, and what it bears, before any walk.

- `specification`       margins and ripple: any controller, sensors, clock, motors
- `walker_loop`         the loop as matrices, with its responses; `disk_margin` its margin
- `tick_matrices`       the derivative of the sample instant
- `frozen_gait`         the robot along a gait and its like with other inertias, linearised
"""
