"""Questions as methods of plans and walks, one for both; plans from code; what notebooks show."""

import pickle
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely

import benchdragon as bd
from benchdragon.i18n import spoken_in
from benchdragon.methods import Method

PLAN = bd.read_plan("turn", ["dragon.benches=20", "walk.start=0", "walk.end=20", "limits.speed=2"])
WALK = PLAN.build()
COIL = bd.read_plan("spiral-in", {"dragon.benches": 12, "walk.end": 30.0, "venue.rectangle": [24, 24]})
ANY_READ: Any = bd.read_plan
WELL = bd.Obstacle.circle("well", (0.0, 0.0), 0.5)
RECORDS = (bd.Plan, bd.Walk, bd.Motion, bd.Route, bd.Arc, bd.Dragon, bd.Answer, bd.Report, bd.Sweep,
           bd.SweptArea, bd.ClearanceCurve)  # fmt: skip


def methods(kind: type) -> dict[str, Method]:
    found = (vars(one).items() for one in reversed(kind.__mro__))
    return {name: of for items in found for name, of in items if isinstance(of, Method)}


@pytest.mark.parametrize("kind", RECORDS)
def test_methods_from_above_are_public_functions(kind: type) -> None:
    assert methods(kind)
    for name, method in methods(kind).items():
        function = getattr(bd, method.name)
        assert getattr(kind, name) is function
        record: Any = object.__new__(kind)
        bound = getattr(record, name)
        assert (bound.__self__, bound.__func__, bound.__doc__) == (record, function, function.__doc__)


def test_a_method_from_above_is_not_fetched_before_it_is_asked_for() -> None:
    script = (
        "import sys, benchdragon as bd; plan = bd.read_plan('turn'); plan.build(); "
        "print([name for name in ('matplotlib', 'benchdragon.analysis', 'benchdragon.solve') "
        "if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


QUESTIONS: dict[str, Callable[..., Any]] = {
    "first_contact": lambda of, *span: bd.first_contact(of, *span, margin=0.9),
    "contact_windows": lambda of, *span: [
        (one.opens.value, one.closes and one.closes.value)
        for one in bd.contact_windows(of, *span, margin=0.9)
    ],
    "least_clearance": bd.least_clearance,
    "greatest_speed": bd.greatest_speed,
    "swept_area": lambda of, *span: bd.swept_area(of, *span).area,
    "enclosing": lambda of, *span: bd.enclosing(of, *span).circle.radius,
    "first_touch": lambda of, *span: bd.first_touch(of, WELL, *span),
    "least_distance": lambda of, *span: bd.least_distance(of, WELL, *span),
}


def number(found: Any) -> Any:
    return getattr(found, "value", found)


@pytest.mark.parametrize("name", QUESTIONS)
def test_a_question_takes_a_plan_or_a_walk_and_the_whole_span_of_it(name: str) -> None:
    ask = QUESTIONS[name]
    wanted = number(ask(WALK, 0.0, 20.0))
    assert number(ask(PLAN)) == wanted
    assert number(ask(PLAN, 0.0)) == wanted
    assert number(ask(PLAN, 8.0)) == number(ask(WALK, 8.0, 20.0))
    alone = bd.Walk(WALK.dragon, WALK.route, start=WALK.route.length - 20.0)
    assert alone.span()[0] == 0.0
    assert alone.span()[1] == pytest.approx(20.0)
    assert number(ask(alone)) == number(ask(alone, *alone.span()))


def test_the_span_of_a_walk_that_never_ends_is_asked_for() -> None:
    still = bd.Walk(WALK.dragon, WALK.route, bd.SpeedProfile.constant(0.0), 50.0)
    with pytest.raises(bd.InputError, match="say start and end"):
        still.first_contact()
    assert still.first_contact(0.0, 1.0) is None


def test_the_table_of_a_plan_is_not_taken_for_its_walk() -> None:
    table: Any = PLAN.walk
    with pytest.raises(bd.InputError, match=r"plan\.walk is a table of the plan: ask about the plan"):
        bd.first_contact(table)


def test_clearance_over_time_has_times_of_its_own_unless_they_are_given() -> None:
    curve = PLAN.clearance_curve()
    assert (len(curve.times), curve.times[0], curve.times[-1]) == (301, 0.0, 20.0)
    assert curve.clearance.min() >= PLAN.least_clearance().lower


def test_timetable_and_bench_walks_take_the_walk_and_the_span_of_the_plan() -> None:
    assert PLAN.timetable() == bd.timetable(PLAN, WALK, 0.0, 20.0)
    assert PLAN.timetable(end=10.0) == bd.timetable(PLAN, WALK, 0.0, 10.0)
    ours, theirs = COIL.bench_walks(), bd.bench_walks(COIL, COIL.build(), (0.0, 30.0))
    assert [repr(one) for one in ours] == [repr(one) for one in theirs]


def test_a_proof_of_a_plan_counts_its_numbers_as_written() -> None:
    pytest.importorskip("flint")
    said = ["dragon.benches=4", "walk.end=1", "route.pitch=0.55000000000000000000001"]
    plan = bd.read_plan("spiral-in", said)
    assert bd.prove_contact(plan.build(), 0.0, 1.0) is None
    with pytest.raises(bd.InputError, match=r"0\.55000000000000000000001"):
        bd.prove_contact(plan)


@pytest.mark.parametrize(
    "read",
    [
        lambda: bd.read_plan("spiral-in", {"disc.radius": 4.5, "dragon.benches": 40}),
        lambda: bd.read_plan(
            "spiral-in", {"disc.radius": np.float64(4.5), "dragon.benches": np.int64(40)}
        ),
        lambda: bd.read_plan("spiral-in", disc={"radius": 4.5}, dragon={"benches": 40}),
        lambda: bd.read_plan("spiral-in", ["disc.radius=4.5"], dragon={"benches": 40}),
        lambda: bd.read_plan("spiral-in", "disc.radius=4.5").with_value("dragon.benches", np.int64(40)),
    ],
)
def test_settings_are_texts_or_values(read: Callable[[], bd.Plan]) -> None:
    assert read() == bd.read_plan("spiral-in", ["disc.radius=4.5", "dragon.benches=40"])


def test_a_plan_of_code_is_that_of_a_file() -> None:
    tables = {"dragon": {"benches": 10}, "route": {"kind": "spiral-in", "pitch": 1.2}}
    made = bd.Plan(**tables)
    assert made == bd.Plan.model_validate({"schema": 1, **tables})
    assert pickle.loads(pickle.dumps(made)) == made
    parts = bd.Plan(route={"part": [{"kind": "line", "length": 300}]}, dragon={"benches": 3})
    assert parts.route.kind == "parts"
    assert parts.build().route.length >= 300.0
    assert bd.Plan(base="spiral-in", dragon={"benches": 10}).route.kind == "spiral-in"


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (bd.Plan, "route is missing"),
        (
            lambda: bd.Plan(route={"kind": "spiral-in", "pitsch": 1.2}),
            "route.pitsch is not a known key; did you mean route.pitch?",
        ),
        (lambda: bd.Plan(dragon={"benches": -3}), "expected at least 1, not -3"),
        (lambda: bd.read_plan("spiral-in", {"disc.radius": "wide"}), "expected a number"),
        (lambda: bd.read_plan("spiral-in", speed=2), "speed is not a known key"),
        (lambda: ANY_READ("spiral-in", 4.5), 'settings must be like {"disc.radius": 4.5}, not 4.5'),
        (lambda: ANY_READ("spiral-in", [4.5]), "expected KEY=VALUE, not 4.5"),
        (lambda: ANY_READ("spiral-in", {4.5: 1}), "expected KEY=VALUE"),
    ],
)
def test_plans_of_code_fail_as_those_of_files_do(make: Callable[[], object], sentence: str) -> None:
    with pytest.raises(bd.PlanError) as caught:
        make()
    assert sentence in str(caught.value)


