"""Whether a walk is safe: first contact, least clearance, speeds and accelerations against limits."""

import math
import time as clock
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from benchdragon import budget
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.contact import (
    ClearanceCurve,
    clearance_curve,
    first_sure_contact,
    least_clearance,
    seen_clearance,
)
from benchdragon.analysis.findings import Finding, all_findings, named
from benchdragon.analysis.left_open import PROOFS, Unproved, speed_at_start, told_if_open
from benchdragon.analysis.not_looked_at import NotLookedAt, not_looked_at
from benchdragon.analysis.obstacles import ObstacleAnswers, obstacle_answers
from benchdragon.analysis.proof import Claim, prove_contact, prove_obstacle
from benchdragon.analysis.room import ASKED, RoomLevel, levels_asked, room_levels, shown_name
from benchdragon.analysis.speed import (
    QUANTITIES,
    RATE_TOLERANCE,
    given_limits,
    greatest,
    greatest_speed,
)
from benchdragon.analysis.speed_proof import SpeedClaim
from benchdragon.analysis.stops import Stop, stops_of
from benchdragon.analysis.unfinished import Unfinished, unfinished
from benchdragon.errors import InputError, of_kind
from benchdragon.i18n import N_, _
from benchdragon.methods import Method
from benchdragon.model.answer import ROUNDING, Answer
from benchdragon.model.walk import Motion, Walk
from benchdragon.number_format import seconds
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, Stage, silent, stages

if TYPE_CHECKING:
    from benchdragon.figures import plots

# Samples of the clearance drawn, those of the last share of the time, where benches come nearest, and
# seconds shown after a contact.
SAMPLES = 1000
LAST_SHARE, LAST_SAMPLES = 0.04, 300
AFTER = 3.0
# Benches so far apart in the line have one between them: they belong to one coil.
AFTER_NEXT = 2


@dataclass(frozen=True)
class Report:
    """The result of a check.

    Attributes:
        plan: the plan that was checked.
        walk: that of the plan.
        start: of the walk, s.
        end: of the walk, s; the answers but the first speak of it up to a contact, if there is one.
        first_contact: when two non-adjacent benches first touch, or come nearer than the margin.
        clearance: the least that they keep, m; 0 where they touch.
        greatest_speed: of any handle, m/s.
        peaks: the greatest of what else is limited, by the names of the limits, in SI units.
        obstacles: what was found about the venue's edge and each obstacle, until then too.
        room: whether sway, imprecision and people have room, level upon level; empty where the plan
            asks for none.
        findings: empty if the walk is safe.
        proved: whether the answers about contact were proved.
        seconds: how long the check took.
        claims: what was proved of benches alone, and of obstacles, to be shown again.
        speeds: what was proved of speeds, to be shown again (see `prove_report`).
        unproved: the answers whose proof failed, and why.
        not_looked_at: what the check did not consider because the plan does not give it.
        unfinished: what the walk lacks where it ends before the tail is out of the turn; else None.

    Examples:
        >>> report = bd.read_plan("turn", {"dragon.benches": 30, "walk.end": 40.0}).check()
        >>> report.safe, [one.code for one in report.findings]
        (True, [])
        >>> round(report.greatest_speed.value, 6)
        1.604793
    """

    plan: Plan
    walk: Walk
    start: float
    end: float
    first_contact: Answer | None
    clearance: Answer
    greatest_speed: Answer
    peaks: dict[str, Answer]
    findings: tuple[Finding, ...]
    obstacles: tuple[ObstacleAnswers, ...] = ()
    room: tuple[RoomLevel, ...] = ()
    proved: bool = False
    seconds: float = 0.0
    claims: tuple[Claim, ...] = ()
    speeds: tuple[SpeedClaim, ...] = ()
    unproved: tuple[Unproved, ...] = ()
    unfinished: Unfinished | None = None
    not_looked_at: tuple[NotLookedAt, ...] = ()

    plot = plots.plot_report if TYPE_CHECKING else Method("plot_report")
    _repr_html_ = Method("as_html")

    def __repr__(self) -> str:
        told = "safe" if self.safe else "not safe" if self.decided else "undecided"
        return f"<Report of {self.plan!r}: {told}, {len(self.findings)} findings>"

    def __str__(self) -> str:
        """The verdict in one sentence, in the language in use."""
        return sentence(self)

    @property
    def safe(self) -> bool:
        """Whether there are no findings; an undecided question counts as a finding."""
        return not self.findings

    @property
    def stops(self) -> tuple[Stop, ...] | None:
        """When the head stands in the dance; None for a plan without cues."""
        return stops_of(self.walk, self.start, self.end) if self.plan.cues.cue else None

    @property
    def decided(self) -> bool:
        """Whether no undecided question could change `safe`."""
        return not self.findings or any(finding.decided for finding in self.findings)


