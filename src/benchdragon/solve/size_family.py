"""The walks of a plan in which one size varies, for Python and for the kernels."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from benchdragon.analysis import distance
from benchdragon.analysis.proof import Claim
from benchdragon.analysis.tables import in_columns, kinds_of, walk_tables
from benchdragon.errors import InputError
from benchdragon.i18n import N_, _
from benchdragon.kernels import family as sizes_of
from benchdragon.kernels.curve import MOST_METRES, FloatArray
from benchdragon.kernels.family import PlanNumber, RouteKind, TurnKind, Varied
from benchdragon.kernels.route_parts import PART_COLUMNS
from benchdragon.kernels.turn_families import ARCS, MOST_TURN_PIECES
from benchdragon.kernels.workspace import Benches
from benchdragon.kernels.workspace import Walk as KernelWalk
from benchdragon.model.answer import Witness
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import FITS, FormationRoute, ProgrammeRoute, SpiralInRoute, TurnRoute
from benchdragon.plans.schema import Plan
from benchdragon.plans.tables import LEAST, LEAST_PITCH, ROOMY
from benchdragon.plans.toml import PlanError

# Brackets are at most so wide, m.
TOLERANCE = 1e-12


@dataclass(frozen=True)
class Question:
    """A size of a plan whose limit is sought.

    Attributes:
        name: as on the command line.
        keys: the plan's keys that hold it.
        sense: +1 where larger sizes are safer, -1 where smaller ones are.
        text: the meaning of the answer, in words.
        what: its number in the kernels.
    """

    name: str
    keys: tuple[str, ...]
    sense: float
    text: str
    what: int


QUESTIONS = {
    question.name: question
    for question in (
        Question("pitch", ("route.pitch",), 1.0, N_("smallest pitch"), Varied.PITCH),
        Question("disc", ("disc.radius",), 1.0, N_("smallest disc radius"), Varied.DISC),
        Question("width", ("dragon.width",), -1.0, N_("widest bench"), Varied.WIDTH),
        Question(
            "length",
            ("dragon.body_length", "dragon.tail_length"),
            -1.0,
            N_("longest bench"),
            Varied.BENCH,
        ),
    )
}


def question(name: str) -> Question:
    """The question of that name.

    Raises:
        InputError: if there is none.
    """
    if not isinstance(name, str) or name not in QUESTIONS:
        text = _("expected one of {known}, not {name}")
        raise InputError(text.format(known=", ".join(QUESTIONS), name=name))
    return QUESTIONS[name]


@dataclass(frozen=True)
class Meeting:
    """Benches i and j (rows, from 0) of a walk whose head stands at s, m, `left` before its end."""

    s: float
    left: float
    i: int
    j: int

    def windows(self, links: FloatArray, first: float, last: float) -> Iterator[tuple[float, float]]:
        """Spans of head positions near it, in a walk from first to last, m.

        What is near is within one and a half links. The walk may be that of another size: then it is
        as far from its start as the meeting, and as far from its end.
        """
        near = 1.5 * float(max(links[self.i], links[self.j]))
        yield max(first, self.s - near), min(last, self.s + near)
        other = last - self.left
        if abs(other - self.s) > 0.1 * near:
            yield max(first, other - near), min(last, other + near)


@dataclass
class PlanFamily:
    """The walks of a plan in which one size varies."""

    plan: Plan
    question: Question
    margin: float
    tolerance: float = TOLERANCE
    _last: tuple[float, tuple[Walk, float, float]] | None = field(
        default=None, init=False, repr=False, compare=False
    )

    def __post_init__(self) -> None:
        """Let the head start and end as with the plan's benches on routes that kernels do not make.

        Raises:
            InputError: for sizes of such routes, which the kernels do not know.
        """
        route = self.plan.route
        if not route.once and self.question.name in ("pitch", "disc"):
            text = _("this size is sought for a coil that is walked once: take out {keys}")
            raise InputError(text.format(keys="route.rounds, route.street"))
        if route.once and not isinstance(route, FormationRoute | ProgrammeRoute):
            return
        if self.question.name == "pitch":
            raise InputError(
                _(
                    "the smallest pitch of a formation is not sought: see by a sweep over its pitch "
                    "what clearance each leaves"
                )
            )
        walk = self.plan.build()
        if not route.once:
            self.plan = self.plan.with_value("walk.end", self.plan.span(walk)[1])
        if self.plan.walk.position is None:
            self.plan = self.plan.with_value("walk.position", walk.start)

    @property
    def first(self) -> float:
        """The plan's own size, from which the search begins."""
        return self.plan.value(self.question.keys[0])

    def sized(self, size: float) -> Plan:
        """The plan with a size."""
        return self.plan.with_values(dict.fromkeys(self.question.keys, size))

    def said(self, claim: Claim, size: float) -> Claim:
        """A claim about the walk of a size, as one about the plan."""
        margin = None if self.margin == self.plan.limits.margin or claim.about else self.margin
        return replace(claim, margin=margin, values=tuple((key, size) for key in self.question.keys))

    def walk(self, size: float) -> tuple[Walk, float, float]:
        """The walk of a size, and the times between which it must stay clear.

        The last one is cached, as a proof asks for it several times.
        """
        if self._last is None or self._last[0] != size:
            plan = self.sized(size)
            walk = plan.build()
            self._last = size, (walk, *plan.span(walk))
        return self._last[1]

    def low_point(self, size: float, meeting: Meeting) -> tuple[float, Meeting]:
        """The least distance of a pair near a meeting, less the margin, m, and the meeting there.

        In the walk of another size that is as far from the start, or from the end: whichever is nearer
        to touching.
        """
        try:
            walk, start, end = self.walk(size)
        except (InputError, PlanError):
            return math.nan, meeting
        first, last = walk.head_position([start, end]).tolist()
        least, where = min(
            distance.low_point(walk, meeting.i, meeting.j, low, high)
            for low, high in meeting.windows(walk.dragon.links, first, last)
        )
        room = least - self.margin if math.isfinite(least) else math.nan
        return room, replace(meeting, s=where, left=last - where)


