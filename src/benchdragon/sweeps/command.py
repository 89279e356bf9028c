"""The command line that makes a sweep again, derived from its record."""

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from decimal import Decimal
from typing import Any

from benchdragon.errors import InputError, of_kind
from benchdragon.i18n import _
from benchdragon.plans.keys import written
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.plans.toml import PlanError, built_in_names
from benchdragon.plans.units import RANGE
from benchdragon.solve.tolerance import CASES
from benchdragon.sweeps.points import Value, parse_vary
from benchdragon.sweeps.sweep import Sweep

# The default name of a plan file.
PLAN_FILE, POINTS_FILE = "plan.dragon.toml", "points.parquet"
# A plan is written as a built-in one with at most so many other values.
MOST_SETTINGS = 8
# The largest seed that --seed takes.
MOST_SEED = 2**31


def sweep_command(sweep: Sweep, output: str = "rows") -> str:
    """The command line that makes a sweep; a sentence where none can say it.

    A plan that is no built-in one with a few values set is PLAN_FILE; points that are neither a grid
    nor a sample are POINTS_FILE.

    Args:
        sweep: what is to be made.
        output: the folder that it names.

    Raises:
        InputError: if `sweep` is no Sweep, or `output` no text.

    Examples:
        >>> plan = bd.read_plan("spiral-in")
        >>> found = bd.sweep(plan, {"route.pitch": [0.5, 0.6]}, executor=threads)
        >>> bd.sweep_command(found)
        'benchdragon sweep spiral-in --vary route.pitch=0.5,0.6 --ask first_contact -o rows'
    """
    of_kind("sweep", sweep, Sweep)
    of_kind("output", output, str)
    reason = unsaid(sweep)
    if reason is not None:
        return reason
    about = sweep.about
    words = ["benchdragon", "sweep", *(plan_words(sweep.plan) or [PLAN_FILE]), *_points(sweep)]
    words += ["--ask", ",".join(about["ask"])]
    words += _dances(about["dances"], seeded=bool(about["points"]["sample"]))
    if about["refine"]:
        words += ["--refine", str(about["refine"]["most"]), "--to", repr(about["refine"]["to"])]
    return shlex.join([*words, "-o", output])


def unsaid(sweep: Sweep) -> str | None:
    """Why no command line makes a sweep, as a sentence; None if one does."""
    about = sweep.about
    drawn, dances = about["points"]["sample"], about["dances"]
    seeds = [one["seed"] for one in (drawn, dances) if one]
    if len(set(seeds)) > 1:
        return _(
            "No command line makes this sweep: its points have the seed {one}, its random dances "
            "{other}, and --seed is for both."
        ).format(one=seeds[0], other=seeds[1])
    if seeds and seeds[0] > MOST_SEED:
        text = _("No command line makes this sweep: --seed is at most {most}, not {seed}.")
        return text.format(most=MOST_SEED, seed=seeds[0])
    for key, values in zip(sweep.keys, about["points"]["grid"] or (), strict=False):
        if not _readable(key, values):
            text = _("No command line makes this sweep: --vary cannot say the values of {key}.")
            return text.format(key=key)
    return None


def _readable(key: str, values: Sequence[Value]) -> bool:
    """Whether `parse_vary` finds these values in their text; "a,b", say, it takes for two."""
    try:
        return _same(parse_vary([vary_text(key, values)])[key], values)
    except InputError:
        return False


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
        words += ["--vary", f"{key}={low!r}{RANGE}{high!r}"]
    words += ["--sample", str(points["count"]), "--seed", str(drawn["seed"])]
    return [*words, "--method", drawn["method"]]


def _dances(dances: Mapping[str, Any] | None, *, seeded: bool) -> list[str]:
    """The words that say which random dances; their seed is that of the sample, if there is one."""
    if dances is None:
        return []
    words = ["--draws", str(dances["draws"])] + ([] if seeded else ["--seed", str(dances["seed"])])
    if dances["deviations"] != asdict(CASES["all"].deviations):  # which are those that none means
        sizes = {name: size for name, size in dances["deviations"].items() if size} or {"aside": 0.0}
        words += [word for name, size in sizes.items() for word in (f"--{name}", repr(size))]
    return words


def vary_text(key: str, values: Sequence[Value]) -> str:
    """Values of a key as `parse_vary` takes them: in steps where they are even, else one by one."""
    if len(values) > 2 and not any(isinstance(value, str) for value in values):
        first, second, last = (Decimal(repr(values[n])) for n in (0, 1, -1))
        if first != second:
            text = RANGE.join((f"{key}={values[0]!r}", repr(values[-1]), str(second - first)))
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
    """Values by dotted keys, lists of tables as they are; those without effect are left out."""
    flat: dict[str, Any] = {}
    for table, values in data.items():
        if isinstance(values, dict) and table != "meta":
            flat |= {f"{table}.{key}": value for key, value in values.items()}
        elif isinstance(values, list) and values:
            flat[table] = values
    return flat
