"""What the studio's workers compute: a table from the name of a question to the function for it.

A question is named by its kind, or kind/detail: "verdict", "limit/pitch", "export/png", "job/turn".
"""

import io
import tempfile
import zipfile
from collections.abc import Callable
from dataclasses import dataclass, field, fields
from functools import partial
from pathlib import Path
from typing import Any, get_args

import numpy as np

from benchdragon.analysis.check import check
from benchdragon.analysis.records import Record, answer_of, verdict_of
from benchdragon.errors import InputError
from benchdragon.export.tables import WRITERS, Selection
from benchdragon.i18n import _, language
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.source import Source
from benchdragon.plans.toml import parsed
from benchdragon.player.page import write_player
from benchdragon.player.scene import Span, is_long, judged_dance
from benchdragon.progress import Progress, part
from benchdragon.solve.head_speed import greatest_head_speed, slowed, with_pace
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, RISKS, Deviations, tolerance
from benchdragon.solve.turn import best_turn
from benchdragon.solve.turn_trials import TurnGoal
from benchdragon.studio import messages
from benchdragon.studio.limits import Settings, too_much

# Steps of an exported motion, s: the first that gives few enough places, times ten and so on.
EXPORT_STEPS = (1.0, 2.0, 5.0)
# How wide the bracket of a size may be, m, while its slider is dragged.
SIZE = 1e-5
# Looks between two frames of a dance that may change at once again, and times at which it is looked
# who is near whom.
FEW_SHARES, FEW_TIMES = (0.5,), 500
MEDIA = {
    "html": "text/html; charset=utf-8",
    "xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    "csv": "text/csv; charset=utf-8",
    "npz": "application/octet-stream",
    "parquet": "application/vnd.apache.parquet",
    "nc": "application/x-netcdf",
    "toml": "application/toml",
    "zip": "application/zip",
}
# What an export may be, without the encoding of its text.
EXPORTED = tuple(media.partition(";")[0] for kind, media in MEDIA.items() if kind != "toml")


@dataclass(frozen=True)
class TaskRequest:
    """A question put to a worker.

    Attributes:
        name: in TASKS.
        language: of all sentences.
        plan: what is asked about; None for "open".
        text: of the plan file, for "open".
        options: of a long question.
        settings: of the studio, for its limits.
    """

    name: str
    language: str
    settings: Settings
    plan: Plan | None = None
    text: str = ""
    options: messages.JobOptions = field(default_factory=messages.JobOptions)

    @property
    def whole(self) -> Plan:
        """The plan of a question that has one."""
        if self.plan is None:
            raise AssertionError("only a plan file is asked about without a plan")
        return self.plan


@dataclass(frozen=True)
class TaskResult:
    """What a worker made: bytes, their media type, and a file's name, if it is one."""

    data: bytes
    media: str = "application/json"
    name: str | None = None


def sent(found: Record) -> TaskResult:
    """An answer as JSON."""
    return TaskResult(found.model_dump_json(by_alias=True).encode())


def opened(request: TaskRequest, _progress: Progress) -> TaskResult:
    """The plan in the text of a plan file."""
    data = parsed(request.text, "plan")
    check_depth(data, request.settings.depth)
    plan = checked(data, Source("plan", request.text))
    check_plan(plan, request.settings)
    return sent(messages.OpenedPlan(plan=plan))


def written(request: TaskRequest, _progress: Progress) -> TaskResult:
    """The plan as a plan file."""
    return TaskResult(request.whole.toml().encode(), MEDIA["toml"], "dance.dragon.toml")


def judged(request: TaskRequest, _progress: Progress) -> TaskResult:
    """Whether the walk is safe."""
    return sent(verdict_of(check(request.whole, quick=True)))


def danced(request: TaskRequest, progress: Progress) -> TaskResult:
    """The dance as the player shows it."""
    plan = request.whole
    sketch = Span(*plan.span(plan.build()), shares=FEW_SHARES, times=FEW_TIMES)
    return sent(judged_dance(plan, partial(check, quick=True), sketch, progress))


def limited(name: str, request: TaskRequest, _progress: Progress) -> TaskResult:
    """How small or large one size may be."""
    return sent(answer_of(limit(request.whole, name, tolerance=SIZE), request.whole))


