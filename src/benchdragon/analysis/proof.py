"""Proofs: the places that an answer rests on, looked over in ball arithmetic (the extra `prove`).

A search concludes from computed chains by bounds that hold for exact ones, and leaves room for
`slack` metres in every distance. So it is a proof once every chain that it used is known to lie near
enough to the exact one. That is shown afterwards, handle by handle: the distance of two
computed places is enclosed with 100 bits, and what it differs from the link by, with the error of the
handle before, bounds how far the exact place can be (design/proof.py). What lies between places and
verdict is done in doubles, with room for their rounding: every answer says so (`assumed`).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from benchdragon.analysis.contact import contact_windows
from benchdragon.analysis.contact_search import SLACK
from benchdragon.analysis.distance import pair_distances
from benchdragon.analysis.ledger import Ledger
from benchdragon.analysis.obstacle_search import ObstacleSearch
from benchdragon.analysis.obstacles import ObstacleAnswers, touching
from benchdragon.errors import InputError, MissingExtraError, UnsureError, in_order, of_kind
from benchdragon.i18n import _
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.regions import EDGE
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.spiral_bound import SPARE
from benchdragon.model.answer import Answer, Status
from benchdragon.model.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.model.walk import Walk
from benchdragon.progress import Progress, silent

if TYPE_CHECKING:
    from flint import arb

Pair = tuple["arb", "arb"]

BITS = 100
# A bound on the distance of two benches over a step is off by at most so many times what their points
# are off by when their handles are off as points at both ends of the step, and along the route.
BESIDE, ALONG = 2.0, 2.0
# Roundings of the arithmetic behind the places, relative to coordinates and sizes, m.
ROUNDINGS = 16.0 * 2.2e-16
# What a cosine between bench and route may be off by: errors that could change one more are too large.
COSINE_SLACK = 1e-6
# Headings that jump by more at a joint, rad, are kinks.
KINK = 1e-11
# Places of cells and of the grid may be off by so much, m: they are widened by far more.
OTHERS = 0.1 * EDGE
# Slack is doubled at most so often, and never beyond this, m.
MOST_TRIALS, MOST_SLACK = 4, 1e-6
# Curves whose points and tangents a `Checker` encloses.
ENCLOSED = (Line, Arc, Clothoid, Spiral)
# Roundings of the few products that bound an error, and what factors change by within one.
ROUNDED_UP = 1.0 + 1e-6


@dataclass(frozen=True)
class Errors:
    """The most that computed places are off by, m, along the route and beside it together.

    Attributes:
        beside: of the chains that distances were taken from, as points.
        along: likewise, along the route.
        others: of what only says which pairs are near: cells, and chains of the grid.
        places: how many places were looked over.
    """

    beside: float
    along: float
    others: float
    places: int


def require_flint() -> None:
    """Say what to install if python-flint is not there.

    Raises:
        MissingExtraError: if it is not.
    """
    try:
        import flint  # noqa: F401 - an optional extra
    except ImportError:
        raise MissingExtraError("prove") from None


def require_enclosed(route: Route) -> None:
    """Say which part of a route cannot be proved, if there is one.

    Raises:
        InputError: if one is of a kind that a `Checker` does not enclose.
    """
    for number, curve in enumerate(route, start=1):
        if not isinstance(curve, ENCLOSED):
            raise InputError(
                _(
                    "part {number} of the route is {kind}, and proofs know lines, arcs, clothoids and "
                    "Archimedean spirals alone"
                ).format(number=number, kind=_(curve.called))
            )


@dataclass(frozen=True)
class Rear:
    """A rear handle, enclosed.

    Attributes:
        point: its place, m.
        tangent: the route's unit tangent there, in the walking direction.
        bench: the unit vector from it to the front handle.
        too_long: the distance to the front handle less the link, m.
        moved: how far it stands from the computed place along the route, at most, m.
    """

    point: Pair
    tangent: Pair
    bench: Pair
    too_long: "arb"
    moved: float

    def cosine(self, tangent: Pair) -> float:
        """That of the angle between the bench and a tangent, to rounding."""
        return float((self.bench[0] * tangent[0] + self.bench[1] * tangent[1]).mid())


class Checker:
    """Encloses the exact places of a route's stored numbers.

    Args:
        rows: the route.
        step: no step of a search is longer, m.
    """

    def __init__(self, rows: FloatArray, step: float) -> None:
        from flint import arb, ctx  # an optional extra

        ctx.prec = BITS
        self._arb = arb
        self.rows = rows
        self._exact = [[arb(float(value)) for value in row] for row in rows]
        self._kinds = rows[:, kernel.KIND].tolist()
        self._ways = [int(kernel.walks_up(rows, j)) for j in range(len(rows))]
        self.places = 0
        ends = [
            (j, float(u)) for j in range(len(rows)) for u in rows[j, [kernel.U_START, kernel.U_END]]
        ]
        self.bend = max(abs(kernel.curvature(rows, j, u)) for j, u in ends)
        joints = [self._joint(j) for j in range(len(rows) - 1)]
        self.smooth = [turn <= KINK for _gap, turn in joints]
        # What leaves a step's smooth course where a handle passes a joint.
        self.jumps = sum(gap + (step * turn if turn <= KINK else 0.0) for gap, turn in joints)

    def ball(self, value: float) -> "arb":
        """A float as an exact ball."""
        return self._arb(value)

    def place(self, j: int, at: "arb") -> tuple["arb", "arb"]:
        """The point at parameter u of row j, enclosed."""
        row, kind = self._exact[j], self._kinds[j]
        self.places += 1
        x, y, angle = row[kernel.X], row[kernel.Y], row[kernel.ANGLE]
        if kind == kernel.SPIRAL:
            sine, cosine = (angle + row[kernel.Q] * at).sin_cos()
            radius = row[kernel.P] * at
            return x + radius * cosine, y + radius * sine
        if kind == kernel.ARC:
            sine, cosine = angle.sin_cos()
            end_sine, end_cosine = (angle + row[kernel.P] * at).sin_cos()
            return x + (end_sine - sine) / row[kernel.P], y - (end_cosine - cosine) / row[kernel.P]
        if kind == kernel.LINE:
            sine, cosine = angle.sin_cos()
            return x + at * cosine, y + at * sine
        return self._clothoid(row, at)

    def heading(self, j: int, at: "arb") -> tuple["arb", "arb"]:
        """The unit tangent in the walking direction at parameter u of row j, enclosed."""
        row = self._exact[j]
        if self._kinds[j] == kernel.SPIRAL:
            sine, cosine = (row[kernel.ANGLE] + row[kernel.Q] * at).sin_cos()
            turn, scale = row[kernel.Q] * at, self._ways[j] / (1 + at * at).sqrt()
            return scale * (cosine - turn * sine), scale * (sine + turn * cosine)
        angle = row[kernel.ANGLE] + at * (row[kernel.P] + row[kernel.Q] * at / 2)
        sine, cosine = angle.sin_cos()
        return cosine, sine

    def _clothoid(self, row: list["arb"], at: "arb") -> tuple["arb", "arb"]:
        from flint import acb

        def tangent(s: Any, _analytic: bool) -> Any:
            phase = acb(row[kernel.ANGLE]) + s * (acb(row[kernel.P]) + acb(row[kernel.Q]) * s / 2)
            return (acb(0, 1) * phase).exp()

        # e^(i phase) is entire, but its real part on the axis is what is wanted: take both parts.
        whole = acb.integral(tangent, acb(0), acb(at))
        return row[kernel.X] + whole.real, row[kernel.Y] + whole.imag

    def head_error(self, j: int, u: float, s: float) -> float:
        """How far the head's computed place is from route position s, along the route, m."""
        row, at = self._exact[j], self._arb(u)
        ahead = at
        if self._kinds[j] == kernel.SPIRAL:
            ahead = self._ways[j] * (self._length(row, at) - self._length(row, row[kernel.U_START]))
        return _size(row[kernel.S_START] + ahead - self._arb(s))

    def _length(self, row: list["arb"], theta: "arb") -> "arb":
        root = (1 + theta * theta).sqrt()
        return row[kernel.P] * (theta * root + theta.asinh()) / 2

    def _joint(self, j: int) -> tuple[float, float]:
        """How far apart rows j and j + 1 are where they meet, m, and what the heading jumps by, rad."""
        end, start = self.ball(self.rows[j, kernel.U_END]), self.ball(self.rows[j + 1, kernel.U_START])
        gap, turn = (
            sum(_size(a - b) for a, b in zip(of(j, end), of(j + 1, start), strict=True))
            for of in (self.place, self.heading)
        )
        return gap, turn

    def may_pass_a_kink(self, j: int, u: float, room: float) -> bool:
        """Whether what stands within `room` metres of parameter u of row j may be beyond a kink."""
        if all(self.smooth):
            return False
        width = room * ROUNDED_UP / kernel.stretch(self.rows, j, u)
        way, last = self._ways[j], len(self.rows) - 1
        behind = way * (u - self.rows[j, kernel.U_START]) <= width
        beyond = way * (self.rows[j, kernel.U_END] - u) <= width
        return (behind and j > 0 and not self.smooth[j - 1]) or (
            beyond and j < last and not self.smooth[j]
        )

    def chain_error(
        self,
        links: FloatArray,
        row: FloatArray | IntArray,
        u: FloatArray,
        x: FloatArray,
        y: FloatArray,
        head: float,
    ) -> tuple[float, float]:
        """The most that computed places of a chain are off by, m, the head being off by at most `head`.

        As points, and along the route; infinite where it cannot be told. Each exact place is followed
        to within 1e-20 m by a Newton step from the computed one, and what that leaves is bounded with
        what the handle before left.
        """
        j, at = int(row[0]), self.ball(float(u[0]))
        front, tangent = self.place(j, at), self.heading(j, at)
        error = along = head + self.jumps
        beside = error + _away(front, float(x[0]), float(y[0]))
        sure = self._can_be_told(j, float(u[0]), error, float(links[0]))
        for i, link in enumerate(links[: len(u) - 1].tolist()):
            j = int(row[i + 1])
            rear = self._follow(front, j, float(u[i + 1]), link)
            behind, ahead = rear.cosine(rear.tangent), rear.cosine(tangent)
            if not (sure and min(behind, ahead) > 2.0 * COSINE_SLACK):
                return math.inf, math.inf
            error = _size(rear.too_long) + min(ahead + COSINE_SLACK, 1.0) * error
            error = error / (behind - COSINE_SLACK) * ROUNDED_UP + self.jumps
            off = error + rear.moved
            sure = self._can_be_told(j, float(u[i + 1]), off, link)
            along = max(along, off)
            beside = max(beside, error + _away(rear.point, float(x[i + 1]), float(y[i + 1])))
            front, tangent = rear.point, rear.tangent
        return (beside, along) if sure else (math.inf, math.inf)

    def _can_be_told(self, j: int, u: float, off: float, link: float) -> bool:
        """Whether cosines hold, and no kink is passed, within `off` metres of a place."""
        small = off * (self.bend + 2.0 / link) < COSINE_SLACK
        return small and not self.may_pass_a_kink(j, u, off)

    def _follow(self, front: Pair, j: int, u: float, link: float) -> Rear:
        """The handle one link behind an enclosed one, by a Newton step from parameter u of row j."""
        metres, at = kernel.stretch(self.rows, j, u), self.ball(u)
        near = self._bench(front, j, at, link)
        slope = near.cosine(near.tangent) * metres * self._ways[j]
        step = near.too_long.mid() / self.ball(slope)
        return self._bench(front, j, at + step, link, _size(step) * metres * ROUNDED_UP)

    def _bench(self, front: Pair, j: int, at: "arb", link: float, moved: float = 0.0) -> Rear:
        """A bench from a front handle to parameter `at` of row j, which is so many metres away."""
        rear, long = self.place(j, at), self.ball(link)
        dx, dy = front[0] - rear[0], front[1] - rear[1]
        too_long = (dx * dx + dy * dy).sqrt() - long
        return Rear(rear, self.heading(j, at), (dx / long, dy / long), too_long, moved)


