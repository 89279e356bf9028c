"""Certificates: a plan, what was proved of it, and the cells that show it; and their verification.

Whoever verifies one need not believe the search: from the plan alone the dragon is placed in ball
arithmetic at the ends of each cell, and each is shown to hold (proofs/cells.py). Nothing that is
written in a certificate is believed but where the cells begin and end. The numbers of the plan, times,
margins and speeds are the decimals that stand there; only head positions are doubles.
"""

import json
import stat
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal, Self, TypeVar, overload

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from benchdragon import budget
from benchdragon.analysis.proof import Claim, Question, require_flint
from benchdragon.analysis.speed_proof import SpeedClaim, SpeedQuestion, head_speeds
from benchdragon.errors import InputError, UnsureError, not_negative, reason
from benchdragon.files import whole_file
from benchdragon.i18n import _
from benchdragon.model.walk import Walk
from benchdragon.plans.digits import Rounded, number
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
    margin: Number | None = None
    values: dict[str, Number] = Field(default={}, max_length=10)

    def claim(self) -> Claim:
        """The same to be shown."""
        lists = {"cells": tuple(self.cells), "benches": tuple(self.benches)}
        return Claim(**self.model_dump() | lists | {"values": tuple(self.values.items())})


class SpeedRecord(BaseModel):
    """A `SpeedClaim` as it is written."""

    model_config = ConfigDict(extra="forbid", strict=True)

    cells: list[Number] = Field(min_length=1, max_length=MOST_CELLS)
    start: Number
    clear: Number
    most: Number
    s: Number
    handle: int = Field(ge=0)
    least: Number

    def claim(self) -> SpeedClaim:
        """The same to be shown."""
        return SpeedClaim(**self.model_dump() | {"cells": tuple(self.cells)})


class Certificate(BaseModel):
    """A certificate as it is written."""

    model_config = ConfigDict(extra="forbid", strict=True)

    format: Literal["benchdragon certificate"] = "benchdragon certificate"
    version: str = Field(max_length=100)
    plan: dict[str, Any]
    plan_sha256: str = Field(max_length=64)
    claims: list[ClaimRecord] = Field(default=[], max_length=1000)
    speeds: list[SpeedRecord] = Field(default=[], max_length=1000)

    @model_validator(mode="after")
    def _says_something(self) -> Self:
        if not (self.claims or self.speeds):
            raise ValueError("nothing is claimed")
        return self


def certificate_of(
    plan: Plan, claims: Sequence[Claim], speeds: Sequence[SpeedClaim] = ()
) -> Certificate:
    """What was proved of a plan, to be written.

    Raises:
        InputError: if nothing was.
    """
    if not (claims or speeds):
        raise InputError(_("nothing was proved, so that there is no certificate"))
    return Certificate(
        version=__version__,
        plan=plan.data(),
        plan_sha256=plan.sha256,
        claims=[ClaimRecord(**_written(claim)) for claim in claims],
        speeds=[SpeedRecord(**asdict(claim) | {"cells": list(claim.cells)}) for claim in speeds],
    )


def _written(claim: Claim) -> dict[str, Any]:
    lists = {"cells": list(claim.cells), "benches": list(claim.benches)}
    return asdict(claim) | lists | {"values": dict(claim.values)}


def write_certificate(certificate: Certificate, path: Path) -> None:
    """Write a certificate as a whole file."""
    with whole_file(path) as temporary:
        temporary.write_text(certificate.model_dump_json(), "utf-8")


Kind = TypeVar("Kind", bound=BaseModel)


@overload
def read_certificate(path: Path) -> Certificate: ...


@overload
def read_certificate(path: Path, kind: type[Kind]) -> Kind: ...


