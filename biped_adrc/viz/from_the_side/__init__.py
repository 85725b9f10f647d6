"""Walks from the side in matplotlib: robots, moving pictures, strips of stick figures."""
