"""The sampled loop of a whole walker at frozen phases of its gait: stability, margins
and ripple before any walk.

A phase is a share of the time of a walking step; ripple is the torque that errors of the encoders cause.

- `specification`  margins and ripple of a walker with any controller, sensors, clock and motors
- `gang`           six frequency responses of the loop, with their peaks, for any controller
- `walker_loop`    the loop as matrices, with its responses
- `frozen_gait`    linearises the robot at phases of a gait, also with other inertias, and the sample instant
"""
