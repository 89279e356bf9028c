"""Conditioning: how first contact, smallest pitch and greatest head speed move with each size.

The chain is differentiated, not stepped: with the head held, rigid benches say how far every handle
moves along the route for a small change of a link or of the route itself, by the same law that gives
speeds. The change of the route comes from its own points, which are known in closed form.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from benchdragon.errors import InputError, WalkError, of_kind
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.answer import Answer, Witness
from benchdragon.model.walk import Motion, Walk
from benchdragon.plans.schema import Plan
from benchdragon.plans.toml import PlanError
from benchdragon.solve.size_family import question

# Central difference of sixth order for the route's own points: relative step, offsets, weights. A
# derivative is off by 1e-11 of its size; a longer step loses to the formula, a shorter one to rounding.
RELATIVE_STEP = 4e-4
OFFSETS = (-3, -2, -1, 1, 2, 3)
WEIGHTS = np.array([-1.0, 9.0, -45.0, 45.0, -9.0, 1.0]) / 60.0
# Sizes whose sensitivity is reported, where a plan gives them.
SIZES = (
    "route.pitch", "disc.radius", "dragon.width", "dragon.head_length", "dragon.body_length",
    "dragon.tail_length", "dragon.front_inset", "dragon.rear_inset", "turn.ratio",
)  # fmt: skip
# How far on either side of a witness, s, the exact graze or peak is sought.
NEAR = 1e-3


@dataclass(frozen=True)
class Drift:
    """How a walk changes with one number while the head has come equally far.

    Attributes:
        point: of each handle's place on the route, per unit, (N + 1, 2).
        heading: of the route's heading there, rad per unit, (N + 1,).
        sizes: of length, width, front inset and rear inset of every bench, m per unit, (4, N).
        head: of the head's way along the route, m per unit.
    """

    point: FloatArray
    heading: FloatArray
    sizes: FloatArray
    head: float = 0.0

    @property
    def links(self) -> FloatArray:
        """Of every link, m per unit, (N,)."""
        return np.asarray(self.sizes[0] - self.sizes[2] - self.sizes[3])


@dataclass(frozen=True)
class Configuration:
    """The dragon at one instant, as vectors: complex numbers x + iy.

    Attributes:
        place: of the handles, m, (N + 1,).
        tangent: of the route there, (N + 1,).
        bend: curvature there, 1/m, (N + 1,).
        bench: unit vectors from rear handle to front handle, (N,).
        links: m, (N,).
        sizes: of the benches, m, (4, N).
    """

    place: np.ndarray[tuple[int], np.dtype[np.complex128]]
    tangent: np.ndarray[tuple[int], np.dtype[np.complex128]]
    bend: FloatArray
    bench: np.ndarray[tuple[int], np.dtype[np.complex128]]
    links: FloatArray
    sizes: FloatArray

    @classmethod
    def of(cls, motion: Motion) -> "Configuration":
        """The one time of a motion."""
        route, s = motion.walk.route, motion.s[0]
        place = motion.x[0] + 1j * motion.y[0]
        dragon = motion.walk.dragon
        return cls(
            place, np.exp(1j * route.heading(s)), route.curvature(s),
            (place[:-1] - place[1:]) / dragon.links, dragon.links, dragon.sizes,
        )  # fmt: skip


@dataclass(frozen=True)
class Change:
    """First derivatives of a standing dragon: what `changed` returns.

    Attributes:
        along: way of every handle along the route, m per unit, (N + 1,).
        place: of the handles, m per unit, complex, (N + 1,).
        turn: of every bench, rad per unit, (N,).
    """

    along: FloatArray
    place: np.ndarray[tuple[int], np.dtype[np.complex128]]
    turn: FloatArray


def dot(a: complex, b: complex) -> float:
    """Scalar product of two vectors."""
    return float(a.real * b.real + a.imag * b.imag)


def changed(configuration: Configuration, drift: Drift) -> Change:
    """How all handles move with a number: |P_i - P_i+1| = d_i, differentiated from head to tail.

    u . (v_i - v_i+1) = d d_i with v = t da + dP: the law of speeds with two terms more.
    """
    shift = drift.point[:, 0] + 1j * drift.point[:, 1]
    along = np.empty(len(configuration.place))
    along[0] = drift.head
    moved = configuration.tangent[0] * drift.head + shift[0]
    for i, link in enumerate(drift.links):
        u = configuration.bench[i]
        along[i + 1] = (dot(u, moved - shift[i + 1]) - link) / dot(u, configuration.tangent[i + 1])
        moved = configuration.tangent[i + 1] * along[i + 1] + shift[i + 1]
    place = configuration.tangent * along + shift
    turn = np.imag(np.conj(configuration.bench) * (place[:-1] - place[1:])) / configuration.links
    return Change(along, place, turn)


def walking(configuration: Configuration) -> Drift:
    """The drift that is the walk itself: the head goes on, per metre of its way."""
    n = len(configuration.place)
    return Drift(np.zeros((n, 2)), np.zeros(n), np.zeros((4, n - 1)), 1.0)


def drift(plan: Plan, keys: Sequence[str], motion: Motion) -> Drift:
    """How the walk of a plan at the one time of `motion` changes with the number under `keys`.

    Raises:
        InputError: where a step of the number gives no walk.
    """
    value = plan.value(keys[0])
    step = RELATIVE_STEP * (abs(value) or 1.0)
    ahead = motion.s[0] - motion.walk.start
    poses, sizes, heads = [], [], []
    for offset in OFFSETS:
        walk = plan.with_values(dict.fromkeys(keys, value + offset * step)).build()
        at = walk.start + ahead
        poses.append(np.column_stack([walk.route.point(at), walk.route.heading(at)]))
        sizes.append(walk.dragon.sizes)
        heads.append(float(walk.head_position(motion.times)[0]) - walk.start)
    pose = np.tensordot(WEIGHTS, np.array(poses), 1) / step
    bench = np.tensordot(WEIGHTS, np.array(sizes), 1) / step
    if not np.isfinite(pose).all():
        text = _("{key}: the dragon cannot walk a little beside this size")
        raise InputError(text.format(key=keys[0]))
    return Drift(pose[:, :2], pose[:, 2], bench, float(WEIGHTS @ np.array(heads)) / step)


@dataclass(frozen=True)
class Touch:
    """A corner of bench `owner` on a side of bench `other` (rows, from 0)."""

    owner: int
    other: int
    at_front: bool
    left: float
    side: str

    @classmethod
    def of(cls, witness: Witness) -> "Touch":
        """What the witness of a contact names.

        Raises:
            InputError: for two corners, or no contact: no law of a corner and a side holds there.
        """
        if len(witness.features) != 2 or " " in witness.features[1][1]:
            raise InputError(_("only the contact of a corner with a side has these derivatives"))
        (owner, which), (other, side) = witness.features
        return cls(
            owner - 1,
            other - 1,
            which.startswith("front"),
            1.0 if which.endswith("left") else -1.0,
            side,
        )


def distance_rate(configuration: Configuration, drift: Drift, touch: Touch) -> float:
    """How the distance of a corner of one bench from a side of another changes, m per unit."""
    i, j, change = touch.owner, touch.other, changed(configuration, drift)
    length, width, front, _rear = configuration.sizes[:, i]
    d_length, d_width, d_front, _d_rear = drift.sizes[:, i]
    u, turn = configuration.bench[i], change.turn[i]
    ahead, d_ahead = (front, d_front) if touch.at_front else (front - length, d_front - d_length)
    across, d_across = 0.5 * touch.left * width, 0.5 * touch.left * d_width
    # The corner is P + (ahead + i across) u, and u turns.
    tip = (ahead + 1j * across) * u
    d_corner = change.place[i] + (d_ahead + 1j * d_across) * u + 1j * turn * tip
    corner_at = configuration.place[i] + tip
    v = configuration.bench[j]
    normal = {"left": 1j * v, "right": -1j * v, "front": v, "rear": -v}[touch.side]
    long, aside, before = drift.sizes[0, j], 0.5 * drift.sizes[1, j], drift.sizes[2, j]
    half = {"left": aside, "right": aside, "front": before, "rear": long - before}[touch.side]
    arm = corner_at - configuration.place[j]
    swing = dot(1j * change.turn[j] * normal, arm)
    return swing + dot(normal, d_corner - change.place[j]) - float(half)


def log_ratio_rate(configuration: Configuration, drift: Drift, handle: int) -> float:
    """How the logarithm of a handle's speed ratio changes, 1 per unit.

    The ratio is a product of (t_i . u) / (t_i+1 . u) over the benches before the handle.
    """
    change = changed(configuration, drift)
    swing = configuration.bend * change.along + drift.heading
    total = 0.0
    for i in range(handle):
        u = configuration.bench[i]
        for end, sign in ((i, 1.0), (i + 1, -1.0)):
            t = configuration.tangent[end]
            total += sign * (change.turn[i] - swing[end]) * dot(t, 1j * u) / dot(t, u)
    return total


def sizes_of(plan: Plan) -> list[str]:
    """The keys of SIZES that play a part in a plan."""
    if plan.dragon.bench:
        return []
    known = []
    for key in SIZES:
        try:
            plan.value(key)
        except PlanError:
            continue
        known.append(key)
    return known


def contact_rates(plan: Plan, contact: Answer) -> dict[str, float]:
    """How the time of first contact moves with each size of a plan: s per metre, by key.

    Args:
        plan: of the walk.
        contact: what `first_contact` found.

    Raises:
        InputError: where it is no contact of a corner with a side.
    """
    witness = _known(contact)
    touch, walk = Touch.of(witness), plan.build()
    motion = walk.motion([contact.value])
    configuration = Configuration.of(motion)
    closing = distance_rate(configuration, walking(configuration), touch) * motion.head_speed[0]
    rates = _distance_rates(plan, motion, configuration, touch)
    return {key: -rate / float(closing) for key, rate in rates.items()}


def limit_rates(plan: Plan, name: str, limit: Answer) -> dict[str, float]:
    """How a limit that `size.limit` found moves with each other size of a plan: m per metre, by key.

    Args:
        plan: what was asked about.
        name: of the question, "pitch", "disc", "width" or "length".
        limit: the answer.

    Raises:
        InputError: where the pair that decides does not graze: it meets at the walk's end.

    Examples:
        >>> plan = bd.read_plan("question-3")
        >>> rates = bd.limit_rates(plan, "pitch", plan.smallest_pitch())
        >>> f"{rates['dragon.width']:.4f} m of pitch for each m of width"
        '0.9690 m of pitch for each m of width'
    """
    of_kind("plan", plan, Plan)
    of_kind("limit", limit, Answer)
    keys = question(name).keys
    touch = Touch.of(_known(limit))
    there = plan.with_values(dict.fromkeys(keys, limit.value))
    walk = there.build()
    time = walk.time_at(_known(limit).s)

    def closing(t: float) -> float:
        configuration = Configuration.of(walk.motion([t]))
        return distance_rate(configuration, walking(configuration), touch)

    motion = walk.motion([_level(closing, time)])
    configuration = Configuration.of(motion)
    slope = distance_rate(configuration, drift(there, keys, motion), touch)
    rates = _distance_rates(there, motion, configuration, touch)
    return {key: -rate / slope for key, rate in rates.items() if key not in keys}


def speed_rates(plan: Plan, head_speed: Answer) -> dict[str, float]:
    """How the greatest head speed moves with each size of a plan: m/s per metre, by key.

    Args:
        plan: what was asked about; one handle's speed must be what limits it.
        head_speed: what `head_speed.greatest_head_speed` found.

    Raises:
        InputError: where the greatest ratio is no smooth peak: a handle stands on a joint then.
    """
    witness = _known(head_speed)
    walk, handle = plan.build(), witness.benches[0] - 1
    still = Walk(walk.dragon, walk.route, start=walk.start)

    def rise(t: float) -> float:
        return float(still.motion([t]).acceleration[0, handle])

    motion = still.motion([_level(rise, witness.s - walk.start)])
    configuration = Configuration.of(motion)
    return {
        key: -head_speed.value * log_ratio_rate(configuration, drift(plan, (key,), motion), handle)
        for key in sizes_of(plan)
    }


def _distance_rates(
    plan: Plan, motion: Motion, configuration: Configuration, touch: Touch
) -> dict[str, float]:
    return {
        key: distance_rate(configuration, drift(plan, (key,), motion), touch) for key in sizes_of(plan)
    }


def _known(answer: Answer) -> Witness:
    if answer.witness is None:
        raise InputError(_("an answer without a witness has no derivatives"))
    return answer.witness


def _level(slope: Callable[[float], float], time: float) -> float:
    """The time near `time` at which a slope is 0, s, or InputError."""
    try:
        return float(brentq(slope, time - NEAR, time + NEAR, xtol=1e-15, rtol=1e-15))
    except (ValueError, WalkError):
        raise InputError(_("only at a smooth minimum or peak are these derivatives known")) from None
