"""Walk the random dances that report and manual quote, and keep what they need.

Run: python tools/make_random_dances.py [DRAWS]

Each case of `solve.tolerance.CASES` is drawn 1000 times; then as many dances of another seed are walked
at the pitch that the first say is enough for a risk of 1 in 20, so that no dance vouches for a pitch
that was chosen with it. It took 12 minutes on two cores that other work shared.
"""

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from rich.progress import Progress, TaskID

from benchdragon.files import whole_file
from benchdragon.paper import random_dances as run
from benchdragon.parallel import Lost, in_blocks, processes
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress as Told
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, Dances, Deviations, Draw, Tolerance, touches, walked

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "src/benchdragon/paper" / run.FILE


@dataclass(frozen=True)
class Touching:
    """How many of some dances of the other seed touch."""

    plan: Plan
    deviations: Deviations

    def __call__(self, numbers: Sequence[int]) -> int:
        """Their number."""
        draws = [Draw(self.deviations, run.OTHER_SEED, number) for number in numbers]
        return sum(touches(self.plan, draw) for draw in draws)


def hits(name: str, draws: int, pitch: float) -> int:
    """How many of the other dances touch at a pitch."""
    work = Touching(run.plan().with_value("route.pitch", pitch), CASES[name].deviations)
    found = 0
    for numbers, count in in_blocks(work, range(draws), processes()):
        if isinstance(count, Lost):
            raise SystemExit(f"dances {numbers} were lost: {count.reason}")
        found += count
    return found


def case_of(name: str, exact: float, draws: int, told: Told) -> dict[str, Any]:
    """What the dances of a case need, to a tenth of a micrometre, and how many others touch."""
    deviations = CASES[name].deviations
    work = Dances(run.plan(), deviations, run.SEED, exact, own=False)
    needed = walked(work, draws, processes(), told)[0].round(7)
    pitch = Tolerance(deviations, run.SEED, exact, np.sort(needed)).pitch_for(run.RISK)
    vouched = {"pitch": pitch, "draws": draws, "hits": hits(name, draws, pitch)}
    return {"needed": needed.tolist(), "vouched": vouched}


def main(draws: int) -> None:
    """Walk all dances and write the file, whole or not at all."""
    exact, cases = limit(run.plan(), "pitch").value, {}
    with Progress() as bar:
        for name in CASES:
            told = partial(tell, bar, bar.add_task(name, total=1.0))
            cases[name] = case_of(name, exact, draws, told)
    data = {"plan": [run.PLAN[0], *run.PLAN[1]], "seed": run.SEED, "other_seed": run.OTHER_SEED}
    with whole_file(TARGET) as path:
        path.write_text(json.dumps({**data, "exact": exact, "cases": cases}) + "\n", "utf-8")


def tell(bar: Progress, task: TaskID, share: float, _text: str) -> None:
    """Show how far a case has come."""
    bar.update(task, completed=share)


if __name__ == "__main__":
    main(int(sys.argv[1]) if sys.argv[1:] else run.DRAWS)
