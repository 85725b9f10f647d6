"""Gaits by optimisation on the zero dynamics."""
