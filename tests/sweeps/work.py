"""A short sweep, for the tests and for the processes that they start."""

import threading
from pathlib import Path
from typing import Any

from benchdragon import parallel
from benchdragon.parallel import threads
from benchdragon.plans.schema import read_plan
from benchdragon.sweeps import folder
from benchdragon.sweeps.sweep import Sweep, sweep

# A short dance: it is swept often.
PLAN = read_plan("spiral-in", ["dragon.benches=8", "route.start_turn=12"])
# A quick sweep with answers of every kind: contacts, clear dances, refused plans, folded benches. They
# fold in few of the dances, since it takes longest to find that they do.
VARY: dict[str, list[float | int | str]] = {
    "route.pitch": [-1, 0.2, 0.45, 0.5, 0.55],
    "disc.radius": [1.0, *[n / 8 for n in range(16, 32)]],
}
ASKED = ["first_contact", "greatest_speed"]


def swept(output: Path | None = None, executor: Any = None, **named: Any) -> Sweep:
    """A short sweep; in this thread, if no executor is given."""
    return sweep(PLAN, VARY, ASKED, output=output, executor=executor or threads(1), **named)


# Parts that are written before a sweep waits for its end, and points of each.
PARTS, OF_A_PART = 3, 2


def sweep_in_small_parts(output: Path) -> None:
    """The same, each block a part of its own; after some of them it waits until it is killed."""
    parallel.MOST_BLOCK, folder.EACH_SECONDS, folder.EACH_SHARE = OF_A_PART, 0.0, 0.0
    written = 0

    def wait(_share: float, _text: str) -> None:
        nonlocal written
        written += 1
        if written == PARTS:
            threading.Event().wait()

    swept(output, progress=wait)
