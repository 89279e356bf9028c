"""A dance as a page shows it: frames, route, sizes, what happens when, what is tight."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from benchdragon import budget
from benchdragon.analysis.beats import score_of
from benchdragon.analysis.check import Report
from benchdragon.analysis.entrances import edge_left
from benchdragon.analysis.findings import shown_name
from benchdragon.analysis.records import Verdict, untimed, verdict_of, verdict_of_fall
from benchdragon.analysis.swept import drawn_ground
from benchdragon.errors import InputError, WalkError, finite
from benchdragon.i18n import Words, _, both
from benchdragon.kernels.bench_nearness import see_near
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.following import FINE, NodeStretch, Tables
from benchdragon.kernels.frames import QUANTUM
from benchdragon.model.arrays import as_table
from benchdragon.model.dragon import Dragon
from benchdragon.model.obstacle import Obstacle
from benchdragon.model.walk import Walk
from benchdragon.plans.people import village
from benchdragon.plans.schema import Plan
from benchdragon.player import messages
from benchdragon.player.following import Following, following
from benchdragon.player.frames import (
    SHARES,
    Course,
    Frames,
    course,
    frames,
    packed_bytes,
    packed_frames,
)
from benchdragon.player.occasions import cued, ending, joints_passed, occasions_found, tighten
from benchdragon.progress import Progress, silent, stages
from benchdragon.version import __version__

# What a page may show off its place, m.
MOST_ERROR = 1e-3
# Reach of the search for nearest benches, m; greatest numbers of its times, and of places.
REACH = 1.0
MOST_TIMES, MOST_DISTANCES = 1500, 3_000_000
# Route drawn before the tail and past the head, m.
AROUND = 5.0
MOST_BENCHES = 5_000
# Benches times seconds above which a dance is long: frames of all handles would take tens of seconds to
# find, and from three times as much on would not fit a page at all.
LONG = 500_000


@dataclass(frozen=True)
class Span:
    """What part of a walk is shown, and how carefully.

    Attributes:
        start: s.
        end: s.
        most_error: how far a place may be off between frames, m.
        shares: of the samples between two frames, as shares of a step.
        times: greatest number of times at which nearest benches are sought.
    """

    start: float
    end: float
    most_error: float = MOST_ERROR
    shares: tuple[float, ...] = SHARES
    times: int = MOST_TIMES

    def __post_init__(self) -> None:
        if finite("start", self.start, "s") >= finite("end", self.end, "s"):
            text = _("the dance would end at {end} s, and must end after its start at {start} s")
            raise InputError(text.format(end=f"{self.end:g}", start=f"{self.start:g}"))


def is_long(walk: Walk, span: Span) -> bool:
    """Whether a dance is long: its page gets tables of how handles follow."""
    return len(walk.dragon) * (span.end - span.start) > LONG


@budget.question()
def checked_dance(
    report: Report, span: Span | None = None, progress: Progress = silent
) -> messages.Dance:
    """The dance of a plan that was checked, with what the check found.

    Raises:
        InputError: for more than MOST_BENCHES, or more frames than a page holds.
        WalkError: if the dragon does not stand at the start.
    """
    plan = report.plan
    shown = span or Span(report.start, report.end)
    dance = plain_dance(report.walk, shown, progress)
    last = dance.frames.start + dance.frames.step * (dance.frames.count - 1)
    verdict, limits = untimed(verdict_of(report)), plan.limits
    seen = occasions_found(verdict, plan.obstacles(), limits.margin, limits.speed)
    found = [one for one in seen if shown.start <= one.time <= last]
    tighten(dance.nearest, verdict.clearance, shown.start, last)
    ground = drawn_ground(report.walk, shown.start, last) if report.obstacles else ()
    return _of_plan(plan, dance, verdict, found).model_copy(
        update={"ground": [_rounded(ring) for ring in ground]}
    )


@budget.question()
def judged_dance(
    plan: Plan, judge: Callable[[Plan], Report], span: Span | None = None, progress: Progress = silent
) -> messages.Dance:
    """The dance of a plan, judged; one that cannot be walked to its end as far as it can.

    Raises:
        InputError: see `checked_dance`.
        WalkError: if the dragon does not stand at the start.
    """
    try:
        report = judge(plan)
    except WalkError as error:
        walk = plan.build()
        whole = plan.span(walk)
        dance = plain_dance(walk, span or Span(*whole), progress)
        return _of_plan(plan, dance, verdict_of_fall(plan, whole, error), [])
    return checked_dance(report, span, progress)


def _of_plan(
    plan: Plan, dance: messages.Dance, verdict: Verdict, found: list[messages.Occasion]
) -> messages.Dance:
    """A dance with what its plan says, and what was found."""
    told, frames = village(plan.people, len(dance.benches.length)), dance.frames
    last = frames.start + frames.step * (frames.count - 1)
    return dance.model_copy(
        update={
            "plan_sha256": plan.sha256,
            "title": Words(en=plan.title("en"), zh=plan.title("zh")),
            "disc": plan.disc.radius,
            "margin": plan.limits.margin,
            "speed_limit": plan.limits.speed,
            "obstacles": [_drawn(obstacle, plan) for obstacle in plan.obstacles()],
            "verdict": verdict,
            "occasions": sorted(
                [*found, *dance.occasions, *cued(plan.moments(), frames.start, last)],
                key=lambda occasion: occasion.time,
            ),
            "beats": _beats(plan),
            "papers": _papers(plan),
            "village": told and messages.Village(**vars(told)),
            "north": plan.survey.north,
            "entrances": plan.event.entrances,
        }
    )


def _beats(plan: Plan) -> messages.Beats | None:
    """The drum of a plan with cues."""
    if "cues" not in plan.own():
        return None
    score = score_of(plan, *plan.span(plan.build()))
    runs = [messages.Run(**run._asdict()) for run in score.runs]
    return messages.Beats(tempo=score.tempo, runs=runs, strokes=list(score.strokes))


def _papers(plan: Plan) -> messages.Papers | None:
    """How the papers of a plan with people or cues tell times."""
    if not {"people", "cues"} & plan.own().keys():
        return None
    return messages.Papers(said=plan.cues.clock, start=plan.span(plan.build())[0])


def _drawn(obstacle: Obstacle, plan: Plan) -> messages.DrawnObstacle:
    """An obstacle of a plan as a page draws it, to a tenth of a millimetre."""
    return messages.DrawnObstacle(
        name=both(lambda: shown_name(obstacle)),
        kind=obstacle.kind,
        points=_rounded(obstacle.outline),
        radius=obstacle.radius,
        margin=obstacle.margin,
        open=[] if obstacle.open is None else _rounded(obstacle.open),
        left=[_rounded(as_table(line)) for line in edge_left(plan)] if obstacle.kind == "venue" else [],
    )


def _rounded(points: FloatArray) -> list[tuple[float, float]]:
    return [(x, y) for x, y in np.round(points, 4).tolist()]


@budget.question()
def plain_dance(walk: Walk, span: Span, progress: Progress = silent) -> messages.Dance:
    """The dance of a walk: its only occasions are joints, and an end where the benches cannot follow.

    Raises:
        InputError: see `checked_dance`.
    """
    if len(walk.dragon) > MOST_BENCHES:
        text = _("a player shows at most {most} benches, not {count}")
        raise InputError(text.format(most=MOST_BENCHES, count=len(walk.dragon)))
    stage = stages(progress, 4)
    stage(_("computing positions"))
    shot, behind = _shot(walk, span)
    stage(_("finding benches near one another"))
    nearest, tightness = _nearness(walk, shot, span.times)
    stage(_("drawing the route"))
    way = _way(walk, shot)
    stage(_("packing"))
    return messages.Dance(
        version=__version__,
        plan_sha256="",
        title=Words(en="", zh=""),
        benches=_sizes(walk.dragon),
        disc=None,
        centre=walk.route.centre,
        course=_course(way),
        frames=messages.Frames(
            start=shot.start, step=shot.step, count=shot.count, quantum=QUANTUM,
            packed=packed_frames(shot), largest_error=shot.error + way.error, everywhere=True,
        ),
        following=None if behind is None else _following(behind),
        occasions=[*_joints(walk, shot, behind), *([ending(shot.end)] if shot.leap else [])],
        nearest=nearest,
        tightness=tightness,
        margin=0.0,
        speed_limit=None,
        obstacles=[],
        ground=[],
        verdict=None,
    )  # fmt: skip


def _shot(walk: Walk, span: Span) -> tuple[Frames, Following | None]:
    """Frames of all handles; of a long dance, if possible, the head's, and how all follow."""
    most = 0.9 * span.most_error
    if is_long(walk, span):
        found = following(walk, span.start, span.end, most, span.shares)
        if found is not None:
            return found.head, found
    return frames(walk, span.start, span.end, most, span.shares), None


