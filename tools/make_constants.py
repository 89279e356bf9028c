"""Write constants of the Python modules as JavaScript, for their twins in the pages (web/compute).

Takes each class of names of the kernels that a script names where it imports constants: `Status`, and
`RouteRow` of kernels/curve.py with its columns. Takes of each module that is named there every number
and short list of numbers that stands in it in capitals and in such a script as a word:
`MODEL_WALK.MOST_PLACES` is that of model/walk.py. The same modules and scripts give the same bytes.
"""

import ast
import importlib
import math
import re
from enum import EnumType
from pathlib import Path
from types import ModuleType

import numpy as np

import benchdragon
from benchdragon.kernels.numbered import Names

PACKAGE = Path(benchdragon.__file__).parent
FILE = PACKAGE / "web" / "compute" / "constants.js"
# Longer lists are tables of the kernels' own.
SHORT = 10
# Of a line, as prettier has it.
WIDTH = 104
HEADER = (
    "// Numbers of the kernels and of modules that have twins here. Made by tools/make_constants.py;\n"
    "// to make it again: make generate\n"
)


def own_names(module: ModuleType) -> list[str]:
    """The names in capitals that a module gives values to, in its order."""
    tree = ast.parse(Path(str(module.__file__)).read_text("utf-8"))
    targets: list[ast.expr] = []
    for node in tree.body:
        if isinstance(node, ast.Assign):
            targets += node.targets
        elif isinstance(node, ast.AnnAssign):
            targets.append(node.target)
    names = [one.id for target in targets for one in ast.walk(target) if isinstance(one, ast.Name)]
    return [name for name in dict.fromkeys(names) if name.isupper() and not name.startswith("_")]


def number(value: float) -> str:
    """A number as JavaScript has it."""
    if math.isinf(value):
        return "Infinity" if value > 0 else "-Infinity"
    if float(value).is_integer() and abs(value) < 2**53:
        return repr(int(value))
    return re.sub(r"e([+-]?)0*", r"e\1", repr(float(value))).replace("e+", "e")


def literal(value: object) -> str | None:
    """A number or a short list of numbers as JavaScript has it; None for anything else."""
    if isinstance(value, np.ndarray):
        value = tuple(value.tolist()) if value.ndim == 1 and value.size < SHORT else None
    if isinstance(value, tuple) and value and all(isinstance(one, int | float) for one in value):
        return f"[{', '.join(number(one) for one in value)}]"
    return number(value) if isinstance(value, int | float) and not isinstance(value, bool) else None


def names_in(module: ModuleType) -> list[type]:
    """The classes of numbers by names that a module defines."""
    found = (one for one in vars(module).values() if isinstance(one, Names | EnumType))
    return [one for one in found if one.__module__ == module.__name__]


def members(names: type) -> dict[str, str]:
    """The names of such a class with their numbers, those of classes that it follows first."""
    known = {key: value for one in reversed(names.__mro__) for key, value in vars(one).items()}
    return {key: number(value) for key, value in known.items() if key.isupper() and key[0] != "_"}


def object_text(name: str, fields: dict[str, str]) -> str:
    """One exported object, as prettier has it."""
    pairs = [f"{key}: {value}" for key, value in fields.items()]
    line = f"export const {name} = {{ {', '.join(pairs)} }};\n"
    if len(line) <= WIDTH + 1:
        return line
    return f"export const {name} = {{\n" + "".join(f"  {pair},\n" for pair in pairs) + "};\n"


def called(name: str) -> str:
    """What a module, named without the package, is called in pages."""
    return name.removeprefix("kernels.").replace(".", "_").upper()


def imported() -> dict[str, set[str]]:
    """What scripts import of the constants, and the words of those that do."""
    asked = re.compile(r'import \{([^}]*)\} from "[./a-z]*/constants\.js"')
    found: dict[str, set[str]] = {}
    for path in FILE.parents[1].rglob("*.js"):
        text = path.read_text("utf-8")
        for name in re.findall(r"\w+", " ".join(asked.findall(text))):
            found.setdefault(name, set()).update(re.findall(r"\w+", text))
    return found


def modules() -> list[str]:
    """All modules, named without the package, the kernels first."""
    paths = (path.relative_to(PACKAGE).with_suffix("") for path in PACKAGE.rglob("*.py"))
    names = (".".join(path.parts) for path in paths if path.name != "__init__")
    return sorted(names, key=lambda name: (not name.startswith("kernels."), name))


def declared(name: str, asked: dict[str, set[str]]) -> list[str]:
    """What is exported of one module, named without the package, of what is asked for."""
    if called(name) not in asked and not name.startswith("kernels."):
        return []
    module = importlib.import_module(f"benchdragon.{name}")
    words = asked.get(called(name), set())
    found = {key: literal(getattr(module, key)) for key in own_names(module) if key in words}
    tables = {called(name): {key: value for key, value in found.items() if value is not None}}
    tables |= {one.__name__: members(one) for one in names_in(module)}
    return [object_text(*each) for each in tables.items() if each[0] in asked and each[1]]


def files() -> dict[Path, str]:
    """The file, and its whole text."""
    asked = imported()
    parts = [HEADER, *(text for name in modules() for text in declared(name, asked))]
    return {FILE: "\n".join(parts)}
