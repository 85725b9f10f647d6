"""What a walk or a gait means: signals, certificates of steps, stability of the cycle, statistics.

Of a finished walk:
- `signals`, `quadrature`          all time series of a walk, and integrals and means of them
- `certificate`, `feasibility`        whether a real robot could have made these steps
- `regression`, `statistics`       multipliers by (26), (27); shares and medians over many walks

Of a closed loop or a gait, before or without a long simulation:
- `return_map`, `variational`      the Poincare map, its fixed point and its derivative
- `stability`                      multipliers by all methods side by side
- `zero_report`, `forced_steps`    predictions of the zero dynamics
- `stride_gain`, `linear_loop`     gains from step to step, and the linear loop (19), (23)
"""