@budget.question()
def check(plan: Plan, progress: Progress = silent, *, prove: bool = False) -> Report:
    """Check the whole walk of a plan against its margin and its limits.

    With `prove` it is proved when the first contact comes, or that none does (see `prove_contact`);
    where two benches come within rounding of the margin first, nothing is.
    `progress` is called with the share done: see `benchdragon.progress`.

    Raises:
        InputError: if `plan` is not a Plan.
        MissingExtraError: for a proof without python-flint.
        WalkError: if no contact comes before the dragon cannot walk on.
        UnsureError: if it could not be decided whether it can.

    Examples:
        >>> report = bd.check(bd.read_plan("spiral-in", {"disc.radius": 4.5, "dragon.benches": 40}))
        >>> report.safe, str(report)[:24]
        (True, 'Safe: tightest 0.099 m, ')
    """
    of_kind("plan", plan, Plan)
    walk = plan.build()
    return checked(plan, walk, plan.span(walk), progress, Prover(plan) if prove else None)


@dataclass(frozen=True)
class Prover:
    """Proves what a check of a plan finds, and keeps what it claims."""

    plan: Plan
    claims: list[Claim] = field(default_factory=list)

    def contact(
        self, walk: Walk, start: float, end: float, margin: float, progress: Progress
    ) -> Answer | None:
        """A first contact: see `prove_contact`."""
        told, plan = self.claims, self.plan
        return prove_contact(walk, start, end, margin=margin, progress=progress, claims=told, plan=plan)

    def obstacle(
        self, walk: Walk, answers: ObstacleAnswers, start: float, end: float
    ) -> ObstacleAnswers:
        """What was found about an obstacle: see `prove_obstacle`."""
        return prove_obstacle(walk, answers, start, end, claims=self.claims, plan=self.plan)


def checked(
    plan: Plan, walk: Walk, span: tuple[float, float], progress: Progress = silent,
    prover: Prover | None = None,
) -> Report:  # fmt: skip
    """The check of the walk that a plan describes, over its span, s: see `check`."""
    began = clock.perf_counter()
    (start, end), asked = span, levels_asked(plan.people)
    stage = stages(progress, 6 if asked else 5)
    contact, clearance = _nearness(plan, walk, span, stage, prover)
    until = end if contact is None or contact.witness is None else contact.upper
    left: list[Finding] = []
    speed = _greatest_speed(plan, walk, (start, until), stage(_("greatest speed")))
    peaks = _limited_peaks(plan, walk, (start, until), left, stage(_("other limits")))
    told = stage(_("obstacles"))
    obstacles = _obstacles(plan, walk, (start, until), prover, left, told)
    room: list[RoomLevel] = []
    if asked:
        told = stage(_("room for people"))
        with told_if_open(left, asked[-1]):
            room_levels(plan, walk, span, (contact, obstacles), room, progress=told, prove=bool(prover))
    contacts = [contact, *(answers.contact for answers in obstacles)]
    contacts += [one and one[0] for one in (level.first for level in room)]
    proved = prover is not None and not left
    limited = {"speed": speed, **peaks}
    found = all_findings(plan, walk, (start, until), contact, obstacles, limited, room)
    return Report(
        plan, walk, start, end, contact, clearance, speed, peaks,
        findings=(*found, *left),
        obstacles=obstacles,
        room=tuple(room),
        proved=proved and all(one is None or one.status == "proved" for one in contacts),
        seconds=clock.perf_counter() - began,
        claims=() if prover is None else tuple(prover.claims),
        unfinished=unfinished(plan, walk, end),
        not_looked_at=not_looked_at(plan, walk, start, end),
    )  # fmt: skip


