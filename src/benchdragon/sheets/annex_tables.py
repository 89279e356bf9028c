"""The tables of the permit annex, in the language in use."""

import math
from dataclasses import fields

from shapely.geometry import LinearRing

from benchdragon.analysis.check import peak_text
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.findings import shown_name
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.posts import Reason, Why
from benchdragon.analysis.room import RoomLevel
from benchdragon.analysis.room import shown_name as level_name
from benchdragon.analysis.speed import given_limits
from benchdragon.analysis.timetable import timetable
from benchdragon.explain.timetable_text import TimetableText, timetable_text
from benchdragon.export.document import Table
from benchdragon.i18n import N_, _, language
from benchdragon.model.answer import Answer
from benchdragon.model.base_curve import Point
from benchdragon.number_format import decimals_towards, known, outward
from benchdragon.plans.people import SourcesTable
from benchdragon.sheets.annex_facts import DISTANCE, AnnexFacts
from benchdragon.sheets.briefing import Briefing

BLANK = 28 * "_"
STATUS = {
    "proved": N_("proved"),
    "found": N_("found"),
    "infeasible": N_("no solution"),
    "undecided": N_("undecided"),
    "unlimited": N_("unlimited"),
}
WHY: dict[Why, str] = {
    "venue": N_("benches nearest to the venue's edge: at least {value} m"),
    "entrance": N_("entrance"),
    "tightest": N_("benches nearest to one another: at least {value} m at {time}"),
    "fastest": N_("fastest handle: {value} m/s at {time}"),
    "run": N_("handles run: up to {value} m/s at {time}"),
    "line": N_("along the line"),
}
# Reasons that tell a speed, which is rounded up; distances are rounded down.
FASTEST: tuple[Why, ...] = ("fastest", "run")
DEVIATIONS = {
    "aside": N_("handles beside the line that is walked"),
    "stray": N_("that line beside the route"),
    "play": N_("pin play"),
    "height": N_("heights of handles"),
    "length": N_("lengths of benches"),
    "width": N_("widths of benches"),
}
PEOPLE = {
    "beside": N_("room for bearers on each side of a bench"),
    "ahead": N_("free room before the head's bench"),
    "sway": N_("sway of benches to a side"),
    "imprecision": N_("how far bearers stray"),
    "step": N_("length of a step"),
    "hurry_from": N_("speed from which one hurries"),
    "run_from": N_("speed from which one runs"),
    "most_speed": N_("greatest speed with a bench"),
}


def metres(value: float, *, up: bool = False) -> str:
    """A length with two decimals; rounded up where less would not be true."""
    return f"{decimals_towards(value, 2, up=True) if up else f'{value:z.2f}'} m"


def place(point: Point, ground: Ground) -> str:
    """Coordinates on the ground, m."""
    x, y = ground.seen([point])[0].tolist()
    return f"{x:z.2f}, {y:z.2f}"


def basics(briefing: Briefing) -> list[tuple[str, str]]:
    """The facts of the event; a blank where the plan does not give them."""
    event, plan = briefing.plan.event, briefing.plan
    said = [
        (_("title"), plan.title(language())),
        (_("place"), event.called_place(language())),
        (_("date"), event.date),
        (_("start of the dance"), plan.cues.clock),
        (_("organiser"), event.organiser),
        (_("whom to ask"), event.contact),
        (_("spectators expected"), "" if event.spectators is None else str(event.spectators)),
        (_("marshals"), "" if event.marshals is None else str(event.marshals)),
    ]
    return [(name, value or BLANK) for name, value in said]


def basics_table(briefing: Briefing) -> Table:
    """The basics."""
    return Table(
        "basics",
        _("the event"),
        (_("item"), _("as the plan says")),
        (1.0, 3.0),
        tuple(basics(briefing)),
    )


def swept_table(facts: AnnexFacts) -> Table:
    """The ground covered in numbers."""
    swept = facts.swept
    box = swept.enclosing.rectangle
    rows = (
        (_("ground within the spectators' line, all of it"), f"{facts.within_line:.0f} m²"),
        (_("of it, what boards pass over: strips along the route"), f"{swept.area:.1f} m²"),
        (_("smallest rectangle that holds these strips"), f"{box.width:.2f} m × {box.height:.2f} m"),
        (
            _("length of the spectators' line round the outside"),
            metres(sum(LinearRing(ring).length for ring in swept.lines.outer)),
        ),
    )
    return Table("swept", _("the ground"), (_("item"), _("value")), (2.0, 1.0), rows)


def timetable_of(briefing: Briefing) -> TimetableText:
    """The timetable of the dance that was checked."""
    report = briefing.report
    span = report.start, report.end
    passings = timetable(report.plan, report.walk, *span)
    return timetable_text(report.plan, report.walk, span, briefing.ground, passings)


def passing_table(told: TimetableText) -> Table:
    """When head and tail pass places of the route: as the timetable has it."""
    widths = (0.3, 0.36, 0.12, 0.18, 0.16)[: len(told.columns)]
    return Table("timetable", told.name, told.columns, widths, told.rows, numbers=True)


