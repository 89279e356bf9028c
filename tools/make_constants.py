"""Write constants of the Python modules as JavaScript, for their twins in the pages (web/compute).

Takes of each module named below every number, short list of numbers and `IntEnum` that stands there in
capitals or as a class, not those it imports: `CURVE.KIND` is `KIND` of kernels/curve.py,
`MODEL_WALK.MOST_PLACES` that of model/walk.py. The same modules give the same bytes.

Run it as `make types`.
"""

import ast
import importlib
import math
import re
from enum import IntEnum
from pathlib import Path
from types import ModuleType

import numpy as np

import benchdragon

KERNELS = (
    "band", "beginning", "bench_cells", "beside", "beside_search", "box", "cells",
    "contact_memory", "course", "curve", "doubts", "drive", "every_pair", "family", "grid",
    "low_points", "meetings", "near_cells", "nearness", "obstacle", "own_room", "pacing", "peak",
    "peak_memory", "peak_question", "perturbed", "question", "regions", "rounding", "route",
    "route_parts", "search", "size_bracket", "size_memory", "size_question", "size_search",
    "spiral", "standing", "status", "step_bounds", "turn_families", "walk_search",
)  # fmt: skip
# Modules with twins in the page: add those whose numbers you need.
TWINS = (
    "analysis.bench_nearness", "analysis.bench_walks", "analysis.bends", "analysis.check",
    "analysis.contact", "analysis.contact_search", "analysis.crossings",
    "analysis.distance", "analysis.left_open", "analysis.marks",
    "analysis.nearby", "analysis.not_looked_at", "analysis.obstacle_search",
    "analysis.room", "analysis.rounds", "analysis.shortage", "analysis.speed", "analysis.tables",
    "analysis.unfinished", "budget", "errors",
    "model.answer", "model.base_curve", "model.connections", "model.curves", "model.dragon",
    "model.formations", "model.holds", "model.obstacle", "model.placement", "model.profile",
    "model.walk", "number_format",
    "plans.cues", "plans.drawn", "plans.routes", "plans.source", "plans.square", "plans.tables",
    "plans.toml",
    "player.following", "player.frames", "player.scene", "rosters.extent", "rosters.grid",
    "sheets.briefing", "solve.dance_bound", "solve.head_speed",
    "solve.minima", "solve.random_dance", "solve.size", "solve.size_family", "solve.size_question",
    "solve.tolerance", "solve.turn", "solve.turn_trials", "surveys.clothoids", "surveys.corners",
    "surveys.fitting", "surveys.lines",
)  # fmt: skip
FILE = Path(benchdragon.__file__).with_name("web") / "compute" / "constants.js"
# Longer lists are tables of the kernels' own.
SHORT = 10
HEADER = (
    "// Numbers of the kernels and of modules that have twins here. Made by tools/make_constants.py;\n"
    "// to make it again: make types\n"
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


def enums(module: ModuleType) -> list[type[IntEnum]]:
    """The enumerations that a module defines."""
    found = (one for one in vars(module).values() if isinstance(one, type) and issubclass(one, IntEnum))
    return [one for one in found if one.__module__ == module.__name__]


def object_text(name: str, fields: dict[str, str]) -> str:
    """One exported object."""
    lines = "".join(f"  {key}: {value},\n" for key, value in fields.items())
    return f"export const {name} = {{\n{lines}}};\n"


def declared(name: str) -> list[str]:
    """What is exported of one module, named without the package."""
    module = importlib.import_module(f"benchdragon.{name}")
    found = {key: literal(getattr(module, key)) for key in own_names(module)}
    fields = {key: value for key, value in found.items() if value is not None}
    called = name.removeprefix("kernels.").replace(".", "_").upper()
    tables = {called: fields} if fields else {}
    for one in enums(module):
        tables[one.__name__] = {member.name: str(member.value) for member in one}
    return [object_text(*each) for each in tables.items()]


def constants() -> str:
    """The whole file."""
    names = [f"kernels.{name}" for name in KERNELS] + list(TWINS)
    return "\n".join([HEADER, *(text for name in names for text in declared(name))])


if __name__ == "__main__":
    FILE.write_text(constants(), "utf-8")
