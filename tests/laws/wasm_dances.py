"""First contacts of random dances by engine.wasm in Node, beside those of the engine of Python.

`python -m tests.laws.wasm_dances 10000` asks both for the first contact of so many dances of
`hard_dances`, each in one call and with the limits of exact searches, and counts how they agree. The
two round differently (another libm, no contraction), so that brackets need not be equal; but both hold
the same contact, so that they overlap.
"""

import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchdragon import Walk
from benchdragon.analysis.contact_search import MOST_EVALUATIONS, SLACK, WIDTH
from benchdragon.kernels import time_of_impact as kernel
from benchdragon.kernels.every_pair import search_all_pairs
from benchdragon.kernels.time_of_impact import Ending, Goal, Note
from tests.engine.recording import Recording, replayed
from tests.laws.hard_dances import dance

# Steps of the head that are searched at once, as a share of the shortest link; dances in one recording.
STEP, BATCH = 0.125, 100
SYMBOL = "bd_every_pair_search_all_pairs"
NAMES = {
    Ending.CLEAR: "clear",
    Ending.FOUND: "contact",
    Ending.GRAZE: "graze",
    Ending.STUCK: "stuck",
    Ending.FALLEN: "cannot follow",
}


@dataclass(frozen=True)
class Found:
    """How a search ended, where the head then stood at least and at most, m, and which pair it was."""

    ending: int
    lower: float
    upper: float
    pair: int

    def overlaps(self, other: "Found") -> bool:
        """Whether the brackets of two have a head position in common."""
        return max(self.lower, other.lower) <= min(self.upper, other.upper)


@dataclass(frozen=True)
class Compared:
    """What both engines say of a dance."""

    seed: int
    one: Found
    other: Found

    def fault(self) -> str:
        """What they disagree about; empty if nothing. A graze may be none, or a contact."""
        endings = {self.one.ending, self.other.ending}
        if endings == {Ending.CLEAR} or endings == {Ending.CLEAR, Ending.GRAZE}:
            return ""
        if len(endings - {Ending.GRAZE}) > 1:
            return f"{NAMES[self.one.ending]}, {NAMES[self.other.ending]}"
        return "" if self.one.overlaps(self.other) else f"{self.one}, {self.other}"


def ask(recording: Recording, seed: int) -> Found:
    """Record the search of a dance; what it found."""
    tried = dance(seed)
    walk = tried.walk
    note = np.zeros(kernel.NOTES)
    limits = (tried.margin, SLACK, WIDTH, MOST_EVALUATIONS)
    values = (*question(walk, tried.last), *limits, note)
    ending = recording.call(SYMBOL, search_all_pairs, *values)
    return found(ending, note)


def question(walk: Walk, last: float) -> tuple[object, ...]:
    """The arguments of `search_all_pairs` up to the scratch for pairs."""
    dragon = walk.dragon
    benches = len(dragon)
    pairs = benches * (benches - 1) // 2
    first, second = np.zeros(pairs, dtype=np.int64), np.zeros(pairs, dtype=np.int64)
    room = kernel.empty_search(benches + 1, benches, pairs)
    steps = 2 + int((last - walk.start) / (STEP * float(dragon.links.min())))
    at = np.linspace(walk.start, last, steps)
    aside = np.empty(0)
    return (
        room, Goal.FIRST_TOUCH, walk.route.rows, dragon.links, aside, dragon.sizes, at, first, second,
    )  # fmt: skip


def found(ending: float, note: np.ndarray) -> Found:
    """What a search wrote into its note."""
    lower, upper, pair = note[[Note.LOWER, Note.UPPER, Note.PAIR]].tolist()
    return Found(int(ending), min(lower, upper), upper, int(pair))


def compare(seeds: range) -> Iterator[Compared]:
    """What both engines say of dances."""
    recording = Recording()
    ones = [ask(recording, seed) for seed in seeds]
    with tempfile.TemporaryDirectory() as folder:
        recording.write(Path(folder))
        memory, _seconds = replayed(Path(folder))
    for seed, one, call in zip(seeds, ones, recording.calls, strict=True):
        (ending,) = np.frombuffer(memory, np.float64, 1, call["results"])
        note = np.frombuffer(memory, np.float64, kernel.NOTES, call["values"][-1]["offset"])
        yield Compared(seed, one, found(ending, note))


def main(count: int) -> None:
    """Compare so many dances, and print what came of them."""
    endings, differ, apart, wrong = Counter[str](), Counter[str](), [0.0], 0
    for begin in range(0, count, BATCH):
        for each in compare(range(begin, min(begin + BATCH, count))):
            one, other = each.one, each.other
            endings[NAMES[one.ending]] += 1
            if one.ending != other.ending:
                differ[f"{NAMES[one.ending]}, {NAMES[other.ending]}"] += 1
            elif one.ending == Ending.FOUND:
                differ["other bits of a contact's bracket"] += one != other
                apart.append(max(abs(one.lower - other.lower), abs(one.upper - other.upper)))
            if fault := each.fault():
                wrong += 1
                print(each.seed, fault)
    print(f"endings: {dict(endings)}")
    print(f"that differ: {dict(differ)}; ends of contacts' brackets apart at most {max(apart):.1e} m")
    print(f"{wrong} of {count} disagree")


if __name__ == "__main__":
    main(int(sys.argv[1]))
