"""What happens when in a dance: moments as pages show them, and those that a check found."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from benchdragon.analysis.check import in_one_coil
from benchdragon.analysis.findings import named, touch_text
from benchdragon.analysis.records import Answer, ObstacleRecord, Verdict, bracketed
from benchdragon.i18n import N_, _, both
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.frames import QUANTUM
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.cues import Moment, cue_name
from benchdragon.player.messages import Nearest, Occasion, OccasionKind

MOST_JOINTS = 200


def occasion(
    kind: OccasionKind,
    time: float,
    say: Callable[[], str],
    benches: Sequence[int] = (),
    obstacle: int | None = None,
) -> Occasion:
    """Something that happens at a time, s."""
    return Occasion(kind=kind, time=time, text=both(say), benches=list(benches), obstacle=obstacle)


def joints_passed(
    joints: Sequence[float] | FloatArray, times: FloatArray, ends: Sequence[FloatArray] | FloatArray
) -> list[Occasion]:
    """When head and tail pass joints of a route, m; none where there are too many.

    They are at `ends`, m, at increasing times, s. Standing at a joint when the dance begins or ends is
    no passing.
    """
    found: list[Occasion] = []
    tail = N_("the tail passes joint {n} of the route")
    for s, says in zip(ends, (N_("the head passes joint {n} of the route"), tail), strict=True):
        for n, joint in enumerate(joints if len(joints) <= MOST_JOINTS else (), start=1):
            if s[0] + QUANTUM < joint < s[-1] - QUANTUM:
                text = partial(_numbered, says, n)
                found.append(occasion("joint", float(np.interp(joint, s, times)), text))
    return found


def _numbered(says: str, n: int) -> str:
    return _(says).format(n=n)


def ending(time: float) -> Occasion:
    """Why frames end before the end of the walk, at a time, s."""
    return occasion("end", time, lambda: _("from here on the benches cannot follow"))


def cued(moments: Sequence[Moment], start: float, end: float) -> list[Occasion]:
    """The cues of a plan from start to end, s, each with its name."""
    return [
        occasion("cue", one.time, partial(cue_name, one.cue))
        for one in moments
        if start <= one.time <= end
    ]


def occasions_found(
    verdict: Verdict, obstacles: Sequence[Obstacle], margin: float, speed_limit: float | None
) -> list[Occasion]:
    """First contact, tightest moment and fastest moment of a check, and what happens on the square.

    `obstacles`, `margin`, m, and `speed_limit`, m/s, are those of the plan.
    """
    contact, clearance, speed = verdict.first_contact, verdict.clearance, verdict.greatest_speed
    found = []
    if contact is not None and contact.witness is not None:
        text = N_("margin not kept") if _apart(contact) and margin > 0.0 else N_("first contact")
        time = bracketed(contact).value
        found.append(occasion("contact", time, lambda: _(text), contact.witness.benches))
    elif clearance is not None and clearance.witness is not None:
        near, least = clearance.witness, bracketed(clearance)
        gap, says = least.shown(up=False, limit=margin), N_("tightest moment: {gap} m")
        if least.vanishing:
            says = N_("tightest moment: less than {gap} m")
        elif in_one_coil((*near.benches,)):
            says = N_("nearest with one bench between: {gap} m")
        if near.time is not None:
            found.append(occasion("tightest", near.time, lambda: _(says).format(gap=gap), near.benches))
    fast = None if speed is None else speed.witness
    if speed is not None and fast is not None and fast.time is not None:
        most = bracketed(speed).shown(up=True, limit=speed_limit)
        says_most = N_("fastest moment: {speed} m/s")
        found.append(
            occasion("fastest", fast.time, lambda: _(says_most).format(speed=most), fast.benches)
        )
    return found + _on_the_square(verdict.obstacles, obstacles)


def _apart(contact: Answer) -> bool:
    """Whether what comes too near does not touch."""
    gap = None if contact.witness is None else contact.witness.gap
    return gap is not None and gap > 0.0


def _on_the_square(records: Sequence[ObstacleRecord], obstacles: Sequence[Obstacle]) -> list[Occasion]:
    """When benches come too near to obstacles, and touch; the moment nearest to one that is clear."""
    found: list[Occasion] = []
    clear: list[tuple[float, int]] = []
    for n, record in enumerate(records):
        if record.contact is None:
            clear.append((bracketed(record.distance).value - obstacles[n].margin, n))
        else:
            found += _too_near(record, record.contact, obstacles[n], n)
    for _room, n in sorted(clear)[:1]:
        found += _nearest(records[n].distance, obstacles[n], n)
    return found


def _nearest(distance: Answer, obstacle: Obstacle, n: int) -> list[Occasion]:
    """The moment nearest to obstacle number n, which is clear."""
    least, edge = bracketed(distance), obstacle.kind == "venue"
    says = N_("nearest to the edge of {name}: {gap} m") if edge else N_("nearest to {name}: {gap} m")
    if least.vanishing:
        says = N_("nearest to {name}: less than {gap} m")
        if edge:
            says = N_("nearest to the edge of {name}: less than {gap} m")
    gap = least.shown(up=False, limit=obstacle.margin)
    return _at_obstacle(distance, obstacle, n, lambda: _(says).format(name=named(obstacle), gap=gap))


def _too_near(record: ObstacleRecord, contact: Answer, obstacle: Obstacle, n: int) -> list[Occasion]:
    """When a bench comes nearer to obstacle number n than its margin; and when one touches it."""
    found: list[Occasion] = []
    touch, says = contact, N_("margin from {name} not kept")
    if _apart(contact):
        found += _at_obstacle(contact, obstacle, n, lambda: _(says).format(name=named(obstacle)))
        touch = record.distance
    near = touch.witness
    if near is not None and record.distance.value == 0.0:
        bench = near.benches[0]
        found += _at_obstacle(touch, obstacle, n, lambda: touch_text(bench, obstacle))
    return found


def _at_obstacle(answer: Answer, obstacle: Obstacle, n: int, say: Callable[[], str]) -> list[Occasion]:
    """What an answer says of obstacle number n, at the time of its witness; none without one."""
    near = answer.witness
    if near is None or near.time is None:
        return []
    time = bracketed(answer).value if answer.unit == "s" else near.time
    return [occasion("venue" if obstacle.kind == "venue" else "obstacle", time, say, near.benches, n)]


def tighten(nearest: Nearest, clearance: Answer | None, start: float, end: float) -> None:
    """Put in the tightest pair as a check found it, which looks closer, if it is in the span, s."""
    near = None if clearance is None else clearance.witness
    if clearance is None or clearance.value is None or near is None or near.time is None:
        return
    if not start <= near.time <= end:
        return
    a, b = near.benches
    for bench, other in ((a, b), (b, a)):
        seen = nearest.distance[bench - 1] if nearest.other[bench - 1] else nearest.reach
        if clearance.value < seen:
            nearest.distance[bench - 1] = round(clearance.value, 5)
            nearest.time[bench - 1] = round(near.time, 4)
            nearest.other[bench - 1] = other