def _nearness(
    plan: Plan, walk: Walk, span: tuple[float, float], stage: Stage, prover: Prover | None
) -> tuple[Answer | None, Answer]:
    """The first contact, and the least clearance until then."""
    (start, end), margin = span, plan.limits.margin
    told = stage(_("searching for contact"))
    search = None if prover is None else prover.contact
    contact = first_sure_contact(walk, start, end, margin=margin, search=search, progress=told)
    if (touching := _no_clearance(contact)) is not None:
        return contact, touching
    last = end if contact is None or contact.witness is None else contact.upper
    told = stage(_("clearance"))
    with told_if_open([]):
        return contact, least_clearance(walk, start, last, progress=told)
    return contact, seen_clearance(walk, start, last, margin if contact is None else 0.0)


def _no_clearance(contact: Answer | None) -> Answer | None:
    """The least clearance where benches surely touch: none; None where they do not."""
    if contact is None or contact.witness is None or contact.witness.gap > 0.0:
        return None
    if contact.status == "undecided":
        return None
    return replace(contact, value=0.0, lower=0.0, upper=0.0, unit="m")


def _obstacles(
    plan: Plan, walk: Walk, span: tuple[float, float], prover: Prover | None, left: list[Finding],
    progress: Progress,
) -> tuple[ObstacleAnswers, ...]:  # fmt: skip
    """The answers about the venue's edge and each obstacle over a span of the walk, s."""
    found, known = [], plan.obstacles()
    for n, obstacle in enumerate(known):
        progress(n / len(known), named(obstacle))
        with told_if_open(left, obstacle):
            answers = obstacle_answers(walk, obstacle, *span)
            if prover is not None:
                answers = prover.obstacle(walk, answers, *span)
            found.append(answers)
    return tuple(found)


def _greatest_speed(plan: Plan, walk: Walk, span: tuple[float, float], progress: Progress) -> Answer:
    """The greatest speed over a span of the walk, s, asked again where its bracket holds a limit."""
    start, end = span
    with told_if_open([]):
        speed = greatest_speed(walk, start, end, progress=progress)
        for limit in (plan.limits.speed, plan.people.most_speed):
            if limit is not None and speed.keeps(limit) is None:
                most = limit * (1.0 + ROUNDING)
                speed = greatest(walk, QUANTITIES["speed"], start, end, limit=most)
        return speed
    return speed_at_start(walk, start)


def _limited_peaks(
    plan: Plan, walk: Walk, span: tuple[float, float], left: list[Finding], progress: Progress,
) -> dict[str, Answer]:  # fmt: skip
    """The greatest of each limited quantity but speed, bracketed as closely as its limit requires."""
    limits = {name: limit for name, limit in given_limits(plan).items() if name != "speed"}
    peaks, (start, end) = {}, span
    for n, (name, limit) in enumerate(limits.items()):
        with told_if_open(left, name, limit):
            peaks[name] = greatest(
                walk, QUANTITIES[name], start, end, tolerance=RATE_TOLERANCE,
                limit=limit * (1.0 + ROUNDING),
            )  # fmt: skip
        progress((n + 1) / len(limits), "")
    return peaks


def peak_text(name: str) -> str:
    """The name of the greatest value of a limited quantity, in the language in use."""
    return _("greatest {what}").format(what=_(QUANTITIES[name].text))


