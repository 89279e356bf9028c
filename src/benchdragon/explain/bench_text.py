"""What one bench does, in plain sentences for those who carry it."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

from benchdragon.analysis.bench_walks import BenchWalk, Stretch, Tightest
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.i18n import N_, _
from benchdragon.kernels.bench_nearness import REACH
from benchdragon.number_format import known
from benchdragon.plans.people import PeopleTable

# Turns and paces that the first line names one by one; of more it tells how many there are.
MOST_TURNS, MOST_PACES = 3, 4
# A stretch that turns by less than this, degrees, turns hardly at all. Angles cannot be read on the
# ground: turns are given to the nearest quarter of a round, and in rounds where they are whole ones.
LEAST_ANGLE, ROUND, QUARTERS = 5.0, 360.0, 4

WALKING = N_("keep walking")
PACES = {
    "wait": N_("wait"), "walk": WALKING, "hurry": N_("hurry"), "run": N_("run"),
}  # fmt: skip
TURNS = {"left": N_("turn left"), "right": N_("turn right"), "straight": N_("straight on")}
# How far it turns, by quarters of a round.
FAR = (N_("a little"), N_("a quarter round"), N_("half round"), N_("three quarters round"))
ALL_THE_WAY = {"left": N_("bend left all the way"), "right": N_("bend right all the way")}
SIDES = {
    "left": N_("on your left"), "right": N_("on your right"),
    "front": N_("in front of you"), "rear": N_("behind you"),
}  # fmt: skip
# The same as others read of a bench.
ITS_SIDES = {
    "left": N_("on its left"), "right": N_("on its right"),
    "front": N_("in front of it"), "rear": N_("behind it"),
}  # fmt: skip


class Halt(NamedTuple):
    """A time, s, in which the head stands, and what for."""

    start: float
    end: float
    what: str


@dataclass(frozen=True)
class BenchText:
    """What one bench does, in the language in which it was asked for.

    Attributes:
        quick: all of it in a dozen words.
        place: where it starts, a sentence each: chalk coordinates, steps from a landmark, the way.
        stretches: what it does from when to when, a sentence each.
        paces: from which speeds on one hurries, runs or waits, a sentence each; of paces in it alone.
        tightest: when a bench of another coil comes nearest.
        people: who is before, behind and beside, and where to go when the dance is over.
        times: what times in it are.
    """

    quick: str
    place: tuple[str, ...]
    stretches: tuple[str, ...]
    paces: tuple[str, ...]
    tightest: str
    people: tuple[str, ...]
    times: str

    @property
    def lines(self) -> list[str]:
        """All sentences, in order."""
        return [
            self.quick, *self.place, *self.stretches, *self.paces, self.tightest, *self.people,
            self.times,
        ]  # fmt: skip


@dataclass(frozen=True)
class Basis:
    """What sentences about benches rest on, beside what each does.

    Attributes:
        clock: which tells times.
        people: what the plan says of them.
        ground: from which places are given.
        halts: what the plan says the head stands for.
        coiled: whether the dance ends inside.
    """

    clock: Clock
    people: PeopleTable
    ground: Ground
    halts: tuple[Halt, ...]
    coiled: bool


@dataclass(frozen=True)
class Landmark:
    """What is nearest to a bench when the dance starts.

    Attributes:
        apart: how far it is, m.
        name: of the landmark; "" for the peg.
        edge: of the venue the edge there: see `Ground.edge`.
    """

    apart: float
    name: str = ""
    edge: int | None = None


def bench_lines(
    basis: Basis, found: BenchWalk, landmark: Landmark, called: Callable[[int], str]
) -> BenchText:
    """The sentences on one bench of a plan; `called` gives the name of a bench by its number.

    Places are given as the chalk plan measures them on the ground.
    """
    clock, halts, people = basis.clock, basis.halts, basis.people
    return BenchText(
        quick_line(found, clock, halts),
        (*place_lines(basis, found, landmark), _coming_line(found)),
        tuple(_stretch_line(one, clock, halts, people.step) for one in found.stretches),
        _pace_lines(people, found),
        tightest_line(found.tightest, clock, called),
        (*people_lines(found, called), _after_line(basis, found)),
        _times_line(found, clock),
    )


def quick_line(found: BenchWalk, clock: Clock, halts: Sequence[Halt] = ()) -> str:
    """What a bench does in a dozen words, and what it waits for."""
    said = [*_quick_turns(found.stretches), *_quick_paces(found.stretches, clock, halts)]
    text = _("{all}.").format(all=_("; ").join(said))
    return text[:1].upper() + text[1:]


def _quick_turns(stretches: Sequence[Stretch]) -> list[str]:
    """To which sides it turns: one after another, or how often."""
    bent = [one.turning for one in stretches if one.turning != "straight"]
    sides = [side for side, _same in groupby(bent)]
    if not sides:
        return [_("straight on all the way")]
    if len(sides) == 1 and len(bent) == len(stretches):
        return [_(ALL_THE_WAY[sides[0]])]
    if len(sides) <= MOST_TURNS:
        return [_(", then ").join(_(TURNS[side]) for side in sides)]
    text = _("{left} times left and {right} times right")
    return [text.format(left=sides.count("left"), right=sides.count("right"))]


def _waited_for(start: float, end: float, halts: Sequence[Halt]) -> str:
    """What the head stands for between two times, s; "" if the plan does not say."""
    return _("; ").join(one.what for one in halts if one.start < end and start < one.end)


def _quick_paces(stretches: Sequence[Stretch], clock: Clock, halts: Sequence[Halt]) -> list[str]:
    """At what paces it goes: one after another with their times, or how often."""
    runs = [(pace, list(some)) for pace, some in groupby(stretches, lambda one: one.pace)]
    if len(runs) == 1 and runs[0][0] == "walk":
        return [_("keep walking, without a stop")]
    if len(runs) == 1:
        return [_("{pace} all the time").format(pace=_(PACES[runs[0][0]]))]
    timed = [_quick_pace(pace, some, clock, halts) for pace, some in runs if pace != "walk"]
    if len(timed) <= MOST_PACES:
        first = [_(WALKING)] if runs[0][0] == "walk" else []
        last = [_("then {pace}").format(pace=_(WALKING))] if runs[-1][0] == "walk" else []
        return [*first, *timed, *last]
    counts = {name: sum(pace == name for pace, _some in runs) for name in ("hurry", "run", "wait")}
    text = _("{pace}, {count} times")
    return [
        _(WALKING),
        *(text.format(pace=_(PACES[name]), count=count) for name, count in counts.items() if count),
    ]


def _quick_pace(pace: str, some: Sequence[Stretch], clock: Clock, halts: Sequence[Halt]) -> str:
    """A pace with its times, and what is waited for."""
    start, end = some[0].start, some[-1].end
    what = _waited_for(start, end, halts) if pace == "wait" else ""
    text = _("{pace} from {start} to {end}: {what}") if what else _("{pace} from {start} to {end}")
    return text.format(pace=_(PACES[pace]), start=clock.tell(start), end=clock.tell(end), what=what)


def _pace_lines(people: PeopleTable, found: BenchWalk) -> tuple[str, ...]:
    """The meaning of a bench's paces, except walking."""
    means = {
        "hurry": _("Hurry means {speed} m/s or more.").format(speed=f"{people.hurry_from:g}"),
        "run": _("Run means {speed} m/s or more.").format(speed=f"{people.run_from:g}"),
        "wait": _("Wait means to stand still."),
    }
    used = {one.pace for one in found.stretches}
    return tuple(text for pace, text in means.items() if pace in used)


