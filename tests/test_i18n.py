import asyncio
import ctypes
import os
import re
import subprocess
import sys
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from babel.messages.catalog import Catalog, Message
from babel.messages.pofile import read_po
from matplotlib.ft2font import FT2Font

from benchdragon.figures.style import FONT_FOLDER
from benchdragon.i18n import (
    LOCALE_FOLDER,
    _,
    language,
    preferred_language,
    spoken_in,
    use_language,
)
from tests.scripts import script

ROOT = Path(__file__).parent.parent
CATALOGUE = LOCALE_FOLDER / "zh_CN" / "LC_MESSAGES" / "benchdragon.po"
VARIABLES = ("BENCHDRAGON_LANG", "LC_ALL", "LC_MESSAGES", "LANG")
# Full-width signs and ideographs; and two words of an English sentence.
CHINESE = re.compile(r"[\u3000-\u9fff\uff00-\uffef]")
ENGLISH = re.compile(r"[A-Za-z]{2,} [a-z]{2,}")
COMMAND_LINES = {
    "help": ["--help"],
    "help of a verb": ["motion", "--help"],
    "unknown plan": ["motion", "nosuchplan", "--at", "3"],
    "misspelt plan": ["motion", "spiral-im", "--at", "3"],
    "wrong time": ["motion", "spiral-in", "--at", "x"],
    "unknown option": ["motion", "--nosuchoption"],
    "misspelt verb": ["motio"],
    "no plan": ["motion"],
    "one argument too many": ["motion", "spiral-in", "turn"],
    "wrong choice": ["motion", "spiral-in", "--leader", "x"],
    "number out of range": ["motion", "spiral-in", "--workers", "0"],
    "option without its value": ["motion", "spiral-in", "--at"],
}


TOOL: Any = script("tools/make_messages.py")


def catalogue(path: Path = CATALOGUE) -> Catalog:
    with path.open("rb") as source:
        return read_po(source, locale="zh_CN")


def messages() -> list[Message]:
    return [message for message in catalogue() if message.id]


def forms(text: str | Iterable[str] | None) -> list[str]:
    """The singular and plural forms of an id or of a translation."""
    return [text] if isinstance(text, str) else list(text or ())


def placeholders(text: str) -> list[str]:
    return sorted(re.findall(r"\{.*?\}|%\(\w+\)\w|%\w", text))


def said(*arguments: str) -> str:
    """All that one command line prints, in a process of its own."""
    environment = {**os.environ, "PYTHONUTF8": "1", "COLUMNS": "80"}
    command = [sys.executable, "-m", "benchdragon", *arguments]
    done = subprocess.run(command, capture_output=True, check=False, env=environment)
    return (done.stdout + done.stderr).decode()


def test_every_sentence_of_the_program_and_of_click_is_translated() -> None:
    known = catalogue()
    wanted = list(TOOL.extracted())
    assert {"Options", "Where every handle of a bench dragon is, and how fast, on any route."} < {
        message for message in wanted if isinstance(message, str)
    }
    for message in wanted:
        found = known.get(message)
        assert found is not None, message
        assert found.id == message
        assert all(forms(found.string)), message
        assert not found.fuzzy, message


def test_placeholders_survive_the_translation() -> None:
    for message in messages():
        wanted = [placeholders(form) for form in forms(message.id)]
        for translation in forms(message.string):
            assert placeholders(translation) in wanted, message.id


def test_the_tool_keeps_what_is_wanted_drops_what_is_not_and_names_what_is_missing(
    tmp_path: Path,
) -> None:
    old = 'msgid "Positions"\nmsgstr "位置"\n\nmsgid "Long gone"\nmsgstr "早已不用"\n'
    text, _compiled, missing = TOOL.made(old.encode())
    (tmp_path / "new.po").write_bytes(text)
    made = catalogue(tmp_path / "new.po")
    places = made.get("Positions")
    assert places is not None
    assert places.string == "位置"
    assert "Long gone" not in made
    assert "Speeds" in missing
    assert "Positions" not in missing


