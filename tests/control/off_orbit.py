"""A state off the orbit of a gait, and what its outputs do there on the plant."""

import numpy as np

import biped_adrc as ba


def off_orbit(gait, biped, seed=2):
    """(q, v) of the start of the gait with random errors, of 0.02 rad and 0.3 rad/s of standard deviation."""
    random = np.random.default_rng(seed)
    q, v = gait.start(biped)
    return q + random.normal(0, 0.02, biped.n), v + random.normal(0, 0.3, biped.n)


def output_acceleration(walker, gait, x):
    """y, y', y'' with the plant's own acceleration."""
    i = walker.instant(0.0, x, ba.Mode())
    m, p = i.measurement, walker.plant.p
    r = gait.constraint(0.0, m.q, m.v)
    return m.q_b - r.q_d, m.v_b - r.dq_d, i.a[:p] - r.drift - r.H @ i.a
