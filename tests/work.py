"""What workers do in tests: a module of its own, which they import without pytest."""

import os
import signal
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchdragon import parallel
from benchdragon.errors import InputError
from benchdragon.i18n import _, language
from benchdragon.parallel import threads
from benchdragon.plans.schema import read_plan
from benchdragon.sweeps import folder
from benchdragon.sweeps.sweep import Sweep, sweep


def double(items: Sequence[int]) -> list[int]:
    return [2 * item for item in items]


def spoken(items: Sequence[int]) -> list[str]:
    return [f"{language()}: {_('number of benches')}" for _item in items]


def refuse(items: Sequence[int]) -> None:
    raise InputError(f"not {items[0]}")


def refuse_plan(items: Sequence[int]) -> None:
    read_plan("spiral-in", ["route.pitch=-1"])


def divide(items: Sequence[int]) -> None:
    print(1 / items[0])


@dataclass(frozen=True)
class Poison:
    """Doubles numbers, but dies of one: each time, or once if a flag's file tells that."""

    of: int
    flag: Path | None = None

    def __call__(self, items: Sequence[int]) -> list[int]:
        if self.of in items and self._deadly():
            os.kill(os.getpid(), signal.SIGKILL)
        return double(items)

    def _deadly(self) -> bool:
        if self.flag is None:
            return True
        try:
            self.flag.touch(exist_ok=False)
        except FileExistsError:
            return False
        return True


@dataclass(frozen=True)
class Stuck:
    """Gives the first item back; leaves its number in a folder and never ends over any other."""

    folder: Path

    def __call__(self, items: Sequence[int]) -> list[int]:
        if items[0]:
            (self.folder / str(os.getpid())).touch()
            threading.Event().wait()
        return list(items)


# A quick sweep with answers of every kind: contacts, clear dances, refused plans, folded benches.
VARY: dict[str, list[float | int | str]] = {
    "route.pitch": [-1, 0.2, *[n / 100 for n in range(45, 60)]],
    "disc.radius": [0.5, 1.0, 2.0, 3.0, 4.5],
}
ASKED = ["first_contact", "greatest_speed"]


def swept(output: Path | None = None, executor: Any = None, **named: Any) -> Sweep:
    """A short sweep; in this thread, if no executor is given."""
    plan = read_plan("spiral-in", ["dragon.benches=8"])
    return sweep(plan, VARY, ASKED, output=output, executor=executor or threads(1), **named)


# Parts that are written before a sweep waits for its end, and points of each.
PARTS, OF_A_PART = 3, 2


def sweep_in_small_parts(output: Path) -> None:
    """The same, each block a part of its own; after some of them it waits until it is killed."""
    parallel.MOST_BLOCK, folder.EACH_SECONDS, folder.EACH_SHARE = OF_A_PART, 0.0, 0.0
    written = 0

    def wait(_share: float, _text: str) -> None:
        nonlocal written
        written += 1
        if written == PARTS:
            threading.Event().wait()

    swept(output, progress=wait)
