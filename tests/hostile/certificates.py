"""`python -m tests.hostile.certificates FROM TO`: certificates altered by seeds, and what came of it.

Small certificates of every kind are altered at random and by rule. What `verify` accepts is parsed from
its structured result and asked of the searches, which share nothing with the proofs: nothing may be
accepted that they show to be false.
"""

import copy
import json
import math
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from benchdragon.analysis.certificate import certificate_of, plan_in, read_certificate, shown
from benchdragon.analysis.check import check
from benchdragon.analysis.contact import first_sure_contact, least_clearance
from benchdragon.analysis.distance import low_point, pair_distances
from benchdragon.analysis.obstacles import obstacle_answers
from benchdragon.analysis.proof import Claim
from benchdragon.analysis.proved_report import prove_report
from benchdragon.analysis.speed import greatest_speed
from benchdragon.errors import BenchDragonError, InputError, UnsureError
from benchdragon.kernels.curve import RouteRow
from benchdragon.kernels.turn_trial import FEW
from benchdragon.model.turns import Turn
from benchdragon.model.walk import Walk
from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.solve import turn_certificate
from benchdragon.solve.size import limit
from benchdragon.solve.turn_goal import TurnFamily, TurnGoal
from benchdragon.solve.turn_proof import _ratios, proved_bound
from tests.proofs.certificates import IN_THE_WAY, ON_A_BENCH, TOO_MUCH, bend

Written = dict[str, Any]
Alter = Callable[[random.Random, Written], None]
# Walks are this short, s, so that a certificate is shown in some hundredths of a second.
SPANS = ((14.0, 14.7), (15.3, 15.8), (10.0, 10.3))
# Turns of a family that are tried for a better one, and what sampling may be off by, m.
TURNS, SAMPLED = 40, 1e-3
# What searches may leave open, m and s.
NEAR = 1e-9
REFUSED, OPEN, ACCEPTED, CONFIRMED, FALSE = (
    "refused", "not shown", "accepted", "accepted and confirmed", "false",
)  # fmt: skip
BESIDE = "accepted: the searches leave it open"


def short(plan: Plan, span: tuple[float, float]) -> Plan:
    """The plan of a walk between two times, s."""
    return plan.with_values({"walk.start": span[0], "walk.end": span[1]})


@cache
def certificates() -> tuple[str, ...]:
    """Certificates of every kind, as text."""
    plans = [short(bend(margin=TOO_MUCH), SPANS[0]), short(bend(IN_THE_WAY), SPANS[1])]
    plans += [short(bend(ON_A_BENCH), SPANS[2]), short(_square(), SPANS[2])]
    found: list[Any] = []
    for n, plan in enumerate(plans):
        report = check(plan, prove=True)
        if n in (1, 3):
            report = prove_report(report)
        found.append(certificate_of(plan, report.claims, report.speeds))
    claims: list[Claim] = []
    plan = short(checked(bend(margin=0.3).data() | {"obstacle": []}, "bare"), SPANS[0])
    limit(plan, "width", prove=True, claims=claims)
    found.append(certificate_of(plan, claims))
    for wish in (TurnGoal("way", 1.5027), TurnGoal("way", longest_way=1.0), TurnGoal("length", 1.5)):
        turn = _turn(3 if wish.longest_way == 1.0 else 6)
        proof = proved_bound(turn, wish, 11.5 if wish.objective == "way" else 10.0, gap=2.0, most=40)
        found.append(turn_certificate.certificate_of(turn, wish, proof))
    return tuple(one.model_dump_json() for one in found if one is not None)


def _square() -> Plan:
    """The bend in a venue, beside a rectangle, a polygon and a line."""
    things = [
        {"kind": "rectangle", "centre": [6, 2], "size": [3, 1], "angle": 10, "margin": 0.1},
        {"kind": "polygon", "points": [[0, -3], [5, -2], [2, -1]]},
        {"kind": "line", "name": "rope", "points": [[0, 1], [9, 1.5]]},
    ]
    data = bend().data() | {"obstacle": things, "venue": {"rectangle": [40, 30], "name": "yard"}}
    return checked(data, "square")


def _turn(benches: int) -> Plan:
    said = [f"dragon.benches={benches}", "turn.family=arc-line-arc", "walk.speed=1.3"]
    joints = ["turn.entry_radius=4.5", "turn.exit_radius=4.5"]
    return read_plan("turn", [*said, *joints])


# How certificates are altered.


