"""The paper again, as numbers: what its report, tables and pictures are made from."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from benchdragon.analysis.check import Report, check, clearance_over, moment
from benchdragon.analysis.contact import ClearanceCurve, contact_windows, first_contact
from benchdragon.errors import UnsureError
from benchdragon.i18n import _, language, use_language
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import Answer
from benchdragon.model.turns import Turn, TwoArcTurn
from benchdragon.model.walk import Motion, Walk
from benchdragon.number_format import finite_or_none
from benchdragon.paper.claims import Equation, equations
from benchdragon.paper.convergence import (
    Convergence,
    accumulated,
    bisected,
    chord_residuals,
    difference_convergence,
    runge_kutta_convergence,
)
from benchdragon.paper.differences import SCHEMES, difference_errors, difference_speeds
from benchdragon.paper.random_dances import Run, kept_run, walked_again
from benchdragon.paper.runge_kutta import head_positions
from benchdragon.paper.sensitivity import contact_rates, limit_rates, sizes_of, speed_rates
from benchdragon.paper.traversal import PitchCurve, first_overlap, pitch_curve, traversed_pitch
from benchdragon.parallel import processes
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.progress import Progress, silent, stages
from benchdragon.solve.head_speed import greatest_head_speed
from benchdragon.solve.size import limit, smallest_pitch
from benchdragon.solve.tolerance import CASES
from benchdragon.solve.turn import BestTurn, pareto_front, undominated
from benchdragon.solve.turn_goal import TurnGoal
from benchdragon.version import __version__

# The contest's own times and handles.
TABLE_TIMES = (0.0, 60.0, 120.0, 180.0, 240.0, 300.0)
TABLE_HANDLES = (0, 1, 51, 101, 151, 201, 223)
# The contest's times of the turn's table.
MOTION_TIMES = (-100.0, -50.0, 0.0, 14.0, 50.0, 100.0)
# Where velocities are taken from differences, s, and the step whose errors are reported.
DIFFERENCE_TIMES = np.arange(10.0, 291.0, 10.0)
SHORT_STEP = 0.1

# Steps of the paper's traversal whose answers are compared, pitch (m) and time (s), and the first pitch
# tried; the last evaluates only the moment at which the head reaches the disc.
TRAVERSALS = (
    (0.02, 1.0, 0.42), (0.01, 1.0, 0.42), (0.005, 1.0, 0.42), (0.004, 1.0, 0.44), (0.002, 1.0, 0.44),
    (0.001, 1.0, 0.44), (0.0005, 1.0, 0.44), (0.002, 0.2, 0.44), (0.001, 1e6, 0.41),
)  # fmt: skip
# Steps of a search that samples times, s.
CONTACT_STEPS = (10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02)
# How long these go on: until the dragon overlaps for good, s.
STEPPED_UNTIL = 430.0
# Pitches of the paper's Fig 2, m.
FIGURE_PITCHES, FIGURE_RESOLUTION = (0.43, 0.47, 21), 5e-4
# Head speeds, m/s, for which the shortest turn is sought, and the one of them whose turn is shown
# beside the paper's; bends are no tighter than the paper's.
FRONT_SPEEDS = tuple(round(1.26 + 0.02 * n, 2) for n in range(24))
TOLD_SPEED = 1.3
# Radius, m, at which joints of the paper's two arcs lie deeper than on the disc's edge.
DEEPER = 4.4
# Random dances of each case that are walked again; steps, m, of the differences beside derivatives.
AGAIN = 5
DIFFERENCE_STEP = 1e-4

# Stages of `results`.
STEPS = 11


@dataclass(frozen=True)
class Rate:
    """How an answer moves with a size of the plan, per metre (or per unit of a plain number).

    Attributes:
        key: the size, as in a plan.
        exact: from derivatives.
        difference: from two answers with the size a little smaller and larger.
    """

    key: str
    exact: float
    difference: float


@dataclass(frozen=True)
class Results:
    """What the paper's parts come to.

    Attributes:
        spiral: plan of the first part; disc: the same down to the disc; turn: plan of the second part.
        motion: of the first part, each second; turn_motion: of the second, each tenth of a second.
        report: of the first part: first contact; turn_report: of the second.
        clearance: of the first part, over time.
        deeper: of the second part with joints at DEEPER.
        head_speed: the greatest in the second part; smallest: the smallest pitch.
        front: for each of FRONT_SPEEDS the shortest turn that was found to allow it.
        curve: angles over the pitch, the paper's Fig 2.
        traversal: (pitch step, m; time step, s; answer), stepped: (time step, s; contact seen, s).
        windows: spans of time in which benches touch, s, of the walk as far as STEPPED_UNTIL.
        head_order: of Runge-Kutta, speed_orders: of each difference formula.
        head_errors: of the head's place, m, by step of each method beside the closed form.
        speed_error: of the head's speed from forward differences a second apart, m/s.
        off, off_bisected: how far handles are from their exact places, m; residuals: of chords, m.
        rates: how answers move with sizes, by name of the answer.
        dances: random dances, kept with the program.
        again: how far those that were walked again now lie from what is kept, at most, m.
        equations: the paper's, tried.
    """

    spiral: Plan
    disc: Plan
    turn: Plan
    motion: Motion
    turn_motion: Motion
    report: Report
    clearance: ClearanceCurve
    turn_report: Report
    deeper: Report
    head_speed: Answer
    smallest: Answer
    front: Sequence[BestTurn]
    curve: PitchCurve
    traversal: Sequence[tuple[float, float, Answer]]
    stepped: Sequence[tuple[float, float]]
    windows: Sequence[tuple[float, float]]
    head_order: Convergence
    speed_orders: dict[str, Convergence]
    head_errors: dict[str, float]
    speed_error: float
    off: FloatArray
    off_bisected: FloatArray
    residuals: FloatArray
    rates: dict[str, list[Rate]]
    dances: Run
    again: float
    equations: Sequence[Equation]

    @property
    def two_arcs(self) -> TwoArcTurn:
        """The paper's turn."""
        return TwoArcTurn(
            self.turn.value("route.pitch"), TurnRoute.disc(self.turn), self.turn.turn.ratio
        )

    @property
    def deeper_turn(self) -> Turn:
        """The paper's two arcs with joints at DEEPER."""
        return self.deeper.plan.turn.build(self.turn.value("route.pitch"), TurnRoute.disc(self.turn))

    @property
    def different(self) -> list[BestTurn]:
        """The turns of the front, each once: one may serve several speeds."""
        return list({id(best.turn): best for best in self.front}.values())

    @property
    def told(self) -> int:
        """The turn of the front that is shown beside the paper's."""
        speeds = [best.plan.walk.speed for best in self.front]
        return int(np.argmin(np.abs(np.array(speeds) - TOLD_SPEED)))

    @property
    def turn_greatest_at(self) -> float:
        """When the greatest speed ratio of the second part occurs, s."""
        witness = self.head_speed.witness
        if witness is None or witness.time is None:
            raise AssertionError("the greatest head speed has a moment")
        return witness.time

    @property
    def before_disc(self) -> float | None:
        """How far before the disc the pair that decides the smallest pitch touches, m."""
        witness = self.smallest.witness
        walk = self.disc.with_value("route.pitch", self.smallest.value).build()
        return None if witness is None else walk.route.length - witness.s


