"""The reproduction of a paper on a controller for the biped RABBIT: its runs, claims, tables and figures.

The paper compares two controllers that track a gait while pushes act on the joints: NPD, a PD law with
decoupling of the inertia, and ADRC, active disturbance rejection with an observer. Each claim of it is tried in
simulated walks, and gets a verdict.
"""