def _spots(table: Any) -> list[tuple[Any, Any]]:
    """Where numbers stand: what holds each, and its key there."""
    found: list[tuple[Any, Any]] = []
    for key, value in list(table.items() if isinstance(table, dict) else enumerate(table)):
        if isinstance(value, dict | list):
            found += _spots(value)
        elif isinstance(value, int | float) and not isinstance(value, bool):
            found.append((table, key))
    return found


def _moved(dice: random.Random, value: float) -> float:
    """Another number: a little, or much, or something simple."""
    kind = dice.randrange(6)
    if kind == 0:
        return math.nextafter(value, dice.choice([-math.inf, math.inf]))
    if kind == 1:
        return value + dice.choice([-1.0, 1.0]) * math.exp(dice.uniform(-32.0, 0.0))
    if kind == 2:
        return value * (1.0 + dice.choice([-1.0, 1.0]) * math.exp(dice.uniform(-20.0, 0.0)))
    return dice.choice([0.0, -value, 1.0, 10.0 * value, 0.1 * value, 1e-3, 1e3, round(value, 1)])


def number(dice: random.Random, what: Written) -> None:
    """Change a number of what is claimed."""
    said = {key: value for key, value in what.items() if key != "plan"}
    spots = _spots(said)
    few = [spot for spot in spots if not isinstance(spot[1], int)] or spots
    table, key = dice.choice(few if dice.random() < 0.7 else spots)
    value = _moved(dice, table[key])
    target = what if table is said else table
    target[key] = round(value) if isinstance(table[key], int) and dice.random() < 0.9 else value


def swapped(dice: random.Random, what: Written) -> None:
    """Exchange two numbers of a claim, or put one in the place of another."""
    claims = [*what.get("claims", []), *what.get("speeds", [])]
    spots = [spot for spot in _spots(dice.choice(claims) if claims else what) if spot[1] != "schema"]
    (one, a), (other, b) = dice.choice(spots), dice.choice(spots)
    one[a], other[b] = (other[b], one[a]) if dice.random() < 0.6 else (one[a], one[a])


def plan(dice: random.Random, what: Written) -> None:
    """Change a number of the plan, with the hash made right again."""
    table, key = dice.choice([spot for spot in _spots(what["plan"]) if spot[1] != "schema"])
    value = _moved(dice, table[key])
    table[key] = round(value) if isinstance(table[key], int) else value
    _with_hash(dice, what)


def limits(dice: random.Random, what: Written) -> None:
    """Change what is to be kept: of the plan, of a claim, or of a turn."""
    value = dice.choice([0.0, 0.05, 0.5, 1.1, 1.2, 5.0, 1e-9, -1.0, None])
    claims = what.get("claims") or []
    if "objective" in what:
        name = dice.choice(["least_radius", "longest", "longest_way", "bound", "objective"])
        what[name] = dice.choice([0.001, 1.0, 5.0, 12.0, 1000.0, None, "way", "length", "speed"])
    elif claims and dice.random() < 0.5:
        dice.choice(claims)["margin"] = value
    elif claims and dice.random() < 0.5:
        key = dice.choice(["limits.margin", "dragon.width", "dragon.body_length", "limits.speed"])
        dice.choice(claims)["values"] = {key: value if value is not None else 0.3}
    else:
        name = dice.choice(["margin", "speed", "venue_margin", "head_acceleration"])
        what["plan"]["limits"][name] = value
        _with_hash(dice, what)


def order(dice: random.Random, what: Written) -> None:
    """Leave out, double, turn round or exchange what stands in a list."""
    lists = [table[key] for table, key in _lists(what) if len(table[key]) > 1]
    one = dice.choice(lists) if lists else []
    if not one:
        return
    a, b = sorted((dice.randrange(len(one)), dice.randrange(len(one))))
    change = dice.randrange(5)
    if change == 0:
        del one[a : b + 1]
    elif change == 1:
        one.insert(a, copy.deepcopy(one[b]))
    elif change == 2:
        one[a : b + 1] = one[a : b + 1][::-1]
    elif change == 3:
        del one[a + 1 : -1]
    else:
        one[a], one[b] = one[b], one[a]


def _lists(table: Any) -> list[tuple[Any, Any]]:
    items = list(table.items() if isinstance(table, dict) else enumerate(table))
    found = [(table, key) for key, value in items if isinstance(value, list)]
    for _key, value in items:
        found += _lists(value) if isinstance(value, dict | list) else []
    return found


