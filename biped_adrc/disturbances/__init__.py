"""Disturbances of a walk: the external generalised force zeta (n,) [N m] on the n coordinates over time."""
