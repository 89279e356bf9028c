"""The record of a check, beside the plan: papers are made of a plan as it was checked."""

import hashlib
import json
import stat
from dataclasses import asdict
from datetime import date
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from benchdragon.analysis.check import Report, sentence
from benchdragon.errors import InputError, reason
from benchdragon.files import write_whole
from benchdragon.i18n import LANGUAGES, _, spoken_in
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import SUFFIX, built_in_names
from benchdragon.rosters.roster import Roster
from benchdragon.version import __version__

# The name of a record: the plan's name and this. Longer files are refused.
ENDING = ".checked.json"
MOST_BYTES = 100_000


class Record(BaseModel):
    """That a plan was checked and found safe.

    Attributes:
        sha256: of all that papers rest on, see `foundation`.
        date: of the check.
        version: of the program that checked.
        verdict: what it found in a sentence, by language.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
    date: date
    version: str
    verdict: dict[str, str]


def foundation(plan: Plan, roster: Roster) -> str:
    """The hash of all that papers rest on: the dance, titles, people, cues, the list of names."""
    people = {bench: [asdict(one) for one in there] for bench, there in roster.benches.items()}
    said = plan.model_dump(mode="json", by_alias=True, exclude_defaults=True)
    whole = {"plan": plan.sha256, "said": said, "roster": people}
    return hashlib.sha256(json.dumps(whole, sort_keys=True).encode()).hexdigest()


def record_path(plan: str) -> Path:
    """Where the check of a plan file is recorded: beside it.

    Raises:
        InputError: for the name of a built-in plan, beside which nothing can lie.
    """
    if plan in built_in_names():
        raise InputError(
            _(
                "{name} is a built-in plan, and its check cannot be recorded: ask for sheets with "
                "--check, or write it into a file with benchdragon plan {name} -o my.dragon.toml"
            ).format(name=plan)
        )
    path = Path(plan)
    name = path.name.removesuffix(SUFFIX)
    return path.with_name(name.removesuffix(".toml") + ENDING)


def record_check(path: Path | None, report: Report, roster: Roster) -> Record:
    """That a plan was checked, written over an older record; a built-in plan has no path for one.

    Raises:
        InputError: for a plan that is not safe: it is not recorded.
    """
    if not report.safe:
        raise InputError(_("only a plan that is safe is recorded as checked"))
    verdict = {}
    for name in LANGUAGES:
        with spoken_in(name):
            verdict[name] = sentence(report)
    record = Record(
        sha256=foundation(report.plan, roster), date=date.today(), version=__version__, verdict=verdict
    )
    if path is None:
        return record
    text = json.dumps(record.model_dump(mode="json"), ensure_ascii=False, indent=1)
    write_whole(path, text + "\n")
    return record


def read_record(path: Path, plan: Plan, roster: Roster, name: str) -> Record:
    """The record of a plan's check; `name` is what the plan was called.

    Raises:
        InputError: if there is none, and if the plan or its list of names has changed since.
    """
    advice = _("run benchdragon check {plan} --record, or sheets with --check").format(plan=name)
    none = _("{path} is no record of a check: {advice}").format(path=path, advice=advice)
    try:
        if not stat.S_ISREG(path.stat().st_mode):  # a device has no end, a pipe may have no beginning
            raise InputError(none)
        with path.open("rb") as written:
            record = Record.model_validate_json(written.read(MOST_BYTES))
    except FileNotFoundError:
        text = _("{plan} has not been recorded as checked: {advice}")
        raise InputError(text.format(plan=name, advice=advice)) from None
    except OSError as error:
        raise InputError(f"{path}: {reason(error)}") from None
    except ValidationError:
        raise InputError(none) from None
    if record.sha256 != foundation(plan, roster):
        text = _("the plan, or its list of names, has changed since it was checked on {date}: {advice}")
        raise InputError(text.format(date=record.date, advice=advice))
    return record
