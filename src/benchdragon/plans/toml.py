"""The text of plan files: TOML read and overlaid with settings, before validation.

Light to import, so that the command line can see how large a job is before it loads the kernels.
"""

import re
import stat
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchdragon.errors import BenchDragonError, brief, did_you_mean, reason
from benchdragon.i18n import N_, _
from benchdragon.plans.digits import number, rounded_numbers
from benchdragon.plans.idle import drop_replaced
from benchdragon.plans.signs import mistyped
from benchdragon.plans.source import Source
from benchdragon.plans.units import QUANTITY, UNITS

BUILT_IN_FOLDER = Path(__file__).parent / "builtin"
# The contest's plans, which are named before the villages'.
CONTEST = ("spiral-in", "turn", "question-3")
SUFFIX = ".dragon.toml"
# Bytes: anything larger is not a plan.
MOST_BYTES = 20_000_000
# Keys and tables of a text, by the signs that begin them, and entries of lists: reading them takes a
# kilobyte of each. 80,000 benches fit, each of four sizes of its own.
MOST_KEYS, MOST_ENTRIES = 500_000, 1_000_000

# Tables within tables by dotted keys, and digits of a number to another base than 10: with more the
# parser takes minutes, or its result cannot be shown. They are matched only from where words begin, so
# that any text is scanned once.
MOST_DEPTH, MOST_DIGITS = 30, 200
WORD = r"""(?:[A-Za-z0-9_-]++|"(?:\\.|[^"\\\n])*+"|'[^'\n]*+')[ \t]*+"""
DEEP = re.compile(rf"(?<![\\A-Za-z0-9_-])(?:{WORD}\.[ \t]*+){{{MOST_DEPTH}}}")
LONG = re.compile(rf"(?<![A-Za-z0-9_])0[box][0-9A-Fa-f_]{{{MOST_DIGITS}}}")
# "KEY=VALUE", or a key and its value.
Setting = str | tuple[str, object]
# Bases that stand on one another.
MOST_BASES = 8

# What some editors put before the text; it says nothing.
BYTE_ORDER_MARK = "\ufeff"
TWICE = N_("[{what}] is defined twice: delete this line, and move its keys below the first [{what}]")
# What tomllib says, and what we say for it.
TOML_FAULTS = (
    ("Invalid statement", N_("a line must be KEY = VALUE, [table] or a comment")),
    (
        "Expected newline or end of document .*",
        N_(
            "something stands behind a line that is complete; a number with a unit needs quotes: "
            '"70 cm"'
        ),
    ),
    ("Expected '=' after a key .*", N_("a key needs = and a value")),
    ("Expected '.*' at the end of .*", N_("a [table] is not closed by its bracket")),
    (r"Cannot declare \((.*?),?\) twice", TWICE),
    ("Cannot overwrite a value|Duplicate inline table key .*", N_("a key is defined twice")),
    ("Cannot (?:mutate immutable|redefine) namespace .*", N_("this table is complete already")),
    ("Invalid initial character for a key part", N_("a key is expected here")),
    ("Unclosed array", N_("a list is not closed")),
    ("Unclosed inline table", N_("a table in braces is not closed")),
    (r"Unescaped '\\' in a string", N_("a backslash in a text must be doubled")),
    ("Invalid hex value|Escaped character is not .*", N_("no sign has this number")),
    ("Unterminated string", N_("a text is not closed")),
    ("(?:Found invalid|Illegal) character (.*)", N_("the sign {what} may not stand here")),
    ("Invalid date or datetime", N_("there is no such date")),
    ("Invalid value", N_("a value is expected here: a number, text in quotes, a list, true or false")),
    ("Expected (.*)", N_("{what} is expected here")),
)


class PlanError(BenchDragonError):
    """A plan that cannot be read or used: where, what was expected, and what was given.

    Examples:
        >>> bd.read_plan("spiral-in", {"route.pitch": -1.0})
        Traceback (most recent call last):
            ...
        benchdragon.plans.toml.PlanError: settings: route.pitch: expected more than 0.0, not -1.0
    """

    exit_code = 3


def built_in_names() -> list[str]:
    """Names of the plans that come with the program, the contest's first."""
    names = sorted(path.name.removesuffix(SUFFIX) for path in BUILT_IN_FOLDER.glob(f"*{SUFFIX}"))
    return [*CONTEST, *(name for name in names if name not in CONTEST)]


def read_toml(source: str, settings: Sequence[Setting] = ()) -> tuple[dict[str, Any], Source]:
    """The tables of a plan file or of a built-in name, with settings laid over them.

    And where they were read.

    Where a setting chooses another kind, family, profile or list of benches, what the file says for
    the former choice goes with it.

    Raises:
        PlanError: for what is not there, not TOML, or cannot be set.
    """
    path, text = _path(source), read_text(source)
    data = with_base(parsed(text, source), path.parent, source)
    keys = lay_over(data, settings)
    rounded = rounded_numbers(data, QUANTITY, UNITS)
    said = "--set" if all(isinstance(one, str) for one in settings) else "settings"
    return data, Source(source, text, keys, path.parent, rounded, set_by=said)


