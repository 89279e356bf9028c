"""Certificates: a plan, what was proved of it, and the cells that show it; and their verification.

Whoever verifies one need not believe the search: from the plan alone the dragon is placed in ball
arithmetic at the ends of each cell, and each is shown to hold (proofs/cells.py). Nothing that is
written in a certificate is believed but where the cells begin and end.
"""

import stat
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from benchdragon import budget
from benchdragon.analysis.check import Report
from benchdragon.analysis.proof import Claim, Question, require_flint
from benchdragon.errors import InputError, UnsureError, reason
from benchdragon.i18n import _
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan, checked
from benchdragon.progress import Progress, silent
from benchdragon.proofs import MOST_CELLS
from benchdragon.version import __version__

# A file that is larger is none of ours, bytes: cells of 20 characters each.
MOST_BYTES = 64_000_000

Number = Annotated[float, Field(allow_inf_nan=False)]


class ClaimRecord(BaseModel):
    """A `Claim` as it is written."""

    model_config = ConfigDict(extra="forbid", strict=True)

    about: str = Field(max_length=1000)
    cells: list[Number] = Field(min_length=1, max_length=MOST_CELLS)
    start: Number
    clear: Number
    contact: Number | None = None
    s: Number | None = None
    benches: list[int] = Field(default=[], max_length=2)


class Certificate(BaseModel):
    """A certificate as it is written."""

    model_config = ConfigDict(extra="forbid", strict=True)

    format: Literal["benchdragon certificate"] = "benchdragon certificate"
    version: str = Field(max_length=100)
    plan: dict[str, Any]
    plan_sha256: str = Field(max_length=64)
    claims: list[ClaimRecord] = Field(min_length=1, max_length=1000)


def certificate_of(report: Report) -> Certificate:
    """What was proved of a plan, to be written.

    Raises:
        InputError: if nothing was.
    """
    if not report.claims:
        raise InputError(_("nothing was proved, so that there is no certificate"))
    plan, claims = report.plan, [ClaimRecord(**_written(claim)) for claim in report.claims]
    return Certificate(version=__version__, plan=plan.data(), plan_sha256=plan.sha256, claims=claims)


def _written(claim: Claim) -> dict[str, Any]:
    return asdict(claim) | {"cells": list(claim.cells), "benches": list(claim.benches)}


def read_certificate(path: Path) -> Certificate:
    """Read a certificate.

    Raises:
        InputError: for a file that cannot be read, or is none.
    """
    name = str(path).encode("utf-8", "backslashreplace").decode()  # names may hold lone surrogates
    try:
        about = path.stat()
        if not stat.S_ISREG(about.st_mode):  # a device has no end, a pipe may have no beginning
            raise InputError(_("{path} is no file that could be a certificate").format(path=name))
        if about.st_size > MOST_BYTES:
            raise InputError(
                _("{path} is larger than any certificate, {most} MB").format(
                    path=name, most=MOST_BYTES // 1_000_000
                )
            )
        return Certificate.model_validate_json(path.read_bytes())
    except OSError as error:
        raise InputError(f"{name}: {reason(error)}") from None
    except UnicodeEncodeError as error:  # a name that no system has
        raise InputError(_("{path} cannot be read: {why}").format(path=name, why=error)) from None
    except ValidationError as error:
        where = ".".join(str(part) for part in error.errors()[0]["loc"])
        raise InputError(
            _("{path} is no certificate that benchdragon writes: see {where}").format(
                path=name, where=where or "JSON"
            )
        ) from None


@budget.question()
def verify(certificate: Certificate, progress: Progress = silent) -> list[str]:
    """Show every claim of a certificate again; sentences about what then is proved.

    Raises:
        InputError, PlanError: for a plan that is none, or another than its hash says.
        MissingExtraError: without python-flint.
        UnsureError: naming the claim that does not hold, and why.
        WalkError: if the dragon cannot stand where a cell ends.
    """
    require_flint()
    plan = checked(certificate.plan, _("the certificate"))
    if plan.sha256 != certificate.plan_sha256:
        raise InputError(_("the plan in the certificate is not the one that it was written for"))
    walk = plan.build()
    for record in certificate.claims:
        lists = {"cells": tuple(record.cells), "benches": tuple(record.benches)}
        claim = Claim(**record.model_dump() | lists)
        try:
            _question(plan, walk, claim).verify(claim, progress)
        except UnsureError as error:
            about = claim.about or _("benches")
            raise UnsureError(_("{about}: {error}").format(about=about, error=error)) from None
    told = [_sentence(plan, record) for record in certificate.claims]
    return told + _left_out(plan, walk, certificate)


