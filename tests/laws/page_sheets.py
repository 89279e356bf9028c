"""What benches do in random dances, in the planner's page and in Python: they say the same.

`python -m tests.laws.page_sheets 300` compares the walks and the sentences of the benches of so many
random plans, those that can be walked, over the first half minute of each.
"""

import re
import sys

from tests.planner.random_plans import plan
from tests.planner.test_bench_walks import compared, fault

# Plans of one run of Node.
BATCH = 20
# Outside of the venue a corner is nearest, and rounding says of which of its edges.
CORNER = re.compile(r"(.*)(?:right|far|left|near)( edge.* and .*)(?:right|far|left|near)( edge.*)")


def main(count: int) -> int:
    """Compare plans; 1 if any differ."""
    walked = wrong = 0
    for first in range(0, count, BATCH):
        found = compared([plan(seed, 0.0) for seed in range(first, min(first + BATCH, count))])
        faults = [told for told in (fault(*each) for each in found) if told and not CORNER.match(told)]
        walked, wrong = walked + len(found), wrong + len(faults)
        for told in faults:
            print(f"seeds {first} to {first + BATCH - 1}: {told[:300]}")
    print(f"{count} plans, {walked} of which can be walked: {wrong} differ")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
