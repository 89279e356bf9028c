"""What is said while kernels are compiled."""

from collections.abc import Callable
from pathlib import Path

import pytest

from benchdragon.cli.options import announce_compiling
from benchdragon.i18n import use_language
from benchdragon.kernels import jit


def test_what_compiling_means_is_told_in_full_once_on_a_computer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    use_language("en")

    def slow_each_time(slow: Callable[[], None], after: float) -> None:
        slow()
        slow()

    monkeypatch.setattr(jit, "watch_compiling", slow_each_time)
    monkeypatch.setattr(jit, "CACHE_FOLDER", tmp_path)
    told = []
    for quiet in (True, False, False):
        announce_compiling(quiet)
        told.append(capsys.readouterr().err)
    assert told[0] == ""
    assert told[1].count("a few minutes") == 1
    assert told[2] == "compiling more of the kernels\n"
