"""The player's file: one page that needs nothing, in both languages, and small."""

import base64
import hashlib
import html
import itertools
import json
import math
import os
import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from benchdragon import Arc, Dragon, InputError, Line, Motion, Route, SpeedProfile, Walk
from benchdragon.cli.main import run
from benchdragon.i18n import Words, language, spoken_in
from benchdragon.inlining import chinese, inert
from benchdragon.plans.schema import read_plan
from benchdragon.player import messages
from benchdragon.player import page as player
from benchdragon.player.frames import frames
from benchdragon.player.page import player_page, show, write_player
from benchdragon.player.scene import Span, plain_dance

IDEOGRAPH = re.compile(r"[\u4e00-\u9fff]")


class Parsed(HTMLParser):
    """Elements of a page: tag, attributes and text of each, in order."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None], str]] = []
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs), ""))

    def handle_endtag(self, tag: str) -> None:
        self.found.append((f"/{tag}", {}, ""))

    def handle_data(self, data: str) -> None:
        if self.found:
            tag, attributes, text = self.found[-1]
            self.found[-1] = (tag, attributes, text + data)

    def one(self, tag: str, **wanted: str) -> tuple[dict[str, str | None], str]:
        """The only element of a tag with some attributes."""
        ((_tag, attributes, text),) = [
            row for row in self.found if row[0] == tag and wanted.items() <= row[1].items()
        ]
        return attributes, text


@cache
def small_dance() -> messages.Dance:
    """A dance of a few benches."""
    walk = read_plan("turn", ["dragon.benches=6"]).build()
    return plain_dance(walk, Span(-5.0, 20.0))


def test_the_page_allows_its_own_script_and_style_and_nothing_else() -> None:
    page = Parsed(player_page(small_dance(), "en"))
    policy = page.one("meta", **{"http-equiv": "Content-Security-Policy"})[0]["content"]
    assert policy is not None
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    for name, element in (
        ("script-src", page.one("script", type="module")),
        ("style-src", page.one("style")),
    ):
        digest = hashlib.sha256(element[1].encode()).digest()
        assert rules.pop(name) == f"'sha256-{base64.b64encode(digest).decode()}'"
    assert rules == {
        "default-src": "'none'", "img-src": "data:", "base-uri": "'none'", "form-action": "'none'",
    }  # fmt: skip
    names = set(itertools.chain.from_iterable(attributes for _tag, attributes, _text in page.found))
    assert not [name for name in names if name == "style" or name.startswith("on") or name == "src"]


def test_the_page_names_no_address_but_the_one_of_svg() -> None:
    addresses = re.findall(r"(?:https?:)?//[\w.-]+\.\w+[^\s\"']*", player_page(small_dance(), "en"))
    assert set(addresses) == {"http://www.w3.org/2000/svg"}


def test_the_page_begins_in_the_language_asked_for_or_in_use(spoken: str) -> None:
    assert language() == spoken
    for asked in ("en", "zh", None):
        page = Parsed(player_page(small_dance(), asked))
        begun = asked or spoken
        assert page.one("html")[0]["lang"] == {"en": "en", "zh": "zh-CN"}[begun]
        assert json.loads(page.one("script", id="language")[1]) == begun
        assert json.loads(page.one("script", id="words")[1]) == chinese("start.js")


def test_titles_cannot_break_out_of_the_page() -> None:
    odd = '</script><script>alert("\'1&amp;")</script><!--\u2028'
    dance = small_dance().model_copy(update={"title": Words(en=odd, zh=odd)})
    page = Parsed(player_page(dance, "zh"))
    assert [attributes.get("type") for tag, attributes, _text in page.found if tag == "script"] == [
        "application/json", "application/json", "application/json", "module",
    ]  # fmt: skip
    assert page.one("title")[1] == odd
    held = messages.Dance.model_validate_json(page.one("script", id="dance")[1])
    assert held == dance
    assert json.loads(inert({"a": "<!--</"})) == {"a": "<!--</"}


@pytest.mark.parametrize(("benches", "most"), [(223, 5_000_000), (1000, 10_000_000)])
def test_dances_of_400_seconds_make_small_files(tmp_path: Path, benches: int, most: int) -> None:
    walk = read_plan("turn", [f"dragon.benches={benches}"]).build()
    path = tmp_path / "dance.html"
    write_player(path, plain_dance(walk, Span(-100.0, 300.0, shares=(0.5,))))
    assert 100_000 < path.stat().st_size < most


def test_too_large_a_file_is_refused_and_not_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(player, "MOST_BYTES", 20_000)
    with pytest.raises(
        InputError, match=r"would have 0\.3 MB, more than 0\.0 MB: choose a shorter time"
    ):
        write_player(tmp_path / "dance.html", small_dance())
    assert list(tmp_path.iterdir()) == []


def test_view_writes_the_same_page_each_time(
    tmp_path: Path, spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "new" / "dance.html"
    command = ["view", "turn", "--set", "dragon.benches=9", "--start", "-3", "--end", "0:40"]
    assert run([*command, "-o", str(path)]) == 0
    first = path.read_bytes()
    assert str(path) in capsys.readouterr().out.replace("\n  ", "")
    assert run([*command, "-o", str(path), "--force", "--quiet"]) == 0
    assert path.read_bytes() == first
    assert list(path.parent.iterdir()) == [path]
    page = Parsed(first.decode())
    held = messages.Dance.model_validate_json(page.one("script", id="dance")[1])
    assert page.one("title")[1] == {"en": "Turning", "zh": "调头"}[spoken]
    assert (held.frames.start, len(held.benches.length)) == (-3.0, 9)
    assert held.frames.start + held.frames.step * (held.frames.count - 1) == pytest.approx(40.0)
    assert held.plan_sha256 == read_plan("turn", ["dragon.benches=9"]).sha256


@pytest.mark.parametrize(
    ("options", "said", "code"),
    [
        (["--start", "9", "--end", "5"], "would end at 5 s, and must end after its start at 9 s", 2),
        (["--end", "inf"], "(3:12 or 1:02:03) or units (3 min 12 s), not 'inf'", 2),
        (["--start", "nan"], "(3:12 or 1:02:03) or units (3 min 12 s), not 'nan'", 2),
        (["--start", "soon"], "(3:12 or 1:02:03) or units (3 min 12 s), not 'soon'", 2),
        (["--start", "-1e9"], "this walk goes to 1e+09 m", 2),
        (["--start", "2000", "--end", "2001"], "past the end of the route", 4),
        (["--set", "dragon.benches=0"], "dragon.benches: expected at least 1", 3),
        (["--set", "nonsense"], "nonsense", 3),
    ],
)
def test_view_refuses_what_cannot_be(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str], said: str, code: int
) -> None:
    command = ["view", "turn", "--set", "dragon.benches=4", "--set", "walk.end=30", "--quiet"]
    assert run([*command, "-o", str(tmp_path / "dance.html"), *options]) == code
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_view_refuses_files_that_are_there_and_unknown_plans(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "dance.html"
    path.write_text("mine")
    for command, said, code in (
        (["view", "turn", "-o", str(path)], "is there already; use --force", 2),
        (["view", "turn", "-o", str(tmp_path)], "is a directory", 2),
        (["view", "turn", "-o", str(path / "below.html")], f"{path} is not a folder", 2),
        (["view", "nosuch", "-o", str(path)], "there is no plan nosuch", 3),
        (["view", "turn"], "Missing option", 2),
    ):
        assert run([*command, "--quiet"]) == code
        assert said in capsys.readouterr().err
    assert path.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("where", ["benchdragon.player.scene.plain_dance", "pathlib.Path.write_bytes"])
def test_an_interrupt_leaves_nothing(tmp_path: Path, where: str) -> None:
    room, name = where.rsplit(".", 1)
    script = (
        "import os, pathlib, signal, sys, benchdragon.player.scene\n"
        "from benchdragon.cli.main import run\n"
        # A background job of a shell is born deaf to SIGINT.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        f"before = {room}.{name}\n"
        "def stop(*arguments):\n"
        "    if before is pathlib_write: before(arguments[0], b'half')\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "pathlib_write = pathlib.Path.write_bytes\n"
        f"{room}.{name} = stop\n"
        "sys.exit(run(['view', 'turn', '--set', 'dragon.benches=4', '--set', 'walk.end=5', '-o', "
        f"{str(tmp_path / 'dance.html')!r}]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False, env={**os.environ}
    )
    assert (done.returncode, "interrupted" in done.stderr) == (130, True)
    assert list(tmp_path.iterdir()) == []


def page_in(shown: str) -> messages.Dance:
    """The dance of a page inside a frame."""
    attributes, _text = Parsed(shown).one("iframe", sandbox="allow-scripts")
    page = Parsed(attributes["srcdoc"] or "")
    return messages.Dance.model_validate_json(page.one("script", id="dance")[1])


def last_time(dance: messages.Dance) -> float:
    """Time of the last frame, s."""
    return dance.frames.start + dance.frames.step * (dance.frames.count - 1)


def test_a_notebook_shows_a_motion_from_its_first_to_its_last_time() -> None:
    walk = read_plan("turn", ["dragon.benches=5"]).build()
    dance = page_in(show(walk.motion([12.0, 3.0, 7.0])).html)
    assert (dance.frames.start, last_time(dance)) == pytest.approx((3.0, 12.0))
    assert len(dance.benches.length) == 5


@pytest.mark.parametrize(
    ("time", "start", "end"), [(20.0, 15.0, 25.0), (9.95, 9.5, 14.95), (58.0, 53.0, 60.0)]
)
def test_of_one_time_a_notebook_shows_the_seconds_about_it_that_there_are(
    time: float, start: float, end: float
) -> None:
    # The dragon is on the route whole from 4.5 m on: from 9.5 s on, and until 60 s.
    walk = Walk(Dragon.uniform(2), Route((Arc(40.0, 55.0 / 40.0),)), start=-5.0)
    dance = page_in(show(walk.motion([time])).html)
    assert dance.frames.start == pytest.approx(start, abs=0.11)
    assert last_time(dance) == pytest.approx(end, abs=0.11)
    assert dance.frames.start <= time <= last_time(dance)


# Its head comes onto the route, and its tail leaves it, at one and the same time.
TURN_OF_A_BENCH = 2.0 * math.asin(0.5 * 2.86 / 40.0)
AT_ITS_END = Walk(
    Dragon.uniform(1), Route((Arc(40.0, TURN_OF_A_BENCH + 1e-9),)), start=40.0 * TURN_OF_A_BENCH + 2e-8
)
LINE = Walk(Dragon.uniform(3), Route((Line(60.0),)), start=20.0)
FAST = Walk(Dragon.uniform(1), Route((Line(5e5),)), SpeedProfile.constant(99.0), 9.0)
CROWD = Walk(Dragon.uniform(5001), Route((Line(9e4),)), start=2e4)
# Motions that no player can show, and what is said of each.
ODD: dict[str, tuple[Callable[[], Motion], str]] = {
    "no time": (lambda: LINE.motion([]), "no time to show"),
    "nowhere to stand": (lambda: LINE.motion([90.0], throw=False), "past the end of the route"),
    "standing for an instant": (lambda: AT_ITS_END.motion([0.0]), "no time to show"),
    "too long": (lambda: CROWD.motion([0.0, 200.0]), "too large for a notebook"),
    "too many benches": (lambda: CROWD.motion([1.0]), "at most 5000 benches"),
    "too far": (lambda: FAST.motion([1.0, 4900.0]), "m of a route, and this walk goes to"),
}


@pytest.mark.parametrize("name", ODD)
def test_what_a_notebook_cannot_show_comes_as_text_with_why(name: str, spoken: str) -> None:
    motion, said = ODD[name][0](), ODD[name][1]
    with spoken_in("en"):
        shown = show(motion).html
    assert shown.startswith(f"<pre>{html.escape(repr(motion))}\n")
    assert said in shown
    assert shown.endswith("</pre>")
    in_use = show(motion)._repr_html_()
    assert IDEOGRAPH.search(in_use) if spoken == "zh" else in_use == shown


def test_a_dance_of_too_many_bytes_is_not_framed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(player, "MOST_FRAMED", 100)
    motion = read_plan("turn", ["dragon.benches=5"]).build().motion([1.0, 2.0])
    assert "too large for a notebook" in show(motion).html


def test_a_dragon_that_stands_still_is_shown() -> None:
    walk = Walk(Dragon.uniform(3), Route((Line(60.0),)), SpeedProfile.constant(0.0), start=20.0)
    dance = page_in(show(walk.motion([1.0, 1.0])).html)
    assert (dance.frames.start, last_time(dance)) == pytest.approx((-4.0, 6.0))
    found = frames(walk, -4.0, 6.0, 1e-3)
    assert np.ptp(found.places, axis=1).max() == found.error == 0.0
