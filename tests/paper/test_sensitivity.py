"""Derivatives of answers by sizes, beside differences of two answers."""

import math
from functools import cache

import numpy as np
import pytest

from benchdragon.analysis.contact import first_contact
from benchdragon.errors import InputError
from benchdragon.model.answer import Answer
from benchdragon.paper.sensitivity import (
    Configuration,
    Drift,
    changed,
    contact_rates,
    drift,
    limit_rates,
    sizes_of,
    speed_rates,
    walking,
)
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit

STEP = 1e-4
CONTACT_KEYS = (
    "route.pitch", "dragon.width", "dragon.head_length", "dragon.body_length", "dragon.tail_length",
    "dragon.front_inset", "dragon.rear_inset",
)  # fmt: skip


def spiral() -> Plan:
    return read_plan("spiral-in")


def disc() -> Plan:
    return read_plan("spiral-in", ["disc.radius=4.5"])


@cache
def contact() -> Answer:
    walk = spiral().build()
    found = first_contact(walk, *spiral().span(walk))
    assert found is not None
    return found


def difference(plan: Plan, key: str, answer: object, step: float = STEP) -> float:
    low, high = (answer(plan.with_value(key, plan.value(key) + side * step)) for side in (-1, 1))  # type: ignore[operator]
    return float(high - low) / (2.0 * step)


def contact_time(plan: Plan) -> float:
    walk = plan.build()
    found = first_contact(walk, *plan.span(walk))
    assert found is not None
    return found.value


def test_first_contact_moves_with_every_size_as_differences_say() -> None:
    rates = contact_rates(spiral(), contact())
    assert tuple(rates) == CONTACT_KEYS
    for key, rate in rates.items():
        assert rate == pytest.approx(difference(spiral(), key, contact_time), rel=1e-5, abs=1e-6), key
    assert abs(rates["dragon.tail_length"]) < 1e-9
    assert rates["route.pitch"] > 900.0  # a centimetre more of pitch gives nine seconds


def test_the_smallest_pitch_moves_with_every_size_as_differences_say() -> None:
    rates = limit_rates(disc(), "pitch", limit(disc(), "pitch"))
    assert "route.pitch" not in rates
    for key, rate in rates.items():
        found = difference(disc(), key, lambda plan: limit(plan, "pitch").value)
        assert rate == pytest.approx(found, rel=1e-6, abs=1e-8), key
    assert abs(rates["disc.radius"]) < 1e-9  # the touch comes before the disc
    assert 0.9 < rates["dragon.width"] < 1.0


def test_the_widest_bench_moves_with_the_pitch_as_the_pitch_with_the_width() -> None:
    at = disc().with_value("route.pitch", limit(disc(), "pitch").value + 0.02)
    wide = limit(at, "width")
    rates = limit_rates(at, "width", wide)
    found = difference(at, "route.pitch", lambda plan: limit(plan, "width").value)
    assert rates["route.pitch"] == pytest.approx(found, rel=1e-6)


def test_the_greatest_head_speed_moves_with_every_size_as_differences_say() -> None:
    plan = read_plan("turn", ["dragon.benches=12"])

    def speed(changed_plan: Plan) -> float:
        return greatest_head_speed(changed_plan, tolerance=1e-11).value

    rates = speed_rates(plan, greatest_head_speed(plan, tolerance=1e-12))
    assert {"route.pitch", "disc.radius", "turn.ratio", "dragon.head_length"} < set(rates)
    for key, rate in rates.items():
        assert rate == pytest.approx(difference(plan, key, speed), rel=1e-5, abs=1e-7), key


def test_walking_is_the_change_whose_rates_are_the_speed_ratios() -> None:
    motion = spiral().build().motion([300.0])
    configuration = Configuration.of(motion)
    change = changed(configuration, walking(configuration))
    assert change.along == pytest.approx(motion.speed_ratio[0], abs=1e-12)
    assert change.turn == pytest.approx(motion.turning_rate[0], abs=1e-12)


def test_a_longer_link_moves_the_handles_behind_it_and_none_before() -> None:
    walk = spiral().build()
    configuration = Configuration.of(walk.motion([300.0]))
    sizes = np.zeros((4, 223))
    sizes[0, 100] = 1.0
    along = changed(configuration, Drift(np.zeros((224, 2)), np.zeros(224), sizes)).along
    assert not along[:101].any()
    assert (along[101:] < -0.9).all()


def test_the_route_s_own_change_is_that_of_the_closed_form() -> None:
    """On r = k theta: dP/dk = (theta + k (1 + i theta) dtheta/dk) e^(i theta), at a fixed way s."""
    motion = spiral().build().motion([300.0])
    found = drift(spiral(), ("route.pitch",), motion)
    k, s = 0.55 / (2.0 * math.pi), motion.s[0]
    theta = motion.state(0)[1]
    swing = s / (k * k * np.sqrt(1.0 + theta * theta))
    # The spiral is walked inwards, clockwise: theta falls as s grows, and x + iy = k theta e^(i theta).
    exact = np.exp(1j * theta) * (theta + k * (1.0 + 1j * theta) * swing) / (2.0 * math.pi)
    scale = np.abs(exact).max()
    assert found.point[:, 0] + 1j * found.point[:, 1] == pytest.approx(exact, abs=1e-9 * scale)


def test_what_has_no_derivative_is_refused() -> None:
    answer = contact()
    with pytest.raises(InputError, match="without a witness"):
        contact_rates(spiral(), Answer(1.0, 1.0, 1.0, "s", "found"))
    assert answer.witness is not None
    features = ((1, "front left"), (9, "front left"))
    corners = type(answer.witness)(
        answer.witness.time, answer.witness.s, (1, 9), (0.0, 0.0), 0.0, features
    )
    with pytest.raises(InputError, match="corner with a side"):
        contact_rates(spiral(), Answer(1.0, 1.0, 1.0, "s", "found", corners))


def test_a_pair_that_meets_where_the_walk_ends_is_refused() -> None:
    plan = read_plan("spiral-in", ["walk.end=412.46"])
    wide = limit(plan, "width")  # the last moment is the tightest: distances still fall there
    with pytest.raises(InputError, match="smooth minimum"):
        limit_rates(plan, "width", wide)


def test_only_sizes_that_play_a_part_are_asked_about() -> None:
    assert "disc.radius" not in sizes_of(spiral())
    assert "turn.ratio" in sizes_of(read_plan("turn"))
    assert "turn.ratio" not in sizes_of(
        read_plan("turn", ["turn.family=arc-line-arc", "turn.radii=[2, 2]"])
    )
    assert sizes_of(read_plan("examples/04_own_benches.dragon.toml")) == []
