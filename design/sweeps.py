"""Where the points of a sweep run: one process, two, two threads, a Dask cluster of two; and a million.

Each place asks the same question, how near benches of a dragon of twenty come at one instant, for
pitches and widths of a grid; the rows go to Parquet files, and are compared bit by bit. Blocks last
about a second, so that what sending them costs does not show; processes are started anew each time,
which is part of the time. Threads wait for Python's lock, as so short a question is Python for the most
part. Dask's scheduler takes time that the two workers then lack on a machine of two cores.

Run it as `python -m design.sweeps 20000`, on a quiet machine; and as `python -m design.sweeps million`
for the million, with the greatest memory that the program and its largest worker took, and the size of
what it wrote.
"""

import resource
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from rich.progress import Progress

from benchdragon.parallel import Place, dask, processes, threads
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.progress import Progress as Told
from benchdragon.progress import silent
from benchdragon.sweeps.points import grid_points
from benchdragon.sweeps.sweep import Design, Sweep, run

WIDTHS = 100


def plan() -> Plan:
    """A short dragon that stands on the contest's spiral."""
    return read_plan("spiral-in", ["dragon.benches=20", "walk.end=0", "walk.position=300"])


def design(count: int) -> Design:
    """Clearances of one instant at so many points."""
    pitches = [0.45 + 0.2 * n * WIDTHS / count for n in range(count // WIDTHS)]
    widths = [0.2 + 0.001 * n for n in range(WIDTHS)]
    points = grid_points({"route.pitch": pitches, "dragon.width": widths})
    return Design(plan(), points, ("clearance",))


def timed(count: int, place: Place, told: Told = silent) -> tuple[float, Sweep, int]:
    """Wall seconds, the rows, and how many bytes they take."""
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        found = run(design(count), place, Path(folder, "rows"), told)
        seconds = time.perf_counter() - began
        size = sum(path.stat().st_size for path in Path(folder, "rows").iterdir())
    return seconds, found, size


def compare(count: int) -> None:
    """The same points at each place, in turns."""
    places: dict[str, Callable[[], Place]] = {
        "1 process": lambda: processes(1),
        "2 processes": lambda: processes(2),
        "2 threads": lambda: threads(2),
        "Dask, 2 workers": lambda: dask(count=2),
    }
    best: dict[str, float] = {}
    tables = []
    for _round in range(3):
        for name, place in places.items():
            seconds, found, _size = timed(count, place())
            best[name] = min(best.get(name, seconds), seconds)
            tables.append(found.numbers())
    assert all(table.equals(tables[0]) for table in tables)
    one = best["1 process"]
    for name, seconds in best.items():
        rate = count / seconds
        print(
            f"{name:16} {seconds:7.2f} s  {rate:7.0f} points a second  {one / seconds:5.2f} times one"
        )


def million() -> None:
    """A million points on two processes."""
    with Progress() as bar:
        task = bar.add_task("points", total=1.0)
        seconds, found, size = timed(
            1_000_000, processes(2), lambda share, _text: bar.update(task, completed=share)
        )
    own, workers = (
        resource.getrusage(who).ru_maxrss / 1e3
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    print(f"{len(found.table)} points in {seconds:.0f} s: {len(found.table) / seconds:.0f} a second")
    print(f"peak {own:.0f} MB, and {workers:.0f} MB in the largest worker; {size / 1e6:.0f} MB written")


if __name__ == "__main__":
    million() if sys.argv[1:] == ["million"] else compare(int(sys.argv[1]))