def results(progress: Progress = silent) -> Results:
    """Walk the paper's two parts, search, try, draw: a minute or two on two cores.

    The searches for better turns run beside the rest in processes of their own; so a script that calls
    this does so under `if __name__ == "__main__":`.
    """
    stage = stages(progress, STEPS)
    spiral, turn = read_plan("spiral-in"), read_plan("turn")
    disc = read_plan("spiral-in", [f"disc.radius={turn.disc.radius}"])
    prove = find_spec("flint") is not None
    with searched(turn, FRONT_SPEEDS) as better:
        stage(_("walking"))
        walk = spiral.build()
        motion = walk.motion(np.arange(301.0))
        turn_motion = turn.build().motion(np.linspace(-100.0, 100.0, 2001))
        stage(_("Runge-Kutta and differences"))
        head_order = runge_kutta_convergence(walk)
        speed_orders = difference_convergence(walk, DIFFERENCE_TIMES)
        still = walk.motion([300.0])
        stage(_("first contact"))
        report = check(spiral, prove=prove)
        clearance = clearance_over(report)
        stage(_("smallest pitch"))
        smallest = limit(disc, "pitch", prove=prove)
        stage(_("turn"))
        turn_report = check(turn)
        deeper = check(turn.with_table("turn", entry_radius=DEEPER, exit_radius=DEEPER))
        head_speed = greatest_head_speed(turn, tolerance=1e-12)
        stage(_("traversal of pitches"))
        traversal = [(p, t, traversed_pitch(disc, p, t, first=first)) for p, t, first in TRAVERSALS]
        stepped = stepped_contacts(walk, motion.times[0], report)
        windows = windows_of(walk, motion.times[0])
        stage(_("angles over the pitch"))
        curve = figure_curve(disc, smallest.value)
        stage(_("derivatives"))
        rates = all_rates(spiral, disc, turn, report, smallest, head_speed)
        stage(_("random dances"))
        dances = kept_run()
        again = walked_again(dances, AGAIN)
        stage(_("better turns"))
        front = undominated(better())
    stage(_("equations"))
    return Results(
        spiral, disc, turn, motion, turn_motion, report, clearance, turn_report, deeper,
        head_speed, smallest, front, curve, traversal, stepped, windows, head_order, speed_orders,
        head_errors(walk, motion.times), speed_error(walk), accumulated(still), bisected(still),
        chord_residuals(motion), rates, dances, again, equations(turn),
    )  # fmt: skip


