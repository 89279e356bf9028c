"""`make bench`: how fast the walk is, as ratios to rivals that run beside it in the same process.

Rivals take turns with ours, repeat by repeat, and the fastest of each counts, so that a machine
that slows down slows both. `--write` keeps the tables in benchmarks/RESULTS.md.
"""

import argparse
import ctypes
import datetime
import math
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from unittest import mock

import numba
import numpy as np
import numpy.typing as npt
from scipy.optimize import fsolve
from textbook import Stepped
from textbook import smallest_pitch as textbook_pitch

from benchdragon import (
    Dragon,
    Route,
    Spiral,
    TwoArcTurn,
    Walk,
    clearances,
    first_contact,
    tightest_pairs,
)
from benchdragon.analysis.check import check
from benchdragon.analysis.distance import nearest_each
from benchdragon.analysis.tables import Tables
from benchdragon.kernels.chain import march
from benchdragon.plans.schema import read_plan
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit, smallest_pitch
from benchdragon.solve.turn import best_turn
from benchdragon.solve.turn_trials import TurnGoal
from benchdragon.studio.tasks import SIZE

FloatArray = npt.NDArray[np.float64]
HERE = Path(__file__).parent
PITCH, START = 0.55, 32.0 * math.pi
WALK = Walk(Dragon.uniform(), Route((Spiral(PITCH, START, 0.0),)))
LINKS, TIMES = WALK.dragon.links, np.arange(301.0)
# Every way of compiling the C rival that was found to matter; the fastest one counts.
WAYS = [
    [f"-DLANES={lanes}", *wide, *lax]
    for lanes in (16, 32, 64, 128)
    for wide in ([], ["-mprefer-vector-width=512"])
    for lax in ([], ["-fno-math-errno", "-fno-trapping-math"])
]


def fastest(jobs: Sequence[Callable[[], object]], repeats: int) -> list[float]:
    """The least time of each job, s, the jobs taking turns."""
    best = [math.inf] * len(jobs)
    for _repeat in range(repeats):
        for i, job in enumerate(jobs):
            start = time.perf_counter()
            job()
            best[i] = min(best[i], time.perf_counter() - start)
    return best


def kernel_job() -> Callable[[], FloatArray]:
    """The compiled march of the standard table into arrays made beforehand."""
    shape = (len(LINKS) + 1, len(TIMES))
    row, failed = np.zeros(shape, np.int64), np.zeros((2, len(TIMES)), np.int64)
    u, x, y, ratio = (np.empty(shape) for _array in range(4))

    def job() -> FloatArray:
        march(WALK.route.rows, LINKS, TIMES, 0, len(TIMES), row, u, x, y, ratio, failed)
        return x

    return job


def c_job(folder: Path, way: Sequence[str]) -> Callable[[], FloatArray]:
    """The same by benchmarks/rival.c, compiled on the spot."""
    target = folder / ("rival" + "".join(way).replace("=", "") + ".so")
    flags = ["-O3", "-march=native", "-shared", "-fPIC", *way]
    subprocess.run(["gcc", *flags, str(HERE / "rival.c"), "-lm", "-o", str(target)], check=True)
    library = ctypes.CDLL(str(target))
    u, x, y, ratio = (np.empty((len(LINKS) + 1, len(TIMES))) for _array in range(4))

    def address(array: FloatArray) -> ctypes.c_void_p:
        return ctypes.c_void_p(array.ctypes.data)

    def job() -> FloatArray:
        library.march(
            ctypes.c_double(PITCH / (2.0 * math.pi)), ctypes.c_double(START), len(LINKS),
            address(LINKS), len(TIMES), address(TIMES),
            address(u), address(x), address(y), address(ratio),
        )  # fmt: skip
        return x

    return job


def numpy_job() -> FloatArray:
    """The same in NumPy, all times at once, three Newton steps a handle."""
    k = PITCH / (2.0 * math.pi)
    a = head_angles()
    h, ratio = LINKS[0] / (k * a), np.ones_like(a)
    x = np.empty((len(LINKS) + 1, len(a)))
    x[0] = k * a * np.cos(a)
    for i, link in enumerate(LINKS):
        for _step in range(8 if i < 2 else 3):
            s2, b = np.sin(0.5 * h) ** 2, a + h
            error = h * h + 4.0 * a * b * s2 - (link / k) ** 2
            h = h - error / (2.0 * h + 4.0 * a * s2 + 2.0 * a * b * np.sin(h))
        b = a + h
        common = h + a * b * np.sin(h)
        gear = (common - 2.0 * b * np.sin(0.5 * h) ** 2) / (common + 2.0 * a * np.sin(0.5 * h) ** 2)
        ratio = ratio * gear * np.sqrt((1.0 + b * b) / (1.0 + a * a))
        h, a = h * (a / b) * (LINKS[min(i + 1, len(LINKS) - 1)] / link), b
        x[i + 1] = k * a * np.cos(a)
    return x


