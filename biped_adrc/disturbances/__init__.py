"""Disturbances of a walk: the external generalised force zeta (n,) [N m] of (1) as a function of time."""
