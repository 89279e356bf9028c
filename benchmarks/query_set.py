"""An open set of continuous-collision queries: its dances, its queries, and the files that hold them.

benchmarks/queries/README.md states the model. All numbers are short decimals, read as the nearest
doubles, and these are exact. Which numbers are drawn depends on SEED and the dance's number alone.
"""

import csv
import itertools
import json
import lzma
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from flint import arb

from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import CurveKind, FloatArray
from benchdragon.proofs.ball_route import BallRoute, Row

T = TypeVar("T")
FOLDER = Path(__file__).parent / "queries"
DANCES, QUERIES = FOLDER / "dances.json.xz", FOLDER / "queries.csv.xz"
SEED = 2026
# The first so many dances have 3 to 300 benches, all others 3 to 40, which take less time to prove: 3
# times base ^ (x ^ exponent) with x drawn from 0 to 1.
LONG_DANCES, SHARE_OF_LONG, SHARE_OF_SHORT = 200, (100.1, 1.4), (13.4, 0.6)
# Digits behind the point, of all numbers of a dance.
DIGITS = 6
# No handle is farther behind the next one along the curve than this many links: see README.md.
SLACKEST = math.pi / 3
# A head is at least so far from where its chain is not all on the route, m, and goes so far on.
LEAD, RUN = 0.5, 60.0
KINDS = {
    "line": CurveKind.LINE,
    "arc": CurveKind.ARC,
    "clothoid": CurveKind.CLOTHOID,
    "spiral": CurveKind.SPIRAL,
}


@dataclass(frozen=True)
class Dance:
    """A chain of benches on a route.

    Attributes:
        kind: how it was drawn.
        route: curves in walking order, as in README.md.
        links: from handle to handle: the first bench's, and all others', m.
        front: from each bench's front handle to its front end, m.
        rear: from its rear handle to its rear end, m.
        benches: how many.
    """

    kind: str
    route: list[dict[str, str | float]]
    links: tuple[float, float]
    front: float
    rear: float
    benches: int

    @cached_property
    def exact(self) -> BallRoute:
        """The route, exactly."""
        rows: list[Row] = []
        for curve in self.route:
            row = _row(curve)
            if rows:
                last = rows[-1]
                row = replace(row, angle=last.heading(last.end) - row.heading(row.start))
            rows.append(row)
        return BallRoute(rows)

    @cached_property
    def rows(self) -> FloatArray:
        """The same as a table of kernels/curve.py."""
        table = np.zeros((len(self.route), kernel.COLUMNS))
        for j, row in enumerate(self.exact.rows):
            angle = float(row.angle)
            table[j] = (
                row.kind, j, float(row.s), float(row.position(row.end) - row.s), float(row.start),
                float(row.end), float(row.start), float(row.x), float(row.y), angle, float(row.p),
                float(row.q), math.cos(angle), math.sin(angle),
            )  # fmt: skip
        return table

    @cached_property
    def link(self) -> FloatArray:
        """From handle to handle, of each bench, m, (benches,)."""
        return np.array([self.links[0], *[self.links[1]] * (self.benches - 1)])

    @cached_property
    def sizes(self) -> FloatArray:
        """The table of sizes of kernels/box.py; the widths are those of queries."""
        overhang = np.full((2, self.benches), [[self.front], [self.rear]])
        return np.array([self.link + self.front + self.rear, np.ones(self.benches), *overhang])

    @property
    def span(self) -> tuple[float, float]:
        """Where the head may be, m: the whole chain on the route."""
        return SLACKEST * float(self.link.sum()) + LEAD, float(self.exact.length) - LEAD


def _row(curve: dict[str, str | float]) -> Row:
    """A curve in balls, at the origin along x; a spiral about it with its axis along x."""
    kind, zero = KINDS[str(curve["type"])], arb(0)
    told = {name: arb(value) for name, value in curve.items() if not isinstance(value, str)}
    if kind == CurveKind.SPIRAL:
        start, end, p, q = (told[name] for name in ("from", "to", "growth", "hand"))
    else:
        start, end = zero, told["length"]
        p, q = told.get("curvature", zero), told.get("curvature_rate", zero)
    way = 1 if end > start else -1
    return Row(kind, zero, zero, zero, p, q, start, end, way, float(start), zero, 0.0)


