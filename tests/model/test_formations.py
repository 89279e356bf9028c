"""Formations: the figures that their names promise, of any sizes, moved and turned as one."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchdragon.errors import InputError
from benchdragon.i18n import LANGUAGES, _, spoken_in
from benchdragon.kernels.connections import crossings
from benchdragon.model.curves import JOINT_GAP, JOINT_KINK, Arc, Line, Route
from benchdragon.model.formations import (
    FORMATIONS,
    CoilIn,
    CoilOut,
    DoubleDoor,
    FigureEight,
    Formation,
    StraightDragon,
    TailSwing,
    ThreePlumBlossoms,
    formation,
    least_radius,
)
from benchdragon.plans.formations import FormationTable
from benchdragon.plans.idle import FORMATION_SIZES

NAMES = list(FORMATIONS)


@st.composite
def formations(draw: st.DrawFn) -> Formation:
    """A formation of sizes that village squares and fields hold."""
    kind = FORMATIONS[draw(st.sampled_from(NAMES))]
    sizes: dict[str, Any] = {
        "pitch": draw(st.floats(0.3, 2.0)), "outer_radius": draw(st.floats(6.0, 30.0)),
        "inner_radius": draw(st.floats(0.8, 5.0)), "between": draw(st.floats(0.0, 20.0)),
        "radius": draw(st.floats(3.0, 40.0)), "waist": draw(st.floats(6.5, 20.0)),
        "rounds": draw(st.integers(1, 4)), "length": draw(st.floats(5.0, 500.0)),
        "swing": draw(st.floats(0.5, 5.5)), "swings": draw(st.integers(1, 9)),
        "run": draw(st.sampled_from([0.0, 1.0, 80.0])), "clockwise": draw(st.booleans()),
    }  # fmt: skip
    return kind(**{name: sizes[name] for name in kind.defaults()})


def points(route: Route, count: int = 4000) -> np.ndarray[Any, Any]:
    return route.point(np.linspace(0.0, route.length, count))


@given(formations())
def test_the_curves_of_a_formation_meet_without_a_kink_and_its_length_is_their_sum(
    one: Formation,
) -> None:
    route = one.build()
    for before, after in zip(route.curves[:-1], route.curves[1:], strict=True):
        (point, heading), (next_point, next_heading) = before.end_pose, after.start_pose
        assert math.dist(point, next_point) < JOINT_GAP
        assert abs(math.remainder(next_heading - heading, 2.0 * math.pi)) < JOINT_KINK
    assert route.length == pytest.approx(sum(curve.length for curve in route), rel=1e-12)
    # Chords of half a metre at most: on the tightest bends they fall short by less than a thousandth.
    steps = np.diff(points(route, max(4000, math.ceil(2.0 * route.length))), axis=0)
    assert np.hypot(*steps.T).sum() == pytest.approx(route.length, rel=1e-3)


@given(formations())
def test_no_bend_is_tighter_than_the_tightest_is_said_to_be(one: Formation) -> None:
    route = one.build()
    bend = np.abs(route.curvature(np.linspace(0.0, route.length, 2000))).max()
    least = one.least_radius
    assert bend <= (1.0 + 1e-9) / least if math.isfinite(least) else bend == 0.0
    assert math.isfinite(least) == bool(one.narrowest)
    if one.narrowest in ("radius", "waist"):
        assert least == pytest.approx(getattr(one, one.narrowest))


@given(formations(), st.floats(-300.0, 300.0), st.floats(-300.0, 300.0), st.floats(-9.0, 9.0))
def test_a_formation_that_is_moved_and_turned_is_the_same(
    one: Formation, x: float, y: float, turned: float
) -> None:
    route = one.build()
    moved = route.moved(turned, (x, y))
    cos, sin = math.cos(turned), math.sin(turned)
    own = points(route, 300)
    expected = own @ np.array([[cos, sin], [-sin, cos]]) + [x, y]
    assert np.abs(points(moved, 300) - expected).max() < 1e-8
    assert moved.length == pytest.approx(route.length, rel=1e-12)


@pytest.mark.parametrize("name", [name for name in NAMES if "clockwise" in FORMATIONS[name].defaults()])
def test_the_other_hand_is_the_mirror_image_and_the_first_bend_turns_as_said(name: str) -> None:
    right, left = (formation(name, clockwise=hand).build() for hand in (True, False))
    assert np.abs(points(right) * [1.0, -1.0] - points(left)).max() < 1e-9
    first = next(curve for curve in right if not isinstance(curve, Line))
    assert first.curvature(0.0) < 0.0


def test_a_coil_out_lies_half_way_between_the_turns_of_a_coil_in() -> None:
    into = CoilIn(1.7, 9.0, 4.0).build()
    out = CoilOut(1.7, 4.0, 9.0, clockwise=False).build().moved(math.pi, (0.0, 0.0))
    radius = np.hypot(*points(into).T)
    assert (radius.max(), radius.min()) == pytest.approx((9.0, 4.0))
    # Half a turn about the centre makes the one the other, walked backwards.
    assert np.abs(points(into)[::-1] + points(out)).max() < 1e-9


@pytest.mark.parametrize("clockwise", [True, False])
def test_the_leaves_of_a_double_door_are_mirror_images(clockwise: bool) -> None:
    door = DoubleDoor(clockwise=clockwise)
    there = points(door.build())
    assert np.abs(there * [-1.0, 1.0] - there[::-1]).max() < 1e-9
    middles = np.abs(there[:, 0]) < 0.5 * door.between
    assert (np.ptp(there[middles, 1]), crossings(there, there)) == (pytest.approx(0.0, abs=1e-9), 0)
    assert np.abs(there[:, 0]).max() == pytest.approx(2 * 9.0 + 0.5 * 2.0, abs=0.5 * door.pitch)


def test_a_figure_of_eight_crosses_itself_once_at_its_centre_at_right_angles() -> None:
    eight = FigureEight(10.0)
    route = eight.build()
    there = points(route, 3970)[1:-1]  # none is the crossing, and the ends do not meet
    assert crossings(there, there) == 2  # each line with the other, and that with it
    passes = route.joints[1] + 10.0, route.joints[3] + 10.0
    assert np.abs(route.point(passes)).max() < 1e-12
    one, other = route.heading(passes)
    assert abs(math.cos(one - other)) < 1e-12
    assert passes[1] - passes[0] == pytest.approx(eight.loop)


def test_rounds_are_walked_on_top_of_one_another() -> None:
    for kind in (FigureEight, ThreePlumBlossoms):
        one, three = kind(rounds=1).build(), kind(rounds=3).build()
        assert three.length == pytest.approx(3.0 * one.length)
        s = np.linspace(0.0, one.length, 500)
        for n in range(3):
            assert np.abs(three.point(s + n * one.length) - one.point(s)).max() < 1e-9


def test_three_plum_blossoms_are_the_same_when_turned_by_a_third_and_do_not_cross_themselves() -> None:
    one = ThreePlumBlossoms(10.0, 4.0)
    route = one.build()
    there = points(route, 3001)
    assert route.length == pytest.approx(4.0 * math.pi * 10.0 + 2.0 * math.pi * 4.0)
    third = route.moved(2.0 * math.pi / 3.0, (0.0, 0.0)).point(np.linspace(0.0, route.length, 3001))
    assert np.abs(np.roll(there[:-1], -2000, axis=0) - third[:-1]).max() < 1e-9
    assert crossings(there, there) == 0


def test_a_tail_swings_as_wide_and_as_often_as_said() -> None:
    one = TailSwing(4.0, 5.0, 7, 20.0)
    route = one.build()
    y = points(route, 20_001)[:, 1]
    assert (y.max(), y.min()) == (pytest.approx(2.0), pytest.approx(-2.0))
    assert (np.diff(np.sign(y)) != 0).sum() == 7
    assert route.start_pose[0][0] == pytest.approx(-route.end_pose[0][0])
    assert [curve.length for curve in route if isinstance(curve, Line)] == [20.0, 20.0]
    assert all(isinstance(curve, Arc) for curve in TailSwing(run=0.0).build())


def test_a_straight_dragon_is_one_line_about_the_origin() -> None:
    (line,) = StraightDragon(60.0).build()
    assert (line.start_pose, line.end_pose) == (((-30.0, 0.0), 0.0), ((30.0, 0.0), 0.0))
    assert least_radius(StraightDragon().build()) == math.inf


@pytest.mark.parametrize(
    ("name", "sizes", "size", "sentence"),
    [
        (
            "coil-in",
            {"pitch": 0.01},
            "pitch",
            "pitch of coil-in must lie in 0.1 .. 100 m, not at 0.01 m",
        ),
        ("coil-in", {"inner_radius": 12.0}, "inner_radius", "must be smaller than outer_radius (12 m)"),
        ("coil-out", {"pitch": 13.0}, "pitch", "pitch of coil-out (13 m) must be smaller than"),
        (
            "double-door",
            {"inner_radius": 10},
            "inner_radius",
            "must be smaller than outer_radius (9 m)",
        ),
        ("tail-swing", {"swing": 10.0}, "swing", "must be smaller than 2 * radius (10 m)"),
        (
            "three-plum-blossoms",
            {"waist": 2},
            "radius",
            "must be smaller than 6.46 * waist (12.9282 m)",
        ),
        ("figure-eight", {"rounds": 1.5}, "rounds", "must be a whole number, not 1.5"),
        ("figure-eight", {"rounds": 21}, "rounds", "must lie in 1 .. 20, not at 21"),
        ("figure-eight", {"radius": math.nan}, "radius", "radius"),
    ],
)
def test_sizes_that_cannot_be_are_refused_by_name(
    name: str, sizes: dict[str, Any], size: str, sentence: str
) -> None:
    with pytest.raises(InputError) as caught:
        formation(name, **sizes)
    assert sentence in str(caught.value)
    assert getattr(caught.value, "size", size) == size


def test_names_and_sizes_that_there_are_not_are_refused_with_those_there_are() -> None:
    with pytest.raises(InputError, match="expected one of coil-in, coil-out, figure-eight"):
        formation("phoenix")
    with pytest.raises(InputError, match="coil-in has no size radius; it has pitch, outer_radius"):
        formation("coil-in", radius=3.0)
    assert formation("figure-eight", radius=7.0) == FigureEight(7.0)


def test_plans_know_the_formations_and_their_sizes() -> None:
    known = {name: set(kind.defaults()) for name, kind in FORMATIONS.items()}
    assert {name: set(sizes) for name, sizes in FORMATION_SIZES.items()} == known
    name = FormationTable.model_fields["name"].annotation
    assert set(name.__args__) == set(known)  # type: ignore[union-attr]
    assert set(FormationTable.model_fields) == {
        "name",
        *(size for own in known.values() for size in own),
    }


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_each_formation_says_what_it_is_and_whose_its_geometry_is(name: str, language: str) -> None:
    kind = FORMATIONS[name]
    with spoken_in(language):
        source, shape = _(kind.source), _(kind.shape)
    own = {"en": "this project's own", "zh": "本项目自定"}[language]
    assert own in source
    assert any(0x4E00 <= ord(sign) <= 0x9FFF for sign in kind.chinese)
    assert kind.pinyin.isalpha() or " " in kind.pinyin
    assert shape != source
    assert set(kind.tightest) <= set(kind.sizes)
    if language == "zh":
        assert (source, shape) != (kind.source, kind.shape)
