"""Write the types of methods that are public functions of higher rooms: a stub beside each module.

A method takes what its function takes, but for the first. The same functions give the same bytes.
"""

import ast
import builtins
import importlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import benchdragon
from benchdragon.methods import Method

MODULES = ("benchdragon.model.asked", "benchdragon.plans.asked")
HEADER = "# Made from {name} by tools/make_methods.py; to make it again: make generate\n"


def files() -> dict[Path, str]:
    """The stubs."""
    return {Path(str(importlib.import_module(name).__file__) + "i"): stub(name) for name in MODULES}


def stub(name: str) -> str:
    """The stub of a module."""
    module = importlib.import_module(name)
    kinds = [kind for kind in vars(module).values() if isinstance(kind, type)]
    roots, imports, lines = set[str](), set[str](), list[str]()
    for kind in (one for one in kinds if one.__module__ == name):
        bases = [base for base in kind.__bases__ if base is not object]
        roots |= {f"from {base.__module__} import {base.__name__}" for base in bases}
        lines.append(f"\nclass {kind.__name__}({', '.join(base.__name__ for base in bases)}):")
        lines[-1] = lines[-1].replace("()", "")
        for method, of in vars(kind).items():
            if isinstance(of, Method):
                function = getattr(benchdragon, of.name)
                node, known = told(function.__module__, function.__name__)
                imports |= set(needed(node, known, function.__module__))
                lines += typed(method, node)
    # So that type checkers look at the functions first, whose modules import these records.
    later = ["from typing import TYPE_CHECKING\n", "if TYPE_CHECKING:"]
    text = [*sorted(roots), *later, *(f"    {one}" for one in sorted(imports)), *lines, ""]
    return HEADER.format(name=name) + "\n".join(text)


def typed(name: str, node: ast.FunctionDef) -> Iterator[str]:
    """A function as a method, one line for each of what it takes."""
    first, *rest = node.args.args
    del first
    yield f"    def {name}("
    yield "        self,"
    given = len(rest) - len(node.args.defaults)
    for n, one in enumerate(rest):
        yield f"        {one.arg}: {said(one.annotation)}{' = ...' if n >= given else ''},"
    if node.args.kwonlyargs:
        yield "        *,"
    for one, default in zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True):
        yield f"        {one.arg}: {said(one.annotation)}{' = ...' if default else ''},"
    yield f"    ) -> {said(node.returns)}: ..."


def said(annotation: ast.expr | None) -> str:
    """An annotation as text, as formatters write it."""
    assert annotation is not None
    return ast.unparse(annotation).replace("'", '"')


def needed(node: ast.FunctionDef, known: dict[str, str], module: str) -> Iterator[str]:
    """The imports of what annotations name."""
    rest = [*node.args.args[1:], *node.args.kwonlyargs]
    for annotation in [*(one.annotation for one in rest), node.returns]:
        assert annotation is not None
        for one in ast.walk(annotation):
            if isinstance(one, ast.Name) and not hasattr(builtins, one.id):
                yield known.get(one.id, f"from {module} import {one.id}")


@cache
def told(module: str, name: str) -> tuple[ast.FunctionDef, dict[str, str]]:
    """A function of a module, and the imports of the names that it knows."""
    tree = ast.parse(Path(str(importlib.import_module(module).__file__)).read_text("utf-8"))
    known: dict[str, str] = {}
    for one in tree.body:
        if isinstance(one, ast.ImportFrom):
            known |= {each.name: f"from {one.module} import {each.name}" for each in one.names}
        elif isinstance(one, ast.Import):
            known |= {each.asname or each.name: f"import {ast.unparse(one)[7:]}" for each in one.names}
    (node,) = (one for one in tree.body if isinstance(one, ast.FunctionDef) and one.name == name)
    return node, known
