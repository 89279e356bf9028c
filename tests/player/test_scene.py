"""A dance as a page gets it: what happens when, who is near whom, what the check ruled."""

import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import shapely

from benchdragon import Dragon, InputError, Line, Route, Walk, WalkError
from benchdragon.analysis.check import Report, check, clearance_text, sentence, speed_text
from benchdragon.analysis.distance import boxes
from benchdragon.i18n import Words, _, both, spoken_in
from benchdragon.kernels.box import corner
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.player import messages
from benchdragon.player.occasions import MOST_JOINTS
from benchdragon.player.scene import (
    MOST_BENCHES,
    REACH,
    Span,
    checked_dance,
    plain_dance,
)

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text("utf-8"))
EXAMPLES = Path(__file__).parents[2] / "examples"
TURN = ("turn", "dragon.benches=40", "walk.start=-20", "walk.end=70")


@cache
def reported(source: str, *settings: str) -> Report:
    """What the check says of a plan."""
    return check(read_plan(source, settings))


@cache
def danced(source: str, *settings: str) -> messages.Dance:
    """The dance of a plan."""
    return checked_dance(reported(source, *settings))


def occasions(dance: messages.Dance, kind: str) -> list[messages.Occasion]:
    """All of a kind."""
    return [occasion for occasion in dance.occasions if occasion.kind == kind]


def by_shapely(walk: Walk, time: float) -> tuple[list[float], list[int]]:
    """Distance of each bench to its nearest that is no neighbour, and the number of that: all pairs."""
    table = boxes(walk.motion([time]), 0)
    shapes = [shapely.Polygon([corner(table, i, k) for k in range(4)]) for i in range(len(table))]
    distances, others = [], []
    for i, shape in enumerate(shapes):
        far = [(shape.distance(other), j + 1) for j, other in enumerate(shapes) if abs(i - j) >= 2]
        distance, other = min(far)
        distances.append(distance)
        others.append(other)
    return distances, others


def test_the_contests_first_contact_is_an_occasion() -> None:
    dance = danced("spiral-in")
    (contact,) = occasions(dance, "contact")
    assert contact.time == pytest.approx(float(TRUTH["first_contact_s"]), abs=1e-6)
    assert (contact.benches, contact.text) == (
        [1, 9],
        Words(en="first contact", zh="首次碰撞"),
    )
    assert occasions(dance, "tightest") == []
    assert dance.verdict is not None
    assert (dance.verdict.safe, dance.verdict.decided) == (False, True)
    (end,) = occasions(dance, "end")
    assert end.time == dance.frames.start + dance.frames.step * (dance.frames.count - 1)
    times = [occasion.time for occasion in dance.occasions]
    assert times == sorted(times)


def test_a_safe_walk_has_a_tightest_and_a_fastest_moment() -> None:
    report, dance = reported(*TURN), danced(*TURN)
    (tightest,), (fastest,) = occasions(dance, "tightest"), occasions(dance, "fastest")
    for occasion, answer in ((tightest, report.clearance), (fastest, report.greatest_speed)):
        assert answer.witness is not None
        assert (occasion.time, tuple(occasion.benches)) == (answer.witness.time, answer.witness.benches)
    assert tightest.text.en == f"tightest moment: {clearance_text(report)} m"
    assert f"{speed_text(report)} m/s" in fastest.text.zh
    assert occasions(dance, "contact") == occasions(dance, "end") == []
    assert (dance.disc, dance.margin, dance.speed_limit) == (4.5, 0.0, 2.0)


def test_a_benchs_own_tightest_moment_is_no_looser_than_the_checks() -> None:
    """Few looks would pass the tightest moment by 2 cm here; the card of a bench must not say so."""
    report = check(read_plan("turn", ["dragon.benches=60", "walk.speed=2"]))
    near = report.clearance.witness
    assert near is not None
    sketch = checked_dance(report, Span(report.start, report.end, shares=(0.5,), times=200)).nearest
    for bench, other in (near.benches, near.benches[::-1]):
        assert sketch.distance[bench - 1] <= report.clearance.value + 1e-5
        assert sketch.other[bench - 1] == other
        assert sketch.time[bench - 1] == pytest.approx(near.time, abs=1e-3)
    before = checked_dance(report, Span(report.start, -40.0)).nearest
    assert not any(0.0 < distance <= report.clearance.value for distance in before.distance)


