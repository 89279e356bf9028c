"""What users read, in English or Simplified Chinese: one gettext catalogue, chosen once."""

import gettext
import os
from pathlib import Path

LANGUAGES = ("en", "zh")
LOCALE_FOLDER = Path(__file__).parent / "locale"

_current: gettext.NullTranslations = gettext.NullTranslations()
_language = "en"


def preferred_language(asked: str | None = None) -> str:
    """`asked`, else BENCHDRAGON_LANG, else what the locale says: "en" or "zh"."""
    candidates = [asked, os.environ.get("BENCHDRAGON_LANG")]
    candidates += [os.environ.get(name) for name in ("LC_ALL", "LC_MESSAGES", "LANG")]
    chosen = next((name for name in candidates if name), "en")
    return "zh" if chosen.lower().startswith("zh") else "en"


def use_language(language: str) -> None:
    """Speak `language`, one of LANGUAGES, from here on; click's own sentences follow."""
    global _current, _language  # noqa: PLW0603 - the language is one for the process
    names = {"en": ["en"], "zh": ["zh_CN"]}[language]
    _current = gettext.translation("benchdragon", LOCALE_FOLDER, names, fallback=True)
    _language = language
    os.environ["LANGUAGE"] = names[0]
    gettext.bindtextdomain("benchdragon", LOCALE_FOLDER)
    gettext.textdomain("benchdragon")


def language() -> str:
    """The language in use, "en" or "zh"."""
    return _language


def _(text: str) -> str:
    """`text` in the language in use."""
    return _current.gettext(text) if text else text


def N_(text: str) -> str:
    """`text` itself, marked for the catalogue and translated later."""
    return text
