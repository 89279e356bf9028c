"""Room for people, level upon level: against dense sampling with shapely, and in what is told of it."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shapely import Polygon

from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.contact import first_contact
from benchdragon.analysis.distance import boxes, nearness
from benchdragon.analysis.records import untimed, verdict_of
from benchdragon.analysis.room import with_people
from benchdragon.errors import InputError
from benchdragon.explain.contact import check_lines
from benchdragon.explain.room import level_line
from benchdragon.i18n import spoken_in
from benchdragon.kernels.box import corner
from benchdragon.model.dragon import Dragon
from benchdragon.number_format import seconds
from benchdragon.plans.people import PeopleTable
from benchdragon.plans.schema import Plan, checked, read_plan

SMALL = ["dragon.benches=20", "walk.start=0", "walk.end=40"]
NEEDS = ["people.sway=0.05", "people.imprecision=0.1", "people.beside=0.3", "people.ahead=0.4"]
VILLAGE = Path(__file__).parents[1] / "cases" / "village"
POST = 'obstacle=[{kind="circle", name="post", centre=[4.5, 0], radius=0.3}]'
# Dances that are looked at, samples of each, and how near to its bracket a sampled time has to come, s.
DANCES, SAMPLES = 50, 120


def small(*settings: str) -> Report:
    return check(read_plan("turn", [*SMALL, *settings]))


def test_plans_that_say_nothing_of_people_have_no_levels() -> None:
    report = small("people.step=0.7")
    assert report.room == ()
    assert verdict_of(report).room == []
    assert not any("room" in line.lower() and "people" in line.lower() for line in check_lines(report))
    assert report.plan.sha256 == read_plan("turn", SMALL).sha256


def test_levels_come_one_upon_another_with_what_each_asks_for() -> None:
    report = small(*NEEDS, "limits.margin=0.01", "people.source.beside=measured")
    assert [level.name for level in report.room] == ["benches", "sway", "imprecision", "people"]
    assert [level.margin for level in report.room] == pytest.approx([0.01, 0.11, 0.31, 0.31])
    asked = [(one.key, one.value, one.source) for level in report.room for one in level.asked]
    assert asked == [
        ("sway", 0.05, ""), ("imprecision", 0.1, ""),
        ("beside", 0.3, "measured"), ("ahead", 0.4, ""),
    ]  # fmt: skip
    only = small("people.imprecision=0.02")
    assert [(level.name, level.margin) for level in only.room] == [
        ("benches", 0),
        ("imprecision", 0.04),
    ]
    breaks = [level.first[0].value for level in report.room if level.first is not None]
    assert breaks == sorted(breaks, reverse=True)
    kept = [level.kept is True for level in report.room]
    assert kept == sorted(kept, reverse=True)
    assert kept[0] is True
    assert kept[-1] is False


def test_a_broken_level_is_a_finding_under_its_own_code() -> None:
    report = small("people.imprecision=0.2")
    assert [found.code for found in report.findings] == ["BD106"]
    found, level = report.findings[0], report.room[-1]
    assert level.first is not None
    assert (found.time, found.limit) == (level.first[0].value, 0.4)
    assert found.text.startswith(f"benches {found.benches[0]} and {found.benches[1]} have no room for")
    assert sentence(report).startswith("Not safe: benches ")
    assert sentence(small("people.sway=0.01")).count("room is kept with sway") == 1
    assert [found.code for found in small("people.sway=0.2").findings] == ["BD105"]
    assert [found.code for found in small("people.beside=0.5").findings] == ["BD107"]
    bare = small("people.sway=0.2", "limits.margin=0.4")
    assert [found.code for found in bare.findings] == ["BD102"]
    assert [level.kept for level in bare.room] == [False, False]
    lines = [
        level_line(level)
        for level in small("limits.margin=0.02", "people.sway=0.01", "people.beside=0.5").room
    ]
    assert lines[-1].endswith("; side by side they need 1.04 m between them")
    assert "side by side" not in lines[1], "which is kept"


def test_a_broken_level_tells_what_its_own_pair_lacks_and_when() -> None:
    for key in ("imprecision", "sway", "beside"):
        report = small(f"people.{key}=0.2", "limits.margin=0.05")
        (found,) = report.findings
        short = report.room[-1].short
        assert short is not None
        assert (short.key, short.wanted) == (key, 0.2)
        table = boxes(report.walk.motion([short.time]), 0)
        near = nearness(table, found.benches[0] - 1, found.benches[1] - 1)
        assert short.apart == pytest.approx(near.distance)
        if key != "beside":
            assert short.there == pytest.approx(0.5 * (short.apart - 0.05))
        assert found.text.endswith(
            f": people.{key} asks for 0.2 m; at t = {seconds(short.time)} s, when these two are "
            f"{math.floor(1000 * short.apart) / 1000:g} m apart, there is room for "
            f"{math.floor(1000 * short.there) / 1000:g} m"
        )
    apart = small(POST).obstacles[0].distance.lower
    report = small(POST, "limits.margin=0", f"people.sway={apart + 0.1}")
    short = report.room[-1].short
    assert short is not None
    assert report.room[-1].obstacles[0].contact is not None
    assert short.there == pytest.approx(short.apart)
    assert apart <= short.apart < apart + 0.1


def test_what_lacks_is_the_room_ahead_where_the_sides_have_theirs() -> None:
    """The benches that come nearest, 1 and 3, have all their room: 1 and 21 lack it."""
    plan = read_plan(str(VILLAGE / "ahead_false_pair.dragon.toml"), [])
    report = check(plan)
    (found,) = report.findings
    assert (found.benches, report.clearance.witness and report.clearance.witness.benches) == (
        (1, 21),
        (1, 3),
    )
    level = report.room[-1]
    assert level.short is not None
    assert level.short.key == "ahead"
    assert ": people.ahead asks for 0.5 m; at t = " in found.text
    assert "what lacks is the room before the head's bench" in level_line(level)
    assert "1.164" not in found.text


def test_what_stands_still_is_kept_from_too_and_sway_counts_once() -> None:
    apart = small(POST).obstacles[0].distance
    near, far = apart.lower - 1e-6, apart.upper + 1e-6
    for key in ("sway", "imprecision", "beside"):
        margin = "limits.margin=0"
        assert _at_post(small(POST, margin, f"people.{key}={near}")) is None
        assert _at_post(small(POST, margin, f"people.{key}={far}")) is not None
    report = small('obstacle=[{kind="circle", centre=[4.5, 0], radius=0.3}]', f"people.beside={far}")
    (text,) = {found.text for found in report.findings if found.obstacle}
    assert "have no room at obstacle 1" in text
    with spoken_in("zh"):
        assert "的人在障碍物 1旁没有余地" in next(one.text for one in report.findings if one.obstacle)


def _at_post(report: Report) -> float | None:
    """When the last level is broken at the post."""
    found = report.room[-1].obstacles[0].contact
    return None if found is None else found.value


def test_speeds_above_what_a_bench_can_be_carried_at_are_findings() -> None:
    fastest = small().greatest_speed.value
    assert small(f"people.most_speed={fastest + 1e-6}").safe
    (found,) = small(f"people.most_speed={fastest - 1e-6}").findings
    assert (found.code, found.limit) == ("BD207", fastest - 1e-6)
    assert "a bench can be carried at" in found.text
    assert "limit being" not in found.text


def test_a_dragon_with_people_is_wider_on_both_sides_and_longer_in_front() -> None:
    dragon = Dragon.uniform(4)
    wide = with_people(dragon, PeopleTable(beside=0.3, ahead=0.5))
    assert wide.width.tolist() == pytest.approx([0.9] * 4)
    assert (wide.length - dragon.length).tolist() == pytest.approx([0.5, 0, 0, 0])
    assert wide.links == pytest.approx(dragon.links)
    assert (wide.rear_inset == dragon.rear_inset).all()


def test_room_that_makes_benches_too_large_is_refused_in_one_sentence() -> None:
    with pytest.raises(InputError, match="bench 1: "):
        small("people.ahead=1e7")


def test_records_and_lines_tell_all_levels() -> None:
    report = small(*NEEDS)
    rooms = untimed(verdict_of(report)).room
    assert [room.name for room in rooms] == [level.name for level in report.room]
    assert [(one.key, one.source) for one in rooms[3].asked] == [("beside", None), ("ahead", None)]
    assert rooms[3].first is not None
    assert rooms[3].first.seconds is None
    assert rooms[0].first is None
    assert rooms[3].text.zh == "加上人"
    lines = check_lines(report)
    assert any("margin + 2·(sway + imprecision) = 0 + 2·(0.05 + 0.1) = 0.3 m" in line for line in lines)
    assert sum("surely broken at" in line for line in lines) == sum(
        level.kept is False for level in report.room
    )


def test_levels_are_proved_by_the_same_calls() -> None:
    plan = read_plan("turn", ["dragon.benches=6", "walk.start=0", "walk.end=8", "people.sway=0.01"])
    report = check(plan, prove=True)
    assert report.proved == all(level.first is None for level in report.room) is True
    tight = check(plan.with_values({"people.sway": 0.6}), prove=True)
    level = tight.room[-1]
    assert level.first is not None
    assert level.first[0].status == "proved"
    assert tight.proved


def random_plan(seed: int) -> Plan:
    """A small dance of two to four bends, and what its people need."""
    rng = np.random.default_rng(seed)
    bends = [
        {"kind": "arc", "radius": float(rng.uniform(1.6, 3.5)), "angle": float(side * angle)}
        for side, angle in zip(rng.choice([-1.0, 1.0], 4), rng.uniform(120.0, 300.0, 4), strict=True)
    ]
    data: dict[str, Any] = {
        "schema": 1,
        "dragon": {"benches": int(rng.integers(6, 12)), "head_length": float(rng.uniform(2.2, 3.4))},
        "route": {"kind": "parts", "part": [{"kind": "line", "length": 30.0}, *bends]},
        "walk": {"position": 28.0, "start": 0, "end": 12},
        "people": {
            "sway": float(rng.uniform(0.01, 0.1)), "imprecision": float(rng.uniform(0.01, 0.1)),
            "beside": float(rng.uniform(0.05, 0.3)), "ahead": float(rng.uniform(0.0, 0.6)),
        },
    }  # fmt: skip
    return checked(data, f"seed {seed}")


def sampled(plan: Plan, dragon: Dragon, margin: float) -> float:
    """The first time looked at, s, at which shapely finds two benches nearer than the margin."""
    walk = plan.build()
    motion = walk.motion(np.linspace(*plan.span(walk), SAMPLES))
    for t in range(SAMPLES):
        shapes = [_shape(motion.x[t], motion.y[t], dragon, k) for k in range(len(dragon))]
        for k, shape in enumerate(shapes):
            if any(shape.distance(other) <= margin - 1e-9 for other in shapes[k + 2 :]):
                return float(motion.times[t])
    return math.inf


def _shape(x: "np.typing.NDArray[Any]", y: "np.typing.NDArray[Any]", dragon: Dragon, k: int) -> Polygon:
    """The rectangle of bench k (a row), from its two handles and its sizes alone."""
    front, rear, bench = complex(x[k], y[k]), complex(x[k + 1], y[k + 1]), dragon[k]
    along = (front - rear) / abs(front - rear)
    tip, end = front + bench.front_inset * along, rear - bench.rear_inset * along
    side = 0.5j * bench.width * along
    return Polygon([(z.real, z.imag) for z in (tip + side, end + side, end - side, tip - side)])


@pytest.mark.parametrize("seed", range(DANCES))
def test_each_level_breaks_when_dense_sampling_has_it(seed: int) -> None:
    plan = random_plan(seed)
    report, needs = check(plan), plan.people
    wide = plan.build().dragon
    people = Dragon.of_sizes(
        wide.length + np.eye(1, len(wide))[0] * needs.ahead,
        wide.width + 2.0 * needs.beside,
        wide.front_inset + np.eye(1, len(wide))[0] * needs.ahead,
        wide.rear_inset,
    )
    both = 2.0 * (needs.sway + needs.imprecision)
    margins = (0.0, 2.0 * needs.sway, both, both)
    step = 12.0 / (SAMPLES - 1)
    for level, margin in zip(report.room, margins, strict=True):
        seen = sampled(plan, people if level.name == "people" else wide, margin)
        if level.contact is None:
            assert seen == math.inf
            continue
        assert level.contact.lower <= seen + 1e-9
        # A contact shorter than a step may be missed by samples, yet the witness shows that it is one.
        if seen > level.contact.upper + step:
            near = level.contact.witness
            assert near is not None
            assert near.gap <= margin + 1e-9


def test_the_search_of_people_is_that_of_their_dragon() -> None:
    report = small("people.beside=0.4")
    level, walk = report.room[-1], report.walk
    wide = type(walk)(
        Dragon.of_sizes(
            walk.dragon.length, walk.dragon.width + 0.8, walk.dragon.front_inset, walk.dragon.rear_inset
        ),
        walk.route, walk.profile, walk.start,
    )  # fmt: skip
    direct = first_contact(wide, report.start, report.end)
    assert level.contact is not None
    assert direct is not None
    assert (level.contact.lower, level.contact.upper) == (direct.lower, direct.upper)
    table = boxes(wide.motion([direct.upper]), 0)
    i, j = (bench - 1 for bench in direct.witness.benches) if direct.witness else (0, 0)
    shapes = [Polygon([corner(table, k, n) for n in range(4)]) for k in (i, j)]
    assert shapes[0].distance(shapes[1]) < 1e-9


def test_the_room_for_people_counts_between_benches() -> None:
    asked = ("people.sway=0.01", "people.imprecision=0.02", "people.beside=0.1", "limits.margin=0.04")
    small = ("dragon.benches=8", "route.pitch=1.2", "route.start_turn=4", "walk.end=12")
    levels = check(read_plan("spiral-in", [*small, *asked])).room
    # 0.04, then twice the sway, twice the imprecision, and the people of both benches.
    assert [level.between for level in levels] == [0.04, 0.06, 0.1, 0.3]