def drawn(number: int) -> Dance:
    """Dance number `number`, drawn at random."""
    rng = np.random.Generator(np.random.Philox(key=(SEED, number)))
    body = float(rng.uniform(0.7, 1.9))
    links = _round(body * rng.uniform(1.0, 1.7)), _round(body)
    front, rear = (_round(body * rng.uniform(0.08, 0.2)) for _ in range(2))
    most, power = SHARE_OF_LONG if number < LONG_DANCES else SHARE_OF_SHORT
    benches = int(3.0 * most ** (rng.random() ** power))
    kind = ("spiral", "turn", "arcs", "clothoids", "eights")[number % 5]
    way = SLACKEST * (links[0] + links[1] * (benches - 1)) + 2.0 * LEAD + RUN
    route = {
        "spiral": _spiral,
        "turn": _turn,
        "arcs": _arcs,
        "clothoids": _clothoids,
        "eights": _eights,
    }
    return Dance(kind, list(route[kind](rng, 1.001 * links[0], way)), links, front, rear, benches)


def _round(value: float) -> float:
    return round(float(value), DIGITS)


Curves = Iterator[dict[str, str | float]]


def _arc(radius: float, sweep: float) -> dict[str, str | float]:
    return {"type": "arc", "curvature": _round(math.copysign(1.0, sweep) / radius),
            "length": _round(radius * abs(sweep))}  # fmt: skip


def _coil(growth: float, inner: float, way: float, hand: float, inward: bool) -> dict[str, str | float]:
    """A spiral from an inner radius, m, so long; or walked inward."""
    low = inner / growth
    high = math.sqrt(low * low + 2.0 * way / growth) + 1.0
    start, end = (high, low) if inward else (low, high)
    return {"type": "spiral", "growth": _round(growth), "from": _round(start), "to": _round(end),
            "hand": hand}  # fmt: skip


def _spiral(rng: np.random.Generator, least: float, way: float) -> Curves:
    growth = rng.uniform(0.25, 0.9) / (2.0 * math.pi)
    inner, hand = least * rng.uniform(1.1, 2.5), rng.choice([-1.0, 1.0])
    yield _coil(growth, inner, way, float(hand), rng.random() < 0.7)


def _turn(rng: np.random.Generator, least: float, way: float) -> Curves:
    """Inward, a turn of two arcs, and outward."""
    growth = rng.uniform(0.5, 1.5) / (2.0 * math.pi)
    inner = least * rng.uniform(2.2, 3.0)
    yield _coil(growth, inner, 0.7 * way, 1.0, True)
    yield _arc(inner * rng.uniform(0.6, 0.75), -rng.uniform(0.85, 1.0) * math.pi)
    yield _arc(max(least, inner * rng.uniform(0.35, 0.45)), rng.uniform(0.85, 1.1) * math.pi)
    yield _coil(growth, inner, 0.5 * way, 1.0, False)


def _arcs(rng: np.random.Generator, least: float, way: float) -> Curves:
    gone = 0.0
    while gone < way:
        if rng.random() < 0.3:
            curve: dict[str, str | float] = {
                "type": "line",
                "length": _round(least * rng.uniform(0.3, 4.0)),
            }
        else:
            radius = least * math.exp(rng.uniform(0.0, 1.2))
            curve = _arc(radius, float(rng.choice([-1.0, 1.0]) * rng.uniform(0.3, 5.5)))
        gone += float(curve["length"])
        yield curve


