from pathlib import Path

import pytest

from benchdragon.files import FileRefusedError, refuse_existing, whole_file


def test_a_file_appears_whole(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    with whole_file(path) as temporary:
        temporary.write_text("half")
        assert not path.exists()
    assert path.read_text() == "half"
    assert list(tmp_path.iterdir()) == [path]


def test_a_failure_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")
    with pytest.raises(KeyboardInterrupt):
        _interrupted(path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def _interrupted(path: Path) -> None:
    with whole_file(path) as temporary:
        temporary.write_text("new")
        raise KeyboardInterrupt


def test_what_is_there_is_refused_unless_forced(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "a.txt"
    refuse_existing([path], force=False)
    path.write_text("old")
    with pytest.raises(FileRefusedError, match="is there already; use --force"):
        refuse_existing([path], force=False)
    refuse_existing([path], force=True)
    with pytest.raises(FileRefusedError, match="cannot be written"):
        refuse_existing([tmp_path / "deep"], force=True)


def test_a_folder_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(FileRefusedError, match="file"):
        refuse_existing([tmp_path / "file" / "a.txt"], force=False)
