"""Exchange of gaits and walks with other programs: arrays, JSON, MATLAB files, in any angle convention.

    importing   reads and writes the files, and checks the gait that comes out; the two functions a user calls
    entries     names of the entries in a file
    record      a gait as arrays, converted from its own angle convention to the paper's coordinates and back
    samples     a gait from angles over time, by a fit over the phase; where they do not fit the robot, which
                change of it would explain them

A gait is imported as a record or as samples, and exported as a record.
"""