def _size(value: "arb") -> float:
    """A float that is surely at least |value|."""
    return math.nextafter(float(abs(value).upper()), math.inf)


def _away(point: tuple["arb", "arb"], x: float, y: float) -> float:
    return _size(point[0] - x) + _size(point[1] - y)


def errors(walk: Walk, ledger: Ledger, head: float = 0.0, progress: Progress = silent) -> Errors:
    """The most that the places in a ledger are off by.

    `head` is what the head's route positions that were asked for are off by, m.
    """
    require_flint()
    links = walk.dragon.links
    checker = Checker(walk.route.rows, float(links.max()))
    jobs: list[tuple[int, FloatArray, tuple[FloatArray, ...]]] = []
    jobs += [(0, links, chains) for chains in ledger.evaluations]
    jobs += [(0, np.array([link]), chains) for link, chains in ledger.benches]
    jobs += [(1, np.array([link]), chains) for link, chains in ledger.cells]
    jobs += [(1, links, chains) for chains in ledger.grid]
    total, done = sum(len(chains[0]) * chains[2].shape[1] for _kind, _links, chains in jobs), 0
    worst = np.zeros((2, 2))
    for kind, sizes, (at, row, u, x, y) in jobs:
        for t in range(len(at)):
            off = head + checker.head_error(int(row[t, 0]), float(u[t, 0]), float(at[t]))
            worst[kind] = np.maximum(
                worst[kind], checker.chain_error(sizes, row[t], u[t], x[t], y[t], off)
            )
            done += u.shape[1]
            progress(done / total, "")
    beside, along = worst[0].tolist()
    return Errors(beside, along, float(worst[1].max()), checker.places)


