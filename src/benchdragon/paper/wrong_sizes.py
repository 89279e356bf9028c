"""What a workbook holds whose dragon or spiral has other sizes than the contest's."""

from collections.abc import Iterator, Mapping

import numpy as np

from benchdragon.errors import BenchDragonError
from benchdragon.i18n import _
from benchdragon.paper.cases import Case, Guess, complex_of, values_of, with_points

# Links of the contest's dragon, m, and how far a link may be off unnoticed; lengths of its benches, m.
LINKS, LINK_SLACK = (2.86, 1.65), 1e-4
LENGTHS = (3.41, 2.20)
# Pitches that are tried, m, how often the range is halved; decimals of those that are meant, if they
# are so near, in units of the last.
PITCHES, HALVINGS, PLACES, ROUND = (0.2, 3.0), 40, (2, 3, 4, 5, 6), 0.01
# Turns of the spiral at which the head may start in place of the 16th.
STARTS = (14, 15, 17, 18)


def size(case: Case) -> Iterator[Guess]:
    """Links of other lengths, another pitch, another turn to start at."""
    links = links_of(case)
    if links is not None:
        yield from _other(case, links_text(links), links[0], _link_keys(links))
    if case.moment:
        return
    if case.plan.route.kind == "spiral-in":
        text = _("the head starts {start} m from the centre of the spiral, not {right} m")
        pitch, right = (case.plan.value(f"route.{key}") for key in ("pitch", "start_turn"))
        for turn in STARTS:
            said = text.format(start=f"{turn * pitch:.4g}", right=f"{right * pitch:.4g}")
            yield from _other(case, said, turn * pitch, {"route.start_turn": turn})
    text = _("the pitch of the spiral is {pitch} m, not {right} m")
    for keys in _pitches(case):
        pitch = keys["route.pitch"]
        said = text.format(pitch=f"{pitch:.6g}", right=f"{case.plan.value('route.pitch'):g}")
        yield from _other(case, said, pitch, keys)


def _other(case: Case, text: str, amount: float, keys: Mapping[str, float]) -> Iterator[Guess]:
    """The same workbook of another plan, if there is one."""
    try:
        walk = case.plan.with_values(keys).build()
    except BenchDragonError:
        return
    yield Guess("size", values_of(walk, case.times), text, amount, "m")


def links_of(case: Case) -> tuple[float, float] | None:
    """Lengths of the first link and of all others, m, if they are not the contest's; else None."""
    apart = np.hypot(*np.diff(case.theirs[:2], axis=2))
    if not (np.isfinite(apart[:, 0]).any() and np.isfinite(apart[:, 1:]).any()):
        return None
    lengths = float(np.nanmedian(apart[:, 0])), float(np.nanmedian(apart[:, 1:]))
    scatter = np.nanmedian(np.abs(apart[:, 1:] - lengths[1]))
    if scatter > LINK_SLACK or np.allclose(lengths, LINKS, rtol=0.0, atol=LINK_SLACK):
        return None
    return lengths


def links_text(lengths: tuple[float, float]) -> str:
    """The lengths of links that are not the contest's, in words."""
    text = _(
        "the handles of the head are {first} m apart and those of all others {others} m; the links "
        "are {links} m"
    )
    if np.allclose(lengths, LENGTHS, rtol=0.0, atol=LINK_SLACK):
        text = _(
            "the handles of the head are {first} m apart and those of all others {others} m: these "
            "are the lengths of the benches; the links are {links} m"
        )
    links = " / ".join(f"{link:.2f}" for link in LINKS)
    return text.format(first=f"{lengths[0]:.4f}", others=f"{lengths[1]:.4f}", links=links)


def _link_keys(links: tuple[float, float]) -> dict[str, float]:
    """Lengths of benches whose holes are so far apart, at the contest's insets."""
    inset = LENGTHS[1] - LINKS[1]
    first, others = (round(link, 5) + inset for link in links)
    return {"dragon.head_length": first, "dragon.body_length": others, "dragon.tail_length": others}


def _pitches(case: Case) -> Iterator[dict[str, float]]:
    """Settings whose spirals put the head as far from the centre as theirs is, in the mean."""
    theirs = np.abs(complex_of(case.theirs)[:, 0])
    known = np.isfinite(theirs)
    if not known.any():
        return
    spiral = case.plan.route.kind == "spiral-in"
    first = float(np.hypot(*case.walk.route.point(np.zeros(1))[0]))

    def settings(pitch: float, fixed: bool) -> dict[str, float]:
        turns = {"route.start_turn": first / pitch} if fixed else {}
        return {"route.pitch": pitch, **turns}

    def beyond(keys: dict[str, float]) -> float:
        try:
            walk = case.plan.with_values(keys).build()
            points = walk.route.point(walk.head_position(case.times[known]))
        except BenchDragonError:  # the spiral ends before, or is none
            return np.nan
        return float(np.median(np.hypot(points[..., 0], points[..., 1]) - theirs[known]))

    for fixed in (False, True) if spiral else (False,):
        low, high = PITCHES
        for _step in range(HALVINGS):
            middle = 0.5 * (low + high)
            too_far = beyond(settings(middle, fixed)) > 0.0
            low, high = (low, middle) if too_far != fixed else (middle, high)
        meant = (n for n in PLACES if abs(high - round(high, n)) < ROUND * 10.0**-n)
        yield settings(round(high, next(meant, 12)), fixed)


def degrees(case: Case) -> Iterator[Guess]:
    """Angles in degrees where sines and cosines need radians, and polar coordinates."""
    if case.plan.route.kind != "spiral-in":
        return
    radius = np.abs(complex_of(case.ours))
    angle = 2.0 * np.pi * radius / case.plan.value("route.pitch")
    points = radius * np.exp(1j * np.radians(angle))
    text = _("sines and cosines were taken of angles in radians as if they were degrees")
    yield Guess("unit", with_points(points, case.ours[2]), text)
    text = _("x and y hold the polar coordinates r and theta, theta in radians")
    yield Guess("unit", np.stack([radius, angle, case.ours[2]]), text)
    text = _("x and y hold the polar coordinates r and theta, theta in degrees")
    yield Guess("unit", np.stack([radius, np.degrees(angle), case.ours[2]]), text)
