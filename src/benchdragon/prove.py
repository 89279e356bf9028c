"""Proofs: the places that an answer rests on, looked over in ball arithmetic (the extra `prove`).

A search concludes from computed chains by bounds that hold for exact ones, and leaves room for
`slack` metres of error in every distance. So it is a proof once every chain that it used is known to
lie near enough to the exact one. That is shown afterwards, handle by handle: the distance of two
computed places is enclosed with 100 bits, and what it differs from the link by, with the error of the
handle before, bounds how far the exact place can be (design/proof.py). Turns of a spiral that `shelter`
passes over rest on no place: a closed form holds there with 1e-9 m to spare, far above its rounding.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from benchdragon.answer import Answer, Status
from benchdragon.clearance import pair_distances
from benchdragon.contact import SLACK, contact_windows
from benchdragon.dragon import Dragon
from benchdragon.errors import MissingExtraError, UnsureError
from benchdragon.ground import Ledger
from benchdragon.kernels import curve as kernel
from benchdragon.kernels.cells import EDGE
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray
from benchdragon.messages import _
from benchdragon.motion import Walk

if TYPE_CHECKING:
    from flint import arb

Advance = Callable[[float], None]

BITS = 100
# A distance of two benches, and the paths of both over a step, are off by at most so many times what
# their points are off by when their handles are off as points, and along the route.
BESIDE, ALONG = 2.0, 4.0
# Roundings of the arithmetic behind the places, relative to coordinates and sizes, m.
ROUNDINGS = 16.0 * 2.2e-16
# What a computed cosine may be off by, far above rounding: it only scales errors.
COSINE_SLACK = 1e-6
# Slack is doubled at most so often.
MOST_TRIALS = 4


@dataclass(frozen=True)
class Errors:
    """The most that computed places are off by, m, along the route and beside it together.

    Attributes:
        beside: of the chains that distances were taken from, as points, given where the head was put.
        along: likewise, along the route.
        head: how far the head was put from its route position.
        others: of what only says which pairs are near, wherever the head was put.
        places: how many places were looked over.
    """

    beside: float
    along: float
    head: float
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


class Checker:
    """Encloses the exact places of a route's stored numbers."""

    def __init__(self, rows: FloatArray) -> None:
        from flint import arb, ctx  # an optional extra

        ctx.prec = BITS
        self._arb = arb
        self.rows = rows
        self._exact = [[arb(float(value)) for value in row] for row in rows]
        self.places = 0

    def ball(self, value: float) -> "arb":
        """A float as an exact ball."""
        return self._arb(value)

    def place(self, j: int, at: "arb") -> tuple["arb", "arb"]:
        """The point at parameter u of row j, enclosed."""
        row, kind = self._exact[j], self.rows[j, kernel.KIND]
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
        if self.rows[j, kernel.KIND] == kernel.SPIRAL:
            way = 1 if self.rows[j, kernel.U_END] >= self.rows[j, kernel.U_START] else -1
            ahead = way * (self._length(row, at) - self._length(row, row[kernel.U_START]))
        return _size(row[kernel.S_START] + ahead - self._arb(s))

    def _length(self, row: list["arb"], theta: "arb") -> "arb":
        root = (1 + theta * theta).sqrt()
        return row[kernel.P] * (theta * root + theta.asinh()) / 2

    def kinks(self) -> float:
        """The sum of what headings and places jump by at joints that count as smooth, rad and m."""
        total = 0.0
        for j in range(len(self.rows) - 1):
            ends = []
            for k, column in ((j, kernel.U_END), (j + 1, kernel.U_START)):
                u = float(self.rows[k, column])
                x, y = self.place(k, self._arb(u))
                ends.append((x, y, *kernel.place(self.rows, k, u)[2:]))
            gaps = [_size(a - b) for a, b in zip(ends[0][:2], ends[1][:2], strict=True)]
            turns = [abs(a - b) for a, b in zip(ends[0][2:], ends[1][2:], strict=True)]
            total += sum(gaps) + (sum(turns) if max(turns) < 1e-11 else 0.0)
        return total

    def chain_error(
        self,
        links: FloatArray,
        row: FloatArray | IntArray,
        u: FloatArray,
        x: FloatArray,
        y: FloatArray,
    ) -> tuple[float, float]:
        """The most that computed places of a chain are off by, its head being where it was put, m.

        As points, and along the route. Each exact place is followed to within 1e-20 m by a Newton step
        from the computed one, and what that leaves is bounded with what the handle before left.
        """
        head = int(row[0])
        front = self.place(head, self._arb(float(u[0])))
        tx, ty = kernel.place(self.rows, head, float(u[0]))[2:]
        error, beside, along = 0.0, _away(front, float(x[0]), float(y[0])), 0.0
        for i, link in enumerate(links[: len(u) - 1].tolist()):
            j, v = int(row[i + 1]), float(u[i + 1])
            metres = kernel.stretch(self.rows, j, v)
            next_tx, next_ty = kernel.place(self.rows, j, v)[2:]
            rear, residual, ux, uy = self._bench(front, j, self._arb(v), link)
            behind = ux * next_tx + uy * next_ty - COSINE_SLACK
            if behind <= 0.0:
                return math.inf, math.inf
            step = residual.mid() / (behind * metres * kernel.walks_up(self.rows, j))
            rear, residual, ux, uy = self._bench(front, j, self._arb(v) + step, link)
            ahead = min(ux * tx + uy * ty + COSINE_SLACK, 1.0)
            error = (_size(residual) + ahead * error) / behind * (1.0 + 1e-9)
            off = error + _size(step) * metres * (1.0 + 1e-9)
            if not off < 0.01 * COSINE_SLACK:
                return math.inf, math.inf
            along = max(along, off)
            beside = max(beside, error + _away(rear, float(x[i + 1]), float(y[i + 1])))
            front, tx, ty = rear, next_tx, next_ty
        return beside, along

    def _bench(
        self, front: tuple["arb", "arb"], j: int, v: "arb", link: float
    ) -> tuple[tuple["arb", "arb"], "arb", float, float]:
        """The rear place at parameter v of row j, how much too long the bench is, and its direction."""
        rear = self.place(j, v)
        dx, dy = front[0] - rear[0], front[1] - rear[1]
        residual = (dx * dx + dy * dy).sqrt() - self._arb(link)
        return rear, residual, float(dx.mid()) / link, float(dy.mid()) / link


