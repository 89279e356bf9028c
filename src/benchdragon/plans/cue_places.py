"""Where on its way the head comes to cues that say a place on the ground, or a round of the dance."""

import math
from collections.abc import Sequence

import numpy as np

from benchdragon.i18n import _
from benchdragon.kernels.curve import CurveKind, FloatArray, RouteRow
from benchdragon.kernels.route import evaluate
from benchdragon.model.base_curve import Point
from benchdragon.model.curves import Route
from benchdragon.plans.cues import CueTable
from benchdragon.plans.source import Fault, KeyedError

# A route is sampled every so many metres. Of nearest points as near, to ALIKE, m, the first is meant.
STEP, ALIKE = 0.1, 1e-6
MOST_SAMPLES = 100_000
# A place is meant that the head comes so near to, m.
BESIDE = 10.0
# So often two steps about a nearest point are halved: to 1e-14 m.
HALVINGS = 44


def heads_of(cues: Sequence[CueTable], route: Route, first: float, last: float) -> list[float | None]:
    """How far the head has walked when it comes to each cue, m; None where a time says when that is.

    Args:
        cues: of a plan.
        route: of its dance.
        first: where on it the head begins, m.
        last: and ends.

    Raises:
        KeyedError: for a round that the dance does not have, or a place that the head never comes near.
    """
    begun = _begun(route.rows, first)
    found: list[float | None] = []
    for n, cue in enumerate(cues):
        key = f"cues.cue.{n}"
        if cue.round is not None and cue.round > len(begun):
            text = _("the dance has {count} rounds").format(count=len(begun))
            raise KeyedError([Fault(f"{key}.round", text)])
        if cue.place is None and cue.round is None:
            found.append(cue.head)
            continue
        span = first, last
        if cue.round is not None:
            span = begun[cue.round - 1], min([last, *begun[cue.round : cue.round + 1]])
        if cue.place is not None and span[0] > last:
            text = _("the walk ends before round {round} begins").format(round=cue.round)
            raise KeyedError([Fault(f"{key}.round", text)])
        at = span[0] if cue.place is None else _nearest(cue.place, route.rows, span, f"{key}.place")
        found.append(max(at - first, 0.0))
    return found


def _begun(rows: FloatArray, first: float) -> list[float]:
    """Where each round begins, m: the head's way in along a spiral, from where it stands at first."""
    spirals = [row for row in rows.tolist() if row[RouteRow.KIND] == CurveKind.SPIRAL]
    inward = [row for row in spirals if row[RouteRow.U_END] < row[RouteRow.U_START]]
    ahead = [row[RouteRow.S_START] for row in inward if row[RouteRow.S_START] >= first]
    return ahead if len(ahead) == len(inward) else [first, *ahead]


def _away(place: Point, rows: FloatArray, ways: Sequence[float]) -> list[float]:
    """How far a place is from points of a route, m."""
    poses = np.empty((len(ways), 4))
    evaluate(rows, np.array(list(ways)), poses)
    return [math.hypot(x - place[0], y - place[1]) for x, y, _heading, _bend in poses.tolist()]


def _nearest(place: Point, rows: FloatArray, span: tuple[float, float], key: str) -> float:
    """Where between two places of a route it is nearest to a point, m; of several the first."""
    low = max(span[0], rows.tolist()[0][RouteRow.S_START])  # before it there is no route
    high = max(span[1], low)
    count = max(2, min(MOST_SAMPLES, math.ceil((high - low) / STEP)))
    step = (high - low) / count
    ways = [low + step * n for n in range(count)] + [high]
    away = _away(place, rows, ways)
    near = min(away) + step
    lows = [
        n for n in range(count + 1)
        if away[n] <= near and away[n] <= min(away[max(n - 1, 0)], away[min(n + 1, count)])
    ]  # fmt: skip
    ends = [_descended(place, rows, ways[n], step, (low, high)) for n in lows]
    best = min(distance for distance, _way in ends)
    if best > BESIDE:
        text = _("the head comes no nearer to that place than {away} m").format(away=f"{best:.1f}")
        raise KeyedError([Fault(key, text)])
    return next(way for distance, way in ends if distance <= best + ALIKE)


def _descended(
    place: Point, rows: FloatArray, way: float, step: float, span: tuple[float, float]
) -> tuple[float, float]:
    """The least distance from a place within a step about a way, m, and where that is.

    A least distance itself, which hardly changes there, would tell its place to half the digits.
    """
    low, high = max(span[0], way - step), min(span[1], way + step)
    for _halving in range(HALVINGS):
        middle = 0.5 * (low + high)
        if _approaches(place, rows, middle):
            low = middle
        else:
            high = middle
    return _away(place, rows, [high])[0], high


def _approaches(place: Point, rows: FloatArray, way: float) -> bool:
    """Whether the route comes nearer to a place at a way, m."""
    pose = np.empty((1, 4))
    evaluate(rows, np.array([way]), pose)
    ((x, y, heading, _bend),) = pose.tolist()
    return (x - place[0]) * math.cos(heading) + (y - place[1]) * math.sin(heading) < 0.0
