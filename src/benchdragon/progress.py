"""Progress of long work: one protocol from searches and writers to the terminal.

`progress=` is called as progress(share, text): the share of the work that is done, 0 to 1 and never
less than before, and the step at work; an empty text keeps the last one.
"""

from collections.abc import Callable

Progress = Callable[[float, str], None]
# Begins the next stage, which is called so: its progress.
Stage = Callable[[str], Progress]


def silent(_share: float, _text: str) -> None:
    """Ignore all progress."""


def part(progress: Progress, start: float, end: float, text: str = "") -> Progress:
    """The progress of a part of the work, from one share of the whole to another.

    While the part itself says nothing, `text` is said.
    """

    def told(share: float, said: str) -> None:
        progress(start + (end - start) * share, said or text)

    return told


def stages(progress: Progress, count: int) -> Stage:
    """Work in so many stages, one after another, each taken to last as long as the others."""
    done = 0

    def begun(text: str) -> Progress:
        nonlocal done
        stage = part(progress, done / count, (done + 1) / count, text)
        done += 1
        stage(0.0, "")
        return stage

    return begun