def test_what_pages_say_is_wanted_too(tmp_path: Path) -> None:
    script = tmp_path / "web" / "page.js"
    script.parent.mkdir()
    script.write_text(
        "const lines = a <b && /it's/.test(c);\n"
        'show(_("Faster than " + "before"), `${_("Slower")} ${x}`, NAMES[N_(\'Turn\')], _(given));\n'
        'show(ngettext("%d dance", "%d dances", n)));\n',
        encoding="utf-8",
    )
    ours = set(TOOL.extracted(tmp_path)) - set(TOOL.extracted(tmp_path / "empty"))
    assert ours == {"Faster than before", "Slower", "Turn", ("%d dance", "%d dances")}


@pytest.mark.parametrize(
    "line",
    ["`<b title=\"${_('Unseen')}\"></b>`", '1 /* _("Never said") */', "_(`${n} benches`)"],
)
def test_a_text_that_could_not_be_translated_is_an_error(tmp_path: Path, line: str) -> None:
    script = tmp_path / "page.js"
    script.write_text(f"show({line});\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"page\.js: [01] of 1 texts"):
        TOOL.script_messages(script)


def test_every_sign_of_the_translations_can_be_drawn() -> None:
    known = set(FT2Font(str(FONT_FOLDER / "NotoSansSC-Regular.ttf")).get_charmap())
    text = "".join(form for message in messages() for form in forms(message.string))
    assert {sign for sign in text if not sign.isspace() and ord(sign) not in known} == set()


def test_the_language_is_what_was_asked_then_what_the_surroundings_say(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
    assert preferred_language() == "en"
    assert preferred_language("zh") == "zh"
    # From the weakest to the strongest; each overrules those before it, and an empty one says nothing.
    language = "en"
    for name in reversed(VARIABLES):
        monkeypatch.setenv(name, "")
        assert preferred_language() == language
        language = "en" if language == "zh" else "zh"
        monkeypatch.setenv(name, {"zh": "zh_CN.UTF-8", "en": "en_GB.UTF-8"}[language])
        assert preferred_language() == language
        assert preferred_language("zh") == "zh"
        assert preferred_language("en") == "en"


@pytest.mark.parametrize(("number", "language"), [(0x0804, "zh"), (0x0409, "en"), (0, "en")])
def test_on_windows_which_has_no_such_variables_its_own_language_is_spoken(
    monkeypatch: pytest.MonkeyPatch, number: int, language: str
) -> None:
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
    system = SimpleNamespace(kernel32=SimpleNamespace(GetUserDefaultUILanguage=lambda: number))
    monkeypatch.setattr(ctypes, "windll", system, raising=False)
    assert preferred_language() == language


def test_tasks_and_threads_may_speak_languages_of_their_own() -> None:
    async def said_in(spoken: str, other: asyncio.Event, mine: asyncio.Event) -> tuple[str, str]:
        with spoken_in(spoken):
            mine.set()
            await other.wait()
            return language(), _("Positions")

    async def both() -> list[tuple[str, str]]:
        a, b = asyncio.Event(), asyncio.Event()
        return list(await asyncio.gather(said_in("en", b, a), said_in("zh", a, b)))

    assert asyncio.run(both()) == [("en", "Positions"), ("zh", "位置")]
    with spoken_in("zh"), ThreadPoolExecutor(1) as pool:
        assert _("Positions") == "位置"
        assert pool.submit(_, "Positions").result() == "Positions"
    assert language() == "en"


def test_a_language_of_ones_own_yields_to_no_default() -> None:
    with spoken_in("en"):
        use_language("zh")
        assert _("Positions") == "Positions"
    assert _("Positions") == "位置"
    use_language("en")


@pytest.mark.parametrize("name", COMMAND_LINES)
def test_chinese_is_spoken_throughout(name: str) -> None:
    text = said("--lang", "zh", *COMMAND_LINES[name])
    assert CHINESE.search(text)
    assert ENGLISH.findall(re.sub(r"benchdragon( motion)?", "", text)) == []


@pytest.mark.parametrize("name", COMMAND_LINES)
def test_english_has_no_chinese_in_it(name: str) -> None:
    text = said("--lang", "en", *COMMAND_LINES[name])
    assert ENGLISH.search(text)
    assert CHINESE.findall(text) == []


def test_the_language_may_be_asked_after_the_verb() -> None:
    assert said("motion", "--lang=zh", "--help") == said("--lang", "zh", "motion", "--help")
