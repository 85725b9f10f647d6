"""Design aid for GPI observers: what one demands of encoders, sampling and motors, before any walk.

- `observer_loop`    one joint under ADRC as a linear loop in continuous time, with a delay
- `observer_sampled` the same loop in sampled time: eigenvalues, and noise of the encoder
- `observer_impact`  the estimation error that an impact leaves
- `observer_choice`  the largest bandwidth that the hardware allows, for each order m
- `observer_report`  the report that puts all of this together, `observer_report`
- `observer_tables`  the report as text
- `to_ss`            observer and loop as state spaces of python-control

It uses the model, a gait's periodic orbit and the observers; no simulation enters.
"""
