"""Compiled code generated from the Pinocchio model of a planar robot, and checked against it."""
