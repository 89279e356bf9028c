"""Routes as a plan says them: the same as stored but for rounding, and without any rounding between."""

from fractions import Fraction

import pytest

pytest.importorskip("flint")
from flint import arb

from benchdragon.analysis.written import assumed_of, number, numbers_of
from benchdragon.errors import InputError
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.proofs.ball_route import BallRoute
from benchdragon.proofs.exact import Numbers
from benchdragon.proofs.parts import as_written, ball
from tests.proofs.certificates import bend

EVERY_PART = """schema = 1
[dragon]
benches = 3
[route]
start = [1.3, -0.7]
heading = 33.3
at = [2.1, 5.7]
turned = -71.7
[[route.part]]
kind = "line"
length = 12.3
[[route.part]]
kind = "clothoid"
length = 9.1
end_curvature = 0.9
[[route.part]]
kind = "arc"
radius = 1.7
angle = -123.4
[[route.part]]
kind = "log-spiral"
length = 3.3
start_curvature = 0.3
end_curvature = 0.1
[[route.part]]
kind = "spiral"
pitch = 0.7
start_radius = 2.3
end_radius = 9.1
clockwise = false
"""
SPIRAL_FIRST = """schema = 1
[route]
heading = 10.1
start = [0.3, 0.1]
[[route.part]]
kind = "spiral"
pitch = 0.7
start_radius = 9.3
end_radius = 4.1
[[route.part]]
kind = "arc"
radius = 3.3
angle = 77.7
"""
OWN = {
    "coiling in": ("spiral-in", ["disc.radius=4.3", "route.clockwise=false", "route.turned=33.3"]),
    "the contest's turn": ("turn", []),
    "joints apart": ("turn", ["turn.exit_radius=4.4", "turn.ratio=1.7", "route.at=[1.1, 2.3]"]),
    "a line between": ("turn", ["turn.family=arc-line-arc", "turn.radii=[1.9,2.1]"]),
}


def read(name: str, folder: object) -> Plan:
    if name in OWN:
        return read_plan(*OWN[name])
    path = folder / "plan.dragon.toml"  # type: ignore[operator]
    path.write_text({"every part": EVERY_PART, "a spiral first": SPIRAL_FIRST}[name], "utf-8")
    return read_plan(str(path))


@pytest.mark.parametrize("name", [*OWN, "every part", "a spiral first"])
def test_a_route_as_written_is_the_stored_one_but_for_rounding(name: str, tmp_path: object) -> None:
    plan = read(name, tmp_path)
    walk = plan.build()
    numbers, stored = numbers_of(plan, walk), BallRoute.stored(walk.route.rows)
    assert "as they are written, and so is what follows" in assumed_of(plan, walk)
    assert len(numbers.route.rows) == len(stored.rows)
    for one, other in zip(numbers.route.rows, stored.rows, strict=True):
        for key in ("p", "q", "start", "s"):
            assert abs(float(getattr(one, key) - getattr(other, key))) < 1e-10
        for share in (0.0, 0.4, 1.0):
            u = [row.start + share * (row.end - row.start) for row in (one, other)]
            for a, b in zip(one.pose(u[0]), other.pose(u[1]), strict=True):
                assert abs(float(a - b)) < 1e-10
            assert max(float(value.rad()) for value in one.pose(u[0])) < 1e-28
    assert abs(float(numbers.start) - walk.start) < 1e-12


def test_pi_is_pi_and_decimals_are_decimals() -> None:
    plan = read_plan("spiral-in")
    numbers = numbers_of(plan, plan.build())
    (row,) = numbers.route.rows
    assert (row.p * 2 * arb.pi()).overlaps(ball(Fraction(11, 20)))
    assert not (row.p * 2 * arb.pi()).overlaps(arb(0.55))
    assert row.start.overlaps(32 * arb.pi())
    assert numbers.sizes.links[1].overlaps(ball(Fraction(33, 20)))
    assert not Numbers.stored(plan.build()).sizes.links[1].overlaps(ball(Fraction(33, 20)))


def test_the_contests_turn_meets_the_second_spiral_where_it_lies() -> None:
    plan = read_plan("turn")
    rows = numbers_of(plan, plan.build()).route.rows
    assert max(abs(rows[-1].x), abs(rows[-1].y)) < 1e-30
    assert abs(rows[1].s - 100) < 1e-30
    stored = BallRoute.stored(plan.build().route.rows).rows
    assert max(abs(stored[-1].x), abs(stored[-1].y)) > 1e-18


@pytest.mark.parametrize(("setting", "value"), [("walk.position=0.1", "0.1"), ("walk.start=0.3", "0")])
def test_places_and_times_are_as_written(setting: str, value: str) -> None:
    plan = read_plan("spiral-in", ["walk.speed=0.7", setting])
    numbers = numbers_of(plan, plan.build())
    wanted = Fraction(value) + Fraction("0.7") * Fraction("12.3")
    assert numbers.position(12.3).overlaps(ball(wanted))
    assert not numbers.position(12.3).overlaps(ball(Fraction(value) + Fraction(0.7) * Fraction(12.3)))


def test_rectangles_are_computed_from_what_is_written() -> None:
    post = {"kind": "rectangle", "name": "stage", "centre": [0.3, 0.1], "size": [0.7, 0.2], "angle": 30}
    plan = bend().with_values({"obstacle": [post], "venue": {"rectangle": [90.1, 80.3]}})
    dance = numbers_of(plan, plan.build()).dance(None, plan.obstacles())
    edge, stage = dance.standing
    assert edge.sides[0].start[0].overlaps(number(90.1) / 2)
    x = number(0.3) + number(0.35) * number(3).sqrt() / 2 - number(0.05)
    assert stage.sides[0].start[0].overlaps(x)
    for one, obstacle in zip(dance.standing, plan.obstacles(), strict=True):
        for side, corner in zip(one.sides, obstacle.outline.tolist(), strict=True):
            assert [float(v) for v in side.start] == pytest.approx(corner)


@pytest.mark.parametrize(
    "settings", [["turn.ease=0.3"], ["turn.family=arc-line-arc"], ["turn.family=arc-arc-arc"]]
)
def test_a_route_that_is_searched_for_counts_as_stored_and_says_so(settings: list[str]) -> None:
    plan = read_plan("turn", settings)
    walk = plan.build()
    assert "as they were computed and stored" in assumed_of(plan, walk)
    rows, stored = numbers_of(plan, walk).route.rows, BallRoute.stored(walk.route.rows).rows
    assert all(one.p == other.p for one, other in zip(rows, stored, strict=True))


def test_a_number_that_was_rounded_is_not_proved() -> None:
    plan = read_plan("spiral-in", ["route.pitch=0.55000000000000000001"])
    with pytest.raises(InputError, match=r"'0.55000000000000000001' was rounded to 0.55"):
        numbers_of(plan, plan.build())


def test_the_shortest_decimal_of_a_double_is_what_was_written() -> None:
    for text in ("0.55", "0.1", "412.4738376821147", "1e-07", "123456.789012345"):
        assert as_written(float(text)) == Fraction(text)
