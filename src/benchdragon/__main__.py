"""`benchdragon` and `python -m benchdragon`: choose the language, then run the command line."""

import io
import itertools
import os
import signal
import sys
import traceback
from types import FrameType
from typing import TextIO

from benchdragon.i18n import preferred_language, use_language

# A fault of the program itself, as sysexits.h has it.
BROKEN = 70
ENDINGS = ("SIGTERM", "SIGHUP", "SIGBREAK")  # the last on Windows: its window is closed


def asked_language(arguments: list[str]) -> str | None:
    """What --lang says, read ahead because the help texts need it first."""
    for here, following in itertools.pairwise([*arguments, ""]):
        if here == "--":
            break
        if here == "--lang":
            return following
        if here.startswith("--lang="):
            return here.removeprefix("--lang=")
    return None


def main() -> None:
    """Run the command line and exit with its code; never 1, "not safe", for what went wrong."""
    try:
        _open_streams()
        _hear_endings()
        _choose_language(sys.argv[1:])
        from benchdragon.cli.main import run  # click must meet the chosen language

        code = run(sys.argv[1:])
    except KeyboardInterrupt:
        code = 128 + signal.SIGINT
    except Exception:
        traceback.print_exc()
        code = BROKEN
    _drop_unprinted()
    sys.exit(code)


def _open_streams() -> None:
    """Leave no stream closed or too narrow for what is printed, whatever the caller did with it."""
    for name in ("stdin", "stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "r" if name == "stdin" else "w", encoding="utf-8"))  # noqa: PTH123, SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.errors in ("strict", "surrogateescape"):
            stream.reconfigure(errors="backslashreplace")


def _hear_endings() -> None:
    """Let a request to end run through all that tidies up, as Ctrl-C does; what is deaf stays deaf."""
    for name in ENDINGS:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _end)


def _end(number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt(number)


def _drop_unprinted() -> None:
    """Let what could not be printed go, lest Python try it again at the end and complain."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _choose_language(arguments: list[str]) -> None:
    """Use the requested language, or English where the streams cannot encode Chinese."""
    language = preferred_language(asked_language(arguments))
    use_language(language)
    if language == "zh" and not all(_speaks_chinese(stream) for stream in (sys.stdout, sys.stderr)):
        use_language("en")
        print(
            f"Note: the encoding {sys.stdout.encoding} has no Chinese signs, so English is spoken; "
            "for Chinese set PYTHONIOENCODING=utf-8",
            file=sys.stderr,
        )


def _speaks_chinese(stream: TextIO) -> bool:
    try:
        "板凳龙盘入长度".encode(stream.encoding)
    except UnicodeEncodeError:
        return False
    return True


if __name__ == "__main__":
    main()
