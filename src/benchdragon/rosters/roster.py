"""Who carries which bench."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from benchdragon.rosters.words import plain


@dataclass(frozen=True)
class Person:
    """Someone who carries a bench; what is not known is "".

    Attributes:
        name: as the list has it.
        household: whose bench it is.
        phone: never shown unless asked for.
        home_phone: the household's, or that of all people of a row; no more shown than theirs.
        remarks: anything else that the list says.

    Examples:
        >>> bd.Person("Li", phone="123").name
        'Li'
    """

    name: str
    household: str = ""
    phone: str = field(default="", repr=False)
    remarks: str = ""
    home_phone: str = field(default="", repr=False)


def phones_of(people: Sequence[Person]) -> tuple[list[str], list[str]]:
    """The phone of each of the people of a bench, "" for none of their own; and those of households.

    What several have is no one's own.
    """
    phones = [one.phone for one in people]
    own = [phone if phones.count(phone) == 1 else "" for phone in phones]
    home = [phone for one in people for phone in (one.phone, one.home_phone)]
    return own, [phone for phone in dict.fromkeys(home) if phone and phone not in own]


@dataclass(frozen=True)
class Roster:
    """The people of each bench.

    Attributes:
        benches: the people of each bench that has any, by its number, 1 being the head's.
        notes: what is odd about the list, in words: benches without people, people named twice, ...

    Examples:
        >>> bd.Roster({1: (bd.Person("Li"), bd.Person("Wang"))}).benches[1][0].name
        'Li'
    """

    benches: dict[int, tuple[Person, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def persons(self) -> int:
        """How many people carry: who is named at several benches counts once."""
        named: dict[str, list[Person]] = {}
        for people in self.benches.values():
            for one in people:
                named.setdefault(plain(one.name), []).append(one)
        return sum(map(_namesakes, named.values()))

    def people(self, bench: int) -> tuple[Person, ...]:
        """Who carries a bench (number, from 1); empty where the list has no name."""
        return self.benches.get(bench, ())


def _namesakes(people: Sequence[Person]) -> int:
    """The number of people of one name, by households or phones; one if an entry has neither."""
    if any(not one.household and not one.phone for one in people):
        return 1
    above: dict[tuple[str, str], tuple[str, str]] = {}

    def root(mark: tuple[str, str]) -> tuple[str, str]:
        while above.setdefault(mark, mark) != mark:
            above[mark] = mark = above[above[mark]]
        return mark

    for one in people:
        marks = [("household", one.household), ("phone", one.phone)]
        known = [mark for mark in marks if mark[1]]
        above[root(known[-1])] = root(known[0])
    return len({root(mark) for mark in list(above)})
