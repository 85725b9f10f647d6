"""A script: `tune_slowly.py OUT` tunes the linear plant in the folder OUT, and says how many walks are done."""

import sys
import time
from pathlib import Path

import linear_plant as plant

from biped_adrc.campaign.workers import Threads
from biped_adrc.tuning.study_file import read_tuning
from biped_adrc.tuning.tune import tune


def rows(records):
    """Rows of the plant, late enough to be killed in between."""
    time.sleep(0.05)
    return plant.rows(records)


def main(out):
    study = read_tuning(plant.tables(budget=12, generation=4), columns=plant.COLUMNS)

    def progress(p):
        print(p.done, flush=True)

    tune(study, Path(out), Threads(2), function=rows, progress=progress)
    print("end", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
