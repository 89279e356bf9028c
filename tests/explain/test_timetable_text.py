"""The timetable in words: its rows and the sentences about them."""

from typing import Any

import pytest

from benchdragon.analysis.beats import score_of
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.timetable import timetable
from benchdragon.explain.timetable_text import TimetableText, tempo_text, timetable_text
from benchdragon.explain.whereabouts import whereabouts
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import Plan, checked, read_plan
from tests.analysis.test_timetable import HOLD, plan_with

BOW = {**HOLD, "text": "bow to the temple", "text_zh": "拜庙"}


def told(plan: Plan) -> TimetableText:
    walk = plan.build()
    span = plan.span(walk)
    return timetable_text(plan, walk, span, Ground.of(plan, walk.route), timetable(plan, walk, *span))


def placed(place: tuple[float, float], **others: Any) -> str:
    """Where a place of a plan with the well at (15.5, -3) is said to be."""
    plan = checked({**plan_with().data(), **others}, "dance")
    return whereabouts(plan, Ground.of(plan, plan.build().route), place)


def test_rows_tell_names_places_and_times_of_day_in_the_language_in_use() -> None:
    plan = plan_with(BOW, clock="18:30")
    text = told(plan)
    assert text.columns == ("place", "where it is", "way (m)", "head", "tail")
    row = next(row for row in text.rows if row[0] == "bow to the temple")
    assert row[2:4] == ("10.00", "18:30:11 to 18:30:16")
    assert "The whole dance lasts 50 s." in text.lines or any(
        "whole dance" in one for one in text.lines
    )
    with spoken_in("zh"):
        assert "拜庙" in [row[0] for row in told(plan).rows]
        assert told(plan).lines[0].startswith("整场 ")


def test_a_place_is_told_from_what_stands_there_while_it_is_danced() -> None:
    near_well = "from well 2.0 m to the left and 1.0 m forward"
    assert placed((13.5, -2.0)) == near_well
    assert placed((30.0, 10.0)) == "10.0 m from the right edge and 19.0 m from the near edge"
    assert placed((39.0, -8.0), event={"entrances": [[40, -9]]}) == (
        "from entrance 1 1.0 m to the left and 1.0 m forward"
    )
    outside = placed((3.5, -3.0))
    assert outside == "from well 12.0 m to the left and 0.0 m forward"
    assert placed((3.5, -3.0), obstacle=[], venue={}) == (
        "from where the peg stood 3.5 m the way x points and 3.0 m against y"
    )


def test_from_a_stage_a_place_is_told_at_its_nearest_side() -> None:
    stage = {"kind": "rectangle", "name": "stage", "centre": [20, 20], "size": [6, 4]}
    said = placed((24.0, 20.5), obstacle=[stage])
    assert said == "from stage 1.0 m to the right and 0.0 m forward"


def test_where_the_tail_comes_nowhere_its_column_is_left_out_and_it_is_said_why() -> None:
    settings = "dragon.benches=40", "route.pitch=3", "route.start_turn=6", "walk.end=5"
    text = told(read_plan("spiral-in", settings))
    assert text.columns[-1] == "head"
    assert all(len(row) == len(text.columns) for row in text.rows)
    assert any("before the tail comes as far" in line for line in text.lines)
    assert not any(line.startswith("-:") for line in text.lines)


def test_it_is_said_which_handle_head_and_tail_count() -> None:
    text = told(plan_with(BOW))
    assert any("the tail with its last handle" in line for line in text.lines)
    assert any(line.startswith("-:") for line in text.lines) == any("-" in row[3:] for row in text.rows)


def test_the_tempo_says_where_it_comes_from_and_how_many_beats_count_in() -> None:
    plan = plan_with(BOW)
    walk = plan.build()
    score = score_of(plan, *plan.span(walk))
    said = "100 beats a minute: a step of 60 cm a beat at the head's speed"
    assert tempo_text(plan, score) == said
    assert tempo_text(plan, score._replace(by_step=False)) == "100 beats a minute, as the plan says"
    lines = told(plan).lines
    assert f"Drum: {said}." in lines
    assert "The sound file counts 4 beats in: the head sets out on the next one." in lines


@pytest.mark.parametrize(
    ("parts", "names"),
    [
        (
            [(20, 0), (8, 90), (5, 0), (8, 90), (5, 0)],
            [
                "straight becomes left bend (1)", "left bend becomes straight (1)",
                "straight becomes left bend (2)", "left bend becomes straight (2)",
            ],
        ),
        ([(20, 0), (8, 90), (12, 90), (10, 0), (30, 0)],
         ["straight becomes left bend", "left bend becomes straight"]),
    ],
)  # fmt: skip
def test_only_where_it_bends_otherwise_the_route_is_told_and_numbered_where_that_recurs(
    parts: list[tuple[float, float]], names: list[str]
) -> None:
    made = [
        {"kind": "arc", "radius": size, "angle": angle} if angle else {"kind": "line", "length": size}
        for size, angle in parts
    ]
    data = {**plan_with().data(), "route": {"kind": "parts", "part": made}}
    plan = checked({**data, "obstacle": [], "venue": {}}, "dance")
    walk = plan.build()
    rows = timetable(plan, walk, *plan.span(walk))
    assert [row.name for row in rows if row.kind == "joint"] == names