def place_lines(basis: Basis, found: BenchWalk, landmark: Landmark) -> tuple[str, str]:
    """Where a bench starts: how far from the peg, and steps from a landmark."""
    ground, steps = basis.ground, _steps_line(basis, landmark)
    (x, y), radius = ground.seen_at(found.place), math.dist(found.place, ground.peg)
    if ground.venue:
        ways = ground.way_names
        where = _(
            "Your front handle starts {x} m {way_x} and {y} m {way_y} from the peg: {radius} m from it."
        ).format(
            x=f"{_settled(abs(x)):.2f}", way_x=ways[0 if x >= 0.0 else 2],
            y=f"{_settled(abs(y)):.2f}", way_y=ways[1 if y >= 0.0 else 3],
            radius=f"{_settled(radius):.2f}",
        )  # fmt: skip
        return where, steps
    text = N_(
        "Your front handle starts at x = {x} m, y = {y} m from the peg: {radius} m from it at {angle}° "
        "from the x axis."
    )
    if ground.north:
        text = N_(
            "Your front handle starts at x = {x} m (east), y = {y} m (north) from the peg: {radius} m "
            "from it on a bearing of {angle}° from north."
        )
    angle = round(math.degrees(math.atan2(x, y) if ground.north else math.atan2(y, x)) % 360.0) % 360
    where = _(text).format(
        x=f"{_settled(x):z.2f}", y=f"{_settled(y):z.2f}", radius=f"{_settled(radius):.2f}", angle=angle
    )
    return where, steps


def _steps(way: float, step: float) -> int:
    """How many steps a way is, m."""
    return round(_settled(way / step))


def _settled(value: float) -> float:
    """A value of which rounding does not decide to which whole number it is nearer."""
    return round(value, 6)


