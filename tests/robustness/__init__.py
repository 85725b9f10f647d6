"""Attacks on the numerics, longer than CI has time for: python -m tests.robustness ATTACK.

engines  random scenarios over every field, in both engines: no traceback, no NaN, equal statuses, equal states
contact  random walks with touchdowns told, policies across contact and soft ground, in both engines
steps    random scenarios at default settings, at the step taken and at a quarter of it
"""
