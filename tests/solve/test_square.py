"""Inverse questions with a venue and obstacles; and where on its square a dance fits best."""

import json
import math
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import shapely

from benchdragon.analysis.check import check
from benchdragon.analysis.contact import least_clearance
from benchdragon.analysis.distance import boxes
from benchdragon.analysis.obstacles import first_touch, least_distance
from benchdragon.cli.main import run
from benchdragon.errors import InputError
from benchdragon.kernels import size_square
from benchdragon.kernels.box import corner
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.obstacle_search import ObstacleEnding
from benchdragon.kernels.size_bracket import SizeVerdict
from benchdragon.kernels.turn_peaks import TURN_MEASURES, TurnMeasure
from benchdragon.model.walk import Motion
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.progress import silent
from benchdragon.solve import place
from benchdragon.solve.place import Exact, best_place, enough_room
from benchdragon.solve.size import feasible_sizes, limit
from benchdragon.solve.size_family import PlanFamily, question
from benchdragon.solve.size_question import SizeQuestion
from benchdragon.solve.square import Square
from benchdragon.solve.turn import _exact_figures, best_turn
from tests.solve.asked_in_python import in_python

COIL = ["disc.radius=4.5", "dragon.benches=20", "route.start_turn=11"]
WELL = 'obstacle=[{kind="circle", name="well", centre=[0, 0], radius=3.9}]'


def blocked(plan: Plan) -> bool:
    """Whether a bench surely comes nearer to an obstacle than it may, over the whole walk."""
    walk = plan.build()
    span = plan.span(walk)
    touches = [first_touch(walk, obstacle, *span) for obstacle in plan.obstacles()]
    assert not any(touch and touch.status == "undecided" for touch in touches)
    return any(touch is not None for touch in touches)


@pytest.mark.parametrize(
    ("name", "key", "settings"),
    [
        ("disc", "disc.radius", [WELL]),
        ("pitch", "route.pitch", ['obstacle=[{kind="circle", centre=[0, 0], radius=4.2}]']),
        (
            "width",
            "dragon.width",
            ["route.pitch=1.5", WELL.replace("3.9", "4.1"), "limits.margin=0.01"],
        ),
    ],
)
def test_next_to_a_limit_that_an_obstacle_sets_the_walk_is_blocked(
    name: str, key: str, settings: list[str]
) -> None:
    plan = read_plan("spiral-in", [*COIL, *settings])
    found = limit(plan, name)
    assert found.status == "found"
    assert found.upper - found.lower < 1e-9
    assert found.witness is not None
    assert found.witness.obstacle in {"well", "obstacle 1"}
    assert any(text.startswith("the venue and obstacles count") for text in found.assumptions)
    sizes = {"length": found.lower, "width": found.lower}.get(name, found.upper)
    beyond = found.upper if sizes == found.lower else found.lower
    passes, fails = plan.with_value(key, sizes), plan.with_value(key, beyond)
    assert not blocked(passes)
    assert blocked(fails)
    walk = passes.build()
    gap = least_distance(walk, passes.obstacles()[0], *passes.span(walk))
    assert gap.value == pytest.approx(plan.limits.margin, abs=1e-9)
    assert least_clearance(walk, *passes.span(walk)).lower > plan.limits.margin
    without = limit(
        read_plan("spiral-in", [*COIL, *(one for one in settings if "obst" not in one)]), name
    )
    assert without.value != pytest.approx(found.value, abs=1e-3)


def test_an_obstacle_that_no_bench_comes_near_changes_no_answer() -> None:
    plan, venue = read_plan("spiral-in", COIL), "venue.rectangle=[60, 60]"
    far = read_plan("spiral-in", [*COIL, venue])
    for name in ("pitch", "disc", "width"):
        assert limit(far, name).value == limit(plan, name).value


def test_no_pitch_far_from_the_plans_own_is_tried() -> None:
    """One of 11.5 m would: twenty times the plan's own, which is not tried, and that is said."""
    well = 'obstacle=[{kind="circle", centre=[8, 0], radius=3.2}]'
    found = limit(read_plan("spiral-in", [*COIL, well]), "pitch")
    assert (found.status, found.witness) == ("infeasible", None)
    assert "none over 10 times the plan's own was tried" in found.assumptions[-1]


