"""The planner's file: one page that needs nothing, small, in both languages, the same each time."""

import base64
import hashlib
import itertools
import json
import re
import webbrowser
import zlib
from functools import cache
from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.hosts import built
from benchdragon.i18n import language, spoken_in
from benchdragon.inlining import chinese
from benchdragon.planner.page import PAGE, WORKER, planner_page
from benchdragon.plans.presets import presets
from benchdragon.plans.schema import Plan, read_plan
from tests.player.test_page import Parsed

ENGINE = built.ENGINE / built.MODULE
IDEOGRAPH = re.compile(r"[\u4e00-\u9fff]")


@cache
def parsed(spoken: str) -> Parsed:
    return Parsed(planner_page(None, spoken))


def held(page: Parsed, name: str) -> object:
    """The data in an inert element."""
    found: object = json.loads(page.one("script", id=name)[1])
    return found


def inflated(page: Parsed, name: str) -> bytes:
    """What is deflated in an inert element."""
    packed = held(page, name)
    assert isinstance(packed, str)
    return zlib.decompress(base64.b64decode(packed), wbits=-zlib.MAX_WBITS)


def test_the_file_is_small_and_the_same_each_time() -> None:
    page = planner_page(None, "en")
    assert 500_000 < len(page.encode()) <= 2_000_000
    assert planner_page(None, "en") == page


def test_the_page_allows_its_own_script_and_style_its_workers_and_nothing_else() -> None:
    page = parsed("en")
    policy = page.one("meta", **{"http-equiv": "Content-Security-Policy"})[0]["content"]
    assert policy is not None
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    script, style = (
        base64.b64encode(hashlib.sha256(element[1].encode()).digest()).decode()
        for element in (page.one("script", type="module"), page.one("style"))
    )
    assert rules == {
        "default-src": "'none'", "script-src": f"'sha256-{script}' 'wasm-unsafe-eval'",
        "worker-src": "blob:", "style-src": f"'sha256-{style}'", "img-src": "data:",
        "base-uri": "'none'", "form-action": "'none'",
    }  # fmt: skip
    names = set(itertools.chain.from_iterable(attributes for _tag, attributes, _text in page.found))
    assert not [name for name in names if name == "style" or name.startswith("on") or name == "src"]


def test_scripts_fetch_nothing_and_make_no_code_of_texts() -> None:
    page = parsed("en")
    worker = inflated(page, "worker").decode()
    assert "serve(globalThis)" in worker
    for script in (page.one("script", type="module")[1], worker):
        assert not re.search(
            r"\bfetch\(|XMLHttpRequest|WebSocket|EventSource|sendBeacon|importScripts|\bimport\b",
            re.sub(r"//.*|/\*.*?\*/", "", script, flags=re.DOTALL | re.MULTILINE),
        )
        assert not re.search(r"\beval\(|\bFunction\(", script)


def test_the_file_holds_engine_presets_words_and_notices() -> None:
    page = parsed("en")
    assert inflated(page, "engine") == ENGINE.read_bytes()
    shown = held(page, "presets")
    assert isinstance(shown, list)
    assert [one["name"] for one in shown] == [preset.name for preset in presets()]
    for one, preset in zip(shown, presets(), strict=True):
        assert Plan.model_validate(one["plan"]).sha256 == preset.plan.sha256
    assert held(page, "words") == chinese(PAGE, WORKER)
    notices = page.one("template", id="notices")[1]
    for name in ("Squirrel Chat et al.", "Rich Felker", "Zig contributors"):
        assert name in notices


@pytest.mark.parametrize("entry", [PAGE, WORKER])
def test_every_sentence_of_the_scripts_has_chinese(entry: str) -> None:
    words = chinese(entry)
    assert len(words) > 100
    for english, translated in words.items():
        assert sorted(re.findall(r"\{\w+\}", english)) == sorted(re.findall(r"\{\w+\}", translated))
        said = re.sub(r"\{\w+\}", "", english)
        assert IDEOGRAPH.search(translated) or not re.search(r"[a-z]{5}", said), english


def test_the_page_begins_in_the_language_asked_for_or_in_use(spoken: str) -> None:
    assert language() == spoken
    for asked in ("en", "zh", None):
        begun = asked or spoken
        page = Parsed(planner_page(None, asked))
        assert page.one("html")[0]["lang"] == {"en": "en", "zh": "zh-CN"}[begun]
        assert held(page, "language") == begun


def test_the_command_writes_a_page_that_begins_with_a_plan(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "new" / "planner.html"
    command = ["planner", "turn", "--set", "dragon.benches=9", "-o", str(path)]
    assert run(command) == 0
    assert str(path) in capsys.readouterr().out.replace("\n  ", "")
    plan = held(Parsed(path.read_text("utf-8")), "plan")
    wanted = read_plan("turn", ["dragon.benches=9"])
    assert Plan.model_validate(plan).sha256 == wanted.sha256
    first = path.read_bytes()
    assert run(command) == 2
    assert "use --force" in capsys.readouterr().err
    assert run([*command, "--force"]) == 0
    assert path.read_bytes() == first
    with spoken_in("en"):
        assert held(Parsed(planner_page()), "plan") is None


def test_without_a_file_the_browser_opens_the_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr("tempfile.mkdtemp", lambda **_options: str(tmp_path))
    assert run(["planner", "--quiet"]) == 0
    assert opened == [(tmp_path / "planner.html").as_uri()]
    assert (tmp_path / "planner.html").stat().st_size > 500_000
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("options", "said", "code"),
    [
        (["nosuch", "-o", "x.html"], "there is no plan nosuch", 3),
        (["turn", "--set", "dragon.benches=0", "-o", "x.html"], "expected at least 1", 3),
        (["--set", "dragon.benches=9", "-o", "x.html"], "--set goes with PLAN alone", 2),
        (["--force"], "--force goes with -o alone", 2),
        (["-o", "x.txt"], ".html", 2),
    ],
)
def test_the_command_refuses_what_cannot_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
    options: list[str], said: str, code: int,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(webbrowser, "open", lambda _address: pytest.fail("nothing is to be opened"))
    assert run(["planner", *options]) == code
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