def needed_slack(walk: Walk, found: Errors, extent: float) -> float:
    """The slack, m, that covers errors of places and the roundings behind them, `extent` m out."""
    extent += float(walk.dragon.length.max())
    return walk.dragon.lever * (BESIDE * found.beside + ALONG * found.along) + ROUNDINGS * extent


def clock_error(walk: Walk, start: float, end: float) -> float:
    """The most that the head's computed route positions at two times, s, are off by, m."""
    return (
        max(
            float(abs(walk.exact_head_position(t) - Fraction(float(walk.head_position([t])[0]))))
            for t in (start, end)
        )
        * ROUNDED_UP
    )


def prove_contact(
    walk: Walk, start: float, end: float, *, margin: float = 0.0, progress: Progress = silent
) -> Answer | None:
    """`first_contact`, proved: clear up to `lower`, and a pair nearer than the margin by `upper`.

    None is proved as well: no pair comes nearer than the margin from start to end. Both rest on what
    `assumed` says. Graze within rounding: the answer stays "undecided".

    Raises:
        InputError: for a route with a part that cannot be proved.
        MissingExtraError: without python-flint.
        UnsureError: if errors of places cannot be bounded well enough.
        WalkError: as `first_contact`.
    """
    of_kind("walk", walk, Walk)
    in_order(start, end)
    require_enclosed(walk.route)
    require_flint()

    def search(slack: float, ledger: Ledger) -> list[Answer]:
        windows = contact_windows(walk, start, end, margin=margin, most=1, slack=slack, ledger=ledger)
        return [window.opens for window in windows]

    return _proved_contact(walk, clock_error(walk, start, end), search, 0.0, progress)