def _clothoids(rng: np.random.Generator, least: float, way: float) -> Curves:
    """As a drawn line is fitted: the curvature is piecewise linear."""
    gone, bend, lean = 0.0, 0.0, 0.0
    while gone < way:
        length = least * rng.uniform(0.5, 1.9)
        lean = 0.9 * lean + rng.normal(0.0, 0.15)
        after = float(np.clip(lean + rng.normal(0.0, 0.3), -0.98, 0.98)) / least
        yield {"type": "clothoid", "curvature": _round(bend), "length": _round(length),
               "curvature_rate": (rate := _round((after - bend) / length))}  # fmt: skip
        gone, bend = gone + _round(length), bend + rate * _round(length)


def _eights(rng: np.random.Generator, least: float, way: float) -> Curves:
    """Loops to one side and the other, each a little different."""
    gone, side, radius = 0.0, 1.0, least * rng.uniform(1.0, 2.5)
    while gone < way:
        loop = radius * rng.uniform(1.0, 1.05)
        yield _arc(loop, side * rng.uniform(1.45, 1.55) * math.pi)
        yield {"type": "line", "length": _round(2.0 * loop * rng.uniform(0.97, 1.03))}
        gone, side = gone + (1.5 * math.pi + 2.0) * loop, -side


@dataclass(frozen=True)
class Query:
    """Do two benches touch while the head goes from `start` to `end`, and where first?

    Attributes:
        dance: its number.
        first: the bench nearer to the head, counted from 0.
        second: the other; not its neighbour.
        width: of both benches, m.
        start: the head's arc length from the route's start, m; they stand apart there.
        end: the last that is looked at.
        answer: "touch", "apart", or "open" where neither was proved; empty: not tried yet.
        low: of "touch": they do not touch before the head is there, m.
        high: of "touch": they overlap with the head there, m.
        separation: of "apart": they keep at least this distance, m.
    """

    dance: int
    first: int
    second: int
    width: float
    start: float
    end: float
    answer: str = ""
    low: float = math.nan
    high: float = math.nan
    separation: float = math.nan


COLUMNS = tuple(Query.__dataclass_fields__)
WHOLE = ("dance", "first", "second")


def read_dances(path: Path = DANCES) -> list[Dance]:
    """The dances of the set."""
    with lzma.open(path, "rt", encoding="utf-8") as file:
        told = json.load(file)["dances"]
    return [Dance(**{**one, "links": tuple(one["links"])}) for one in told]


def read_queries(path: Path = QUERIES) -> list[Query]:
    """The queries of the set, dance by dance."""
    with lzma.open(path, "rt", encoding="utf-8", newline="") as file:
        return [_query(row) for row in csv.DictReader(file)]


def _query(row: dict[str, str]) -> Query:
    values: list[Any] = []
    for name in COLUMNS:
        number = int(row[name]) if name in WHOLE else name != "answer" and float(row[name] or "nan")
        values.append(row[name] if name == "answer" else number)
    return Query(*values)


def by_dance(queries: Iterable[T], dance: Callable[[T], int]) -> Iterator[tuple[int, list[T]]]:
    """What is about each dance, one after another."""
    for number, group in itertools.groupby(queries, dance):
        yield number, list(group)


def dance_of(query: Query) -> int:
    """The number of a query's dance."""
    return query.dance


def write_dances(dances: Iterable[Dance], path: Path = DANCES) -> None:
    """Write dances, a line each."""
    lines = ",\n".join(json.dumps(asdict(dance)) for dance in dances)
    _write(path, f'{{"dances": [\n{lines}\n]}}\n')


def write_queries(queries: Iterable[Query], path: Path = QUERIES) -> None:
    """Write queries, a line each."""
    lines = [",".join(COLUMNS)]
    for query in queries:
        values = (getattr(query, name) for name in COLUMNS)
        lines.append(",".join("" if value != value else str(value) for value in values))
    _write(path, "\n".join(lines) + "\n")


def _write(path: Path, text: str) -> None:
    """Write a whole file, or none."""
    part = path.with_name(path.name + ".part")
    part.write_bytes(lzma.compress(text.encode("utf-8"), preset=9))
    part.replace(path)
