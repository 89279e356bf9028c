"""What users read, in English or Simplified Chinese: one gettext catalogue.

The language is chosen once for the process; a server's answers may each speak their own (`spoken_in`).
"""

import ctypes
import gettext
import locale
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

LANGUAGES = ("en", "zh")
LOCALE_FOLDER = Path(__file__).parent / "locale"

CATALOGUES = {"en": "en", "zh": "zh_CN"}

_language = "en"
# What is spoken here instead: in one task, or one thread, alone.
_here: ContextVar[str | None] = ContextVar("language", default=None)


def preferred_language(asked: str | None = None) -> str:
    """`asked`, else BENCHDRAGON_LANG, else what the locale says: "en" or "zh"."""
    candidates = [asked, os.environ.get("BENCHDRAGON_LANG")]
    candidates += [os.environ.get(name) for name in ("LC_ALL", "LC_MESSAGES", "LANG")]
    chosen = next((name for name in [*candidates, _windows_language()] if name), "en")
    return "zh" if chosen.lower().startswith("zh") else "en"


def _windows_language() -> str | None:
    """The language in which Windows speaks, such as "zh_CN"; None on other systems."""
    library: Any = getattr(ctypes, "windll", None)
    return library and locale.windows_locale.get(library.kernel32.GetUserDefaultUILanguage())


def use_language(language: str) -> None:
    """Speak `language`, one of LANGUAGES, from here on; click's own sentences follow."""
    global _language  # noqa: PLW0603 - the language is one for the process
    name = CATALOGUES[language]
    _language = language
    os.environ["LANGUAGE"] = name
    gettext.bindtextdomain("benchdragon", LOCALE_FOLDER)
    gettext.textdomain("benchdragon")


@contextmanager
def spoken_in(language: str) -> Iterator[None]:
    """Speak `language` inside the block, in this task or thread; others go on in theirs."""
    token = _here.set(language)
    try:
        yield
    finally:
        _here.reset(token)


def language() -> str:
    """The language in use, "en" or "zh"."""
    return _here.get() or _language


@dataclass(frozen=True)
class Words:
    """The same words in both languages."""

    en: str
    zh: str


def both(say: Callable[[], str]) -> Words:
    """What `say` says in both languages."""
    said = {}
    for name in LANGUAGES:
        with spoken_in(name):
            said[name] = say()
    return Words(**said)


@cache
def _catalogue(language: str) -> gettext.NullTranslations:
    return gettext.translation("benchdragon", LOCALE_FOLDER, [CATALOGUES[language]], fallback=True)


def _(text: str) -> str:
    """`text` in the language in use."""
    return _catalogue(language()).gettext(text) if text else text


def N_(text: str) -> str:
    """`text` itself, marked for the catalogue and translated later."""
    return text
