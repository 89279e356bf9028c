"""Brute force never beats the search: sampling finds no contact before the first, and one after."""

import math

import numpy as np
import pytest
import shapely

from benchdragon import (
    Arc,
    Clothoid,
    Dragon,
    Line,
    LogSpiral,
    Route,
    SpeedProfile,
    Spiral,
    Walk,
    contact_windows,
    first_contact,
    least_clearance,
)
from benchdragon.analysis.speed import greatest_speed
from benchdragon.kernels.curve import FloatArray
from tests.analysis.test_speed import with_room
from tests.rounding import closing_rate, pair_off

SEEDS = range(40)
# In which benches touch; all of them can be walked to their ends. (Those that cannot: hard_dances.py.)
TOUCHING = {2, 4, 5, 8, 9, 10, *range(12, 23), 24, 28, 29, 31, 33, 35}
# Samples of the walk before the contact, and just around it.
SAMPLES = 200


def random_dragon(rng: np.random.Generator) -> Dragon:
    count = int(rng.integers(5, 61))
    length = rng.uniform(0.8, 2.6, count)
    length[0] *= rng.uniform(1.0, 1.8)
    inset = rng.uniform(0.05, 0.15) * length
    return Dragon.of_sizes(length, rng.uniform(0.15, 0.8), inset, 0.5 * inset)


def random_route(rng: np.random.Generator) -> Route:
    kind = int(rng.integers(4))
    if kind == 0:
        pitch = rng.uniform(0.5, 1.6)
        return Route((Spiral.between(pitch, rng.uniform(5.0, 9.0), rng.uniform(1.5, 3.0)),))
    if kind == 1:  # a hairpin or a loop
        radius = rng.uniform(1.2, 4.0)
        return Route.joined([Line(40.0), Arc(radius, rng.uniform(2.0, 6.0)), Line(40.0)])
    if kind == 2:  # an S
        a, b = rng.uniform(1.5, 4.0, 2)
        arcs = Arc(a, rng.uniform(2.0, 4.5)), Arc(b, -rng.uniform(2.0, 4.5))
        return Route.joined([Line(30.0), *arcs, Line(30.0)])
    turn, bend = rng.uniform(3.0, 7.0), rng.uniform(0.3, 0.7)
    ease = Clothoid(3.0, 0.0, bend), Clothoid(3.0, bend, 0.0)
    return Route.joined([Line(30.0), ease[0], Arc(1.0 / bend, turn), ease[1], Line(30.0)])


def random_walk(seed: int) -> tuple[Walk, float, float, float]:
    """A walk, the times between which it goes, and a margin."""
    rng = np.random.default_rng(seed)
    dragon, route = random_dragon(rng), random_route(rng)
    profile = SpeedProfile.constant(1.0)
    if rng.random() < 0.3:
        profile = SpeedProfile((0.0, 5.0, 10.0, 12.0), (0.5, 1.8, 0.0, 1.0))
    walk = Walk(dragon, route, profile, start=0.0)
    end = profile.time(0.98 * route.length)
    margin = float(rng.choice([0.0, 0.0, 0.05, 0.2]))
    return walk, 0.0, end, margin


def nearest(walk: Walk, times: FloatArray) -> FloatArray:
    """Least distance by shapely at each time, over all pairs but neighbours, m; 0: overlap."""
    motion = walk.motion(times)
    i, j = np.triu_indices(len(walk.dragon), 2)
    least = np.full(len(times), math.inf)
    for t in range(len(times)):
        corners = motion[t].corners()[0]
        benches = np.asarray(shapely.polygons(corners))
        middles = corners.mean(axis=1)
        near = np.hypot(*(middles[i] - middles[j]).T) < 6.0
        if near.any():
            least[t] = shapely.distance(benches[i[near]], benches[j[near]]).min()
    return least


