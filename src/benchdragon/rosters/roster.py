"""Who carries which bench."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Person:
    """Someone who carries a bench; what is not known is "".

    Attributes:
        name: as the list has it.
        household: whose bench it is.
        phone: never shown unless asked for.
        remarks: anything else that the list says.
    """

    name: str
    household: str = ""
    phone: str = field(default="", repr=False)
    remarks: str = ""


@dataclass(frozen=True)
class Roster:
    """The people of each bench.

    Attributes:
        benches: the people of each bench that has any, by its number, 1 being the head's.
        notes: what is odd about the list, in words: benches without people, people named twice, ...
    """

    benches: dict[int, tuple[Person, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def persons(self) -> int:
        """How many people carry: who is named at several benches counts once."""
        everybody = (one for people in self.benches.values() for one in people)
        return len({(one.name, one.household, one.phone) for one in everybody})

    def people(self, bench: int) -> tuple[Person, ...]:
        """Who carries a bench (number, from 1); empty where the list names nobody."""
        return self.benches.get(bench, ())