def sentence(report: Report, told: Clock | None = None) -> str:
    """A verdict in one sentence, in the language in use.

    With a clock, as on papers, a safe walk is described in clock times and the village's names of
    benches; otherwise in seconds of the plan, with bench numbers.
    """
    if report.safe:
        return _("Safe: {tightest}").format(tightest=kept(report, told))
    text = _briefly(min(report.findings, key=_soonest))
    count = len(report.findings)
    if count > 1:
        text = _("{finding} (one of {count} findings)").format(finding=text, count=count)
    if not report.decided:
        return _("Undecided: {finding}").format(finding=text)
    return _("Not safe: {finding}").format(finding=text)


# Findings about benches and obstacles, in few words.
BRIEF = {
    "contact": N_("benches {a} and {b} touch at {t} s"),
    "margin": N_("benches {a} and {b} come nearer than the {margin} m asked for at {t} s"),
    "obstacle": N_("bench {a} touches {name} at {t} s"),
    "obstacle_margin": N_("bench {a} comes nearer than {margin} m to {name} at {t} s"),
    "venue": N_("bench {a} leaves {name} at {t} s"),
    "venue_margin": N_("bench {a} comes nearer than {margin} m to the edge of {name} at {t} s"),
    "sway": N_("benches {a} and {b} have no room to sway at {t} s"),
    "imprecision": N_("benches {a} and {b} have no room for imprecision at {t} s"),
    "people": N_("the people of benches {a} and {b} have no room at {t} s"),
}


def _soonest(found: Finding) -> tuple[bool, bool, float]:
    """The finding to report first: decided before undecided, then contact, then the earliest."""
    time = math.inf if found.time is None else found.time
    touch = found.kind in BRIEF
    return not found.decided, not touch, time if touch else 0.0


def _briefly(found: Finding) -> str:
    """A finding in few words, in the language in use."""
    if found.kind not in BRIEF or not found.decided or found.time is None:
        return found.text
    if found.kind in ASKED and found.obstacle:
        return found.text
    return _(BRIEF[found.kind]).format(
        a=found.benches[0],
        b=found.benches[-1],
        t=seconds(found.time),
        margin=f"{found.limit:g}",
        name=found.said("name") if "name" in found.words else "",
    )


def kept(report: Report, told: Clock | None = None) -> str:
    """A safe walk's least clearance and greatest speed, each beside its limit."""
    near, limits = report.clearance.witness, report.plan.limits
    said = [_("no two benches come near one another")]
    if near is not None and near.time is not None and len(near.benches) == 2:
        said = [_tightest(report, near.time, near.benches, told)]
    if limits.margin:
        said.append(_("{margin} m were asked for").format(margin=f"{limits.margin:g}"))
    said += _kept_from(report)
    if report.room:
        text = _("room is kept {levels}")
        said.append(text.format(levels=_(", ").join(shown_name(one) for one in report.room[1:])))
    if limits.speed is not None:
        text = _("fastest handle {speed} m/s of {limit} m/s allowed")
        said.append(text.format(speed=speed_text(report), limit=f"{limits.speed:g}"))
    for name in report.peaks:
        quantity = QUANTITIES[name]
        said.append(
            _("{what} at most {most} {unit} of {limit} {unit} allowed").format(
                what=_(quantity.text),
                most=peak_shown(report, name),
                limit=f"{given_limits(report.plan)[name]:g}",
                unit=quantity.unit,
            )
        )
    if report.unfinished is not None:
        said.append(report.unfinished.text if told is None else report.unfinished.told)
    if report.unproved:
        what = _(", ").join(_(PROOFS[one.kind]) for one in report.unproved)
        said.append(_("not proved: {what}").format(what=what))
    if report.not_looked_at:
        what = _(", ").join(one.brief for one in report.not_looked_at)
        said.append(_("not checked: {what}").format(what=what))
    return _("; ").join(said)


