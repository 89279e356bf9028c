"""What all questions that the engine holds have in common: first figures, and exit statuses of steps.

A host knows a question by a handle (kernels/memory.py). It steps until the question is answered, and
closes it in any case.
"""

from benchdragon.kernels.entries import entry
from benchdragon.kernels.memory import forget, release_block
from benchdragon.kernels.numbered import Numbered


class Told(Numbered):
    """The first figures of each question, a row of floats; those of its own begin at TOLD."""

    SPENT = 0  # work of the latest step, in handles placed
    WANTED = 1  # bytes that tables would take, if those are too many


TOLD = len(Told)


class QuestionEnding(Numbered):
    """Exit statuses of steps of any question, besides its own."""

    MORE = 8  # call again
    OVER_MEMORY = 20  # tables would take more bytes than allowed
    OUT_OF_MEMORY = 21
    CLOSED = 22  # there is no such question, or nothing is sought


@entry
def close_question(handle: int) -> bool:
    """Close a question and release its memory; False if there is no such question, or not any more."""
    block = forget(handle)
    if block == 0:
        return False
    release_block(block)
    return True
