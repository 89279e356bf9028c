"""How walks grow with benches and times, jobs that must fit, and threads."""

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from standard import PITCH, START, WALK
from timing import Options, digits, fastest, in_process, lines_of

from benchdragon import Dragon, TwoArcTurn, Walk, tightest_pairs

TURN_ROUTE = TwoArcTurn(1.7).route()
TURN = Walk(Dragon.uniform(), TURN_ROUTE, start=float(TURN_ROUTE.joints[1]))


def growth(options: Options) -> list[str]:
    """Rows of cost against benches and against times, with the fitted slope."""
    top = 5 if options.quick else 6
    benches = [10**e for e in range(2, top + 1)]
    times = [10**e for e in range(1, 4 if options.quick else 5)]
    coiled = {n: long_walk(n).motion([0.0]) for n in benches[:4]}
    # What grows, how many there are of what stays, the sizes, the job.
    cases: list[tuple[str, int, list[int], Callable[[int], object]]] = [
        ("benches, one time", 1, benches, lambda n: long_walk(n).motion([0.0])),
        ("benches, 64 times", 64, benches[:-2], lambda n: long_walk(n).motion(np.arange(64.0))),
        ("times, 224 handles", 224, times, lambda n: WALK.motion(np.linspace(0.0, 300.0, n))),
        (
            "times, the turn, 224 handles", 224, times[:-1],
            lambda n: TURN.motion(np.linspace(-100.0, 100.0, n)),
        ),
        ("benches, tightest pair", 1, list(coiled), lambda n: tightest_pairs(coiled[n])),
    ]  # fmt: skip
    columns = (
        "grows with", "from .. to", "ns a place, first .. last", "slope of log cost, last decade",
    )  # fmt: skip
    return lines_of(columns, [grown(*case) for case in cases])


def grown(name: str, other: int, sizes: Sequence[int], job: Callable[[int], object]) -> list[str]:
    """A row: a job of growing size."""
    seconds = []
    for n in sizes:
        job(n)
        seconds += fastest([partial(job, n)], 5 if n < 10**5 else 2)
    slope = math.log(seconds[-1] / seconds[-2]) / math.log(sizes[-1] / sizes[-2])
    each = [t / n / other * 1e9 for t, n in zip(seconds, sizes, strict=True)]
    places = f"{digits(each[0])} .. {digits(each[-1])}"
    return [name, f"{sizes[0]} .. {sizes[-1]}", places, f"{slope:.2f}"]


def long_walk(benches: int) -> Walk:
    """A uniform dragon of so many benches on the contest's spiral."""
    return Walk(Dragon.uniform(benches=benches), WALK.route)


def large_jobs(options: Options) -> list[str]:
    """Rows of jobs that must fit: time, and the peak memory of a process of their own."""
    benches, times = (10**5, 10**3) if options.quick else (10**6, 10**4)
    jobs = {
        "imports and one table of 224 handles": "",
        f"{benches:,} benches at one time": (
            f"print(Walk(Dragon.uniform(benches={benches}), route).motion([0.0]).chord_error)"
        ),
        f"1,000 benches x {times:,} times, in slices": (
            f"w = Walk(Dragon.uniform(benches=1000), route)\n"
            f"print(max(m.chord_error for m in w.motions(np.linspace(0.0, 300.0, {times}))))"
        ),
    }
    rows = []
    for name, script in jobs.items():
        *chord, seconds, peak = in_process(
            "import math, time, numpy as np\n"
            "from benchdragon import Dragon, Route, Spiral, Walk\n"
            f"route = Route((Spiral({PITCH}, {START!r}, 0.0),))\n"
            "Walk(Dragon.uniform(), route).motion([0.0])\n"
            f"start = time.perf_counter()\n{script}\n"
            "seconds = time.perf_counter() - start\n"
            "lines = open('/proc/self/status').read().splitlines()\n"
            "peak = next(line.split()[1] for line in lines if line.startswith('VmHWM'))\n"
            "print(seconds, int(peak) / 1024)"
        )
        kept = f"{float(chord[0]):.1e}" if chord else ""
        rows.append([name, f"{float(seconds):.2f}" if chord else "", f"{float(peak):.0f}", kept])
    return lines_of(("job", "s", "peak memory, MB", "chords kept to, m"), rows)


def threads(options: Options) -> list[str]:
    """Rows of one and two threads on many times; the numbers must be the same."""
    times = 2_000 if options.quick else 20_000
    clock = np.linspace(0.0, 300.0, times)
    one, two = fastest([lambda: WALK.motion(clock), lambda: WALK.motion(clock, workers=2)], 5)
    same = bool((WALK.motion(clock).x == WALK.motion(clock, workers=2).x).all())
    rows = [["1 thread", f"{one:.3f}", ""], ["2 threads", f"{two:.3f}", "yes" if same else "NO"]]
    return lines_of((f"224 handles x {times:,} times", "s", "same numbers"), rows)