def read_text(source: str) -> str:
    """The text of a plan file or of a built-in plan.

    Raises:
        PlanError: for what is not there, or no text.
    """
    return _text(_path(source), source)


def _path(source: str) -> Path:
    """Where a plan file, or a built-in plan, lies."""
    return BUILT_IN_FOLDER / f"{source}{SUFFIX}" if source in built_in_names() else Path(source)


def with_base(
    data: dict[str, Any], folder: Path | None, source: str, since: tuple[str, ...] = ()
) -> dict[str, Any]:
    """The tables of a plan laid over those of the plan that its `base` names; all, if it has none.

    A table of another kind replaces that of the base, obstacles are added to the base's, and other
    lists and values replace the base's.

    Args:
        data: tables of a plan.
        folder: where a base that is a file must lie; None: only built-in plans are bases.
        source: name of the plan, in errors.
        since: names of the plans that have this one as their base.

    Raises:
        PlanError: for a base that cannot be read, or bases in a circle.
    """
    own = dict(data)
    if "base" not in own:
        return own
    below = _below(own.pop("base"), folder, source, (*since, source))
    merged, keys = _merged(below, own)
    drop_replaced(merged, keys)
    return merged


def _below(base: Any, folder: Path | None, source: str, chain: tuple[str, ...]) -> dict[str, Any]:
    """The tables of a base."""
    path = _base_path(base, folder, source)
    if base in chain or len(chain) > MOST_BASES:
        text = _("{source}: base = {base} comes back to itself, or is the {most}th base in a row")
        raise PlanError(text.format(source=source, base=brief(base), most=MOST_BASES))
    return with_base(parsed(_text(path, base), base), path.parent, base, chain)


def _base_path(base: object, folder: Path | None, source: str) -> Path:
    """Where a base lies: a built-in plan, or a file beside the plan."""
    if isinstance(base, str) and base in built_in_names():
        return BUILT_IN_FOLDER / f"{base}{SUFFIX}"
    beside = isinstance(base, str) and base.isprintable() and base == Path(base).name
    beside = beside and base not in ("", ".", "..")
    if folder is None or not isinstance(base, str) or not beside:
        text = _("{source}: base must be one of {names} or the name of a file beside it, not {base}")
        raise PlanError(text.format(source=source, names=", ".join(built_in_names()), base=brief(base)))
    return folder / base


