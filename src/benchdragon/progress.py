"""How far long work is: one protocol, told by searches and writers, heard by the terminal.

Whoever passes `progress=` gets calls progress(share, text): the share of the work that is done, 0 to 1
and never less than before, and what is being done; an empty text leaves that as it was.
"""

from collections.abc import Callable

Progress = Callable[[float, str], None]


def silent(_share: float, _text: str) -> None:
    """Nobody listens."""


def part(progress: Progress, start: float, end: float, text: str = "") -> Progress:
    """The progress of a part of the work, from one share of the whole to another.

    While the part itself says nothing, `text` is said.
    """

    def told(share: float, said: str) -> None:
        progress(start + (end - start) * share, said or text)

    return told


class Stages:
    """Work in so many stages, one after another, each taken to last as long as the others."""

    def __init__(self, progress: Progress, count: int) -> None:
        self._progress, self._count, self._done = progress, count, 0

    def __call__(self, text: str) -> Progress:
        """Begin the next stage: its progress."""
        stage = part(self._progress, self._done / self._count, (self._done + 1) / self._count, text)
        self._done += 1
        stage(0.0, "")
        return stage
