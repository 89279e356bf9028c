"""The command line that makes a sweep anew, told from what it is."""

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from decimal import Decimal
from typing import Any

from benchdragon.plans.keys import written
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.plans.toml import PlanError, built_in_names
from benchdragon.solve.tolerance import CASES
from benchdragon.sweeps.points import Value, parse_vary
from benchdragon.sweeps.sweep import Sweep

# What a plan file is called where nobody said.
PLAN_FILE, POINTS_FILE = "plan.dragon.toml", "points.csv"
# A plan is told as a built-in one with at most so many other values.
MOST_SETTINGS = 8


def command(sweep: Sweep, output: str) -> str:
    """The command line that makes a sweep.

    A plan that is no built-in one with a few values set is PLAN_FILE; points that are neither a grid
    nor a sample are POINTS_FILE.

    Args:
        sweep: what is to be made.
        output: the folder that it names.
    """
    about = sweep.about
    words = ["benchdragon", "sweep", *(plan_words(sweep.plan) or [PLAN_FILE]), *_points(sweep)]
    words += ["--ask", ",".join(about["ask"])]
    words += _dances(about["dances"], seeded=bool(about["points"]["sample"]))
    if about["refine"]:
        words += ["--refine", str(about["refine"]["most"]), "--to", repr(about["refine"]["to"])]
    return shlex.join([*words, "-o", output])


def _points(sweep: Sweep) -> list[str]:
    """The words that say at which points."""
    points = sweep.about["points"]
    if points["grid"] is not None:
        texts = [vary_text(*one) for one in zip(sweep.keys, points["grid"], strict=True)]
        return [word for text in texts for word in ("--vary", text)]
    drawn = points["sample"]
    if drawn is None:
        return ["--points", POINTS_FILE]
    words = []
    for key, (low, high) in zip(sweep.keys, drawn["ranges"], strict=True):
        words += ["--vary", f"{key}={low!r}:{high!r}"]
    words += ["--sample", str(points["count"]), "--seed", str(drawn["seed"])]
    return [*words, "--method", drawn["method"]]


def _dances(dances: Mapping[str, Any] | None, *, seeded: bool) -> list[str]:
    """The words that say which random dances; their seed is that of the sample, if there is one."""
    if dances is None:
        return []
    words = ["--draws", str(dances["draws"])] + ([] if seeded else ["--seed", str(dances["seed"])])
    if dances["deviations"] != asdict(CASES["all"].deviations):
        words += [
            word for name, size in dances["deviations"].items() if size
            for word in (f"--{name}", repr(size))
        ]  # fmt: skip
    return words


def vary_text(key: str, values: Sequence[Value]) -> str:
    """Values of a key as `parse_vary` takes them: in steps where they are even, else one by one."""
    if len(values) > 2 and not any(isinstance(value, str) for value in values):
        first, second, last = (Decimal(repr(values[n])) for n in (0, 1, -1))
        if first != second:
            text = f"{key}={values[0]!r}:{values[-1]!r}:{second - first}"
            steps = (last - first) / (second - first)
            if steps == len(values) - 1 and _same(parse_vary([text])[key], values):
                return text
    return f"{key}={','.join(map(str, values))}"


def _same(some: Sequence[Value], others: Sequence[Value]) -> bool:
    """Whether values are equal, and of equal types."""
    return list(map(repr, some)) == list(map(repr, others))


def plan_words(plan: Plan) -> list[str] | None:
    """A plan as a command line names it: a built-in one with values set; None for others."""
    found = []
    said = _flat(plan.data())
    for name in built_in_names():
        own = _flat(read_plan(name).data())
        settings = [f"{key}={written(value)}" for key, value in said.items() if own.get(key) != value]
        try:
            same = read_plan(name, settings).sha256 == plan.sha256
        except PlanError:
            continue
        if same and len(settings) <= MOST_SETTINGS:
            found.append([name, *(word for text in settings for word in ("--set", text))])
    return min(found, key=len, default=None)


def _flat(data: Mapping[str, Any]) -> dict[str, Any]:
    """Values by dotted keys; those without effect are left out."""
    return {
        f"{table}.{key}": value
        for table, values in data.items()
        if table not in {"schema", "meta"}
        for key, value in values.items()
    }
