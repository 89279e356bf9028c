"""Bring the Chinese catalogue up to date with what the program says, and compile it.

Takes every `_("...")` and `N_("...")` of the package, its pages' JavaScript too, and click's own
sentences, which the program looks up in the same catalogue. Translations that are still wanted stay,
others go, new ones stand empty. The same sources give the same bytes.
"""

import ast
import re
import sys
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import click
from babel.messages.catalog import Catalog
from babel.messages.extract import extract_from_file
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

import benchdragon
from benchdragon.cli.help import paragraphs

PACKAGE = Path(benchdragon.__file__).parent
CATALOGUE = PACKAGE / "locale" / "zh_CN" / "LC_MESSAGES" / "benchdragon.po"
# Those of click's files that speak to users; the others prompt, or draw bars, which we leave.
CLICK_FILES = ("core", "decorators", "exceptions", "formatting", "parser", "types")
# Code of others, which says nothing to users.
CARRIED = "carried.js"
KEYWORDS = {"_": None, "N_": None, "ngettext": (1, 2)}
# `say` of export/document.py looks up what it is given.
PYTHON_KEYWORDS = {**KEYWORDS, "say": None}
SCRIPT_OPTIONS = {"jsx": False, "parse_template_string": True}
# A text for users in a script, as it stands there.
SCRIPT_TEXT = re.compile(r"""(?<![\w$])(?:_|N_|ngettext)\(\s*["'`]""")

MessageId = str | tuple[str, ...]


class PlainCatalog(Catalog):
    """A catalogue whose header holds no dates and no names of programs."""

    mime_headers = property(
        lambda self: [
            ("Language", str(self.locale_identifier)),
            ("Plural-Forms", self.plural_forms),
            ("MIME-Version", "1.0"),
            ("Content-Type", "text/plain; charset=utf-8"),
            ("Content-Transfer-Encoding", "8bit\n"),
        ]
    )


def script_messages(script: Path) -> list[MessageId]:
    """What users may read of one script.

    Raises:
        ValueError: Babel does not see every text, or one holds a value already.
    """
    found = extract_from_file("javascript", script, KEYWORDS, options=SCRIPT_OPTIONS)
    messages = [message for _line, message, _comments, _context in found]
    texts = len(SCRIPT_TEXT.findall(script.read_text("utf-8")))
    if len(messages) != texts or any("${" in str(message) for message in messages):
        raise ValueError(
            f"{script.name}: {len(messages)} of {texts} texts can be translated; "
            "keep _() out of comments and templates, and values out of texts"
        )
    return messages


def verb_messages(source: Path) -> Iterator[str]:
    """The help of the command line's verbs: what their functions say of themselves."""
    for node in ast.walk(ast.parse(source.read_text("utf-8"))):
        if isinstance(node, ast.FunctionDef):
            said = ast.get_docstring(node)
            if said and any(ast.unparse(mark).startswith("verb(") for mark in node.decorator_list):
                yield paragraphs(said)


def extracted(package: Path = PACKAGE) -> Iterator[MessageId]:
    """Everything that users may read, our own and click's."""
    sources = sorted(package.rglob("*.py"))
    sources += [Path(click.__file__).with_name(f"{name}.py") for name in CLICK_FILES]
    for source in sources:
        for _line, message, _comments, _context in extract_from_file("python", source, PYTHON_KEYWORDS):
            if message:
                yield message
        if source.parent.name == "cli":
            yield from verb_messages(source)
    scripts = set((package / "web").rglob("*.js")) - {package / "web" / CARRIED}
    for script in sorted(scripts):
        yield from script_messages(script)


def updated(known: Catalog) -> Catalog:
    """The catalogue of everything extracted, with the translations that are known."""
    catalogue = PlainCatalog(
        locale="zh_CN",
        header_comment="# What the program says, in Simplified Chinese. Update: make generate",
        fuzzy=False,
    )
    for message in extracted():
        found = known.get(message)
        if found and found.id == message:
            catalogue.add(message, found.string, flags=found.flags)
        else:
            catalogue.add(message)
    return catalogue


def made(old: bytes) -> tuple[bytes, bytes, list[str]]:
    """The catalogue with the translations of an old one, the same compiled, and what has none yet."""
    catalogue = updated(read_po(BytesIO(old), locale="zh_CN"))
    text, compiled = BytesIO(), BytesIO()
    write_po(text, catalogue, sort_output=True, no_location=True)
    write_mo(compiled, catalogue)
    missing = [str(message.id) for message in catalogue if not any(message.string or "")]
    return text.getvalue().rstrip(b"\n") + b"\n", compiled.getvalue(), missing


def files() -> dict[Path, bytes]:
    """The catalogue, and the same compiled."""
    text, compiled, missing = made(CATALOGUE.read_bytes())
    for one in missing:
        print(f"not translated: {one}", file=sys.stderr)
    return {CATALOGUE: text, CATALOGUE.with_suffix(".mo"): compiled}
