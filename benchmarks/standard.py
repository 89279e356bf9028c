"""The standard table, 224 handles x 301 times, and its rivals: C, NumPy, SciPy, plain Python."""

import ctypes
import math
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy.optimize import fsolve
from timing import Options, digits, fastest, in_process, lines_of

from benchdragon import Dragon, Route, Spiral, Walk
from benchdragon.kernels.chain import empty_placements, march

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
# Rounds in which all ways of C take turns with ours; the best one then takes so many times as many.
ROUNDS, QUICK_ROUNDS, BEST_ROUNDS = 100, 20, 4
# Times of which those rivals get whose whole table would take minutes.
FSOLVE_TIMES, PLAIN_TIMES = 2, 8


def kernel_job() -> Callable[[], FloatArray]:
    """The compiled march of the standard table into arrays made beforehand."""
    places = empty_placements(len(LINKS) + 1, len(TIMES))

    def job() -> FloatArray:
        march(WALK.route.rows, LINKS, TIMES, 0, len(TIMES), places)
        return places.x

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


@dataclass(frozen=True)
class AgainstC:
    """Our compiled march beside the best C, the two taking turns: s of each, and which C that was."""

    ours: float
    best: float
    way: str
    job: Callable[[], FloatArray]


@cache
def against_c(options: Options) -> AgainstC:
    """The race of our march and C, compiled in all WAYS."""
    rounds, kernel = QUICK_ROUNDS if options.quick else ROUNDS, kernel_job()
    with tempfile.TemporaryDirectory() as folder:
        rivals = [c_job(Path(folder), way) for way in WAYS]
    times = fastest([kernel, *rivals], rounds)[1:]
    best = int(np.argmin(times))
    ours, theirs = fastest([kernel, rivals[best]], BEST_ROUNDS * rounds)
    return AgainstC(ours, theirs, f"best of {len(WAYS)} ways ({' '.join(WAYS[best])})", rivals[best])


def standard_table(options: Options) -> list[str]:
    """Rows of 224 handles x 301 times, places and speeds, one thread each."""
    kernel, c = kernel_job(), against_c(options)
    exact = kernel().copy()
    rounds = QUICK_ROUNDS if options.quick else ROUNDS
    first, by_walk = fastest([kernel, lambda: WALK.motion(TIMES)], rounds)
    again, by_numpy = fastest([kernel, numpy_job], max(rounds // 5, 3))
    third, by_fsolve = fastest([kernel, partial(fsolve_job, FSOLVE_TIMES)], 3)
    plain = plain_python_seconds() * len(TIMES) / PLAIN_TIMES
    fsolve_all = by_fsolve * len(TIMES) / FSOLVE_TIMES
    few = exact[:, :FSOLVE_TIMES]
    rows = [
        (f"C, {c.way}", c.best, c.ours, apart(c.job(), exact)),
        ("`Walk.motion`, arrays made anew", by_walk, first, apart(WALK.motion(TIMES).x.T, exact)),
        ("NumPy over times, three Newton steps", by_numpy, again, apart(numpy_job(), exact)),
        (f"our kernels as plain Python (from {PLAIN_TIMES} times)", plain, again, None),
        (
            f"SciPy fsolve for each handle (from {FSOLVE_TIMES} times)", fsolve_all, third,
            apart(fsolve_job(FSOLVE_TIMES), few),
        ),
    ]  # fmt: skip
    columns = ("standard table by", "ms", "ours, ms", "rival / ours", "largest difference in x, m")
    return lines_of(columns, [row(*entries) for entries in rows])


def apart(x: FloatArray, exact: FloatArray) -> float:
    """How far places lie from ours at most, m."""
    return float(np.abs(x - exact).max())


def row(name: str, rival: float, ours: float, error: float | None) -> list[str]:
    """One line of the table, times in s."""
    return [
        name, digits(1e3 * rival), digits(1e3 * ours), digits(rival / ours),
        "" if error is None else f"{error:.1e}",
    ]  # fmt: skip


def plain_python_seconds() -> float:
    """The march of PLAIN_TIMES with BENCHDRAGON_ENGINE=plain, in a process of its own, s."""
    script = (
        "import time, numpy as np; from benchdragon.plans.schema import read_plan\n"
        "walk = read_plan('spiral-in').build(); walk.motion([0.0])\n"
        f"times = np.arange({PLAIN_TIMES}.0); start = time.perf_counter()\n"
        "walk.motion(times); print(time.perf_counter() - start)"
    )
    return float(in_process(script, BENCHDRAGON_ENGINE="plain")[-1])
