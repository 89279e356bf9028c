"""Files appear whole or not at all, and never over one that was there unless asked.

However a run ends: what kill -9 leaves is hidden, and cleared by the next run that writes the same.
On Windows an open file is locked: it cannot be removed or renamed.
"""

import errno
import io
import os
import re
import secrets
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path

from benchdragon.errors import BenchDragonError, MachineError, reason
from benchdragon.i18n import _

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

# In a folder that a run keeps others out of, where the system cannot lock the folder itself.
LOCK = ".lock"
# The folders that the run at hand keeps others out of.
_kept: ContextVar[ExitStack | None] = ContextVar("kept", default=None)


class FileRefusedError(BenchDragonError):
    """A file that is in the way, or a folder that cannot be written."""


@contextmanager
def one_run() -> Iterator[None]:
    """A run whose files belong together: folders that get several of them take no others meanwhile."""
    with ExitStack() as kept:
        token = _kept.set(kept)
        try:
            yield
        finally:
            _kept.reset(token)


def refuse_existing(paths: Iterable[Path], force: bool) -> None:
    """Make the folders of `paths`; refuse if a file is there already and `force` is not set.

    Raises:
        FileRefusedError: naming the first one; or a folder that is to get several files, into which
            another run is writing.
    """
    wanted = list(paths)
    _make_folders(wanted, force)
    kept = _kept.get()
    several = [folder for folder, count in Counter(path.parent for path in wanted).items() if count > 1]
    if kept is not None:
        for folder in several:
            kept.enter_context(alone(folder))


def _make_folders(paths: Iterable[Path], force: bool) -> None:
    for path in paths:
        if path.exists() and not force:
            text = _("{path} is there already; use --force to overwrite it")
            raise FileRefusedError(text.format(path=path))
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except (FileExistsError, NotADirectoryError):
            raise FileRefusedError(_("{path} is not a folder").format(path=path.parent)) from None
        except OSError as error:
            raise FileRefusedError(f"{path.parent}: {reason(error)}") from None
        if path.is_dir() or not os.access(path.parent, os.W_OK):
            raise FileRefusedError(_("{path} cannot be written").format(path=path))


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Keep other runs out of a folder; the system lets go when this process ends, however it does.

    Raises:
        FileRefusedError: if another run has the folder.
    """
    if fcntl is None:  # no folder can be opened there
        handle = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT, 0o644)
    else:
        handle = os.open(folder, os.O_RDONLY)
    try:
        if not _locked(handle, otherwise=True):
            raise FileRefusedError(_("another run is writing into {folder}").format(folder=folder))
        yield
    finally:
        _let_go(handle)


def _locked(handle: int, *, otherwise: bool) -> bool:
    """Whether an open file could be locked; `otherwise` where locks are not supported."""
    try:
        if fcntl is None:
            import msvcrt

            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined, unused-ignore]
        else:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in (errno.EAGAIN, errno.EACCES) and otherwise
    return True


def _let_go(handle: int) -> None:
    if fcntl is not None:  # a worker made by a fork has it open, too, and would keep the lock
        fcntl.flock(handle, fcntl.LOCK_UN)
    os.close(handle)


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A temporary path beside `path` that takes its name once the block has ended well.

    What killed runs have left of the same file goes.

    Raises:
        MachineError: naming the file, if the system refuses to write it.
    """
    begun: list[Path] = []
    handle = None
    try:
        clear_leftovers(path)
        handle = _begun(path, begun)
        yield begun[-1]
        if fcntl is None:
            os.close(handle)
            handle = None
        begun[-1].replace(path)
    except OSError as error:
        text = _("{path} could not be written: {why}")
        raise MachineError(text.format(path=path, why=reason(error))) from None
    finally:
        if handle is not None:
            _let_go(handle)
        for temporary in begun:
            temporary.unlink(missing_ok=True)


def _begun(path: Path, begun: list[Path]) -> int:
    """Begin a temporary file beside `path`; what keeps others from clearing it, while it is open.

    Its name is the last in `begun` before it is there: it goes even if an interrupt comes at once.
    """
    while True:
        temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}{path.suffix}")
        begun.append(temporary)
        handle = os.open(temporary, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
        if fcntl is None or (_locked(handle, otherwise=True) and temporary.exists()):
            return handle
        os.close(handle)  # it was taken for a leftover before it was locked


def clear_leftovers(path: Path) -> None:
    """Remove the temporary files of runs that were killed while they wrote `path`."""
    name = re.compile(rf"\.{re.escape(path.name)}\.[0-9a-f]{{8}}{re.escape(path.suffix)}")
    for found in path.parent.iterdir():
        if name.fullmatch(found.name):
            _clear(found)


def _clear(leftover: Path) -> None:
    """Remove a temporary file that no process writes any more."""
    if fcntl is None:
        with suppress(PermissionError):  # it is open
            leftover.unlink(missing_ok=True)
        return
    try:
        handle = os.open(leftover, os.O_RDWR)
    except OSError:
        return  # who wrote it was done just now
    try:
        if _locked(handle, otherwise=False):
            leftover.unlink(missing_ok=True)
    finally:
        os.close(handle)


def write_whole(path: Path, text: str) -> None:
    """Write a text, the same bytes on all systems.

    Raises:
        MachineError: as `whole_file`.
    """
    with whole_file(path) as temporary:
        temporary.write_text(text, "utf-8", newline="\n")


@contextmanager
def whole_bytes(path: Path) -> Iterator[io.BytesIO]:
    """What becomes a file at once: for libraries that do not get over a disk that is full.

    Raises:
        MachineError: as `whole_file`.
    """
    with whole_file(path) as temporary:
        made = io.BytesIO()
        yield made
        temporary.write_bytes(made.getbuffer())