def _question(plan: Plan, walk: Walk, claim: Claim) -> Question:
    if not claim.about:
        _check_benches(claim, len(walk.dragon), 2)
        return Question(walk, plan.limits.margin, None)
    _check_benches(claim, len(walk.dragon), 1)
    for obstacle in plan.obstacles():
        if obstacle.name == claim.about:
            return Question(walk, None, obstacle)
    raise InputError(_("the plan has no obstacle {name}").format(name=repr(claim.about)))


def _check_benches(claim: Claim, count: int, wanted: int) -> None:
    """Refuse benches that are not there, or neighbours, which may touch."""
    benches = claim.benches
    if claim.contact is None and claim.s is None and not benches:
        return
    there = len(benches) == wanted and all(0 <= n < count for n in benches)
    if not (there and claim.contact is not None and claim.s is not None):
        raise InputError(_("a contact in the certificate names no benches of this dragon"))
    if wanted == 2 and abs(benches[0] - benches[1]) < 2:
        raise InputError(_("a contact in the certificate names benches that are joined"))


def _sentence(plan: Plan, claim: ClaimRecord) -> str:
    """What a claim says, once it is shown; its times with all digits, as none may be rounded."""
    span = {"start": repr(claim.start), "clear": repr(claim.clear)}
    margin = repr(plan.limits.margin).removesuffix(".0")  # with all digits, as the times
    if claim.contact is not None and claim.clear <= claim.start:
        return _at_start(claim, margin)
    if claim.about:
        text = _("proved: free of contact with {about} from t = {start} s to t = {clear} s").format(
            about=claim.about, **span
        )
    else:
        text = _(
            "proved: no two non-adjacent benches nearer than {margin} m from t = {start} s to "
            "t = {clear} s"
        ).format(margin=margin, **span)
    if claim.contact is None:
        return text
    return text + _("; nearer by t = {contact} s: {benches}").format(
        contact=repr(claim.contact), benches=_numbers(claim)
    )


def _at_start(claim: ClaimRecord, margin: str) -> str:
    """What a claim says that shows nothing but a contact at its start."""
    named = {"contact": repr(claim.contact), "benches": _numbers(claim)}
    if claim.about:
        text = _("proved: too near to {about} by t = {contact} s: {benches}")
        return text.format(about=claim.about, **named)
    text = _("proved: benches nearer than {margin} m by t = {contact} s: {benches}")
    return text.format(margin=margin, **named)


def _numbers(claim: ClaimRecord) -> str:
    return " ".join(str(n + 1) for n in claim.benches)


def _left_out(plan: Plan, walk: Walk, certificate: Certificate) -> list[str]:
    """What the certificate says nothing about: benches, obstacles, or a part of the dance.

    A dance is over where something is proved to come too near.
    """
    claims = certificate.claims
    about = {claim.about for claim in claims}
    known = ["", *(obstacle.name for obstacle in plan.obstacles())]
    text = _("not in the certificate: {about}")
    found = [text.format(about=name or _("benches")) for name in known if name not in about]
    start, end = plan.span(walk)
    met = [claim.contact is not None and claim.contact >= start for claim in claims]
    contacts = (claim.contact for claim in claims if claim.contact is not None)
    end = min([end, *(t for t in contacts if t >= start)])
    for claim, over in zip(claims, met, strict=True):
        for low, high in ((start, claim.start), (max(claim.clear, start), end)):
            if low < high and (not over or high == claim.start):
                text = _("not in the certificate: {about} from t = {low} s to t = {high} s")
                name = claim.about or _("benches")
                found.append(text.format(about=name, low=repr(low), high=repr(high)))
    return found
