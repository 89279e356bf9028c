"""Walk the random dances that report and manual quote, and keep what they need.

Run: python tools/make_random_dances.py [DRAWS]

Each case of `solve.tolerance.CASES` is drawn 1000 times; then as many dances of another seed are walked
at the pitch that the first say is enough for a risk of 1 in 20, so that no dance vouches for a pitch
that was chosen with it. It took 33 minutes on two cores that other work shared.
"""

import json
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from rich.progress import track

from benchdragon.files import whole_file
from benchdragon.paper import random_dances as run
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, Draw, Tolerance, needed_pitch, touches

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "src/benchdragon/paper" / run.FILE


def needed(name: str, number: int, exact: float) -> float:
    """What one dance needs, m, to a tenth of a micrometre."""
    draw = Draw(CASES[name].deviations, run.SEED, number)
    return round(needed_pitch(run.plan(), draw, exact), 7)


def touched(name: str, number: int, pitch: float) -> bool:
    """Whether one dance of the other seed touches."""
    draw = Draw(CASES[name].deviations, run.OTHER_SEED, number)
    return touches(run.plan().with_value("route.pitch", pitch), draw)


def main(draws: int) -> None:
    """Walk all dances and write the file, whole or not at all."""
    exact = limit(run.plan(), "pitch").value
    cases = {}
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for name, case in CASES.items():
            tasks = pool.map(needed, [name] * draws, range(draws), [exact] * draws, chunksize=10)
            pitches = list(track(tasks, name, draws))
            found = Tolerance(case.deviations, run.SEED, exact, np.sort(pitches))
            pitch = found.pitch_for(run.RISK)
            tasks = pool.map(touched, [name] * draws, range(draws), [pitch] * draws, chunksize=10)
            hits = sum(track(tasks, f"{name}: other dances", draws))
            vouched = {"pitch": pitch, "draws": draws, "hits": hits}
            cases[name] = {"needed": pitches, "vouched": vouched}
    data = {"plan": [run.PLAN[0], *run.PLAN[1]], "seed": run.SEED, "other_seed": run.OTHER_SEED}
    with whole_file(TARGET) as path:
        path.write_text(json.dumps({**data, "exact": exact, "cases": cases}) + "\n", "utf-8")


if __name__ == "__main__":
    main(int(sys.argv[1]) if sys.argv[1:] else run.DRAWS)
