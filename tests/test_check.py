"""Whether walks are safe, as the report and the command line say it."""

import json
import math
from pathlib import Path

import pytest
from python_calamine import CalamineWorkbook

from benchdragon import InputError
from benchdragon.check import check
from benchdragon.cli import run
from benchdragon.messages import use_language
from benchdragon.plan import read_plan
from benchdragon.speeds import greatest_speed


def spoken(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    code = run([*words, "--quiet"])
    out, err = capsys.readouterr()
    return code, out, err


def test_coiling_in_to_the_centre_is_not_safe(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = spoken(capsys, "check", "spiral-in", "--json")
    found = json.loads(out)
    assert (code, err) == (1, "")
    assert not found["safe"]
    first = found["first_contact"]
    assert first["value"] == pytest.approx(412.4738376821147, abs=1e-11)
    assert first["lower"] <= first["value"] <= first["upper"]
    assert first["witness"]["benches"] == [1, 9]
    assert found["clearance"]["value"] == 0.0
    assert found["greatest_speed"]["value"] == 1.0
    assert [finding["code"] for finding in found["findings"]] == ["contact"]
    assert found["plan_sha256"] == read_plan("spiral-in").sha256


@pytest.mark.parametrize(("pitch", "safe"), [(0.46, True), (0.44, False)])
def test_a_disc_is_reached_at_one_pitch_and_not_at_another(
    capsys: pytest.CaptureFixture[str], pitch: float, safe: bool
) -> None:
    settings = ("--set", "disc.radius=4.5", "--set", f"route.pitch={pitch}")
    code, out, _err = spoken(capsys, "check", "spiral-in", "--json", *settings)
    found = json.loads(out)
    assert found["safe"] is safe
    assert code == (0 if safe else 1)
    assert (found["first_contact"] is None) is safe
    assert (found["clearance"]["value"] > 0.0) is safe


def test_a_margin_is_checked_as_a_distance() -> None:
    settings = ["disc.radius=4.5", "route.pitch=0.46", "limits.margin=0.01"]
    report = check(read_plan("spiral-in", settings))
    assert [finding.code for finding in report.findings] == ["margin"]
    assert report.clearance.value > 0.0
    assert check(read_plan("spiral-in", [*settings[:2], "limits.margin=0.009"])).safe


def test_a_limit_of_speed_is_checked() -> None:
    fast = check(read_plan("turn", ["walk.speed=1.3", "dragon.benches=20"]))
    assert [finding.code for finding in fast.findings] == ["speed"]
    assert fast.greatest_speed.value == pytest.approx(1.3 * 1.6047933, rel=1e-3)
    assert check(read_plan("turn", ["walk.speed=1.2", "dragon.benches=20"])).safe


def test_the_turns_greatest_speed_is_bracketed() -> None:
    plan = read_plan("turn", ["dragon.benches=30"])
    walk = plan.build()
    found = greatest_speed(walk, *plan.span(walk), tolerance=1e-5)
    assert found.lower <= 1.604793378966638 <= found.upper
    assert found.upper - found.lower < 2e-5
    assert found.witness is not None
    assert found.witness.time == pytest.approx(14.4799695977, abs=0.1)


def test_a_head_that_slows_down_slows_all() -> None:
    settings = ["walk.profile=[[0, 1.0], [10, 2.0], [20, 0.5]]", "dragon.benches=10", "disc.radius=5"]
    plan = read_plan("spiral-in", settings)
    walk = plan.build()
    found = greatest_speed(walk, 0.0, 30.0)
    assert found.value == pytest.approx(2.0, rel=1e-3)
    assert found.upper <= 2.0 * (1.0 + 2e-3)


def test_the_report_reads_in_both_languages(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["check", "spiral-in", "--set", "disc.radius=4.5", "--quiet"]
    run(words)
    english = capsys.readouterr().out
    use_language("zh")
    try:
        run(words)
    finally:
        use_language("en")
    chinese = capsys.readouterr().out
    assert "SAFE from t = 0 s" in english
    assert "安全" in chinese
    assert "bench 20: right" in english
    assert "右侧" in chinese


def test_files_show_the_moment_of_contact(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    words = ["check", "spiral-in", "-o", str(tmp_path), "--set", "dragon.benches=40"]
    code, out, _err = spoken(capsys, *words)
    assert code == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "clearance.png", "contact.png", "result2.xlsx",
    ]  # fmt: skip
    assert all(str(path) in out for path in tmp_path.iterdir())
    rows = CalamineWorkbook.from_path(tmp_path / "result2.xlsx").get_sheet_by_index(0).to_python()
    assert len(rows) == 42
    assert rows[0][1:] == ["x (m)", "y (m)", "speed (m/s)"]
    head = read_plan("spiral-in", ["dragon.benches=40"]).build().motion([412.4738376821147])
    assert rows[1][1:] == pytest.approx([head.x[0, 0], head.y[0, 0], 1.0], abs=1e-9)
    code, _out, err = spoken(capsys, *words)
    assert code == 2
    assert "--force" in err


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (("check", "nowhere"), 3, "there is no plan nowhere"),
        (("check", "spiral-in", "-o", "x", "--format", "gif"), 2, "'gif'"),
        (("check", "spiral-in", "--set", "walk.speed=0"), 3, "never comes to the end"),
        (("check", "spiral-in", "--set", "limits.margin=-1"), 3, "limits.margin"),
        (("check", "spiral-in", "--set", "walk.end=-5"), 2, "must not come before"),
        (("solve", "colour", "spiral-in"), 2, "wanted one of pitch"),
        (("solve", "disc", "spiral-in"), 3, "disc.radius"),
        (("solve", "pitch", "spiral-in", "--range", "a:b"), 2, "LOW:HIGH"),
        (("solve", "width", "spiral-in", "--method", "traversal"), 2, "pitch alone"),
    ],
)
def test_wrong_words_end_in_one_sentence(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...], code: int, text: str
) -> None:
    ended, out, err = spoken(capsys, *words)
    assert (ended, out) == (code, "")
    assert text in err
    assert "Traceback" not in err