def _merged(below: dict[str, Any], own: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """The tables of a base with a plan's own laid over them, and the keys that were laid over it."""
    merged, keys = dict(below), []
    for name, table in own.items():
        before = merged.get(name)
        if name == "obstacle" and isinstance(table, list) and isinstance(before, list):
            merged[name] = before + table
        elif isinstance(table, dict) and isinstance(before, dict) and not _another(name, before, table):
            merged[name] = {**before, **table}
            keys += [f"{name}.{key}" for key in table]
        else:
            merged[name] = table
            keys += [f"{name}.{key}" for key in (*table, "kind")] if isinstance(table, dict) else []
    return merged, keys


def _kind(table: dict[str, Any]) -> object:
    """The kind of a route that a table says, or that its parts do."""
    return "parts" if "part" in table else table.get("kind")


def _another(name: str, before: dict[str, Any], table: dict[str, Any]) -> bool:
    """Whether a table replaces that of the base as a whole: another kind of route, another venue."""
    own, below = _kind(table), _kind(before)
    return name == "venue" or own not in (None, below)


def lay_over(data: dict[str, Any], settings: Sequence[Setting]) -> tuple[str, ...]:
    """Lay settings over a plan's tables; the keys that they name.

    Raises:
        PlanError: for what cannot be set.
    """
    keys = tuple(_lay_over(data, setting) for setting in settings)
    drop_replaced(data, keys)
    return keys


def _text(path: Path, source: str) -> str:
    try:
        about = path.stat()
        if not stat.S_ISREG(about.st_mode):
            raise PlanError(_("{source} is no file that could be a plan").format(source=source))
        if about.st_size > MOST_BYTES:
            raise PlanError(
                _("{source} is too large for a plan: {size} MB, at most {most} MB are read").format(
                    source=source, size=about.st_size // 1_000_000, most=MOST_BYTES // 1_000_000
                )
            )
        return path.read_text(encoding="utf-8").removeprefix(BYTE_ORDER_MARK)
    except FileNotFoundError:
        files = [str(one) for one in sorted(path.parent.glob(f"*{SUFFIX}"))]
        bare = source.removesuffix(".toml").removesuffix(".dragon")
        hint = did_you_mean(bare, [*built_in_names(), *files])
        text = _("there is no plan {source}: expected a {suffix} file or one of {names}")
        raise PlanError(
            text.format(source=source, suffix=SUFFIX, names=", ".join(built_in_names())) + hint
        ) from None
    except UnicodeDecodeError:
        text = _("{source} is not UTF-8 text: save it again with the encoding UTF-8")
        raise PlanError(text.format(source=source)) from None
    except OSError as error:
        raise PlanError(f"{source}: {reason(error)}") from None


def parsed(text: str, source: str) -> dict[str, Any]:
    """The tables in the text of a plan file; `source` is named in errors.

    Raises:
        PlanError: for what is not TOML.
    """
    try:
        return _loaded(text.removeprefix(BYTE_ORDER_MARK), source)
    except tomllib.TOMLDecodeError as error:
        said = _("{source} is not TOML: {fault}")
        raise PlanError(said.format(source=source, fault=toml_fault(error, text))) from None


def _loaded(text: str, source: str) -> dict[str, Any]:
    """TOML, or its own error, or a PlanError for what Python refuses to hold."""
    if sum(map(text.count, "=[{")) > MOST_KEYS or text.count(",") > MOST_ENTRIES:
        wanted = _(
            "{source} is too long for a plan: at most {keys} keys and {entries} entries are read"
        )
        raise PlanError(wanted.format(source=source, keys=MOST_KEYS, entries=MOST_ENTRIES))
    if DEEP.search(text):
        raise PlanError(_("{source} is nested too deeply").format(source=source))
    if LONG.search(text):
        raise PlanError(_("{source}: a number has too many digits").format(source=source))
    try:
        return tomllib.loads(text, parse_float=number)
    except RecursionError:
        raise PlanError(_("{source} is nested too deeply").format(source=source)) from None
    except tomllib.TOMLDecodeError:
        raise
    except ValueError:
        raise PlanError(_("{source}: a number has too many digits").format(source=source)) from None


def toml_fault(error: tomllib.TOMLDecodeError, text: str = "") -> str:
    """Where a text is not TOML, and why, in the language in use.

    A sign of a Chinese input method where it broke off is named, with what to type instead.
    """
    said, _at, place = str(error).removesuffix(")").rpartition(" (at ")
    found = ((match, told) for pattern, told in TOML_FAULTS if (match := re.fullmatch(pattern, said)))
    match, told = next(found, (None, N_("this cannot be read")))
    what = match[1] if match and match.re.groups else ""
    if told == TWICE:  # Python's tuple of the parts of its name
        what = ".".join(re.findall(r"'(.*?)'", what))
    fault = _(told).format(what=what)
    numbers, lines = [int(number) for number in re.findall(r"\d+", place)], text.split("\n")
    for line in numbers[:1] or range(1, len(lines) + 1):
        typed = mistyped(lines[line - 1]) if line <= len(lines) else None
        if typed is not None:
            return _(
                "line {line}, column {column}: {sign} stands there; type {plain} instead, with the "
                "keyboard set to English"
            ).format(line=line, column=typed[0], sign=typed[1], plain=typed[2])
    if not numbers:
        return _("at its end: {fault}").format(fault=fault)
    return _("line {line}, column {column}: {fault}").format(
        line=numbers[0], column=numbers[1], fault=fault
    )


def _lay_over(data: dict[str, Any], setting: Setting) -> str:
    """Set what a setting says; the key that it names."""
    if isinstance(setting, tuple) and isinstance(setting[0], str):
        set_value(data, *setting)
        return setting[0]
    key, equals, text = setting.partition("=") if isinstance(setting, str) else ("", "", "")
    if key.count(".") >= MOST_DEPTH:
        raise PlanError(_("{source} is nested too deeply").format(source=brief(key)))
    if not equals or not key.strip():
        raise PlanError(_("expected KEY=VALUE, not {text}").format(text=brief(setting)))
    try:
        value = _loaded(f"value = {text}", key)["value"]
    except tomllib.TOMLDecodeError:
        value = text
    set_value(data, key.strip(), value)
    return key.strip()


def set_value(data: dict[str, Any], key: str, value: object) -> None:
    """Set the value under a dotted key, in which the parts of a list have numbers from 0.

    Raises:
        PlanError: where no value can stand.
    """
    at: Any = data
    names = key.split(".")
    for name in names[:-1]:
        slot = _slot(at, name, key)
        at = at[slot] if isinstance(at, list) else at.setdefault(slot, {})
        if not isinstance(at, dict | list):
            raise _nowhere(key)
    at[_slot(at, names[-1], key)] = _plain(value)


def _plain(value: object) -> object:
    """A value, or what an array or a number of NumPy's holds."""
    return value.tolist() if hasattr(value, "tolist") else value


def _slot(at: Any, name: str, key: str) -> Any:
    """The key of a table, or the place in a list."""
    if not isinstance(at, list):
        return name
    place = int(name) if re.fullmatch(r"-?[0-9]{1,9}", name) else len(at)
    if not -len(at) <= place < len(at):
        raise _nowhere(key)
    return place


def _nowhere(key: str) -> PlanError:
    return PlanError(_("there is no {key} to set").format(key=key))
