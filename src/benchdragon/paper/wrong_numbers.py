"""Numbers that known mistakes lead to: each mistake is made, and what it answers is computed."""

import math
from collections.abc import Callable, Iterator
from functools import cache

import numpy as np

from benchdragon.analysis.distance import pair_distances
from benchdragon.i18n import _
from benchdragon.model.turns import TwoArcTurn
from benchdragon.model.walk import Walk
from benchdragon.paper.traversal import first_overlap
from benchdragon.plans.schema import Plan, read_plan

# Steps in which contact, and pitches, are mostly sought, s and m; of the head's angle, rad.
TIME_STEPS = (10.0, 5.0, 4.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.01)
DISC_STEPS, PITCH_STEPS, ANGLE_STEPS = (1e-2, 1e-3, 1e-4), (2e-3, 5e-5), (0.1, 0.01)
# Times sampled on the whole way in, s; angles near the disc, rad, and how far back from it they go.
SEEN_EACH, SEEN_ANGLE, LAST_ANGLES = (10.0, 1.0), 0.02, 2.0
# Pitches between which a flag is bisected, m, how often, and benches that can touch there.
PITCHES, HALVINGS, NEAR = (0.40, 0.50), 34, 60
# Steps in which speeds are sampled, s; when handle 1 is at its fastest, s.
SPEED_STEPS, HANDLE_1 = (1.0, 0.1), (14.0, 15.0, 0.0005)

# What a known mistake leads to, and the mistake in words.
Wrong = tuple[float, str]


def contacts(exact: float) -> Iterator[Wrong]:
    """Times of first contact, s."""
    text = _("it is the first moment after it in steps of {step} s: what lies between two was not seen")
    for step in TIME_STEPS:
        yield math.ceil(exact / step) * step, text.format(step=f"{step:g}")
    plan = read_plan("spiral-in")
    walk = plan.build()
    yield plan.span(walk)[1], _("the walk ends then: the test for contact never fires")
    text = _("it is the first moment after it in steps of {step} rad of the head's angle")
    k = plan.value("route.pitch") / (2.0 * math.pi)
    angle = float(np.hypot(*walk.route.point(walk.head_position([exact])[0]))) / k
    for step in ANGLE_STEPS:
        later = math.floor(angle / step) * step
        yield exact + _along(k, angle) - _along(k, later), text.format(step=f"{step:g}")


def _along(k: float, angle: float) -> float:
    """How long the spiral r = k angle is from its centre on, m."""
    return 0.5 * k * (angle * math.hypot(1.0, angle) + math.asinh(angle))


def pitches(exact: float) -> Iterator[Wrong]:
    """Smallest pitches, m."""
    text = _("contact was checked only when the head reaches the disc")
    at_disc = _bisected(_touches_at_the_disc)
    for size in (at_disc, *(math.ceil(at_disc / step) * step for step in DISC_STEPS)):
        yield size, text
    text = _("contact was checked only when the head reaches the disc, and only of the head's bench")
    yield _bisected(_head_touches_at_the_disc), text
    text = _("contact was checked only each {step} s")
    for step in SEEN_EACH:
        yield _bisected(_touches_each(step)), text.format(step=f"{step:g}")
    text = _("contact was checked only each {step} rad of the head's angle")
    yield _bisected(_touches_at_angles), text.format(step=f"{SEEN_ANGLE:g}")
    text = _("it is the first pitch that is safe in steps of {step} m")
    for step in PITCH_STEPS:
        yield math.ceil(exact / step) * step, text.format(step=f"{step:.5f}".rstrip("0"))


@cache
def _bisected(touches: Callable[[float], bool]) -> float:
    """The pitch at which a flag falls, m, if it falls once."""
    low, high = PITCHES
    for _step in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if touches(middle) else (low, middle)
    return high


def _way_in(pitch: float) -> tuple[Walk, float]:
    """The first benches of the contest's dragon on a spiral, and when its head reaches the disc, s."""
    plan = read_plan("question-3", {"route.pitch": pitch, "dragon.benches": NEAR})
    walk = plan.build()
    return walk, plan.span(walk)[1]


def _touches_at_the_disc(pitch: float) -> bool:
    walk, end = _way_in(pitch)
    return first_overlap(walk, np.array([end])) is not None


def _head_touches_at_the_disc(pitch: float) -> bool:
    walk, end = _way_in(pitch)
    placed = walk.motion(end)
    return any(pair_distances(placed, 0, other)[0] < 0.0 for other in range(2, NEAR))


@cache
def _touches_each(step: float) -> Callable[[float], bool]:
    def touches(pitch: float) -> bool:
        walk, end = _way_in(pitch)
        return first_overlap(walk, np.append(np.arange(0.0, end, step), end)[::-1]) is not None

    return touches


def _touches_at_angles(pitch: float) -> bool:
    walk, end = _way_in(pitch)
    k, disc = pitch / (2.0 * math.pi), read_plan("question-3").value("disc.radius")
    angles = np.arange(LAST_ANGLES, 0.0, -SEEN_ANGLE) + disc / k
    before = np.array([_along(k, angle) for angle in angles]) - _along(k, disc / k)
    return first_overlap(walk, np.append(end - before, end)) is not None


def lengths(_exact: float) -> Iterator[Wrong]:
    """Lengths of turns, m."""
    plan = read_plan("turn")
    yield 2.0 * plan.value("disc.radius"), _("it is the straight way across the disc")
    text = _(
        "the joints were moved inwards until the head's bench just fits the tighter arc, with radii of "
        "{ratio} : 1; neither contact nor the way from the disc to the joints was counted"
    )
    for ratio in (2.0, 1.0):
        yield _tightest(plan, ratio).length, text.format(ratio=f"{ratio:g}")


def _tightest(plan: Plan, ratio: float) -> TwoArcTurn:
    """The turn whose smaller arc is as wide as the head's link is long."""
    link, pitch = float(plan.build().dragon.links[0]), plan.value("route.pitch")
    low, high = 1.0, plan.value("disc.radius")
    for _step in range(HALVINGS):
        middle = 0.5 * (low + high)
        fits = 2.0 * TwoArcTurn(pitch, middle, ratio).radii[1] >= link
        low, high = (low, middle) if fits else (middle, high)
    return TwoArcTurn(pitch, high, ratio)


def speeds(_exact: float) -> Iterator[Wrong]:
    """Greatest head speeds, m/s."""
    plan = read_plan("turn")
    limit = plan.value("limits.speed")
    for step in SPEED_STEPS:
        seen = plan.motion(np.arange(*plan.span(plan.build()), step)).speed.max()
        text = _("speeds were evaluated in steps of {step} s: the peak lies between two of them")
        yield limit / float(seen), text.format(step=f"{step:g}")
    text = _("only handle 1 was looked at: handles behind it are faster")
    yield limit / float(plan.motion(np.arange(*HANDLE_1)).speed[:, 1].max()), text
    yield limit, _("it is the limit itself: handles behind the head are faster than it in the turn")