def meeting_of(walk: Walk, end: float, witness: Witness) -> Meeting:
    """About where benches meet, as a witness says, in a walk until `end`, s."""
    i, j = (number - 1 for number in witness.benches)
    return Meeting(witness.s, float(walk.head_position([end])[0]) - witness.s, i, j)


def kernel_numbers(plan: Plan, question: Question) -> FloatArray:
    """A plan's numbers as the kernels take them: see kernels/family.py."""
    route, turn, walk = plan.route, plan.turn, plan.walk
    begin_way, end_way, most_way = plan.ways()
    pitch, disc = math.nan, _or_nan(plan.disc.radius)
    kind, start, clockwise = RouteKind.FIXED, math.nan, True
    if not route.once:
        pass  # its rows stay
    elif isinstance(route, SpiralInRoute):
        kind, pitch, start = RouteKind.SPIRAL_IN, route.pitch, route.start_turn
        clockwise = route.clockwise
    elif isinstance(route, TurnRoute):
        kind, pitch, disc = RouteKind.TURN, route.pitch, TurnRoute.disc(plan)
    radii = turn.radii or (math.nan, math.nan)
    numbers = {
        PlanNumber.WHAT: question.what,
        PlanNumber.ROUTE: kind,
        PlanNumber.PITCH_SIZE: pitch,
        PlanNumber.DISC_RADIUS: disc,
        PlanNumber.START_TURN: start,
        PlanNumber.HANDED: 1.0 if clockwise else -1.0,
        PlanNumber.TURN_FAMILY: TurnKind.ARC_ARC if turn.family == "arc-arc" else TurnKind.THREE_PIECES,
        PlanNumber.ENTRY_RADIUS: _or_nan(turn.entry_radius),
        PlanNumber.EXIT_RADIUS: _or_nan(turn.exit_radius),
        PlanNumber.RATIO: turn.ratio,
        PlanNumber.FIRST_RADIUS: radii[0],
        PlanNumber.LAST_RADIUS: radii[1],
        PlanNumber.BEND: turn.curvature if turn.family == "arc-arc-arc" else 0.0,
        PlanNumber.EASE: turn.ease,
        PlanNumber.POSITION: _or_nan(walk.position),
        PlanNumber.BEGIN_WAY: begin_way,
        PlanNumber.END_WAY: end_way,
        PlanNumber.MOST_WAY: most_way,
        PlanNumber.LEAST_SIZE: LEAST_PITCH if question.what == Varied.PITCH else LEAST,
        PlanNumber.MOST_SIZE: _most_size(plan, question),
        PlanNumber.ROOMY: ROOMY,
        PlanNumber.FITS: FITS,
    }
    return in_columns(numbers)


def _most_size(plan: Plan, question: Question) -> float:
    """The greatest size that a plan may have, m: longer benches cannot follow its formations."""
    if question.what != Varied.BENCH:
        return MOST_METRES
    insets = plan.dragon.front_inset + plan.dragon.rear_inset
    return min(MOST_METRES, plan.route.links_below() + insets - TOLERANCE)


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def kernel_family(family: PlanFamily, walk: Walk) -> tuple[sizes_of.Family, KernelWalk]:
    """A family, and one of its walks, `walk`, as the kernels take them; they copy both."""
    name, sizes, benches = family.question.name, walk.dragon.sizes, walk_tables(walk).benches
    all_of = {"width": 0, "length": 1}.get(name, len(walk.dragon))  # from which bench on they vary
    share = [0.0 if n < all_of else 1.0 for n in range(len(walk.dragon))]
    marked = sizes.tolist()  # benches of the same sizes of which one alone varies are two kinds
    row = 1 if name == "width" else 0
    mark = max(marked[row]) + 1.0
    marked[row] = [mark if n >= all_of else size for n, size in enumerate(marked[row])]
    kind, kinds = kinds_of(np.array(marked))
    own = Benches(benches.links, benches.sizes, kind, benches.ahead, benches.lever)
    made = sizes_of.Family(
        kernel_numbers(family.plan, family.question), np.empty((MOST_TURN_PIECES + 2, PART_COLUMNS)),
        np.empty((ARCS, 2)), np.empty((MOST_TURN_PIECES, 3)), sizes, np.array(share),
    )  # fmt: skip
    return made, KernelWalk(walk.route.rows, own, kinds)
