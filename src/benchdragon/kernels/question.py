"""What all questions that the engine holds have in common: what they tell of themselves, how steps end.

A host knows a question by a handle (kernels/memory.py). It steps until the question has come to
something, and closes it in any case.
"""

from benchdragon.kernels.entries import entry
from benchdragon.kernels.memory import forget, release_block
from benchdragon.kernels.numbered import Numbered


class Told(Numbered):
    """What each question tells first, in a row of floats; from TOLD on is what is its own."""

    SPENT = 0  # in the step before, in handles placed
    WANTED = 1  # bytes, where tables would take more than they may


TOLD = len(Told)


class QuestionEnding(Numbered):
    """How steps of any question end, besides what each comes to."""

    MORE = 8  # to be called again
    OVER_MEMORY = 20  # WANTED says how much it would take
    OUT_OF_MEMORY = 21
    CLOSED = 22  # there is no such question, or nothing is sought


@entry
def close_question(handle: int) -> bool:
    """Give a question back; False if there is no such question, or not any more."""
    block = forget(handle)
    if block == 0:
        return False
    release_block(block)
    return True
