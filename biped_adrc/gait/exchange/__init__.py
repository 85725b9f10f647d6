"""Exchange of gaits and walks with other programs: arrays, JSON, MATLAB files, in any angle convention.

importing (from disk, by the names of `entries`) -> record (arrays in their own convention, the paper's
coordinates) or samples (fit over the phase) -> importing (a `Gait`, checked). Samples of another robot go to
`causes`. Exporting goes the same way back.
"""
