"""Questions and proofs of a check that stay undecided, because of too much work or of rounding."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from benchdragon import budget
from benchdragon.analysis.findings import Finding, name_words
from benchdragon.analysis.speed import QUANTITIES, fastest_handle
from benchdragon.budget import OverBudgetError
from benchdragon.errors import OpenError, UnsureError
from benchdragon.i18n import N_, _
from benchdragon.model.answer import ROUNDING, Answer, Witness
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk

# Least work of each question after that of contact, as a share of a question's work.
REST = 0.25
# Reasons for an undecided question.
DEAR, HIDDEN = N_("that takes more work than a question may"), N_("rounding hides it")

# Names of what can be proved, for texts.
PROOFS = {
    "contact": N_("whether and when benches touch"),
    "clearance": N_("least clearance"),
    "speed": N_("greatest speed"),
}

# The subject of a question: an obstacle, a level of room, or a limited quantity, by name.
Asked = Obstacle | str


@dataclass(frozen=True)
class Unproved:
    """An answer whose proof failed: it stays as found.

    Attributes:
        kind: what, one of PROOFS.
        why: how its proof failed.
    """

    kind: str
    why: OpenError

    @property
    def text(self) -> str:
        """Both in a sentence, in the language in use."""
        return _("not proved: {what}: {why}").format(what=_(PROOFS[self.kind]), why=self.why)


@contextmanager
def told_if_open(
    found: list[Finding], asked: Asked | None = None, limit: float = 0.0
) -> Iterator[None]:
    """Answer a question with its own share of work; if it stays undecided, add a finding to `found`.

    The finding is added only if the verdict needs it, that is with `asked`. `limit` is that of a
    limited quantity, in SI units.
    """
    budget.allow(REST)
    try:
        yield
    except (OverBudgetError, UnsureError) as error:
        budget.allow(REST)  # for what is known without a search
        if asked is not None:
            found.append(
                open_finding(asked, limit, DEAR if isinstance(error, OverBudgetError) else HIDDEN)
            )


def open_finding(asked: Asked, limit: float, why: str) -> Finding:
    """The finding of an undecided question; of a limited quantity with its limit."""
    if isinstance(asked, Obstacle):
        sentence = N_("whether benches keep their distance from {name} is undecided: {why}")
        kind, words = "venue" if asked.kind == "venue" else "obstacle", name_words(asked)
        limit, name = asked.margin, asked.name
    elif asked in QUANTITIES:
        sentence = N_("whether the {what} keeps to {limit} {unit} is undecided: {why}")
        quantity, kind, name = QUANTITIES[asked], asked, ""
        words = {"what": quantity.text, "unit": quantity.unit, "limit": f"{limit:.6g}"}
    else:
        sentence = N_("whether there is room for people is undecided: {why}")
        kind, words, name = asked, {}, ""
    words |= {"why": why}
    return Finding(kind, None, (), 0.0, limit, sentence, words, decided=False, obstacle=name)


def speed_at_start(walk: Walk, start: float) -> Answer:
    """The greatest speed of a handle known without a search, m/s: that at the start, s."""
    motion = walk.motion([start])
    row = fastest_handle(motion.speed_ratio[0])
    value, point = float(motion.speed[0, row]), (float(motion.x[0, row]), float(motion.y[0, row]))
    bench = min(row + 1, len(walk.dragon))
    witness = Witness(start, float(motion.head_s[0]), (bench,), point, float("nan"), handle=row)
    return Answer(value, value * (1.0 - ROUNDING), float("inf"), "m/s", "undecided", witness)
