import errno
import gc
import os
import resource
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from benchdragon.errors import REASONS, MachineError, reason
from benchdragon.export.tables import WRITERS, Selection, write_moment_xlsx
from benchdragon.figures.style import lay_out, write_picture
from benchdragon.figures.walk import walk_pictures
from benchdragon.files import FileRefusedError, refuse_existing, whole_file
from benchdragon.i18n import use_language
from benchdragon.plans.schema import read_plan
from benchdragon.progress import silent

Written = Callable[[Path], None]


def test_a_file_appears_whole(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    with whole_file(path) as temporary:
        temporary.write_text("half")
        assert not path.exists()
    assert path.read_text() == "half"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interrupt_as_soon_as_a_file_is_begun_leaves_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(_handle: int, *, otherwise: bool) -> bool:
        assert otherwise
        assert len(list(tmp_path.iterdir())) == 1
        raise KeyboardInterrupt

    monkeypatch.setattr("benchdragon.files._locked", interrupted)
    with pytest.raises(KeyboardInterrupt), whole_file(tmp_path / "a.txt"):
        pytest.fail("it was begun")
    assert list(tmp_path.iterdir()) == []


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


@contextmanager
def files_of_at_most(size: int) -> Iterator[None]:
    """Files end at a size, bytes, as they do where a disk is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.fixture(scope="module")
def written() -> Iterator[dict[str, Written]]:
    """What writes each kind of file, some 10 KB or more of it."""
    walk = read_plan("spiral-in", ["dragon.benches=40"]).build()
    what = Selection(walk, np.arange(0.0, 60.0), range(41))
    figure = walk_pictures(walk, what.times, "", None, throw=True)["dragon"]
    lay_out(figure)

    def table(name: str) -> Written:
        return lambda path: WRITERS[name](path, what, silent)

    found = {name: table(name) for name in WRITERS}
    found |= dict.fromkeys(("png", "svg", "pdf"), lambda path: write_picture(figure, path, "", "x"))
    gc.freeze()  # what is there by now: the tests collect what comes after it
    first = walk.motion([0.0])
    tables = [first.x[0], first.y[0], first.speed[0]]
    yield {**found, "moment.xlsx": lambda path: write_moment_xlsx(path, tables)}
    gc.unfreeze()


def refusal(write: Written, path: Path) -> str:
    """What is said where a file cannot be written."""
    with pytest.raises(MachineError) as caught:
        write(path)
    return str(caught.value)


# XlsxWriter leaves the file at which it failed to the garbage collector.
@pytest.mark.filterwarnings("ignore:.*FileIO.*:pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("kind", [*WRITERS, "png", "svg", "pdf", "moment.xlsx"])
def test_a_full_disk_is_told_by_the_files_name_and_keeps_what_was_there(
    tmp_path: Path, written: dict[str, Written], kind: str
) -> None:
    path = tmp_path / f"a.{kind}"
    written[kind](path)
    before = path.read_bytes()
    for share in (0.05, 0.5, 0.95):
        with files_of_at_most(int(share * len(before))):
            said = refusal(written[kind], path)
        gc.collect()  # what libraries dropped half-made may complain only now
        assert said == f"{path} could not be written: the file would be larger than is allowed", share
        assert MachineError.exit_code == 6
        assert path.read_bytes() == before, share
        assert list(tmp_path.iterdir()) == [path], share


@pytest.mark.parametrize("language", ["en", "zh"])
def test_what_the_system_says_is_said_in_the_language_in_use(language: str) -> None:
    use_language(language)
    said = {reason(OSError(number, os.strerror(number))) for number in REASONS}
    unknown = reason(OSError(errno.EXDEV, os.strerror(errno.EXDEV)))
    bare = reason(OSError("no number"))
    use_language("en")
    assert len(said) == len(REASONS)
    assert said.isdisjoint({os.strerror(number) for number in REASONS})
    assert all(text.isascii() == (language == "en") for text in said)
    assert str(errno.EXDEV) in unknown
    assert bare == "no number"