def test_the_smallest_pitch_is_solved_from_the_command_line(
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = ["solve", "pitch", "spiral-in", "--set", "disc.radius=4.5"]
    code, out, _err = spoken(capsys, *words, "--json")
    found = json.loads(out)
    assert code == 0
    assert found["value"] == pytest.approx(0.4503373930271955, abs=1e-13)
    code, out, _err = spoken(capsys, *words)
    assert "smallest pitch: 0.450337393027 m" in out
    code, out, _err = spoken(capsys, *words, "--method", "traversal", "--json")
    found = json.loads(out)
    assert (code, found["status"]) == (5, "undecided")
    assert found["value"] == pytest.approx(0.452)


def test_all_walkable_pitches_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["solve", "pitch", "spiral-in", "--set", "disc.radius=4.5", "--count", "3"]
    code, out, _err = spoken(capsys, *words, "--range", "0.44:0.46", "--json")
    assert code == 0
    ((low, high),) = json.loads(out)["walkable"]
    assert low == pytest.approx(0.4503373930271955, abs=2e-12)
    assert high == 0.46
    code, out, _err = spoken(capsys, *words, "--range", "0.40:0.41")
    assert (code, out.strip()) == (4, "no size tried is walkable")


def test_limits_of_acceleration_and_turning_rate_are_checked() -> None:
    settings = ["dragon.benches=20", "walk.speed=1.0", "turn.ease=1.0"]
    report = check(read_plan("turn", [*settings, "limits.turning_rate=20"]))
    assert [finding.code for finding in report.findings] == ["turning_rate"]
    found = report.findings[0]
    assert found.limit == pytest.approx(math.radians(20.0))
    assert found.value > found.limit
    assert check(read_plan("turn", [*settings, "limits.turning_rate=90"])).safe
    report = check(read_plan("turn", [*settings, "limits.acceleration=0.1"]))
    assert [finding.code for finding in report.findings] == ["acceleration"]
    with pytest.raises(InputError, match="steady head"):
        check(read_plan("turn", [*settings, "limits.acceleration=9", "walk.profile=[[0,1],[9,1.2]]"]))


def test_the_greatest_head_speed_is_on_the_command_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    code, out, _err = spoken(capsys, "solve", "speed", "turn", "--json")
    assert code == 0
    assert json.loads(out)["value"] == pytest.approx(1.246266358157487, abs=1e-9)
    path = tmp_path / "paced.dragon.toml"
    words = ["solve", "speed", "turn", "--set", "walk.speed=1.5", "--set", "dragon.benches=20"]
    code, out, _err = spoken(capsys, *words, "--pace", str(path))
    assert code == 0
    assert "slowing down only where it must" in out
    assert check(read_plan(str(path))).safe
    assert spoken(capsys, "solve", "speed", "spiral-in")[0] == 2
    assert spoken(capsys, "solve", "pitch", "spiral-in", "--pace", str(path))[0] == 2


@pytest.mark.parametrize(
    ("what", "option"),
    [
        ("pitch", "--plan-file=x.toml"),
        ("pitch", "--longest=12"),
        ("disc", "--objective=speed"),
        ("turn", "--pace=x.toml"),
        ("turn", "--prove"),
        ("speed", "--method=traversal"),
        ("speed", "--range=1:2"),
    ],
)
def test_options_that_say_nothing_there_are_refused(
    capsys: pytest.CaptureFixture[str], what: str, option: str
) -> None:
    code, out, err = spoken(capsys, "solve", what, "turn", option)
    assert (code, out) == (2, "")
    assert f"{option.partition('=')[0]} does not go with {what}" in err
