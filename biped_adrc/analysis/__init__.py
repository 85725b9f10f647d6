"""What a walk or a gait means: signals, certificates of steps, stability of the cycle, statistics.

Of a finished walk:
- `signals`                        all time series of a walk, and integrals and peaks of them
- `certificate`, `feasibility`     whether a real robot could have made these steps; `ground_force` and
                                 `demands` compute the force of the ground that they need
- `touchdowns`                     when the controller detected the touchdowns, if it has to detect them itself
- `soft_steps`                     what the feet did on soft ground, and what that does to the tracking error
- `statistics`                     shares and medians over many walks

Of a closed loop or a gait:
- `return_map`, `variational`      the Poincare map, its fixed point and its derivative
- `stability`                      its eigenvalues by differences and by the variational equation, side by side
- `tick_derivative`                derivative of a sample instant, for `variational` and `loops`
- `zero_report`                    what the zero dynamics predict of a gait
- `stride_gain`                    gains of a PI controller that corrects the walking speed once in each step
- `rough_ground`, `stride_map`     how rough a ground a gait bears, by the map of one number from step to step
- `rough_estimate`                 an estimate of the same for any controller, by one simulated step per height
- `forced_map`                     gains from heights, forces and wrong masses to the next steps, of full order
- `gait_design`                    a gait for a speed, proved by a simulated walk
- `family_design`                  a family of gaits, by speed and step length
- `observer`                       what an observer demands of encoders, sampling and motors
- `loops`                          margins of the sampled loop of a whole walker
"""
