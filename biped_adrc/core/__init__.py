"""What every other folder of the package uses, and what has no mechanics and no control law in it.

- `errors`, `checks`, `verdict`  errors with exit codes, checks of a user's input, checks of a computed number
- `types`, `tree`                types of arrays; states of a controller, as a tree of arrays and as one vector
- `part`                         base of controllers, observers and the like; results that are kept in these
- `shown`                        equality of dataclasses with arrays, and their text on one line
- `registry`                     names of controllers, observers, robots, gaits, and the classes behind them
- `timing`                       controller in continuous time, or sampled
- `files`, `versions`            reading and writing; versions on which the digits of a run depend
- `linear`, `processes`          small linear systems; worker processes
"""
