"""Studies: many walks of one scenario with other values each, made on all cores.

Values vary by named cases that are compared, conditions under which they are, grids, random draws and seeds; or
a search proposes them.
"""
