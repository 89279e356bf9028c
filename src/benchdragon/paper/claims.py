"""What the paper prints, and how its equations stand against the dragon that walks.

The paper: Nie and Zhao, "Modeling And Analysis of Motion Path and Collision Detection for The Bench
Dragon Using Spiral Equations and Differential Algorithms". Figures are quoted, sentences are not.
"""

import cmath
import math
from dataclasses import dataclass

from benchdragon.errors import InputError
from benchdragon.i18n import N_, _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.curves import Arc
from benchdragon.model.profile import SpeedProfile
from benchdragon.model.turns import TwoArcTurn
from benchdragon.model.walk import Walk
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan

# m: the smallest pitch of its abstract, and the digits it is printed to.
SMALLEST_PITCH = 0.452
# m/s: what it calls the standard value.
HEAD_SPEED = 1.0
# rad: its boundary angles of the two arcs.
ANGLES = {"theta_max1": 4.0055, "theta_min1": 0.9841, "theta_min2": -2.1575, "theta_max2": 0.8639}
# Times, s, at which its equations are tried: after the head enters each of the two arcs, and on the
# ways out and in.
ON_ARCS, ON_WAY_OUT, ON_WAY_IN = (5.0, 2.0), 60.0, -50.0


@dataclass(frozen=True)
class Equation:
    """An equation of the paper, tried on a walk.

    Attributes:
        number: in the paper.
        says: what it gives, in words.
        printed: its value as it is printed.
        true: what the walk does.
        unit: of both; "1" of a plain number.
        remark: what is to be said of it.
    """

    number: int
    says: str
    printed: float
    true: float
    unit: str
    remark: str


def equations(plan: Plan) -> list[Equation]:
    """The paper's equations (1) to (6), evaluated as printed and beside the walk of a plan.

    Raises:
        InputError: for a plan whose turn is not of two arcs with joints on the disc.
    """
    if plan.route.kind != "turn" or plan.turn.family != "arc-arc":
        raise InputError(_("the paper's equations are those of a turn of two arcs"))
    if plan.walk.build() != SpeedProfile.constant(HEAD_SPEED):
        raise InputError(_("the paper's equations are those of a head at 1 m/s"))
    radius = TurnRoute.disc(plan)
    turn = TwoArcTurn(plan.route.pitch, radius, plan.turn.ratio)
    walk = plan.build()
    # The paper's alpha: between the tangent and what is square to the radius.
    alpha = math.atan(plan.route.pitch / (2.0 * math.pi * radius))
    arcs = [curve for curve in walk.route.curves if isinstance(curve, Arc)]
    both = sum(arc.radius for arc in arcs)
    return [
        Equation(
            1, N_("length of the two arcs"), both * (math.pi - 2.0 * alpha),
            sum(arc.length for arc in arcs), "m", N_("right, whatever the ratio of the radii"),
        ),
        Equation(
            2, N_("sum of the radii"), radius / math.cos(alpha), both, "m",
            N_("right; so the length of two tangent arcs is fixed"),
        ),
        _third(walk, turn),
        *(_fourth(walk, turn, arc) for arc in (0, 1)),
        _fifth(walk),
        _sixth(walk, turn),
    ]  # fmt: skip


def _third(walk: Walk, turn: TwoArcTurn) -> Equation:
    """d theta / dt on the way out: the head's velocity about the centre."""
    motion = walk.motion([ON_WAY_OUT])
    place = complex(motion.x[0, 0], motion.y[0, 0])
    velocity = cmath.exp(1j * float(walk.route.heading(motion.s[0, 0]))) * float(motion.speed[0, 0])
    k = turn.pitch / (2.0 * math.pi)
    theta = abs(place) / k
    return Equation(
        3, N_("d theta/dt on the way out"), 1.0 / (k * math.sqrt(1.0 + theta * theta)),
        (velocity / place).imag, "rad/s",
        N_("right, and meant, for the way out; inward it is negative"),
    )  # fmt: skip


def _fourth(walk: Walk, turn: TwoArcTurn, arc: int) -> Equation:
    """The angle on one of the two arcs, from where the arc begins."""
    begins = arc * turn.radii[0] * turn.sweep  # the head walks 1 m/s, and enters the first at 0 s
    x, y = (table[:, 0] for table in _at(walk, [begins, begins + ON_ARCS[arc]]))
    centre = complex(*turn.centres()[arc])
    swung = cmath.phase((complex(x[1], y[1]) - centre) / (complex(x[0], y[0]) - centre))
    says, remark = (
        (
            N_("theta - theta0 on the first arc, 5 s after it begins"),
            N_("misprint: t stands there as 1; theta = theta0 - t/r1 holds"),
        ),
        (
            N_("theta - theta0 on the second arc, 2 s after it begins"),
            N_("the same misprint, and the other sign: theta = theta0 + t/r2 holds"),
        ),
    )[arc]
    return Equation(4, says, -1.0 / turn.radii[arc], swung, "rad", remark)


def _fifth(walk: Walk) -> Equation:
    """The chord equation of the first two handles on the way in."""
    x, y = _at(walk, [ON_WAY_IN])
    dx, dy = float(x[0, 1] - x[0, 0]), float(y[0, 1] - y[0, 0])
    link = float(walk.dragon.links[0])
    return Equation(
        5, N_("left side, which should be d squared"), dx + dy, link * link, "m^2",
        N_("misprint: both terms in parentheses should be squared"),
    )  # fmt: skip


def _sixth(walk: Walk, turn: TwoArcTurn) -> Equation:
    """The cosine of the angle at the first arc's centre, one handle on each arc."""
    start = walk.start + turn.radii[0] * turn.sweep
    head = walk.time_at(start + 0.5 * float(walk.dragon.links[0]))
    x, y = _at(walk, [head])
    centre = complex(*turn.centres()[0])
    front, rear = (complex(x[0, i], y[0, i]) - centre for i in (0, 1))
    d1, r1, d = abs(front), turn.radii[0], float(walk.dragon.links[0])
    return Equation(
        6, N_("cosine of the angle at the centre of the first arc"),
        (d1 * d1 + r1 * r1 - d * d) / (2.0 * d1 * r1), math.cos(cmath.phase(front / rear)), "1",
        N_("right as printed"),
    )  # fmt: skip


def _at(walk: Walk, times: list[float]) -> tuple[FloatArray, FloatArray]:
    motion = walk.motion(times)
    return motion.x, motion.y
