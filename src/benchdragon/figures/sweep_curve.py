"""Answers over one key: a curve with its bracket, broken at jumps, hatched where there is no answer."""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes

from benchdragon.figures.style import BODY, LEAST_TEXT
from benchdragon.figures.sweep_rows import HATCHES, Answered, Bools, Ints, said
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.sweeps.questions import STATES

# Where others decide than at the point before, the answer jumps if it changes so many times as much as
# the steeper of the slopes on either side says.
STEEPER = 1.25
# What changes by less, as a share of all answers, is not seen to jump, unless it stands so upright: its
# share of all answers to its share of the key's range.
SEEN, UPRIGHT = 1e-2, 2.0
# Each point has a mark where there are so few.
FEW = 60
# A bracket is seen if it is so wide, as a share of all answers; a stretch is named if it is.
VISIBLE, NAMED = 2e-3, 0.04
# Above and below the curve, as a share of its height, for labels.
ROOM = 0.1
# Answers that agree so well are one answer.
ONE_ANSWER = 1e-6


def draw_curve(panel: Axes, found: Answered, key: str, colours: tuple[str, ...]) -> None:
    """The answers over a key, whose texts stand side by side without a curve."""
    joined = key not in found.texts
    found = found.part(np.argsort(found.keys[key], kind="stable"))
    x = found.keys[key]
    panel.margins(y=ROOM)
    if not joined:
        panel.set_xticks(range(len(found.texts[key])), [said(found, key, n) for n in np.unique(x)])
        panel.set_xlim(-0.5, len(found.texts[key]) - 0.5)
    hatch_gaps(panel, found, key)
    _draw_clear(panel, found, x)
    sound = found.part(found.known)
    x = sound.keys[key]
    apart = np.flatnonzero(_parted(found, key) if joined else np.ones(max(len(x) - 1, 0), dtype=bool))
    _draw_bracket(panel, sound, x, apart)
    jump = jumps(x, sound.value, sound.who)
    for stretch in np.split(np.arange(len(x)), apart + 1):
        _draw_stretch(panel, sound, x, stretch, colours)
    if joined:
        _draw_jumps(panel, sound, x, np.flatnonzero(jump), colours)
    if len(x) and np.ptp(sound.value) < spread(sound.value):
        room, middle = spread(sound.value), float(np.median(sound.value))
        panel.set_ylim(middle - room, middle + room)
    panel.yaxis.get_major_formatter().set_useOffset(False)  # type: ignore[attr-defined]


