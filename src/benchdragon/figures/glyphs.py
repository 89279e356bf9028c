"""Signs of names that the package's fonts lack: another font's, else their code, and never a box."""

import unicodedata
from functools import cache
from pathlib import Path

from matplotlib import font_manager
from matplotlib.ft2font import FT2Font

from benchdragon.figures.style import package_signs

# OS/2.fsType of fonts that may not be put into documents.
NO_EMBEDDING = 0x2
# Fonts that map more signs to a glyph than this draw boxes in place of signs.
MOST_SIGNS_A_GLYPH = 2.0
# Fonts of the system that are looked through for a sign.
MOST_FONTS = 1000
# Where WSL shows the fonts of the Windows beneath it: those of all users, and of each.
WINDOWS = Path("/mnt/c")
WINDOWS_FONTS = ("Windows/Fonts/*.*", "Users/*/AppData/Local/Microsoft/Windows/Fonts/*.*")
FONT_ENDINGS = (".ttf", ".ttc", ".otf")
# What the names of its Chinese fonts begin with, the one with the most signs first.
WINDOWS_FIRST = ("simsun", "msyh", "deng", "sim")


def printable(text: str) -> str:
    """`text` as papers can print it: signs that no font here has become 〔U+5586〕.

    Signs that another font of the system has stay: see `spare_fonts`. What shows nothing is dropped.
    """
    return "".join(_printed(sign) for sign in text if not _unseen(sign))


def spare_fonts(text: str) -> tuple[Path, ...]:
    """Font files of the system, whose first faces hold signs of `text` that the package's lack."""
    found = (_spare(sign) for sign in dict.fromkeys(text) if _lacking(sign))
    return tuple(dict.fromkeys(path for path in found if path is not None))


def _printed(sign: str) -> str:
    if _lacking(sign) and _spare(sign) is None:
        return f"〔U+{ord(sign):04X}〕"
    return sign


def _unseen(sign: str) -> bool:
    """Whether a sign only tells how others are shown: marks of direction, variation selectors."""
    code = ord(sign)
    return unicodedata.category(sign) == "Cf" or 0xFE00 <= code <= 0xFE0F or 0xE0100 <= code <= 0xE01EF


def _lacking(sign: str) -> bool:
    return not sign.isspace() and ord(sign) not in package_signs()


@cache
def _spare(sign: str) -> Path | None:
    """The font of the system, or of the Windows beneath it, that prints a sign."""
    if unicodedata.category(sign) in ("Co", "Cs", "Cn", "Cc"):
        return None  # that code is another sign in each font, or none
    return next(
        (path for path in (*_system_fonts(), *_windows_fonts()) if ord(sign) in _signs(path)), None
    )


@cache
def _system_fonts() -> tuple[Path, ...]:
    """Font files of the system, regular ones first."""
    entries = sorted(
        (one for one in font_manager.fontManager.ttflist if not getattr(one, "index", 0)),
        key=lambda one: (one.style != "normal", abs(_weight(one.weight) - 400), one.fname),
    )
    return tuple(dict.fromkeys(Path(one.fname) for one in entries))[:MOST_FONTS]


@cache
def _windows_fonts() -> tuple[Path, ...]:
    """Font files of Windows as WSL shows them, Chinese ones first; none elsewhere."""
    found = (path for pattern in WINDOWS_FONTS for path in WINDOWS.glob(pattern))
    return tuple(
        sorted((path for path in found if path.suffix.lower() in FONT_ENDINGS), key=_chinese_first)
    )[:MOST_FONTS]


def _chinese_first(path: Path) -> tuple[int, str]:
    name = path.name.lower()
    first = next(
        (n for n, start in enumerate(WINDOWS_FIRST) if name.startswith(start)), len(WINDOWS_FIRST)
    )
    return first, name


def _weight(said: object) -> int:
    return int(said) if isinstance(said, int | float) else font_manager.weight_dict.get(str(said), 400)


@cache
def _signs(path: Path) -> frozenset[int]:
    """Code points that a font file prints; none if it cannot be read or may not be embedded."""
    try:
        font = FT2Font(str(path))
    except (OSError, RuntimeError):
        return frozenset()  # gone since the system was asked for its fonts
    about = font.get_sfnt_table("OS/2")
    if about is not None and int(about["fsType"]) & 0xF == NO_EMBEDDING:
        return frozenset()
    signs = font.get_charmap()
    return frozenset(signs) if len(signs) <= MOST_SIGNS_A_GLYPH * font.num_glyphs else frozenset()
