"""Observer assistant: what an observer demands of encoders, sampling and motors, before any walk.

- `loop`     one joint under ADRC as a linear loop in continuous time, with a delay
- `sampled`  the same loop in sampled time: eigenvalues, and noise of the encoder
- `impact`   the estimation error that an impact leaves
- `choice`   the largest bandwidth that the hardware allows, for each order m
- `report`   puts all of this together, in numbers, words and tables
"""
