"""The paper's way to the smallest pitch: stepped pitches and times, and its picture over the pitch."""

import itertools
import math
import time as clock
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.contact import first_contact
from benchdragon.errors import of_kind, positive
from benchdragon.i18n import _
from benchdragon.kernels.box import least_distance
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import Answer
from benchdragon.model.curves import Spiral
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import SpiralInRoute
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import PlanError
from benchdragon.progress import Progress, silent
from benchdragon.solve.size import MOST_COUNT
from benchdragon.solve.size_family import QUESTIONS, PlanFamily

# Angles that differ by more than this from one pitch to the next, rad, are a jump and not a slope.
JUMP = 0.5


def traversed_pitch(
    plan: Plan, pitch_step: float, time_step: float, *, first: float | None = None,
    progress: Progress = silent,
) -> Answer:  # fmt: skip
    """The smallest pitch as the paper finds it: pitches in steps, a flag at times in steps.

    The flag rises when the gap of any two non-adjacent benches is negative at a time that is sampled,
    the last always among them; contact between two times, or a pitch between two steps, is not seen. So
    the answer is "undecided" and depends on both steps (m and s): compare `smallest_pitch`.

    Args:
        plan: the rest of the walk.
        pitch_step: pitches tried are its multiples, m.
        time_step: s.
        first: where the traversal begins, m; None: at four fifths of the plan's pitch.
        progress: is called with the share done and the value being tried.

    Raises:
        InputError: for steps that are not positive, or a plan without a pitch.

    Examples:
        >>> plan = bd.read_plan("question-3")
        >>> found = bd.traversed_pitch(plan, 0.01, 5.0)
        >>> found.status, f"{found.value:.2f} m", f"{plan.smallest_pitch().value:.6f} m"
        ('undecided', '0.45 m', '0.450337 m')
    """
    began = clock.perf_counter()
    of_kind("plan", plan, Plan)
    positive("pitch_step", pitch_step, "m")
    positive("time_step", time_step, "s")
    family = PlanFamily(plan, QUESTIONS["pitch"], 0.0)
    n = math.ceil((0.8 * plan.value("route.pitch") if first is None else first) / pitch_step - 1e-9)
    evaluations = 0
    for tried in range(n, n + MOST_COUNT):
        pitch = tried * pitch_step
        progress(0.0, f"{pitch:.9g} m")
        walk, start, end = family.walk(pitch)
        times = np.append(np.arange(start, end, time_step), end)
        evaluations += len(times)
        if first_overlap(walk, times[::-1]) is None:
            break
    return Answer(
        pitch, pitch - pitch_step, pitch, "m", "undecided", None,
        (
            _("pitches in steps of {step} m").format(step=f"{pitch_step:g}"),
            _("contact checked every {step} s").format(step=f"{time_step:g}"),
        ),
        evaluations, clock.perf_counter() - began,
    )  # fmt: skip


def first_overlap(walk: Walk | Plan, times: npt.ArrayLike) -> float | None:
    """The first in the list `times` at which two non-adjacent benches overlap; None if there is none.

    The paper's flag: the separating axis theorem at each time, and nothing known of what lies between.
    Compare `first_contact`, which misses nothing.

    Args:
        walk: what moves, or a plan of it.
        times: s, (T,), in the order in which they are tried.

    Raises:
        InputError: for what is neither, and times that are none.
        WalkError: if the dragon cannot stand at a time.

    Examples:
        >>> plan = bd.read_plan("spiral-in")
        >>> bd.first_overlap(plan, np.arange(400.0, 430.0))
        413.0
    """
    walk, _start, _end = asked_of(walk, 0.0, 0.0)
    for motion in walk.motions(times):
        for n, t in enumerate(motion.times):
            x, y = (np.ascontiguousarray(table[n, :, np.newaxis]) for table in (motion.x, motion.y))
            if least_distance(walk.dragon.sizes, x, y) < 0.0:
                return float(t)
    return None


@dataclass(frozen=True)
class PitchCurve:
    """What the paper draws over the pitch: angles about the spiral's centre, rad, (P,) each.

    Attributes:
        pitch: m.
        disc_angle: of the place where the spiral meets the disc.
        least_angle: the least that the head reaches, coming in, before two benches touch.
    """

    pitch: FloatArray
    disc_angle: FloatArray
    least_angle: FloatArray


def pitch_curve(
    plan: Plan, pitches: npt.ArrayLike, *, resolution: float = math.inf, progress: Progress = silent
) -> PitchCurve:
    """The two angles of the paper's Fig 2 at given pitches, m, for a spiral-in plan with a disc.

    Where the least angle jumps from one pitch to the next, pitches between are added until the two
    sides of the jump are at most `resolution` metres apart.

    Raises:
        PlanError: for another kind of route, or no disc.
    """
    radius = plan.value("disc.radius")
    if not isinstance(plan.route, SpiralInRoute):
        raise PlanError(_("this picture is for plans whose route.kind is spiral-in"))
    inward = plan.model_copy(update={"disc": plan.disc.model_copy(update={"radius": None})})
    family = PlanFamily(inward, QUESTIONS["pitch"], plan.limits.margin)
    least: dict[float, float] = {}
    wanted = np.unique(np.asarray(pitches, dtype=np.float64)).tolist()
    while wanted:
        for pitch in wanted:
            progress(0.0, f"{pitch:.9g} m")
            least[pitch] = _least_angle(family, pitch)
        known = sorted(least)
        wanted = [
            0.5 * (a + b)
            for a, b in itertools.pairwise(known)
            if abs(least[a] - least[b]) > JUMP and b - a > resolution
        ]
    sizes = np.array(sorted(least))
    angles = np.array([least[pitch] for pitch in sizes.tolist()])
    return PitchCurve(sizes, 2.0 * math.pi * radius / sizes, angles)


def _least_angle(family: PlanFamily, pitch: float) -> float:
    """The spiral angle of the head at first contact, rad, or at the route's end."""
    walk, start, end = family.walk(pitch)
    contact = first_contact(walk, start, end, margin=family.margin)
    s = walk.route.length if contact is None else float(walk.head_position([contact.upper])[0])
    spiral = walk.route.curves[0]
    return float(spiral.angle(s)) if isinstance(spiral, Spiral) else math.nan
