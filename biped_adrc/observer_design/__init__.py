"""Design aid: what an observer, or a whole walker, demands of encoders, sampling and motors, before any walk.

- `observer_loop`    one joint under ADRC as a linear loop in continuous time, with a delay
- `observer_sampled` the same loop in sampled time: eigenvalues, and noise of the encoder
- `observer_impact`  the estimation error that an impact leaves
- `observer_choice`  the largest bandwidth that the hardware allows, for each order m
- `observer_report`  the report that puts all of this together, `observer_report`
- `observer_tables`  the report as text
- `specification`    margins and ripple of a whole walker: any controller, sensors, clock, motors
- `walker_loop`      its sampled loop at frozen phases, from the derivative of the sample instant
- `frozen_gait`      the robot along a gait and its like with other inertias, linearised
- `disk_margin`      the multiloop disk margin

It uses the model, a gait's periodic orbit and the observers; no simulation enters.
"""
