"""Folders that only this user can write to: files there are loaded and run as code.

It stands outside of `kernels` so that a change here makes no compiled kernel stale.
"""

import os
import stat
from contextlib import suppress
from pathlib import Path


def made_own(folder: Path | None, *names: str) -> Path | None:
    """`folder`, and what is named in it, one in the other, made if need be, for this user alone.

    None where one cannot be made or written, is a link, belongs to another user, or is open to others;
    and where anyone may put another one in the place of the first; and for no folder.
    """
    if folder is None:
        return None
    with suppress(OSError):
        folder.parent.mkdir(parents=True, exist_ok=True)
        if _anyone_may_rename(folder.parent):
            return None
        at = folder
        for name in ("", *names):
            at /= name
            with suppress(FileExistsError):
                at.mkdir(mode=stat.S_IRWXU)
            if not is_own(at):
                return None
        return at if os.access(at, os.W_OK) else None
    return None


def is_own(folder: Path) -> bool:
    """Whether a folder is none but this user's: no link to one, and closed to all others."""
    try:
        found = folder.lstat()
    except OSError:
        return False
    if not stat.S_ISDIR(found.st_mode):
        return False
    if not hasattr(os, "getuid"):  # then it lies in the user's own profile, which the system keeps
        return True
    return found.st_uid == os.getuid() and not found.st_mode & (stat.S_IRWXG | stat.S_IRWXO)


def shared_folder(name: str, place: Path) -> Path | None:
    """A folder for this user in a place that others write to, too; None where users have no number."""
    return place / f"{name}-{os.getuid()}" if hasattr(os, "getuid") else None


def _anyone_may_rename(place: Path) -> bool:
    """Whether all users may rename what lies in a folder, though it is not theirs."""
    mode = place.stat().st_mode if hasattr(os, "getuid") else stat.S_ISVTX
    return bool(mode & stat.S_IWOTH) and not mode & stat.S_ISVTX
