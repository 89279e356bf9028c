"""The planner in Firefox: it opens from disk, and answers what Python answers."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from benchdragon.analysis.bench_walks import bench_walks
from benchdragon.analysis.check import check
from benchdragon.analysis.records import verdict_of
from benchdragon.explain.bench_text import doing
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import Plan, read_plan
from tests.browser.firefox import Firefox, firefox, firefox_path
from tests.browser.links import letters
from tests.browser.test_planner_bench import MINE, SETTINGS
from tests.browser.test_village_stories import DRAGGED, KEEP, LIST, TO

SETTLED = (
    'document.querySelector("#planner")?.getAttribute("aria-busy") === "false"'
    ' && document.querySelector(".verdict:is(.safe, .tight, .unsafe):not([data-stale])") !== null'
)
SLIDERS = 'document.querySelectorAll("input[type=range]")'
PITCH = f'[...{SLIDERS}].find((one) => one.ariaLabel === "spiral pitch")'


@pytest.fixture
def fox(tmp_path: Path) -> Iterator[Firefox]:
    path = firefox_path()
    if path is None:
        pytest.skip("no Firefox here to test pages in: apt-get install firefox-esr")
    with firefox(path, tmp_path / "profile") as started:
        yield started


def test_a_dance_is_planned_in_firefox(fox: Firefox, file: Path) -> None:
    fox.open(f"{file.as_uri()}#lang=en")
    fox.until(SETTLED)
    for value, verdict in (("0.44", "unsafe"), ("0.46", "safe")):
        fox.evaluate(
            f"""{{
              const slider = {PITCH};
              slider.value = {value};
              slider.dispatchEvent(new Event("input", {{ bubbles: true }}));
              slider.dispatchEvent(new Event("change", {{ bubbles: true }}));
            }}"""
        )
        fox.until(f"benchdragon.plan.route.pitch === {value} && {SETTLED}")
        plan = Plan.model_validate_json(fox.evaluate("JSON.stringify(benchdragon.plan)"))
        fox.until(f'benchdragon.verdict.found.plan_sha256 === "{plan.sha256}"')
        assert fox.evaluate('document.querySelector(".verdict").className') == f"verdict {verdict}"
        sentence = verdict_of(check(plan)).sentence.en
        assert sentence in fox.evaluate('document.querySelector(".sentence").textContent')
    fox.evaluate("benchdragon.player.play(true)")
    fox.until("benchdragon.player.time > benchdragon.player.scene.start")
    assert fox.faults == []


def test_a_well_is_put_onto_a_square_in_firefox(fox: Firefox, file: Path) -> None:
    fox.open(f"{file.as_uri()}#lang=en")
    fox.until(SETTLED)

    def press(where: str) -> None:
        fox.evaluate(f"document.querySelector('{where}').click()")

    press(".adders button")
    fox.until(f"benchdragon.plan.venue.rectangle && {SETTLED}")
    press('[data-add="well"]')
    press(".placing button")
    fox.until(f"benchdragon.plan.obstacle?.length === 1 && {SETTLED}")
    plan = Plan.model_validate_json(fox.evaluate("JSON.stringify(benchdragon.plan)"))
    assert [one.name for one in plan.obstacles()] == ["square", "well"]
    fox.until(f'benchdragon.verdict.found.plan_sha256 === "{plan.sha256}"')
    assert fox.evaluate("document.activeElement.dataset.grip") == "obstacle.0"
    assert fox.evaluate("document.querySelector('.things [open] summary span').textContent") == "well"
    press('.things [open] .row button[aria-label="delete: well"]')
    fox.until(f"!benchdragon.plan.obstacle && {SETTLED}")
    assert fox.faults == []


def button(text: str) -> str:
    """A button of the page by what it says."""
    return f"[...document.querySelectorAll('button')].find((one) => one.textContent === '{text}')"


def tick(text: str) -> str:
    """A box to tick by what stands beside it."""
    return (
        f"[...document.querySelectorAll('label')].find((one) => one.textContent === '{text}').control"
    )


def test_a_bearer_follows_his_bench_and_all_is_there_the_next_day_in_firefox(
    fox: Firefox, bare_file: Path, tmp_path: Path
) -> None:
    plan = read_plan("turn", SETTINGS)
    built = plan.build()
    walk = bench_walks(plan, built, plan.span(built))[MINE - 1]
    now, mine = "document.querySelector('.mine .now strong').textContent", ".mine select"
    fox.open(f"{bare_file.as_uri()}#plan={letters(plan)}&lang=zh")
    fox.until(SETTLED)
    fox.evaluate(f"{button('我抬板凳')}.click()")
    fox.evaluate(
        f"""{{
          const box = document.querySelector("{mine}");
          box.value = "{MINE}";
          box.dispatchEvent(new Event("change"));
        }}"""
    )
    for one in walk.stretches:
        fox.evaluate(f"benchdragon.player.put({0.5 * (one.start + one.end)})")
        with spoken_in("zh"):
            fox.until(f"{now} === '{doing(one)}'")
    fox.evaluate(f"{button('关闭')}.click(); {tick(KEEP['zh']['plan'])}.click()")
    fox.evaluate(f"{button('板凳单')}.click()")
    fox.until("document.querySelector('#sheets .paper') !== null")
    fox.evaluate(f"document.querySelector('#sheets textarea').value = {LIST!r}")
    fox.evaluate("document.querySelector('#sheets .names .row button').click()")
    fox.evaluate(f"{tick(KEEP['zh']['names'])}.click()")

    fox.open("about:blank")
    fox.open(f"{bare_file.as_uri()}#lang=zh")
    fox.until(SETTLED)
    assert (
        Plan.model_validate_json(fox.evaluate("JSON.stringify(benchdragon.plan)")).sha256 == plan.sha256
    )
    fox.evaluate(f"{button('我抬板凳')}.click()")
    fox.until(f"document.querySelector('{mine}').value === '{MINE}'")
    fox.until("document.querySelector('.mine .around')?.textContent.includes('李四')")

    # The page that is sent opens in motion here, too.
    fox.evaluate(
        f"""{{
          URL.createObjectURL = (made) => {{
            globalThis.made = made;
            return "#";
          }};
          HTMLAnchorElement.prototype.click = () => {{}};
          {button("发给大家")}.click();
        }}"""
    )
    path = tmp_path / "sent.html"
    path.write_text(fox.evaluate("made.text()"), "utf-8")
    fox.open(path.as_uri())
    fox.until(f"{SETTLED} && benchdragon.player.playing")
    assert fox.faults == []


def test_a_well_too_near_is_mended_by_a_button_in_firefox(fox: Firefox, file: Path) -> None:
    moved = DRAGGED[-1].replace("[-13, 6]", f"{list(TO)}")
    plan = read_plan("question-3", [*DRAGGED[:-1], moved])
    fox.open(f"{file.as_uri()}#plan={letters(plan)}&lang=en")
    fox.until(SETTLED)
    assert not check(plan).safe
    fox.evaluate("document.querySelector('.verdict').click()")
    fox.until("document.querySelector('.remedy')?.textContent.includes('fits')")
    fox.evaluate("document.querySelector('.remedy').click()")
    fox.until(f"benchdragon.past.length === 1 && {SETTLED}")
    assert check(Plan.model_validate_json(fox.evaluate("JSON.stringify(benchdragon.plan)"))).safe
    assert fox.faults == []