def about(dice: random.Random, what: Written) -> None:
    """Let a claim speak of something else, of others, or of less."""
    claims = what.get("claims") or []
    if not claims:
        number(dice, what)
        return
    one, other = dice.choice(claims), dice.choice(claims)
    change = dice.randrange(6)
    if change == 0:
        one["about"] = dice.choice([other["about"], "", "post", "nobody"])
    elif change == 1:
        one["benches"] = [dice.randrange(-1, 7) for _n in range(dice.choice([1, 2, 2]))]
    elif change == 2:
        one.update(contact=None, s=None, benches=[])
    elif change == 3:
        one.update({key: other[key] for key in ("contact", "s", "benches")})
    elif change == 4:
        one["clear"] = one["start"] if dice.random() < 0.5 else one["cells"][-1]
    else:
        one["cells"], one["clear"] = one["cells"][:1], one["start"]


def keys(dice: random.Random, what: Written) -> None:
    """A key more, or less, another version, format or hash."""
    change = dice.randrange(5)
    if change == 0:
        what[dice.choice(["more", "margin", "values", "verified"])] = dice.choice([1, {}, None])
    elif change == 1:
        del what[dice.choice(list(what))]
    elif change == 2:
        what["version"] = dice.choice(["", "0.0.9", "1", "0.1.0 ", 1])
    elif change == 3:
        what["format"] = dice.choice(["benchdragon certificate", "benchdragon turn certificate", ""])
    else:
        what["plan_sha256"] = dice.choice(["", "0" * 64, what["plan_sha256"].upper()])


ALTERED: tuple[Alter, ...] = (number, number, swapped, plan, plan, limits, limits, order, about, keys)


def _with_hash(dice: random.Random, what: Written) -> None:
    if dice.random() < 0.05:
        return
    try:
        what["plan_sha256"] = checked(what["plan"], "altered").sha256
    except BenchDragonError:
        return


def altered(seed: int) -> str:
    """The text of the certificate of a seed."""
    dice = random.Random(seed)
    what: Written = json.loads(dice.choice(certificates()))
    for _n in range(dice.choice([1, 1, 1, 2, 3])):
        try:
            dice.choice(ALTERED)(dice, what)
        except (KeyError, IndexError, AttributeError, TypeError):  # what was altered before has no such
            continue
    text = json.dumps(what)
    if dice.random() < 0.02:  # a key twice
        text = text.replace('"version":', '"version": "0.1.0", "version":', 1)
    return text


# What verify accepts, asked of the searches.


@dataclass(frozen=True)
class Outcome:
    """What came of a certificate: one of the words above, and what was said, if that is false."""

    kind: str
    said: str = ""


def outcome(text: str, folder: Path) -> Outcome:
    """What verify says of a certificate, and what the searches say of that."""
    path = folder / "altered.json"
    path.write_text(text, "utf-8")
    try:
        if turn_certificate.is_turn_certificate(path):
            turns = read_certificate(path, turn_certificate.TurnCertificate)
            one = turn_certificate.shown(turns)
            return judged([(turn_holds(one.as_json(), one.plan), one.sentence())])
        kept = read_certificate(path)
        found = shown(kept)
    except UnsureError:
        return Outcome(OPEN)
    except BenchDragonError:
        return Outcome(REFUSED)
    plan = plan_in(kept.version, kept.plan, kept.plan_sha256)
    told = [
        (holds(said.as_json(), said.sentence(), plan), said.sentence()) for said in found.statements
    ]
    return judged(told)


def judged(told: list[tuple[bool | None, str]]) -> Outcome:
    """The outcome of statements that hold, do not, or are left open by the searches."""
    wrong = [sentence for true, sentence in told if true is False]
    if wrong:
        return Outcome(FALSE, wrong[0])
    return Outcome(CONFIRMED if all(true for true, _sentence in told) else BESIDE)


def holds(said: Written, sentence: str, plan: Plan) -> bool | None:
    """Whether a statement is true by the searches; None where these leave it open."""
    if said["about"] == "speeds":
        return _paces_hold(said, plan)
    other = plan.with_values(said["values"]) if said["values"] else plan
    walk, start, clear, contact = other.build(), said["start"], said["clear"], said["contact"]
    if f"{said['margin']!r}".removesuffix(".0") not in sentence and "free of" not in sentence:
        return False
    true: list[bool | None] = []
    if contact is None or clear > start:
        true.append(_kept(walk, other, said, (start, clear)))
    if contact is not None:
        end = min(contact + NEAR, other.span(walk)[1])  # contacts of that time are within rounding
        true.append(_met(walk, other, said, (start, end)))
    return False if False in true else None if None in true else True


