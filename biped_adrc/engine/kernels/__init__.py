"""Integrators, event location and the hybrid walk in compiled loops that call laws by their addresses."""