def _following(found: Following) -> messages.Following:
    """How handles follow, as a page takes it."""
    tables, ends = found.tables, found.tables.ends.tolist()
    stretches = [tables.stretches[a:b] for a, b in pairwise([0, *ends])]
    return messages.Following(
        tables=[
            messages.FollowTable(
                link=link,
                stretches=_stretches(rows),
                fine=FINE,
                packed=packed_bytes(_nodes(tables, rows)),
            )
            for link, rows in zip(tables.links.tolist(), stretches, strict=True)
        ],
        kinds=tables.kinds.tolist(),
        fastest=np.round(found.fastest, 4).tolist(),
        when=np.round(found.when, 2).tolist(),
        speeds=found.speeds,
        change=found.change,
    )


def _nodes(tables: Tables, stretches: FloatArray) -> npt.NDArray[np.int32]:
    """The nodes of some stretches: ways, then their changes."""
    first, last = (
        int(stretches[0, NodeStretch.FIRST]),
        int(stretches[-1, NodeStretch.FIRST] + stretches[-1, NodeStretch.NODES]),
    )
    return tables.nodes[:, first:last].ravel().astype("<i4")


def _stretches(rows: FloatArray) -> list[messages.Stretch]:
    """The stretches of nodes that are evenly spaced."""
    return [messages.Stretch(start=a, step=b, nodes=int(n)) for a, b, _first, n in rows.tolist()]


