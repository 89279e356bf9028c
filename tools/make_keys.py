"""Write the tables of all keys of plan files into the manual's page, in both languages.

They come from `benchdragon.plans.sections`, between two comments of the page; the same keys give the
same bytes.
"""

import re
from pathlib import Path

from benchdragon.i18n import LANGUAGES, _, spoken_in
from benchdragon.plans.keys import rows
from benchdragon.plans.sections import SECTIONS

PAGES = Path(__file__).parent.parent / "docs"
# Headers, and keys with or without a value, as they stand in files: `[turn]`, `route.kind = "turn"`.
CODE = re.compile(r'\[\[?[a-z.]+\]\]?|\b[a-z]+\.[a-z]+\b(?: = "[a-z-]+")?')
MARKED = re.compile(r"(?<=<!-- keys -->\n).*(?=<!-- end of keys -->)", re.DOTALL)


def marked(text: str) -> str:
    """A text whose headers and keys are marked as code."""
    return CODE.sub(r"`\g<0>`", text)


def tables() -> str:
    """All keys as tables in Markdown, in the language in use."""
    parts = []
    for section in SECTIONS:
        columns = (_("key"), _("what it is"), _("unit"), _("default"), _("example"))
        lines = [f"### `{section.header or 'schema'}`", "", marked(_(section.text)), ""]
        lines += [f"| {' | '.join(columns)} |", "|---" * len(columns) + "|"]
        for name, text, unit, default, example in rows(section):
            said = f"`{default}`" if default not in ("-", _("must be said")) else default
            cells = (f"`{name}`", marked(text), unit.replace("^2", "²"), said, f"`{example}`")
            lines.append(f"| {' | '.join(cells)} |")
        parts.append("\n".join(lines))
    return "\n" + "\n\n".join(parts) + "\n\n"


def page(language: str) -> tuple[Path, str]:
    """The page of a language, and its text with the tables as they are now."""
    path = PAGES / language / "plan-files.md"
    with spoken_in(language):
        return path, MARKED.sub(lambda _old: tables(), path.read_text("utf-8"))


def files() -> dict[Path, str]:
    """The pages of both languages."""
    return dict(map(page, LANGUAGES))
