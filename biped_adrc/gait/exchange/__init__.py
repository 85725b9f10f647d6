"""Exchange of gaits and walks with other programs: arrays, JSON, MATLAB files, in any angle convention.

importing (from disk) -> record (arrays in their own convention, the paper's coordinates) or samples (fit over
the phase) -> importing (a `Gait`, checked). Exporting goes the same way back.
"""
