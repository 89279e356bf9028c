"""Write modules that both hosts need, and that know texts and records alone, as JavaScript for pages.

Each file of web/made, named in TWINS of tools/translation/shares.py, holds what pages ask of a Python
module, with all that this needs of it and of other such modules. Constants stand in it with the values
that the module has. The same modules give the same bytes.
"""

import ast
import dataclasses
import enum
import importlib
import inspect
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

from pydantic import BaseModel, BeforeValidator
from tools.translation.names import camel, number, text
from tools.translation.patterns import javascript
from tools.translation.shares import (
    AROUND,
    AS_FUNCTIONS,
    FREED,
    GIVEN,
    LEFT_OUT,
    OWN,
    TWINS,
    UNASKED,
    WAITING,
)
from tools.translation.statements import Code

import benchdragon
from benchdragon.analysis.engine_question import EngineQuestion
from benchdragon.kernels.entries import ENTRIES
from benchdragon.kernels.numbered import Names

FOLDER = Path(benchdragon.__file__).with_name("web") / "made"
HEADER = "// @ts-nocheck\n// Made from {name} by tools/make_twins.py; to make it again: make generate\n"


@dataclass
class Twin:
    """A module on its way.

    Attributes:
        name: of the module, without the package.
        all: all twins, by the names of their modules.
    """

    name: str
    all: "dict[str, Twin]"
    wanted: dict[str, str] = field(default_factory=dict)
    imports: dict[str, set[str]] = field(default_factory=dict)
    shared: set[str] = field(default_factory=set)
    patterns: dict[tuple[str, int], str] = field(default_factory=dict)

    @cached_property
    def module(self) -> ModuleType:
        """The module itself."""
        return importlib.import_module(f"benchdragon.{self.name}")

    @cached_property
    def tree(self) -> ast.Module:
        """What it says."""
        return ast.parse(Path(str(self.module.__file__)).read_text("utf-8"))

    @cached_property
    def definitions(self) -> dict[str, ast.FunctionDef | ast.ClassDef]:
        """Its functions and records, and methods that are functions of pages."""
        found = [one for one in self.tree.body if isinstance(one, ast.FunctionDef | ast.ClassDef)]
        inner = [each for one in found if isinstance(one, ast.ClassDef) for each in one.body]
        methods = [one for one in inner if isinstance(one, ast.FunctionDef)]
        found += [one for one in methods if AS_FUNCTIONS.get(one.name, ("",))[0] == self.name]
        return {one.name: one for one in found}

    @cached_property
    def values(self) -> set[str]:
        """The names to which it gives values."""
        targets = [
            target
            for one in self.tree.body
            for target in (
                one.targets
                if isinstance(one, ast.Assign)
                else [one.target]
                if isinstance(one, ast.AnnAssign)
                else []
            )
        ]
        return {one.id for target in targets for one in ast.walk(target) if isinstance(one, ast.Name)}

    @cached_property
    def origins(self) -> dict[str, tuple[str, str]]:
        """Where what it takes from the package is from, and what it is called there."""
        return {
            alias.asname or alias.name: (str(one.module).removeprefix("benchdragon."), alias.name)
            for one in self.tree.body
            if isinstance(one, ast.ImportFrom) and str(one.module).startswith("benchdragon.")
            for alias in one.names
        }

    @cached_property
    def messages(self) -> set[str]:
        """What is translated when it is said."""
        calls = (one for one in ast.walk(self.tree) if isinstance(one, ast.Call) and one.args)
        marked = [one for one in calls if isinstance(one.func, ast.Name) and one.func.id == "N_"]
        return {str(ast.literal_eval(one.args[0])) for one in marked}

    @cached_property
    def code(self) -> Code:
        """What translates it."""
        listed = vars(self.module).get("fields") is dataclasses.fields
        return Code(
            self.parameters, self.use, self.hoist, self.function_for, self.plain, self.waits,
            self.entry, self.group, self.owned, self.member, self.kind, listed,
        )  # fmt: skip

    def use(self, name: str) -> None:
        """Have a name, of this module or taken from another."""
        if name in self.wanted or name in ("error", "this"):
            return
        if given := UNASKED.get(".".join(self.origins.get(name, (self.name, name)))):
            self.wanted[name] = f"const {camel(name)} = {given};"
        elif path := GIVEN.get(f"{self.name}.{name}"):
            self.imports.setdefault(path, set()).add(camel(name))
        elif name in self.definitions:
            self.wanted[name] = ""
            out = LEFT_OUT.get(self.name, ()) + LEFT_OUT.get(f"{self.name}.{name}", ())
            node, code = _without(self.definitions[name], out), self.code
            make = code.function if isinstance(node, ast.FunctionDef) else code.record
            kept = code.scopes, code.me, code.record_name, code.of_class
            code.scopes, code.me = [], []
            self.wanted[name] = make(node)  # type: ignore[arg-type]
            code.scopes, code.me, code.record_name, code.of_class = kept
        elif name in self.values:
            self.wanted[name] = ""
            self.wanted[name] = f"const {camel(name)} = {self.literal(getattr(self.module, name))};"
        elif name in self.origins:
            self._take(name, *self.origins[name])
        elif name in ERRORS:
            if name == "ValueError":
                self.imports.setdefault("../compute/python.js", set()).add(name)
        else:
            raise NameError(f"{self.name}: {name} is not known")

    def _take(self, name: str, module: str, there: str) -> None:
        value = getattr(self.module, name)
        if isinstance(value, bool | int | float | str):
            self.wanted[name] = f"const {name} = {self.literal(value)};"
        elif module in self.all or module in OWN or f"{module}.{there}" in GIVEN:
            self._bring(name, module, there)
        else:
            self.wanted[name] = f"const {name} = {self.literal(value)};"

    def parameters(self, name: str) -> Sequence[str] | None:
        """What a function or a record takes; of a method, named with a point, any of that name."""
        if name.startswith("."):
            return next(
                (
                    [one.arg for one in [*node.args.args[1:], *node.args.kwonlyargs]]
                    for twin in self.all.values()
                    for record in twin.definitions.values()
                    if isinstance(record, ast.ClassDef)
                    for node in record.body
                    if isinstance(node, ast.FunctionDef) and node.name == name[1:]
                ),
                None,
            )
        value = getattr(self.module, name, None)
        if not callable(value) or (isinstance(value, type) and issubclass(value, Exception)):
            return None
        return list(inspect.signature(value).parameters)

    def entry(self, name: str) -> tuple[str, bool] | None:
        """What an entry of the kernels is called in the engine, and whether it gives one number."""
        found = self._told(name)
        module = str(getattr(found, "__module__", ""))
        if f"{module}.{getattr(found, '__name__', '')}" not in ENTRIES:
            return None
        kind = inspect.signature(found).return_annotation
        one = isinstance(kind, type) and not issubclass(kind, tuple)
        return f"bd_{module.rpartition('.')[2]}_{found.__name__}", one

    def group(self, name: str) -> Sequence[str] | None:
        """The fields of a group of arrays that entries take."""
        found = self._told(name)
        module = str(getattr(found, "__module__", "")).removeprefix("benchdragon.")
        if not (isinstance(found, type) and module.startswith("kernels.")) or module in self.all:
            return None
        return getattr(found, "_fields", None)

    def owned(self, name: str) -> tuple[str, Sequence[str]] | None:
        """A function of a module that this one names, and what it takes."""
        owner, _point, there = name.rpartition(".")
        found, of = self._told(name), vars(self.module).get(owner)
        module = str(getattr(of, "__name__", "")).removeprefix("benchdragon.")
        if not owner or not callable(found) or not (module in self.all or module in OWN):
            return None
        here = f"{owner}_{there}"
        self._bring(here, module, there)
        return camel(here), list(inspect.signature(found).parameters)

    def _bring(self, name: str, module: str, there: str) -> None:
        """Have something of another module, by a name."""
        if path := GIVEN.get(f"{module}.{there}", OWN.get(module)):
            self.imports.setdefault(path, set()).add(_renamed(there, name))
        else:
            self.all[module].use(there)
            self.all[module].shared.add(there)
            self.imports.setdefault(f"./{TWINS[module][0]}.js", set()).add(_renamed(there, name))

    def member(self, name: str) -> str | None:
        """A number that is named with its module, or with its class of names."""
        found = self._told(name)
        plain = isinstance(found, int | float) and not isinstance(found, bool | enum.Enum)
        return number(found) if "." in name and plain else None

    def _told(self, name: str) -> Any:
        """What is called so: in this module, or in one that it names."""
        owner, _point, own = name.rpartition(".")
        of = vars(self.module).get(owner) if owner else self.module
        if isinstance(of, Names):
            return getattr(of, own, None)
        return vars(of).get(own) if isinstance(of, ModuleType) else None

    def kind(self, name: str) -> type | None:
        """The class of the package that this module calls so."""
        found = self._told(name)
        own = isinstance(found, type) and found.__module__.startswith("benchdragon.")
        return found if own else None

    def function_for(self, method: str) -> Sequence[str] | None:
        """What the function takes that stands for a method; None for any other method."""
        if method not in AS_FUNCTIONS:
            return None
        module, parameters = AS_FUNCTIONS[method]
        self.all[module].use(method)
        self.all[module].shared.add(method)
        if module != self.name:
            self.imports.setdefault(f"./{TWINS[module][0]}.js", set()).add(method)
        return parameters

    def waits(self, name: str) -> str:
        """Whether a function gives way, "made"; or "around" or "freed" of a context; or "unasked"."""
        module, there = self.origins.get(name, (self.name, name))
        if UNASKED.get(f"{module}.{there}", "").endswith("=> null"):
            return "unasked"
        if f"{module}.{there}" in AROUND:
            return "around"
        kind = getattr(self.module, name, None)
        asks = isinstance(kind, type) and issubclass(kind, EngineQuestion)
        if asks or f"{module}.{there}" in FREED:
            return "freed"
        if f"{module}.{there}" in WAITING:
            return "made"
        return "made" if module in self.all and there in self.all[module].code.waiting else ""

    def plain(self, name: str) -> dict[str, tuple[str | None, str]] | None:
        """The keys of records that are plain data, what each holds by default, and what changes it."""
        kind = getattr(self.module, name, None)
        if not (isinstance(kind, type) and issubclass(kind, BaseModel)):
            return None
        return {
            key: (None if of.is_required() else self.literal(of.default), self._changing(of.metadata))
            for key, of in kind.model_fields.items()
        }

    def _changing(self, said: Sequence[object]) -> str:
        """The function that changes what stands under a key of plain data; "" if none does."""
        names = [one.func.__name__ for one in said if isinstance(one, BeforeValidator)]
        for name in names:
            self.use(name)
        return camel(names[0]) if names else ""

    def hoist(self, pattern: str, flags: int) -> str:
        """The name of a regular expression that stands within a function."""
        return self.patterns.setdefault((pattern, flags), f"PATTERN_{len(self.patterns) + 1}")

    def literal(self, value: Any) -> str:
        """A constant as JavaScript has it."""
        match value:
            case type():
                return self._class(value)
            case enum.Enum():
                return number(value.value)
            case None | bool():
                return {None: "null", True: "true", False: "false"}[value]
            case int() | float():
                return number(value if isinstance(value, float) else int(value))
            case str():
                return self._text(value)
            case _ if dataclasses.is_dataclass(value):
                return self._made(
                    value, [getattr(value, one.name) for one in dataclasses.fields(value)]
                )
            case tuple() if hasattr(value, "_fields"):
                return self._made(value, value)
            case re.Pattern():
                return _pattern(value.pattern, value.flags)
        return self._several(value)

    def _several(self, value: Any) -> str:
        """A list, a set or a dict."""
        match value:
            case tuple() | list():
                return f"[{', '.join(map(self.literal, value))}]"
            case set() | frozenset():
                return f"py.set_of([{', '.join(map(self.literal, sorted(value)))}])"
            case _ if hasattr(value, "items"):
                pairs = (
                    f"[{text(key) if isinstance(key, str) else self.literal(key)}, {self.literal(of)}]"
                    for key, of in value.items()
                )
                return f"py.dict([{', '.join(pairs)}])"
        raise TypeError(f"{self.name}: {value!r}")

    def _text(self, value: str) -> str:
        if value not in self.messages:
            return text(value)
        self.imports.setdefault(OWN["i18n"], set()).add("N_")
        return f"N_({text(value)})"

    def _class(self, value: type) -> str:
        """A class: an enumeration as its numbers."""
        if issubclass(value, enum.IntEnum):
            return f"{{ {', '.join(f'{one.name}: {one.value}' for one in value)} }}"
        self.use(value.__name__)
        return value.__name__

    def _made(self, value: object, fields: Sequence[object]) -> str:
        """A record of what it was made of."""
        return f"new {self._class(type(value))}({', '.join(map(self.literal, fields))})"

    def script(self) -> str:
        """The whole file."""
        there = [*_in_order(self.tree)]
        others = [name for name in self.wanted if name not in there]
        order = [name for name in [*others, *there] if self.wanted.get(name)]
        runtime = "../compute/python.js"
        taken = {**self.imports, runtime: {"py", *self.imports.get(runtime, ())}}
        lines = [
            f'import {{ {", ".join(sorted(names))} }} from "{path}";'
            for path, names in sorted(taken.items())
        ]
        lines += [
            f"const {name} = {_pattern(pattern, flags)};"
            for (pattern, flags), name in self.patterns.items()
        ]
        own = [
            ("export " if name in self.shared else "") + self.wanted[name]
            for name in dict.fromkeys(order)
        ]
        head = HEADER.format(name=f"{self.name.replace('.', '/')}.py")
        return "\n".join([head, *lines, "", *indented("\n".join(own)), ""])


