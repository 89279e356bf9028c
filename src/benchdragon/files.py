"""Files appear whole or not at all, and never over one that was there unless asked."""

import io
import os
import secrets
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from benchdragon.errors import BenchDragonError, MachineError, reason
from benchdragon.i18n import _


class FileRefusedError(BenchDragonError):
    """A file that is in the way, or a folder that cannot be written."""


def refuse_existing(paths: Iterable[Path], force: bool) -> None:
    """Make the folders of `paths`; refuse if a file is there already and `force` is not set.

    Raises:
        FileRefusedError: naming the first one.
    """
    for path in paths:
        if path.exists() and not force:
            raise FileRefusedError(
                _("{path} is there already; use --force to overwrite it").format(path=path)
            )
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except (FileExistsError, NotADirectoryError):
            raise FileRefusedError(_("{path} is not a folder").format(path=path.parent)) from None
        except OSError as error:
            raise FileRefusedError(f"{path.parent}: {reason(error)}") from None
        if path.is_dir() or not os.access(path.parent, os.W_OK):
            raise FileRefusedError(_("{path} cannot be written").format(path=path))


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A temporary path beside `path` that takes its name once the block has ended well.

    Raises:
        MachineError: naming the file, if the system refuses to write it.
    """
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}{path.suffix}")
    try:
        yield temporary
        temporary.replace(path)
    except OSError as error:
        raise MachineError(
            _("{path} could not be written: {why}").format(path=path, why=reason(error))
        ) from None
    finally:
        temporary.unlink(missing_ok=True)


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