def test_an_arc_says_its_unit() -> None:
    assert bd.Arc(9.0, degrees=90.0) == bd.Arc(9.0, np.pi / 2)
    assert bd.Arc(9.0, degrees=3600.0) == bd.Arc(9.0, 20.0 * np.pi, many=True)
    round_ = bd.Arc(9.0, degrees=3600.0).moved((1.0, 2.0), 0.5)
    assert (round_.sweep, round_.start) == (20.0 * np.pi, (1.0, 2.0))
    wrong: dict[str, tuple[float, float | None]] = {
        "an angle of 360 rad is 57.3 turns: say degrees=360 if": (360.0, None),
        "an angle of -45 rad is -7.2 turns": (-45.0, None),
        "not both": (1.0, 90.0),
        "must not be 0": (0.0, None),
    }
    for said, (sweep, degrees) in wrong.items():
        with pytest.raises(bd.InputError, match=re.escape(said)):
            bd.Arc(9.0, sweep, degrees=degrees)


def test_an_obstacle_takes_lists_and_shapes_of_shapely() -> None:
    house = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)]
    drawn = bd.Obstacle.polygon("house", shapely.Polygon(house))
    assert drawn == bd.Obstacle.polygon("house", house) == bd.Obstacle("house", "polygon", house)  # type: ignore[arg-type]
    assert bd.Obstacle.line("rope", shapely.LineString(house)) == bd.Obstacle.line("rope", house)
    ring = shapely.Point(0.0, 0.0).buffer(2.0).difference(shapely.Point(0.0, 0.0).buffer(1.0))
    for wrong in (ring, shapely.MultiPoint(house)):
        with pytest.raises(bd.InputError, match="house: expected a polygon without holes, or a line"):
            bd.Obstacle.polygon("house", wrong)


