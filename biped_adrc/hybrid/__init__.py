"""Hybrid systems: flows, guards, resets and clocks; one-step methods; the loop; trajectories.

Nothing here knows a robot.
"""
