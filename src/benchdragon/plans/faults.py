"""Errors of a plan as sentences: where, what was expected, and what was given."""

import difflib
import json
from collections.abc import Sequence
from typing import Any, get_args, get_origin

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from benchdragon.errors import did_you_mean
from benchdragon.i18n import N_, _
from benchdragon.plans.source import Fault

# What was expected, by pydantic's name of the error, which fills in the braces.
WANTED = {
    "greater_than": N_("more than {gt}"),
    "greater_than_equal": N_("at least {ge}"),
    "less_than_equal": N_("at most {le}"),
    "finite_number": N_("a finite number"),
    "float_type": N_("a number"),
    "float_parsing": N_("a number"),
    "int_type": N_("a whole number"),
    "int_parsing": N_("a whole number"),
    "int_from_float": N_("a whole number"),
    "bool_type": N_("true or false"),
    "bool_parsing": N_("true or false"),
    "string_type": N_("text"),
    "string_pattern_mismatch": N_("text like {pattern}"),
    "list_type": N_("a list"),
    "tuple_type": N_("a list"),
    "literal_error": "{expected}",
    "union_tag_invalid": "{expected_tags}",
    "model_type": N_("a table"),
    "model_attributes_type": N_("a table"),
    "dict_type": N_("a table"),
    "union_tag_not_found": N_("a table with the key kind"),
    "too_short": N_("at least {min_length} entries"),
    "too_long": N_("at most {max_length} entries"),
}


def tables_in(annotation: object) -> list[type[BaseModel]]:
    """The models that an annotation names, at any depth."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [table for part in get_args(annotation) for table in tables_in(part)]


def known_keys(model: type[BaseModel], path: list[str]) -> list[str]:
    """Keys allowed in the table at a `path` of pydantic's, which names kinds and numbers too."""
    tables = [model]
    for step in path:
        fields = [table.model_fields[step] for table in tables if step in table.model_fields]
        kinds = [table for table in tables if step in kinds_of(table)]
        tables = kinds or [table for field in fields for table in tables_in(field.annotation)] or tables
    return [field.alias or name for table in tables for name, field in table.model_fields.items()]


def single_keys(model: type[BaseModel]) -> list[str]:
    """The dotted keys under which plans say one value, whatever the route: route.pitch, walk.speed."""
    tables = {
        name: tables_in(field.annotation)
        for name, field in model.model_fields.items()
        if get_origin(field.annotation) is not list
    }
    found = (
        f"{name}.{field.alias or key}"
        for name, kinds in tables.items()
        for table in kinds
        for key, field in table.model_fields.items()
    )
    return list(dict.fromkeys(found))


def kinds_of(table: type[BaseModel]) -> tuple[str, ...]:
    """The kinds that a table of a union is for."""
    return get_args(table.model_fields["kind"].annotation) if "kind" in table.model_fields else ()


def fault_of(
    error: ErrorDetails, data: dict[str, Any], model: type[BaseModel], settings: Sequence[str] = ()
) -> Fault:
    """One validation error of `data`, which should be a `model`, in the language in use.

    Of `settings`, keys that were set besides, a half one is named in full: pitch, route.pitch.
    """
    path = [str(step) for step in error["loc"]]
    where = ".".join(step for i, step in enumerate(path) if not _is_tag(path, i, data))
    if error["type"] == "extra_forbidden" and len(path) == 1:
        half = next((key for key in settings if f"{key}.".startswith(f"{where}.")), None)
        if half is not None and (hint := did_you_mean(half, single_keys(model))):
            return Fault(where, _("{where} is not a known key").format(where=half) + hint)
    return Fault(where, _sentence(error, path, where, model))


def _sentence(error: ErrorDetails, path: list[str], where: str, model: type[BaseModel]) -> str:
    kind, context = error["type"], error.get("ctx", {})
    if kind == "extra_forbidden":
        known = known_keys(model, path[:-1])
        near = difflib.get_close_matches(path[-1], known, 1)
        whole = "".join(f"{where.rpartition('.')[0]}.{name}".lstrip(".") for name in near)
        hint = _("; did you mean {name}?").format(name=whole) if near else ""
        return _("{where} is not a known key").format(where=where) + hint
    if kind == "missing":
        return _("{where} is missing").format(where=where)
    if kind not in WANTED:
        return f"{where}: {context.get('error', error['msg'])}"
    came = json.dumps(error["input"], ensure_ascii=False, default=str)
    if kind == "union_tag_invalid":
        came, where = json.dumps(context.get("tag"), ensure_ascii=False), f"{where}.kind"
    came = came if len(came) <= 60 else came[:57] + "..."
    wanted = _(WANTED[kind]).format(**context).replace(" or ", ", ")
    return _("{where}: expected {wanted}, not {came}").format(where=where, wanted=wanted, came=came)


def _is_tag(path: list[str], i: int, data: Any) -> bool:
    """Whether step i names the kind of a union and not a key of the plan."""
    for step in path[:i]:
        if isinstance(data, list) and step.isdigit() and int(step) < len(data):
            data = data[int(step)]
        elif isinstance(data, dict) and step in data:
            data = data[step]
    return isinstance(data, dict) and data.get("kind") == path[i] and path[i] not in data