def _sizes(dragon: Dragon) -> messages.Sizes:
    """The sizes of all benches, to a micrometre."""
    names = messages.Sizes.model_fields
    return messages.Sizes(**{name: np.round(getattr(dragon, name), 6).tolist() for name in names})


def _way(walk: Walk, shot: Frames) -> Course:
    """The route that is walked on in the frames, and somewhat more of it."""
    low = float(walk.motion([shot.start]).s.min())
    high = float(shot.places.max()) * QUANTUM
    return course(walk, max(low - AROUND, -walk.route.extension), min(high + AROUND, walk.route.length))


def _course(way: Course) -> messages.Course:
    """The route as a page takes it."""
    return messages.Course(
        stretches=_stretches(way.stretches), origin=way.origin, packed=packed_bytes(way.nodes.ravel())
    )


def _nearness(walk: Walk, shot: Frames, most: int) -> tuple[messages.Nearest, messages.Tightness]:
    """Each bench's tightest moment, and the tightest pair over time, at evenly spread times."""
    benches = len(walk.dragon)
    walked = QUANTUM * float(shot.places[0, -1] - shot.places[0, 0])
    wanted = 4.0 * max(walked, shot.end - shot.start, 0.5)  # a sample each 0.25 m, and each 0.25 s
    count = int(min(most, max(2, MOST_DISTANCES // benches), wanted))
    times = np.linspace(shot.start, shot.end, count)
    table, over_time = np.tile([np.inf, 0.0, 0.0], (benches, 1)), []
    for motion in walk.motions(times, throw=False):
        x, y = np.ascontiguousarray(motion.x.T), np.ascontiguousarray(motion.y.T)
        least = np.empty(len(motion.times))
        see_near(walk.dragon.sizes, x, y, motion.times, REACH, table, least)
        over_time.append(least)
    near, when, other = table.T
    nearest = messages.Nearest(
        reach=REACH,
        distance=np.where(np.isfinite(near), np.round(near, 5), 0.0).tolist(),
        time=np.round(when, 4).tolist(),
        other=other.astype(int).tolist(),
    )
    distance = np.round(np.concatenate(over_time), 4).tolist()
    return nearest, messages.Tightness(
        start=shot.start, step=float(times[1] - times[0]), distance=distance
    )


def _joints(walk: Walk, shot: Frames, behind: Following | None) -> list[messages.Occasion]:
    """When head and tail pass the joints of the route."""
    if behind is not None:
        return joints_passed(walk.route.joints[1:-1], behind.times, behind.ends)
    times = shot.start + shot.step * np.arange(shot.count, dtype=float)
    return joints_passed(walk.route.joints[1:-1], times, shot.places[[0, -1]].astype(float) * QUANTUM)
