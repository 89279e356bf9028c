"""Why handles beside a turn are placed in runs of times that share a row, and not one by one.

While a dragon turns, few handles of a placement stand where the next time's do: on the same row of the
route. Taken one by one, these few cost more than all others. A run of times on one spiral is placed
abreast, as where all times share it; arcs and lines have a closed form.
"""

import time

import numpy as np

from benchdragon.plans.schema import read_plan

HEADS = np.linspace(150.0, 250.0, 512)


def nanoseconds(times: int) -> float:
    """The least time of five placements of the turning dragon, so many times abreast, ns a place."""
    walk, spent = read_plan("turn").build(), []
    for _repeat in range(5):
        began = time.perf_counter()
        for start in range(0, len(HEADS), times):
            walk.placement(HEADS[start : start + times])
        spent.append(time.perf_counter() - began)
    return 1e9 * min(spent) / len(HEADS) / (len(walk.dragon) + 1)


def main() -> None:
    """Print the table."""
    walk = read_plan("turn").build()
    row = walk.placement(HEADS[:64]).tables[0]
    mixed = int((row != row[:, :1]).any(axis=1).sum())
    print(f"of {len(row)} handles {mixed} stand on more than one row during 64 times")
    print("times abreast   ns a place")
    for times in (1, 4, 16, 64, 256):
        print(f"{times:13}   {nanoseconds(times):10.1f}")


if __name__ == "__main__":
    main()
