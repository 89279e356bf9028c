"""Proofs of answers about contact in ball arithmetic, independent of the search (the extra `prove`).

A search finds the first contact. The proof then shows without it that nothing comes nearer before: the
head's way is cut into cells, each short enough that bounds alone show it clear (proofs/cells.py, and
design/proof.py). At the contact itself it shows that benches are nearer than allowed. A wrong result of
the search therefore stays unproved.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from benchdragon import budget
from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.contact import MOST_GRAZES, contact_windows
from benchdragon.analysis.obstacles import ObstacleAnswers, touching
from benchdragon.errors import UnsureError, brought_by, in_order
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.proofs import BITS

if TYPE_CHECKING:
    from benchdragon.proofs.chain import Chain
    from benchdragon.proofs.exact import Numbers

# How far behind the search's bracket a contact is sought, m; ten times as far each time.
FIRST_BEHIND, MOST_BEHIND = 1e-15, 1e-6
# If the proved clear way ends more than this before a contact, m, its time stays unproved.
MOST_SHORT = 1e-6
# Width of the bracket of a proved clearance, m.
CLEARANCE_WIDTH = 1e-6


@dataclass(frozen=True)
class Claim:
    """A proved statement: nothing comes nearer than allowed from `start` to `clear`, s.

    Attributes:
        about: the name of an obstacle, or empty: of benches among themselves.
        cells: the head's route positions, m, between each two of which nothing does.
        start: s.
        clear: s.
        contact: a time, s, by which a pair has come nearer; None in a claim without contact.
        s: the head's route position where it has, m.
        benches: which, rows from 0.
        margin: the distance kept, m; None: that of the plan.
        values: of other keys than the plan says them, by which the walk shown differs from the plan's.
    """

    about: str
    cells: tuple[float, ...]
    start: float
    clear: float
    contact: float | None = None
    s: float | None = None
    benches: tuple[int, ...] = ()
    margin: float | None = None
    values: tuple[tuple[str, float], ...] = ()


def require_flint() -> None:
    """Require python-flint.

    Raises:
        MissingExtraError: if it is not.
    """
    with brought_by("prove"):
        import flint  # noqa: F401 - an optional extra


@budget.question()
def prove_contact(
    walk: Walk | Plan, start: float | None = None, end: float | None = None, *,
    margin: float = 0.0, progress: Progress = silent, claims: list[Claim] | None = None,
    plan: Plan | None = None,
) -> Answer | None:  # fmt: skip
    """`first_contact`, proved: clear up to `lower`, and a pair nearer than the margin by `upper`.

    None is proved as well: no pair comes nearer than the margin from start to end. A graze that cannot
    be decided is "undecided". The proved claim is added to `claims`. Of a plan, or with the `plan` of
    which the walk is built, all numbers, times and margin too, count as they are written, else as the
    doubles that they are. It is about the whole walk unless start and end are given.

    Raises:
        InputError: for a number that the plan holds rounded, or a route that cannot be enclosed.
        MissingExtraError: without python-flint.
        UnsureError: if it could not be shown.
        WalkError: as `first_contact`.

    Examples:
        >>> plan = bd.read_plan("spiral-in", {"dragon.benches": 4, "walk.end": 1.0})
        >>> bd.prove_contact(plan) is None
        True
    """
    plan = walk if isinstance(walk, Plan) else plan
    walk, start, end = asked_of(walk, start, end)
    in_order(start, end)
    require_flint()
    found: list[Answer] = []
    for most in (1, MOST_GRAZES):
        windows = contact_windows(walk, start, end, margin=margin, most=most)
        found = [window.opens for window in windows]
        if not found or found[0].status == "found":
            break
    return Question(walk, margin, None, plan).proved((start, end), found, progress, claims)


@budget.question()
def prove_obstacle(
    walk: Walk, answers: ObstacleAnswers, start: float, end: float, *,
    claims: list[Claim] | None = None, plan: Plan | None = None,
) -> ObstacleAnswers:  # fmt: skip
    """The answers about an obstacle, with its contact proved, or that there is none from start to end.

    The proved claim is added to `claims`; `plan` as for `prove_contact`.

    Raises:
        InputError: as `prove_contact`.
        MissingExtraError: without python-flint.
        UnsureError: if it could not be shown.
        WalkError: as `first_touch`.
    """
    require_flint()
    obstacle = answers.obstacle
    found = touching(walk, obstacle, start, end)
    contact = Question(walk, None, obstacle, plan).proved((start, end), found, silent, claims)
    return replace(answers, contact=contact)


def prove_nearer(
    walk: Walk, span: tuple[float, float], s: float, benches: tuple[int, int], margin: float,
    plan: Plan | None = None,
) -> Claim | None:  # fmt: skip
    """That two benches (rows, from 0) are nearer than `margin` in a span of time, s; None if not.

    With the head at s, m, or where the span begins or ends, if that is nearer. `plan` as for
    `prove_contact`. The claim shows nothing of any time before.
    """
    require_flint()
    return Question(walk, margin, None, plan).nearer_in(span, s, benches)


@budget.question()
def prove_clearance(
    walk: Walk, found: Answer, start: float, end: float, *, width: float = CLEARANCE_WIDTH,
    progress: Progress = silent, claims: list[Claim] | None = None, plan: Plan | None = None,
) -> Answer:  # fmt: skip
    """The least clearance from start to end, s, proved in a bracket of `width`, m.

    No two benches are ever nearer than the lower end of the bracket, and two are nearer than the upper.

    Args:
        walk: the walk.
        found: what `least_clearance` found.
        start: s.
        end: s.
        width: of the bracket, m.
        progress: is called with the share done.
        claims: the proved claim is added to it.
        plan: as for `prove_contact`.

    Raises:
        InputError: as `prove_contact`.
        MissingExtraError: without python-flint.
        UnsureError: if it could not be shown, or no pair counts.
    """
    require_flint()
    near = found.witness
    if near is None or len(near.benches) != 2:
        raise UnsureError(N_("there is no clearance that could be proved"))
    lower, upper = max(found.value - 0.5 * width, 0.0), found.value + 0.5 * width
    i, j = sorted(number - 1 for number in near.benches)
    nearest = prove_nearer(walk, (start, end), near.s, (i, j), upper, plan)
    if nearest is None:
        raise UnsureError(N_("that benches come so near could not be shown in ball arithmetic"))
    shown: list[Claim] = []
    Question(walk, lower, None, plan).proved((start, end), [], progress, shown)
    if claims is not None:
        claims += [replace(shown[0], margin=lower), replace(nearest, margin=upper)]
    return replace(found, lower=lower, upper=upper, status="proved", assumptions=(assumed(walk, plan),))


def assumed(walk: Walk, plan: Plan | None = None) -> str:
    """The assumptions of every proof of a walk."""
    if plan is not None:
        from benchdragon.analysis.written import assumed_of  # needs flint

        return assumed_of(plan, walk)
    return _(
        "the stored numbers of route and benches are exact, and each part of the route begins "
        "where the one before it ends, in its direction if that is within 1e-9 rad"
    )


def exact_numbers(walk: Walk, plan: Plan | None) -> "Numbers":
    """The numbers of which a proof speaks: those of a plan as written, else as they are stored."""
    from benchdragon.proofs.exact import Numbers  # needs flint

    if plan is None:
        return Numbers.stored(walk)
    from benchdragon.analysis.written import numbers_of

    return numbers_of(plan, walk)


class Question:
    """A question to be proved about a walk: of its benches, with a margin, m, or of an obstacle.

    With the plan of which the walk is built, its numbers are those that are written.
    """

    def __init__(
        self, walk: Walk, margin: float | None, obstacle: Obstacle | None, plan: Plan | None = None
    ) -> None:
        self._numbers = exact_numbers(walk, plan)
        self._walk, self._obstacle, self._plan = walk, obstacle, plan
        self._dance = self._numbers.dance(margin, () if obstacle is None else (obstacle,))
        self._guess = self._numbers.guess

    def proved(
        self, span: tuple[float, float], found: Sequence[Answer], progress: Progress,
        claims: list[Claim] | None,
    ) -> Answer | None:  # fmt: skip
        """The first contact among those that were found, proved; or that there is none."""
        from benchdragon.proofs.cover import cells

        sure = next((one for one in found if one.status == "found"), None)
        first = self._numbers.at_most(span[0])
        last = self._numbers.at_least(span[1] if sure is None else sure.upper)
        belong = self._all_belong(first)
        at = cells(self._dance, self._guess, first, last, progress) if belong else [first]
        claims = [] if claims is None else claims
        if sure is None and at[-1] == last and belong and (len(at) > 1 or self._stands_clear(first)):
            claims.append(Claim(self._about, tuple(at), *span))
            return None
        text = _("{count} cells of the head's way shown free of contact in balls of {bits} bits")
        told = (assumed(self._walk, self._plan), text.format(count=len(at) - 1, bits=BITS))
        open_still = [one for one in found if self._may_be(one, at[-1])]
        for one in open_still:
            benches = _rows(one)
            s = self._meeting(max(at[-1], self._numbers.at_least(span[0])), span[1], benches)
            if s is not None:
                lower = max(self._numbers.before(at[-1]) if len(at) > 1 else span[0], span[0])
                upper = min(self._numbers.after(s), span[1])
                claims.append(Claim(self._about, tuple(at), span[0], lower, upper, s, benches))
                value = min(max(one.value, lower), upper)
                return replace(
                    one, value=value, lower=lower, upper=upper, status="proved", assumptions=told
                )
        graze = next((one for one in open_still if one.status == "undecided"), None)
        if graze is None:
            text = N_("what was found could not be shown in ball arithmetic beyond {s} m of the route")
            raise UnsureError(text, s=f"{at[-1]:.12g}")
        value, upper = (min(time, span[1]) for time in (graze.value, graze.upper))
        return replace(graze, value=value, upper=upper, assumptions=told)

    @property
    def _about(self) -> str:
        return "" if self._obstacle is None else self._obstacle.name

    def _may_be(self, found: Answer, s: float) -> bool:
        """Whether a contact, or a graze, may come where no cell could be shown any more, at s, m."""
        lower, upper = (float(self._walk.exact_head_position(t)) for t in (found.lower, found.upper))
        return lower - MOST_SHORT <= s <= upper + MOST_SHORT and found.witness is not None

    def verify(self, claim: Claim, progress: Progress = silent) -> None:
        """Prove a claim again from its cells and its contact alone.

        Raises:
            UnsureError: naming the step that does not hold.
        """
        from benchdragon.proofs.chain import UnprovedError
        from benchdragon.proofs.cover import covered

        at = claim.cells
        self._check_cells(claim)
        if len(at) == 1 and claim.contact is not None and claim.clear == claim.start:
            self._verify_contact(claim)
            return
        if not self._all_belong(at[0]):
            raise UnsureError(_("a bench may stand at the start where none may"))
        try:
            covered(self._dance, self._guess, at, progress)
        except UnprovedError as error:
            raise UnsureError(_("it could not be shown: {error}").format(error=error)) from None
        if claim.contact is not None:
            self._verify_contact(claim)

    def _check_cells(self, claim: Claim) -> None:
        """Refuse cells that do not cover the way from the start to `clear`, or that no claim needs."""
        position, at = self._numbers.position, claim.cells
        unused = _("it has cells on which nothing rests")
        if claim.clear < claim.start:
            raise UnsureError(_("it ends before it starts"))
        if len(at) == 1 and claim.contact is not None and claim.clear == claim.start:
            if at[0] != self._numbers.at_most(claim.start):
                raise UnsureError(unused)
            return
        if not (at and position(claim.start) >= at[0]):
            raise UnsureError(_("the cells begin after the start"))
        if not position(claim.clear) <= at[-1]:
            raise UnsureError(_("the cells end before what they are to show"))
        late = claim.contact is None and len(at) > 1 and position(claim.clear) <= at[-2]
        if late or (len(at) > 1 and position(claim.start) >= at[1]):
            raise UnsureError(unused)

    def _verify_contact(self, claim: Claim) -> None:
        """Prove again that a pair has come nearer by a time."""
        position = self._numbers.position
        if claim.contact is None or claim.s is None:
            return
        within = position(claim.start) <= claim.s <= position(claim.contact)
        if not (within and self.meet(claim.s, claim.benches)):
            raise UnsureError(_("the contact could not be shown"))

    def _all_belong(self, s: float) -> bool:
        """Whether all benches are surely where they may be, inside or outside, the head at s, m."""
        from benchdragon.proofs.meeting import belongs

        chain, sizes = self._chain(s), self._dance.sizes
        return chain is not None and all(
            belongs(chain, sizes, i, standing) is True
            for standing in self._dance.standing
            for i in range(len(sizes.links))
        )

    def _stands_clear(self, s: float) -> bool:
        """Whether all keep apart with the head at route position s, m, for walks of no length."""
        from benchdragon.proofs.cells import holds

        chain = self._chain(s)
        return chain is not None and holds(self._dance, chain, chain)

    def _chain(self, s: float) -> "Chain | None":
        """The dragon with its head at s, m; None where it cannot be enclosed."""
        from benchdragon.proofs.chain import UnprovedError
        from benchdragon.proofs.cover import chain_at

        try:
            return chain_at(self._dance, self._guess, s)
        except UnprovedError:
            return None

    def _meeting(self, s: float, end: float, benches: Sequence[int]) -> float | None:
        """Where the head is, m, from s on, when both surely meet; None if not soon, and by an end."""
        at, behind, last = s, FIRST_BEHIND * max(1.0, abs(s)), self._numbers.at_most(end)
        while at <= last and not self.meet(at, benches):
            if behind > MOST_BEHIND or at == last:
                return None
            at, behind = min(s + behind, last), 4.0 * behind
        return at if at <= last else None

    def nearer_in(self, span: tuple[float, float], s: float, benches: tuple[int, ...]) -> Claim | None:
        """That two benches are nearer than the margin in a span of time, s: see `prove_nearer`."""
        numbers = self._numbers
        s = min(max(s, numbers.at_least(span[0])), numbers.at_most(span[1]))
        if not self.meet(s, benches):
            return None
        early, by = max(numbers.before(s), span[0]), min(numbers.after(s), span[1])
        return Claim(self._about, (numbers.at_most(early),), early, early, by, s, benches)

    def meet(self, s: float, benches: Sequence[int]) -> bool:
        """Whether two benches, or one and the obstacle, are surely nearer than they may be."""
        from benchdragon.proofs.apart import Moving
        from benchdragon.proofs.meeting import belongs, nearer

        chain, sizes = self._chain(s), self._dance.sizes
        if chain is None:
            return False
        if self._dance.margin is not None:
            return nearer(chain, sizes, [Moving(i) for i in benches], self._dance.margin)
        (i,) = benches
        return any(
            belongs(chain, sizes, i, standing) is False
            or any(nearer(chain, sizes, (Moving(i), side), standing.margin) for side in standing.sides)
            for standing in self._dance.standing
        )


def _rows(found: Answer) -> tuple[int, ...]:
    """The benches of an answer, from 0."""
    return () if found.witness is None else tuple(n - 1 for n in found.witness.benches)
