"""Compiled loops: integrators, location of events, and the walk.

A walker's own functions, such as its flow, are called by their addresses, so that one compilation of the loops
serves all walkers.
"""
