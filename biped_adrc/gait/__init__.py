"""Gaits: from curves over a phase to periodic orbits, on disk, by design, and from other programs.

    curves -> constraint (q_b = h(Theta), a `reference`)   what controllers follow
    zero_dynamics, zero_orbits, zero_domain                the walk on the constraint: orbit, return map, limits
    gait (constraint + periodic orbit, JSON file)          what scenarios walk
    published, recipe, design                              where gaits come from
    conventions, exchange                                  gaits of other groups, in other angles
    outputs                                                y(q) in place of joint errors

The room knows robots (`model`) but neither controllers nor simulation.
"""
