"""The two controllers that the paper compares: NPD (PD with inertia decoupling) and ADRC (with the observer).

A module of its own, since the claims, the map of pushes, the plan and the validation all need the pair and
must not import one another for it.
"""

CONTROLLERS = ("NPD", "ADRC")
"""In the order of the tables and of every pair of outcomes."""
