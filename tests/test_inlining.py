"""Modules of a page as one script: each once, before those that need it, with names of its own."""

import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from benchdragon import inlining
from benchdragon.inlining import (
    IMPORT,
    TEXT,
    WEB,
    ScriptError,
    chinese,
    content_hash,
    exported,
    inert,
    inlined,
    joined_styles,
)
from tests.engine.recording import node

MODULES = sorted(WEB.rglob("*.js"))
IDEOGRAPH = re.compile(r"[\u4e00-\u9fff]")

needs_node = pytest.mark.skipif(node() is None, reason="no Node here to run a script in")


@pytest.fixture
def web(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder for modules of a page of the test's own."""
    monkeypatch.setattr(inlining, "WEB", tmp_path)
    inlined.cache_clear()
    yield tmp_path
    inlined.cache_clear()


def said(script: str) -> object:
    """What a script says at its end, run as a module."""
    program = node()
    assert program is not None
    done = subprocess.run(
        [program, "--input-type=module", "-e", script], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    found: object = json.loads(done.stdout)
    return found


@needs_node
def test_modules_stand_once_each_before_those_that_need_them(web: Path) -> None:
    (web / "deep").mkdir()
    (web / "a.js").write_text(
        'import { b } from "./b.js";\nimport {\n  c,\n  name as other,\n} from "./deep/c.js";\n'
        "const name = 1;\nexport const a = [b, c(), other, name];\n"
    )
    (web / "b.js").write_text('import { c } from "./deep/c.js";\nexport const b = c();\n')
    (web / "deep" / "c.js").write_text(
        'import { d } from "../d.js";\nimport { Many, y } from "./e.js";\nconst name = 2;\n'
        "let calls = 0;\nexport function c() {\n  return [d, new Many().e, y, ++calls];\n}\n"
        "export { name };\n"
    )
    (web / "d.js").write_text("const name = 3;\nexport {name as d};")
    (web / "deep" / "e.js").write_text(
        "export class Many {\n  e = 4;\n}\nexport const { x, y } = { x: 5, y: 6 };\n"
    )
    script = inlined("a.js")
    assert script.count("class Many") == 1
    assert said(script + "console.log(JSON.stringify(a));") == [[3, 4, 6, 1], [3, 4, 6, 2], 2, 1]


@pytest.mark.parametrize(
    "line",
    [
        'import b from "./b.js";',
        'import * as b from "./b.js";',
        'import "./b.js";',
        'import { b } from "b.js";',
        'import { b } from "../b.js";',
        'import { b } from "https://example.org/b.js";',
        "export default 1;",
        'export { b } from "./b.js";',
        'export * from "./b.js";',
        "export const { a: b } = {};",
        "export const [b] = [];",
        '  import { b } from "./b.js";',
    ],
)
def test_imports_and_exports_of_another_form_are_refused(web: Path, line: str) -> None:
    (web / "a.js").write_text(f"const a = 1;\n{line}\n")
    with pytest.raises(ScriptError, match=r"a\.js: "):
        inlined("a.js")


def test_circles_are_refused(web: Path) -> None:
    (web / "a.js").write_text('import { b } from "./b.js";\n')
    (web / "b.js").write_text('import { c } from "./c.js";\n')
    (web / "c.js").write_text('import { b } from "./b.js";\n')
    with pytest.raises(ScriptError, match=r"a circle of imports: a\.js, b\.js, c\.js, b\.js"):
        inlined("a.js")


def test_imported_names_are_exported() -> None:
    exports = {
        module: {outside for _inside, outside in exported(module.read_text("utf-8"))}
        for module in MODULES
    }
    assert "Player" in exports[WEB / "player.js"]
    for module in MODULES:
        for names, path in IMPORT.findall(module.read_text("utf-8")):
            wanted = {name.split()[0] for name in names.split(",") if name.strip()}
            assert not wanted - exports[(module.parent / path).resolve()], f"{module.name} from {path}"


def test_inlining_leaves_no_import_and_no_export() -> None:
    script = inlined("start.js")
    assert not re.search(r"^\s*(import|export)\b", script, re.MULTILINE)
    for text in ("class Player", "class Scene", "class Boxes", "async function start"):
        assert script.count(f"{text} ") + script.count(f"{text}(") == 1
    assert script.index("class Scene") < script.index("async function start")


@pytest.mark.parametrize("entry", ["start.js"])
def test_every_sentence_of_the_scripts_has_chinese(entry: str) -> None:
    words = chinese(entry)
    assert len(words) > 60
    for english, translated in words.items():
        assert IDEOGRAPH.search(translated) or english == "Home, End", english
        assert sorted(re.findall(r"\{\w+\}", english)) == sorted(re.findall(r"\{\w+\}", translated))
    calls = len(re.findall(r"(?<![\w$.])_\(", inlined(entry)))
    literals = len(TEXT.findall(inlined(entry)))
    assert calls == literals + 1  # the function's own line


def test_words_of_several_scripts_are_all_there() -> None:
    assert chinese("planner_start.js", "start.js") == chinese("start.js") | chinese("planner_start.js")


def test_data_cannot_end_the_element_that_it_stands_in() -> None:
    assert "<" not in inert({"a": "<!--</script>"})
    assert json.loads(inert({"a": "<!--</"})) == {"a": "<!--</"}


def test_styles_follow_one_another_and_are_named_by_their_hash(web: Path) -> None:
    (web / "a.css").write_text("a {}\n")
    (web / "b.css").write_text("b {}\n")
    assert joined_styles(["b.css", "a.css"]) == "b {}\na {}\n"
    assert content_hash("") == "sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU="
