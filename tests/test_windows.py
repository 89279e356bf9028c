"""Windows: what only POSIX has is taken away, and the command line runs all the same."""

import ast
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import cast

import pytest

from benchdragon import files
from benchdragon.paper.reproduce import pages_from

ROOT = Path(__file__).parents[1]
PACKAGE = Path(files.__file__).parent


def test_what_only_posix_has_is_not_needed(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-X", "warn_default_encoding", "-m", "tests.windows"],
        capture_output=True, text=True, check=False, cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), str(PACKAGE.parent)])},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    ours = [
        line for line in done.stderr.splitlines() if "EncodingWarning" in line and str(PACKAGE) in line
    ]
    assert ours == []


def text_calls(source: str) -> Iterator[ast.Call]:
    """Calls that may write a text into a file."""
    for node in ast.walk(ast.parse(source)):
        name = (
            node.func.attr
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
            else ""
        )
        if name == "write_text" or (name == "open" and "'w'" in ast.unparse(node)):
            yield cast("ast.Call", node)


def test_texts_have_the_same_bytes_on_all_systems() -> None:
    """Windows writes another end of line, unless it is told."""
    found = {
        ast.unparse(call): {word.arg for word in call.keywords}
        for path in PACKAGE.rglob("*.py")
        if path.name != "help.py"  # click's own `write_text` writes no file
        for call in text_calls(path.read_text("utf-8"))
    }
    assert len(found) > 1
    assert [call for call, words in found.items() if "newline" not in words] == []


def test_what_is_read_in_any_encoding_is_ascii() -> None:
    """lazy-loader reads the front door so."""
    assert (PACKAGE / "__init__.pyi").read_bytes().isascii()


def test_pages_on_another_drive_are_linked_by_their_address(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "established.html").touch()

    def refuse(_path: object, _start: object) -> str:
        raise ValueError("path is on mount 'D:', start on mount 'C:'")

    monkeypatch.setattr("benchdragon.paper.reproduce.os.path.relpath", refuse)
    assert pages_from(tmp_path / "out", str(tmp_path)) == tmp_path.as_uri()
