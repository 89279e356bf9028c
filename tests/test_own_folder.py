"""Compiled code lies in a folder that nobody else can write to, or nowhere."""

import os
import stat
import tempfile
from pathlib import Path

import pytest

from benchdragon.hosts import built, compiled, native
from benchdragon.own_folder import is_own, made_own, shared_folder

STRANGER = 54_321


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder that all write to, as the system's temporary one."""
    folder = tmp_path / "shared"
    folder.mkdir()
    folder.chmod(stat.S_ISVTX | 0o777)
    return folder


def test_a_folder_is_made_for_this_user_alone_whatever_the_mask(place: Path) -> None:
    before = os.umask(0)
    try:
        made = made_own(place / "ours", "kernels")
    finally:
        os.umask(before)
    assert made == place / "ours" / "kernels"
    assert [stat.S_IMODE(each.stat().st_mode) for each in (made, made.parent)] == [0o700, 0o700]
    assert made_own(place / "ours", "kernels") == made


@pytest.mark.parametrize("inner", ["", "kernels"])
@pytest.mark.parametrize("mode", [0o701, 0o710, 0o702, 0o720, 0o750, 0o777])
def test_a_folder_that_is_open_to_others_is_not_used(place: Path, inner: str, mode: int) -> None:
    made = made_own(place / "ours", "kernels")
    assert made is not None
    (place / "ours" / inner).chmod(mode)
    assert made_own(place / "ours", "kernels") is None


@pytest.mark.parametrize("inner", ["", "kernels"])
def test_a_link_is_not_used(place: Path, tmp_path: Path, inner: str) -> None:
    """Whoever made it may let it lead elsewhere."""
    target = made_own(tmp_path / "target", "kernels")
    assert target is not None
    if inner:
        assert made_own(place / "ours") is not None
    (place / "ours" / inner).symlink_to(target if inner else target.parent)
    assert made_own(place / "ours", "kernels") is None
    assert not is_own(place / "ours" / inner)


def test_a_file_in_the_way_is_not_used(place: Path) -> None:
    (place / "ours").write_text("", encoding="utf-8")
    assert made_own(place / "ours", "kernels") is None


@pytest.mark.parametrize("inner", ["", "kernels"])
def test_a_folder_of_another_user_is_not_used(place: Path, inner: str) -> None:
    if os.getuid() != 0:
        pytest.skip("only the superuser can give folders away")
    assert made_own(place / "ours", "kernels") is not None
    os.chown(place / "ours" / inner, STRANGER, STRANGER)
    assert made_own(place / "ours", "kernels") is None


def test_whoever_is_not_its_owner_does_not_use_it(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert made_own(place / "ours") is not None
    monkeypatch.setattr(os, "getuid", lambda: STRANGER)
    assert made_own(place / "ours") is None


def test_a_place_in_which_anyone_may_rename_is_not_used(place: Path) -> None:
    place.chmod(0o777)
    assert made_own(place / "ours") is None
    assert list(place.iterdir()) == []


def test_what_cannot_be_written_is_not_used(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda _path, _mode: False)
    assert made_own(place / "ours") is None


def test_where_users_have_no_numbers_nothing_is_shared(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert shared_folder("x", place) == place / f"x-{os.getuid()}"
    monkeypatch.delattr(os, "getuid")
    assert shared_folder("x", place) is None
    assert made_own(place / "ours") == place / "ours"


def test_a_planted_cache_is_not_used(
    place: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Home cannot hold one, and somebody was there before: by his folder, or by a link to it."""
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr(tempfile, "tempdir", str(place))
    ours = compiled.kept_folder()
    assert ours == place / f"benchdragon-{os.getuid()}"
    ours.rename(tmp_path / "away")
    ours.symlink_to(tmp_path / "away")
    assert compiled.kept_folder() is None
    ours.unlink()
    ours.mkdir(mode=0o755)
    ours.chmod(0o755)
    assert compiled.kept_folder() is None


@pytest.mark.parametrize(
    ("system", "told", "folder"),
    [
        ("linux", {}, "home/.cache"),
        ("darwin", {}, "home/Library/Caches"),
        ("win32", {"LOCALAPPDATA": "home/AppData/Local"}, "home/AppData/Local"),
        ("darwin", {"XDG_CACHE_HOME": "caches"}, "caches"),
        ("win32", {"XDG_CACHE_HOME": "caches", "LOCALAPPDATA": "home"}, "caches"),
    ],
)
def test_what_is_kept_lies_where_each_system_keeps_such_things(
    monkeypatch: pytest.MonkeyPatch, system: str, told: dict[str, str], folder: str
) -> None:
    monkeypatch.setattr("sys.platform", system)
    for name in ("XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in {"HOME": "home", **told}.items():
        monkeypatch.setenv(name, value)
    assert built.user_folder() == Path(folder) / "benchdragon"


def test_who_has_no_home_keeps_nothing_there(monkeypatch: pytest.MonkeyPatch) -> None:
    def lost() -> Path:
        raise RuntimeError("Could not determine home directory.")

    for name in ("XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(Path, "home", lost)
    assert built.user_folder() is None
    assert made_own(built.user_folder()) is None
    monkeypatch.setattr(native, "library_name", lambda: "of others.so")
    assert native.find_library() is None


def test_a_library_is_taken_from_an_own_folder_alone(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(built, "ENGINE", tmp_path / "nowhere")
    monkeypatch.setattr(native, "library_name", lambda: "kernels.so")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    own = made_own(built.user_folder())
    assert own is not None
    (own / "kernels.so").write_bytes(b"")
    assert native.find_library() == own / "kernels.so"
    own.chmod(0o770)
    assert native.find_library() is None
