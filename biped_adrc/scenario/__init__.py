"""Scenarios: a walk described by plain values, and everything that turns it into a simulated walk.

scenario (values, units, ranges) + registry (what names stand for) -> build (robot, gait, controller, pushes: a
`Walker`) -> walk (integration method, simulation) -> recording (`Walk`: signals, plots, files;
`Outcome`: the few numbers that a worker process sends back). stored reads and writes walks as files.
"""
