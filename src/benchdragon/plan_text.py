"""The text of plan files: TOML read and overlaid with settings, before any of it is believed.

Light to import, so that the command line can see how large a job is before it loads the kernels.
"""

import difflib
import re
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchdragon.errors import BenchDragonError
from benchdragon.messages import _

BUILT_IN_FOLDER = Path(__file__).parent / "plans"
SUFFIX = ".dragon.toml"
# Bytes: a million benches of their own sizes fit; anything larger is not a plan.
MOST_BYTES = 200_000_000


class PlanError(BenchDragonError):
    """A plan that cannot be read or used: where, what was wanted, and what came."""

    exit_code = 3


def built_in_names() -> list[str]:
    """Names of the plans that come with the program."""
    return sorted(path.name.removesuffix(SUFFIX) for path in BUILT_IN_FOLDER.glob(f"*{SUFFIX}"))


def read_toml(source: str, settings: Sequence[str] = ()) -> dict[str, Any]:
    """The tables of a plan file or of a built-in name, with "KEY=VALUE" settings laid over them.

    Raises:
        PlanError: for what is not there, not TOML, or cannot be set.
    """
    path = Path(source)
    if source in built_in_names():
        path = BUILT_IN_FOLDER / f"{source}{SUFFIX}"
    data = _parsed(path, source)
    for setting in settings:
        _lay_over(data, setting)
    return data


def bench_count(data: dict[str, Any]) -> int | None:
    """How many benches the tables ask for, or None where only the full check can tell."""
    dragon = data.get("dragon", {})
    if not isinstance(dragon, dict) or "bench" in dragon:
        return None
    count = dragon.get("benches", 223)
    return count if isinstance(count, int) else None


def _parsed(path: Path, source: str) -> dict[str, Any]:
    try:
        if path.stat().st_size > MOST_BYTES:
            raise PlanError(_("{source} is too large for a plan").format(source=source))
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        near = difflib.get_close_matches(source, built_in_names(), 1)
        hint = _("; did you mean {name}?").format(name=near[0]) if near else ""
        raise PlanError(
            _("there is no plan {source}: wanted a {suffix} file or one of {names}").format(
                source=source, suffix=SUFFIX, names=", ".join(built_in_names())
            )
            + hint
        ) from None
    except UnicodeDecodeError:
        raise PlanError(_("{source} is not UTF-8 text").format(source=source)) from None
    except OSError as error:
        raise PlanError(f"{source}: {error.strerror}") from None
    return parsed(text, source)


def parsed(text: str, source: str) -> dict[str, Any]:
    """The tables in the text of a plan file; `source` is named in errors.

    Raises:
        PlanError: for what is not TOML.
    """
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise PlanError(_("{source} is nested too deeply").format(source=source)) from None
    except tomllib.TOMLDecodeError as error:
        raise PlanError(_("{source} is not TOML: {error}").format(source=source, error=error)) from None


def _lay_over(data: dict[str, Any], setting: str) -> None:
    key, equals, text = setting.partition("=")
    if not equals or not key.strip():
        raise PlanError(_("wanted KEY=VALUE, not {text}").format(text=repr(setting)))
    try:
        value = tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        value = text
    at: Any = data
    *folders, last = key.strip().split(".")
    for name in folders:
        at = _inside(at, name, key)
    if isinstance(at, list):
        _inside(at, last, key)
        at[int(last)] = value
    else:
        at[last] = value


def _inside(at: Any, name: str, key: str) -> Any:
    try:
        found = at[int(name)] if isinstance(at, list) else at.setdefault(name, {})
    except (ValueError, IndexError):
        found = None
    if not isinstance(found, dict | list) and not isinstance(at, list):
        found = None
    if found is None:
        raise PlanError(_("there is no {key} to set").format(key=key))
    return found


def quantity(text: object, units: dict[str, float]) -> object:
    """A number in the first of `units` from text such as "3 min 12 s"; other things unchanged.

    Raises:
        ValueError: for text without a known unit, and for true and false, which are no numbers.
    """
    if isinstance(text, bool):
        raise ValueError(_("wanted a number, not {text}").format(text=str(text).lower()))
    if not isinstance(text, str) or not units:
        return text
    pieces = re.findall(r"([-+]?[0-9.]+(?:e[-+]?\d+)?)\s*([^\s\d.+-]+)", text.strip(), re.IGNORECASE)
    rest = re.sub(r"([-+]?[0-9.]+(?:e[-+]?\d+)?)\s*([^\s\d.+-]+)", "", text, flags=re.IGNORECASE)
    try:
        if rest.strip() or not pieces:
            raise ValueError
        return sum(float(number) * units[unit] for number, unit in pieces)
    except (KeyError, ValueError):
        raise ValueError(
            _("wanted a number, or text with a unit of {units}, not {text}").format(
                units=", ".join(units), text=repr(text)
            )
        ) from None
