"""What one bench does, in plain sentences: read as the one who carries it reads them."""

import math
import re
from dataclasses import replace
from functools import partial

import pytest

from benchdragon.analysis.bench_walks import PACES, BenchWalk, Stretch, Tightest, bench_walks
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.ground import Ground
from benchdragon.explain.bench_basis import bench_text
from benchdragon.explain.bench_text import BenchText, doing, quick_line, tightest_line
from benchdragon.i18n import spoken_in
from benchdragon.model.base_curve import Point
from benchdragon.plans.people import called
from benchdragon.plans.schema import Plan, read_plan
from tests.analysis.test_bench_walks import PLAN


@pytest.fixture(scope="module")
def told() -> tuple[BenchWalk, ...]:
    walk = PLAN.build()
    return bench_walks(PLAN, walk, PLAN.span(walk))


def text_of(plan: Plan, found: BenchWalk, peg: Point = (0.0, 0.0)) -> BenchText:
    plan = plan.with_value("chalk.peg", list(peg))
    ground = Ground.of(plan, plan.build().route)
    return bench_text(plan, found, partial(called, plan.people, count=9), ground)


def stretch(start: float, end: float, turning: str, pace: str, angle: float = 1.0) -> Stretch:
    return Stretch(start, end, turning, pace, end - start, angle, (0.0, 1.0))  # type: ignore[arg-type]


def one_bench(*stretches: Stretch) -> BenchWalk:
    # 2 m long and 0.3 m wide, its front handle 0.2 m from its front end.
    box = (2.2, 4.0, 1.0, 0.0, 1.0, 0.15)
    return BenchWalk(5, (3.0, 4.0), 0.0, box, stretches, None, 4, 6)


def test_the_quick_line_names_turns_and_times_from_the_start_of_the_dance_on() -> None:
    bench = one_bench(
        stretch(-100.0, 30.0, "left", "walk"), stretch(30.0, 45.0, "left", "run"),
        stretch(45.0, 60.0, "straight", "walk"), stretch(60.0, 90.0, "straight", "wait"),
    )  # fmt: skip
    clock = Clock("", -100.0)
    assert quick_line(bench, clock) == (
        "Turn left; keep walking; run from 2:10 to 2:25; wait from 2:40 to 3:10."
    )
    with spoken_in("zh"):
        assert quick_line(bench, clock) == "往左弯；走；2:10 到 2:25 跑；2:40 到 3:10 等。"


def test_what_is_done_now_is_said_in_few_words() -> None:
    said = [("left", "run"), ("right", "walk"), ("straight", "hurry"), ("left", "wait")]
    told = [stretch(0.0, 5.0, turning, pace) for turning, pace in said]
    assert [doing(one) for one in told] == [
        "turn left, run", "turn right, keep walking", "straight on, hurry", "wait",
    ]  # fmt: skip
    with spoken_in("zh"):
        assert [doing(one) for one in told] == ["往左弯，跑", "往右弯，走", "直走，快走", "等"]


def test_the_quick_line_counts_what_is_too_much_to_name() -> None:
    sides, paces = ("left", "right"), ("walk", "hurry", "run", "wait")
    bench = one_bench(*(stretch(n, n + 1.0, sides[n % 2], paces[n % 4]) for n in range(20)))
    clock = Clock("", 0.0)
    assert quick_line(bench, clock) == (
        "10 times left and 10 times right; keep walking; hurry, 5 times; run, 5 times; wait, 5 times."
    )
    still = one_bench(stretch(0.0, 9.0, "straight", "walk", 0.0))
    assert quick_line(still, clock) == "Straight on all the way; keep walking, without a stop."


def test_stretches_say_clock_turn_way_and_steps(told: tuple[BenchWalk, ...]) -> None:
    clock = Clock("", told[0].stretches[0].start)
    for bench in told:
        text = text_of(PLAN, bench)
        for line, one in zip(text.stretches, bench.stretches, strict=True):
            assert line.startswith(f"{clock.tell(one.start)} to {clock.tell(one.end)}: ")
            assert (": wait." in line) == (one.pace == "wait")
            if one.pace != "wait":
                way, steps = (int(number) for number in re.findall(r"(\d+) (?:m|steps)", line))
                assert (way, steps) == (round(round(one.way, 6)), round(round(one.way / 0.6, 6)))
            if one.turning != "straight" and one.pace != "wait":
                assert f"turn {one.turning}" in line
    rounds = one_bench(stretch(0.0, 60.0, "right", "walk", -15.707963))
    assert ", turn right, 2.5 times round; 60 m, 100 steps." in text_of(PLAN, rounds).stretches[0]


