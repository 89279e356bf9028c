"""The page's check beside Python's: where answers differ by more than rounding and ties allow."""

import json
import random
import re
from collections.abc import Iterator
from typing import Any

from benchdragon.analysis.check import check
from benchdragon.analysis.records import verdict_of
from benchdragon.i18n import _, spoken_in
from benchdragon.plans.schema import checked
from tests.planner.random_plans import Tables, plan
from tests.planner.twins import WEB, asked, same, tried

# A sentence of a script.
TEXT = re.compile(r'(?<![\w$.])(?:_|N_)\(\s*("(?:[^"\\]|\\.)*")')
# A bound on rounding, m, in English or Chinese.
BOUND = re.compile(r"\d\.\de-\d\d(?= m)")
# How long it took, and how many chains that needed, which another rounding may change.
ASIDE = ("seconds", "evaluations")
# Where a walk comes to the same twice, one of the two is named, and sentences tell of it.
NAMED = (".witness", ".sentence", ".text", ".time", ".benches")


def words() -> dict[str, str]:
    """Chinese for every sentence of the page."""
    scripts = WEB.rglob("*.js")
    texts = {json.loads(text) for script in scripts for text in TEXT.findall(script.read_text("utf-8"))}
    with spoken_in("zh"):
        return {text: _(text) for text in texts}


def limited(seed: int) -> Tables:
    """A random plan with limits of all kinds, and needs of people."""
    data, dice = plan(seed, 0.0), random.Random(1_000_000 + seed)
    limits = data.setdefault("limits", {})
    for name, low, high in (
        ("speed", 0.8, 2.5), ("acceleration", 0.1, 2.0), ("lateral_acceleration", 0.1, 2.0),
        ("total_acceleration", 0.1, 2.0), ("turning_rate", 10.0, 90.0), ("margin", 0.0, 0.3),
    ):  # fmt: skip
        if dice.random() < 0.35:
            limits[name] = dice.uniform(low, high)
    needs = {"ahead": 0.5, "beside": 0.4, "sway": 0.1, "imprecision": 0.05, "most_speed": 1.5}
    if dice.random() < 0.3:
        people = data.setdefault("people", {})
        people |= {name: value for name, value in needs.items() if dice.random() < 0.5}
    return data


def here(data: Tables) -> Any:
    """What Python says of a plan."""
    return tried(lambda: _judged(data))


def _judged(data: Tables) -> dict[str, Any]:
    known = checked(json.loads(json.dumps(data)), "plan")
    return {"verdict": verdict_of(check(known)).model_dump(mode="json")}


def there(plans: list[Tables], *, rounds: int = 1, cancel: int = 0) -> Any:
    """What the page says of plans, and its memory, bytes, after each of `rounds`.

    Each is given up where its progress is told for the time `cancel`, if that is not 0.
    """
    questions = {"plans": plans, "words": words()}
    return asked("check_plans.mjs", {**questions, "rounds": rounds, "cancel": cancel})


def told_alike(one: Any, other: Any) -> bool:
    """Whether two texts differ only in a bound on rounding, which another rounding changes."""
    texts = [text for text in (one, other) if isinstance(text, str)]
    bounds = [[float(bound) for bound in BOUND.findall(text)] for text in texts]
    if len(texts) < 2 or not bounds[0] or len({BOUND.sub("", text) for text in texts}) > 1:
        return False
    return all(0.7 * a <= b <= a / 0.7 for a, b in zip(*bounds, strict=True))


def differences(one: Any, other: Any, at: str = "") -> Iterator[str]:
    """Where two answers differ by more than rounding: paths, and what stands there."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in sorted((one.keys() | other.keys()) - set(ASIDE)):
            yield from differences(one.get(key, "absent"), other.get(key, "absent"), f"{at}.{key}")
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for n, (a, b) in enumerate(zip(one, other, strict=True)):
            yield from differences(a, b, f"{at}.{n}")
    elif not (same(one, other) or told_alike(one, other)):
        yield f"{at}: {one!r} and {other!r}"


def fault(one: Any, other: Any) -> str:
    """What is wrong with a twin's answer; "" if nothing is, or another of equal places is named."""
    found = list(differences(one, other))
    if any(".witness" in path for path in found):
        found = [path for path in found if not any(name in path for name in NAMED)]
    found = [
        path for path in found if not path.startswith(".verdict.peaks.") or apart(one, other, path)
    ]
    return "; ".join(found)[:500]


def apart(one: Any, other: Any, path: str) -> bool:
    """Whether the brackets of a limited quantity, which are wide, have no number in common."""
    n = int(path.split(".")[3])
    a, b = (answer["verdict"]["peaks"][n]["peak"] for answer in (one, other))
    return bool(max(a["lower"], b["lower"]) > min(a["upper"], b["upper"]))
