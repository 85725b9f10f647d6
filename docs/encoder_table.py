"""The rows of the table in docs/guide/observer.md, from the walks of examples/studies/encoder_observers.toml.

Run: python docs/encoder_table.py FOLDER, which walks what is not there yet. Of each observer and filter of the
rates it prints the largest bandwidth with which the walks of seeds 0 to 19 are all feasible, and of all such
bandwidths that of the least error; medians are over the walks of seeds 20 to 59.
"""

import sys
from collections import defaultdict
from statistics import median

import biped_adrc as ba


def feasible(rows):
    """How many of the rows are, the impact at most aside."""
    return sum(row["feasible"] + row["but_impact"] for row in rows)


def shown(name, walks):
    """Print the lines of one observer; walks: rows by bandwidth."""
    good = {w: rows[:20] for w, rows in walks.items() if feasible(rows[:20]) == 20}
    best = sorted(good, key=lambda w: median(row["rms_error"] for row in good[w]))
    for w in dict.fromkeys([max(good), best[0]] if good else []):
        fresh = walks[w][20:]
        error, torque = (median(row[x] for row in fresh) for x in ("rms_error", "rms_torque"))
        print(
            *name,
            f"{w:.0f} rad/s, {feasible(fresh)} of 40, {1e3 * error:.2f} mrad, {torque:.1f} N m",
        )


if __name__ == "__main__":
    walks = defaultdict(lambda: defaultdict(list))
    for row in ba.study("examples/studies/encoder_observers.toml", sys.argv[1]).rows():
        walks[row["case"], row["condition"]][row["controller.observer.bandwidth"]].append(row)
    for name, rows in walks.items():
        shown(name, rows)
