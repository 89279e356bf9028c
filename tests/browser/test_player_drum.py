"""The drum in the player: off until asked for, in time with the page, silent when it pauses."""

from pathlib import Path

import pytest
from playwright.sync_api import expect

from benchdragon.analysis.beats import score_of
from benchdragon.analysis.check import check
from benchdragon.export.metronome import sounds_of
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.player.page import player_page
from benchdragon.player.scene import checked_dance
from tests.browser.pages import Pages
from tests.browser.players import ready, until

SAID = ("disc.radius=8", "dragon.benches=4", "walk.end=40")
CUES = 'cues.cue=[{kind="hold", head=10, hold=6, text="bow", text_zh="拜庙"}, {kind="beat", at=30}]'
# A sound card that only writes down what it is given, in the page's own clock.
CARD = """globalThis.AudioContext = class {
  static given = [];
  get currentTime() { return benchdragon.time / benchdragon.speed; }
  resume() { return Promise.resolve(); }
  createGain() {
    const gain = { setValueAtTime() {}, exponentialRampToValueAtTime() {} };
    return { gain, connect: (to) => to };
  }
  createOscillator() {
    const one = { frequency: { value: 0 }, taken: false, connect: (to) => to, stop() {} };
    one.disconnect = () => { one.taken = true; };
    one.start = (when) => {
      one.when = when;
      AudioContext.given.push(one);
    };
    return one;
  }
}"""
GIVEN = "AudioContext.given.map((one) => [one.when, one.frequency.value, one.taken])"


def page_text(plan: Plan) -> str:
    return player_page(checked_dance(check(plan)), "en")


def test_beats_by_rule_are_those_of_the_sound_file(pages: Pages, tmp_path: Path) -> None:
    plan = read_plan("spiral-in", [*SAID, CUES])
    file = tmp_path / "dance.html"
    file.write_text(page_text(plan), "utf-8")
    page = ready(pages.open(file.as_uri()))
    expect(page.get_by_role("button", name="bow (0:11 · 11.00 s)")).to_be_attached()
    page.evaluate(f"() => {{ {CARD}; }}")
    button = page.get_by_role("button", name="drum beat")
    expect(button).to_have_attribute("aria-pressed", "false")
    page.evaluate("benchdragon.speed = 5; benchdragon.jump(8)")
    page.keyboard.press("b")
    expect(button).to_have_attribute("aria-pressed", "true")
    assert page.evaluate("AudioContext.given.length") == 0  # it does not play yet
    page.keyboard.press(" ")
    until(page, "benchdragon.time > 24")
    page.keyboard.press(" ")
    until(page, "!benchdragon.playing")
    page.wait_for_timeout(50)
    given = page.evaluate(GIVEN)
    assert given[-1][2]  # what lay ahead was taken back when it paused
    first = given[0][0]
    score = score_of(plan, *plan.span(plan.build()))
    known = [time for time, _name in sounds_of(score, 0.0) if 8.0 <= time < 24.0]
    heard = [5.0 * (when - first) + known[0] for when, _pitch, _taken in given]
    assert heard[: len(known)] == pytest.approx(known, abs=0.05)
    assert [round(pitch) for _when, pitch, _taken in given].count(2400) == 4
    assert not [time for time in heard if 11.3 < time < 14.2]  # silent while the head stands


def test_a_dance_without_cues_has_no_drum(pages: Pages, tmp_path: Path) -> None:
    file = tmp_path / "dance.html"
    file.write_text(page_text(read_plan("spiral-in", SAID)), "utf-8")
    page = ready(pages.open(file.as_uri()))
    expect(page.get_by_role("button", name="drum beat")).to_have_count(0)
    page.keyboard.press("b")
    assert page.evaluate("benchdragon.drum.on") is False


def test_the_player_tells_the_time_of_the_papers_beside_its_own(pages: Pages, tmp_path: Path) -> None:
    plan = read_plan("spiral-in", [*SAID, CUES, "walk.start=3", 'cues.clock="18:30"'])
    file = tmp_path / "dance.html"
    file.write_text(page_text(plan), "utf-8")
    page = ready(pages.open(file.as_uri()))
    page.evaluate("benchdragon.jump(24)")
    expect(page.locator(".clock")).to_have_text("18:30:21 · t = 24.00 s")
    expect(page.locator(".clock")).to_have_attribute(
        "title", "Times are times of day; the dance starts at 18:30."
    )
