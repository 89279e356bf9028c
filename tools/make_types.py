"""Write the pydantic models of pages' messages as TypeScript, for the checker of the front end's types.

Takes every public model of the modules named below, and whatever those refer to, as they are sent. A
field with a default may be missing, unless the model's `model_config` holds
`json_schema_serialization_defaults_required=True`. The same models give the same bytes; a schema that
has no plain counterpart is an error.
"""

import importlib
import json
from pathlib import Path
from types import ModuleType
from typing import Any, Literal

from pydantic import BaseModel
from pydantic.json_schema import models_json_schema

import benchdragon

MODULES = ("benchdragon.player.messages", "benchdragon.planner.messages")
TYPES = Path(benchdragon.__file__).with_name("web") / "messages.d.ts"
HEADER = "// Made from {modules} by tools/make_types.py; to make it again: make generate\n"
PLAIN = {
    "integer": "number",
    "number": "number",
    "string": "string",
    "boolean": "boolean",
    "null": "null",
}

Schema = dict[str, Any]


def models(module: ModuleType) -> list[type[BaseModel]]:
    """The public models that a module defines, not those it imports."""
    return [
        found
        for name, found in vars(module).items()
        # Pydantic leaves every `Model[int]` that was asked for among a module's names.
        if name.isidentifier()
        and not name.startswith("_")
        and isinstance(found, type)
        and issubclass(found, BaseModel)
        and found.__module__ == module.__name__
    ]


def union(members: list[str]) -> str:
    """One of several types, each named once."""
    return " | ".join(dict.fromkeys(members))


def array(schema: Schema) -> str:
    """A list of one type, or a tuple, or a tuple with a tail."""
    items = schema.get("items", {})
    if "prefixItems" not in schema:
        return f"Array<{kind(items)}>"
    first = [kind(item) for item in schema["prefixItems"]]
    # A tuple of fixed length says so, with or without telling that nothing follows.
    tail = [] if items is False or "maxItems" in schema else [f"...Array<{kind(items)}>"]
    return f"[{', '.join(first + tail)}]"


def mapping(schema: Schema) -> str:
    """A table of any keys whose values are of one type."""
    values = schema.get("additionalProperties")
    if schema.keys() & {"properties", "patternProperties"} or values in (None, False):
        raise ValueError(f"no type for {schema}")
    return f"Record<string, {kind({} if values is True else values)}>"


def kind(schema: Schema) -> str:
    """The TypeScript type of a JSON schema."""
    match schema:
        case {"$ref": str(path)}:
            return path.rpartition("/")[2]
        case {"const": value}:
            return json.dumps(value, ensure_ascii=False)
        case {"enum": [*values]}:
            return union([json.dumps(value, ensure_ascii=False) for value in values])
        case {"anyOf": [*members]} | {"oneOf": [*members]}:
            return union([kind(member) for member in members])
        case {"type": "array"}:
            return array(schema)
        case {"type": "object"}:
            return mapping(schema)
        case {"type": str(name)}:
            return PLAIN[name]
    if schema.keys() - {"title", "description", "default", "examples"}:
        raise ValueError(f"no type for {schema}")
    return "unknown"


def comment(schema: Schema, indent: str = "") -> str:
    """What a schema says of itself, as JSDoc; nothing if it says nothing."""
    lines = schema.get("description", "").replace("*/", "*\\/").splitlines()
    if len(lines) < 2:
        return "".join(f"{indent}/** {line} */\n" for line in lines)
    inner = "".join(f"{indent} * {line}".rstrip() + "\n" for line in lines)
    return f"{indent}/**\n{inner}{indent} */\n"


def field(name: str, schema: Schema, required: bool) -> str:
    """One field of an interface, below what it says of itself."""
    key = name if name.isidentifier() else json.dumps(name, ensure_ascii=False)
    return f"{comment(schema, '  ')}  {key}{'' if required else '?'}: {kind(schema)};\n"


def declared(name: str, schema: Schema) -> str:
    """One exported declaration: an interface for what has fields, a name for the rest."""
    if "properties" not in schema:
        return f"{comment(schema)}export type {name} = {kind(schema)};\n"
    if schema.get("additionalProperties"):
        raise ValueError(f"no type for the unnamed fields of {name}")
    required = schema.get("required", ())
    inner = "".join(field(key, of, key in required) for key, of in schema["properties"].items())
    return f"{comment(schema)}export interface {name} {{\n{inner}}}\n"


def types(*modules: ModuleType) -> str:
    """The whole file of declarations for modules of models."""
    mode: Literal["serialization"] = "serialization"
    wanted = [(model, mode) for module in modules for model in models(module)]
    definitions = models_json_schema(wanted)[1]["$defs"]
    parts = [declared(name, definitions[name]) for name in sorted(definitions)]
    return "\n".join(
        [HEADER.format(modules=" and ".join(module.__name__ for module in modules)), *parts]
    )


def files() -> dict[Path, str]:
    """The file of all declarations."""
    return {TYPES: types(*map(importlib.import_module, MODULES))}