def _proved_contact(
    walk: Walk,
    head: float,
    search: Callable[[float, Ledger], list[Answer]],
    extent: float,
    progress: Progress = silent,
) -> Answer | None:
    """The last contact that a search finds, with the slack that the errors behind it need; None: none.

    `head` is what the head's route positions are off by, m, and `extent` how far what stands still
    reaches.
    """
    slack = SLACK
    for _trial in range(MOST_TRIALS):
        ledger = Ledger()
        contacts = search(slack, ledger)
        found = errors(walk, ledger, head, progress)
        needed = needed_slack(walk, found, max(_extent(ledger), extent))
        if found.others > OTHERS or not needed < MOST_SLACK:
            break
        if needed <= slack:
            return _proved(contacts[-1], found, slack) if contacts else None
        slack = 2.0 * needed
    raise UnsureError(
        _("the errors of computed positions could not be bounded well enough for a proof")
    )


def prove_obstacle(walk: Walk, answers: ObstacleAnswers, start: float, end: float) -> ObstacleAnswers:
    """The answers about an obstacle, with its contact proved, or that there is none from start to end.

    The walk itself must be shown to go on so far: see `prove_contact`, on whose assumptions this rests.

    Raises:
        InputError: for a route with a part that cannot be proved.
        MissingExtraError: without python-flint.
        UnsureError: if errors of places cannot be bounded well enough.
        WalkError: as `first_touch`.
    """
    require_enclosed(walk.route)
    require_flint()
    obstacle = answers.obstacle
    extent = float(np.abs(obstacle.outline).max()) + obstacle.radius

    def search(slack: float, ledger: Ledger) -> list[Answer]:
        return touching(ObstacleSearch(walk, obstacle, start, end, slack, ledger))

    head = clock_error(walk, start, end)
    return replace(answers, contact=_proved_contact(walk, head, search, extent))


