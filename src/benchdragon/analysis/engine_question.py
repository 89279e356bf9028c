"""Questions that the engine holds: stepped until they are answered, within what a question may take."""

import threading
import weakref
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self

from benchdragon import budget
from benchdragon.kernels import question as kernel
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.question import QuestionEnding, Told


def _closed(handle: int, thread: int) -> None:
    """Close a question; only the thread that opened it may do so."""
    if threading.get_ident() == thread:
        kernel.close_question(handle)


class EngineQuestion:
    """A question that the engine holds until it is closed, by `with` or by garbage collection.

    Args:
        handle: what its entry `open` gave.
        step: its entry that continues: of the handle, the work allowed, and further arguments.
        read: its entry that fills arrays with the results so far.
        told: the arrays that `read` fills; the first begins as kernels/question.py says.

    Raises:
        MemoryError: if it could not be opened.
    """

    def __init__(
        self, handle: int, step: Callable[..., int], read: Callable[..., bool], *told: Any
    ) -> None:
        if not handle:
            raise MemoryError
        self._handle, self._step, self._read, self._told = handle, step, read, told
        self._close = weakref.finalize(self, _closed, handle, threading.get_ident())

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Release the engine's memory of the question; results stay."""
        self._close()

    @property
    def figures(self) -> FloatArray:
        """The figures that the engine reports."""
        figures: FloatArray = self._told[0]
        return figures

    def tell(self, *columns: int) -> list[float]:
        """Some of the engine's figures."""
        told: list[float] = self.figures[list(columns)].tolist()
        return told

    def rest(self) -> None:
        """Yield, so that a page can handle events between steps."""

    def step(self, *said: float) -> int:
        """Continue for some hundredths of a second; return the exit status.

        Raises:
            OverBudgetError: if it takes more than the question at hand may.
            MemoryError: if there is no memory.
            ValueError: if it was closed.
        """
        ending = self._step(self._handle, budget.left(), *said)
        self._read(self._handle, *self._told)
        if ending == QuestionEnding.CLOSED:
            raise ValueError("this question was closed")
        budget.spend(self.figures[Told.SPENT])
        if ending == QuestionEnding.OVER_MEMORY:
            budget.hold(self.figures[Told.WANTED])
        if ending in (QuestionEnding.OVER_MEMORY, QuestionEnding.OUT_OF_MEMORY):
            raise MemoryError
        return ending
