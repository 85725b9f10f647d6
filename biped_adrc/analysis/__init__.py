"""What a walk or a gait means: signals, certificates of steps, stability of the cycle, statistics.

Of a finished walk:
- `signals`                        all time series of a walk, and integrals and means of them
- `certificate`, `feasibility`     whether a real robot could have made these steps, by `ground_force` and the
                                 compiled loops in `demands`
- `touchdowns`                     when they were noticed
- `soft_steps`                     what the feet did on soft ground, and what that does to the error
- `statistics`                     shares and medians over many walks

Of a closed loop or a gait:
- `return_map`, `variational`      the Poincare map, its fixed point and its derivative
- `stability`                      multipliers by both methods side by side
- `zero_report`, `stride_gain`     predictions of the zero dynamics; gains from step to step
- `gait_design`                    a gait for a speed, proved by a walk
- `observer`, `loops`              the observer assistant; margins of a whole walker
"""