# Kinds of errors that the languages have in common, or have by other names.
ERRORS = ("Error", "RangeError", "TypeError", "ValueError")


def _without(
    node: ast.FunctionDef | ast.ClassDef, names: Sequence[str]
) -> ast.FunctionDef | ast.ClassDef:
    """A record without some of what it has."""
    node.body = [one for one in node.body if _name_of(one) not in names]
    return node


def _name_of(node: ast.stmt) -> str:
    target = getattr(node, "target", None) or (getattr(node, "targets", None) or [None])[0]
    return str(getattr(node, "name", getattr(target, "id", "")))


def _renamed(there: str, here: str) -> str:
    one, other = camel(there), camel(here)
    return one if one == other else f"{one} as {other}"


def _in_order(tree: ast.Module) -> Iterator[str]:
    for one in tree.body:
        match one:
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                yield name
            case ast.Assign(targets=targets):
                yield from (
                    n.id for target in targets for n in ast.walk(target) if isinstance(n, ast.Name)
                )
            case ast.AnnAssign(target=ast.Name(id=name)):
                yield name


def indented(script: str) -> Iterator[str]:
    """Lines, each set in by how many braces are open."""
    depth = 0
    for line in script.splitlines():
        depth -= line.startswith("}")
        yield "  " * depth + line
        depth += line.endswith("{")


def _pattern(pattern: str, flags: int) -> str:
    return f"py.pattern({text(javascript(pattern, flags))}, {text(_flags(flags))})"


def _flags(flags: int) -> str:
    names = {re.IGNORECASE: "i", re.MULTILINE: "m"}
    return "".join(sign for flag, sign in names.items() if flags & flag)


def files() -> dict[Path, str]:
    """All files, and their texts."""
    twins: dict[str, Twin] = {}
    for name in TWINS:
        twins[name] = Twin(name, twins)
    for name, (_file, *asked) in TWINS.items():
        for one in asked:
            twins[name].use(one)
            twins[name].shared.add(one)
    return {FOLDER / f"{TWINS[name][0]}.js": twin.script() for name, twin in twins.items()}
