"""The dragon on all turns of a box at once: each handle one link behind the one before it, enclosed."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from flint import arb

from benchdragon.proofs.mean_value import ZERO, Form, UnboundedError
from benchdragon.proofs.turn_shape import Pose, TurnShape

# Newton's steps to a handle in the middle of a box, and when it has come near enough, m.
STEPS, NEAR = 30, 1e-25
# How often the range of a handle is widened until it surely holds it, and by what share.
WIDENINGS, WIDER = 8, 1.1
# Pieces into which the way between two handles is cut, until it surely holds no place for the rear one.
PIECES = (1, 4, 16)


class Handle(NamedTuple):
    """A handle: route position, m, place, and speed by the head's."""

    s: Form
    pose: Pose
    ratio: Form


def handles(shape: TurnShape, links: Sequence[arb], head: float) -> Iterator[Handle]:
    """All handles from the head's at a route position, m, to the tail's; `links` in m.

    Raises:
        UnboundedError: where one could not be enclosed, or may not be where it follows.
    """
    if not shape.sure:
        raise UnboundedError("some turns of the box may not exist")
    s = shape.box.constant(head)
    handle = Handle(s, shape.pose(s), shape.box.constant(1))
    yield handle
    for link in links:
        handle = _follower(shape, handle, link)
        yield handle


def _follower(shape: TurnShape, front: Handle, link: arb) -> Handle:
    """The handle one link behind another: the nearest place there."""
    s = _behind(shape, front, link)
    pose = shape.pose(s)
    dx, dy = front.pose.x - pose.x, front.pose.y - pose.y
    ahead = dx * front.pose.along + dy * front.pose.across
    behind = dx * pose.along + dy * pose.across
    if not behind.over > 0:
        raise UnboundedError("a bench may stand square to the route")
    _check_nearest(shape, front, s, link)
    return Handle(s, pose, front.ratio * ahead * behind.inverse())


def _behind(shape: TurnShape, front: Handle, link: arb) -> Form:
    """Where one is one link behind, by Newton's method over the box: in its range, and nowhere else."""
    box, middle = shape.box, _behind_in_middle(shape, front, link)
    half = _off(shape, front, link, middle, 0.0)[1] * WIDER
    for _widening in range(WIDENINGS):
        form, far = _off(shape, front, link, middle, half)
        if (middle + arb(0, half)).contains_interior(form.over):
            box.unknown(middle, 0.0)
            return form
        half = max(far, half) * WIDER
        if not half < float(link):
            break
    raise UnboundedError("a handle's range has no end")


def _behind_in_middle(shape: TurnShape, front: Handle, link: arb) -> arb:
    """A route position, m, near that of the handle behind, in the middle of the box."""
    s = (front.s.middle - link).mid()
    for _step in range(STEPS):
        pose = shape.pose(shape.box.unknown(s, 0.0))
        dx, dy = (front.pose[n].middle - pose[n].middle for n in (0, 1))
        apart = (dx * dx + dy * dy).sqrt()
        if abs(apart - link) < NEAR:
            return s
        behind = (dx * pose.along.middle + dy * pose.across.middle) / apart
        s = (s + (apart - link) / behind).mid()
        if not s.is_finite():
            break
    raise UnboundedError("no handle was found in the middle of the box")


def _off(shape: TurnShape, front: Handle, link: arb, middle: arb, half: float) -> tuple[Form, float]:
    """A Newton step from `middle`, all slopes taken within `half`, m; and how far it may lead, m."""
    box, n = shape.box, shape.box.count
    pose = shape.pose(box.unknown(middle, half))
    missed = (front.pose.x - pose.x).square() + (front.pose.y - pose.y).square() - link * link
    slope = missed.slopes[n]
    if not ((slope.is_finite() and slope < 0) or slope > 0):
        raise UnboundedError("a bench may stand square to the route")
    slopes = [ZERO if own is ZERO else -own / slope for own in missed.slopes[:n]]
    at = middle - missed.middle / slope
    over = at
    for own, width in zip(slopes, box.halves, strict=False):
        if own is not ZERO:
            over = over + own * width
    if not over.is_finite():
        raise UnboundedError("a handle's range has no end")
    return Form(box, at, over, (*slopes, ZERO)), float((over - middle).abs_upper())


def _check_nearest(shape: TurnShape, front: Handle, rear: Form, link: arb) -> None:
    """Show that no place between two handles is one link behind the front one.

    Up to a link behind it, along the route, places are nearer. From there on the distance grows, as
    long as the route leads away.
    """
    spare = front.s - rear - link
    if not spare.over.upper() > 0:
        return
    for count in PIECES:
        shares = (shape.box.unknown(arb(2 * i + 1) / (2 * count), 0.5 / count) for i in range(count))
        if all(_leads_away(shape, front, rear + share * spare) for share in shares):
            shape.box.unknown(arb(0), 0.0)
            return
    raise UnboundedError("a handle may have a nearer place")


def _leads_away(shape: TurnShape, front: Handle, s: Form) -> bool:
    pose = shape.pose(s)
    dx, dy = front.pose.x - pose.x, front.pose.y - pose.y
    return bool((dx * pose.along + dy * pose.across).over > 0)
