"""Onto a robot: a controller with all that it needs as C99 without dependencies, also as an FMU."""