@contextmanager
def searched(plan: Plan, speeds: Sequence[float]) -> Iterator[Callable[[], list[BestTurn]]]:
    """What gives `better_turns`, of the slower speeds and the faster ones in a process each.

    These end when the block is left in haste, or with this process, however that ends.

    Raises:
        UnsureError: from what the block gets, if a process died.
    """
    middle, spoken = len(speeds) // 2, language()
    with processes(2).opened() as executor:
        halves = [half for half in (speeds[:middle], speeds[middle:]) if half]
        searches = [executor.submit(better_turns, plan, half, spoken) for half in halves]

        def found() -> list[BestTurn]:
            try:
                return [best for search in searches for best in search.result()]
            except BrokenExecutor:
                text = _("the search for better turns died; is there enough memory?")
                raise UnsureError(text) from None

        yield found


def better_turns(plan: Plan, speeds: Sequence[float], spoken: str) -> list[BestTurn]:
    """Shortest turns with a line between the arcs, for each head speed (m/s), in a language."""
    use_language(spoken)
    goal = TurnGoal("way", least_radius=TwoArcTurn(plan.value("route.pitch")).radii[1])
    return pareto_front(plan.with_table("turn", family="arc-line-arc"), speeds, goal)


def head_errors(walk: Walk, times: FloatArray) -> dict[str, float]:
    """How far the two Runge-Kutta roads to the head differ from the closed form at most, m."""
    exact = walk.head_position(times)
    return {
        "rk4_step_0.1_s_m": _largest(head_positions(walk, times, "rk4", SHORT_STEP) - exact),
        "adaptive_m": _largest(head_positions(walk, times, "adaptive") - exact),
    }


def speed_error(walk: Walk) -> float:
    """How far the head's speed from forward differences a second apart is off at most, m/s."""
    head = difference_speeds(walk, DIFFERENCE_TIMES, 1.0, "forward")[:, 0]
    return _largest(head - walk.profile.speed(DIFFERENCE_TIMES))


def stepped_contacts(walk: Walk, start: float, report: Report) -> list[tuple[float, float]]:
    """The answer of a search that samples times, for each of CONTACT_STEPS."""
    until = (
        report.end if report.first_contact is None else report.first_contact.upper + CONTACT_STEPS[0]
    )
    found = []
    for step in CONTACT_STEPS:
        seen = first_overlap(walk, np.arange(start, until, step))
        if seen is not None:
            found.append((step, seen))
    return found


def windows_of(walk: Walk, start: float) -> list[tuple[float, float]]:
    """Spans of time in which benches touch, s, until STEPPED_UNTIL."""
    return [
        (window.opens.value, STEPPED_UNTIL if window.closes is None else window.closes.value)
        for window in contact_windows(walk, start, STEPPED_UNTIL)
    ]


def figure_curve(disc: Plan, smallest: float) -> PitchCurve:
    """The paper's Fig 2, with both sides of the smallest pitch."""
    low, high, count = FIGURE_PITCHES
    near = [smallest - 1e-9, smallest + 1e-9]
    pitches = np.concatenate([np.linspace(low, high, count), near])
    return pitch_curve(disc, pitches, resolution=FIGURE_RESOLUTION)


def all_rates(
    spiral: Plan, disc: Plan, turn: Plan, report: Report, smallest: Answer, head_speed: Answer
) -> dict[str, list[Rate]]:
    """How first contact, smallest pitch and greatest head speed move with each size."""

    def contact(plan: Plan) -> float:
        walk = plan.build()
        found = first_contact(walk, *plan.span(walk))
        return np.nan if found is None else found.value

    def speed(plan: Plan) -> float:
        return greatest_head_speed(plan, tolerance=1e-11).value

    if report.first_contact is None:
        raise AssertionError("the contest's dragon touches")
    return {
        "first_contact": _rates(spiral, contact_rates(spiral, report.first_contact), contact),
        "smallest_pitch": _rates(
            disc, limit_rates(disc, "pitch", smallest), lambda plan: smallest_pitch(plan).value
        ),
        "greatest_head_speed": _rates(turn, speed_rates(turn, head_speed), speed),
    }


