"""Integrators, event location and the hybrid walk in compiled loops that call functions by their addresses."""
