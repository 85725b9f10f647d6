"""The one place that names the package's own classes and functions: what a change of its API has to edit.

own.py       controllers, observers, disturbances and references of the photograph's own
walkers.py   a walker from the plain values of a scenario
walks.py     walking it, and what of the walk is recorded
reports.py   runs of every kind, reports of the studies, rows of the verification
commands.py  the commands there are
"""
