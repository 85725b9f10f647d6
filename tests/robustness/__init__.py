"""Attacks on the numerics, longer than CI has time for: python -m tests.robustness engines, or steps.

engines  random scenarios over every field, in both engines: no traceback, no NaN, equal statuses, equal states
steps    random scenarios at default settings, at the step taken and at a quarter of it
"""
