"""A robot of one's own from one URDF: what its robot.toml says, derived and checked."""
