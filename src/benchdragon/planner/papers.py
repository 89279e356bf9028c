"""The papers of a plan as one page: the planner opened on them, with plan and list of names in it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from benchdragon.files import write_whole
from benchdragon.planner.messages import Bearer, NamesHeld, WantedPapers
from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import Plan
from benchdragon.rosters.roster import Person, Roster

# Those of web/sheets.js.
PAPERS = ("benches", "overview", "timetable", "chalk", "annex")


def wanted_papers(names: Sequence[str], roster: Roster, options: Mapping[str, Any]) -> WantedPapers:
    """Papers by the options of `benchdragon sheets`; without `phones` they hold no phone number."""
    phones = bool(options["phones"])
    people = [
        (bench, [Bearer.model_validate(one if phones else _without_phones(one)) for one in there])
        for bench, there in sorted(roster.benches.items())
    ]
    held = NamesHeld(people=people, notes=list(roster.notes)) if people or roster.notes else None
    return WantedPapers(
        only=[] if len(names) == len(PAPERS) else list(names), paper=options["paper"].lower(),
        households=options["by"] == "household", night=options["night"], phones=phones, names=held,
    )  # fmt: skip


def _without_phones(person: Person) -> Person:
    return replace(person, phone="", home_phone="")


def write_papers(path: Path, plan: Plan, wanted: WantedPapers) -> None:
    """Write a page that opens on papers of a plan, whole or not at all, in the language in use."""
    write_whole(path, planner_page(plan, papers=wanted))
