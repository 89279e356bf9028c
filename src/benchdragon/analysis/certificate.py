"""Certificates: a plan, what was proved of it, and the cells that show it; and their verification.

Verification does not rely on the search: from the plan alone the dragon is placed in ball arithmetic at
the ends of each cell, and each is shown to hold (proofs/cells.py). Of the certificate's content only
the cells' boundaries are used. The numbers of the plan, times, margins and speeds are the decimals that
stand there; only head positions are doubles.
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
from benchdragon.analysis.speed_proof import SpeedClaim, SpeedQuestion
from benchdragon.analysis.statements import Apart, Paces, Verified, place_of, quoted
from benchdragon.errors import InputError, UnsureError, not_negative, reason
from benchdragon.files import write_whole
from benchdragon.i18n import _
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.digits import Rounded, number
from benchdragon.plans.schema import Plan, checked
from benchdragon.progress import Progress, silent
from benchdragon.proofs import MOST_CELLS
from benchdragon.version import __version__

# Versions whose certificates say what is read here.
VERSIONS = ("0.1.0",)
# Tables of a plan that do not affect contact, except by margins; obstacles are checked separately.
ASIDE = ("meta", "people", "limits", "venue", "obstacle")
# Largest size of a certificate file, bytes: cells of 20 characters each.
MOST_BYTES = 64_000_000

# Whole numbers of fewer signs have a double of their own.
EXACT = 16

Number = Annotated[float, Field(allow_inf_nan=False)]


class ClaimRecord(BaseModel):
    """A `Claim` as stored in a certificate."""

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
    """A `SpeedClaim` as stored in a certificate."""

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
    """The content of a certificate file."""

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
    """The certificate of what was proved about a plan.

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
    write_whole(path, certificate.model_dump_json())


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
            said = _("{path} is larger than any certificate, {most} MB")
            raise InputError(said.format(path=name, most=MOST_BYTES // 1_000_000))
        text = path.read_bytes()
        found = kind.model_validate_json(text)
        _refuse_odd(text)
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


def _refuse_odd(text: bytes) -> None:
    """Raise InputError for duplicate keys, and for numbers that are not the decimal of their double."""

    def held(written: str) -> float:
        value = number(written)
        if isinstance(value, Rounded):
            text = _("the certificate says {written}, of which {kept} alone could be shown")
            raise InputError(text.format(written=written, kept=repr(float(value))))
        return value

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found = dict(pairs)
        if len(found) < len(pairs):
            names = [name for name, _value in pairs]
            twice = next(name for name in names if names.count(name) > 1)
            raise InputError(_("the certificate says {name} twice").format(name=repr(twice[:80])))
        return found

    def whole(written: str) -> float:
        return int(written) if len(written) < EXACT else held(written)

    def never(written: str) -> float:
        raise InputError(_("the certificate says {name}").format(name=written))

    json.loads(text, parse_float=held, parse_int=whole, parse_constant=never, object_pairs_hook=once)


def verify(certificate: Certificate, progress: Progress = silent) -> list[str]:
    """Show every claim of a certificate again; sentences about what then is proved: see `shown`."""
    return shown(certificate, progress).sentences


@budget.question()
def shown(certificate: Certificate, progress: Progress = silent) -> Verified:
    """What a certificate shows, every claim of it being shown again.

    Raises:
        InputError, PlanError: for a plan that is none, or another than its hash says; for an unknown
            version, or a field on which nothing rests that is shown.
        MissingExtraError: without python-flint.
        UnsureError: naming the claim that does not hold, and why.
        WalkError: if the dragon cannot stand where a cell ends.
    """
    require_flint()
    plan = plan_in(certificate.version, certificate.plan, certificate.plan_sha256)
    apart = [_shown(plan, record.claim(), progress) for record in certificate.claims]
    paces = [_paces(plan, speed.claim(), progress) for speed in certificate.speeds]
    return Verified((*apart, *paces), tuple(_all_left_out(plan, apart)))


def plan_in(version: str, data: dict[str, Any], sha256: str) -> Plan:
    """The plan of a certificate of a version.

    Raises:
        InputError, PlanError: for one that is unknown, or a plan that is none or has another hash.
    """
    if version not in VERSIONS:
        text = _("the certificate is of version {version}, which is unknown here; known: {known}")
        raise InputError(text.format(version=repr(version), known=", ".join(VERSIONS)))
    plan = checked(data, _("the certificate"))
    if plan.sha256 != sha256:
        raise InputError(_("the plan in the certificate is not the one that it was written for"))
    return plan


def _shown(plan: Plan, claim: Claim, progress: Progress) -> Apart:
    """The statement that a claim proves."""
    other = _with(plan, claim.values)
    walk, obstacle = other.build(), _obstacle(other, claim)
    _check_benches(claim, len(walk.dragon), 2 if obstacle is None else 1)
    _refuse_unused(plan, claim)
    margin = _margin(other, claim) if obstacle is None else obstacle.margin
    not_negative("margin", margin, "m")
    times = [time for time in (claim.start, claim.clear, claim.contact) if time is not None]
    try:
        _check_times(other, walk, times)
        kept = margin if obstacle is None else None
        Question(walk, kept, obstacle, other).verify(claim, progress)
    except UnsureError as error:
        about = _("benches") if obstacle is None else f'"{quoted(obstacle.name)}"'
        raise UnsureError(_("{about}: {error}").format(about=about, error=error)) from None
    benches = tuple(n + 1 for n in claim.benches)
    return Apart(claim.values, obstacle, margin, claim.start, claim.clear, claim.contact, benches)


def _with(plan: Plan, values: Sequence[tuple[str, float]]) -> Plan:
    """The plan with the values of a claim."""
    return plan.with_values(dict(values)) if values else plan


def _obstacle(plan: Plan, claim: Claim) -> Obstacle | None:
    """The obstacle of a claim, or InputError; None for a claim about the benches alone."""
    if not claim.about:
        return None
    for obstacle in plan.obstacles():
        if obstacle.name == claim.about:
            return obstacle
    raise InputError(_("the plan has no obstacle {name}").format(name=repr(claim.about)))


def _margin(plan: Plan, claim: Claim) -> float:
    return plan.limits.margin if claim.margin is None else claim.margin


def _refuse_unused(plan: Plan, claim: Claim) -> None:
    """Raise InputError for a margin, or a value, that the claim's proof does not use."""
    unused = ["margin"] if claim.about and claim.margin is not None else []
    wanted = _rests_on(_with(plan, claim.values), claim)
    for key, _value in claim.values:
        rest = _with(plan, [one for one in claim.values if one[0] != key])
        unused += [key] if _rests_on(rest, claim) == wanted else []
    if unused:
        text = _("the certificate says {name}, on which nothing rests that it shows")
        raise InputError(text.format(name=unused[0]))


def _rests_on(plan: Plan, claim: Claim) -> tuple[Any, ...]:
    """The part of a plan that what a claim shows is read from."""
    walked = {name: data for name, data in plan.data().items() if name not in ASIDE}
    found = [obstacle for obstacle in plan.obstacles() if obstacle.name == claim.about]
    return walked, found, None if claim.about else _margin(plan, claim)


def _check_times(plan: Plan, walk: Walk, times: Sequence[float]) -> None:
    """Raise UnsureError for times outside of the walk."""
    start, end = plan.span(walk)
    if not all(start <= time <= end for time in times):
        text = _("it speaks of other times than those of the walk, {start} s to {end} s")
        raise UnsureError(text.format(start=repr(start), end=repr(end)))


def _paces(plan: Plan, claim: SpeedClaim, progress: Progress) -> Paces:
    """The statement that a claim about speeds proves."""
    walk = plan.build()
    if claim.handle > len(walk.dragon):
        raise InputError(_("a speed in the certificate is of no handle of this dragon"))
    try:
        _check_times(plan, walk, (claim.start, claim.clear))
        SpeedQuestion(walk, plan).verify(claim, progress)
    except UnsureError as error:
        raise UnsureError(_("{about}: {error}").format(about=_("speed"), error=error)) from None
    return Paces(claim, plan.limits.speed)


def _check_benches(claim: Claim, count: int, wanted: int) -> None:
    """Refuse benches that do not exist, and adjacent benches, which may touch."""
    benches = claim.benches
    if claim.contact is None and claim.s is None and not benches:
        return
    there = len(benches) == wanted and all(0 <= n < count for n in benches)
    if not (there and claim.contact is not None and claim.s is not None):
        raise InputError(_("a contact in the certificate names no benches of this dragon"))
    if wanted == 2 and abs(benches[0] - benches[1]) < 2:
        raise InputError(_("a contact in the certificate names benches that are joined"))


def _all_left_out(plan: Plan, shown: Sequence[Apart]) -> list[str]:
    """What the certificate does not cover; if its claims are about sizes, for those claimed safe.

    What it says with other margins than those of the plan is said besides.
    """
    groups: dict[tuple[tuple[str, float], ...], list[Apart]] = {}
    for one in shown:
        if one.obstacle is not None or one.margin == _with(plan, one.values).limits.margin:
            groups.setdefault(one.values, []).append(one)
    found: list[str] = []
    for values, said in (groups or {(): []}).items():
        other = _with(plan, values)
        if not values or any(one.contact is None for one in said):
            left = _left_out(other, other.build(), said)
            found += [said[0].of_values(text) for text in left] if said else left
    return found


def _left_out(plan: Plan, walk: Walk, shown: Sequence[Apart]) -> list[str]:
    """What no claim covers before a proved contact: benches, obstacles, or a part of the dance."""
    about = {one.obstacle for one in shown}
    text = _("not in the certificate: {about}")
    known = (None, *plan.obstacles())
    found = [text.format(about=_named(one)) for one in known if one not in about]
    start, end = plan.span(walk)
    contacts = [one.contact for one in shown if one.contact is not None]
    end = min([end, *contacts])
    for one in shown:
        for low, high in ((start, one.start), (one.clear, end)):
            if low < high and (one.contact is None or high == one.start):
                text = _("not in the certificate: {about} from t = {low} s to t = {high} s")
                found.append(text.format(about=_named(one.obstacle), low=repr(low), high=repr(high)))
    return found


def _named(obstacle: Obstacle | None) -> str:
    return _("benches") if obstacle is None else place_of(obstacle)