def test_a_broken_margin_is_named_as_such() -> None:
    dance = danced(*TURN, "limits.margin=0.5")
    (broken,) = occasions(dance, "contact")
    assert (broken.text.en, dance.margin) == ("margin not kept", 0.5)
    near = read_plan("turn", TURN[1:]).build().motion([broken.time])
    a, b = (n - 1 for n in broken.benches)
    shapes = [shapely.Polygon([corner(boxes(near, 0), i, k) for k in range(4)]) for i in (a, b)]
    assert shapes[0].distance(shapes[1]) == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize(
    "plan",
    [
        TURN,
        (str(EXAMPLES / "03_smooth_corner.dragon.toml"),),
        (str(EXAMPLES / "05_stop_and_go.dragon.toml"),),
    ],
)
def test_head_and_tail_stand_at_the_joints_they_are_said_to_pass(plan: tuple[str, ...]) -> None:
    dance, walk = danced(*plan), read_plan(plan[0], plan[1:]).build()
    passed = occasions(dance, "joint")
    inner = walk.route.joints[1:-1]
    begin, end = (
        walk.motion([dance.frames.start]),
        walk.motion([dance.frames.start + dance.frames.step * (dance.frames.count - 1)]),
    )
    expected = sum(
        int(begin.s[0, handle] <= joint <= end.s[0, handle]) for handle in (0, -1) for joint in inner
    )
    assert len(passed) == expected > 1
    for occasion in passed:
        handle = 0 if occasion.text.en.startswith("the head passes joint ") else -1
        n = int(occasion.text.en.removesuffix(" of the route").rsplit(" ", 1)[1])
        assert f" {n} " in occasion.text.zh
        assert walk.motion([occasion.time]).s[0, handle] == pytest.approx(inner[n - 1], abs=0.01)


def test_of_very_many_joints_none_is_told() -> None:
    route = Route.joined([Line(0.5) for _n in range(MOST_JOINTS + 2)])
    many = plain_dance(Walk(Dragon.uniform(2), route, start=40.0), Span(0.0, 5.0))
    assert many.occasions == []
    route = Route.joined([Line(0.5) for _n in range(MOST_JOINTS + 1)])
    some = plain_dance(Walk(Dragon.uniform(2), route, start=40.0), Span(0.0, 5.0))
    assert {occasion.kind for occasion in some.occasions} == {"joint"}


def test_only_what_falls_into_the_times_shown_is_told() -> None:
    report = reported(*TURN)
    part = checked_dance(report, Span(40.0, 50.0))
    assert part.occasions == [o for o in danced(*TURN).occasions if 40.0 <= o.time <= 50.0]
    assert part.frames.start == 40.0
    assert part.frames.step * (part.frames.count - 1) == pytest.approx(10.0)
    assert part.plan_sha256 == report.plan.sha256


@pytest.mark.parametrize(
    ("source", "settings", "span"),
    [
        ("turn", ("dragon.benches=30",), (5.0, 25.0)),
        ("spiral-in", ("dragon.benches=25",), (360.0, 380.0)),
        (str(EXAMPLES / "04_own_benches.dragon.toml"), (), (40.0, 50.0)),
    ],
)
def test_each_benchs_tightest_moment_is_that_of_all_pairs_at_all_times(
    source: str, settings: tuple[str, ...], span: tuple[float, float]
) -> None:
    walk = read_plan(source, settings).build()
    dance = plain_dance(walk, Span(*span))
    over_time = dance.tightness
    times = [over_time.start + n * over_time.step for n in range(len(over_time.distance))]
    assert (times[0], times[-1]) == pytest.approx(span)
    looked = [by_shapely(walk, time) for time in times]
    table = np.array([distances for distances, _others in looked])
    least = np.minimum(table.min(axis=1), REACH)
    np.testing.assert_allclose(over_time.distance, least, rtol=0.0, atol=6e-5)
    within = 0
    for bench, best in enumerate(table.min(axis=0)):
        found = (dance.nearest.distance[bench], dance.nearest.time[bench], dance.nearest.other[bench])
        if best > REACH:
            assert found == (0.0, 0.0, 0)
            continue
        within += 1
        assert found[0] == pytest.approx(best, abs=6e-6)
        row = int(np.argmin(np.abs(np.array(times) - found[1])))
        assert found[1] == pytest.approx(times[row], abs=1e-4)
        assert table[row, bench] == pytest.approx(best, abs=1e-9)
        assert looked[row][1][bench] == found[2]
    assert within > 5


