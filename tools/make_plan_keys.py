"""Write what plan files may hold as data for the pages' own check of plans (compute/plan_check.js).

From the pydantic models of plans: the keys of each table, what may stand under each, and what is so if
nothing is said; besides, the units of numbers, and the built-in plans. The same models give the same
bytes; an annotation that has no plain counterpart is an error.
"""

import json
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import annotated_types
from pydantic import AfterValidator, BaseModel, BeforeValidator
from pydantic.fields import FieldInfo

import benchdragon
from benchdragon.plans import toml, units
from benchdragon.plans.faults import kinds_of
from benchdragon.plans.schema import Plan

FILE = Path(benchdragon.__file__).with_name("web") / "compute" / "plan_keys.js"
HEADER = (
    "// What plan files may hold, from the models of plans. Made by tools/make_plan_keys.py;\n"
    "// to make it again: make generate\n"
)
UNITS = ("METRES", "SECONDS", "DEGREES", "SPEEDS", "ACCELERATIONS", "ANGULAR_SPEEDS")
TYPES = {float: "float", int: "int", bool: "bool", str: "text"}
NUMBERS, NAMES = "Record<string, Record<string, number>>", "Record<string, string[]>"
# Functions that check or change a value, made for the pages too.
CHECKS = ("entrance", "one_line", "time_of_day", "web_address")
LIMITS = {"le": min, "ge": max, "gt": max, "least": max, "most": min}

Spec = dict[str, Any]


def closed_over(function: Any) -> Any:
    """The one value that a function made by another keeps."""
    (cell,) = function.__closure__
    return cell.cell_contents


def constraint(one: object) -> Spec:
    """What one entry of `Annotated` says."""
    match one:
        case FieldInfo():
            return narrowed(*map(constraint, one.metadata))
        case annotated_types.MinLen(min_length=least):
            return {"fewest": least}
        case annotated_types.MaxLen(max_length=most):
            return {"most": most}
        case BeforeValidator(func=function) if function.__name__ == "_day":
            return {"day": True}
        case BeforeValidator(func=function):
            found = closed_over(function)
            return {"units": next((name for name in UNITS if getattr(units, name) is found), "")}
        case AfterValidator(func=function) if function.__name__ in CHECKS:
            return {"check": function.__name__}
        case AfterValidator(func=function):
            return {"least": closed_over(function)}
    # Limits of numbers; pydantic keeps some in an object of its own.
    said = getattr(one, "__dict__", {}) or {name: getattr(one, name, None) for name in LIMITS}
    return {name: value for name, value in said.items() if name in LIMITS and value is not None}


def narrowed(*specs: Spec) -> Spec:
    """What several say together: of two limits the narrower one."""
    found: Spec = {}
    for spec in specs:
        for key, value in spec.items():
            narrower = LIMITS.get(key)
            found[key] = narrower(found[key], value) if narrower and key in found else value
    return found


def spec(annotation: Any, tables: dict[str, Any]) -> Spec:
    """What may stand where an annotation does; models that it names are added to `tables`."""
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return narrowed(spec(inner[0], tables), *map(constraint, inner[1:]))
    if origin in (Union, UnionType):
        return union(inner, tables)
    if origin is Literal:
        return {"type": "choice", "values": list(inner)}
    if origin is list:
        return {"type": "list", "of": spec(inner[0], tables)}
    if origin is tuple:
        return {"type": "tuple", "of": [spec(one, tables) for one in inner]}
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return {"type": "table", "table": add(annotation, tables)}
    return {"type": TYPES[annotation]}


def union(members: tuple[Any, ...], tables: dict[str, Any]) -> Spec:
    """Something or nothing, or one of several tables by their kinds."""
    present = [member for member in members if member is not NoneType]
    if len(present) == 1:
        return {**spec(present[0], tables), "none": True}
    kinds = {kind: add(member, tables) for member in present for kind in kinds_of(member)}
    return {"type": "union", "tables": kinds}


def add(model: type[BaseModel], tables: dict[str, Any]) -> str:
    """Add the keys of a model to `tables`; its name."""
    if model.__name__ not in tables:
        fields = tables[model.__name__] = {}
        for name, field in model.model_fields.items():
            fields[field.alias or name] = key_spec(field, tables)
    return model.__name__


def key_spec(field: FieldInfo, tables: dict[str, Any]) -> Spec:
    """What may stand under a key, and what does where nothing is said."""
    kind = narrowed(spec(field.annotation, tables), *map(constraint, field.metadata))
    if field.is_required():
        return {**kind, "required": True}
    default = field.get_default(call_default_factory=True, validated_data={})
    if isinstance(default, BaseModel):
        default = {}
    return {**kind, "default": default}


def built_in() -> dict[str, Any]:
    """The built-in plans as their files say them."""
    return {name: toml.read_toml(name)[0] for name in toml.built_in_names()}


def files() -> dict[Path, str]:
    """The file, and its whole text."""
    tables: dict[str, Any] = {}
    add(Plan, tables)
    texts = [
        exported(
            "PLAN_TABLES", tables, 'Record<string, Record<string, import("./plan_check.js").Spec>>'
        ),
        exported("PLAN_UNITS", {name: getattr(units, name) for name in UNITS}, NUMBERS),
        exported("BUILT_IN_PLANS", built_in(), "Record<string, Record<string, any>>"),
    ]
    return {FILE: "\n".join([HEADER, *texts])}


def exported(name: str, value: dict[str, Any], kind: str) -> str:
    """One exported object, tables of tables a line each."""
    text = json.dumps(value, ensure_ascii=False)
    if any(isinstance(of, dict) for of in value.values()):
        lines = (
            f"  {json.dumps(key)}: {json.dumps(of, ensure_ascii=False)},\n" for key, of in value.items()
        )
        text = f"{{\n{''.join(lines)}}}"
    return f"/** @type {{{kind}}} */\n// prettier-ignore\nexport const {name} = {text};\n"
