"""What Python answers about plans, and what its twin in the page answers, in Node."""

import json
import math
import re
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from benchdragon.errors import BenchDragonError
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan, checked
from tests.engine.recording import MODULE, node

WEB = MODULE.parents[1] / "web"
# What two libms may do to places, m, or of 1.
APART = 1e-11
# What rounding leaves of 0 in a sentence.
ZERO = re.compile(r"(=) -?\d\S*e-1\d\b|(?<==) -0\b")


def asked(script: str, questions: object) -> Any:
    """What a script of this folder answers in Node."""
    program = node()
    assert program is not None
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "questions.json"
        file.write_text(json.dumps(questions), "utf-8")
        path = Path(__file__).with_name(script)
        command = [program, str(path), str(WEB), str(MODULE), str(file)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def tried(make: Any) -> Any:
    """What `make` makes; its error in words."""
    try:
        return make()
    except BenchDragonError as error:
        return {"error": str(error), "kind": type(error).__name__}


def answered(data: dict[str, Any]) -> Any:
    """What Python answers about a plan: see plans.mjs."""
    return tried(lambda: _answer(data))


def _answer(data: dict[str, Any]) -> dict[str, Any]:
    plan = checked(json.loads(json.dumps(data)), "plan")
    written = plan.model_dump(mode="json", by_alias=True, exclude_defaults=True)
    said = {"sha256": plan.sha256, "data": plan.data(), "written": _less(written)}
    return {**said, "walk": tried(lambda: _walked(plan))}


def _less(written: Any) -> Any:
    """Plain data without None."""
    if isinstance(written, dict):
        return {key: _less(value) for key, value in written.items() if value is not None}
    return [_less(value) for value in written] if isinstance(written, list | tuple) else written


def _walked(plan: Plan) -> dict[str, Any]:
    walk = plan.build()
    length = walk.route.length
    return {
        "rows": walk.route.rows.ravel().tolist(),
        "start": walk.start,
        "length": length,
        "places": tried(lambda: _places(walk)),
        "span": tried(lambda: list(plan.span(walk))),
        "boxes": [one.boxes.tolist() for one in plan.obstacles()],
        "times": list(walk.profile.times),
        "speeds": list(walk.profile.speeds),
        "moments": tried(lambda: [[one.time, one.way, one.until] for one in plan.moments()]),
        "ways": tried(lambda: list(plan.ways())),
    }


def _places(walk: Walk) -> list[list[float]]:
    head = walk.start + 0.3 * (walk.route.length - walk.start)
    placed = walk.placement([walk.start, head])
    tables = [placed.s, placed.x, placed.y, placed.speed_ratio]
    return [np.ascontiguousarray(table.T).ravel().tolist() for table in tables]


def difference(one: Any, other: Any, at: str = "") -> str:
    """Where two answers differ first, by more than rounding; "" where they do not."""
    if isinstance(one, dict) and isinstance(other, dict):
        if one.keys() != other.keys():
            return f"{at}: {sorted(one.keys() ^ other.keys())} of {one} and {other}"[:600]
        found = (difference(one[key], other[key], f"{at}.{key}") for key in one)
    elif isinstance(one, list) and isinstance(other, list):
        if len(one) != len(other):
            return f"{at}: {len(one)} and {len(other)} entries"
        found = (difference(a, b, f"{at}.{i}") for i, (a, b) in enumerate(zip(one, other, strict=True)))
    else:
        return "" if same(one, other) else f"{at}: {one!r} and {other!r}"
    return next((text for text in found if text), "")


def same(one: Any, other: Any) -> bool:
    """Whether two values are the same but for rounding; the twin's infinities are null or text."""
    if isinstance(one, float) and other in (None, "Infinity", "-Infinity", "NaN"):
        return not math.isfinite(one)
    if isinstance(one, float) and isinstance(other, str):
        other = float(other)
    if isinstance(one, int | float) and isinstance(other, int | float) and not isinstance(one, bool):
        return abs(one - other) <= APART * max(1.0, abs(one))
    if isinstance(one, str) and isinstance(other, str):
        return ZERO.sub(r"\1 0", one) == ZERO.sub(r"\1 0", other)
    return bool(one == other)
