"""Hybrid systems and their simulation: flow between events, event functions, resets, sample instants,
integration methods, and trajectories as the result. Nothing here depends on a robot.
"""
