"""The command line on what stands in for Windows: verbs, files and streams, in a process of its own.

What only POSIX has is taken away: modules, functions, signals. Folders cannot be opened, an open file
can be neither removed nor renamed, and a pipe that nobody reads is invalid. `python -m tests.windows`
writes into the folder at hand, and fails with what is wrong.
"""

import errno
import io
import os
import pkgutil
import shutil
import signal
import subprocess  # takes msvcrt, where it finds that, for the rest of Windows
import sys
from contextlib import suppress
from importlib import import_module
from pathlib import Path, PurePath
from types import ModuleType
from typing import Any

MODULES = ("fcntl", "resource", "pwd", "grp", "termios", "tty", "pty", "syslog")
FUNCTIONS = (
    "chown", "fchmod", "fchown", "fork", "forkpty", "getegid", "geteuid", "getgid", "getloadavg",
    "getpgid", "getpriority", "getuid", "killpg", "lchown", "mkfifo", "nice", "pathconf",
    "posix_spawn", "sched_getaffinity", "setsid", "statvfs", "sync", "sysconf",
)  # fmt: skip
# SIGKILL is not there either, but multiprocessing needs it here to end a process.
SIGNALS = {
    "SIGABRT",
    "SIGFPE",
    "SIGILL",
    "SIGINT",
    "SIGSEGV",
    "SIGTERM",
    "SIGKILL",
    "SIG_DFL",
    "SIG_IGN",
}
# Parts of names that no file of Windows may have.
FORBIDDEN = set('<>:"|?*\\')

EXTRAS = ("benchdragon.engine.",)  # what builds the kernels
PLAN = ["--set", "dragon.benches=5", "--quiet"]
VERBS = (
    (0, ["doctor"]),
    (1, ["check", "spiral-in"]),
    (0, ["motion", "spiral-in", *PLAN, "--at", "0..3", "-o", "motion", "--format", "xlsx,csv,npz,png"]),
    (0, ["plan", "turn", "-o", "mine.dragon.toml"]),
    (0, ["view", "mine.dragon.toml", *PLAN, "-o", "view.html"]),
    (0, ["planner", "mine.dragon.toml", "-o", "planner.html"]),
    (0, ["solve", "pitch", "spiral-in", *PLAN, "--set", "disc.radius=4.5"]),
    (
        0,
        [
            "view",
            "turn",
            *PLAN,
            "--end",
            "0.2",
            "--start",
            "0",
            "-o",
            "turn.gif",
            "--size",
            "128x72",
        ],
    ),
    (
        0,
        ["sweep", "spiral-in", *PLAN, "--vary", "route.pitch=0.5,0.6", "--workers", "1", "-o", "sweep"],
    ),
    (0, ["atlas", "sweep", "-o", "atlas.html", "--quiet"]),
    (0, ["timetable", "turn", *PLAN]),
    (0, ["sheets", "turn", *PLAN, "--pdf", "sheets", "--only", "beat"]),
)


class Locks(ModuleType):
    """As the module msvcrt: an open file that is locked cannot be locked again."""

    LK_NBLCK = 2

    def __init__(self) -> None:
        super().__init__("msvcrt")
        self.locked: set[int] = set()

    def locking(self, handle: int, _mode: int, _bytes: int) -> None:
        """Lock what is open, or refuse."""
        self.locked.discard(handle)  # it was closed, and is another now
        if any(_same_file(handle, other) for other in self.locked):
            raise PermissionError(errno.EACCES, "locked")
        self.locked.add(handle)


def _same_file(one: int, other: int) -> bool:
    try:
        return os.path.sameopenfile(one, other)
    except OSError:  # the other was closed
        return False


def _guard(event: str, arguments: tuple[Any, ...]) -> None:
    """Refuse what Windows refuses."""
    if event == "open" and isinstance(arguments[0], str) and Path(arguments[0]).is_dir():
        raise PermissionError(errno.EACCES, "a folder", arguments[0])
    if event in ("os.remove", "os.rename"):
        names = [name for name in arguments[:2] if isinstance(name, (str, os.PathLike))]
        taken = _open_files().intersection(str(Path(name).absolute()) for name in names)
        if taken:
            raise PermissionError(errno.EACCES, "in use", *taken)


def _open_files() -> set[str]:
    found = set()
    for number in os.listdir("/proc/self/fd"):  # noqa: PTH208 - no folder is opened for it by name
        try:
            found.add(os.readlink(f"/proc/self/fd/{number}"))  # noqa: PTH115
        except OSError:
            continue  # that of the listing itself
    return found


def become_windows() -> None:
    """Take away what only POSIX has."""
    assert subprocess.__name__ in sys.modules
    sys.modules.update(dict.fromkeys(MODULES), msvcrt=Locks())  # type: ignore[arg-type]
    for name in FUNCTIONS:
        delattr(os, name)
    for name in [name for name in dir(signal) if name.startswith("SIG") and name not in SIGNALS]:
        delattr(signal, name)
    del signal.pthread_sigmask
    shutil._use_fd_functions = False  # type: ignore[attr-defined]  # else it opens folders
    sys.addaudithook(_guard)


def import_all() -> None:
    """Import each module of the package."""
    package = import_module("benchdragon")
    for found in pkgutil.walk_packages(package.__path__, "benchdragon."):
        if not found.name.startswith(EXTRAS) and not found.name.endswith("__main__"):
            import_module(found.name)


def run_verbs() -> None:
    """Run each verb, and look at what it wrote."""
    from benchdragon.cli.main import run

    for wanted, arguments in VERBS:
        code = run(arguments)
        assert code == wanted, (arguments, code)
    for path in Path().rglob("*"):
        assert not FORBIDDEN.intersection(path.name), path
        assert path.name == ".lock" or not path.name.startswith("."), path
        assert PurePath(path.name).stem.upper() not in ("CON", "PRN", "AUX", "NUL"), path


def lock_files() -> None:
    """What is being written is let be, what was left is cleared; a folder takes one run."""
    from benchdragon.files import FileRefusedError, alone, whole_file, write_whole

    path = Path("a.txt")
    with whole_file(path) as other:
        write_whole(path, "one\ntwo\n")
        assert other.exists()
    assert path.read_bytes() == b""
    other.touch()
    with suppress(KeyboardInterrupt), whole_file(path):
        raise KeyboardInterrupt
    assert [each.name for each in Path().glob("*a.txt*")] == ["a.txt"]
    with alone(Path("sweep")), suppress(FileRefusedError), alone(Path("sweep")):
        raise AssertionError("two are in")
    with alone(Path("sweep")):
        pass


def break_workbook() -> None:
    """What goes wrong in a workbook is told, and not that its files are open."""
    from benchdragon.export.tables import workbook

    with suppress(KeyboardInterrupt), workbook(io.BytesIO()) as book:
        book.add_worksheet("a").write_row(0, 0, [1])
        raise KeyboardInterrupt


def close_pipe() -> None:
    """Who reads no more is no failure."""
    from benchdragon.cli.main import NOBODY_READS, run

    class Pipe(io.StringIO):
        def write(self, _text: str) -> int:
            raise OSError(errno.EINVAL, "closed")

    before, sys.stdout = sys.stdout, Pipe()
    try:
        assert run(["doctor", "--json"]) == NOBODY_READS
    finally:
        sys.stdout = before


if __name__ == "__main__":
    become_windows()
    import_all()
    run_verbs()
    lock_files()
    break_workbook()
    close_pipe()
