"""The robot: URDF, Pinocchio dynamics in the paper's coordinates, impact, the split (11)-(15)."""
