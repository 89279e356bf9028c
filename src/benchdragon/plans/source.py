"""Where a plan was read: its file and settings, the line of each key, and what is wrong under a key."""

import re
import tomllib
from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from benchdragon.errors import InputError, brief
from benchdragon.i18n import _

Built = TypeVar("Built")

# Signs of a key that are shown.
MOST_SIGNS = 200
# How many names are listed; of more only their number.
MOST_FAULTS = 20
# What may hold a bracket or a line's end that ends nothing, then brackets and ends of lines.
TOKEN = re.compile(
    r'"""(?:\\.|[^\\])*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\'|#[^\n]*|[][{}]|\n',
    re.DOTALL,
)


@dataclass(frozen=True)
class Fault:
    """What is wrong under a dotted key of a plan; "" is the whole plan."""

    key: str
    text: str

    def __str__(self) -> str:
        said = self.text if self.text.startswith(self.key) else f"{self.key}: {self.text}"
        if len(self.key) > MOST_SIGNS:
            said = said.replace(self.key, f"{self.key[:MOST_SIGNS]}...")
        return said


class KeyedError(InputError):
    """What is wrong with a plan when it is built."""

    def __init__(self, faults: Sequence[Fault]) -> None:
        super().__init__("\n".join(str(fault) for fault in faults))
        self.faults = list(faults)


class Faults:
    """Gathers what is wrong while parts of a plan are built, so that all can be said at once."""

    def __init__(self) -> None:
        self.found: list[Fault] = []

    def tried(self, key: str, make: Callable[[], Built]) -> Built | None:
        """What `make` makes of the key; None, and a fault, where it cannot."""
        try:
            return make()
        except KeyedError as error:
            self.found += error.faults
        except InputError as error:
            self.found.append(Fault(key, str(error)))
        return None


@dataclass(frozen=True)
class Source:
    """Where a plan was read, which says nothing about what it is: all are equal.

    Args:
        name: of the file, or of a built-in plan.
        text: of the file, without which lines have no numbers.
        settings: keys that were set besides, on the command line or in Python.
        set_by: where they were set, as errors say it.
        folder: of the file, in which others that the plan names lie; None: nothing lies beside it.
        rounded: numbers that the plan holds rounded: as written, and as held.
        passed: what was passed over in drawings that the plan names, a sentence each.
    """

    name: str = field(default="plan", compare=False)
    text: str = field(default="", compare=False, repr=False)
    settings: tuple[str, ...] = field(default=(), compare=False)
    folder: Path | None = field(default=None, compare=False)
    rounded: Sequence[tuple[str, str]] = field(default=(), compare=False)
    passed: Sequence[str] = field(default=(), compare=False)
    set_by: str = field(default="--set", compare=False)

    def sentences(self, faults: Sequence[Fault], others: int = 0) -> str:
        """What is wrong, a line each, with its place; `others` are too many to be listed."""
        told, more = faults[:MOST_FAULTS], len(faults[MOST_FAULTS:]) + others
        lines = lines_of(self.text, {fault.key for fault in told})
        said = [f"{_place(self, fault.key, lines)}: {fault}" for fault in told]
        if more:
            said.append(_("and {count} more").format(count=more))
        return "\n".join(said)

    def beside(self, name: str) -> Path:
        """Where a file lies that the plan names.

        Raises:
            InputError: where no file lies beside the plan, and for an invalid name of one.
        """
        if self.folder is None:
            raise InputError(_("this plan was not read from a file, so nothing lies beside it"))
        if name != Path(name).name or name in ("", ".", "..") or "\\" in name or "\0" in name:
            text = _("expected the name of a file beside the plan, not {name}")
            raise InputError(text.format(name=brief(name)))
        return self.folder / name


def _place(source: Source, key: str, lines: dict[str, int]) -> str:
    for setting in source.settings:
        if f"{key}.".startswith(f"{setting}.") or setting.startswith(f"{key}."):
            return source.set_by
    while key and key not in lines:
        key = key.rpartition(".")[0]
    return f"{source.name}:{lines[key]}" if key else source.name


def lines_of(text: str, wanted: Set[str] | None = None) -> dict[str, int]:
    """The line on which each dotted key of a TOML text is said, counted from 1.

    With given keys the text is read up to the last of them.
    """
    found: dict[str, int] = {}
    counts: dict[str, int] = {}
    table = ""
    for line, statement in _statements(text):
        if wanted is not None and wanted <= found.keys():
            break
        said = tomllib.loads(statement)
        if not statement.startswith("["):
            _note(said, table, line, found)
            continue
        table = ""
        while said:
            name, inner = next(iter(said.items()))
            table = f"{table}.{name}".lstrip(".")
            if isinstance(inner, list):
                counts[table] = counts.get(table, -1) + 1
            if table in counts:
                found.setdefault(table, line)
                table = f"{table}.{counts[table]}"
            said = inner[0] if isinstance(inner, list) else inner
        found.setdefault(table, line)
    return found


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Headers and pairs of a TOML text, with the line on which each begins."""
    start, line, depth, breaks = 0, 1, 0, 0
    for token in TOKEN.finditer(text + "\n"):
        sign = token[0]
        depth += (sign in "[{") - (sign in "]}") if len(sign) == 1 else 0
        breaks += sign.count("\n")
        if sign != "\n" or depth:
            continue
        statement = text[start : token.start()].strip()
        if statement and not statement.startswith("#"):
            yield line, statement
        start, line = token.end(), line + breaks
        breaks = 0


def _note(said: dict[str, Any], table: str, line: int, found: dict[str, int]) -> None:
    for name, value in said.items():
        key = f"{table}.{name}".lstrip(".")
        found[key] = line
        if isinstance(value, dict):
            _note(value, key, line, found)
