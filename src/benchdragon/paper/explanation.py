"""How the paper's answers are derived, in plain words (see `explain.text`)."""

import math
from collections.abc import Sequence
from typing import Any

from benchdragon.explain.answers import listed, two_arc_lines
from benchdragon.explain.text import number, tiny
from benchdragon.i18n import _
from benchdragon.model.answer import Answer
from benchdragon.model.turns import TwoArcTurn
from benchdragon.plans.schema import read_plan


def traversal_lines(
    answer: Answer, pitch_step: float, time_step: float, tried: Sequence[str]
) -> list[str]:
    """How the paper's traversal goes."""
    return [
        _("Pitches in steps of {step} m, from small to large: {sizes}.").format(
            step=number(pitch_step), sizes=listed(tried)
        ),
        _(
            "For each, the dragon is evaluated every {step} s: {evaluations} evaluations in all. The "
            "answer is the first pitch at which no evaluation finds two benches overlapping: "
            "{pitch} m."
        ).format(
            step=number(time_step), evaluations=answer.evaluations,
            pitch=f"{round(answer.value / pitch_step)}·{number(pitch_step)} = {number(answer.value)}",
        ),
        _(
            "What happens between two evaluations or between two pitches is not seen; the exact "
            "method misses nothing."
        ),
    ]  # fmt: skip


def reproduce_lines(answers: dict[str, Any]) -> list[str]:
    """A line or a few for each part of the paper, from the answers of `reproduce`."""
    return [*_walk_lines(answers), *_touch_lines(answers), *_paper_turn_lines(answers["turn"])]


def _walk_lines(answers: dict[str, Any]) -> list[str]:
    """Motion, Runge-Kutta, differences."""
    pitch = read_plan("spiral-in").value("route.pitch")
    text = _(
        "Motion: r = k·θ, k = pitch/(2·π) = {k} m. The head's angle follows from the distance "
        "walked, every other handle from the one before it, one link away. Chords equal their "
        "links to within {error} m."
    )
    k = f"{number(pitch)}/(2·π) = {number(pitch / (2.0 * math.pi))}"
    lines = [text.format(k=k, error=tiny(answers["largest_chord_error_m"]))]
    text = _(
        "How fast errors fall: with half the step they are 2^order times smaller. Runge-Kutta: {rk}; "
        "differences forward: {forward}; central: {central}; backward: {backward}."
    )
    orders = {name: found["order"] for name, found in answers["differences"].items()}
    orders["rk"] = answers["runge_kutta"]["rk4_order"]
    powers = {name: f"2^{number(order)} = {number(2.0**order)}" for name, order in orders.items()}
    return [*lines, text.format(**powers)]


def _touch_lines(answers: dict[str, Any]) -> list[str]:
    """First contact and smallest pitch."""
    first, smallest = answers["contact"]["first"], answers["pitch"]["smallest"]
    text = _(
        "Contact: benches {a} and {b} at t = {t} s; all of it: benchdragon check spiral-in --explain"
    )
    a, b = first["witness"]["benches"]
    lines = [text.format(a=a, b=b, t=number(first["value"]))]
    text = _(
        "Smallest pitch: benches {a} and {b} just graze at {pitch} m. The paper's traversals are "
        "off by the error of their steps (the last evaluates at the disc alone): {steps} m."
    )
    exact = smallest["value"]
    steps = "; ".join(
        f"{number(row['pitch_m'])} - {number(exact)} = {number(row['pitch_m'] - exact)}"
        for row in answers["pitch"]["traversal"]
    )
    a, b = smallest["witness"]["benches"]
    return [*lines, text.format(a=a, b=b, pitch=number(exact), steps=steps)]


def _paper_turn_lines(turn: dict[str, Any]) -> list[str]:
    """The paper's turn, how fast it may be walked, and shorter ones."""
    plan = read_plan("turn")
    head, near = turn["greatest_head_speed"], turn["clearance"]
    two = TwoArcTurn(plan.value("route.pitch"), plan.value("disc.radius"), plan.turn.ratio)
    limit = plan.value("limits.speed")
    text = _("Head speed in the turn: limit/greatest ratio = {numbers} m/s, at t = {t} s.")
    numbers = f"{number(limit)}/{number(limit / head['value'])} = {number(head['value'])}"
    lines = [*two_arc_lines(two), text.format(numbers=numbers, t=number(head["witness"]["time"]))]
    text = _("Turning, benches {a} and {b} come nearest: {gap} m.")
    a, b = near["witness"]["benches"]
    lines.append(text.format(a=a, b=b, gap=number(near["value"])))
    text = _(
        "Arc, line, arc: path inside the disc {way} m, {numbers} m less than with the paper's "
        "turn; the head may walk at {speed} m/s."
    )
    for best in turn["better"]:
        way, whole = best["way"], turn["length_m"]
        numbers = f"{number(whole)} - {number(way)} = {number(whole - way)}"
        speed = number(best["greatest_head_speed"]["value"])
        lines.append(text.format(way=number(way), numbers=numbers, speed=speed))
    return lines
