"""Export of a controller, with its model, gait and observer: as C99 without dependencies, and as a functional
mock-up unit (FMU) for other simulators.
"""