def _rates(plan: Plan, exact: dict[str, float], answer: Callable[[Plan], float]) -> list[Rate]:
    rates = []
    for key in sizes_of(plan):
        if key not in exact:
            continue
        sizes = [plan.value(key) + side * DIFFERENCE_STEP for side in (-1.0, 1.0)]
        low, high = (answer(plan.with_value(key, size)) for size in sizes)
        rates.append(Rate(key, exact[key], (high - low) / (sizes[1] - sizes[0])))
    return rates


def _largest(values: FloatArray) -> float:
    return float(np.abs(values).max())


def table(motion: Motion, times: Sequence[float]) -> list[dict[str, float]]:
    """The contest's table: so many of the motion's times by seven handles, x, y (m), speed (m/s)."""
    return [
        {
            "time_s": t,
            "handle": handle,
            "x_m": float(motion.x[row, handle]),
            "y_m": float(motion.y[row, handle]),
            "speed_m_s": float(motion.speed[row, handle]),
        }
        for t, row in ((t, int(np.searchsorted(motion.times, t))) for t in times)
        for handle in TABLE_HANDLES
    ]


def as_json(found: Results) -> dict[str, Any]:
    """All answers as plain data, in SI units."""
    two_arcs, touch = found.two_arcs, moment(found.report)
    names = ("theta_max1", "theta_min1", "theta_min2", "theta_max2")
    return {
        "version": __version__,
        "plans": {name: getattr(found, name).sha256 for name in ("spiral", "disc", "turn")},
        "table": table(found.motion, TABLE_TIMES),
        "largest_chord_error_m": max(found.motion.chord_error, found.turn_motion.chord_error),
        "runge_kutta": {**found.head_errors, "rk4_order": found.head_order.order},
        "differences": {scheme: _difference(found, scheme) for scheme in SCHEMES},
        "contact": {
            "first": touch[1].as_json(),
            "table": table(touch[0], touch[0].times.tolist()),
            "windows_s": [list(window) for window in found.windows],
            "stepped": [{"time_step_s": step, "time_s": seen} for step, seen in found.stepped],
        },
        "pitch": {
            "smallest": found.smallest.as_json(),
            "before_disc_m": found.before_disc,
            "traversal": [
                {"pitch_step_m": p, "time_step_s": t, "pitch_m": answer.value}
                for p, t, answer in found.traversal
            ],
        },
        "turn": {
            "radii_m": list(two_arcs.radii),
            "length_m": two_arcs.length,
            **dict(zip(names, two_arcs.boundary_angles(), strict=True)),
            "table": table(found.turn_motion, MOTION_TIMES),
            "greatest_head_speed": found.head_speed.as_json(),
            "clearance": found.turn_report.clearance.as_json(),
            "deeper_joints": _deeper(found),
            "better": [best.as_json() for best in found.front],
        },
        "errors_along_the_dragon_m": {
            "here": found.off.tolist(), "bisected": found.off_bisected.tolist(),
        },
        "rates": {name: [vars(rate) for rate in rates] for name, rates in found.rates.items()},
        "margins": {name: _margin(found.dances, name) for name in CASES},
        "equations": [vars(equation) for equation in found.equations],
    }  # fmt: skip


def _deeper(found: Results) -> dict[str, Any]:
    turn = found.deeper_turn
    return {
        "joints_m": DEEPER,
        "length_m": turn.length,
        "way_m": turn.way(TurnRoute.disc(found.turn)),
        "clearance": found.deeper.clearance.as_json(),
    }


def _difference(found: Results, scheme: Any) -> dict[str, float]:
    walk = found.motion.walk
    head = difference_speeds(walk, DIFFERENCE_TIMES, 1.0, scheme)[:, 0]
    errors = difference_errors(walk, DIFFERENCE_TIMES, [SHORT_STEP], scheme)
    return {
        "head_speed_m_s": float(head.mean()),
        "head_speed_error_m_s": _largest(head - 1.0),
        "largest_velocity_error_step_0.1_s_m_s": float(errors[0]),
        "order": found.speed_orders[scheme].order,
    }


def _margin(run: Run, name: str) -> dict[str, Any]:
    one, vouched = run.tolerance(name), run.vouched[name]
    return {
        "deviations_m": vars(one.deviations),
        "draws": one.needed.size,
        "seed": one.seed,
        "exact_m": one.exact,
        "median_m": float(np.median(one.needed)),
        **{f"pitch_for_{risk:g}_m": finite_or_none(one.pitch_for(risk)) for risk in (0.5, 0.1, 0.05)},
        "other_dances": {"pitch_m": vouched.pitch, "draws": vouched.draws, "touched": vouched.hits},
        **{f"pitch_from_{risk:g}_m": one.pitch_from(risk) for risk in (0.5, 0.1, 0.05)},
    }
