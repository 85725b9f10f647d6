"""Controllers, wrappers around controllers, and outer loops; each idea has a file of its own.

A controller computes the torques of the motors from a measurement. A wrapper contains another controller, and
changes the torque that it commands or the measurement that it gets. An outer loop changes its reference.
"""
