"""`python -m tests.hostile [COUNT] [FIRST]`: strangers' plans, and what came of questions."""

import sys
from collections import Counter

from tests.hostile.children import NOT_SAFE, PLAN_WRONG, UNDECIDED, WRONG, tried
from tests.hostile.plans import hostile

COUNT, SHARE = 10_000, 0.1


def main(arguments: list[str]) -> int:
    """Try them, and say how many were refused and answered; 1 if one did what it must not."""
    count = int(arguments[0]) if arguments else COUNT
    first = int(arguments[1]) if len(arguments) > 1 else 0
    counts: Counter[str] = Counter()
    faults, seconds, memory = 0, 0.0, 0
    for seed, question, found in tried(range(first, first + count), hostile, SHARE):
        counts["tried"] += 1
        counts[_name(found.code, found.over)] += 1
        seconds, memory = max(seconds, found.seconds), max(memory, found.memory)
        if found.fault:
            faults += 1
            print(f"seed {seed}, {question}: {found.fault}", flush=True)
    print(", ".join(f"{name}: {number}" for name, number in counts.items()))
    print(f"longest: {seconds:.1f} CPU s; most memory: {memory / 1e6:.0f} MB; faults: {faults}")
    return 1 if faults else 0


def _name(code: int | None, over: bool) -> str:
    if over:
        return "told to be too much"
    if code in (WRONG, PLAN_WRONG):
        return "refused"
    if code is None:
        return "failed"
    return "undecided" if code == UNDECIDED else "answered" if code <= NOT_SAFE else "no solution"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
