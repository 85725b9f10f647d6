"""Descriptions of robots: a URDF and a robot.toml beside it, read and written."""
