"""Sizes that no one means are refused at the door, by the key that holds them."""

import re
import warnings
from contextlib import suppress

import numpy as np
import pytest

from benchdragon import Arc, BenchDragonError, InputError, Spiral
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import PlanError

PARADE = "examples/01_parade.dragon.toml"
KEYS = {
    "spiral-in": (
        "route.pitch", "route.start_turn", "disc.radius", "walk.speed", "walk.start", "walk.end",
        "walk.position", "dragon.width", "dragon.head_length", "dragon.body_length",
        "dragon.front_inset", "dragon.rear_inset", "limits.margin",
    ),
    "turn": ("route.pitch", "disc.radius", "turn.ratio", "turn.entry_radius", "turn.ease"),
    PARADE: (
        "route.part.0.length", "route.part.1.radius", "route.part.1.angle", "route.heading",
    ),
}  # fmt: skip
# Where a tiny number does no harm.
HARMLESS = {"walk.start", "walk.end", "walk.position", "route.part.1.angle", "route.heading"}


@pytest.mark.parametrize(("plan", "key"), [(plan, key) for plan in KEYS for key in KEYS[plan]])
@pytest.mark.parametrize("value", ["5e-324", "1e-300", "1e-12", "1e12", "1e300", "-1e300"])
def test_absurd_sizes_are_refused_by_name(plan: str, key: str, value: str) -> None:
    if key in HARMLESS and float(value) in (5e-324, 1e-300, 1e-12):
        try_to_walk(plan, f"{key}={value}")
        return
    with pytest.raises(PlanError) as caught:
        read_plan(plan, [f"{key}={value}"]).build()
    assert re.search(rf"\b{key}: (expected|speed must be at most 100)", str(caught.value))


def try_to_walk(plan: str, setting: str) -> None:
    """Walk, or be told why not; without a warning of NumPy's."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with suppress(BenchDragonError):
            walk = read_plan(plan, [setting, "dragon.benches=3"]).build()
            assert np.isfinite(walk.motion([walk.start]).x).all()


@pytest.mark.parametrize("size", [5e-324, 1e-300, 9e-7])
def test_bends_too_tight_to_be_summed_are_refused_in_python_too(size: float) -> None:
    with pytest.raises(InputError, match=r"radius must be at least 1e-06 m, not"):
        Arc(size, 1.0)
    with pytest.raises(InputError, match=r"pitch must be at least 1e-06 m, not"):
        Spiral(size, 9.0, 1.0)
    with pytest.raises(InputError, match=r"pitch must be at least 1e-06 m, not"):
        Spiral.between(size, 9.0, 1.0)
    assert Arc(1e-6, 1.0).length == 1e-6