def _size(value: "arb") -> float:
    """A float that is surely at least |value|."""
    return math.nextafter(float(abs(value).upper()), math.inf)


def _away(point: tuple["arb", "arb"], x: float, y: float) -> float:
    return _size(point[0] - x) + _size(point[1] - y)


def errors(walk: Walk, ledger: Ledger, advance: Advance | None = None) -> Errors:
    """The most that the places in a ledger are off by."""
    require_flint()
    checker = Checker(walk.route.rows)
    links = walk.dragon.links
    jobs: list[tuple[int, FloatArray, tuple[FloatArray, ...]]] = []
    jobs += [(0, links, chains) for chains in ledger.looks]
    jobs += [(1, np.array([link]), chains) for link, chains in ledger.cells]
    jobs += [(2, links, chains) for chains in ledger.grid]
    total, done = sum(len(chains[0]) * chains[2].shape[1] for _kind, _links, chains in jobs), 0
    worst, heads = np.zeros((3, 2)), np.zeros(3)
    for kind, sizes, (at, row, u, x, y) in jobs:
        for t in range(len(at)):
            worst[kind] = np.maximum(worst[kind], checker.chain_error(sizes, row[t], u[t], x[t], y[t]))
            head = checker.head_error(int(row[t, 0]), float(u[t, 0]), float(at[t]))
            heads[kind] = max(heads[kind], head)
            done += u.shape[1]
            if advance:
                advance(done / total)
    kinks = checker.kinks()
    others = float(worst[1:].max() + heads[1:].max())
    beside, along = worst[0].tolist()
    return Errors(beside + kinks, along + kinks, float(heads[0]), others, checker.places)


