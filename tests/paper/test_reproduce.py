import json
from pathlib import Path

import pytest
from python_calamine import CalamineWorkbook

from benchdragon.cli.main import run
from benchdragon.explain.text import number
from benchdragon.files import FileRefusedError
from benchdragon.paper.explanation import reproduce_lines
from benchdragon.paper.reproduce import planned_files, reproduce
from tests.calculator import agree, chinese_or_not

# What the paper comes to is computed once, by one worker.
pytestmark = pytest.mark.xdist_group("paper")

TRUTH = json.loads((Path(__file__).parents[1] / "truth" / "contest.json").read_text("utf-8"))


def answers(folder: Path) -> dict[str, dict[str, float]]:
    """What `answers.json` holds."""
    found: dict[str, dict[str, float]] = json.loads((folder / "answers.json").read_text("utf-8"))
    return found


def test_every_planned_file_is_there_and_nothing_else(folder: Path) -> None:
    assert sorted(folder.iterdir()) == sorted(planned_files(folder))
    assert all(path.stat().st_size > 1000 for path in folder.iterdir())


def test_the_contests_table_is_met(folder: Path) -> None:
    rows: list[dict[str, float]] = json.loads((folder / "answers.json").read_text())["table"]
    assert len(rows) == 42
    for row in rows:
        x, y, speed = TRUTH["spiral_in_055"][str(int(row["time_s"]))][str(row["handle"])]
        assert row["x_m"] == pytest.approx(float(x), abs=1e-11)
        assert row["y_m"] == pytest.approx(float(y), abs=1e-11)
        assert row["speed_m_s"] == pytest.approx(float(speed), abs=1e-12)


def test_the_spreadsheet_holds_all_handles_and_seconds(folder: Path) -> None:
    book = CalamineWorkbook.from_path(folder / "result1.xlsx")
    places, speeds = (book.get_sheet_by_index(i).to_python() for i in (0, 1))
    assert (len(places), len(places[0])) == (449, 302)
    assert (len(speeds), len(speeds[0])) == (225, 302)
    x, y, speed = TRUTH["spiral_in_055"]["300"]["223"]
    assert places[-2][-1] == round(float(x), 6)
    assert places[-1][-1] == round(float(y), 6)
    assert speeds[-1][-1] == round(float(speed), 6)


def test_the_checks_of_each_method_come_out_as_they_should(folder: Path) -> None:
    found = answers(folder)
    assert found["largest_chord_error_m"] < 1e-12  # type: ignore[operator]
    assert found["runge_kutta"]["rk4_step_0.1_s_m"] < 1e-10
    assert found["runge_kutta"]["adaptive_m"] < 1e-10
    assert found["runge_kutta"]["rk4_order"] == pytest.approx(4.0, abs=0.1)
    for scheme, order in (("forward", 1.0), ("central", 2.0), ("backward", 1.0)):
        row: dict[str, float] = found["differences"][scheme]  # type: ignore[assignment]
        assert row["order"] == pytest.approx(order, abs=0.05)
        assert 1e-5 < row["head_speed_error_m_s"] < 1e-2


def test_the_papers_turn_comes_out_to_its_digits(folder: Path) -> None:
    turn = answers(folder)["turn"]
    assert turn["length_m"] == pytest.approx(float(TRUTH["two_arc"]["length"]), abs=1e-12)
    printed = {"theta_max1": 4.0055, "theta_min1": 0.9841, "theta_min2": -2.1575, "theta_max2": 0.8639}
    assert {name: round(turn[name], 4) for name in printed} == pytest.approx(printed, abs=1.5e-4)


def test_a_second_run_is_refused_unless_forced(folder: Path) -> None:
    with pytest.raises(FileRefusedError):
        reproduce(folder)


