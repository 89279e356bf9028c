"""Surveyed alignments: small gaps and kinks are absorbed where they are, and the change is told."""

import math
from pathlib import Path

import numpy as np
import pytest

from benchdragon.errors import InputError
from benchdragon.model.curves import Arc, Line, Route
from benchdragon.surveys.alignment import joined_alignment
from benchdragon.surveys.coordinates import Survey
from benchdragon.surveys.fitting import fitted
from benchdragon.surveys.lines import chords
from benchdragon.surveys.reading import read_line
from tests.surveys.drawings import RAILWAY, TRAM, landxml

FAR = (2_712_345.0, 1_234_567.0)


def written(folder: Path, text: str) -> Path:
    path = folder / "alignment.xml"
    path.write_text(text, "utf-8")
    return path


def test_a_sound_alignment_is_read_as_it_is(tmp_path: Path) -> None:
    line, _survey = read_line(written(tmp_path, landxml(RAILWAY, 0.0, 0.0, (0.0, 0.0))), Survey())
    fit = fitted(line, "none", 0.01)
    assert fit.absorbed.joints == 8
    assert math.isclose(fit.route.length, RAILWAY.length, abs_tol=1e-6)
    s = np.linspace(0.0, RAILWAY.length, 200)
    assert np.allclose(fit.route.point(s * (1 - 1e-12)), RAILWAY.point(s), atol=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_millimetres_and_tenths_of_milliradians_are_absorbed_within_the_bound(
    tmp_path: Path, seed: int
) -> None:
    path = written(tmp_path, landxml(TRAM, 2e-3, 2e-4, (0.0, 0.0), seed))
    line, _survey = read_line(path, Survey())
    fit = fitted(line, "none", 0.05)
    assert isinstance(fit.route, Route)  # which takes gaps of 1e-9 m at most
    assert not fit.route.kinks
    told = fit.absorbed
    assert told.adjusted == told.joints == 8
    assert 1e-5 < told.gap < 5e-3
    assert 1e-6 < told.kink < 1e-3
    # Every part is where it was, to what is told, wherever on it one looks; the parts stay in order.
    new = iter(fit.route)
    worst = 0.0
    for old in line.curves:
        pieces = [next(new) for _n in range(max(1, math.ceil(_turn(old) / 1.5)))]
        share = np.linspace(0.0, 1.0, 333)
        for n, piece in enumerate(pieces):
            s = old.length * (n + share) / len(pieces)
            apart = old.point(np.minimum(s, old.length)) - piece.point(share * piece.length)
            worst = max(worst, float(np.hypot(apart[:, 0], apart[:, 1]).max()))
    assert worst <= told.shift <= max(2.0 * worst, 1e-3)
    assert told.shift <= fit.deviation


def _turn(curve: object) -> float:
    assert hasattr(curve, "curvature")
    assert hasattr(curve, "length")
    return float(np.abs(curve.curvature([0.0, curve.length])).max() * curve.length)


def test_nothing_adds_up_along_the_way() -> None:
    # 400 sides of a ring with a kink of 1e-4 rad at each joint, all to the left.
    rng = np.random.default_rng(2)
    angle = 2.0 * math.pi * np.arange(400) / 400
    parts = [
        Arc(
            500.0,
            2.0 * math.pi / 400,
            (500.0 * math.cos(a), 500.0 * math.sin(a)),
            a + 0.5 * math.pi + k,
        )
        for a, k in zip(angle.tolist(), rng.uniform(-1e-4, 1e-4, 400).tolist(), strict=True)
    ]
    curves, told = joined_alignment(parts, closed=True)
    route = Route(curves)
    assert told.joints == told.adjusted == 400
    assert told.shift < 2e-3
    s = np.linspace(0.0, route.length, 5000)
    assert np.abs(np.hypot(*route.point(s).T) - 500.0).max() < 2e-3
    start, end = route.point([0.0, route.length])
    assert np.allclose(start, end, atol=1e-9)


def test_parts_that_meet_stay_as_they_are() -> None:
    parts = (*RAILWAY.curves[:3], *Route.joined(RAILWAY.curves).curves[3:])
    curves, told = joined_alignment(parts)
    assert curves == parts
    assert (told.joints, told.adjusted, told.shift) == (8, 0, 0.0)


def test_what_is_too_far_off_is_named() -> None:
    parts = [Line(10.0), Line(10.0, (10.0, 0.006), 0.0)]
    with pytest.raises(
        InputError, match=r"at \(10, 0\) m two parts .* are 0\.006 m apart, more than the"
    ):
        joined_alignment(parts)
    assert joined_alignment(parts, gap=0.01)[1].adjusted == 1
    parts = [Line(10.0), Line(10.0, (10.0, 0.0), 2e-3)]
    with pytest.raises(
        InputError, match=r"has a kink of 0\.1146 degrees, more than the 0\.0573 degrees"
    ):
        joined_alignment(parts)
    assert joined_alignment(parts, kink=0.01)[1].adjusted == 1


def test_no_digits_are_lost_on_the_map(tmp_path: Path) -> None:
    near, _survey = read_line(written(tmp_path, landxml(RAILWAY, 0.0, 0.0, (0.0, 0.0))), Survey())
    path = written(tmp_path, landxml(RAILWAY, 0.0, 0.0, FAR))
    far, survey = read_line(path, Survey(origin=FAR))
    assert survey.origin == FAR
    assert len(far.curves) == len(near.curves)
    for one, other in zip(far.curves, near.curves, strict=True):
        assert type(one) is type(other)
        # The file itself has nine decimals, of which doubles of 2.7e6 hold nine.
        assert np.allclose(one.start_pose[0], other.start_pose[0], atol=2e-9)
    chosen, survey = read_line(path, Survey())
    assert survey.origin == FAR
    assert chosen.curves == far.curves


def test_a_line_is_no_worse_for_being_long() -> None:
    parts = [Line(1000.0), Line(1000.0, (1000.0, 1e-3), 1e-4)]
    curves, told = joined_alignment(parts)
    assert math.isclose(told.gap, 1e-3, rel_tol=1e-9)
    assert math.isclose(told.kink, 1e-4, rel_tol=1e-9)
    assert told.shift < 0.02
    Route(curves)


def test_parts_without_a_moved_end_are_not_cut() -> None:
    # The first winds round a quarter of a million times; the gap is between two others.
    wound = Arc(2.0, 1.5e6, many=True)
    point, heading = wound.end_pose
    line = Line(10.0, point, heading)
    (x, y), _heading = line.end_pose
    curves, told = joined_alignment([wound, line, Line(10.0, (x + 1e-3, y), heading)])
    assert curves[0] == wound
    assert (len(curves), told.adjusted) == (3, 1)


def test_a_part_that_winds_too_often_to_be_cut_is_refused_before_it_is() -> None:
    wound = Arc(2.0, 1.5e6, many=True)
    (x, y), heading = wound.end_pose
    with pytest.raises(InputError, match=r"part 1 of the drawing winds round 2\.387e\+05 times"):
        joined_alignment([wound, Line(10.0, (x + 1e-3, y), heading)])
    with pytest.raises(InputError, match=r"100000 points at most, not 2\.37\d+e\+12"):
        chords([Arc(2.0, 1.5e6, many=True)], 1e-13)
