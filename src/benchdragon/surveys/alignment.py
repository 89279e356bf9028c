"""Surveyed alignments: lines, arcs and clothoids whose joints have small gaps and kinks, made whole."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import JOINT_GAP, JOINT_KINK, AnyCurve, Arc, Clothoid, Line
from benchdragon.surveys.clothoids import bound_between, folded, g1_clothoids
from benchdragon.surveys.lines import MOST_CURVES, most_bend

BoolArray = npt.NDArray[np.bool_]

# Default tolerances of joints, m and rad.
GAP = 5e-3
KINK = 1e-3
# Half of what a route accepts: the rest is for rounding.
SOUND_GAP, SOUND_KINK = 0.1 * JOINT_GAP, 0.1 * JOINT_KINK
# A part is refitted in pieces that turn by at most this, rad.
MOST_TURN = 1.5


@dataclass(frozen=True)
class Absorbed:
    """What it took to make the parts of a drawing meet.

    Attributes:
        joints: how many joints there are.
        adjusted: how many of them had a gap or a kink.
        gap: the largest gap, m.
        kink: the largest kink, rad.
        shift: a bound on how far any point was moved, m.
        turn: the most by which the heading at an end of a part was changed, rad.
    """

    joints: int
    adjusted: int = 0
    gap: float = 0.0
    kink: float = 0.0
    shift: float = 0.0
    turn: float = 0.0


def joined_alignment(
    curves: Sequence[AnyCurve], closed: bool = False, gap: float = GAP, kink: float = KINK
) -> tuple[tuple[AnyCurve, ...], Absorbed]:
    """Curves that meet without gap or kink, from such as nearly do, and what was changed.

    At each joint both ends come to the middle of the gap, with the mean of both headings, the longer
    part's counting for more. A part with an end that was moved becomes clothoids between its new
    ends; the others stay as they are. So nothing adds up along the way.

    Args:
        curves: lines, arcs and clothoids in walking order.
        closed: whether the last one leads to the first.
        gap: the largest gap at a joint, m.
        kink: the largest kink at a joint, rad.

    Raises:
        InputError: naming the first joint that is farther off, and for parts that would be cut into
            more than MOST_CURVES.
    """
    starts, ends = _poses(curves)
    off, turn = _misfits(ends, np.roll(starts, -1, axis=0), closed)
    _check(ends, off, turn, gap, kink)
    moved = _unsound(off, turn)
    parts = _pieces(curves, moved | np.roll(moved, 1))
    starts, ends = _poses(parts)
    after = np.roll(starts, -1, axis=0)
    off, turn = _misfits(ends, after, closed)
    moved = _unsound(off, turn)
    lengths = np.array([part.length for part in parts])
    share = np.roll(lengths, -1) / (lengths + np.roll(lengths, -1))
    joints = np.column_stack([0.5 * (ends[:, :2] + after[:, :2]), ends[:, 2] + share * turn])
    if not closed:
        joints[-1] = ends[-1]
    first_moved = np.roll(moved, 1)
    first_moved[0] &= closed
    found, shift = _between(parts, joints, moved, first_moved)
    turned = np.maximum(share, 1.0 - share) * np.abs(turn)
    joint_count = len(curves) - (not closed)
    return found, Absorbed(
        joint_count, int(moved.sum()), float(off.max()), float(np.abs(turn).max()), shift,
        float(turned.max()),
    )  # fmt: skip


def _between(
    parts: Sequence[AnyCurve], joints: FloatArray, moved: BoolArray, first_moved: BoolArray
) -> tuple[tuple[AnyCurve, ...], float]:
    """The parts, clothoids in place of those with an end that was moved, and how far these lie off, m.

    `joints` are the poses at their ends, (n, 3); `moved` and `first_moved` say of each part whether
    its end and its start were moved.
    """
    found: list[AnyCurve] = []
    shift = 0.0
    starts, ends = _poses(parts)
    for n, part in enumerate(parts):
        if not (first_moved[n] or moved[n]):
            found.append(part)
            continue
        start = joints[n - 1] if first_moved[n] else starts[n]
        end = joints[n] if moved[n] else ends[n]
        (made,) = g1_clothoids(np.array([start, end]))
        shift = max(shift, bound_between(part, made))
        found.append(made)
    return tuple(found), shift


def largest_misfits(
    curves: Sequence[AnyCurve], closed: bool, gap: float, kink: float
) -> tuple[float, float]:
    """The largest gap, m, and kink, rad, at the joints of curves, as `joined_alignment` finds them.

    Raises:
        InputError: naming the first joint with a gap over `gap`, m, or a kink over `kink`, rad.
    """
    starts, ends = _poses(curves)
    off, turn = _misfits(ends, np.roll(starts, -1, axis=0), closed)
    _check(ends, off, turn, gap, kink)
    return float(off.max()), float(np.abs(turn).max())


def _misfits(ends: FloatArray, after: FloatArray, closed: bool) -> tuple[FloatArray, FloatArray]:
    """From the end of each part to the start of the one after it: the gap, m, and the kink, rad."""
    off = np.hypot(*(after[:, :2] - ends[:, :2]).T)
    turn = folded(after[:, 2] - ends[:, 2])
    if not closed:
        off[-1] = turn[-1] = 0.0
    return off, turn


def _unsound(off: FloatArray, turn: FloatArray) -> BoolArray:
    """Which joints a route would not take as they are."""
    return (off > SOUND_GAP) | (np.abs(turn) > SOUND_KINK)


def _poses(parts: Sequence[AnyCurve]) -> tuple[FloatArray, FloatArray]:
    """Poses (x, y, heading) at the starts and at the ends."""
    starts, ends = (part.start_pose for part in parts), (part.end_pose for part in parts)
    return (
        np.array([(*point, heading) for point, heading in starts]),
        np.array([(*point, heading) for point, heading in ends]),
    )


def _check(ends: FloatArray, off: FloatArray, turn: FloatArray, gap: float, kink: float) -> None:
    bad = (off > gap) | (np.abs(turn) > kink)
    if not bad.any():
        return
    n = int(np.argmax(bad))
    place = f"({ends[n, 0]:.6g}, {ends[n, 1]:.6g})"
    if off[n] > gap:
        text = _(
            "at {place} m two parts of the drawing are {gap} m apart, more than the {most} m "
            "that are absorbed: join them in the drawing, or set route.joint_gap"
        )
        raise InputError(text.format(place=place, gap=f"{off[n]:.4g}", most=f"{gap:g}"))
    raise InputError(
        _(
            "at {place} m the drawing has a kink of {kink} degrees, more than the {most} degrees "
            'that are absorbed: round it by route.smooth = "G1", or set route.joint_kink'
        ).format(
            place=place, kink=f"{math.degrees(abs(turn[n])):.4g}", most=f"{math.degrees(kink):.4g}"
        )
    )


def _pieces(curves: Sequence[AnyCurve], moved: BoolArray) -> list[AnyCurve]:
    """Curves with a moved end cut for clothoids, others whole; InputError beyond MOST_CURVES."""
    turns = np.array([most_bend(curve) * curve.length for curve in curves])
    counts = np.where(moved, np.maximum(1.0, np.ceil(turns / MOST_TURN)), 1.0)
    if not counts.sum() <= MOST_CURVES:
        n = int(np.argmax(counts))
        text = _(
            "part {part} of the drawing winds round {turns} times, too often for its ends to be "
            "moved to those beside it"
        )
        raise InputError(text.format(part=n + 1, turns=f"{turns[n] / (2.0 * math.pi):.4g}"))
    pairs = zip(curves, counts.astype(np.int64).tolist(), strict=True)
    return [piece for curve, count in pairs for piece in _cut(curve, count)]


def _cut(curve: AnyCurve, count: int) -> list[AnyCurve]:
    if isinstance(curve, Line) or count == 1:
        return [curve]
    at = np.linspace(0.0, curve.length, count + 1)
    poses = np.column_stack([curve.point(at), curve.heading(at)]).tolist()
    if isinstance(curve, Arc):
        return [Arc(curve.radius, curve.sweep / count, (x, y), w) for x, y, w in poses[:-1]]
    bends = curve.curvature(at).tolist()
    return [
        Clothoid(curve.length / count, a, b, (x, y), w)
        for a, b, (x, y, w) in zip(bends[:-1], bends[1:], poses[:-1], strict=True)
    ]