def _tightest(report: Report, time: float, benches: tuple[int, ...], told: Clock | None) -> str:
    """The tightest moment of a safe walk; within one coil the bends alone set the distance."""
    (a, b), gap, hidden = benches, clearance_text(report), report.clearance.vanishing
    if in_one_coil(benches) and not hidden:
        text = _("none come nearer than two with one between them, which keep {gap} m in the bends")
        return text.format(gap=gap)
    if told is None:
        text = _("tightest {gap} m, bench {a} with bench {b}, at {t} s")
        if hidden:
            text = _("tightest less than {gap} m, bench {a} with bench {b}, at {t} s")
        return text.format(gap=gap, a=a, b=b, t=seconds(time))
    text = _("tightest {gap} m, {a} with {b}, at {t}")
    if hidden:
        text = _("tightest less than {gap} m, {a} with {b}, at {t}")
    names = [called(report.plan.people, one, len(report.walk.dragon)) for one in benches]
    return text.format(gap=gap, a=names[0], b=names[1], t=told.tell(time))


def in_one_coil(benches: tuple[int, ...]) -> bool:
    """Whether two benches have one between them: no plan but that of the benches keeps them apart."""
    return len(benches) == 2 and abs(benches[0] - benches[1]) == AFTER_NEXT


def clearance_text(report: Report) -> str:
    """The least clearance, m, formatted as in all texts."""
    return report.clearance.shown(up=False, limit=report.plan.limits.margin)


def speed_text(report: Report) -> str:
    """The greatest speed of a handle, m/s, formatted as in all texts."""
    return report.greatest_speed.shown(up=True, limit=report.plan.limits.speed)


def peak_shown(report: Report, name: str) -> str:
    """The greatest value of a limited quantity, in its SI unit, formatted as in all texts."""
    return report.peaks[name].shown(up=True, limit=given_limits(report.plan)[name])


def _kept_from(report: Report) -> list[str]:
    """The least distances from the venue's edge, and from the obstacle with the least room."""
    venue = [one for one in report.obstacles if one.obstacle.kind == "venue"]
    stands = [one for one in report.obstacles if one.obstacle.kind != "venue"]
    near = sorted(stands, key=lambda one: one.distance.sure(up=False) - one.obstacle.margin)[:1]
    said = []
    for one in (*venue, *near):
        text = _("at least {gap} m from {name}")
        if one in venue:
            text = _("at least {gap} m from the edge of {name}")
        elif len(stands) > 1:
            text = _("at least {gap} m from {name}, the narrowest of {count} obstacles")
        if one.distance.vanishing:
            text = _("less than {gap} m from {name}")
            if one in venue:
                text = _("less than {gap} m from the edge of {name}")
        kept = text.format(
            gap=one.distance.shown(up=False, limit=one.obstacle.margin),
            name=named(one.obstacle),
            count=len(stands),
        )
        if one.obstacle.margin:
            asked = f"{one.obstacle.margin:g}"
            kept = _("{kept} ({margin} m asked for)").format(kept=kept, margin=asked)
        said.append(kept)
    return said


def moment(report: Report) -> tuple[Motion, Answer]:
    """The dragon at its first contact of any kind, or where it is tightest; and the answer of that.

    Raises:
        InputError: for a dragon without pairs that count, and without obstacles that it touches.
    """
    contacts = [report.first_contact, *(answers.contact for answers in report.obstacles)]
    known = [one for one in contacts if one is not None and one.witness is not None]
    answer = min(known, key=lambda one: one.value, default=report.clearance)
    if answer.witness is None or answer.witness.time is None:
        raise InputError(_("a dragon of one or two benches has no pair whose clearance counts"))
    time = answer.value if known else answer.witness.time
    return report.walk.motion([time]), answer


def clearance_over(report: Report) -> ClearanceCurve:
    """Clearance over the whole walk, or until shortly after a contact."""
    walk, end = report.walk, report.end
    contact = report.first_contact
    if contact is not None:
        end = min(end, contact.upper + AFTER)
    late = end - LAST_SHARE * (end - report.start)
    before = np.linspace(report.start, late, SAMPLES, endpoint=False)
    times = np.concatenate([before, np.linspace(late, end, LAST_SAMPLES)])
    while walk.motion(times, throw=False).status.any():  # the walk falls shortly after the contact
        times = times[:-1]
    return clearance_curve(walk, times)