@pytest.mark.parametrize("seed", SEEDS)
def test_sampling_never_finds_a_contact_before_the_first_and_finds_one_after(seed: int) -> None:
    walk, start, end, margin = random_walk(seed)
    found = first_contact(walk, start, end, margin=margin)
    assert (found is not None) == (seed in TOUCHING)
    if found is None:
        assert (nearest(walk, np.linspace(start, end, SAMPLES)) >= margin - 1e-9).all()
        return
    assert found.lower <= found.value <= found.upper
    if found.lower > start:
        assert found.upper - found.lower <= 1e-9
        before = found.lower - np.geomspace(1e-9, found.lower - start, SAMPLES)
        assert (nearest(walk, before) >= margin - 1e-9).all()
    # Right after it they are nearer, unless the walk ends there or they only graze.
    windows = contact_windows(walk, start, min(end, found.upper + 1.0), margin=margin, most=1)
    opens = windows[0].opens  # of a search that leaves nothing out
    assert max(opens.lower, found.lower) <= min(opens.upper, found.upper)
    if found.status == "found":
        assert nearest(walk, np.array([found.upper]))[0] <= max(margin, 1e-12)


@pytest.mark.parametrize("margin", [0.0, 0.1])
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("seed", [1, 2, 5])
def test_sampling_agrees_about_contact_on_a_logarithmic_spiral(
    seed: int, side: float, margin: float
) -> None:
    dragon = random_dragon(np.random.default_rng(seed))
    route = Route.joined([Line(60.0), LogSpiral(90.0, side / 7.0, side / 1.2)])
    walk = Walk(dragon, route, start=60.0)
    found = first_contact(walk, 0.0, 88.0, margin=margin)
    assert (found is None) == (seed == 2 and margin == 0.0)
    if found is None:
        assert (nearest(walk, np.linspace(0.0, 88.0, SAMPLES)) > 0.0).all()
        return
    assert found.witness is not None
    # Benches may close by a millimetre a second only, and distances are known to some 5e-12 m.
    doubt = pair_off(walk, found.witness) / closing_rate(walk, found.witness)
    assert 0.0 < found.lower <= found.value <= found.upper <= found.lower + min(3.0 * doubt, 5e-9)
    before = found.lower - np.geomspace(1e-9, found.lower, SAMPLES)
    assert (nearest(walk, before) >= margin - 1e-9).all()
    assert nearest(walk, np.array([found.upper]))[0] <= max(margin, 1e-12)


@pytest.mark.parametrize("seed", [4, 8, 12, 16, 20, 24, 27, 28, 36])
def test_no_sample_is_below_the_least_clearance(seed: int) -> None:
    walk, start, end, _margin = random_walk(seed)
    found = least_clearance(walk, start, end)
    assert found.lower <= found.value <= found.upper
    sampled = nearest(walk, np.linspace(start, end, SAMPLES))
    assert sampled.min() >= found.lower - 1e-9
    if found.witness is not None and found.value > 0.0:
        assert found.witness.time is not None
        assert nearest(walk, np.array([found.witness.time]))[0] == pytest.approx(found.value, abs=1e-9)


@pytest.mark.parametrize("seed", [1, 5, 9, 13, 17, 21, 25, 33])
def test_windows_are_where_sampling_sees_overlaps(seed: int) -> None:
    walk, start, end, margin = random_walk(seed)
    windows = contact_windows(walk, start, end, margin=margin, most=200)
    times = np.linspace(start, end, SAMPLES)
    inside = np.zeros(len(times), dtype=bool)
    unsure = np.zeros(len(times), dtype=bool)
    for window in windows:
        closes = end if window.closes is None else window.closes.upper
        inside |= (times >= window.opens.upper) & (times <= closes)
        unsure |= np.abs(times - window.opens.value) < 1e-9
        unsure |= np.abs(times - closes) < 1e-9
    seen = nearest(walk, times) < margin if margin > 0.0 else nearest(walk, times) <= 0.0
    assert (seen == inside)[~unsure].all()


@pytest.mark.parametrize("seed", SEEDS)
def test_no_sample_is_above_the_greatest_speed(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    with_room(monkeypatch, CELL_COST=0.0)
    walk, start, end, _margin = random_walk(seed)
    found = greatest_speed(walk, start, end, tolerance=1e-4)
    assert found.value * (1.0 - 1e-11) <= found.lower <= found.value <= found.upper
    sampled = walk.motion(np.linspace(start, end, 20 * SAMPLES), throw=False).speed
    assert np.nanmax(sampled) <= found.upper
    assert found.witness is not None
    assert found.witness.time is not None
    assert walk.motion([found.witness.time]).speed.max() == pytest.approx(found.value, rel=1e-6)