def read_certificate(path: Path, kind: type[BaseModel] = Certificate) -> BaseModel:
    """Read a certificate, of that kind.

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
        text = path.read_bytes()
        found = kind.model_validate_json(text)
        _refuse_rounded(text)
        return found
    except OSError as error:
        raise InputError(f"{name}: {reason(error)}") from None
    except UnicodeEncodeError as error:  # a name that no system has
        raise InputError(_("{path} cannot be read: {why}").format(path=name, why=error)) from None
    except ValidationError as error:
        first = error.errors()[0]
        where = "claims" if first["type"] == "value_error" else ".".join(map(str, first["loc"]))
        raise InputError(
            _("{path} is no certificate that benchdragon writes: see {where}").format(
                path=name, where=where or "JSON"
            )
        ) from None


def _refuse_rounded(text: bytes) -> None:
    """Refuse a number that is not the decimal that names its double: another is what is shown.

    Raises:
        InputError: naming it.
    """

    def held(written: str) -> float:
        value = number(written)
        if isinstance(value, Rounded):
            raise InputError(
                _("the certificate says {written}, of which {kept} alone could be shown").format(
                    written=written, kept=repr(float(value))
                )
            )
        return value

    json.loads(text, parse_float=held)


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
    for record in certificate.claims:
        claim = record.claim()
        try:
            shown = _with(plan, claim)
            _question(shown, shown.build(), claim).verify(claim, progress)
        except UnsureError as error:
            about = claim.about or _("benches")
            raise UnsureError(_("{about}: {error}").format(about=about, error=error)) from None
    for speed in certificate.speeds:
        _verify_speed(plan, speed.claim(), progress)
    told = [_sentence(plan, record) for record in certificate.claims]
    told += [_speed_sentence(plan, record) for record in certificate.speeds]
    return told + _all_left_out(plan, certificate)


def _with(plan: Plan, claim: Claim) -> Plan:
    """The plan that a claim is about."""
    return plan.with_values(dict(claim.values)) if claim.values else plan


def _verify_speed(plan: Plan, claim: SpeedClaim, progress: Progress) -> None:
    walk = plan.build()
    if claim.handle > len(walk.dragon):
        raise InputError(_("a speed in the certificate is of no handle of this dragon"))
    try:
        SpeedQuestion(walk, plan).verify(claim, progress)
    except UnsureError as error:
        raise UnsureError(_("{about}: {error}").format(about=_("speed"), error=error)) from None


def _question(plan: Plan, walk: Walk, claim: Claim) -> Question:
    if not claim.about:
        _check_benches(claim, len(walk.dragon), 2)
        margin = plan.limits.margin if claim.margin is None else claim.margin
        not_negative("margin", margin, "m")
        return Question(walk, margin, None, plan)
    _check_benches(claim, len(walk.dragon), 1)
    for obstacle in plan.obstacles():
        if obstacle.name == claim.about:
            return Question(walk, None, obstacle, plan)
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
    kept = plan.limits.margin if claim.margin is None else claim.margin
    margin = repr(kept).removesuffix(".0")  # with all digits, as the times
    return _of_values(claim, _said_of(claim, margin, span))


def _of_values(claim: ClaimRecord, text: str) -> str:
    """The same of a walk that differs from the plan's."""
    if not claim.values:
        return text
    values = ", ".join(f"{key} = {value!r}" for key, value in claim.values.items())
    return _("with {values}: {text}").format(values=values, text=text)


def _said_of(claim: ClaimRecord, margin: str, span: dict[str, str]) -> str:
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


def _speed_sentence(plan: Plan, claim: SpeedRecord) -> str:
    """What a claim says of speeds, and of the head's, if the plan limits speeds."""
    text = _(
        "proved: from t = {start} s to t = {clear} s no handle is ever more than {most} times as fast "
        "as the head; handle {handle} is at least {least} times as fast"
    )
    numbers = {name: repr(getattr(claim, name)) for name in ("start", "clear", "most", "least")}
    told = text.format(handle=claim.handle, **numbers)
    if plan.limits.speed is None:
        return told
    lower, upper = head_speeds(plan.limits.speed, claim.claim())
    more = _("; so the head may go at {lower} m/s, and not at {upper} m/s, if {limit} m/s is the limit")
    return told + more.format(lower=repr(lower), upper=repr(upper), limit=repr(plan.limits.speed))


def _all_left_out(plan: Plan, certificate: Certificate) -> list[str]:
    """What the certificate says nothing about; where it is about sizes, of those that are to be safe.

    What it says with margins of its own is said besides.
    """
    plain = [claim for claim in certificate.claims if claim.margin is None or claim.values]
    groups: dict[tuple[tuple[str, float], ...], list[ClaimRecord]] = {}
    for claim in plain:
        groups.setdefault(tuple(claim.values.items()), []).append(claim)
    found: list[str] = []
    for values, claims in (groups or {(): []}).items():
        shown = plan.with_values(dict(values)) if values else plan
        if not values or any(claim.contact is None for claim in claims):
            left = _left_out(shown, shown.build(), claims)
            found += [_of_values(claims[0], text) for text in left] if claims else left
    return found


def _left_out(plan: Plan, walk: Walk, claims: Sequence[ClaimRecord]) -> list[str]:
    """What claims say nothing about: benches, obstacles, or a part of the dance.

    A dance is over where something is proved to come too near.
    """
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
