"""Pages of one file: their modules, styles and words, and what they hold, as the text of it.

Each module keeps its own names: it becomes a function's body, except the one that is requested.
"""

import base64
import hashlib
import json
import posixpath
import re
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from benchdragon.i18n import _, both, spoken_in
from benchdragon.version import __version__

WEB = Path(__file__).parent / "web"
# Modules may import others so, and in no other way.
IMPORT = re.compile(r'^import \{([^}]*)\} from "(\.\.?/(?:\w+/)*\w+\.js)";\n', re.MULTILINE)
EXPORT = re.compile(
    r"^export (?=(?:const|let|class|function\*?|async function\*?) (\w+))", re.MULTILINE
)
# Names that are taken out of an object.
TAKEN = re.compile(r"^export (?=const \{([\w\s,]*)\} = )", re.MULTILINE)
# What a bundler writes at the end of a module.
LIST = re.compile(r"^export \{([^}]*)\};?$\n?", re.MULTILINE)
STRAY = re.compile(r"^\s*(?:import|export)\b.*", re.MULTILINE)
TEXT = re.compile(r'(?<![\w$.])(?:_|N_)\(\s*("(?:[^"\\]|\\.)*")')


class ScriptError(ValueError):
    """A module of the page that cannot be put into one file."""


@cache
def inlined(entry: str) -> str:
    """A module of the page and all it imports as one script, each before those that need it.

    What `entry` exports are names of the script.

    Raises:
        ScriptError: for an import or an export of another form, and for a circle of imports.
    """
    done: dict[str, str] = {}
    under_way: list[str] = []

    def add(name: str) -> None:
        if name in under_way:
            raise ScriptError(f"a circle of imports: {', '.join([*under_way, name])}")
        if name in done:
            return
        under_way.append(name)
        text = (WEB / name).read_text("utf-8")
        for _names, path in IMPORT.findall(text):
            add(_resolved(name, path))
        under_way.pop()
        done[name] = _joined(name, text, name == entry)

    add(entry)
    return "\n".join(done.values())


def _joined(name: str, text: str, entry: bool) -> str:
    """A module, with names that it takes from those before it in place of its imports."""
    given = ", ".join(_pair(outside, inside) for inside, outside in exported(text))
    text = IMPORT.sub(lambda found: _taken(name, *found.groups()), text)
    text = LIST.sub("", TAKEN.sub("", EXPORT.sub("", text)))
    if stray := STRAY.search(text):
        raise ScriptError(f"{name}: {stray.group().strip()}")
    if entry:
        return text
    return f"const {_variable(name)} = (() => {{\n{text}return {{ {given} }};\n}})();\n"


def exported(text: str) -> list[tuple[str, str]]:
    """What a module exports: names inside of it, and those that others call them by."""
    found = [(name, name) for name in EXPORT.findall(text)]
    for names in [*TAKEN.findall(text), *LIST.findall(text)]:
        found += _pairs(names)
    return found


def _taken(importer: str, names: str, path: str) -> str:
    """The replacement of an import."""
    pattern = ", ".join(_pair(outside, inside) for outside, inside in _pairs(names))
    return f"const {{ {pattern} }} = {_variable(_resolved(importer, path))};\n"


def _pairs(names: str) -> list[tuple[str, str]]:
    """Names in the braces of an import or an export: those before and those after `as`."""
    told = [name.split(" as ") for name in names.split(",") if name.strip()]
    return [(name[0].strip(), name[-1].strip()) for name in told]


def _pair(key: str, name: str) -> str:
    """A key of an object and the name of its value, as the literal or pattern has them."""
    return key if key == name else f"{key}: {name}"


def _resolved(importer: str, path: str) -> str:
    """The path of an imported module below the folder of all, or ScriptError."""
    name = posixpath.normpath(posixpath.join(posixpath.dirname(importer), path))
    if name.startswith(".."):
        raise ScriptError(f"{importer}: {path}")
    return name


def _variable(name: str) -> str:
    """The name of a module in the script."""
    return "$" + name.removesuffix(".js").replace("/", "_")


@cache
def chinese(*entries: str) -> dict[str, str]:
    """Chinese for every sentence of some scripts."""
    texts = [text for entry in entries for text in TEXT.findall(inlined(entry))]
    with spoken_in("zh"):
        return {text: _(text) for text in map(json.loads, texts)}


def html_page(
    template: str,
    entry: str,
    styles: Iterable[str],
    language: str,
    held: Mapping[str, Any],
    **more: Any,
) -> str:
    """A page that runs what a module exports as `start`, beginning in a language ("en" or "zh").

    Args:
        template: the name of its template.
        entry: the module.
        styles: their names.
        language: "en" or "zh".
        held: data that it finds in elements of these names.
        more: what the template takes beside.
    """
    script, style = f"{inlined(entry)}\nawait start();\n", joined_styles(styles)
    environment = Environment(
        loader=PackageLoader("benchdragon"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
    )
    waiting = both(
        lambda: _("Nothing moves? Then open this file in a browser: previews do not run it.")
    )
    return environment.get_template(template).render(
        language=language,
        version=__version__,
        hashes={"script": content_hash(script), "style": content_hash(style)},
        script=script,
        style=style,
        waiting=asdict(waiting),
        held={"language": inert(language)} | {name: inert(data) for name, data in held.items()},
        **more,
    )


def joined_styles(names: Iterable[str]) -> str:
    """Styles of the page, one after the other."""
    return "".join((WEB / name).read_text("utf-8") for name in names)


def inert(data: Any) -> str:
    """Data as JSON that may stand inside a script element."""
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")


def content_hash(text: str) -> str:
    """How a content security policy names a script or a style."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
