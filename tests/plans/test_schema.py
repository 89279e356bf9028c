import math
import re
from pathlib import Path

import jsonschema
import pytest

from benchdragon import Arc, Clothoid, Line, Spiral
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import PlanError, built_in_names, read_toml
from benchdragon.plans.units import (
    ACCELERATIONS,
    ANGULAR_SPEEDS,
    DEGREES,
    METRES,
    SECONDS,
    SPEEDS,
    quantity,
)

ROUTE = {"kind": "parts", "part": [{"kind": "line", "length": 5}]}


def test_built_in_plans_are_the_papers_two_parts() -> None:
    assert built_in_names()[:4] == ["spiral-in", "turn", "question-3", "gaochun"]
    assert len(built_in_names()) == 11
    spiral, turn = read_plan("spiral-in").build(), read_plan("turn").build()
    assert len(spiral.dragon) == len(turn.dragon) == 223
    assert spiral.dragon.links[:2].tolist() == pytest.approx([2.86, 1.65])
    assert spiral.motion([0.0]).x[0, 0] == pytest.approx(8.8)
    assert turn.start == turn.route.joints[1]
    assert [type(curve) for curve in turn.route.curves] == [Spiral, Arc, Arc, Spiral]


@pytest.mark.parametrize(
    ("text", "units", "value"),
    [
        ("55 cm", METRES, 0.55),
        ("55cm", METRES, 0.55),
        ("3 min 12 s", SECONDS, 192.0),
        ("1.5e2 mm", METRES, 0.15),
        ("-100 s", SECONDS, -100.0),
        ("90 deg", DEGREES, 90.0),
        ("2 米", METRES, 2.0),
        ("1h2min 3s", SECONDS, 3723.0),
        ("2 m/s^2", ACCELERATIONS, 2.0),
        ("20cm/s^2 3 m/s²", ACCELERATIONS, 3.2),
        ("20 deg/s", ANGULAR_SPEEDS, 20.0),
        ("90°/s", ANGULAR_SPEEDS, 90.0),
        ("1 rad/s", ANGULAR_SPEEDS, 180.0 / math.pi),
        ("60 公尺", METRES, 60.0),
        ("６０　ｍ", METRES, 60.0),
        ("－５．５厘米", METRES, -0.055),
        ("48 m/min", SPEEDS, 0.8),
        ("48米/分", SPEEDS, 0.8),
    ],
)
def test_a_quantity_may_carry_a_unit(text: str, units: dict[str, float], value: float) -> None:
    assert quantity(text, units) == pytest.approx(value)


@pytest.mark.parametrize("text", ["55", "55 kg", "cm", "", "5 cm 3", "1..2 m"])
def test_a_quantity_without_a_known_unit_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="expected a number, or text with a unit of m, cm"):
        quantity(text, METRES)


@pytest.mark.parametrize(
    ("setting", "sentence"),
    [
        ("dragon.bences=3", "dragon.bences is not a known key; did you mean dragon.benches?"),
        ("route.pitc=3", "route.pitc is not a known key; did you mean route.pitch?"),
        ("wak.speed=3", "wak.speed is not a known key; did you mean walk.speed?"),
        ("route.pitch=-1", "route.pitch: expected more than 0.0, not -1"),
        ("route.pitch=nan", "route.pitch: expected a finite number, not NaN"),
        ("route.pitch=inf", "route.pitch: expected a finite number, not Infinity"),
        ("route.pitch=60 kg", "route.pitch: expected a number, or text with a unit of m, cm"),
        ("dragon.benches=2.5", "dragon.benches: expected a whole number, not 2.5"),
        ("dragon.benches=0", "dragon.benches: expected at least 1, not 0"),
        ("dragon.benches=1000001", "dragon.benches: expected at most 1000000, not 1000001"),
        ("dragon=3", "dragon: expected a table, not 3"),
        (
            'route.kind="circle"',
            "route.kind: expected 'spiral-in', 'turn', 'parts', 'formation', 'programme', 'drawn', not "
            '"circle"',
        ),
        ("walk.profile=3", "walk.profile: expected a list, not 3"),
        ("walk.speed=-1", "walk.speed: expected at least 0.0, not -1"),
        ("schema=2", "schema: expected 1, not 2"),
        ("nonsense", "expected KEY=VALUE, not 'nonsense'"),
        ("dragon.benches.x=1", "there is no dragon.benches.x to set"),
    ],
)
def test_a_bad_value_is_named_with_what_was_wanted(setting: str, sentence: str) -> None:
    with pytest.raises(PlanError, match=r":|expected|there is no") as caught:
        read_plan("spiral-in", [setting])
    assert sentence in str(caught.value)


