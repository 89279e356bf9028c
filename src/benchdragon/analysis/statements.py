"""The content of a certificate in sentences and as data, from its proved claims alone."""

import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from benchdragon.analysis.speed_proof import SpeedClaim, head_speeds
from benchdragon.i18n import N_, _
from benchdragon.model.obstacle import Obstacle

# Obstacles by their kinds; a name proves nothing, so that the place is given.
STANDING: Mapping[str, str] = {
    "circle": N_('the circle "{name}" of radius {radius} m about ({x}, {y}) m'),
    "rectangle": N_('the rectangle "{name}" between ({x}, {y}) and ({to_x}, {to_y}) m'),
    "polygon": N_('the polygon "{name}" between ({x}, {y}) and ({to_x}, {to_y}) m'),
    "line": N_('the line "{name}" between ({x}, {y}) and ({to_x}, {to_y}) m'),
    "venue": N_('the venue "{name}" between ({x}, {y}) and ({to_x}, {to_y}) m'),
}
# What ends a quotation, besides initial and final quotes, or begins an escape.
QUOTES = '"\uff02\\'


def quoted(name: str) -> str:
    """A name in quotes; characters that could end them, or are invisible, become their code."""

    def plain(sign: str) -> bool:
        return (
            sign.isprintable() and sign not in QUOTES and unicodedata.category(sign) not in ("Pi", "Pf")
        )

    return "".join(sign if plain(sign) else f"\\u{{{ord(sign):04x}}}" for sign in name)


def place_of(obstacle: Obstacle) -> str:
    """An obstacle by its kind, its name in quotes, and where it stands: in the language in use."""
    (x, y), (to_x, to_y) = obstacle.outline.min(axis=0), obstacle.outline.max(axis=0)
    words = {"x": x, "y": y, "to_x": to_x, "to_y": to_y, "radius": obstacle.radius}
    shown = {name: f"{value:.10g}" for name, value in words.items()}
    return _(STANDING[obstacle.kind]).format(name=quoted(obstacle.name), **shown)


@dataclass(frozen=True)
class Apart:
    """A proved statement about benches among themselves, or benches and an obstacle.

    Attributes:
        values: of other keys than the plan says them, by which the walk shown differs from the plan's.
        obstacle: from which benches keep apart; None: from one another.
        margin: than which nothing comes nearer from `start` to `clear`, m.
        start: s.
        clear: s; the start itself where no time before the contact is shown.
        contact: a time, s, by which a pair has come nearer; None in a claim without contact.
        benches: which, numbers from 1.
    """

    values: tuple[tuple[str, float], ...]
    obstacle: Obstacle | None
    margin: float
    start: float
    clear: float
    contact: float | None
    benches: tuple[int, ...]

    def sentence(self) -> str:
        """It in words, in the language in use; numbers with all digits, as none may be rounded."""
        words = {
            "margin": repr(self.margin).removesuffix(".0"), "start": repr(self.start),
            "clear": repr(self.clear), "contact": repr(self.contact),
            "benches": " ".join(map(str, self.benches)),
            "obstacle": "" if self.obstacle is None else place_of(self.obstacle),
        }  # fmt: skip
        if self.contact is not None and self.clear <= self.start:
            return self.of_values(_(self._met()).format(**words))
        text = _(self._kept()).format(**words)
        if self.contact is not None:
            text += _("; nearer by t = {contact} s: {benches}").format(**words)
        return self.of_values(text)

    def of_values(self, text: str) -> str:
        """The same, said of a walk that differs from the plan's."""
        if not self.values:
            return text
        values = ", ".join(f"{key} = {value!r}" for key, value in self.values)
        return _("with {values}: {text}").format(values=values, text=text)

    def _kept(self) -> str:
        if self.obstacle is None:
            return N_(
                "proved: no two non-adjacent benches nearer than {margin} m from t = {start} s to "
                "t = {clear} s"
            )
        if self.obstacle.kind == "venue":
            return N_(
                "proved: no bench leaves {obstacle} or comes nearer than {margin} m to its edge from "
                "t = {start} s to t = {clear} s"
            )
        if self.margin:
            return N_(
                "proved: no bench nearer than {margin} m to {obstacle} from t = {start} s to "
                "t = {clear} s"
            )
        return N_("proved: free of contact with {obstacle} from t = {start} s to t = {clear} s")

    def _met(self) -> str:
        if self.obstacle is None:
            return N_("proved: benches nearer than {margin} m by t = {contact} s: {benches}")
        if self.obstacle.kind == "venue":
            return N_(
                "proved: outside {obstacle}, or nearer than {margin} m to its edge, by t = {contact} "
                "s: {benches}"
            )
        if self.margin:
            return N_("proved: nearer than {margin} m to {obstacle} by t = {contact} s: {benches}")
        return N_("proved: contact with {obstacle} by t = {contact} s: {benches}")

    def as_json(self) -> dict[str, Any]:
        """It as plain data, in SI units."""
        one = self.obstacle
        standing = one and {
            "name": one.name, "kind": one.kind, "radius": one.radius, "outline": one.outline.tolist()
        }  # fmt: skip
        return {
            "about": "benches" if one is None else "obstacle", "obstacle": standing,
            "values": dict(self.values), "margin": self.margin, "start": self.start,
            "clear": self.clear, "contact": self.contact, "benches": list(self.benches),
        }  # fmt: skip


@dataclass(frozen=True)
class Paces:
    """A proved statement about handles' speeds, and what follows for the head's.

    Attributes:
        claim: the proved claim.
        limit: of handles' speeds, m/s; None if the plan has none.
    """

    claim: SpeedClaim
    limit: float | None

    def sentence(self) -> str:
        """It in words, in the language in use."""
        claim = self.claim
        text = _(
            "proved: from t = {start} s to t = {clear} s no handle is ever more than {most} times as "
            "fast as the head; handle {handle} is at least {least} times as fast"
        )
        numbers = {name: repr(getattr(claim, name)) for name in ("start", "clear", "most", "least")}
        told = text.format(handle=claim.handle, **numbers)
        if self.limit is None:
            return told
        lower, upper = head_speeds(self.limit, claim)
        more = _(
            "; so on this way no handle exceeds {limit} m/s with the head at {lower} m/s, and one does "
            "with the head at {upper} m/s"
        )
        return told + more.format(lower=repr(lower), upper=repr(upper), limit=repr(self.limit))

    def as_json(self) -> dict[str, Any]:
        """It as plain data, in SI units."""
        claim, head = self.claim, None if self.limit is None else head_speeds(self.limit, self.claim)
        names = ("start", "clear", "most", "handle", "least")
        rest = {"speed_limit": self.limit, "head_speeds": head and list(head)}
        return {"about": "speeds", **{name: getattr(claim, name) for name in names}, **rest}


Statement = Apart | Paces


@dataclass(frozen=True)
class Verified:
    """What a certificate proves, and what it does not cover, a sentence each."""

    statements: tuple[Statement, ...]
    left_out: tuple[str, ...]

    @property
    def sentences(self) -> list[str]:
        """All of it in words, in the language in use."""
        return [*(one.sentence() for one in self.statements), *self.left_out]
