"""Why the player's file holds route positions and speeds, and not places.

A page must show every handle within a millimetre of its place at any time, from a file that a phone
opens. Three ways to hold a dance in evenly spaced frames:

1. places, joined by straight lines: two numbers a handle and frame. On a bend the chord cuts the
   corner, by v^2 h^2 / (8 r);
2. places and velocities, joined by cubics: four numbers. Where a handle passes a joint of the route
   its velocity turns at another rate all at once, which no cubic does;
3. route positions and speeds, joined by cubics, and the route once: two numbers. Every handle is on
   the route by construction; along it, the speed bends only where the chain does.

Frames of all handles still grow with benches times seconds: 3,000 benches that turn would take 60
million places. But where handle i + 1 stands depends on where handle i stands alone. A long dance is
therefore frames of the head, and a table of the way from a handle back to the next by its place
(player/following.py); below, what that comes to.

The numbers are whole multiples of 0.1 mm and 0.1 mm/s, of which each is foretold from those before it,
so that what is left deflates well. Below: how far each way is off at seven looks between frames, and
how large it is, for the turn of the contest.
"""

import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

from benchdragon.kernels.drawn_route import cubic
from benchdragon.kernels.following import NodeStretch
from benchdragon.kernels.frames import QUANTUM
from benchdragon.plans.schema import read_plan
from benchdragon.player.following import following
from benchdragon.player.frames import (
    LEVEL,
    SHARES,
    Frames,
    packed_bytes,
    packed_frames,
)

Table = npt.NDArray[np.float64]
START, END = -20.0, 100.0


def between(s: Table, rise: Table, share: float) -> Table:
    """Cubics through values s with slopes `rise` a frame, at a share of each step."""
    whole: Any = cubic
    return np.asarray(whole(s[:, :-1], s[:, 1:], rise[:, :-1], rise[:, 1:], share))


def kilobytes(*tables: Table) -> float:
    """Numbers in quanta, each less what the two before foretell, deflated and in base64, kB."""
    whole = [np.rint(table / QUANTUM).astype(np.int64) for table in tables]
    left = [np.diff(np.diff(table, axis=1, prepend=0), axis=1, prepend=0) for table in whole]
    numbers = np.concatenate([table.ravel() for table in left]).astype("<i4")
    planes = numbers.view(np.uint8).reshape(-1, 4).T.tobytes()
    return len(zlib.compress(planes, LEVEL)) * 4.0 / 3.0 / 1000.0


def main() -> None:
    """Print how far off each way is, and how large."""
    walk = read_plan("turn").build()
    print("step, s | lines: mm, kB | cubics of places: mm, kB | route positions: mm, kB")
    for step in (1.0, 0.5, 0.25, 0.125, 0.0625):
        times = np.arange(START, END + 0.5 * step, step)
        motion = walk.motion(times)
        x, y, s, v = motion.x.T, motion.y.T, motion.s.T, motion.speed.T
        heading = np.stack([walk.route.heading(row) for row in s])
        vx, vy = v * np.cos(heading), v * np.sin(heading)
        off = np.zeros(3)
        for share in SHARES:
            exact = walk.motion(times[:-1] + share * step)
            ex, ey, es = exact.x.T, exact.y.T, exact.s.T
            lines = [table[:, :-1] + share * np.diff(table, axis=1) for table in (x, y)]
            cubics = [between(table, rise * step, share) for table, rise in ((x, vx), (y, vy))]
            errors = [np.hypot(a - ex, b - ey).max() for a, b in (lines, cubics)]
            off = np.maximum(off, [*errors, np.abs(between(s, v * step, share) - es).max()])
        places, speeds = (np.rint(table / QUANTUM).astype(np.int64) for table in (s, v))
        ours = len(packed_frames(Frames(START, step, places, speeds, 0.0, False))) / 1000.0
        sizes = (kilobytes(x, y), kilobytes(x, y, vx, vy), ours)
        cells = [f"{1e3 * error:8.3f} {size:7.0f}" for error, size in zip(off, sizes, strict=True)]
        print(f"{step:6} | " + " | ".join(cells))
    for benches in (223, 1000, 3000):
        plan = read_plan("turn", [f"dragon.benches={benches}"])
        walk = plan.build()
        told = following(walk, *plan.span(walk), 0.9e-3, SHARES)
        assert told is not None
        last = told.tables.stretches[told.tables.ends[-1] - 1]
        nodes = told.tables.nodes[:, : int(last[NodeStretch.FIRST] + last[NodeStretch.NODES])].astype(
            "<i4"
        )
        sent = [packed_frames(told.head), packed_bytes(nodes.ravel())]
        size = sum(map(len, sent)) / 1000.0
        print(f"{benches} benches follow the head: {1e3 * told.head.error:.3f} mm, {size:.0f} kB")


if __name__ == "__main__":
    main()