def people_table(briefing: Briefing) -> Table:
    """How many people there are."""
    event, dragon = briefing.plan.event, briefing.report.walk.dragon
    bearers = briefing.roster.persons
    without = sum(not briefing.roster.people(n) for n in range(1, len(dragon) + 1))
    rows = (
        (_("benches"), str(len(dragon))),
        (_("bearers in the list of names"), str(bearers) if bearers else BLANK),
        (_("benches for which the list names nobody"), str(without) if bearers else BLANK),
        (_("marshals"), BLANK if event.marshals is None else str(event.marshals)),
        (_("spectators expected"), BLANK if event.spectators is None else str(event.spectators)),
    )
    return Table("people", _("numbers of people"), (_("item"), _("value")), (3.0, 1.0), rows)


def _answer_row(name: str, found: Answer, limit: float | None, *, up: bool) -> tuple[str, ...]:
    """What is surely true of an answer, its bracket, how it was established, what was asked for."""
    asked = "–" if limit is None else f"{limit:g} {found.unit}"
    if not math.isfinite(found.value):
        return (name, _("no pair counts"), "–", _(STATUS[found.status]), asked)
    sure = f"{found.shown(up=up, limit=limit)} {found.unit}"
    return (name, sure, outward(found.lower, found.upper), _(STATUS[found.status]), asked)


ANSWER_NAMES = (N_("what"), N_("value"), N_("bracket"), N_("how"), N_("asked for"))


def _answers(name: str, caption: str, rows: list[tuple[str, ...]]) -> Table:
    names = tuple(_(text) for text in ANSWER_NAMES)
    return Table(name, caption, names, (3.2, 1.4, 1.9, 1.0, 1.2), tuple(rows))


def clearance_table(briefing: Briefing) -> Table:
    """What benches keep from one another, from the venue's edge and from obstacles."""
    report = briefing.report
    margin = report.plan.limits.margin
    rows = [_answer_row(_("benches from one another"), report.clearance, margin, up=False)]
    for one in report.obstacles:
        text = _("benches from {name}")
        if one.obstacle.kind == "venue":
            text = _("benches from the edge of {name}")
        name = text.format(name=shown_name(one.obstacle))
        rows.append(_answer_row(name, one.distance, one.obstacle.margin, up=False))
    return _answers("clearances", _("least distances over the whole dance"), rows)


def room_table(briefing: Briefing) -> Table:
    """Room for people, level upon level."""
    words = {True: _("kept"), False: _("not kept"), None: _("undecided")}
    rows = tuple(
        (level_name(one), _asked(one) or "–", f"{one.between:g} m", words[one.kept])
        for one in briefing.report.room
    )
    names = (_("room"), _("asked for"), _("between benches side by side, at least"), _("verdict"))
    return Table("room", _("room for people"), names, (1.2, 3.0, 1.4, 0.8), rows)


def _asked(level: RoomLevel) -> str:
    """What a level asks for and where that comes from."""
    text = _("{what} {value} m ({source})")
    return _("; ").join(
        text.format(
            what=_(PEOPLE[one.key]), value=f"{one.value:g}", source=one.source or _("assumption")
        )
        for one in level.asked
    )


def speed_table(briefing: Briefing) -> Table:
    """The greatest speed, and what else the plan limits."""
    report, limits = briefing.report, given_limits(briefing.plan)
    rows = [_answer_row(_("fastest handle"), report.greatest_speed, limits.get("speed"), up=True)]
    for name, peak in report.peaks.items():
        rows.append(_answer_row(peak_text(name), peak, limits[name], up=True))
    return _answers("speeds", _("greatest values over the whole dance"), rows)


def _reason(one: Reason, clock: Clock) -> str:
    time = "" if math.isnan(one.time) else clock.tell(one.time)
    value = known(one.value, one.value, "m", up=one.why in FASTEST)
    return _(WHY[one.why]).format(value=value, time=time)


def post_table(facts: AnnexFacts) -> Table:
    """Where posts are, and what for."""
    clock = facts.briefing.clock
    rows = tuple(
        (
            str(n),
            place(post.point, facts.briefing.ground),
            _("; ").join(_reason(one, clock) for one in post.reasons),
        )
        for n, post in enumerate(facts.posts, start=1)
    )
    names = (_("post"), _("x, y from the peg (m)"), _("reason"))
    return Table("posts", _("posts for marshals"), names, (0.5, 1.6, 6.0), rows)


def chance_table(facts: AnnexFacts) -> Table:
    """How far from exact the random dances are."""
    rows = tuple(
        (_(DEVIATIONS[field.name]), f"{getattr(facts.chance.deviations, field.name):g} m")
        for field in fields(facts.chance.deviations)
    )
    names = (_("deviation"), _("standard deviation"))
    return Table("deviations", _("deviations of random dances"), names, (3.0, 1.0), rows)


def assumption_table(facts: AnnexFacts) -> Table:
    """Numbers about people with their sources; what has none is an assumption."""
    plan, rows = facts.briefing.plan, []
    for name in SourcesTable.model_fields:
        value = getattr(plan.people, name)
        if value:
            unit = "m/s" if name in ("hurry_from", "run_from", "most_speed") else "m"
            source = getattr(plan.people.source, name) or _("assumption")
            rows.append((_(PEOPLE[name]), f"{value:g} {unit}", source))
    distance = _("as the plan says")
    if plan.event.distance is None:
        distance = _("assumption of this program, since the plan says none")
    shown = DISTANCE if plan.event.distance is None else plan.event.distance
    rows.append((_("distance of the spectators' line"), f"{shown:g} m", distance))
    rows.append((_("deviations of random dances"), "–", _("assumption of this program")))
    names = (_("figure"), _("value"), _("source"))
    return Table("assumptions", _("figures and sources"), names, (2.5, 1.0, 2.5), tuple(rows))
