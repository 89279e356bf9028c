"""What a sheet for a bench, or for a household's benches, says."""

from dataclasses import dataclass
from typing import Literal

from benchdragon.explain.bench_walk import BenchText, bench_text
from benchdragon.i18n import _
from benchdragon.rosters.roster import Person
from benchdragon.sheets.briefing import Briefing


@dataclass(frozen=True)
class Entry:
    """A bench on a sheet.

    Attributes:
        bench: its number, from 1.
        called: what the village calls it.
        people: who carries it, a line each.
        text: what it does; benches beside it are named with their people.
    """

    bench: int
    called: str
    people: tuple[str, ...]
    text: BenchText


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
    """
    entries = [_entry(briefing, found.bench, phones) for found in briefing.benches]
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


def _entry(briefing: Briefing, bench: int, phones: bool) -> Entry:
    people = tuple(_person(one, phones) for one in briefing.roster.people(bench))
    text = bench_text(briefing.plan, briefing.benches[bench - 1], briefing.named, briefing.peg)
    return Entry(bench, briefing.called(bench), people, text)


def _person(person: Person, phones: bool) -> str:
    if phones and person.phone:
        text = _("{name}, phone {phone}")
        return text.format(name=person.name, phone=person.phone)
    return person.name