def check_depth(data: Any, most: int) -> None:
    """Refuse lists and tables nested deeper than `most`.

    Raises:
        InputError: if they are.
    """
    level: list[Any] = [[data]]
    depth = 0
    while level := [one for values in level for one in values if isinstance(one, dict | list)]:
        if depth == most:
            raise InputError(_("wanted brackets at most {most} deep").format(most=most))
        level = [list(at.values()) if isinstance(at, dict) else at for at in level]
        depth += 1


def check_plan(plan: Plan, settings: Settings) -> None:
    """Refuse a plan that asks for more than the studio bears.

    Raises:
        InputError: for the first thing that is too much.
    """
    limits = settings.plans
    own = plan.dragon.bench
    counts = {
        _("benches"): (
            sum(bench.count for bench in own) if own else plan.dragon.benches,
            limits.benches,
        ),
        _("kinds of benches"): (len(own), limits.benches),
        _("parts of a route"): (len(getattr(plan.route, "part", ())), limits.parts),
        _("points of a speed profile"): (len(plan.walk.profile), limits.profile),
    }
    for wanted, (count, most) in counts.items():
        if count > most:
            raise too_much(wanted, most, count)
    for number in _numbers(plan.model_dump(mode="python")):
        if number and not limits.smallest <= abs(number) <= limits.largest:
            raise InputError(
                _("the studio takes numbers from {least} to {most}, and 0, not {number}").format(
                    least=f"{limits.smallest:g}", most=f"{limits.largest:g}", number=f"{number:g}"
                )
            )


def _numbers(data: Any) -> list[float]:
    """All numbers in plain data."""
    if isinstance(data, dict):
        data = list(data.values())
    if isinstance(data, list | tuple):
        return [number for one in data for number in _numbers(one)]
    return [float(data)] if isinstance(data, int | float) else []