@pytest.mark.usefixtures("ready")
def test_the_command_prints_answers_and_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["reproduce", "-o", str(tmp_path / "a"), "--explain"]) == 0
    out = capsys.readouterr().out
    contact, pitch, place = out.splitlines()[:3]
    assert contact.endswith(f"t = {float(TRUTH['first_contact_s']):.9f} s")
    assert pitch.endswith(f"is {float(TRUTH['smallest_pitch_m']):.9f} m")
    assert str(tmp_path / "a" / "report.html") in place
    assert "measured order of RK4 3.97" in out
    assert "4.0055, 0.9841, -2.1575, 0.8639" in out
    assert str(tmp_path / "a" / "result1.xlsx") in out
    assert run(["reproduce", "-o", str(tmp_path / "a"), "--json", "--force", "--explain"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["files"][0].endswith("report.html")
    explained = [f"{n:3}. {line}" for n, line in enumerate(answer["explanation"], start=1)]
    assert out.splitlines()[-len(explained) :] == explained


def test_each_part_is_explained(folder: Path, spoken: str) -> None:
    found = json.loads((folder / "answers.json").read_text("utf-8"))
    lines = reproduce_lines(found)
    agree(lines, 13)
    chinese_or_not(lines, spoken)
    assert f"{number(found['turn']['greatest_head_speed']['value'])} m/s" in " ".join(lines)


def test_contact_and_pitch_come_out_as_the_truth_has_them(folder: Path) -> None:
    found = json.loads((folder / "answers.json").read_text("utf-8"))
    assert found["contact"]["first"]["value"] == pytest.approx(
        float(TRUTH["first_contact_s"]), abs=1e-11
    )
    for row in found["contact"]["table"]:
        x, y, speed = (float(number) for number in TRUTH["at_first_contact"][str(row["handle"])])
        assert row["x_m"] == pytest.approx(x, abs=1e-10)
        assert row["y_m"] == pytest.approx(y, abs=1e-10)
        assert row["speed_m_s"] == pytest.approx(speed, abs=1e-10)
    pitch = found["pitch"]
    assert {found["contact"]["first"]["status"], pitch["smallest"]["status"]} == {"found"}
    assert pitch["smallest"]["value"] == pytest.approx(float(TRUTH["smallest_pitch_m"]), abs=1e-13)
    assert pitch["before_disc_m"] == pytest.approx(4.595723632, abs=2e-6)
    traversed = {
        (row["pitch_step_m"], row["time_step_s"]): row["pitch_m"] for row in pitch["traversal"]
    }
    assert traversed[0.002, 1.0] == pytest.approx(0.452)
    assert traversed[0.001, 1.0] == pytest.approx(0.451)


def test_the_moment_of_contact_is_in_the_contests_layout(folder: Path) -> None:
    rows = CalamineWorkbook.from_path(folder / "result2.xlsx").get_sheet_by_index(0).to_python()
    assert (len(rows), len(rows[0])) == (225, 4)
    x, y, speed = (float(number) for number in TRUTH["at_first_contact"]["223"])
    assert rows[-1] == ["龙尾（后）", round(x, 6), round(y, 6), round(speed, 6)]


def test_the_turn_s_motion_speed_and_clearance_are_the_truth(folder: Path) -> None:
    turn = json.loads((folder / "answers.json").read_text("utf-8"))["turn"]
    assert len(turn["table"]) == 42
    for row in turn["table"]:
        truth = TRUTH["two_arc_motion"][str(int(row["time_s"]))][str(row["handle"])]
        x, y, speed = (float(number) for number in truth)
        assert row["x_m"] == pytest.approx(x, abs=1e-11)
        assert row["y_m"] == pytest.approx(y, abs=1e-11)
        assert row["speed_m_s"] == pytest.approx(speed, abs=1e-11)
    head = turn["greatest_head_speed"]
    allowed = float(TRUTH["greatest_head_speed"])
    assert head["value"] == head["lower"] <= allowed <= head["upper"]
    assert head["value"] == pytest.approx(allowed, abs=3e-12)
    assert head["witness"]["time"] == pytest.approx(float(TRUTH["greatest_ratio_at_s"]), abs=1e-6)
    near = turn["clearance"]
    assert near["witness"]["gap"] == pytest.approx(0.2791, abs=1e-4)
    assert near["witness"]["benches"] == [1, 17]
    assert near["witness"]["time"] == pytest.approx(30.15, abs=0.3)


def test_shorter_turns_come_out_faster(folder: Path) -> None:
    turn = json.loads((folder / "answers.json").read_text("utf-8"))["turn"]
    for wanted, best in zip((1.3,), turn["better"], strict=True):
        assert best["greatest_head_speed"]["lower"] >= wanted * (1.0 - 1e-6)
        assert best["length"] <= best["way"] < turn["length_m"]
        assert best["least_radius"] >= min(turn["radii_m"]) * (1.0 - 1e-6)
        assert best["clearance"]["lower"] > 0.2


def test_the_turn_s_spreadsheet_holds_all_handles_and_seconds(folder: Path) -> None:
    book = CalamineWorkbook.from_path(folder / "result4.xlsx")
    places, speeds = (book.get_sheet_by_index(i).to_python() for i in (0, 1))
    assert (len(places), len(places[0])) == (449, 202)
    assert (len(speeds), len(speeds[0])) == (225, 202)
    x, y, _speed = (float(number) for number in TRUTH["two_arc_motion"]["100"]["223"])
    assert places[-2][-1] == round(x, 6)
    assert places[-1][-1] == round(y, 6)
