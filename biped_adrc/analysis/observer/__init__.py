"""Observer assistant: the encoders, sampling and motors that an observer needs, before any walk.

- `loop`     one joint under ADRC as a linear loop with a delay, in continuous and in sampled time
- `transfer`  its law as transfer functions, exact for the sampled observer
- `impact`   the estimation error that an impact leaves
- `choice`   the largest bandwidth that the hardware allows, for each order m
- `report`   puts all of this together, in numbers, words and tables
"""
