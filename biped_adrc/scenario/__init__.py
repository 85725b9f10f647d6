"""Scenarios: a walk described by plain values, and everything that turns it into a simulated walk.

The modules, in the order in which a walk passes through them:

    scenario     the values, with their units and ranges; the registry (`core.registry`) knows what names in
                 them stand for, such as "ADRC"
    build        robot, gait, controller and pushes, as one closed loop: a `Walker`
    walk         choice of the integration method, and simulation
    recording    the result: a `Walk` with signals, plots and files, or an `Outcome`, the few numbers that a
                 worker process sends back
    stored       walks as files
"""
