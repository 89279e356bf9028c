"""A plan file with other values in it, its comments and the order of its lines kept."""

from collections.abc import Mapping
from typing import Any

import tomlkit
from tomlkit.container import Container
from tomlkit.items import Table

from benchdragon.plans.idle import drop, idle_keys
from benchdragon.plans.schema import Plan, checked
from benchdragon.plans.toml import parsed, read_text, read_toml


def rewritten(plan: Plan, source: str) -> str:
    """The text of a plan file with what a plan says; of the rest, comments included, no sign changes.

    A file that has a base, or a table that cannot be changed in place, is written from scratch.

    Args:
        plan: what the file is to say.
        source: the file, or the name of a built-in plan, that it was made from.

    Raises:
        PlanError: for a source that cannot be read.
    """
    text, (tables, where) = read_text(source), read_toml(source)
    if "base" in parsed(text, source):
        return plan.toml()
    before, after = _said(checked(tables, where)), _said(plan)
    document = tomlkit.parse(text)
    for name in dict.fromkeys([*before, *after]):
        _change(document, name, before.get(name), after.get(name))
    drop(document, idle_keys(document.unwrap()))
    made = document.as_string()
    return made if checked(parsed(made, source), where).data() == plan.data() else plan.toml()


def _said(plan: Plan) -> dict[str, Any]:
    """What a plan says that is not as by default."""
    return plan.model_dump(mode="json", by_alias=True, exclude_defaults=True)


def _change(at: Container | Table, name: str, before: Any, after: Any) -> None:
    """Let a table say another value under a name, or another table; None is nothing."""
    if before == after:
        return
    held = at.get(name)
    if isinstance(before, Mapping) and isinstance(after, Mapping) and isinstance(held, Table):
        for key in dict.fromkeys([*before, *after]):
            _change(held, key, before.get(key), after.get(key))
    elif after is None:
        if held is not None:
            at.remove(name)
    else:
        at[name] = after  # the text behind the value stays