def test_a_bad_value_in_a_list_is_named_by_its_number() -> None:
    route = {"part": [{"kind": "line", "length": 5}, {"kind": "arc", "radius": -1, "angle": 9}]}
    with pytest.raises(PlanError, match=r"x: route\.part\.1\.radius: expected more than 0\.0, not -1"):
        checked({"schema": 1, "route": route}, "x")


def test_limits_take_the_units_of_what_they_limit() -> None:
    settings = ["acceleration='50 cm/s^2'", "turning_rate='1 rad/s'", "head_acceleration='0.2 m/s²'"]
    limits = read_plan("turn", [f"limits.{setting}" for setting in settings]).limits
    found = (limits.acceleration, limits.turning_rate, limits.head_acceleration)
    assert found == pytest.approx((0.5, 180.0 / math.pi, 0.2))
    for setting in ("acceleration='1 m/s'", "turning_rate='20 deg'", "head_acceleration='2 m/s^3'"):
        with pytest.raises(
            PlanError, match=r"expected a number, or text with a unit of (m/s\^2|deg/s)"
        ):
            read_plan("turn", [f"limits.{setting}"])


def test_settings_reach_into_lists() -> None:
    path = Path(__file__).parents[2] / "examples" / "01_parade.dragon.toml"
    walk = read_plan(str(path), ["route.part.0.length=50", "route.part.2.length='30 m'"]).build()
    assert walk.route.length == pytest.approx(80.0 + 4.0 * math.pi)
    for key in ("route.part.7.length", "route.part.7", "route.part.one", "route.part.0.length.x"):
        with pytest.raises(PlanError, match=rf"there is no {re.escape(key)} to set"):
            read_plan(str(path), [f"{key}=50"])
    for key in ("walk.profile.0.1.x", "walk.profile.0.1.x.y"):
        with pytest.raises(PlanError, match=rf"there is no {re.escape(key)} to set"):
            read_plan(str(path), ["walk.profile=[[0, 1]]", f"{key}=50"])


def test_sizes_that_cannot_be_are_a_plan_error() -> None:
    with pytest.raises(PlanError, match=r"bench 2: its insets \(3 m and 0.275 m\) leave no link"):
        read_plan("turn", ["dragon.front_inset=3"]).build()


def test_a_disc_larger_than_the_start_is_refused() -> None:
    with pytest.raises(PlanError, match="must be smaller than the radius of start_turn"):
        read_plan("spiral-in", ["disc.radius=9"]).build()
    with pytest.raises(PlanError, match=r"turn\.entry_radius \(5 m\) must not exceed disc\.radius"):
        read_plan("turn", ["turn.entry_radius=5"]).build()


def test_a_spiral_in_ends_at_the_disc_or_the_centre() -> None:
    to_disc = read_plan("spiral-in", ["disc.radius=4.5"]).build().route
    assert math.hypot(*to_disc.end_pose[0]) == pytest.approx(4.5, abs=1e-12)
    to_centre = read_plan("spiral-in").build().route
    assert math.hypot(*to_centre.end_pose[0]) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("clockwise", [True, False])
@pytest.mark.parametrize("inward", [True, False])
def test_a_spiral_part_turns_the_way_it_says(clockwise: bool, inward: bool) -> None:
    radii = (5.0, 3.0) if inward else (3.0, 5.0)
    part = {"kind": "spiral", "pitch": 0.6, "clockwise": clockwise}
    part |= {"start_radius": radii[0], "end_radius": radii[1]}
    curve = checked({"schema": 1, "route": {"part": [part]}}, "x").build().route.curves[0]
    assert (curve.curvature(1.0) < 0.0) == clockwise


def test_parts_are_joined_from_the_start_given() -> None:
    parts = [
        {"kind": "line", "length": "3 m"},
        {"kind": "clothoid", "length": 2, "end_curvature": 0.5},
        {"kind": "arc", "radius": 2, "angle": "90 deg"},
    ]
    route = {"part": parts, "start": [1, 2], "heading": 90}
    walk = checked({"schema": 1, "route": route, "walk": {"position": 1.5}}, "x").build()
    assert [type(curve) for curve in walk.route.curves] == [Line, Clothoid, Arc]
    assert walk.route.point(3.0) == pytest.approx([1.0, 5.0])
    assert walk.start == 1.5


def test_a_profile_replaces_the_speed() -> None:
    walk = read_plan("spiral-in", ["walk.profile=[[0, 1], ['1 min', '7.2 km/h']]"]).build()
    assert walk.profile.speed(60.0) == pytest.approx(2.0)
    with pytest.raises(PlanError, match="the times of a speed profile must increase"):
        read_plan("spiral-in", ["walk.profile=[[0, 1], [0, 2]]"]).build()


