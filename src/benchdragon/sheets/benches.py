"""What a sheet for a bench, or for a household's benches, says."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from benchdragon.analysis.marks import Marks, between
from benchdragon.explain.bench_basis import bench_text
from benchdragon.explain.bench_text import BenchText
from benchdragon.i18n import _
from benchdragon.rosters.roster import Person, phones_of
from benchdragon.sheets.briefing import Briefing


@dataclass(frozen=True)
class Entry:
    """A bench on a sheet.

    Attributes:
        bench: its number, from 1.
        called: what the village calls it.
        title: the same, with a word for head and tail.
        people: who carries it, a line each.
        text: what it does; benches beside it are named with their people.
        marks: between which marks of the chalk plan it starts; "" where no two marks tell.
        kin: where the others of its household are; "" where the list names none.
    """

    bench: int
    called: str
    title: str
    people: tuple[str, ...]
    text: BenchText
    marks: str
    kin: str


@dataclass(frozen=True)
class Sheet:
    """What one gets: one's bench, or the benches of a household under its name."""

    title: str
    entries: tuple[Entry, ...]


def bench_sheets(
    briefing: Briefing, by: Literal["bench", "household"], phones: bool, most: int
) -> list[Sheet]:
    """The sheets of a dance, the head's first, with so many benches of a household at most.

    Benches of no household stand alone.

    Raises:
        InputError: for marks of the chalk plan that are too many.
    """
    starts = briefing.report.walk.motion([briefing.report.start]).s[0]
    told = [mark_line(briefing.marks, float(starts[found.bench - 1])) for found in briefing.benches]
    entries = [
        _entry(briefing, found.bench, phones, line)
        for found, line in zip(briefing.benches, told, strict=True)
    ]
    if by == "bench":
        return [Sheet("", (entry,)) for entry in entries]
    groups: dict[str, list[Entry]] = {}
    for entry in entries:
        households = [one.household for one in briefing.roster.people(entry.bench) if one.household]
        for key in dict.fromkeys(households) or [f"\0{entry.bench}"]:
            groups.setdefault(key, []).append(entry)
    return [
        Sheet("" if key.startswith("\0") else key, tuple(there[n : n + most]))
        for key, there in groups.items()
        for n in range(0, len(there), most)
    ]


def _entry(briefing: Briefing, bench: int, phones: bool, marks: str) -> Entry:
    people = _people(briefing.roster.people(bench), phones)
    text = bench_text(briefing.plan, briefing.benches[bench - 1], briefing.named, briefing.ground)
    called, title = briefing.called(bench), briefing.titled(bench)
    return Entry(bench, called, title, people, text, marks, briefing.kin(bench))


def mark_line(marks: Marks, s: float) -> str:
    """Where a front handle starts, m along the route, by the chalk plan's marks; "" as `between`."""
    found = between(marks, s)
    if found is None:
        return ""
    n, past = found
    if not past:
        return _("Your front handle starts at mark {n} of the chalk plan.").format(n=n)
    text = _(
        "Your front handle starts between marks {n} and {next} of the chalk plan, {past} m past mark "
        "{n} along the line."
    )
    return text.format(n=n, next=n + 1, past=f"{past:.2f}")


def _people(people: Sequence[Person], phones: bool) -> tuple[str, ...]:
    """People, a line each, and then the phones that are their household's."""
    if not phones:
        return tuple(one.name for one in people)
    own, home = phones_of(people)
    text, of_home = _("{name}, phone {phone}"), _("phone of the household: {phone}")
    told = [
        text.format(name=one.name, phone=phone) if phone else one.name
        for one, phone in zip(people, own, strict=True)
    ]
    return (*told, *(of_home.format(phone=phone) for phone in home))