@pytest.mark.parametrize(
    ("degrees", "said"),
    [
        (4.0, "turn left; 9 m"), (6.0, "turn left, a little; 9 m"), (44.0, "a little"),
        (46.0, "a quarter round"), (134.0, "a quarter round"), (171.0, "half round"),
        (226.0, "three quarters round"), (314.0, "three quarters round"), (316.0, "0.9 times round"),
        (360.0, "1.0 times round"),
    ],
)  # fmt: skip
def test_how_far_one_turns_is_told_in_quarters_of_a_round(degrees: float, said: str) -> None:
    bench = one_bench(stretch(0.0, 9.0, "left", "walk", math.radians(degrees)))
    (line,) = text_of(PLAN, bench).stretches
    assert said in line
    assert "°" not in line


def test_the_place_is_told_from_the_peg_and_from_the_nearest_landmark() -> None:
    bench = one_bench(stretch(0.0, 9.0, "left", "walk"))
    peg = text_of(PLAN, bench).place
    assert peg[:2] == (
        "Your front handle starts at x = 3.00 m, y = 4.00 m from the peg: 5.00 m from it at 53° "
        "from the x axis.",
        "At the start your front handle is 8 steps from the peg.",
    )
    away = text_of(PLAN, bench, (0.0, 4.02)).place
    assert "x = 3.00 m, y = -0.02 m from the peg: 3.00 m from it at 0° from" in away[0]
    assert away[1] == "At the start your front handle is 5 steps from the peg."
    surveyed = read_plan("turn", ["survey.crs=EPSG:4549"])
    assert text_of(surveyed, bench, (0.0, 0.0)).place[0] == (
        "Your front handle starts at x = 3.00 m (east), y = 4.00 m (north) from the peg: 5.00 m from "
        "it on a bearing of 37° from north."
    )
    said = ['obstacle=[{kind="circle", name="well", centre=[3.0, 6.5], radius=0.7}]']
    # The well's edge is 1.65 m from the bench, 1.8 m from its front handle.
    assert text_of(read_plan("turn", said), bench).place[1] == (
        "At the start your bench is 3 steps from well."
    )
    said.append("venue.rectangle=[7.2, 60]")
    plan = read_plan("turn", [*said, "people.step=0.3"])
    # The bench's front end is 0.4 m from it, its front handle 0.6 m.
    assert text_of(plan, bench).place[:2] == (
        "Your front handle starts 3.00 m to the right and 4.00 m forward from the peg: 5.00 m from it.",
        "At the start your bench is 1 steps from the right edge of the venue.",
    )
    with spoken_in("zh"):
        assert text_of(plan, bench, (4.0, 4.5)).place[:2] == (
            "你的前把手从木桩往左 1.00 米、往后 0.50 米起步：离木桩 1.12 米。",
            "起步时你这条板凳离场地的右边线 1 步。",
        )
    near = read_plan("turn", [*said[:1], "venue.rectangle=[6.6, 60]"])
    assert "less than 1 steps from the right edge" in text_of(near, bench).place[1]


def test_places_are_told_along_the_edges_of_a_venue_that_is_turned() -> None:
    bench = one_bench(stretch(0.0, 9.0, "left", "walk"))
    plan = read_plan("turn", ["venue.rectangle=[20, 9.6]", "venue.angle=30"])
    # (3, 4) along and across axes turned by 30 degrees; the nearest corner is 1.81 m from the edge.
    assert text_of(plan, bench).place[:2] == (
        "Your front handle starts 4.60 m to the right and 1.96 m forward from the peg: 5.00 m from it.",
        "At the start your bench is 3 steps from the far edge of the venue.",
    )


def test_the_tightest_moment_and_the_neighbours_have_the_names_that_the_village_gives() -> None:
    plan = read_plan("turn", ["people.unit=qiao", "people.count_head=false"])
    near = Tightest(75.4, 3, "left", 0.1, 0.279, (0.0, 0.0))
    bench = replace(
        one_bench(stretch(10.0, 90.0, "left", "walk")), tightest=near, before=1, left=9, right=3
    )
    text = text_of(plan, bench)
    assert text.tightest == (
        "Tightest at 1:05: qiao 2, in another coil, comes as near as 0.279 m, on your left."
    )
    assert text.people == (
        "Before you: the head.", "Behind you: qiao 5.", "At the end on your left: the tail.",
        "At the end on your right: qiao 2.", "Afterwards: follow the bench before you out.",
    )  # fmt: skip
    alone = replace(bench, tightest=None, before=None, behind=None, left=None, right=None)
    assert text_of(plan, alone).tightest == "No bench of another coil comes within about 1.5 m of you."
    assert text_of(plan, alone).people == ("Afterwards: lead all of them out where the leader says.",)
    with spoken_in("zh"):
        assert re.fullmatch(
            r"1:05 最挤：另一圈的.+在你左边，只隔 0\.279 米。", text_of(plan, bench).tightest
        )


