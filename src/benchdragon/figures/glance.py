"""What notebooks show of records: a small picture, and a table of what they hold, as HTML."""

import html
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from benchdragon.analysis.check import Report, moment, sentence
from benchdragon.errors import BenchDragonError, InputError, brief
from benchdragon.figures.framing import ROUTE_STEP
from benchdragon.i18n import N_, _, language
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import Answer
from benchdragon.model.base_curve import Curve
from benchdragon.model.dragon import Dragon
from benchdragon.model.walk import Motion, Walk
from benchdragon.plans.schema import Plan

# Pixels of a picture's side, and how much of the ground is left about what is shown.
SIDE, ROOM = 220, 0.04
# Points of a route, and benches: of more a line through their handles is drawn.
MOST_POINTS, MOST_BENCHES = 2_000, 500
# Sizes and findings that are listed.
MOST_SIZES, MOST_FINDINGS = 4, 10
BODY, HEAD, LINE = "#56B4E9", "#D55E00", "#999999"

Rows = Sequence[tuple[str, str]]


def as_html(record: Any) -> str:
    """What a notebook shows of a dragon, a route, a walk, a motion, an answer, a plan or a report.

    Raises:
        InputError: for anything else.

    Examples:
        >>> bd.as_html(bd.Dragon.uniform(3))[:5]
        '<div '
    """
    told = next((tell for kind, tell in TOLD.items() if isinstance(record, kind)), None)
    if told is None:
        raise InputError(_("nothing is known to show of {value}").format(value=brief(record)))
    picture, rows = told(record)
    cells = "".join(
        f'<tr><th style="text-align:left">{html.escape(name)}</th>'
        f'<td style="text-align:left">{html.escape(text)}</td></tr>'
        for name, text in rows
    )
    return f'<div style="display:flex;gap:1em;align-items:center">{picture}<table>{cells}</table></div>'


def _dragon(dragon: Dragon) -> tuple[str, Rows]:
    sizes = [f"{length:g} × {width:g} m" for length, width in np.unique(dragon.sizes[:2], axis=1).T]
    return "", [
        (_("benches"), f"{len(dragon)}"),
        (_("sizes"), ", ".join(sizes[:MOST_SIZES]) + (" …" if len(sizes) > MOST_SIZES else "")),
        (_("from handle to handle"), f"{dragon.extent:.6g} m"),
    ]


def _route(route: Curve) -> tuple[str, Rows]:
    bend = float(np.abs(route.curvature(_positions(route))).max())
    return _picture(route), [
        (_("curves"), f"{len(route.parts)}"),
        (_("length"), f"{route.length:.6g} m"),
        (_("tightest radius"), f"{1.0 / bend:.4g} m" if bend else "∞"),
    ]


def _walk(walk: Walk) -> tuple[str, Rows]:
    speeds = [f"{speed:g}" for _time, speed in walk.profile]
    picture, rows = _route(walk.route)
    head = ", ".join(speeds[:MOST_SIZES]) + (" …" if len(speeds) > MOST_SIZES else "")
    return picture, [*_dragon(walk.dragon)[1], *rows, (_("speed of the head"), f"{head} m/s")]


def _motion(motion: Motion) -> tuple[str, Rows]:
    stands = motion[motion.status == 0]
    rows = [
        (_("handles"), f"{motion.x.shape[1]}"),
        (_("times"), f"{len(motion)}" + (f": {_ends(motion.times)} s" if len(motion) else "")),
    ]
    if not len(stands):
        return _picture(motion.walk.route), rows
    return _picture(motion.walk.route, stands[0]), [*rows, (_("speeds"), f"{_ends(stands.speed)} m/s")]


def _answer(answer: Answer) -> tuple[str, Rows]:
    rows = [
        (_("value"), f"{answer.value:.12g} {answer.unit}"),
        (_("bracket"), f"{answer.lower:.15g} … {answer.upper:.15g} {answer.unit}"),
        (_("how established"), _(STATUSES[answer.status])),
    ]
    if (near := answer.witness) is not None:
        rows.append((_("benches"), ", ".join(str(bench) for bench in near.benches)))
        rows += [] if near.time is None else [(_("time"), f"{near.time:.9g} s")]
        rows += [] if near.obstacle is None else [(_("obstacle"), near.obstacle)]
    return "", rows


def _report(report: Report) -> tuple[str, Rows]:
    rows = [
        (_("verdict"), sentence(report)),
        *((found.code, found.text) for found in report.findings[:MOST_FINDINGS]),
    ]
    try:
        motion, _about = moment(report)
    except InputError:  # a dragon of one or two benches
        return _picture(report.walk.route), rows
    return _picture(report.walk.route, motion), rows


def _plan(plan: Plan) -> tuple[str, Rows]:
    rows = [(_("plan"), plan.title(language()) or plan.source.name), (_("route"), plan.route.kind)]
    try:
        walk = plan.build()
        start, end = plan.span(walk)
        motion = walk.motion(start, throw=False)
    except BenchDragonError as error:
        return "", [*rows, (_("error"), str(error))]
    picture = _picture(walk.route, motion if motion.status[0] == 0 else None)
    return picture, [*rows, *_dragon(walk.dragon)[1], (_("time"), f"{start:g} … {end:.6g} s")]


# Who tells of what; STATUSES of answers in words.
TOLD: dict[type, Callable[[Any], tuple[str, Rows]]] = {
    Dragon: _dragon, Curve: _route, Walk: _walk, Motion: _motion, Answer: _answer, Report: _report,
    Plan: _plan,
}  # fmt: skip
STATUSES = {
    "found": N_("found"), "proved": N_("proved"), "infeasible": N_("infeasible"),
    "undecided": N_("undecided"), "unlimited": N_("unlimited"),
}  # fmt: skip


def _ends(values: FloatArray) -> str:
    return f"{values.min():.6g} … {values.max():.6g}"


def _positions(route: Curve) -> FloatArray:
    count = int(min(max(route.length / ROUTE_STEP, 2.0), MOST_POINTS))
    return np.linspace(0.0, route.length, count)


def _picture(route: Curve, motion: Motion | None = None) -> str:
    """A route, and the dragon at the first time of a motion, as SVG."""
    line, seen = route.point(_positions(route)), np.empty((0, 2))
    drawn = [(line, f'fill="none" stroke="{LINE}"')]
    if motion is not None:
        handles = np.stack([motion.x[0], motion.y[0]], axis=-1)
        benches = [(handles, f'fill="none" stroke="{BODY}"')]
        if len(handles) <= MOST_BENCHES:
            benches = [(corners, f'fill="{BODY}"') for corners in motion[0].corners()[0][::-1]]
            benches[-1] = benches[-1][0], f'fill="{HEAD}"'
        drawn += benches
        seen = handles
    points = np.concatenate([line, seen])
    low, size = points.min(axis=0), float(np.ptp(points, axis=0).max()) or 1.0
    scale = SIDE / size
    paths = "".join(
        f'<path d="M{_path((points - low) * (scale, -scale))}" {look}/>' for points, look in drawn
    )
    room = ROOM * SIDE
    box = f"{-room:g} {-SIDE - room:g} {SIDE + 2 * room:g} {SIDE + 2 * room:g}"
    return f'<svg style="flex:none" width="{SIDE}" height="{SIDE}" viewBox="{box}">{paths}</svg>'


def _path(points: FloatArray) -> str:
    return "L".join(f"{x:.1f} {y:.1f}" for x, y in points.tolist())
