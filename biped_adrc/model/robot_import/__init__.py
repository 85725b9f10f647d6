"""Import of a robot from one URDF: the content of its robot.toml, derived and checked.

- `import_robot` the whole way from a URDF to a Biped, and the two files written for it
- `mjcf`         reading an MJCF through MuJoCo's compiler
- `base`         planar base, found or added
- `anatomy`      feet, hip, order of the joints and phase variable

The laws of mechanics that the result must obey are in `model.physical`.

`ba.biped_from_urdf` and the commands `biped-adrc robot check` and `robot new` call it. Nothing else in the
package does: afterwards the robot is data like any other.
"""
