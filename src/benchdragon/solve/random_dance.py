"""The engine's question about a dance whose people are not exact: kernels/random_dance_question.py."""

import numpy as np

from benchdragon import budget
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.analysis.tables import in_columns
from benchdragon.errors import InputError, UnsureError, in_order
from benchdragon.i18n import _
from benchdragon.kernels import random_dance_memory as told
from benchdragon.kernels import random_dance_question as kernel
from benchdragon.kernels.question import QuestionEnding
from benchdragon.kernels.random_dance_memory import DanceGiven, DanceSought, DanceTold
from benchdragon.kernels.random_dance_question import DanceEnding
from benchdragon.plans.schema import Plan
from benchdragon.solve.size_family import QUESTIONS, PlanFamily, kernel_family


def answered(plan: Plan, limits: dict[int, float]) -> float:
    """The engine's answer about a dance; `limits`: those of kernels/random_dance_memory.py that vary.

    Raises:
        WalkError: where the exact dragon cannot stand at the start.
        InputError: for a walk or a dragon that is too long, or benches that cannot be.
        UnsureError: where no pitch was found near the guess.
    """
    walk = plan.build()
    start, end = plan.span(walk)
    in_order(start, end)
    first, last = walk.head_position([start, end]).tolist()
    name = "pitch" if limits[DanceGiven.WHAT] == DanceSought.NEEDED else "width"
    family, laid = kernel_family(PlanFamily(plan, QUESTIONS[name], 0.0), walk)
    known = {
        DanceGiven.MARGIN: plan.limits.margin, DanceGiven.FIRST: first, DanceGiven.LAST: last,
        DanceGiven.BYTES: budget.memory(), **limits,
    }  # fmt: skip
    handle = kernel.open_dance(family, laid, in_columns(known))
    figures, ending = np.zeros(told.DANCE_FIGURES), QuestionEnding.MORE
    with EngineQuestion(handle, kernel.step_dance, kernel.read_dance, figures) as question:
        while ending == QuestionEnding.MORE:
            ending = question.step()
    refuse(ending, limits[DanceGiven.GUESS], int(limits[DanceGiven.DANCE]) + 1)
    return float(figures[DanceTold.RESULT])


def refuse(ending: int, guess: float, number: int) -> None:
    """Raise the error of a dance, by its number from 1, whose question was not answered."""
    if ending == DanceEnding.TOO_LONG:
        raise InputError(_("the walk is too long, or the dragon, for random dances"))
    if ending == DanceEnding.NO_BENCH:
        text = _("dance {number} has a bench that cannot be; make the deviations smaller")
        raise InputError(text.format(number=number))
    if ending == DanceEnding.NOT_FOUND:
        text = _("no pitch near {guess} m was found with which dance {number} is just free of contact")
        raise UnsureError(text.format(guess=f"{guess:.4g}", number=number))
