"""Entries of a plan written by hand, which a plan that replaces it would lose."""

import json
from collections.abc import Sequence
from pathlib import Path

import click

from benchdragon.i18n import _

# Of a plan's people, what no question of `new` asks for.
BY_HAND = ("roster", "sheet", "unit", "count_head", "address")


def kept_by_hand(path: Path) -> list[str]:
    """A plan's entries by hand: obstacles, the street, cues, marks, the event, who dances.

    Nothing, where no plan can be read.
    """
    from benchdragon.plans.toml import PlanError, read_toml

    if not path.exists():
        return []
    try:
        data, _source = read_toml(str(path))
    except PlanError:
        return []
    obstacles, people = data.get("obstacle"), data.get("people")
    listed = obstacles if isinstance(obstacles, list) else []
    names = [str(one.get("name", "")) for one in listed if isinstance(one, dict)]
    people = people if isinstance(people, dict) else {}
    found = [f"[[obstacle]] {name}".strip() for name in names]
    route = data.get("route")
    found += ["[route.street]"] if isinstance(route, dict) and "street" in route else []
    found += [f"[{name}]" for name in ("cues", "chalk", "event") if name in data]
    written = {name: json.dumps(people[name], ensure_ascii=False) for name in BY_HAND if name in people}
    return found + [f"people.{name} = {value}" for name, value in written.items()]


def warn_of_lost(before: Sequence[str], path: Path) -> None:
    """Say what stood in the plan before, and does not in that which is there now."""
    lost = [one for one in before if one not in kept_by_hand(path)]
    if lost:
        text = _("WARNING: not in the new plan, as they were in the one it replaces: {what}.")
        click.echo(text.format(what=_(", ").join(lost)), err=True)
