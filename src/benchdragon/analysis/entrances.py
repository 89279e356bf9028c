"""Entrances of the square: where they open the edge of the venue, and what is left of that.

An entrance opens the edge if that is no farther from it than half its width. Elsewhere its width has no
direction that is known: it is a round place. Benches must keep from the edge at an entrance, too; the
gate of the street alone is theirs.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from benchdragon.model.base_curve import Point
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.rings import Ring, between, length_of, nearest_on, opening, ring_of, stretch
from benchdragon.plans.schema import Plan

# An entrance whose width is not known is taken for a post so thick, m.
POST = 1e-3


@dataclass(frozen=True)
class Gate:
    """Where people come in.

    Attributes:
        place: m.
        width: m; None where the plan does not say.
        span: of the edge's ring what it opens, from one way along it to another, m; None of one that
            is not on the edge.
        shape: what of the ground it is.
    """

    place: Point
    width: float | None
    span: tuple[float, float] | None
    shape: Obstacle


def gates_of(plan: Plan) -> list[Gate]:
    """The entrances of a plan."""
    rings = [ring_of(edge.outline.tolist()) for edge in _venue(plan)]
    pairs = zip(plan.event.places, plan.event.widths, strict=True)
    return [_gate(place, width, rings) for place, width in pairs]


def _venue(plan: Plan) -> list[Obstacle]:
    """The edge of the venue, if the plan says one."""
    return [one for one in plan.obstacles() if one.kind == "venue"]


def _gate(place: Point, width: float | None, rings: Sequence[Ring]) -> Gate:
    """An entrance so wide, m, and what it opens of the venue's ring, if there is one."""
    if width is None:
        return Gate(place, None, None, Obstacle.circle("", place, POST))
    half = 0.5 * width
    for ring in rings:
        span = opening(ring, place, width)
        if span is not None:
            return Gate(place, width, span, Obstacle.line("", stretch(ring, *span)))
    return Gate(place, width, None, Obstacle.circle("", place, half))


def edge_left(plan: Plan) -> list[list[Point]]:
    """What entrances and the street's gate leave of the venue's edge, as open lines, m.

    Empty where the edge is whole, or there is none.
    """
    for edge in _venue(plan):
        ring = ring_of(edge.outline.tolist())
        spans = [gate.span for gate in gates_of(plan) if gate.span is not None]
        if edge.open is not None:
            posts = edge.open.tolist()
            begin, end = nearest_on(ring, posts[-1])[1], nearest_on(ring, posts[0])[1]
            spans.append((begin, end if end > begin else end + length_of(ring)))
        return between(ring, spans)
    return []
