"""The planner where no script runs: its dance in a picture, and the verdict in both languages."""

import re
from html import unescape

import numpy as np
import pytest

from benchdragon.analysis.check import check
from benchdragon.analysis.records import verdict_of
from benchdragon.kernels.curve import FloatArray
from benchdragon.number_format import seconds
from benchdragon.planner.first_look import SIDE, first_look
from benchdragon.planner.page import planner_page
from benchdragon.plans.presets import presets
from benchdragon.plans.schema import read_plan

SMALL = ["dragon.benches=9", "route.start_turn=8", "walk.end=20"]
MOST_BYTES = 20_000  # of what is drawn of a built-in dance


def shown(page: str) -> str:
    (found,) = re.findall('<section class="look">(.*?)</section>', page, re.DOTALL)
    return unescape(found)


@pytest.mark.parametrize("spoken", ["en", "zh"])
def test_who_has_no_javascript_reads_the_dance_and_its_verdict(spoken: str) -> None:
    plan = read_plan("spiral-in", SMALL)
    text = shown(planner_page(plan, spoken))
    sentence = verdict_of(check(plan)).sentence
    read = [
        f'<div lang="{code}">\n<h1>{title}</h1>\n<p><strong>{said}</strong></p>'
        for code, title, said in (
            ("en", plan.meta.title, sentence.en),
            ("zh-CN", plan.meta.title_zh, sentence.zh),
        )
    ]
    places = [text.index(one) for one in read]
    assert (places[0] < places[1]) == (spoken == "en")
    assert text.count("<svg") == 1
    assert "style" not in text  # the page's policy allows none


def test_the_picture_shows_each_bench_where_it_is_when_two_are_nearest() -> None:
    plan = read_plan("spiral-in", SMALL)
    look = first_look(plan)
    assert look is not None
    report = check(plan)
    near = report.clearance.witness
    assert near is not None
    assert near.time is not None
    assert seconds(near.time) in look.moment.en
    corners = report.walk.motion([near.time]).corners()[0]
    drawn = np.array([chain(path) for path in re.findall("M[^M]*", look.head + look.benches)])
    length, told = look.bar
    scale = length / float(told.removesuffix(" m"))
    wanted = (corners - corners[0, 0]) * (scale, -scale)
    np.testing.assert_allclose(drawn - drawn[0, 0], wanted, atol=4.0)
    assert look.ring is not None
    ring = np.array(look.ring[:2]) - drawn[0, 0]
    np.testing.assert_allclose(ring, (near.point - corners[0, 0]) * (scale, -scale), atol=4.0)


def chain(path: str) -> FloatArray:
    """Points of a path of one piece, units."""
    steps = np.array(re.findall(r"-?\d+", path), np.float64).reshape(-1, 2)
    return np.cumsum(steps, axis=0)


def test_every_built_in_dance_has_a_small_picture() -> None:
    for preset in presets():
        look = first_look(preset.plan)
        assert look is not None
        assert max(look.width, look.height) == SIDE
        assert 1_000 < len(look.route) + len(look.benches) + len(look.head) < MOST_BYTES


def test_a_contact_is_what_is_drawn() -> None:
    plan = read_plan("spiral-in", ["dragon.benches=30"])
    look = first_look(plan)
    assert look is not None
    contact = check(plan).first_contact
    assert contact is not None
    assert contact.witness is not None
    assert f"t = {contact.witness.time:.2f} s, when benches first touch" in look.moment.en
    assert look.sentence.zh.startswith("不安全")


def test_what_stands_on_the_square_is_drawn() -> None:
    plan = read_plan("spiral-in", SMALL).model_copy(deep=True)
    square = plan.model_validate(
        plan.data()
        | {
            "venue": {"rectangle": [30, 24]},
            "obstacle": [{"name": "well", "kind": "circle", "centre": [12, -9], "radius": 1}],
        }
    )
    look = first_look(square)
    assert look is not None
    kinds = dict(look.standing)
    assert set(kinds) == {"venue", "circle"}
    assert np.ptp(chain(kinds["venue"]), axis=0) == pytest.approx([1920, 1536], abs=2)
    assert np.ptp(chain(kinds["circle"]), axis=0) == pytest.approx([128, 128], abs=2)


def test_a_dance_that_cannot_be_walked_has_no_first_look() -> None:
    plan = read_plan("spiral-in", ["dragon.benches=9", "route.pitch=0.01"])
    assert first_look(plan) is None
    assert "<noscript" not in planner_page(plan, "en")
