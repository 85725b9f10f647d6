"""Gaits: from curves over a phase to periodic orbits, on disk, by design, and from other programs.

    curves -> constraint (h, a `reference`)                what controllers track
    zero_dynamics, zero_orbits, zero_domain                the walk on the constraint: orbit, return map, limits
    gait (constraint + periodic orbit, JSON file)          the gait that a scenario walks
    published, design                                      gaits of the literature, and by optimisation
    conventions, exchange                                  gaits of other groups, in other angles
    outputs                                                what a controller drives to zero besides joint errors

A *gait* is a virtual constraint q_b = h(Theta) for the joints with motors, over the phase Theta, and the
periodic walk on it. These modules use robots (`model`), and neither controllers nor simulation.
"""
