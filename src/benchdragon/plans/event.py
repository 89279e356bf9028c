"""The table of a plan file about the event: where, when, by whom, how many people come."""

from datetime import date
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, Field

from benchdragon.i18n import _
from benchdragon.model.base_curve import Point
from benchdragon.plans.tables import Length, Metres, OneLine, Table

# Entrances of one venue, and people at one event: more are an input error.
MOST_ENTRANCES, MOST_PEOPLE = 50, 10_000_000


def _day(value: Any) -> Any:
    """A date of TOML as text."""
    return value.isoformat() if isinstance(value, date) else value


def entrance(numbers: list[float]) -> list[float]:
    """Refuses a width that is none."""
    if len(numbers) > 2 and numbers[2] <= 0.0:
        said = _("expected a width of more than 0 m, not {value}")
        raise ValueError(said.format(value=f"{numbers[2]:g}"))
    return numbers


Entrance = Annotated[list[Metres], Field(min_length=2, max_length=3), AfterValidator(entrance)]
People = Annotated[int, Field(ge=0, le=MOST_PEOPLE, strict=True)]


class EventTable(Table):
    """What the permit annex says of the event; what is not said is left to be filled in by hand.

    Attributes:
        place: where it is.
        place_zh: the same in Chinese.
        date: the day, or the days.
        organiser: who is responsible for it.
        contact: who is asked about it.
        spectators: how many are expected.
        marshals: how many there will be.
        distance: of the spectators' line from the ground that the benches cover, m.
        entrances: where people come in, x and y, m, and how wide, m, where that is known.
    """

    place: OneLine = ""
    place_zh: OneLine = ""
    date: Annotated[OneLine, BeforeValidator(_day, json_schema_input_type=str)] = ""
    organiser: OneLine = ""
    contact: OneLine = ""
    spectators: People | None = None
    marshals: People | None = None
    distance: Length | None = None
    entrances: Annotated[list[Entrance], Field(max_length=MOST_ENTRANCES)] = Field(default_factory=list)

    @property
    def places(self) -> list[Point]:
        """Where people come in, m."""
        return [(numbers[0], numbers[1]) for numbers in self.entrances]

    @property
    def widths(self) -> list[float | None]:
        """How wide the entrances are, m; None where the plan does not say."""
        return [numbers[2] if len(numbers) > 2 else None for numbers in self.entrances]
