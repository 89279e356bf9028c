"""Which library serves: one of these kernels, for this processor."""

import platform
from pathlib import Path

import pytest

from benchdragon.hosts import built, native
from benchdragon.own_folder import made_own


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of one kernel, with a builder."""
    for name in ("kernels", "engine"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "one.py").write_text("a = 1\n", encoding="utf-8")
    monkeypatch.setattr(built, "KERNELS", tmp_path / "kernels")
    monkeypatch.setattr(built, "ENGINE", tmp_path / "engine")
    (tmp_path / "signature.py").write_text("b = 1\n", encoding="utf-8")
    monkeypatch.setattr(built, "CONVENTION", tmp_path / "signature.py")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path


@pytest.mark.parametrize(
    "changed", ["kernels/one.py", "engine/one.py", "engine/runtime.c", "signature.py"]
)
def test_a_library_of_other_sources_is_not_found(package: Path, changed: str) -> None:
    assert native.find_library() is None
    path = package / "engine" / native.library_name()
    path.touch()
    assert native.find_library() == path
    (package / changed).write_text("a = 2\n", encoding="utf-8")
    assert native.find_library() is None
    mine = package / "cache" / "benchdragon" / native.library_name()
    assert built.user_folder() == mine.parent
    assert made_own(mine.parent) == mine.parent
    mine.touch()
    assert native.find_library() == mine


def test_a_library_for_another_processor_is_not_found(
    package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(platform, "machine", lambda: "x86_64")
    monkeypatch.setattr(built, "PROCESSORS", package / "cpuinfo")
    assert built.processor() == "x86-64"
    flags = "flags : fpu " + " ".join(sorted(built.V3))
    built.PROCESSORS.write_text(f"model : one\n{flags}\n{flags}\n", encoding="utf-8")
    assert built.processor() == "x86-64-v3"
    path = package / "engine" / native.library_name()
    path.touch()
    assert native.find_library() == path
    built.PROCESSORS.write_text(flags.replace("avx2", "avx"), encoding="utf-8")
    assert built.processor() == "x86-64"
    assert native.find_library() is None
    monkeypatch.setattr(platform, "machine", lambda: "arm64")
    assert built.processor() == "arm64"


def test_a_library_that_cannot_be_loaded_is_as_none(package: Path) -> None:
    assert native.load_library() is None
    (package / "engine" / native.library_name()).write_bytes(b"no library")
    assert native.load_library() is None
