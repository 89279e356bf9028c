"""When head and tail pass places, where the head stands, and how the drum goes."""

import json

import numpy as np
import pytest

from benchdragon.analysis.beats import score_of
from benchdragon.analysis.check import check
from benchdragon.analysis.clock import Clock, minutes
from benchdragon.analysis.records import verdict_of
from benchdragon.analysis.stops import stops_of, stops_sentence, stops_text
from benchdragon.analysis.timetable import timetable
from benchdragon.cli.main import run
from benchdragon.errors import WalkError
from benchdragon.plans.schema import Plan, checked, read_plan

HOLD = {"kind": "hold", "head": 10.0, "hold": 5.0}
LINES = [{"kind": "line", "length": 20.0}, {"kind": "arc", "radius": 8.0, "angle": 180.0}]


def plan_with(*cues: dict[str, object], **others: object) -> Plan:
    data = {
        "schema": 1, "dragon": {"benches": 3, "head_length": 2.2}, "walk": {"position": 6.0},
        "route": {"kind": "parts", "part": LINES},
        "venue": {"boundary": [[8, -9], [40, -9], [40, 30], [8, 30]]},
        "obstacle": [{"kind": "circle", "name": "well", "centre": [15.5, -3], "radius": 0.5}],
        "cues": {"cue": list(cues), **others},
    }  # fmt: skip
    return checked(data, "dance")


def test_every_place_is_passed_when_the_head_and_the_tail_are_there() -> None:
    plan = plan_with(HOLD, {"kind": "note", "head": 12.0, "text": "bow"})
    walk = plan.build()
    start, end = plan.span(walk)
    rows = timetable(plan, walk, start, end)
    names = [
        "the head sets out",
        "entrance of the venue",
        "the head nearest to well",
        "hold",
        "bow",
        "straight becomes left bend",
        "the head at the end",
    ]
    assert [row.name for row in rows] == names
    for row in rows:
        np.testing.assert_allclose(walk.route.point([row.s])[0], row.point, atol=1e-12)
        if row.head is not None:
            assert walk.motion([row.head]).s[0, 0] == pytest.approx(row.s, abs=2e-6)
        if row.tail is not None:
            assert walk.motion([row.tail]).s[0, -1] == pytest.approx(row.s, abs=1e-6)
    by_name = {row.name: row for row in rows}
    assert by_name["entrance of the venue"].s == pytest.approx(8.0, abs=1e-5)
    assert by_name["the head nearest to well"].s == pytest.approx(15.5, abs=1e-5)
    assert by_name["hold"].head == pytest.approx(11.0)
    assert by_name["hold"].until == pytest.approx(16.0)
    # While the head stands the tail does: it passes the well later by the hold.
    own = plan_with().build()
    free = {row.name: row for row in timetable(plan_with(), own, *plan_with().span(own))}
    late = by_name["the head nearest to well"].tail or 0.0
    assert late - (free["the head nearest to well"].tail or 0.0) == pytest.approx(7.0, abs=1e-6)


def test_head_and_tail_are_told_nearest_to_where_people_come_in() -> None:
    # Beside the line that the head walks first, and beside the bow behind it, of 8 m about (20, 8).
    event = {"entrances": [[12.25, -5.0], [40.0, 8.0]]}
    plan = checked({**plan_with().data(), "event": event}, "dance")
    walk = plan.build()
    rows = [
        row
        for row in timetable(plan, walk, *plan.span(walk))
        if "entrance " in row.name and "of" not in row.name
    ]
    assert [(row.kind, row.name) for row in rows] == [
        ("entrance", "the dragon's way nearest to entrance 1"),
        ("entrance", "the dragon's way nearest to entrance 2"),
    ]
    for row, point in zip(rows, [(12.25, 0.0), (28.0, 8.0)], strict=True):
        np.testing.assert_allclose(row.point, point, atol=1e-5)
        assert row.head is not None
        assert row.tail is not None
        assert walk.motion([row.head]).s[0, 0] == pytest.approx(row.s, abs=1e-6)
        assert walk.motion([row.tail]).s[0, -1] == pytest.approx(row.s, abs=1e-6)


def test_a_tail_that_would_come_after_the_dance_is_not_sought_where_no_dragon_can_be() -> None:
    # Where the tail comes to the place of the head's start, the head would be in the spiral's centre.
    plan = read_plan(
        "spiral-in", ["dragon.benches=300", "route.pitch=1.2", "route.start_turn=10", "walk.end=5"]
    )
    walk = plan.build()
    with pytest.raises(WalkError, match="folds"):
        walk.placement([walk.head_where_tail(float(walk.head_position([0.0])[0]))])
    rows = [(row.kind, row.head, row.tail) for row in timetable(plan, walk, *plan.span(walk))]
    assert rows == [("start", 0.0, None), ("end", 5.0, None)]


@pytest.mark.parametrize(
    ("clock", "start", "time", "text"),
    [
        ("18:30", 0.0, 65.0, "18:31:05"),
        ("18:30", -100.0, 0.0, "18:31:40"),
        ("23:59:30", 0.0, 45.0, "0:00:15"),
        ("", 0.0, 65.4, "1:05"),
        ("", -38.0, 15.27, "0:53"),
        ("", -38.0, -38.0, "0:00"),
        ("", -0.5, 2.0, "0:03"),
        ("9:05", 0.0, 59.6, "9:06:00"),
    ],
)
def test_times_are_times_of_day_where_the_plan_says_one(
    clock: str, start: float, time: float, text: str
) -> None:
    assert Clock(clock, start).tell(time) == text


