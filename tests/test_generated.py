"""Files that are made from other files are as their tools make them."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from tools import make_messages
from tools.generate import TOOLS, stale, write
from tools.make_twins import FOLDER, files


@pytest.mark.parametrize("tool", TOOLS.values(), ids=TOOLS)
def test_what_is_made_is_committed(tool: SimpleNamespace) -> None:
    assert list(stale(tool)) == [], "run `make generate`"


def test_every_sentence_has_its_translation() -> None:
    assert make_messages.made(make_messages.CATALOGUE.read_bytes())[2] == []


def test_no_module_of_pages_is_left_that_nothing_makes() -> None:
    assert set(FOLDER.iterdir()) == set(files())


def test_only_what_is_stale_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    one, other = tmp_path / "one.js", tmp_path / "other.po"
    tool = SimpleNamespace(files=lambda: {one: "\u9f99\n", other: b"\x00"})
    monkeypatch.setitem(TOOLS, "dragons", tool)
    one.write_text("\u9f99\n", "utf-8", newline="\n")
    assert stale(tool) == {other: b"\x00"}
    write("dragons")
    write("dragons")
    assert (one.read_bytes(), other.read_bytes()) == ("\u9f99\n".encode(), b"\x00")
    assert capsys.readouterr().out == "dragons: other.po\ndragons: as before\n"
