"""The random dances that report and manual quote: one run, kept with the program.

tools/make_random_dances.py makes it, in a quarter of an hour on two busy cores; `walked_again` walks
some of its dances again, so that the report can state that they are still reproduced.
"""

import json
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np

from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.tolerance import CASES, Draw, Tolerance, chance, needed_pitch

# The run: its file, plan, dances, seeds, and the risk whose pitch other dances vouch for.
FILE = "random_dances.json"
PLAN = ("spiral-in", ("disc.radius=4.5",))
DRAWS, SEED, OTHER_SEED, RISK = 1000, 1, 2, 0.05


@dataclass(frozen=True)
class Vouched:
    """How often dances of another seed touched at a pitch that was chosen without them.

    Attributes:
        pitch: m.
        draws: dances walked at it.
        hits: those in which benches touched.
    """

    pitch: float
    draws: int
    hits: int

    @property
    def chance(self) -> tuple[float, float, float]:
        """Share that touched, and bounds of the probability: see `tolerance.chance`."""
        return chance(self.hits, self.draws)


@dataclass(frozen=True)
class Run:
    """The dances kept, by name of the case in `CASES`.

    Attributes:
        exact: the smallest pitch of exact people, m.
        needed: the pitch that each dance needs, m, in the order drawn, (draws,).
        vouched: what other dances say of the pitch for RISK.
    """

    exact: float
    needed: dict[str, FloatArray]
    vouched: dict[str, Vouched]

    def tolerance(self, name: str) -> Tolerance:
        """What the dances of a case need."""
        return Tolerance(CASES[name].deviations, SEED, self.exact, np.sort(self.needed[name]))


def plan() -> Plan:
    """The plan of the run: the contest's dragon, to the edge of the disc."""
    return read_plan(PLAN[0], list(PLAN[1]))


def kept_run() -> Run:
    """The run that is kept."""
    data: dict[str, Any] = json.loads(files("benchdragon.paper").joinpath(FILE).read_text("utf-8"))
    cases = data["cases"]
    return Run(
        data["exact"],
        {name: np.array(case["needed"]) for name, case in cases.items()},
        {name: Vouched(**case["vouched"]) for name, case in cases.items()},
    )


def walked_again(run: Run, count: int) -> float:
    """How far the first `count` dances of each case now lie from what is kept, at most, m."""
    most = 0.0
    for name, kept in run.needed.items():
        for number in range(count):
            draw = Draw(CASES[name].deviations, SEED, number)
            most = max(most, abs(needed_pitch(plan(), draw, run.exact) - float(kept[number])))
    return most


def kept_tolerances() -> dict[str, Tolerance]:
    """What a thousand random dances need for each assumption that is relaxed: kept with the program.

    They are dances of the plan "question-3", the same as `tolerance` draws with their deviations and
    seed. By name: "aside", "play", "stray", "height", "benches" and "all".

    Examples:
        >>> found = bd.kept_tolerances()["aside"]
        >>> f"{found.pitch_for(0.1):.3f} m, exactly {found.exact:.3f} m"
        '0.503 m, exactly 0.450 m'
    """
    run = kept_run()
    return {name: run.tolerance(name) for name in CASES}
