"""What the tests of studies run in place of walks: cheap, the same each time, and bad on request.

A script as well: `standin.py FILE N PAUSE` runs a study of N records into FILE, and says how many are stored.
"""

import math
import os
import signal
import sys
import time
from pathlib import Path

from biped_adrc.campaign.chunk import Point
from biped_adrc.campaign.execute import run_study
from biped_adrc.campaign.store import About, open_store
from biped_adrc.campaign.workers import Crew, Threads, workers_of
from biped_adrc.versions import numerical_versions


def rows(records):
    """A row of each record; `raise` raises, `kill` ends the process, `once` does so at first."""
    return [_row(record) for record in records]


def _row(record):
    time.sleep(record.get("pause", 0.0))
    if "raise" in record:
        raise ValueError(f"no row for {record['x']}")
    if "kill" in record or _first_time(record.get("once")):
        os.kill(os.getpid(), signal.SIGKILL)
    x = record["x"]
    return {
        "status": "COMPLETED",
        "y": math.sin(x) / 3.0,
        "n": x * x,
        "none": None,
        "text": f"µ{x}",
    }


def _first_time(path):
    if path is None or Path(path).exists():
        return False
    Path(path).touch()
    return True


def carried_out(function, given, store, workers, **more):
    with Crew(workers_of(workers)) as crew:
        points = (r if isinstance(r, Point) else Point(r, r) for r in given)
        return run_study(function, points, store, crew, **more)


def about(name="standin", **configuration):
    return About(name, f"hash of {name}", configuration, dict(numerical_versions()))


def records(n, pause=0.0):
    more = {"pause": pause} if pause else {}
    return ({"x": k, "seed": k % 7, **more} for k in range(n))


def results(store):
    """All that may not depend on how a study was run."""
    return [(r.position, r.key, r.at, r.row) for r in store.results()]


def main(path, n, pause):
    def progress(p):
        print(p.done, flush=True)

    with open_store(Path(path), about()) as store:
        given = records(int(n), float(pause))
        carried_out(rows, given, store, Threads(2), chunk=3, total=int(n), progress=progress)
    print("end", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