def head_angles() -> FloatArray:
    """Spiral angles of the head at TIMES, by NumPy."""
    curve = WALK.route.curves[0]
    assert isinstance(curve, Spiral)
    return curve.angle(TIMES)


def fsolve_job(times: int) -> FloatArray:
    """The contest scripts' way for a few times: fsolve for every handle on the textbook equation."""
    k = PITCH / (2.0 * math.pi)
    x = np.empty((len(LINKS) + 1, times))
    for t, theta in enumerate(head_angles()[:times]):
        a = float(theta)
        x[0, t] = k * a * math.cos(a)
        for i, link in enumerate(LINKS):

            def chord(b: FloatArray, a: float = a, link: float = float(link)) -> FloatArray:
                return np.asarray(k * k * (a * a + b * b - 2.0 * a * b * np.cos(b - a)) - link * link)

            a = float(fsolve(chord, np.array([a + link / (k * a)]))[0])
            x[i + 1, t] = k * a * math.cos(a)
    return x


def standard_table(repeats: int) -> list[str]:
    """Rows of 224 handles x 301 times, places and speeds, one thread each."""
    kernel = kernel_job()
    exact = kernel().copy()
    with tempfile.TemporaryDirectory() as folder:
        rivals = [c_job(Path(folder), way) for way in WAYS]
        _ours, *c_times = fastest([kernel, *rivals], repeats)
        best = rivals[int(np.argmin(c_times))]
        ours, c_best, by_walk = fastest([kernel, best, lambda: WALK.motion(TIMES)], 4 * repeats)
        c_error = np.abs(best() - exact).max()
    way = " ".join(WAYS[int(np.argmin(c_times))])
    by_numpy, again = fastest([numpy_job, kernel], max(repeats // 5, 3))
    by_fsolve, third = fastest([lambda: fsolve_job(2), kernel], 3)
    plain = plain_python_seconds()
    numpy_error = np.abs(numpy_job() - exact).max()
    fsolve_error = np.abs(fsolve_job(2) - exact[:, :2]).max()
    head = [
        "| standard table by | time, ms | ours, ms | rival / ours | largest difference in x, m |",
        "|---|---|---|---|---|",
    ]
    rows = [
        (f"C, best of {len(WAYS)} ways ({way})", c_best, ours, c_error),
        ("`Walk.motion`, arrays made anew", by_walk, ours, 0.0),
        ("NumPy over times, three Newton steps", by_numpy, again, numpy_error),
        ("our kernels as plain Python (from 8 times)", plain * 301 / 8, again, 0.0),
        ("SciPy fsolve for each handle (from 2 times)", by_fsolve * 301 / 2, third, fsolve_error),
    ]
    verdict = f"\nOurs takes {ours / c_best:.2f} of the best C's time (at most 2 is wanted)."
    return head + [row(*entries) for entries in rows] + [verdict]


def row(name: str, rival: float, ours: float, error: float) -> str:
    """One line of the first table."""
    return f"| {name} | {rival * 1e3:.3g} | {ours * 1e3:.3g} | {rival / ours:.3g} | {error:.1e} |"


def plain_python_seconds() -> float:
    """The march of 8 times with BENCHDRAGON_ENGINE=plain, in a process of its own, s."""
    script = (
        "import time, numpy as np; from benchdragon.plans.schema import read_plan\n"
        "walk = read_plan('spiral-in').build(); walk.motion([0.0])\n"
        "start = time.perf_counter(); walk.motion(np.arange(8.0)); print(time.perf_counter() - start)"
    )
    return float(in_process(script, BENCHDRAGON_ENGINE="plain")[-1])


def in_process(script: str, **environment: str) -> list[str]:
    """What a fresh Python prints for `script`, word by word."""
    done = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True, text=True, check=True, env={**os.environ, **environment},
    )  # fmt: skip
    return done.stdout.split()


def growth(quick: bool) -> list[str]:
    """Rows of cost against benches and against times, with the fitted slope."""
    lines = [
        "| grows with | from .. to | ns a place, first .. last | slope of log cost, last decade |",
        "|---|---|---|---|",
    ]
    top = 10**5 if quick else 10**6
    benches = [10**e for e in range(2, round(math.log10(top)) + 1)]
    times = [10**e for e in range(1, 4 if quick else 5)]
    cases: list[tuple[str, list[int], Callable[[int], object]]] = [
        ("benches, one time", benches, lambda n: long_walk(n).motion([0.0])),
        ("benches, 64 times", benches[:-2], lambda n: long_walk(n).motion(np.arange(64.0))),
        ("times, 224 handles", times, lambda n: WALK.motion(np.linspace(0.0, 300.0, n))),
        (
            "times, the turn, 224 handles",
            times[:-1],
            lambda n: TURN.motion(np.linspace(-100.0, 100.0, n)),
        ),
    ]
    coiled = {n: long_walk(n).motion([0.0]) for n in benches[: -1 if not quick else None]}
    tightest_pairs(coiled[benches[0]])
    cases.append(("benches, tightest pair", list(coiled), lambda n: tightest_pairs(coiled[n])))
    for name, sizes, job in cases:
        seconds = [fastest([partial(job, n)], 5 if n < 10**5 else 2)[0] for n in sizes]
        slope = math.log(seconds[-1] / seconds[-2]) / math.log(sizes[-1] / sizes[-2])
        other = {"benches, 64 times": 64}.get(name, 1 if name.startswith("benches") else 224)
        each = [t / n / other * 1e9 for t, n in zip(seconds, sizes, strict=True)]
        lines.append(
            f"| {name} | {sizes[0]} .. {sizes[-1]} | {each[0]:.3g} .. {each[-1]:.3g} | {slope:.2f} |"
        )
    return lines


def long_walk(benches: int) -> Walk:
    """A uniform dragon of so many benches on the contest's spiral."""
    return Walk(Dragon.uniform(benches=benches), WALK.route)


TURN_ROUTE = TwoArcTurn(1.7).route()
TURN = Walk(Dragon.uniform(), TURN_ROUTE, start=float(TURN_ROUTE.joints[1]))


def large_jobs(quick: bool) -> list[str]:
    """Rows of jobs that must fit: time, and the peak memory of a process of their own."""
    million, times = (10**5, 10**3) if quick else (10**6, 10**4)
    jobs = {
        "imports alone": "pass",
        f"{million:,} benches at one time": (
            f"m = Walk(Dragon.uniform(benches={million}), route).motion([0.0]); print(m.chord_error)"
        ),
        f"1,000 benches x {times:,} times, in slices": (
            f"w = Walk(Dragon.uniform(benches=1000), route)\n"
            f"print(max(m.chord_error for m in w.motions(np.linspace(0.0, 300.0, {times}))))"
        ),
    }
    lines = ["| job | s | peak memory, MB | chords kept to, m |", "|---|---|---|---|"]
    for name, script in jobs.items():
        words = in_process(
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
        chord = f"{float(words[0]):.1e}" if len(words) == 3 else ""
        lines.append(f"| {name} | {float(words[-2]):.2f} | {float(words[-1]):.0f} | {chord} |")
    return lines


def cold_starts() -> list[str]:
    """Rows of whole processes: by the library, and by numba the first time ever and later; and help."""
    one = ["-m", "benchdragon", "motion", "spiral-in", "--at", "60", "--json", "--quiet"]
    lines = ["| whole process | s |", "|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        cache = {"XDG_CACHE_HOME": folder}
        compiled = {**cache, "BENCHDRAGON_ENGINE": "jit"}
        native = {**cache, "BENCHDRAGON_ENGINE": "native"}
        for name, arguments, environment, repeats in (
            ("`--help`", ["-m", "benchdragon", "--help"], cache, 5),
            ("`motion` of one time, by the library", one, native, 5),
            ("the same by numba, first ever", one, compiled, 1),
            ("the same by numba, cached", one, compiled, 5),
        ):
            job = [sys.executable, *arguments]
            variables = {**os.environ, **environment}
            call = partial(subprocess.run, job, env=variables, check=True, capture_output=True)
            seconds = fastest([call], repeats)[0]
            lines.append(f"| {name} | {seconds:.2f} |")
    return lines


def workers() -> list[str]:
    """Rows of one and two threads on many times; the numbers must be the same."""
    clock = np.linspace(0.0, 300.0, 20_000)
    one, two = fastest([lambda: WALK.motion(clock), lambda: WALK.motion(clock, workers=2)], 5)
    same = bool((WALK.motion(clock).x == WALK.motion(clock, workers=2).x).all())
    return [
        "| 224 handles x 20,000 times | s | same numbers |", "|---|---|---|",
        f"| 1 thread | {one:.3f} | |", f"| 2 threads | {two:.3f} | {'yes' if same else 'NO'} |",
    ]  # fmt: skip


def without_spiral_bound(job: Callable[[], object]) -> None:
    """Run a search that boxes every cell, as on curves that are no spirals."""
    begin = Tables.begin

    def begin_without(tables: Tables) -> None:
        begin(tables)
        tables.ground.spans[:] = math.inf, -math.inf

    with mock.patch.object(Tables, "begin", begin_without):
        job()


def contact_rows(quick: bool) -> list[str]:
    """First contact and smallest pitch against the textbook's stepped search, and how cost grows."""
    plan = read_plan("spiral-in")
    walk, disc = plan.build(), read_plan("spiral-in", ["disc.radius=4.5"])
    found, pitch = first_contact(walk, 0.0, 430.0), smallest_pitch(disc)
    search = Stepped(walk)
    textbook = search.first_contact(0.0, 430.0, 1.0, 1e-9)
    their_pitch, chains = textbook_pitch(disc, 0.44, 0.46, 1.0, 0.01 if quick else 1e-4)
    ours, bare, theirs = fastest(
        [
            lambda: first_contact(walk, 0.0, 430.0),
            lambda: without_spiral_bound(lambda: first_contact(walk, 0.0, 430.0)),
            lambda: Stepped(walk).first_contact(0.0, 430.0, 1.0, 1e-9),
        ],
        1 if quick else 3,
    )
    our_pitch, bare_pitch = fastest(
        [lambda: smallest_pitch(disc), lambda: without_spiral_bound(lambda: smallest_pitch(disc))],
        1 if quick else 5,
    )
    (their_time,) = fastest([lambda: textbook_pitch(disc, 0.44, 0.46, 1.0, 0.01 if quick else 1e-4)], 1)
    value, placed = (0.0, 0) if found is None else (found.value, found.evaluations)
    lines = [
        "| question | by | s | chains placed | answer |",
        "|---|---|---|---|---|",
        f"| first contact | ours | {ours:.3g} | {placed} | {value:.13f} s |",
        f"| | ours, without the bound for spirals | {bare:.3g} | {placed} | the same |",
        f"| | textbook: each second, then bisection to 1e-9 s | {theirs:.3g} | {search.chains} "
        f"| {textbook or 0.0:.9f} s |",
        f"| smallest pitch | ours, bracket {pitch.upper - pitch.lower:.0e} m | {our_pitch:.3g} | "
        f"| {pitch.value:.13f} m |",
        f"| | ours, without the bound for spirals | {bare_pitch:.3g} | | the same |",
        f"| | textbook: bisection to 1e-4 m, each second | {their_time:.3g} | {chains} "
        f"| {their_pitch:.5f} m |",
        "",
        f"Textbook over ours: first contact {theirs / ours:.1f}, smallest pitch "
        f"{their_time / our_pitch:.1f} (to four digits against thirteen).",
        "",
        "| benches | first contact, s | us a bench |",
        "|---|---|---|",
    ]
    for benches in (100, 1000) if quick else (100, 1_000, 10_000, 100_000):
        long = Walk(Dragon.uniform(benches), walk.route)
        job: Callable[[], object] = partial(first_contact, long, 0.0, 430.0)
        (seconds,) = fastest([job], 1 if benches > 1e4 else 2)
        lines.append(f"| {benches:,} | {seconds:.3g} | {1e6 * seconds / benches:.3g} |")
    return lines


def turn_rows(quick: bool) -> list[str]:
    """Greatest head speed, how its cost grows, and a best turn, in a warm process."""
    turn = read_plan("turn")
    greatest_head_speed(turn)
    lines = ["| question | benches | s | answer |", "|---|---|---|---|"]
    for benches in (100, 223) if quick else (100, 223, 1000, 3000):
        plan = turn.with_value("dragon.benches", benches)
        (seconds,) = fastest([partial(greatest_head_speed, plan, tolerance=1e-12)], 1 if quick else 2)
        found = greatest_head_speed(plan, tolerance=1e-12)
        lines.append(
            f"| greatest head speed, bracket {found.upper - found.lower:.0e} m/s | {benches:,} "
            f"| {seconds:.3g} | {found.value:.13f} m/s |"
        )
    if not quick:
        plan = read_plan("turn", ["turn.family=arc-line-arc", "walk.speed=1.3"])
        began = time.perf_counter()
        best = best_turn(plan, TurnGoal("way", least_radius=1.5027))
        seconds = time.perf_counter() - began
        lines.append(
            f"| best turn, arc-line-arc, at 1.3 m/s | 223 | {seconds:.3g} | {best.way:.4f} m |"
        )
    return lines


def quick_rows(quick: bool) -> list[str]:
    """Quick answers beside exact ones: all of a verdict, and the smallest pitch."""
    disc = "disc.radius=4.5"
    lines = ["| plan | verdict: exact, ms | quick, ms | exact over quick |", "|---|---|---|---|"]
    for source, *settings in (
        ["spiral-in"], ["spiral-in", disc], ["spiral-in", disc, "route.pitch=0.46"],
        ["spiral-in", disc, "route.pitch=0.44"], ["turn"], ["turn", "turn.family=arc-line-arc"],
        ["turn", "turn.ease=0.3"], ["turn", "dragon.head_length=2.2"],
    ):  # fmt: skip
        plan = read_plan(source, settings)
        lines.append(
            beside(source, settings, [partial(check, plan), partial(check, plan, quick=True)], quick)
        )
    lines += [
        "",
        "| plan | smallest pitch: exact, ms | quick, ms | exact over quick |",
        "|---|---|---|---|",
    ]
    for settings in ([], ["route.pitch=0.44"], ["route.pitch=0.6"], ["dragon.width=0.5"]):
        plan = read_plan("spiral-in", [disc, *settings])
        jobs = [partial(smallest_pitch, plan), partial(limit, plan, "pitch", tolerance=SIZE)]
        lines.append(beside("spiral-in", [disc, *settings], jobs, quick))
    motion = WALK.motion(np.linspace(0.0, 400.0, 64))
    each, tree = fastest([partial(nearest_each, motion), partial(clearances, motion)], 5)
    return [
        *lines, "", "| 223 benches in a coil | ms a time |", "|---|---|",
        f"| each bench's nearest | {1e3 * each / 64:.3f} |",
        f"| the nearest pair, by a hash grid | {1e3 * tree / 64:.3f} |",
    ]  # fmt: skip


def beside(
    source: str, settings: Sequence[str], jobs: Sequence[Callable[[], object]], quick: bool
) -> str:
    """A row of two jobs that take turns."""
    for job in jobs:
        job()
    exact, loose = (1e3 * seconds for seconds in fastest(jobs, 1 if quick else 5))
    return f"| {' '.join([source, *settings])} | {exact:.0f} | {loose:.0f} | {exact / loose:.1f} |"


def machine() -> str:
    """What the figures were measured on."""
    name = platform.processor() or platform.machine()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            name = line.split(":")[1].strip()
            break
    gcc = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=True).stdout
    return (
        f"{datetime.datetime.now(datetime.UTC).date()}; {name}, {os.cpu_count()} cores; Python "
        f"{platform.python_version()}, NumPy {np.__version__}, numba {numba.__version__}; "
        f"{gcc.splitlines()[0]}"
    )


def printed(name: str) -> list[str]:
    """The table that another script of this folder prints."""
    command = [sys.executable, "-m", f"benchmarks.{name}"]
    done = subprocess.run(command, cwd=HERE.parent, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


def main() -> None:
    """Measure, print, and with --write keep the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="smaller sizes, fewer repeats")
    parser.add_argument("--write", action="store_true", help="write benchmarks/RESULTS.md")
    options = parser.parse_args()
    if shutil.which("gcc") is None:
        sys.exit("the C rival needs gcc, and there is none")
    parts = [
        ["# Results of `make bench`", "", machine()],
        ["## The standard table", "", *standard_table(20 if options.quick else 100)],
        ["## Growth", "", *growth(options.quick)],
        ["## Contact", "", *contact_rows(options.quick)],
        ["## Turns", "", *turn_rows(options.quick)],
        ["## Quick answers", "", *quick_rows(options.quick)],
        ["## Large jobs", "", *large_jobs(options.quick)],
        ["## Whole processes", "", *cold_starts()],
        ["## Threads", "", *workers()],
        ["## The player's frames, in Chromium that draws without a GPU", "", *printed("frame_time")],
        ["## The studio, one person moving a slider", "", *printed("sliders")],
        ["## The studio, fifty people moving sliders", "", *printed("studio_load")],
    ]
    text = "\n".join("\n".join([*part, ""]) for part in parts)
    print(text)
    if options.write:
        (HERE / "RESULTS.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
