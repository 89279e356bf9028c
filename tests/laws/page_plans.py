"""Verdicts of random plans by the page's check in Node, beside those of Python.

`python -m tests.laws.page_plans 10000` asks both about so many plans of `limited`, whole records in
both languages, and counts answers. Faults are told one by one; with any the run ends with status 1.
"""

import sys
from collections import Counter
from collections.abc import Iterator
from typing import Any

from tests.planner.verdicts import fault, here, limited, there

BATCH = 100


def kind(answer: Any) -> str:
    """What an answer is, in a word or two."""
    if "verdict" not in answer:
        return str(answer["kind"])
    verdict = answer["verdict"]
    return ("safe" if verdict["safe"] else "unsafe") if verdict["decided"] else "undecided"


def compared(seeds: range) -> Iterator[tuple[int, str, str]]:
    """Of each: its seed, what Python's answer is, and what is wrong with the page's, if anything."""
    for first in range(seeds.start, seeds.stop, BATCH):
        batch = range(first, min(first + BATCH, seeds.stop))
        plans = [limited(seed) for seed in batch]
        for seed, data, twin in zip(batch, plans, there(plans), strict=True):
            answer = here(data)
            yield seed, kind(answer), fault(answer, twin["found"])


def main(count: int, first: int = 0) -> int:
    kinds, faults = Counter[str](), 0
    for done, (seed, what, wrong) in enumerate(compared(range(first, first + count)), 1):
        kinds[what] += 1
        faults += bool(wrong)
        if wrong:
            print(f"{seed}: {wrong}", flush=True)
        print(f"\r{done} of {count}", end="", file=sys.stderr)
    print(file=sys.stderr)
    print(f"{count} plans: {dict(kinds.most_common())}; {faults} told otherwise by the page")
    return min(faults, 1)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
