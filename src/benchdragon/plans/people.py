"""The table of a plan file about the people: who carries, what room and what speeds they need."""

import re
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from benchdragon.errors import brief
from benchdragon.i18n import N_, Words, _, both
from benchdragon.plans.tables import Length, LengthOrZero, Number, OneLine, Speed, Table, one_line

# The unit of benches, after a number.
UNITS = {"bench": N_("bench {n}"), "qiao": N_("qiao {n}"), "jie": N_("jie {n}")}

# What phones may open from paper: an address of the web without a user's name, which would look like
# another host, or a relative file, whose path has neither scheme nor host.
ADDRESS = re.compile(
    r"[Hh][Tt][Tt][Pp][Ss]?://[^ /?#@:\\][^ /?#@\\]*(?:[/?#][^ \\]*)?"
    r"|[^ \\/:?#][^ \\:?#]*(?:[?#][^ \\]*)?"
)


def web_address(text: str) -> str:
    """Refuses what is neither an address of the web nor a relative file: phones do what it says."""
    if one_line(text) and not ADDRESS.fullmatch(text):
        said = _(
            "expected a web address (http:// or https://) or a relative file name, without spaces, "
            "not {text}"
        )
        raise ValueError(said.format(text=brief(text)))
    return text


Address = Annotated[str, Field(max_length=255), AfterValidator(web_address)]


class SourcesTable(Table):
    """Where numbers about people come from; what has no source is an assumption."""

    beside: OneLine = ""
    ahead: OneLine = ""
    sway: OneLine = ""
    imprecision: OneLine = ""
    steering: OneLine = ""
    step: OneLine = ""
    hurry_from: OneLine = ""
    run_from: OneLine = ""
    most_speed: OneLine = ""


class PeopleTable(Table):
    """Who carries the benches, the room that they need, and their speeds.

    Attributes:
        roster: a list of names beside the plan; `sheet` of it, if it has several.
        unit: what benches are counted in.
        count_head: whether the head's bench is number 1; else it is called the head, and 1 the next.
        beside: room for bearers on each side of a bench, m.
        ahead: room that is free before the head's bench, m.
        sway: how far benches sway to a side, m.
        imprecision: how far bearers stray from their line, m.
        steering: how fast bearers steer back, 1/m: an offset falls to 37 % over 1 / steering.
        step: length of a step, m.
        hurry_from: speed from which walking is called hurrying, m/s.
        run_from: speed from which it is called running, m/s.
        most_speed: the greatest at which a bench can be carried, m/s.
        address: where the player of the dance will be: http, https, or a relative file.
    """

    roster: OneLine = ""
    sheet: OneLine = ""
    unit: Literal["bench", "qiao", "jie"] = "bench"
    count_head: bool = True
    beside: LengthOrZero = 0.0
    ahead: LengthOrZero = 0.0
    sway: LengthOrZero = 0.0
    imprecision: LengthOrZero = 0.0
    steering: Annotated[Number, Field(ge=0.01, le=10.0)] | None = None
    step: Length = 0.6
    hurry_from: Annotated[Speed, Field(gt=0.0)] = 1.2
    run_from: Annotated[Speed, Field(gt=0.0)] = 1.8
    most_speed: Annotated[Speed, Field(gt=0.0)] | None = None
    address: Address = ""
    source: SourcesTable = SourcesTable()


@dataclass(frozen=True)
class Village:
    """Head and tail by name, {n} for the number of those between: the plan's, less `before`."""

    head: Words
    between: Words
    tail: Words
    before: int


# What of it decides whether a dance is safe.
DECIDING = ("beside", "ahead", "sway", "imprecision", "most_speed")


def called(people: PeopleTable, bench: int, count: int) -> str:
    """What the village calls a bench (number, from 1) of so many, in the language in use."""
    if not people.count_head and bench == 1:
        return _("the head")
    if not people.count_head and bench == count:
        return _("the tail")
    return _(UNITS[people.unit]).format(n=bench if people.count_head else bench - 1)


def village(people: PeopleTable, count: int) -> Village | None:
    """What the village calls so many benches, where that is not what the plan calls them."""
    if people.unit == "bench" and people.count_head:
        return None
    return Village(
        both(lambda: called(people, 1, count)),
        both(lambda: _(UNITS[people.unit])),
        both(lambda: called(people, count, count)),
        0 if people.count_head else 1,
    )