def test_the_verdict_is_in_both_languages_whichever_is_spoken(spoken: str) -> None:
    report = reported(*TURN)
    dance = checked_dance(report, Span(0.0, 1.0))
    assert dance.verdict is not None
    for language in ("en", "zh"):
        with spoken_in(language):
            assert getattr(dance.verdict.sentence, language) == sentence(report)
    assert dance.verdict.sentence.en.startswith("Safe: ")
    assert dance.verdict.sentence.zh.startswith("安全")
    assert dance.title == Words(en="Turning", zh="调头")
    assert both(lambda: _("first contact")) == Words(en="first contact", zh="首次碰撞")


def test_what_is_sent_survives_the_wire() -> None:
    dance = danced(*TURN)
    assert messages.Dance.model_validate_json(dance.model_dump_json()) == dance
    assert len(dance.benches.length) == 40
    assert dance.benches.length[0] == 3.41


def test_a_dance_tells_how_far_it_is_and_what_is_done() -> None:
    told: list[tuple[float, str]] = []
    plain_dance(read_plan("turn", TURN[1:]).build(), Span(0.0, 1.0), lambda *said: told.append(said))
    assert [share for share, _text in told] == [0.0, 0.25, 0.5, 0.75]
    assert len({text for _share, text in told if text}) == len(told)


@pytest.mark.parametrize(
    ("start", "end", "said"),
    [
        (5.0, 5.0, "would end at 5 s, and must end after its start at 5 s"),
        (9.0, 5.0, "would end at 5 s, and must end after its start at 9 s"),
        (math.nan, 5.0, "start must be finite, not nan s"),
        (0.0, math.inf, "end must be finite, not inf s"),
    ],
)
def test_times_that_make_no_span_are_refused(start: float, end: float, said: str) -> None:
    with pytest.raises(InputError, match=said):
        Span(start, end)


def test_what_a_page_cannot_hold_is_refused() -> None:
    route = Route((Line(30_000.0),))
    crowd = Walk(Dragon.uniform(MOST_BENCHES + 1), route, start=25_000.0)
    with pytest.raises(InputError, match="at most 5000 benches, not 5001"):
        plain_dance(crowd, Span(0.0, 1.0))
    with pytest.raises(WalkError, match="past the end of the route"):
        plain_dance(Walk(Dragon.uniform(3), route, start=29_999.0), Span(5.0, 9.0))


def test_a_plan_with_coordinates_says_where_north_is() -> None:
    plan = read_plan("spiral-in", ["dragon.benches=3", "walk.end=5"])
    surveyed = Plan.model_validate(plan.data() | {"survey": {"crs": "wgs84"}})
    assert [checked_dance(check(one)).north for one in (plan, surveyed)] == [False, True]


def test_a_dance_of_people_says_how_its_papers_tell_times() -> None:
    short = ("spiral-in", "dragon.benches=4", "walk.start=2", "walk.end=5")
    assert danced(*short).papers is None
    for said in ("people.step=0.5", "cues.tempo=90"):
        papers = danced(*short, said).papers
        assert papers is not None
        assert (papers.said, papers.start) == ("", 2.0)
    papers = danced(*short, 'cues.clock="18:30"').papers
    assert papers is not None
    assert papers.said == "18:30"


def test_only_a_village_that_counts_otherwise_sends_its_names() -> None:
    short = ("spiral-in", "dragon.benches=4", "walk.end=5")
    assert danced(*short).village is None
    village = danced(*short, "people.count_head=false").village
    assert village is not None
    assert (village.head.zh, village.tail.en, village.between.en) == ("龙头", "the tail", "bench {n}")
    assert village.before == 1
    village = danced(*short, "people.unit=qiao").village
    assert village is not None
    assert (village.head.zh, village.tail.en) == ("第 1 桥", "qiao 4")
    assert (village.between.zh, village.before) == ("第 {n} 桥", 0)
