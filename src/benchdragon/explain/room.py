"""How room for people was checked: each level with its requirements."""

from collections.abc import Callable

from benchdragon.analysis.check import Report
from benchdragon.analysis.findings import named
from benchdragon.analysis.room import RoomLevel, asked_text, shown_name
from benchdragon.explain.text import number, tiny
from benchdragon.i18n import N_, _
from benchdragon.number_format import seconds

# What a level asks for, as papers say it, cm.
PLAIN = {
    "sway": N_("{value} cm to each side"),
    "imprecision": N_("{value} cm to each side"),
    "beside": N_("{value} cm on each side of a bench"),
    "ahead": N_("{value} cm before the head"),
}


def level_line(level: RoomLevel, asked: Callable[[RoomLevel], str] = asked_text) -> str:
    """A level, what it asks for, and whether it is kept or when it is first broken."""
    name = shown_name(level)
    if level.asked:
        name = _("{name}: {asked}").format(name=name, asked=asked(level))
    if level.first is None:
        return _("{name}: kept").format(name=name)
    contact, obstacle = level.first
    benches = () if contact.witness is None else contact.witness.benches
    if level.kept is None:
        text = _("{name}: too close to tell at t = {t} s")
    elif obstacle is not None:
        text = _("{name}: first broken at t = {t} s by bench {a} at {obstacle}")
    else:
        text = _("{name}: first broken at t = {t} s by benches {a} and {b}")
        if level.asked:
            text = _(
                "{name}: first broken at t = {t} s by benches {a} and {b}; side by side they need "
                "{between} m between them"
            )
        if level.short is not None and level.short.key == "ahead":
            text = _(
                "{name}: first broken at t = {t} s by benches {a} and {b}; what lacks is the room "
                "before the head's bench"
            )
    return text.format(
        name=name, t=seconds(contact.value), a=benches[0] if benches else 0,
        b=benches[-1] if benches else 0, obstacle="" if obstacle is None else named(obstacle),
        between=f"{level.between:g}",
    )  # fmt: skip


def plain_asked(level: RoomLevel) -> str:
    """What a level asks for and where that comes from, without keys of the plan: for papers."""
    said = []
    for one in level.asked:
        text = _("{what}, assumption")
        if one.source:
            text = _("{what}, {source}")
        what = _(PLAIN[one.key]).format(value=f"{round(100.0 * one.value, 6):g}")
        said.append(text.format(what=what, source=one.source))
    return _("; ").join(said)


def room_lines(report: Report) -> list[str]:
    """The derivation of the levels of room; no lines where the plan asks for none."""
    if not report.room:
        return []
    people, margin = report.plan.people, report.plan.limits.margin
    each = people.sway + people.imprecision
    numbers = f"{number(margin)} + 2·({number(people.sway)} + {number(people.imprecision)})"
    lines = [
        _(
            "Room for people is searched level upon level, each as benches alone are. Two benches that "
            "each sway or stray come nearer by twice that: margin + 2·(sway + imprecision) = {numbers} "
            "= {sum} m; to what stands still by once."
        ).format(numbers=numbers, sum=number(margin + 2.0 * each))
    ]
    if people.beside or people.ahead:
        text = _(
            "With people each bench is {beside} m wider on both sides, and that of the head longer by "
            "{ahead} m in front, straight on."
        )
        lines.append(text.format(beside=number(people.beside), ahead=number(people.ahead)))
    return [*lines, *(_bracketed(level) for level in report.room)]


def _bracketed(level: RoomLevel) -> str:
    """A level, and the bracket of when it is first broken."""
    if level.first is None:
        return level_line(level)
    contact = level.first[0]
    text = _("{level}; kept until {lower} s, surely broken at {upper} s; bracket {width} s")
    if level.kept is None:
        text = _("{level}; kept until {lower} s, the doubt ends at {upper} s; bracket {width} s")
    width = tiny(contact.upper - contact.lower)
    return text.format(
        level=level_line(level), lower=f"{contact.lower:.16g}", upper=f"{contact.upper:.16g}",
        width=width,
    )  # fmt: skip