def needed_slack(walk: Walk, found: Errors, extent: float) -> float:
    """The slack, m, that covers errors of places and the roundings behind them, `extent` m out."""
    extent += float(walk.dragon.length.max())
    return walk.dragon.lever * (BESIDE * found.beside + ALONG * found.along) + ROUNDINGS * extent


def prove_contact(
    walk: Walk, start: float, end: float, *, margin: float = 0.0, advance: Advance | None = None
) -> Answer | None:
    """`first_contact`, proved: clear up to `lower`, and a pair nearer than the margin by `upper`.

    None is proved as well: no pair comes nearer than the margin from start to end. The route's and the
    dragon's stored numbers are taken as exact. Graze within rounding: the answer stays "undecided".

    Raises:
        MissingExtraError: without python-flint.
        UnsureError: if errors of places cannot be bounded well enough.
        WalkError: as `first_contact`.
    """
    require_flint()
    tell = advance or (lambda _share: None)
    slack = SLACK
    for _trial in range(MOST_TRIALS):
        ledger = Ledger()
        windows = contact_windows(walk, start, end, margin=margin, most=1, slack=slack, ledger=ledger)
        found = errors(walk, ledger, tell)
        extent = max(
            (float(np.abs(chain[3:]).max()) for chain in ledger.looks if chain[0].size), default=1.0
        )
        slack_needed = needed_slack(walk, found, extent)
        if found.others > 0.1 * EDGE or not slack_needed < 1e-6:
            break
        if slack_needed <= slack:
            return _proved(walk, windows[0].opens, found, slack) if windows else None
        slack = 2.0 * slack_needed
    raise UnsureError(_("the errors of computed places could not be bounded well enough for a proof"))


def prove_nearer(walk: Walk, s: float, i: int, j: int, margin: float) -> bool:
    """Whether benches i < j (rows, from 0) are surely nearer than `margin`, m, with the head about s.

    The head stands within a rounding of route position s.
    """
    require_flint()
    dragon = walk.dragon
    short = Walk(Dragon.of_sizes(*(dragon.sizes[n, : j + 1] for n in range(4))), walk.route)
    motion = short.motion([s])
    row, u = motion.state(0)
    beside, along = Checker(walk.route.rows).chain_error(
        short.dragon.links, row, u, motion.x[0], motion.y[0]
    )
    found = Errors(beside, along, 0.0, 0.0, len(u))
    extent = float(np.abs([motion.x, motion.y]).max())
    return bool(pair_distances(motion, i, j)[0] < margin - needed_slack(short, found, extent))


def _proved(walk: Walk, answer: Answer, found: Errors, slack: float) -> Answer:
    texts = (
        _("the stored numbers of route and benches are exact"),
        _(
            "{count} places enclosed with {bits} bits: distances rest on places within {error} m, "
            "of an allowed {slack} m"
        ).format(count=found.places, bits=BITS, error=f"{found.beside:.1e}", slack=f"{slack:.1e}"),
    )
    status: Status = "undecided" if answer.status == "undecided" else "proved"
    lower = _moved(walk, answer.lower, -found.head)
    upper = _moved(walk, answer.upper, found.head)
    return replace(answer, lower=lower, upper=upper, status=status, assumptions=texts)


def _moved(walk: Walk, time: float, metres: float) -> float:
    """When the head stands so many metres ahead of where it stands at `time`, rounded out."""
    s = float(walk.profile.distance(time)) + metres
    far = math.copysign(math.inf, metres)
    moved = walk.profile.time(math.nextafter(s, far))
    for _ulp in range(4):
        moved = math.nextafter(moved, far)
    return moved
