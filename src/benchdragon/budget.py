"""How much work and memory one question may take: counted, so that it is the same on all machines.

A question is one request of a user: a check, a size, a sheet for each bench. All that it calls counts
with it. Work is counted in handles placed on a route, or what takes as long: some millions a second.
Searches estimate what they need at least before they begin, and spend while they go on.
"""

import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from benchdragon.errors import InputError, OpenError
from benchdragon.i18n import N_, _

# Multiplies both limits.
VARIABLE, MOST_TIMES = "BENCHDRAGON_BUDGET", 1e6
# Handles placed for one question, and bytes of its tables.
WORK, MEMORY = 1_000_000_000, 600_000_000


class OverBudgetError(OpenError):
    """A question that takes more work or memory than it may: not wrong, but not answered."""


@dataclass
class Budget:
    """What a question may take, and what it has taken.

    Attributes:
        work: handles that may be placed.
        memory: bytes that tables may take.
        spent: handles placed.
    """

    work: float
    memory: float
    spent: float = 0.0


_asked: ContextVar[Budget | None] = ContextVar("asked", default=None)


def times() -> float:
    """By how much the limits are multiplied.

    Raises:
        InputError: if the variable holds no number from 0 to 1e6.
    """
    text = os.environ.get(VARIABLE, "1")
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0.0 <= number <= MOST_TIMES:
        said = _("{variable} must be a number from 0 to {most}, not {text}")
        raise InputError(said.format(variable=VARIABLE, most=f"{MOST_TIMES:g}", text=repr(text)[:80]))
    return number


@contextmanager
def question(count: int = 1) -> Iterator[None]:
    """A question, or `count` of them that share; within another question it is a part of that one."""
    if _asked.get() is not None:
        yield
        return
    share = times()
    token = _asked.set(Budget(share * WORK * count, share * MEMORY))
    try:
        yield
    finally:
        _asked.reset(token)


@contextmanager
def aside(share: float) -> Iterator[None]:
    """What an answer can do without: so large a share of a question's work at most, counted apart."""
    asked = _asked.get()
    if asked is None:
        yield
        return
    token = _asked.set(Budget(share * times() * WORK, asked.memory))
    try:
        yield
    finally:
        _asked.reset(token)


def aside_most(share: float) -> float:
    """How many handles may be placed for what an answer can do without: see `aside`."""
    return math.inf if _asked.get() is None else share * times() * WORK


def allow(share: float) -> None:
    """Let the question at hand take so large a share of a question's work from now on, if not more."""
    asked = _asked.get()
    if asked is not None:
        asked.work = max(asked.work, asked.spent + share * times() * WORK)


def spend(handles: float) -> None:
    """Count handles that were placed; nothing is counted outside of questions.

    Raises:
        OverBudgetError: if the question at hand has placed more than it may.
    """
    budget = _asked.get()
    if budget is not None:
        budget.spent += handles
        expect(0.0)


def left() -> float:
    """How many handles the question at hand may still place."""
    budget = _asked.get()
    return math.inf if budget is None else max(budget.work - budget.spent, 0.0)


def expect(handles: float) -> None:
    """Say how many handles must at least be placed, before that is begun.

    Raises:
        OverBudgetError: if the question at hand may not place so many more.
    """
    budget = _asked.get()
    if budget is None or budget.spent + handles <= budget.work:
        return
    text = N_(
        "this takes more work than a question may: at least {asked} million positions of handles, "
        "where {most} million are allowed; take fewer benches or a shorter walk (walk.start, "
        "walk.end), or allow {times} times as much on the command line by {variable}={times}"
    )
    raise _over(text, budget.spent + handles, budget.work, WORK)


def hold(size: float) -> None:
    """Say how many bytes the tables of the question at hand are to take, before they are made.

    Raises:
        OverBudgetError: if they are more than it may have.
    """
    budget = _asked.get()
    if budget is None or size <= budget.memory:
        return
    text = N_(
        "this takes more memory than a question may: at least {asked} MB, where {most} MB are "
        "allowed; take fewer benches, fewer sizes of benches or a shorter walk (walk.start, "
        "walk.end), or allow {times} times as much on the command line by {variable}={times}"
    )
    raise _over(text, size, budget.memory, MEMORY)


def memory() -> float:
    """How many bytes the tables of the question at hand may take."""
    budget = _asked.get()
    return math.inf if budget is None else budget.memory


def _over(text: str, asked: float, most: float, usual: float) -> OverBudgetError:
    """What to say of more than is allowed, and which power of ten times `usual` would allow it."""
    times = 10.0 ** max(math.ceil(math.log10(1.01 * asked / usual)), 1)
    amounts = {"asked": f"{asked / 1e6:.4g}", "most": f"{most / 1e6:.4g}"}
    return OverBudgetError(text, **amounts, variable=VARIABLE, times=f"{times:g}")