def _kept(walk: Walk, plan: Plan, said: Written, span: tuple[float, float]) -> bool | None:
    """Whether nothing comes nearer than was said."""
    if said["obstacle"] is None:
        found = least_clearance(walk, *span)
        low, high = found.lower, found.upper
    else:
        thing = next(one for one in plan.obstacles() if one.name == said["obstacle"]["name"])
        if thing.outline.tolist() != said["obstacle"]["outline"] or thing.margin != said["margin"]:
            return False
        answers = obstacle_answers(walk, thing, *span)
        if answers.contact is not None and answers.contact.status == "found":
            return False
        low, high = answers.distance.lower, answers.distance.upper
    return False if high < said["margin"] else True if low >= said["margin"] - NEAR else None


def _met(walk: Walk, plan: Plan, said: Written, span: tuple[float, float]) -> bool | None:
    """Whether something has come nearer by the time that was said."""
    if said["obstacle"] is not None:
        thing = next(one for one in plan.obstacles() if one.name == said["obstacle"]["name"])
        found = obstacle_answers(walk, thing, *span).contact
    else:
        i, j = sorted(n - 1 for n in said["benches"])
        first, last = walk.head_position(span).tolist()
        at = pair_distances(walk.placement([first, last]), i, j)
        near = min(float(at.min()), low_point(walk, i, j, first, last)[0])
        if near > said["margin"] + NEAR:
            return False
        found = first_sure_contact(walk, *span, margin=said["margin"])
    if found is None:
        return False
    return True if found.status == "found" else None


def _paces_hold(said: Written, plan: Plan) -> bool | None:
    """Whether no handle is faster than was said, and one is as fast."""
    if plan.walk.profile or plan.cues.cue:
        return None
    head, walk = plan.walk.speed, plan.build()
    found = greatest_speed(walk, said["start"], said["clear"])
    low, high = found.lower / head, found.upper / head
    return bool(low <= said["most"] and high >= said["least"] * (1.0 - 1e-12))


def fastest(turn: Turn, family: TurnFamily) -> float:
    """The greatest speed of a handle with the head at 1 m/s, sampled; infinite where none can walk."""
    rows, links = turn.rows(lead=1.0, trail=1000.0), family.dragon.links[:FEW]
    at = np.linspace(rows[1, RouteRow.S_START], rows[-1, RouteRow.S_START] + links.sum(), 400)
    ratios = _ratios(rows, links, at)
    return math.inf if ratios is None else float(ratios.max())


def turn_holds(said: Written, plan: Plan) -> bool | None:
    """Whether no turn of the family that is tried, and keeps what it must, is better than was said."""
    limits = {name: math.inf if said["limits"][name] is None else said["limits"][name]
              for name in ("longest", "longest_way")}  # fmt: skip
    goal = TurnGoal(said["objective"], said["limits"]["least_radius"], **limits)
    family, dice = TurnFamily(plan, goal), random.Random(7)
    seen, limit = 0, math.inf if plan.limits.speed is None else plan.limits.speed
    for _n in range(TURNS):
        try:
            turn = family.turn([dice.uniform(low, high) for low, high in family.bounds])
        except InputError:
            continue
        way, speed = turn.way(family.disc), fastest(turn, family)
        found = {"speed": speed, "length": turn.length, "way": way}
        head = 0.0 if goal.objective == "speed" else plan.walk.speed
        if (
            speed == math.inf
            or turn.least_radius < family.narrowest
            or turn.length > goal.longest
            or way > goal.longest_way
            or speed * head > limit
        ):
            continue
        seen += 1
        if said["bound"] is None:
            return False
        if goal.objective == "speed":
            if (
                plan.limits.speed is not None
                and plan.limits.speed / found["speed"] > said["bound"] + SAMPLED
            ):
                return False
        elif found[goal.objective] < said["bound"] - SAMPLED:
            return False
    return True if seen or said["bound"] is None else None


def counted(seeds: Iterable[int]) -> Counter[str]:
    """What came of the certificates of these seeds; whatever is false is told."""
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in seeds:
            found = outcome(altered(seed), Path(folder))
            counts[found.kind] += 1
            if found.kind == FALSE:
                print(f"seed {seed}: {found.said}", flush=True)
    return counts


def main(arguments: list[str]) -> int:
    """Try the certificates of these seeds, and say what all came to; 1 if one was falsely accepted."""
    first, last = map(int, arguments)
    counts = counted(range(first, last))
    counts[ACCEPTED] = counts[CONFIRMED] + counts[BESIDE] + counts[FALSE]
    for name in (REFUSED, OPEN, ACCEPTED, CONFIRMED, BESIDE, FALSE):
        print(f"{name}: {counts[name]}")
    return 1 if counts[FALSE] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
