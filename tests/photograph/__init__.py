"""The photograph: what the package does, recorded before and after a change, and compared.

    python -m tests.photograph take AFTER [--like tests/photograph/before] [--scenarios 20] [--only help]
    python -m tests.photograph compare tests/photograph/before AFTER [--allow tests/photograph/allowed.txt]

It records 300 random walks in both engines, each with what a start moved by 1e-14 does to it; the help of every
command; typical and wrong calls with what they print and write; `summary.json`; runs of every kind, reports and
the rows of the verification. `before` is the photograph that a change is judged by. Floats are stored so that
they read back bit for bit. Only `adapter` knows the package's API: a change of names is followed up there, and
nowhere else.
"""
