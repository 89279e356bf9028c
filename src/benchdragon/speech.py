"""The language of texts, for users of Python."""

from benchdragon.errors import InputError, brief
from benchdragon.i18n import LANGUAGES, _, preferred_language
from benchdragon.i18n import use_language as speak


def use_language(language: str | None = None) -> None:
    """Choose the language of errors, reports and pictures, from here on.

    Args:
        language: "en" or "zh"; None: as BENCHDRAGON_LANG says, else the system.

    Raises:
        InputError: for another language.

    Examples:
        >>> bd.use_language("zh")
        >>> bd.Line(-1.0)
        Traceback (most recent call last):
            ...
        benchdragon.errors.InputError: length 必须是正数，不能是 -1.0 m
        >>> bd.use_language("en")
    """
    if language not in (None, *LANGUAGES):
        text = _("language must be one of {names}, not {value}")
        raise InputError(text.format(names=", ".join(LANGUAGES), value=brief(language)))
    speak(language or preferred_language())
