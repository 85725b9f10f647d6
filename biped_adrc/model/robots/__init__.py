"""Robots as data: a URDF and a robot.toml beside it, read, checked and written.

- `urdf`        links and joints as a small tree, what makes it physical, exchange of the legs, writing it
- `urdf_reader` reading a URDF into that tree
- `robot_toml`  the record robot.toml, parameter presets

A robot is a folder with these two files and no code; `model.biped` makes the dynamics from them,
and `robot_import` derives the record from a URDF alone.
"""