def test_thresholds_are_those_of_the_plan(told: tuple[BenchWalk, ...]) -> None:
    bench = one_bench(*(stretch(n, n + 1.0, "left", pace) for n, pace in enumerate(PACES)))
    text = text_of(PLAN, bench)
    assert text.paces == (
        "Hurry means 1.15 m/s or more.", "Run means 1.45 m/s or more.",
        "Wait means to stand still.",
    )  # fmt: skip
    assert text.lines[0] == text.quick
    assert set(text.paces) <= set(text.lines)
    assert text_of(PLAN, one_bench(stretch(0.0, 9.0, "left", "run"))).paces == text.paces[1:2]


def test_who_only_walks_and_bends_one_way_reads_no_more_than_that() -> None:
    bench = one_bench(stretch(0.0, 9.0, "right", "walk"))
    text = text_of(PLAN, bench)
    assert (text.quick, text.paces) == ("Bend right all the way; keep walking, without a stop.", ())
    with spoken_in("zh"):
        assert quick_line(bench, Clock("", 0.0)) == "一路往右弯；一直走，不停。"
    straight = one_bench(stretch(0.0, 9.0, "right", "walk"), stretch(9.0, 12.0, "straight", "walk"))
    assert quick_line(straight, Clock("", 0.0)) == "Turn right; keep walking, without a stop."


def test_a_wait_says_what_the_head_stops_for() -> None:
    bench = one_bench(stretch(0.0, 30.0, "left", "walk"), stretch(30.0, 45.0, "left", "wait"))
    cue = {"kind": "hold", "at": 31.0, "hold": 9.0, "text": "bow to the temple", "text_zh": "拜庙"}
    plan = read_plan("turn").with_value("cues.cue", [cue])
    assert text_of(plan, bench).stretches[1] == "0:30 to 0:45: wait: bow to the temple."
    assert "wait from 0:30 to 0:45: bow to the temple." in text_of(plan, bench).quick
    with spoken_in("zh"):
        assert text_of(plan, bench).stretches[1] == "0:30 到 0:45：等：拜庙。"
        assert "0:30 到 0:45 等（拜庙）" in text_of(plan, bench).quick
    for other in ({**cue, "at": 50.0}, {**cue, "text": "", "text_zh": ""}):
        plan = read_plan("turn").with_value("cues.cue", [other])
        assert text_of(plan, bench).stretches[1] == "0:30 to 0:45: wait."


def test_a_sheet_ends_with_where_to_go_when_the_dance_is_over() -> None:
    bench = one_bench(stretch(0.0, 30.0, "left", "walk"))
    assert text_of(read_plan("turn"), bench).people[-1].endswith("follow the bench before you out.")
    head = replace(bench, before=None)
    assert (
        text_of(read_plan("turn"), head)
        .people[-1]
        .endswith("lead all of them out where the leader says.")
    )
    for each in (head, bench):
        assert "until your pin is pulled" in text_of(read_plan("spiral-in"), each).people[-1]


def test_others_read_of_a_bench_by_its_own_sides() -> None:
    near, clock = Tightest(75.4, 3, "rear", 0.1, 0.279, (0.0, 0.0)), Clock("", 0.0)
    own, others = (tightest_line(near, clock, str, its=its) for its in (False, True))
    assert (own.endswith("0.279 m, behind you."), others.endswith("0.279 m, behind it.")) == (
        True,
        True,
    )
    assert tightest_line(None, clock, str, its=True).endswith("m of it.")


def test_the_head_leads_all_in_and_the_others_follow() -> None:
    bench = one_bench(stretch(0.0, 9.0, "left", "walk"))
    assert text_of(PLAN, bench).place[2] == (
        "Coming in: follow the bench before you along the chalk line."
    )
    assert "lead all of them" in text_of(PLAN, replace(bench, before=None)).place[2]


def test_times_are_of_day_where_the_plan_says_when_the_dance_starts() -> None:
    near = Tightest(75.4, 3, "left", 0.1, 0.279, (0.0, 0.0))
    bench = replace(one_bench(stretch(-38.0, 90.0, "left", "run")), tightest=near)
    text = text_of(read_plan("turn", ["cues.clock=18:30"]), bench)
    assert text.stretches[0].startswith("18:30:00 to 18:32:08: run")
    assert text.tightest.startswith("Tightest at 18:31:53")
    assert text.times == ("Times are times of day; the dance starts at 18:30.")
    text = text_of(read_plan("turn"), bench)
    assert text.stretches[0].startswith("0:00 to 2:08: run")
    assert text.times == ("Times are minutes and seconds since the dance starts.")
    assert text.times in text.lines
    tail = text_of(read_plan("turn"), replace(bench, behind=None))
    assert tail.times.startswith(text.times)
    assert tail.times.endswith("of your front handle, in the timetable of your last handle.")
