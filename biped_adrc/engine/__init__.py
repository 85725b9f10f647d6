"""Walks in machine code, which is made from the methods of controllers and other parts, and from the dynamics
of a planar robot as formulas, checked against Pinocchio.
"""