def jumps(x: FloatArray, value: FloatArray, who: Ints) -> Bools:
    """Behind which points, in the order of x, all with an answer, the answer jumps, (n - 1,).

    It can where others decide, and does unless it changes about as the slopes on either side say, or as
    most slopes do where there is none, or so little that it is invisible. Where no slope is known it is
    taken to jump.
    """
    step, change = np.diff(x), np.diff(value)
    other = who[1:] != who[:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.where(other | (step <= 0.0), np.nan, np.abs(change / step))
    known = slope[np.isfinite(slope)]
    around = np.full((2, len(step)), np.nan)
    around[0, 1:], around[1, :-1] = slope[:-1], slope[1:]
    steepest = np.fmax(around[0], around[1])
    steepest[np.isnan(steepest)] = np.median(known) if len(known) else 0.0
    if not step.any():
        return np.asarray(other, dtype=np.bool_)
    seen = spread(value) * np.minimum(SEEN, UPRIGHT * step / step.sum())
    found: Bools = other & (np.abs(change) > STEEPER * steepest * step + seen)
    return found


def _parted(found: Answered, key: str) -> Bools:
    """Between which points that have an answer no line is drawn: a jump, or points without one."""
    places = np.flatnonzero(found.known)
    sound = found.part(places)
    parted: Bools = jumps(sound.keys[key], sound.value, sound.who) | (np.diff(places) > 1)
    return parted


def hatch_gaps(panel: Axes, found: Answered, key: str) -> None:
    """Hatch where there is no answer, half way to the points that have one, by the reason."""
    x = found.keys[key]
    edges = np.concatenate([x[:1], 0.5 * (x[1:] + x[:-1]), x[-1:]])
    if key in found.texts:
        edges[[0, -1]] += [-0.5, 0.5]
    for first, last in runs(found.why):
        why = str(found.why[first])
        if why:
            panel.axvspan(
                float(edges[first]), float(edges[last + 1]), fc="#EEEEEE", ec="#777777", lw=0.0,
                hatch=HATCHES[why], zorder=0.5, label=_(STATES[why]),
            )  # fmt: skip


def runs(values: "np.ndarray[tuple[int, ...], np.dtype[np.generic]]") -> Iterator[tuple[int, int]]:
    """The first and the last place of each run of equal values."""
    if not len(values):
        return
    ends = np.flatnonzero(values[1:] != values[:-1])
    yield from zip([0, *(ends + 1).tolist()], [*ends.tolist(), len(values) - 1], strict=True)


def _draw_clear(panel: Axes, found: Answered, x: FloatArray) -> None:
    """How far walks without contact were followed."""
    clear = (found.why == "clear") & np.isfinite(found.lower)
    if clear.any():
        text = _("no contact up to here")
        panel.plot(x[clear], found.lower[clear], "^", color="black", mfc="none", ms=4.0, label=text)


def _draw_bracket(panel: Axes, sound: Answered, x: FloatArray, apart: Ints) -> None:
    """The bracket of each answer, where it is wide enough to be seen."""
    wide = sound.upper - sound.lower
    finite = np.isfinite(wide)
    if not (wide[finite] > VISIBLE * spread(sound.value)).any():
        return
    for n, stretch in enumerate(np.split(np.arange(len(x)), apart + 1)):
        some = stretch[finite[stretch]]
        label = _("bracket") if n == 0 else ""
        if len(some) > 1:
            panel.fill_between(
                x[some], sound.lower[some], sound.upper[some], fc=BODY, alpha=0.35, lw=0.0, label=label
            )
        else:
            panel.vlines(x[some], sound.lower[some], sound.upper[some], color=BODY, lw=4.0, label=label)


def spread(value: FloatArray) -> float:
    """The range of answers; a small share of them where they agree up to rounding."""
    if not len(value):
        return 0.0
    return max(float(np.ptp(value)), ONE_ANSWER * float(np.abs(value).max()))


def _draw_stretch(
    panel: Axes, sound: Answered, x: FloatArray, stretch: Ints, colours: tuple[str, ...]
) -> None:
    """Points without a jump between them, in the colours of those who decide."""
    for first, last in runs(sound.who[stretch]):
        own = stretch[first : last + 1]
        who = int(sound.who[own[0]])
        colour = colours[who] if who >= 0 else "black"
        xs, ys = x[own], sound.value[own]
        # The curve goes on without a jump to the next who decides: each has half of the way.
        for end, beside in ((0, first - 1), (len(xs), last + 1)):
            if 0 <= beside < len(stretch):
                near, other = own[0 if end == 0 else -1], stretch[beside]
                xs = np.insert(xs, end if end == 0 else len(xs), 0.5 * (x[near] + x[other]))
                middle = 0.5 * (sound.value[near] + sound.value[other])
                ys = np.insert(ys, end if end == 0 else len(ys), middle)
        panel.plot(xs, ys, color=colour, lw=1.6, solid_capstyle="butt")
        if len(x) <= FEW or len(xs) == 1:
            panel.plot(x[own], sound.value[own], ".", color=colour, ms=5.0)


def _draw_jumps(
    panel: Axes, sound: Answered, x: FloatArray, places: Ints, colours: tuple[str, ...]
) -> None:
    """Both ends of each jump: the lower filled, the upper open."""
    for number, place in enumerate(places):
        ends = sorted((place, place + 1), key=lambda n: float(sound.value[n]))
        for n, full in zip(ends, (True, False), strict=True):
            colour = colours[sound.who[n]] if sound.who[n] >= 0 else "black"
            panel.plot(
                x[n], sound.value[n], "o", color=colour, mfc=colour if full else "white", ms=4.0,
                mew=1.0, zorder=4, label=None if full or number else _("jump"),
            )  # fmt: skip


def name_stretches(panel: Axes, found: Answered, key: str) -> None:
    """Write the numbers of who decides beside each stretch that is long enough."""
    found = found.part(np.argsort(found.keys[key], kind="stable"))
    x = found.keys[key]
    for first, last in runs(found.who):
        who = int(found.who[first])
        if who < 0 or x[last] - x[first] < NAMED * (x[-1] - x[0]):
            continue
        at = 0.5 * (x[first] + x[last])
        own = slice(first, last + 1)
        falls = found.value[last] < found.value[first]
        panel.annotate(
            "–".join(map(str, found.names[who])), (at, np.interp(at, x[own], found.value[own])),
            xytext=(3 if falls else -3, 3), textcoords="offset points", va="bottom",
            ha="left" if falls else "right", fontsize=LEAST_TEXT,
        )  # fmt: skip
