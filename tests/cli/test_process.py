import io
import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from benchdragon import __main__ as program
from benchdragon.cli import main as cli
from benchdragon.i18n import use_language

QUESTION = ("motion", "spiral-in", "--at", "3", "--only", "0")


@pytest.fixture(autouse=True)
def as_before() -> Iterator[None]:
    """Signals are heard, and English is spoken, as before the test."""
    names = [number for name in program.ENDINGS if (number := getattr(signal, name, None))]
    handlers = {number: signal.getsignal(number) for number in names}
    yield
    for number, handler in handlers.items():
        signal.signal(number, handler)
    use_language("en")


def ran(
    monkeypatch: pytest.MonkeyPatch, *arguments: str, encoding: str = "utf-8"
) -> tuple[Any, str, str]:
    """Exit code and both streams of the whole program, its streams in an encoding."""
    streams = {name: io.TextIOWrapper(io.BytesIO(), encoding) for name in ("stdout", "stderr")}
    for name, stream in streams.items():
        monkeypatch.setattr(sys, name, stream)
    monkeypatch.setattr(sys, "argv", ["benchdragon", *arguments])
    with pytest.raises(SystemExit) as ended:
        program.main()
    monkeypatch.undo()
    texts = []
    for stream in streams.values():
        stream.flush()
        texts.append(stream.buffer.getvalue().decode(encoding))
    return ended.value.code, texts[0], texts[1]


def in_shell(command: str, **more: str) -> subprocess.CompletedProcess[str]:
    """`command` run by a shell, in which $B is the program."""
    environment = {**os.environ, "B": f"{sys.executable} -m benchdragon", **more}
    return subprocess.run(
        ["bash", "-c", command], capture_output=True, text=True, check=False, env=environment
    )


def test_without_a_verb_the_help_is_shown_as_for_wrong_usage(monkeypatch: pytest.MonkeyPatch) -> None:
    code, out, err = ran(monkeypatch)
    assert (code, out) == (2, "")
    assert err.startswith("Usage: benchdragon")
    assert "  motion " in err


@pytest.mark.parametrize("encoding", ["cp1252", "ascii", "big5"])
def test_where_chinese_cannot_be_written_english_is_spoken_and_a_note_says_why(
    monkeypatch: pytest.MonkeyPatch, encoding: str
) -> None:
    code, out, err = ran(monkeypatch, *QUESTION, "--lang", "zh", encoding=encoding)
    assert code == 0
    assert "speed (m/s)" in out
    assert err.splitlines() == [
        f"Note: the encoding {encoding} has no Chinese signs, so English is spoken; "
        "for Chinese set PYTHONIOENCODING=utf-8"
    ]


@pytest.mark.parametrize("encoding", ["gbk", "gb18030", "utf-8"])
def test_chinese_is_spoken_in_every_encoding_that_has_it(
    monkeypatch: pytest.MonkeyPatch, encoding: str
) -> None:
    code, out, err = ran(monkeypatch, *QUESTION, "--lang", "zh", encoding=encoding)
    assert (code, err) == (0, "")
    assert "时间" in out


def test_a_sign_that_cannot_be_written_is_escaped(monkeypatch: pytest.MonkeyPatch) -> None:
    code, out, err = ran(monkeypatch, *QUESTION, "--set", "meta.title='龙'", encoding="cp1252")
    assert (code, err) == (0, "")
    assert "\\u9f99" in out
    code, out, err = ran(monkeypatch, "motion", "龙", "--at", "3", encoding="cp1252")
    assert (code, out) == (3, "")
    assert "there is no plan \\u9f99" in err


def test_a_file_whose_name_is_no_text_is_named_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    code, out, err = ran(monkeypatch, "motion", "x\udcff.toml", "--at", "3")
    assert (code, out) == (3, "")
    assert "there is no plan x\\udcff.toml" in err


@pytest.mark.parametrize("encoding", ["cp1252", "ascii", "utf-8"])
@pytest.mark.parametrize(
    "verb", [("schema",), (*QUESTION, "--json", "--explain"), ("doctor", "--json")]
)
def test_json_is_json_in_every_encoding(
    monkeypatch: pytest.MonkeyPatch, verb: tuple[str, ...], encoding: str
) -> None:
    code, out, _err = ran(monkeypatch, *verb, encoding=encoding)
    assert code == 0
    assert json.loads(out)


@pytest.mark.parametrize(
    ("command", "code", "err"),
    [
        ("$B doctor --json >&-", 0, ""),
        ("$B doctor --json <&- >&- 2>&-", 0, ""),
        ("$B doctor --json >/dev/full", 6, "Error: the disk is full\n"),
        ("$B doctor --json >/dev/full 2>&1", 6, ""),
        ("$B motion spiral-in --at x 2>/dev/full", 2, ""),
        ("$B motion spiral-in --at x 2>&-", 2, ""),
        ("$B --help | head -0; exit ${PIPESTATUS[0]}", 141, ""),
        ("$B doctor --json | head -0; exit ${PIPESTATUS[0]}", 141, ""),
        ("$B motion spiral-in --at x 2>&1 | head -0; exit ${PIPESTATUS[0]}", 2, ""),
    ],
)
def test_streams_that_are_closed_or_full_are_no_verdict(command: str, code: int, err: str) -> None:
    done = in_shell(command)
    assert (done.returncode, done.stdout, done.stderr) == (code, "", err)


def test_a_fault_of_the_program_is_no_verdict_either(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_arguments: list[str]) -> int:
        raise ZeroDivisionError

    monkeypatch.setattr(cli, "run", broken)
    code, out, err = ran(monkeypatch, *QUESTION)
    assert (code, out) == (70, "")
    assert "ZeroDivisionError" in err


def test_memory_that_runs_out_is_no_verdict_either(monkeypatch: pytest.MonkeyPatch) -> None:
    def greedy(*_arguments: object) -> int:
        raise MemoryError

    monkeypatch.setattr(cli, "_motion_json", greedy)
    code, out, err = ran(monkeypatch, *QUESTION, "--json")
    assert (code, out, err) == (6, "", "Error: memory ran out\n")


@pytest.mark.parametrize(("name", "code"), [("SIGTERM", 143), ("SIGHUP", 129), ("SIGINT", 130)])
def test_no_signal_leaves_anything_half_written(tmp_path: Path, name: str, code: int) -> None:
    script = (
        "import os, signal, sys; from benchdragon import __main__ as program\n"
        "from benchdragon.export import tables\n"
        # A background job of a shell is born deaf to SIGINT.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "signal.signal(signal.SIGHUP, signal.SIG_DFL)\n"  # and one of nohup to SIGHUP
        f"tables._long = lambda *_: os.kill(os.getpid(), signal.{name})\n"
        f"sys.argv = 'benchdragon motion spiral-in --at 0,9 -o {tmp_path / 'out'} --quiet'.split()\n"
        "program.main()"
    )
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False, env=environment
    )
    assert done.returncode == code
    assert done.stderr.strip() == "interrupted; nothing half-written is left"
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["motion.xlsx"]


def test_who_was_told_not_to_hear_a_hangup_does_not() -> None:
    script = (
        "import signal; signal.signal(signal.SIGHUP, signal.SIG_IGN)\n"
        "from benchdragon import __main__ as program; program._hear_endings()\n"
        "print(signal.getsignal(signal.SIGHUP).name, signal.getsignal(signal.SIGTERM).__name__)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["SIG_IGN", "_end"]