def test_a_motion_is_a_sequence_of_moments_whose_tables_cannot_be_written() -> None:
    motion = WALK.motion([0.0, 5.0, 10.0, 15.0])
    motion.speed.sum()
    assert len(motion) == 4
    assert [float(one.times[0]) for one in motion] == [0.0, 5.0, 10.0, 15.0]
    for rows in (1, -1, slice(None, None, 2), [3, 0], motion.times > 4.0):
        part, chosen = motion[rows], np.atleast_1d(np.arange(4)[rows])
        assert np.array_equal(part.times, motion.times[chosen])
        for name in ("x", "y", "s", "speed", "acceleration", "heading", "turning_rate", "status"):
            assert np.array_equal(getattr(part, name), getattr(motion, name)[chosen]), name
            with pytest.raises(ValueError, match="read-only"):
                getattr(part, name)[...] = 0.0
        assert part.walk is WALK
    assert bd.tightest_pairs(motion[2:], 0) == bd.tightest_pairs(motion, 2)
    with pytest.raises(IndexError):
        motion[4]


def test_corners_and_outlines_are_those_of_each_bench() -> None:
    walk = bd.Walk(
        bd.Dragon([bd.Bench(2.0, 0.4, 0.1, 0.3), bd.Bench(1.0)]), bd.Route((bd.Line(9.0),)), start=5.0
    )
    motion = walk.motion([0.0, 100.0], throw=False)
    corners, outlines = motion.corners(), motion.outlines()
    assert corners.shape == (2, 2, 4, 2)
    assert np.allclose(corners[0, 0], [(5.1, 0.2), (3.1, 0.2), (3.1, -0.2), (5.1, -0.2)])
    assert outlines[0, 1].area == pytest.approx(0.3)
    assert outlines[1].tolist() == [None, None]


SHOWN: dict[str, Callable[[], Any]] = {
    "plan": lambda: PLAN,
    "a plan that cannot be": lambda: bd.Plan(dragon={"front_inset": 3.0}, route={"kind": "turn"}),
    "walk": lambda: WALK,
    "motion": lambda: WALK.motion([0.0, 14.0]),
    "a motion that fails": lambda: WALK.motion([1e6], throw=False),
    "route": lambda: WALK.route,
    "dragon": lambda: WALK.dragon,
    "answer": PLAN.least_clearance,
    "report": PLAN.check,
    "a report of one bench": bd.read_plan("spiral-in", {"dragon.benches": 1, "walk.end": 1.0}).check,
}  # fmt: skip


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("name", SHOWN)
def test_a_notebook_shows_a_table_and_a_small_picture(name: str, language: str) -> None:
    record = SHOWN[name]()
    with spoken_in(language):
        page = record._repr_html_()
    root = ElementTree.fromstring(page)
    assert all(cell.text for row in root.iter("tr") for cell in row)
    pictures = list(root.iter("svg"))
    assert len(pictures) == (name not in ("dragon", "answer", "a plan that cannot be"))
    x, y, width, height = map(float, pictures[0].attrib["viewBox"].split()) if pictures else (0,) * 4
    for path in root.iter("path"):
        points = np.array(re.findall(r"-?[\d.]+", path.attrib["d"]), np.float64).reshape(-1, 2)
        # Benches reach farther than the route and the handles do, by a bench at most.
        assert (points > (x - 20.0, y - 20.0)).all()
        assert (points < (x + width + 20.0, y + height + 20.0)).all()
    assert len(repr(record)) < 250
    assert len(page) < 60_000


def test_the_picture_of_a_motion_has_each_bench_and_the_head_on_top() -> None:
    page = ElementTree.fromstring(WALK.motion(14.0)._repr_html_())
    looks = [path.attrib.get("fill") for path in page.iter("path")]
    assert looks == ["none", *["#56B4E9"] * 19, "#D55E00"]
    long = bd.Walk(bd.Dragon.uniform(600), bd.Route((bd.Line(2000.0),)), start=1500.0)
    assert long.motion(0.0)._repr_html_().count("<path") == 2


def test_a_player_shows_a_plan_as_it_is_judged_a_walk_and_a_motion() -> None:
    shown = PLAN.show().html
    assert shown.startswith("<iframe")
    assert "Turning" in shown
    assert bd.show(WALK).html.startswith("<iframe")
    still = bd.Walk(WALK.dragon, WALK.route, bd.SpeedProfile.constant(0.0), 50.0)
    assert bd.show(still).html.startswith("<pre>")
    wrong: Any = 1.0
    with pytest.raises(bd.InputError, match="motion must be a Motion, a Walk or a Plan, not "):
        bd.show(wrong)


def test_a_report_is_told_by_its_verdict() -> None:
    report = PLAN.check()
    assert str(report).startswith(("Safe: ", "Not safe: "))
    assert repr(report) == f"<Report of {PLAN!r}: safe, 0 findings>"
    assert repr(PLAN) == str(PLAN) == "<Plan 'Turning': turn, 20 benches>"