def export_times(plan: Plan, walk: Walk, places: int) -> FloatArray:
    """Times, s, of an exported motion: all along the walk, as far as the dragon can walk on.

    Raises:
        WalkError: if it cannot stand at the start.
    """
    start, end = plan.span(walk)
    most = max(2, places // (len(walk.dragon) + 1))
    step, decade = 1.0, 1.0
    while (end - start) / step + 1.0 > most:
        larger = [size * decade for size in EXPORT_STEPS if size * decade > step]
        decade *= 1.0 if larger else 10.0
        step = larger[0] if larger else decade
    times = np.append(np.arange(start, end, step), end)
    failed = np.concatenate([motion.status for motion in walk.motions(times, throw=False)]) != 0
    if failed[0]:
        walk.motion(times[:1])
    return times[: int(np.argmax(failed))] if failed.any() else times


def exported(name: str, request: TaskRequest, progress: Progress) -> TaskResult:
    """A table or the pictures of a dance, as a file."""
    plan = request.whole
    with tempfile.TemporaryDirectory() as folder:
        if name in {"png", "svg", "pdf"}:
            return TaskResult(
                _pictures(plan, name, Path(folder), request.settings), MEDIA["zip"], f"{name}.zip"
            )
        path = Path(folder) / name
        if name == "player.html":
            walk = plan.build()
            judge = partial(check, quick=is_long(walk, Span(*plan.span(walk))))
            write_player(path, judged_dance(plan, judge, progress=progress))
        elif name == "check.xlsx":
            from benchdragon.export.check_files import write_files

            write_files(check(plan), [path])
        else:
            walk = plan.build()
            times = export_times(plan, walk, request.settings.places)
            what = Selection(walk, times, range(len(walk.dragon) + 1))
            WRITERS[path.suffix[1:]](path, what, part(progress, 0.0, 1.0, name))
        return TaskResult(path.read_bytes(), MEDIA[path.suffix[1:]], name)


def _pictures(plan: Plan, kind: str, folder: Path, settings: Settings) -> bytes:
    """The pictures of a motion and of a check, zipped."""
    from benchdragon.export.check_files import write_files
    from benchdragon.figures.style import write_picture
    from benchdragon.figures.walk import walk_pictures

    walk, title = plan.build(), plan.title(language())
    times = export_times(plan, walk, settings.places)
    drawn = walk_pictures(walk, times, title, plan.disc.radius, obstacles=plan.obstacles())
    for name, figure in drawn.items():
        write_picture(figure, folder / f"{name}.{kind}", title, plan.sha256)
    if len(walk.dragon) > 2:
        write_files(check(plan), [folder / f"{name}.{kind}" for name in ("contact", "clearance")])
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as out:
        for path in sorted(folder.iterdir()):
            out.write(path, path.name)
    return packed.getvalue()


def best(request: TaskRequest, progress: Progress) -> TaskResult:
    """The best turn."""
    options, plan = request.options, request.whole
    goal = TurnGoal(
        options.objective,
        options.least_radius,
        options.longest or float("inf"),
        options.longest_way or float("inf"),
    )
    found = best_turn(plan, goal, progress=progress)
    speed, route = found.head_speed, plan.route
    before = route.turn(plan).way(route.disc(plan)) if isinstance(route, TurnRoute) else None
    return sent(
        messages.TurnFound(
            plan=found.plan,
            objective=answer_of(found.objective, plan),
            length=found.length,
            way=found.way,
            way_before=before,
            least_radius=found.turn.least_radius,
            head_speed=None if speed is None else answer_of(speed, plan),
            clearance=answer_of(found.clearance, plan),
            active=list(found.active),
        )
    )


def proved(request: TaskRequest, progress: Progress) -> TaskResult:
    """Whether the walk is safe, proved."""
    return sent(verdict_of(check(request.whole, progress, prove=True)))


def head_speed(request: TaskRequest, progress: Progress) -> TaskResult:
    """How fast the head may walk."""
    return sent(answer_of(greatest_head_speed(request.whole, progress=progress), request.whole))


def paced(request: TaskRequest, progress: Progress) -> TaskResult:
    """A pace that slows down only where it must."""
    plan = request.whole
    pace = slowed(plan, progress=progress)
    steady = answer_of(pace.steady, plan)
    slow = with_pace(plan, pace)
    return sent(messages.PaceFound(plan=slow, steady=steady, seconds=pace.seconds, saved=pace.saved))


def room_needed(request: TaskRequest, progress: Progress) -> TaskResult:
    """How much room imprecise people need; with no deviation given, those of all cases together."""
    options, plan = request.options, request.whole
    if options.draws > request.settings.draws:
        raise too_much(_("random dances"), request.settings.draws, options.draws)
    deviations = Deviations(
        **{field.name: getattr(options, field.name) for field in fields(Deviations)}
    )
    if deviations == Deviations():
        deviations = CASES["all"].deviations
    told = part(progress, 0.0, 1.0, _("random dances"))
    found = tolerance(plan, deviations, options.draws, seed=options.seed, own=True, progress=told)
    pitch = plan.value("route.pitch")
    chance, lower, upper = found.touching()
    pitches = [messages.PitchFor(risk=risk, pitch=found.pitch_for(risk)) for risk in RISKS]
    return sent(
        messages.MarginsFound(
            draws=options.draws, exact=found.exact, pitch=pitch, chance=chance, chance_lower=lower,
            chance_upper=upper, pitch_for=pitches,
        )
    )  # fmt: skip


TASKS: dict[str, Callable[[TaskRequest, Progress], TaskResult]] = {
    "open": opened,
    "toml": written,
    "verdict": judged,
    "dance": danced,
    **{f"limit/{name}": partial(limited, name) for name in get_args(messages.LimitName)},
    **{f"export/{name}": partial(exported, name) for name in get_args(messages.ExportName)},
    "job/turn": best,
    "job/prove": proved,
    "job/speed": head_speed,
    "job/pace": paced,
    "job/margins": room_needed,
}


def warm(kind: str, settings: Settings) -> None:
    """Dry answers of what a lane is asked most, so that the first asker need not wait."""
    coil = read_plan("spiral-in", ["dragon.benches=40", "disc.radius=4.5", "route.start_turn=10"])
    turn = read_plan("turn", ["dragon.benches=10", "walk.start=-5"])
    few = read_plan("spiral-in", ["dragon.benches=4", "disc.radius=4.5", "route.start_turn=9"])
    asked = {
        "quick": [("verdict", coil), ("verdict", turn), ("limit/pitch", coil), ("dance", coil)],
        "files": [("export/png", few)],
        "jobs": [("job/speed", turn)],
    }
    for name, plan in asked[kind]:
        TASKS[name](TaskRequest(name, "en", settings, plan), lambda _share, _text: None)
