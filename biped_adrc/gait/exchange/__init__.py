"""Exchange of gaits and walks with other programs: arrays, JSON, MATLAB files, in any angle convention.

files (disk) -> record (checked arrays in their own convention) -> convert (the paper's coordinates) -> closure
(is it a periodic gait?) -> importing (a `Gait`). Exporting goes the same way back.
"""
