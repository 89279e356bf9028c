"""What the builder does where something is missing."""

from pathlib import Path

import pytest

from benchdragon.engine import build
from benchdragon.engine.optimise import BuildError


def test_without_a_c_compiler_nothing_is_begun(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    with pytest.raises(BuildError, match="no C compiler is here: wanted cc, gcc, clang, or CC"):
        build.build(tmp_path / "made")
    assert not (tmp_path / "made").exists()
    mine = tmp_path / "mine"
    mine.write_text("#!/bin/sh\n", encoding="utf-8")
    mine.chmod(0o755)
    monkeypatch.setenv("CC", "mine")
    assert build.c_compiler() == str(mine)


def test_a_library_that_does_not_link_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="failed: "):
        build.link(b"no object", tmp_path / "kernels.so")
    assert list(tmp_path.iterdir()) == []
