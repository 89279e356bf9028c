"""Plans as strangers send them: sound ones made extreme, broken ones, and what is no plan at all."""

import random
from collections.abc import Iterator
from typing import Any

import tomlkit

from tests.planner.random_plans import Tables, length, part, plan

# What a number may be multiplied by: powers of ten up to these, most often to one of the last.
EXTREMES = 9.0, 2.0, 2.0, 1.0, 0.5
ODD: tuple[Any, ...] = (
    float("nan"), float("inf"), -0.0, 5e-324, 1.7e308, 10**400, -(10**18), "", "0", "1e999",
    "1" * 5_000, "-1 min -5 s", "龙" * 300, True, [], {}, [[]], [[[[1]]]], "\x00", "../x", [0] * 3_000,
)  # fmt: skip
# Powers of ten of the numbers that doubles hold, the least of them with few digits.
POWERS = -323.0, 308.25
# The share of plans that go round and round.
ROUNDS = 0.15
KINDS = ("extreme", "vast", "odd", "cut", "torn", "deep")


def toml(data: Tables) -> str:
    """A plan as the text of a file; keys without a value are left out."""
    return tomlkit.dumps(_said(data))


def _said(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _said(inner) for key, inner in value.items() if inner is not None}
    return [_said(inner) for inner in value if inner is not None] if isinstance(value, list) else value


def _numbers(table: Any) -> Iterator[tuple[Any, Any]]:
    """Where numbers stand: what holds each, and its key there."""
    for key, value in list(table.items() if isinstance(table, dict) else enumerate(table)):
        if isinstance(value, dict | list):
            yield from _numbers(value)
        elif key != "schema" and isinstance(value, int | float) and not isinstance(value, bool):
            yield table, key


def extreme(dice: random.Random, data: Tables) -> None:
    """Multiply some numbers by powers of ten."""
    spots = list(_numbers(data))
    for _n in range(dice.choice([1, 1, 2, 3])):
        table, key = dice.choice(spots)
        power = dice.choice(EXTREMES)
        value = table[key] * 10.0 ** dice.uniform(-power, power) * dice.choice([1, 1, 1, -1])
        table[key] = round(value) if isinstance(table[key], int) and dice.random() < 0.9 else value


def vast(dice: random.Random, data: Tables) -> None:
    """Put any number that a double holds in the place of some numbers."""
    spots = list(_numbers(data))
    for _n in range(dice.choice([1, 1, 2, 5])):
        table, key = dice.choice(spots)
        value = 10.0 ** dice.uniform(*POWERS) * dice.choice([1, 1, 1, -1])
        table[key] = round(value) if isinstance(table[key], int) and dice.random() < 0.5 else value


def odd(dice: random.Random, data: Tables) -> None:
    """Put what nobody means in the place of some numbers."""
    spots = list(_numbers(data))
    for _n in range(dice.choice([1, 2, 5])):
        table, key = dice.choice(spots)
        table[key] = dice.choice(ODD)


def rounds(dice: random.Random) -> Tables:
    """A route that is walked round and round: a circle, a circuit, or parts that lead on and on."""
    count = round(10.0 ** dice.uniform(0.0, 1.3))  # more parts take longer to write than to check
    if dice.random() < 0.4:
        bend = {"kind": "arc", "radius": length(dice, 4.0, 30.0), "angle": 360.0 * count**2}
        return {"kind": "parts", "part": [{"kind": "line", "length": length(dice, 1.0, 20.0)}, bend]}
    half = [{"kind": "line", "length": length(dice, 1.0, 40.0)}]
    half += [{"kind": "arc", "radius": length(dice, 4.0, 15.0), "angle": 180}]
    more = [part(dice) for _n in range(dice.choice([0, 0, 0, 1, 2]))]
    return {"kind": "parts", "part": [*half, *half, *more] * count}


def hostile(seed: int) -> str:
    """The text of the plan file of a seed."""
    dice, round_and_round = random.Random(seed), random.Random(f"rounds {seed}")
    data, kind = plan(seed, 0.05), dice.choices(KINDS, [14, 3, 2, 1, 1, 1])[0]
    if round_and_round.random() < ROUNDS:
        data = {**data, "route": rounds(round_and_round)}
    change = {"extreme": extreme, "vast": vast, "odd": odd}.get(kind)
    if change is not None:
        change(dice, data)
        return toml(data)
    text = toml(data)
    if kind == "cut":
        return text[: dice.randrange(len(text))]
    at = dice.randrange(len(text))
    if kind == "torn":
        return text[:at] + "".join(chr(dice.randrange(1, 0x3000)) for _n in range(9)) + text[at:]
    inner = dice.choice(["[", "{a=", "1", '"']) * 10 ** dice.randrange(2, 6)
    return f"{text}\nx = {dice.choice('[{')}{inner}"
