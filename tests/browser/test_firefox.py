"""The planner in Firefox: it opens from disk, and answers what Python answers."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from benchdragon.analysis.check import check
from benchdragon.analysis.records import verdict_of
from benchdragon.plans.schema import Plan
from tests.browser.firefox import Firefox, firefox, firefox_path

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