def test_halves_of_seconds_are_rounded_up() -> None:
    assert [minutes(time) for time in (0.0, 0.5, 2.5, 59.4, 59.6, 130.0, 3600.0)] == [
        "0:00", "0:01", "0:03", "0:59", "1:00", "2:10", "60:00",
    ]  # fmt: skip


def test_the_stops_of_the_head_are_counted_where_cues_are_said(
    capsys: pytest.CaptureFixture[str], tmp_path: object
) -> None:
    plan = plan_with(HOLD, {"kind": "stop", "head": 20.0}, {"kind": "start", "at": 50.0})
    walk = plan.build()
    stops = stops_of(walk, *plan.span(walk))
    assert [one.end - one.start for one in stops] == pytest.approx([5.0, 50.0 - stops[1].start])
    assert [one.s for one in stops] == pytest.approx([16.0, 26.0])
    for one in stops:
        assert not walk.motion([one.start, one.end]).speed.any()
    assert stops_text(stops[:1]) == "stops of the head: 1, 5 s in all (11 s to 16 s)"
    clock = Clock("18:30", -38.0)
    assert stops_sentence(stops[:1], clock) == (
        "Stops of the head: 1, 5 s in all (18:30:49 to 18:30:54)."
    )
    assert stops_sentence((), clock) == "The head does not stop."
    report = check(plan.without_square())
    assert report.stops == stops
    record = verdict_of(report).stops
    assert record is not None
    assert [one.s for one in record] == pytest.approx([16.0, 26.0])
    assert verdict_of(check(plan_with().without_square())).stops is None
    assert run(["check", "spiral-in", "--set", "disc.radius=4.6", "--set", "dragon.benches=4", "--set",
                "cues.cue=[{kind='hold', head=9, hold=3}]", "--explain"]) == 0  # fmt: skip
    out = capsys.readouterr().out
    assert "stops of the head: 1, 3 s in all (10 s to 13 s)\n" in out
    assert "every handle stands when the head does" in out
    assert run(["check", "spiral-in", "--set", "disc.radius=4.6", "--set", "dragon.benches=4",
                "--json"]) == 0  # fmt: skip
    assert json.loads(capsys.readouterr().out)["stops"] is None


def test_beats_are_even_silent_in_a_hold_and_counted_in_before_the_start() -> None:
    plan = plan_with(HOLD, {"kind": "tempo", "at": 20.0, "tempo": 120}, tempo=60, bar=3)
    score = score_of(plan, *plan.span(plan.build()))
    assert (score.tempo, score.by_step) == (60.0, False)
    assert [(run.start, run.end, run.period, run.counted) for run in score.runs[:4]] == [
        (0.0, pytest.approx(11.0), 1.0, False),
        (pytest.approx(13.0), pytest.approx(16.0), 1.0, True),
        (pytest.approx(16.0), 20.0, 1.0, False),
        (20.0, pytest.approx(plan.span(plan.build())[1]), 0.5, False),
    ]
    assert [run.beats() for run in score.runs[:3]] == [11, 3, 4]
    assert list(score.strokes) == pytest.approx([11.0, 20.0])


def test_a_tempo_told_in_a_hold_is_that_of_the_bar_that_counts_in() -> None:
    plan = plan_with(HOLD, {"kind": "tempo", "at": 13.5, "tempo": 120}, tempo=60, bar=3)
    score = score_of(plan, *plan.span(plan.build()))
    last = plan.span(plan.build())[1]
    told = [time for run in score.runs for time in (run.start, run.end, run.period)]
    assert told == pytest.approx([0.0, 11.0, 1.0, 14.5, 16.0, 0.5, 16.0, last, 0.5])
    assert [run.counted for run in score.runs] == [False, True, False]


def test_a_tempo_that_is_not_said_is_a_step_a_beat() -> None:
    plan = plan_with(HOLD).with_value("walk.speed", 0.9).with_value("people.step", 0.6)
    score = score_of(plan, *plan.span(plan.build()))
    assert score.by_step
    assert score.tempo == pytest.approx(90.0)


def test_a_short_hold_counts_in_as_many_beats_as_there_is_time_for() -> None:
    plan = plan_with({**HOLD, "hold": 2.5}, tempo=60)
    counted = [run for run in score_of(plan, *plan.span(plan.build())).runs if run.counted]
    assert [run.beats() for run in counted] == [2]


def test_joints_are_called_by_what_happens_there() -> None:
    data = {"schema": 1, "dragon": {"benches": 9}, "route": {"kind": "turn"}, "walk": {"start": -5}}
    plan = checked(data, "turn")
    walk = plan.build()
    rows = timetable(plan, walk, *plan.span(walk))
    names = [row.name for row in rows if row.kind == "joint"]
    assert names == [
        "the turn begins",
        "right bend becomes left bend",
        "the turn ends",
    ]
    begins = next(row for row in rows if row.name == names[0])
    assert begins.head == pytest.approx(0.0, abs=1e-9), "time 0 of such a plan"
