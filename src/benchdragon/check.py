"""Whether a walk is safe: first contact, least clearance and greatest speed against their limits."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from benchdragon.answer import Answer
from benchdragon.contact import (
    ClearanceCurve,
    clearance_curve,
    contact_windows,
    first_contact,
    least_clearance,
)
from benchdragon.errors import InputError
from benchdragon.messages import N_, _
from benchdragon.motion import Motion, Walk
from benchdragon.pace import given_limits
from benchdragon.plan import Plan
from benchdragon.prove import prove_contact
from benchdragon.speeds import QUANTITIES, greatest_of, greatest_speed, part_of

Advance = Callable[[float, str], None]

# Width of the brackets of accelerations and turning rates, relative.
RATE_TOLERANCE = 1e-6
# Grazes that a check looks past for a sure contact.
MOST_GRAZES = 100
# Samples of the clearance drawn, and seconds shown after a contact.
SAMPLES = 1000
AFTER = 3.0
# How often a check advances by 1.
STEPS = 3


@dataclass(frozen=True)
class Finding:
    """Something that a walk must not do, or that could not be decided.

    Attributes:
        code: "contact", "margin", "speed", "acceleration", "turning_rate" or "undecided".
        time: when, s.
        benches: which.
        value: what came out, m, m/s, m/s^2 or rad/s.
        limit: what was to be kept.
        sentence: the same in words, to be translated, with places for `words`, translated too.
        words: see `sentence`.
    """

    code: str
    time: float | None
    benches: tuple[int, ...]
    value: float
    limit: float
    sentence: str
    words: dict[str, str]

    @property
    def text(self) -> str:
        """The finding as a sentence, in the language in use."""
        return _(self.sentence).format(**{name: _(word) for name, word in self.words.items()})

    def as_json(self) -> dict[str, Any]:
        """The finding as plain data, its text in the language in use."""
        names = ("code", "text", "time", "benches", "value", "limit")
        return {name: getattr(self, name) for name in names}


@dataclass(frozen=True)
class Report:
    """What a check found.

    Attributes:
        plan: what was checked.
        start: of the walk, s.
        end: of the walk, s; the answers but the first speak of it up to a contact, if there is one.
        first_contact: when two benches but neighbours first touch, or come nearer than the margin.
        clearance: the least distance that they keep, m; 0 where they touch.
        greatest_speed: of any handle, m/s.
        findings: empty if the walk is safe.
        proved: whether what is said of contact was proved.
    """

    plan: Plan
    start: float
    end: float
    first_contact: Answer | None
    clearance: Answer
    greatest_speed: Answer
    findings: tuple[Finding, ...]
    proved: bool = False

    @property
    def safe(self) -> bool:
        """Whether nothing was found; a question left open counts as found."""
        return not self.findings

    @property
    def decided(self) -> bool:
        """Whether no question was left open that could change `safe`."""
        codes = {finding.code for finding in self.findings}
        return codes != {"undecided"}


def check(plan: Plan, advance: Advance | None = None, *, prove: bool = False) -> Report:
    """Check the whole walk of a plan against its margin and its limit of speed.

    With `prove` it is proved when the first contact comes, or that none does (see `prove`).

    Raises:
        MissingExtraError: for a proof without python-flint.
        WalkError: if no contact comes before the dragon cannot walk on.
        UnsureError: if it could not be decided whether it can.
    """
    tell = advance or (lambda _share, _text: None)
    walk = plan.build()
    start, end = plan.span(walk)
    margin = plan.limits.margin
    tell(0.0, _("looking for contact"))
    search = prove_contact if prove else first_contact
    contact = search(walk, start, end, margin=margin, advance=part_of(tell, _("contact")))
    contact = sure_contact(walk, start, end, margin, contact)
    until = end if contact is None or contact.witness is None else contact.upper
    clearance = no_clearance(contact)
    if clearance is None:
        clearance = least_clearance(walk, start, until, advance=part_of(tell, _("clearance")))
    speed = greatest_speed(walk, start, until, advance=part_of(tell, _("greatest speed")))
    findings = all_findings(plan, walk, (start, until), contact, speed)
    return Report(plan, start, end, contact, clearance, speed, findings, proved=prove)


def sure_contact(
    walk: Walk, start: float, end: float, margin: float, first: Answer | None
) -> Answer | None:
    """The first contact, or if that is a graze one that is none, if there is one."""
    if first is None or first.status != "undecided":
        return first
    windows = contact_windows(walk, start, end, margin=margin, most=MOST_GRAZES)
    return next((window.opens for window in windows if window.opens.status == "found"), first)


def no_clearance(contact: Answer | None) -> Answer | None:
    """The least clearance where benches touch: none; None where they do not."""
    if contact is None or contact.witness is None or contact.witness.gap > 0.0:
        return None
    return replace(contact, value=0.0, lower=0.0, upper=0.0, unit="m")


def all_findings(
    plan: Plan, walk: Walk, span: tuple[float, float], contact: Answer | None, speed: Answer
) -> tuple[Finding, ...]:
    """What a walk does that its plan forbids, from the first time of the span, s, to the second.

    Raises:
        InputError: for a limit of acceleration or turning rate on a head whose speed changes.
    """
    return (
        *_contact_findings(contact, plan.limits.margin),
        *_speed_findings(speed, plan.limits.speed),
        *_rate_findings(plan, walk, *span),
    )


def _contact_findings(contact: Answer | None, margin: float) -> list[Finding]:
    if contact is None or contact.witness is None:
        return []
    near = contact.witness
    code = "undecided" if contact.status == "undecided" else "contact" if near.gap <= 0.0 else "margin"
    sentence = {
        "contact": N_("benches {a} and {b} touch at t = {t} s"),
        "margin": N_("benches {a} and {b} come nearer than {margin} m at t = {t} s"),
        "undecided": N_(
            "benches {a} and {b} come to {margin} m of one another at t = {t} s, too exactly to tell "
            "on which side"
        ),
    }[code]
    a, b = near.benches
    words = {"a": str(a), "b": str(b), "t": f"{contact.value:.6f}", "margin": f"{margin:g}"}
    return [Finding(code, contact.value, near.benches, max(near.gap, 0.0), margin, sentence, words)]


def _rate_findings(plan: Plan, walk: Walk, start: float, until: float) -> list[Finding]:
    """Limits of acceleration and turning rate that are exceeded, or could not be decided.

    Raises:
        InputError: for such a limit on a head whose speed changes.
    """
    limits = {name: limit for name, limit in given_limits(plan).items() if name != "speed"}
    if limits and len(walk.profile.speeds) > 1:
        raise InputError(
            _("limits.acceleration and limits.turning_rate are checked for a steady head alone")
        )
    head, findings = walk.profile.speeds[0], []
    first, last = walk.head_position([start, until]).tolist()
    for name, limit in limits.items():
        quantity = QUANTITIES[name]
        peak = greatest_of(walk, quantity, first, last, tolerance=RATE_TOLERANCE)
        value, upper = (size * head**quantity.power for size in (peak.value, peak.upper))
        if upper <= limit:
            continue
        sentence = N_(
            "{what} at bench {bench} is {value} {unit} at t = {t} s, the limit being {limit} {unit}"
        )
        if value <= limit:
            sentence = N_(
                "whether the {what} keeps to {limit} {unit} is undecided: {value} {unit} was seen"
            )
        bench, time = min(peak.row + 1, len(walk.dragon)), walk.profile.time(peak.s - walk.start)
        words = {
            "what": quantity.text, "bench": str(bench), "value": f"{value:.6g}",
            "limit": f"{limit:.6g}", "unit": quantity.unit, "t": f"{time:.6f}",
        }  # fmt: skip
        code = name if value > limit else "undecided"
        findings.append(Finding(code, time, (bench,), value, limit, sentence, words))
    return findings


def _speed_findings(speed: Answer, limit: float | None) -> list[Finding]:
    if limit is None or speed.upper <= limit or speed.witness is None:
        return []
    sure = speed.lower > limit
    sentence = N_(
        "a handle of bench {bench} walks at {speed} m/s at t = {t} s, the limit being {limit} m/s"
    )
    if not sure:
        sentence = N_("whether every handle keeps to {limit} m/s is undecided: {speed} m/s was seen")
    near = speed.witness
    words = {
        "bench": str(near.benches[0]),
        "speed": f"{speed.value:.6f}",
        "limit": f"{limit:g}",
        "t": "-" if near.time is None or math.isinf(near.time) else f"{near.time:.6f}",
    }
    code = "speed" if sure else "undecided"
    return [Finding(code, near.time, near.benches, speed.value, limit, sentence, words)]


def sentence(report: Report) -> str:
    """A verdict in one sentence, in the language in use."""
    if report.safe:
        return _("Walkable: {tightest}").format(tightest=_kept(report))
    first = report.findings[0]
    text = first.text
    if first.code in {"contact", "margin"} and first.time is not None:
        text = _("benches {a} and {b} touch at {t} s")
        if first.code == "margin":
            text = _("benches {a} and {b} come nearer than the {margin} cm asked for at {t} s")
        a, b = first.benches
        text = text.format(a=a, b=b, t=f"{first.time:.1f}", margin=f"{100.0 * first.limit:g}")
    more = len(report.findings) - 1
    if more:
        text = _("{finding}; findings besides: {count}").format(finding=text, count=more)
    if not report.decided:
        return _("Undecided: {finding}").format(finding=text)
    return _("Not walkable: {finding}").format(finding=text)


def _kept(report: Report) -> str:
    """What a safe walk keeps: the tightest place, and margin and speed beside what was asked for."""
    near, limits = report.clearance.witness, report.plan.limits
    said = [_("no two benches come near one another")]
    if near is not None and near.time is not None and len(near.benches) == 2:
        said = [
            _("tightest {gap} cm, bench {a} with bench {b}, at {t} s").format(
                gap=f"{100.0 * report.clearance.value:.3g}",
                a=near.benches[0],
                b=near.benches[1],
                t=f"{near.time:.1f}",
            )
        ]
    if limits.margin:
        said.append(_("{margin} cm were asked for").format(margin=f"{100.0 * limits.margin:g}"))
    if limits.speed is not None:
        said.append(
            _("fastest handle {speed} m/s of {limit} m/s allowed").format(
                speed=f"{report.greatest_speed.value:.3g}", limit=f"{limits.speed:g}"
            )
        )
    return _("; ").join(said)


def moment(report: Report) -> tuple[Motion, Answer]:
    """The dragon at first contact, or where the walk is tightest; and the answer that says so.

    Raises:
        InputError: for a dragon without pairs that count.
    """
    contact = report.first_contact
    answer = report.clearance if contact is None else contact
    if answer.witness is None or answer.witness.time is None:
        raise InputError(_("a dragon of one or two benches has no pair whose clearance counts"))
    walk = report.plan.build()
    time = answer.witness.time if contact is None else contact.value
    return walk.motion([time]), answer


def clearance_over(report: Report) -> ClearanceCurve:
    """Clearance over the whole walk, or until shortly after a contact."""
    walk, end = report.plan.build(), report.end
    contact = report.first_contact
    if contact is not None:
        end = min(end, contact.upper + AFTER)
    times = np.linspace(report.start, end, SAMPLES)
    while walk.motion(times, throw=False).status.any():  # the walk falls shortly after the contact
        times = times[:-1]
    return clearance_curve(walk, times)
