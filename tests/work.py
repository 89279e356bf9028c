"""What workers do in tests: a module of its own, which they import without pytest."""

import os
import signal
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from benchdragon.errors import InputError
from benchdragon.i18n import _, language


def double(items: Sequence[int]) -> list[int]:
    return [2 * item for item in items]


def spoken(items: Sequence[int]) -> list[str]:
    return [f"{language()}: {_('number of benches')}" for _item in items]


def refuse(items: Sequence[int]) -> None:
    raise InputError(f"not {items[0]}")


def refuse_plan(items: Sequence[int]) -> None:
    from benchdragon.plans.schema import read_plan  # slow to import, for each worker

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
