"""Compiled loops: integrators, location of events, and the walk; a walker's functions are called by address."""