def _steps_line(basis: Basis, landmark: Landmark) -> str:
    """How many steps the bench is from the nearest landmark when the dance starts."""
    steps = _steps(landmark.apart, basis.people.step)
    told = str(steps) if steps else _("less than 1")
    if not landmark.name:
        return _("At the start your front handle is {steps} steps from the peg.").format(steps=told)
    if landmark.edge is None:
        text = _("At the start your bench is {steps} steps from {name}.")
        return text.format(steps=told, name=landmark.name)
    text = _("At the start your bench is {steps} steps from the {edge} of {name}.")
    return text.format(steps=told, edge=basis.ground.edge_name(landmark.edge), name=landmark.name)


def doing(one: Stretch) -> str:
    """What a bench does in a stretch, in few words: to which side it turns, and its pace."""
    if one.pace == "wait":
        return _(PACES[one.pace])
    return _("{turn}, {pace}").format(turn=_(TURNS[one.turning]), pace=_(PACES[one.pace]))


def _stretch_line(one: Stretch, clock: Clock, halts: Sequence[Halt], step: float) -> str:
    """What a bench does in one stretch, and what it waits for."""
    times = {"start": clock.tell(one.start), "end": clock.tell(one.end)}
    if one.pace == "wait":
        what = _waited_for(one.start, one.end, halts)
        text = _("{start} to {end}: wait: {what}.") if what else _("{start} to {end}: wait.")
        return text.format(**times, what=what)
    angle = abs(math.degrees(one.angle))
    quarters = round(_settled(angle * QUARTERS / ROUND))
    text = _("{start} to {end}: {pace}, {turn}; {way} m, {steps} steps.")
    if one.turning != "straight" and quarters >= QUARTERS:
        text = _("{start} to {end}: {pace}, {turn}, {rounds} times round; {way} m, {steps} steps.")
    elif one.turning != "straight" and angle >= LEAST_ANGLE:
        text = _("{start} to {end}: {pace}, {turn}, {far}; {way} m, {steps} steps.")
    return text.format(
        **times, pace=_(PACES[one.pace]), turn=_(TURNS[one.turning]), far=_(FAR[quarters % QUARTERS]),
        rounds=f"{angle / ROUND:.1f}", way=f"{_settled(one.way):.0f}", steps=_steps(one.way, step),
    )  # fmt: skip


def tightest_line(
    near: Tightest | None, clock: Clock, called: Callable[[int], str], *, its: bool = False
) -> str:
    """When a bench of another coil comes nearest, which, on which side and how near.

    To those who carry it; with `its`, to others.
    """
    if near is None:
        text = _("No bench of another coil comes within about {reach} m of you.")
        if its:
            text = _("No bench of another coil comes within about {reach} m of it.")
        return text.format(reach=f"{REACH:g}")
    text = _("Tightest at {time}: {bench}, in another coil, comes as near as {gap} m, {side}.")
    gap = known(near.upper, near.upper, "m", up=False)
    time, side = clock.tell(near.time), _((ITS_SIDES if its else SIDES)[near.side])
    return text.format(time=time, bench=called(near.bench), gap=gap, side=side)


def people_lines(found: BenchWalk, called: Callable[[int], str]) -> tuple[str, ...]:
    """Who is before and behind a bench, and who stands beside it at the end."""
    said = []
    if found.before is not None:
        said.append(_("Before you: {bench}.").format(bench=called(found.before)))
    if found.behind is not None:
        said.append(_("Behind you: {bench}.").format(bench=called(found.behind)))
    if found.left is not None:
        said.append(_("At the end on your left: {bench}.").format(bench=called(found.left)))
    if found.right is not None:
        said.append(_("At the end on your right: {bench}.").format(bench=called(found.right)))
    return tuple(said)


def _times_line(found: BenchWalk, clock: Clock) -> str:
    """What times are; on the tail's sheet also that the timetable counts its last handle."""
    if found.behind is not None:
        return clock.legend
    text = _("{times} Here they are of your front handle, in the timetable of your last handle.")
    return text.format(times=clock.legend)


def _coming_line(found: BenchWalk) -> str:
    """How to come to where one starts."""
    if found.before is None:
        return _("Coming in: lead all of them along the chalk line, slowly.")
    return _("Coming in: follow the bench before you along the chalk line.")


def _after_line(basis: Basis, found: BenchWalk) -> str:
    """Where to go when the dance is over: who has coiled in cannot follow the head out."""
    if basis.coiled:
        return _("Afterwards: stand until your pin is pulled; the tail goes first.")
    if found.before is None:
        return _("Afterwards: lead all of them out where the leader says.")
    return _("Afterwards: follow the bench before you out.")
