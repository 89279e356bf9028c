"""The meaning of a plan's keys as JSON Schema, rows of the manual, and comments of printed plans."""

from collections.abc import Iterator, Mapping
from typing import Any

import tomlkit
from pydantic.fields import FieldInfo

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.plans.routes import PartsRoute
from benchdragon.plans.schema import Plan
from benchdragon.plans.sections import SECTIONS, Section
from benchdragon.plans.tables import Key, Table

# Keys that may be left out since other keys determine their values.
TOLD: Mapping[tuple[type[Table], str], str] = {(PartsRoute, "kind"): "parts"}


def schema() -> dict[str, Any]:
    """The JSON Schema of plan files, each key with what it means in the language in use."""
    whole = Plan.model_json_schema()
    for table, name in TOLD:
        whole["$defs"][table.__name__]["required"].remove(name)
    for section in SECTIONS:
        part = whole if section.table is Plan else whole["$defs"][section.table.__name__]
        part["description"] = _(section.text)
        for name, key in section.keys.items():
            about = {"description": _(key.text), "examples": [key.example]}
            part["properties"][name] |= about | ({"unit": key.unit} if key.unit else {})
    return whole


def rows(section: Section) -> Iterator[tuple[str, str, str, str, str]]:
    """Key, meaning, unit, default and example of each key of a section, as text."""
    fields = {field.alias or name: field for name, field in section.table.model_fields.items()}
    for name, key in section.keys.items():
        told = TOLD.get((section.table, name))
        default = _default(fields[name]) if told is None else written(told)
        yield name, _(key.text), key.unit, default, written(key.example)


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return _("must be said")
    value = field.get_default(call_default_factory=True, validated_data={})
    return "-" if value is None or value in ([], "") or isinstance(value, Table) else written(value)


def written(value: Any) -> str:
    """A value as it stands in a plan file."""
    if isinstance(value, list):
        return f"[{', '.join(written(entry) for entry in value)}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key} = {written(entry)}' for key, entry in value.items())}}}"
    return str(tomlkit.item(value).as_string())


def commented(data: dict[str, Any], notes: Mapping[str, str]) -> str:
    """Tables of a plan as the text of a plan file, each key with its unit and what it means.

    Args:
        data: what `Plan.data` gives; what is empty is left out.
        notes: more to say, by dotted key.
    """
    lines = [f"schema = {data['schema']}"]
    for name, table in data.items():
        if isinstance(table, list):
            for entry in table:
                lines += _block(f"[[{name}]]", name, entry, notes)
        elif name != "schema" and any(value not in ("", []) for value in table.values()):
            lines += _block(f"[{name}]", name, table, notes)
    return "\n".join(lines) + "\n"


def _block(header: str, path: str, table: dict[str, Any], notes: Mapping[str, str]) -> list[str]:
    """A table, then the lists of tables in it."""
    lists = {key: value for key, value in table.items() if value and _is_tables(value)}
    plain = {key: value for key, value in table.items() if key not in lists and value not in ("", [])}
    lines = ["", header] if plain else []
    keys = _section(header, table).keys
    for key, value in plain.items():
        about = [f"{keys[key].unit}:" if keys[key].unit else "", _(keys[key].text)]
        about += [f"({notes[f'{path}.{key}']})"] if f"{path}.{key}" in notes else []
        lines.append(f"{key} = {written(value)}  # {' '.join(filter(None, about))}")
    for key, entries in lists.items():
        for entry in entries:
            lines += _block(f"[[{path}.{key}]]", f"{path}.{key}", entry, notes)
    return lines


def _is_tables(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(entry, dict) for entry in value)


def meaning(plan: Plan, key: str) -> Key:
    """What a dotted key of a plan, in which the parts of a list have numbers, means; its unit.

    Of a key that several kinds have it is that of the plan's own kind.

    Raises:
        InputError: for a key that no section has.
    """
    *folders, name = key.split(".")
    table: Any = plan.data()
    for folder in folders:
        table = table[int(folder)] if isinstance(table, list) else table.get(folder, {})
    header = ".".join(folder for folder in folders if not folder.isdigit())
    header = f"[[{header}]]" if folders[-1].isdigit() else f"[{header}]"
    own = f'{header} kind = "{table.get("kind")}"'
    fitting = [one for one in SECTIONS if one.header.split(" ")[0] == header and name in one.keys]
    if not fitting:
        raise InputError(_("no section has {key}").format(key=key))
    return next((one for one in fitting if one.header == own), fitting[0]).keys[name]


def _section(header: str, table: dict[str, Any]) -> Section:
    """The section of a table of a plan."""
    kinds = (header, f'{header} kind = "{table.get("kind")}"')
    return next(section for section in SECTIONS if section.header in kinds)