def test_own_benches_are_counted() -> None:
    data = {
        "schema": 1,
        "route": ROUTE,
        "dragon": {"bench": [{"length": 3}, {"length": 2, "count": 4}]},
    }
    dragon = checked(data, "x").build().dragon
    assert dragon.length.tolist() == [3, 2, 2, 2, 2]
    data["dragon"] = {"bench": [{"length": 3, "count": 1_000_000}, {"length": 2}]}
    with pytest.raises(PlanError, match="a dragon has 1 to 1000000 benches, not 1000001"):
        checked(data, "x").build()


def test_titles_do_not_change_a_plans_name_but_values_do() -> None:
    plain = read_plan("spiral-in")
    assert read_plan("spiral-in", ['meta.title="Other"']).sha256 == plain.sha256
    assert read_plan("spiral-in", ["route.pitch=0.55"]).sha256 == plain.sha256
    assert read_plan("spiral-in", ["route.at=[0, 0]", "route.turned=0"]).sha256 == plain.sha256
    assert read_plan("spiral-in", ["route.pitch=0.5500001"]).sha256 != plain.sha256


def test_a_title_falls_back_to_the_other_language() -> None:
    plan = read_plan("spiral-in", ['meta.title_zh=""'])
    assert plan.title("zh") == plan.title("en") == "Coiling in"
    assert read_plan("spiral-in").title("zh") == "盘入"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"schema = 1\nroute = [", "is not TOML: at its end: a value is expected here"),
        (b"\xff\xfe\x00", "is not UTF-8 text: save it again with the encoding UTF-8"),
        (b"schema = 1", "route is missing"),
        (b"schema = 1\n[route]\npitch = 1", "route: expected a table with the key kind"),
    ],
)
def test_a_file_that_is_no_plan_is_told_why(tmp_path: Path, content: bytes, sentence: str) -> None:
    path = tmp_path / "x.dragon.toml"
    path.write_bytes(content)
    with pytest.raises(PlanError) as caught:
        read_plan(str(path))
    assert sentence in str(caught.value)


def test_a_missing_plan_names_the_nearest_built_in() -> None:
    with pytest.raises(PlanError, match=r"there is no plan spiral-on: .*did you mean spiral-in\?"):
        read_plan("spiral-on")


def test_the_schema_accepts_the_built_in_plans_and_refuses_others() -> None:
    schema = Plan.model_json_schema()
    for name in built_in_names():
        jsonschema.validate(read_toml(name)[0], schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(read_toml("turn", ["dragon.benches=-1"])[0], schema)


def test_a_plan_without_its_square_is_the_plan_before_it_had_one() -> None:
    plain = read_plan("turn", ["limits.margin=0.1"])
    square = ["venue.rectangle=[60, 50]", "limits.venue_margin=0.5"]
    well = 'obstacle=[{kind="circle", centre=[9, 9], radius=1}]'
    plan = read_plan("turn", ["limits.margin=0.1", *square, well])
    assert [(one.kind, one.margin) for one in plan.obstacles()] == [("venue", 0.5), ("circle", 0.1)]
    assert plan.without_square().sha256 == plain.sha256 != plan.sha256
    assert plan.without_square().obstacles() == ()
    assert read_plan("turn", ["limits.margin=0.1", well]).sha256 != plain.sha256


def test_a_plan_is_named_by_all_that_the_square_does_to_it() -> None:
    said = ["limits.margin=0.05", "venue.rectangle=[60, 60]"]
    plan, bare = read_plan("spiral-in", said), read_plan("spiral-in", [*said, "limits.venue_margin=0"])
    assert [one.obstacles()[0].margin for one in (plan, bare)] == [0.05, 0.0]
    assert plan.sha256 != bare.sha256
    assert read_plan("spiral-in", [*said, "route.at=[0, 0]", "route.turned=0"]).sha256 == plan.sha256
    assert read_plan("spiral-in", [*said, "route.at=[0, 1]"]).sha256 != plan.sha256


@pytest.mark.parametrize("name", [" ", "a\nb", "\u001b[31mred"])
def test_a_name_must_be_seen_on_one_line(name: str) -> None:
    well = {"kind": "circle", "centre": [3, 1], "radius": 0.5, "name": name}
    data = {"schema": 1, "route": {"kind": "turn"}, "obstacle": [well]}
    with pytest.raises(PlanError, match="expected text that can be printed on one line"):
        checked(data, "plan")