def test_limits_of_a_moved_dance_are_those_of_the_dance_among_moved_obstacles() -> None:
    plan = read_plan("spiral-in", [*COIL, 'obstacle=[{kind="circle", centre=[0.3, 0.1], radius=3.7}]'])
    (x, y), turned = (-7.0, 3.0), math.radians(40.0)
    at = [
        x + 0.3 * math.cos(turned) - 0.1 * math.sin(turned),
        y + 0.3 * math.sin(turned) + 0.1 * math.cos(turned),
    ]
    moved = plan.with_values({"route.at": [x, y], "route.turned": 40.0, "obstacle.0.centre": at})
    one, other = limit(plan, "disc"), limit(moved, "disc")
    assert other.value == pytest.approx(one.value, abs=1e-9)


def test_far_from_the_origin_obstacles_set_the_same_limit() -> None:
    plan = read_plan("spiral-in", [*COIL, WELL])
    moved = plan.with_values({"route.at": [4e4, 0.0], "obstacle.0.centre": [4e4, 0.0]})
    assert limit(moved, "disc").value == pytest.approx(limit(plan, "disc").value, abs=1e-9)


def test_a_size_of_which_an_obstacle_leaves_it_open_does_not_pass(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plan = read_plan("spiral-in", [*COIL, "dragon.benches=3", "walk.end=9", WELL])
    in_python(monkeypatch)
    with SizeQuestion(PlanFamily(plan, question("pitch"), 0.0), silent) as search:
        assert search.trial(0.55) == SizeVerdict.PASSES
        monkeypatch.setattr(size_square, "stepped", lambda *_step: ObstacleEnding.TOO_OFTEN)
        assert search.trial(0.55) == SizeVerdict.UNDECIDED


SHORT = [*COIL, "dragon.benches=2", "walk.end=3"]


@pytest.mark.parametrize("x", [0.0, 4e4])
def test_a_second_obstacle_fails_a_size_as_the_first_does_wherever_a_dance_is(x: float) -> None:
    well, far = ({"kind": "circle", "centre": [x + at, 0.0], "radius": 1.0} for at in (6.0, 60.0))
    plan = read_plan("spiral-in", SHORT).with_value("route.at", [x, 0.0])
    for things in ([well], [far, well]):
        among = PlanFamily(plan.with_value("obstacle", things), question("pitch"), 0.0)
        with SizeQuestion(among, silent) as search:
            assert search.trial(0.55) == SizeVerdict.FAILS
            assert search.blocked(0.55) == len(things) - 1


def test_beside_obstacles_no_size_far_from_the_plans_own_passes() -> None:
    far = {"kind": "circle", "centre": [600.0, 0.0], "radius": 1.0}
    plan = read_plan("spiral-in", [*SHORT, "walk.end=1"])
    for things, result in ((None, SizeVerdict.PASSES), ([far], SizeVerdict.FAILS)):
        among = PlanFamily(
            plan.with_values({"obstacle": things} if things else {}), question("pitch"), 0.0
        )
        with SizeQuestion(among, silent) as search:
            assert search.trial(5.4) == SizeVerdict.PASSES
            assert search.trial(5.6) == result


def test_rounds_past_an_obstacle_are_searched_once_for_a_size() -> None:
    post = {"kind": "circle", "centre": [8.5, 0.3], "radius": 2.0}
    evaluations = []
    for rounds in (2, 4):
        route = {"kind": "formation", "name": "figure-eight", "radius": 6.0, "rounds": rounds}
        told = {"schema": 1, "dragon": {"benches": 1}, "route": route, "obstacle": [post]}
        with SizeQuestion(PlanFamily(checked(told, "plan"), question("width"), 0.0), silent) as search:
            assert search.trial(0.3) == SizeVerdict.PASSES
            evaluations.append(search.evaluations)
    assert 0 < evaluations[1] == evaluations[0]


def test_sizes_of_a_range_stop_at_an_obstacle() -> None:
    plan = read_plan("spiral-in", [*COIL, WELL])
    (span,) = feasible_sizes(plan, "disc", 4.0, 5.0, 11).spans
    assert span.low == pytest.approx(limit(plan, "disc").value, abs=1e-9)
    assert span.high == 5.0


def test_a_best_turn_keeps_clear_of_a_post_in_its_way() -> None:
    few = ["dragon.benches=12", "route.at=[30, -20]", "route.turned=70"]
    free = best_turn(read_plan("turn", few)).plan
    walk = free.build()
    x, y = walk.route.point(0.5 * float(walk.route.joints[1] + walk.route.joints[-2])).tolist()
    post = f'obstacle=[{{kind="circle", name="post", centre=[{x + 0.45}, {y + 0.45}], radius=0.2}}]'
    plan = read_plan("turn", [*few, post, "venue.rectangle=[70, 70]", "venue.centre=[30, -20]"])
    of_free = {"turn": free.turn, "disc": free.disc}
    assert any(finding.obstacle for finding in check(plan.model_copy(update=of_free)).findings)
    best = best_turn(plan)
    assert not [finding for finding in check(best.plan).findings if finding.obstacle]


def test_what_touches_keeps_no_margin_of_a_turn() -> None:
    """A clearance of 0 is that of benches that touch: it is less than a margin of 0."""
    plan = read_plan(
        "turn", ["dragon.benches=12", 'obstacle=[{kind="line", points=[[0, -2], [0, 2]]}]']
    )
    exact, _clearance = _exact_figures(plan, [-1.0] * TURN_MEASURES, ())
    assert exact[TurnMeasure.BESIDE] > 0.0
    assert exact[TurnMeasure.APART] < 0.0


SQUARE = [
    "dragon.benches=8", "disc.radius=2.9", "route.pitch=0.9", "route.start_turn=6",
    "venue.boundary=[[0, 0], [24, 0], [24, 9], [14, 9], [14, 20], [0, 20]]",
    'obstacle=[{kind="circle", name="well", centre=[7, 12], radius=0.5, margin=0.3}]',
]  # fmt: skip


def room(plan: Plan) -> float:
    """The least distance to an obstacle beyond its margin, m; negative where one is touched."""
    walk = plan.build()
    span = plan.span(walk)
    apart = [(least_distance(walk, one, *span), one.margin) for one in plan.obstacles()]
    return min(found.value - margin if found.value else -1.0 for found, margin in apart)


def test_no_place_that_is_tried_has_more_room_than_the_best() -> None:
    plan = read_plan("spiral-in", SQUARE)
    best = best_place(plan)
    assert best.room.status == "found"
    assert best.room.lower <= room(best.plan) <= best.room.upper
    assert best.plan.route.at == best.at
    said = json.loads(json.dumps(best.as_json()))
    assert said["check"]["safe"] is best.passes is True
    assert (said["at"], said["turned"], set(said["distances"])) == (
        list(best.at),
        best.turned,
        {"venue", "well"},
    )
    assert room(best.plan) == pytest.approx(
        min(found.distance.value - found.obstacle.margin for found in best.obstacles), abs=1e-12
    )
    random = np.random.default_rng(18)
    for _place in range(120):
        near = random.random() < 0.5
        at = random.normal(best.at, 0.3) if near else random.uniform([0.0, 0.0], [24.0, 20.0])
        turned = best.turned + random.normal(0.0, 5.0) if near else random.uniform(0.0, 360.0)
        tried = plan.with_values({"route.at": at.tolist(), "route.turned": turned})
        assert room(tried) <= best.room.upper + 2e-3  # metres are told to millimetres


def test_the_place_is_looked_at_by_exact_distances_last(monkeypatch: pytest.MonkeyPatch) -> None:
    """The boxes of the global search lie so far apart here that they lead to a poorer place."""
    monkeypatch.setattr(place, "Square", partial(Square, step=2.5))
    plan = read_plan("spiral-in", SQUARE)
    square = Square(plan.with_values({"route.at": [0.0, 0.0], "route.turned": 0.0}), step=2.5)
    by_boxes = Exact(square).crowding(square.roomiest(silent))
    found = best_place(plan).room.value
    assert isinstance(found, float)
    assert found > 2e-3 - by_boxes


def test_a_dance_that_fits_nowhere_is_told_so(capsys: pytest.CaptureFixture[str]) -> None:
    settings = [word for text in SQUARE[:4] for word in ("--set", text)]
    words = ["solve", "place", "spiral-in", *settings, "--set", "venue.rectangle=[9, 9]", "--quiet"]
    assert run(words) == 4
    assert "missing where" not in capsys.readouterr().out, "no margin is asked for"
    assert run([*words, "--set", "limits.venue_margin=0.1"]) == 4
    out = capsys.readouterr().out
    assert "no place was found where the dance fits on this square" in out
    assert "least distance from the edge of the venue: 0 m (found)" in out
    assert "it has a place with" not in out, "the head alone is too far out"
    assert "missing where it is tightest: 0.1 m or more" in out


def test_what_would_do_for_a_dance_without_a_place_does(capsys: pytest.CaptureFixture[str]) -> None:
    settings = [
        *SQUARE[1:4],
        "dragon.benches=30",
        "venue.rectangle=[13, 12.6]",
        "limits.venue_margin=0.1",
    ]
    words = ["solve", "place", "spiral-in", *(word for one in settings for word in ("--set", one))]
    assert run([*words, "--quiet", "--json"]) == 4
    enough = json.loads(capsys.readouterr().out)["enough"]
    plan = read_plan("spiral-in", settings)
    larger = plan.with_value("venue.rectangle", enough["rectangle"])
    assert best_place(larger).room.status == "found"
    length, width = enough["rectangle"]
    assert length >= width > 12.6
    smaller = plan.with_value("venue.rectangle", [length - 0.4, width - 0.4])
    assert best_place(smaller).room.status == "infeasible"
    count = enough["benches"]
    assert 1 < count < 30
    assert best_place(plan.with_value("dragon.benches", count)).room.status == "found"
    assert best_place(plan.with_value("dragon.benches", count + 1)).room.status == "infeasible"
    assert run([*words, "--quiet", "--lang", "en"]) == 4
    told = capsys.readouterr().out
    assert f"it has a place with {count} benches: write benches = {count} below [dragon]" in told
    assert f"fits on a square of {length:g} m by {width:g} m" in told


VILLAGE = Path(__file__).parents[1] / "cases" / "village" / "ahead_false_pair.dragon.toml"
PEOPLED = [
    "disc.radius=2.9", "route.pitch=1.7", "route.start_turn=4",
    "dragon.benches=12", "venue.rectangle=[19, 19]",
    "people.beside=0.4", "people.ahead=0.3", "people.sway=0.05", "people.imprecision=0.1",
]  # fmt: skip


def test_a_place_has_the_room_that_check_asks_for_people() -> None:
    best = best_place(read_plan("spiral-in", PEOPLED))
    assert best.room.status == "found"
    sides = best.plan.venue.rectangle
    assert sides is not None

    def kept(less: float) -> bool:
        """Whether all levels are, on a square whose edges are so much nearer, m."""
        smaller = [side - 2.0 * less for side in sides]
        levels = check(best.plan.with_value("venue.rectangle", smaller)).room
        assert len(levels) == 4
        return all(one.contact is None for level in levels for one in level.obstacles)

    assert kept(best.room.lower - 1e-6)
    assert not kept(best.room.upper + 1e-6)


def test_a_square_that_would_do_has_room_for_people() -> None:
    plan = read_plan("spiral-in", [*PEOPLED, "venue.rectangle=[15, 14]"])
    assert best_place(plan).report is None
    enough = enough_room(plan)
    assert enough.rectangle is not None
    larger = best_place(plan.with_value("venue.rectangle", list(enough.rectangle)))
    assert larger.passes
    assert enough.benches is not None
    fewer = best_place(plan.with_value("dragon.benches", enough.benches))
    for best in (larger, fewer):
        report = check(best.plan)
        assert report.safe
        assert [level.kept for level in report.room] == 4 * [True]


@pytest.mark.parametrize("pitch", [1.7, 1.55, 1.2])
@pytest.mark.parametrize("sides", ["[19, 19]", "[22, 17]", "[40, 30]"])
def test_a_place_is_told_to_pass_just_where_check_finds_it_safe(pitch: float, sides: str) -> None:
    plan = read_plan("spiral-in", [*PEOPLED, f"route.pitch={pitch}", f"venue.rectangle={sides}"])
    best = best_place(plan)
    assert best.report is not None, "there is room on the square"
    report = check(best.plan)
    assert best.passes == report.safe == (pitch > 1.5)
    assert best.passes == all(level.kept for level in report.room)


def test_a_place_at_which_check_refuses_the_dance_is_not_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The square has room, but what lacks is between benches: no place mends that."""
    found = tmp_path / "found.dragon.toml"
    words = ["solve", "place", str(VILLAGE), "--quiet", "--lang", "en"]
    assert run([*words, "-o", str(found)]) == 1
    out = capsys.readouterr().out
    assert "room beyond the margins and what people take: 0.1" in out
    refused = (
        "but the dance does not pass the check there, and no plan is written: Not safe: the people of"
    )
    assert refused in out
    assert not found.exists()
    assert run([*words, "--set", "venue.rectangle=[9, 9]", "--json"]) == 4
    said = json.loads(capsys.readouterr().out)
    assert said["check"] is None
    assert said["enough"]["rectangle"] is None
    assert said["enough"]["check"]["sentence"]["en"].startswith("Not safe: the people of benches 1 and")


def test_a_place_needs_a_venue() -> None:
    with pytest.raises(InputError, match=r"no venue to be placed in: add \[venue\]"):
        best_place(read_plan("spiral-in", SQUARE[:4]))


def test_margins_ask_about_benches_alone_and_say_so(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["margins", "spiral-in", "--draws", "2", "--aside", "0.01", "--quiet"]
    for text in (*COIL, WELL.replace("3.9", "4.2")):  # which sets the pitch: 1.7 m
        words += ["--set", text]
    assert run(words) == 0
    out = capsys.readouterr().out
    assert "benches alone are asked about: the venue and obstacles do not count here" in out
    assert "without deviations: 0.4" in out


@pytest.mark.parametrize("name", ["spiral-in", "turn"])
def test_the_smallest_square_holds_all_benches(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    settings = ["dragon.benches=30", "route.at=[3, -2]", "route.turned=25"]
    settings += COIL[:1] + COIL[2:] if name == "spiral-in" else []
    plan = read_plan(name, settings)
    words = ["solve", "square", name, *(word for one in settings for word in ("--set", one)), "--quiet"]
    assert run([*words, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    walk = plan.build()
    placed = walk.motion(np.linspace(*plan.span(walk), 400))
    corners = [shapely.Polygon(ring) for ring in outlines(placed)]
    ground = shapely.union_all(corners)
    box = shapely.Polygon(found["rectangle"]["corners"])
    assert box.buffer(1e-9).contains(ground)
    assert box.area == pytest.approx(found["rectangle"]["area"]["value"], rel=1e-9)
    least = shapely.minimum_rotated_rectangle(ground).area
    assert found["rectangle"]["area"]["lower"] <= box.area <= least * 1.01
    centre, radius = found["circle"]["centre"], found["circle"]["radius"]
    assert shapely.Point(centre).buffer(radius["upper"] + 1e-9, 4096).contains(ground)
    sampled = shapely.minimum_bounding_radius(ground)
    assert radius["lower"] <= sampled + 1e-3
    assert sampled <= radius["upper"] <= sampled + 0.02
    assert run(words) == 0
    out = capsys.readouterr().out
    assert f"radius {math.ceil(100.0 * radius['upper'] + 0.2) / 100.0:.2f} m" in out


def outlines(placed: Motion) -> FloatArray:
    """The corners of every bench at every time, m, (benches, 4, 2)."""
    rows = [boxes(placed, n) for n in range(len(placed.times))]
    table = np.vstack(rows)
    return np.array([[corner(table, i, k) for k in range(4)] for i in range(len(table))])
