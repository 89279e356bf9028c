"""The questions that a sweep may ask of each of its plans, and their outcomes."""

import math
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from benchdragon.analysis.contact import first_contact, least_clearance
from benchdragon.analysis.speed import greatest_speed
from benchdragon.budget import OverBudgetError
from benchdragon.errors import (
    BenchDragonError,
    InputError,
    MachineError,
    MissingExtraError,
    NoSolutionError,
    UnsureError,
    WalkError,
    brief,
    of_kind,
    whole,
)
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.plans.schema import Plan
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, MOST_DRAWS, Deviations, Draw, chance, touches
from benchdragon.solve.turn import best_turn

# Beside the status of an answer: no benches touch; the dragon cannot walk; such a plan cannot be; the
# worker was lost, or its memory ran out, each time.
CLEAR, UNWALKABLE, REFUSED, LOST = "clear", "unwalkable", "refused", "lost"
# Texts for readers.
STATES = {
    "found": N_("found"),
    "proved": N_("proved"),
    "unlimited": N_("unlimited"),
    "infeasible": N_("no solution"),
    "undecided": N_("undecided"),
    CLEAR: N_("no contact"),
    UNWALKABLE: N_("cannot be walked"),
    REFUSED: N_("cannot be"),
    LOST: N_("lost"),
}


@dataclass(frozen=True)
class RandomDances:
    """The dances that `tolerance` walks: how many, how far from exact, and their seed.

    Examples:
        >>> bd.RandomDances(draws=10, deviations=bd.Deviations(0.01)).seed
        1
    """

    draws: int = 100
    deviations: Deviations = field(default_factory=lambda: CASES["all"].deviations)
    seed: int = 1

    def __post_init__(self) -> None:
        """Check them.

        Raises:
            InputError: for numbers out of range, or of another kind.
        """
        object.__setattr__(self, "draws", whole("draws", self.draws, 1, MOST_DRAWS))
        of_kind("deviations", self.deviations, Deviations)
        object.__setattr__(self, "seed", whole("seed", self.seed, 0, 2**63 - 1))


@dataclass(frozen=True)
class Question:
    """A question about a plan.

    Attributes:
        name: what the command line and the columns call it.
        text: what it is, in words.
        unit: of its answer; of a turn's, that of a length.
        ask: answers it; None where no benches touch.
    """

    name: str
    text: str
    unit: str
    ask: Callable[[Plan, RandomDances], Answer | None]


@dataclass(frozen=True)
class Outcome:
    """The outcome of a question about one plan: an answer, or why there is none."""

    status: str
    answer: Answer | None = None
    message: str | None = None
    seconds: float = 0.0
    clear_until: float = math.nan


def _first_contact(plan: Plan, _dances: RandomDances) -> Answer | None:
    walk = plan.build()
    return first_contact(walk, *plan.span(walk), margin=plan.limits.margin)


def _clearance(plan: Plan, _dances: RandomDances) -> Answer | None:
    walk = plan.build()
    found = least_clearance(walk, *plan.span(walk))
    return found if math.isfinite(found.value) else None  # no two benches are non-adjacent


def _greatest_speed(plan: Plan, _dances: RandomDances) -> Answer:
    walk = plan.build()
    return greatest_speed(walk, *plan.span(walk))


def _tolerance(plan: Plan, dances: RandomDances) -> Answer:
    """The share of random dances in which benches touch, with its bounds at 95 %."""
    plan.build()  # invalid plans raise an error and are not counted
    hits = sum(
        touches(plan, Draw(dances.deviations, dances.seed, number)) for number in range(dances.draws)
    )
    share, low, high = chance(hits, dances.draws)
    return Answer(share, low, high, "", "found", evaluations=dances.draws)


def _limit(name: str) -> Callable[[Plan, RandomDances], Answer]:
    return lambda plan, _dances: limit(plan, name)


QUESTIONS = {
    question.name: question
    for question in (
        Question("first_contact", N_("first contact"), "s", _first_contact),
        Question("clearance", N_("least clearance"), "m", _clearance),
        Question("greatest_speed", N_("greatest speed of any handle"), "m/s", _greatest_speed),
        Question(
            "greatest_head_speed",
            N_("greatest head speed"),
            "m/s",
            lambda plan, _dances: greatest_head_speed(plan),
        ),
        Question("smallest_pitch", N_("smallest pitch"), "m", _limit("pitch")),
        Question("disc", N_("smallest disc radius"), "m", _limit("disc")),
        Question("width", N_("widest bench"), "m", _limit("width")),
        Question("length", N_("longest bench"), "m", _limit("length")),
        Question("tolerance", N_("share of random dances in which benches touch"), "", _tolerance),
        Question("turn", N_("best turn"), "m", lambda plan, _dances: best_turn(plan).objective),
    )
}


def questions(names: Sequence[str]) -> list[Question]:
    """The questions of these names.

    Raises:
        InputError: for an unknown name, one that stands twice, or none at all.
    """
    known = isinstance(names, list | tuple) and all(
        isinstance(name, str) and name in QUESTIONS for name in names
    )
    if not known or not names or len(set(names)) < len(names):
        text = _("ask: expected some of {known}, each once, not {names}")
        raise InputError(text.format(known=", ".join(QUESTIONS), names=brief(names)))
    return [QUESTIONS[name] for name in names]


def outcome(question: Question, plan: Plan, dances: RandomDances) -> Outcome:
    """The outcome of a question about a plan."""
    began = clock.perf_counter()
    status, answer, message, until = CLEAR, None, None, math.nan
    try:
        answer = question.ask(plan, dances)
        if answer is not None:
            status = answer.status
        elif question.unit == "s":
            until = plan.span(plan.build())[1]
    except WalkError as error:
        status, message = UNWALKABLE, str(error)
    except NoSolutionError as error:
        status, message = "infeasible", str(error)
    except (UnsureError, OverBudgetError) as error:
        status, message = "undecided", str(error)
    except MemoryError:
        status, message = LOST, _("memory ran out")
    except (MachineError, MissingExtraError):
        raise  # the plan is not to blame
    except BenchDragonError as error:
        status, message = REFUSED, str(error)
    return Outcome(status, answer, message, clock.perf_counter() - began, until)
