"""The timetable of a dance in words: its rows, and the sentences about them and the drum."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from benchdragon.analysis.beats import Score, counted_in, score_of
from benchdragon.analysis.clock import Clock, lasting
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.stops import stops_of, stops_sentence
from benchdragon.analysis.timetable import Passing
from benchdragon.explain.whereabouts import whereabouts
from benchdragon.i18n import _
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan

# The cell of a place that nothing passes.
NONE = "-"


@dataclass(frozen=True)
class TimetableText:
    """A timetable in the language in which it was asked for.

    Attributes:
        name: of the table.
        columns: their headings; without the tail's if it comes to no place.
        rows: as many cells each.
        lines: a sentence each: times, stops, the drum, what the columns count.
    """

    name: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[str, ...]


def timetable_text(
    plan: Plan, walk: Walk, span: tuple[float, float], ground: Ground, passings: Sequence[Passing]
) -> TimetableText:
    """The timetable of a plan's walk over a span, s: `passings` are what `timetable` found."""
    start, end = span
    clock, tail = Clock(plan.cues.clock, start), any(row.tail is not None for row in passings)
    columns = (_("place"), _("where it is"), _("way (m)"), _("head"), _("tail"))
    count = len(columns) if tail else len(columns) - 1
    rows = [_cells(plan, row, clock, ground)[:count] for row in passings]
    score = score_of(plan, start, end)
    lines = [
        _("The whole dance lasts {long}.").format(long=lasting(end - start)),
        clock.legend,
        stops_sentence(stops_of(walk, start, end), clock),
        _("Drum: {tempo}.").format(tempo=tempo_text(plan, score)),
        *_count_in(score, start),
        *told_sentences(passings),
        ground.ways_legend,
    ]
    return TimetableText(
        _("When head and tail pass") if tail else _("When the head passes"),
        columns[:count],
        tuple(rows),
        tuple(line for line in lines if line),
    )


def _cells(plan: Plan, row: Passing, clock: Clock, ground: Ground) -> tuple[str, ...]:
    """A row of the table."""

    def at(time: float | None) -> str:
        return NONE if time is None else clock.tell(time)

    head = at(row.head)
    if row.until is not None and row.head is not None and row.until > row.head:
        head = _("{start} to {end}").format(start=head, end=at(row.until))
    where = whereabouts(plan, ground, row.point)
    return row.name, where, f"{row.way:z.2f}", head, at(row.tail)


def _count_in(score: Score, start: float) -> Iterator[str]:
    """How many beats of the sound file count in before the dance starts, s."""
    first = counted_in(score).runs[:1]
    if first and first[0].start < start:
        text = _("The sound file counts {beats} beats in: the head sets out on the next one.")
        yield text.format(beats=first[0].beats())


def told_sentences(passings: Sequence[Passing]) -> list[str]:
    """What the columns of times count, and what a dash in them means, where there is one."""
    if all(row.tail is None for row in passings):
        return [
            _(
                "The dance ends before the tail comes as far as any of these: only the head is told "
                "of, by its front handle."
            )
        ]
    said = [
        _(
            "The head is there with its front handle, the tail with its last handle: then all have "
            "passed. The tail's own sheet tells of its front handle, which is there a little earlier."
        )
    ]
    if any(row.head is None or row.tail is None for row in passings):
        said.append(_("-: the head, or the tail, does not pass there while the dance lasts."))
    return said


def tempo_text(plan: Plan, score: Score) -> str:
    """The tempo, and where it comes from, in the language in use."""
    tempo = f"{score.tempo:.4g}"
    if not score.by_step:
        return _("{tempo} beats a minute, as the plan says").format(tempo=tempo)
    text = _("{tempo} beats a minute: a step of {step} cm a beat at the head's speed")
    return text.format(tempo=tempo, step=f"{100.0 * plan.people.step:g}")
