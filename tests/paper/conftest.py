"""Comparisons of workbooks without their files, most of whose time is writing and reading."""

from collections.abc import Sequence

import pytest

from benchdragon.kernels.curve import FloatArray
from benchdragon.paper import compare as comparing
from benchdragon.paper.compare import Comparison, Result
from tests.paper.workbooks import Compared, held


@pytest.fixture
def compared(monkeypatch: pytest.MonkeyPatch) -> Compared:
    """`compare` of what a file would hold; tests/paper/test_workbook.py reads such files."""

    def call(
        table: FloatArray,
        times: Sequence[float] | FloatArray | None = None,
        *,
        name: str = "a.xlsx",
        decimals: int = 6,
        result: Result | None = None,
        tolerance: float = 1e-6,
    ) -> Comparison:
        with monkeypatch.context() as patch:
            patch.setattr(comparing, "read_workbook", lambda _path: held(table, times, decimals))
            return comparing.compare(name, result=result, tolerance=tolerance)

    return call
