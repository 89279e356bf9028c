"""How placing handles can end, and the decorators of all kernels."""

import ast

import pytest

from benchdragon.hosts import built
from benchdragon.kernels import entries
from benchdragon.kernels.status import Status


def test_only_ok_is_false_and_every_status_has_its_own_number() -> None:
    assert [status for status in Status if not status] == [Status.OK]
    assert [int(status) for status in Status] == list(range(len(Status)))


def double(x: float) -> float:
    return 2.0 * x


def test_kernels_stay_plain_functions_but_where_they_are_built(monkeypatch: pytest.MonkeyPatch) -> None:
    assert entries.kernel(double) is double
    monkeypatch.setattr(entries, "compiler", repr)
    monkeypatch.setattr(entries, "ENTRIES", {})
    assert [str(made(double)) for made in (entries.kernel, entries.entry)] == [repr(double)] * 2
    assert list(entries.ENTRIES) == [f"{__name__}.double"]


def test_who_makes_arrays_counts_references_to_them_and_keeps_them() -> None:
    """Else they would never be freed."""
    kernels = {
        node.name: node
        for path in built.KERNELS.glob("*.py")
        for node in ast.parse(path.read_text("utf-8")).body
        if isinstance(node, ast.FunctionDef)
        and {"kernel", "entry"} & {ast.unparse(mark) for mark in node.decorator_list}
    }
    counting = {
        name
        for name, node in kernels.items()
        if "allocates" in {ast.unparse(mark) for mark in node.decorator_list}
    }
    for name, node in kernels.items():
        called = {ast.unparse(call.func) for call in ast.walk(node) if isinstance(call, ast.Call)}
        if called & {"np.empty", "np.zeros"}:
            assert name in counting
    for name in counting:
        returns = kernels[name].returns
        assert returns is not None
        told = {part.id for part in ast.walk(returns) if isinstance(part, ast.Name)}
        assert told <= {"tuple", "int", "float", "bool", "FitStatus", "Status"}
