"""Gaits: from curves over a phase to periodic orbits, on disk, by design, and from other programs.

    curves -> constraint (q_b = h(Theta), a `reference`)   the reference of controllers
    zero_dynamics, zero_orbits, zero_domain                the walk on the constraint: orbit, return map, limits
    gait (constraint + periodic orbit, JSON file)          the gait that a scenario walks
    published, design                                      origins of gaits
    conventions, exchange                                  gaits of other groups, in other angles
    outputs                                                y(q) in place of joint errors

The room uses robots (`model`), and neither controllers nor simulation.
"""
