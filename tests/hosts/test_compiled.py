"""Compiled code is kept in an own folder, whole, and thrown away where it is not sound."""

import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
import wasmtime

from benchdragon.hosts import built, compiled
from benchdragon.hosts.trouble import EngineError, Trouble
from tests.hosts.modules import code


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's folder of what is compiled, not there yet; no other place will do."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    (tmp_path / "file").touch()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "file"))
    return tmp_path / "benchdragon"


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[bytes]:
    """The modules that are compiled, and not taken from where they are kept."""
    done: list[bytes] = []

    class Module(wasmtime.Module):
        def __init__(self, engine: Any, text: Any) -> None:
            done.append(text)
            super().__init__(engine, text)

    monkeypatch.setattr(wasmtime, "Module", Module)
    return done


def kept(home: Path) -> Path:
    """The one file that is kept."""
    (path,) = home.iterdir()
    return path


def runs(module: tuple[Any, Any]) -> bool:
    """Whether an engine's module is at work."""
    engine, made = module
    store = wasmtime.Store(engine)
    return "bd_modules_half" in wasmtime.Instance(store, made, []).exports(store)


def test_a_module_is_compiled_once(home: Path, made: list[bytes]) -> None:
    for _start in range(3):
        assert runs(compiled.module(code()))
    assert made == [code()]
    assert home.stat().st_mode & 0o777 == 0o700
    assert kept(home).name == compiled.name_of(code(), version("wasmtime"))


def test_its_name_is_of_module_version_and_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    names = {compiled.name_of(code(), "1"), compiled.name_of(code(), "2"), compiled.name_of(b"", "1")}
    monkeypatch.setattr(built, "processor", lambda: "another")
    assert len({*names, compiled.name_of(code(), "1")}) == 4


@pytest.mark.parametrize(
    "torn",
    [
        lambda data: data[:-100],
        lambda _data: b"",
        lambda data: b"\1" + data,
        lambda data: data[: len(data) // 2] + bytes(1000) + data[len(data) // 2 + 1000 :],
    ],
)
def test_what_is_torn_is_thrown_away(home: Path, made: list[bytes], torn: Any) -> None:
    compiled.module(code())
    sound = kept(home).read_bytes()
    kept(home).write_bytes(torn(sound))
    assert runs(compiled.module(code()))
    assert len(made) == 2
    assert len(kept(home).read_bytes()) == len(sound)


def test_what_wasmtime_does_not_take_is_compiled_anew(home: Path, made: list[bytes]) -> None:
    compiled.module(code())
    compiled.keep(kept(home), b"of another version")
    assert runs(compiled.module(code()))
    assert len(made) == 2


def test_code_is_taken_from_an_own_folder_alone(home: Path, made: list[bytes], tmp_path: Path) -> None:
    """Others may write there, or it is a link to where they may."""
    compiled.module(code())
    home.chmod(0o770)
    assert compiled.kept_folder() is None
    assert runs(compiled.module(code()))
    home.chmod(0o700)
    home.rename(tmp_path / "away")
    home.symlink_to(tmp_path / "away")
    assert compiled.kept_folder() is None
    assert runs(compiled.module(code()))
    assert len(made) == 3


def test_it_goes_to_the_temporary_folder_where_home_cannot_hold_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    folder = compiled.kept_folder()
    assert folder == tmp_path / "temporary" / f"benchdragon-{os.getuid()}"


def test_a_disk_that_takes_nothing_is_no_error(
    home: Path, made: list[bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_path: Path, _data: bytes) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    assert runs(compiled.module(code()))
    assert list(home.iterdir()) == []


def test_processes_may_race(home: Path) -> None:
    script = (
        "from benchdragon.hosts import compiled; from tests.hosts.modules import code\n"
        "compiled.module(code())"
    )

    def start(_number: int) -> int:
        return subprocess.run([sys.executable, "-c", script], check=False).returncode

    with ThreadPoolExecutor(3) as pool:
        assert list(pool.map(start, range(3))) == [0, 0, 0]
    assert compiled.whole(kept(home)) is not None


def test_the_newest_few_are_kept(home: Path) -> None:
    home.mkdir()
    for number in range(compiled.MOST + 3):
        path = home / f"{number}{compiled.ENDING}"
        compiled.keep(path, b"code")
        os.utime(path, (number, number))
    compiled.keep(home / f"last{compiled.ENDING}", b"code")
    names = {path.stem for path in home.iterdir()}
    assert names == {"last", *(str(3 + n) for n in range(1, compiled.MOST))}


def test_without_wasmtime_it_is_said_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "wasmtime", None)
    with pytest.raises(EngineError, match="wasmtime") as told:
        compiled.module(b"")
    assert told.value.trouble is Trouble.NO_WASMTIME


def test_what_is_no_module_is_told(home: Path) -> None:
    with pytest.raises(EngineError) as told:
        compiled.module(b"no module")
    assert told.value.trouble is Trouble.NO_WASMTIME