def prove_nearer(walk: Walk, s: float, i: int, j: int, margin: float) -> bool:
    """Whether benches i < j (rows, from 0) are surely nearer than `margin`, m, with the head about s.

    The head stands within a rounding of route position s.
    """
    require_flint()
    short = Walk(walk.dragon.first(j + 1), walk.route)
    placed = short.placement(s)
    ledger = Ledger()
    ledger.add_placement(placed)
    needed = needed_slack(short, errors(short, ledger), _extent(ledger))
    return bool(pair_distances(placed, i, j)[0] < margin - needed)


def assumed() -> tuple[str, ...]:
    """What every proof rests on besides the places that were enclosed."""
    return (
        _("the stored numbers of route and benches are exact"),
        _(
            "what is computed from positions is in double precision, with room for rounding: "
            "distances ({distances} of the largest coordinate), bounds on motion within a step, "
            "which benches can meet ({boxes} m), which turns of a spiral cannot touch ({turns} m), "
            "and that each handle stands at the nearest position one link behind and never jumps"
        ).format(distances=f"{ROUNDINGS:.1e}", boxes=f"{EDGE:.0e}", turns=f"{SPARE:.0e}"),
    )


def _proved(answer: Answer, found: Errors, slack: float) -> Answer:
    text = _(
        "{count} positions enclosed with {bits} bits: distances rest on positions within {error} "
        "m, of an allowed {slack} m"
    ).format(count=found.places, bits=BITS, error=f"{found.beside:.1e}", slack=f"{slack:.1e}")
    status: Status = "undecided" if answer.status == "undecided" else "proved"
    return replace(answer, status=status, assumptions=(*assumed(), text))


def _extent(ledger: Ledger) -> float:
    """The largest coordinate of chains that distances were taken from, m."""
    chains = [*ledger.evaluations, *(chain for _link, chain in ledger.benches)]
    return max((float(np.abs(chain[3:]).max()) for chain in chains if len(chain[0])), default=0.0)
