"""Whether walks are safe, as the report and the command line say it."""

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import pytest
from python_calamine import CalamineWorkbook

from benchdragon.analysis.check import check, sentence
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.contact import least_clearance
from benchdragon.analysis.findings import all_findings
from benchdragon.analysis.speed import QUANTITIES, greatest, greatest_speed
from benchdragon.cli.answers import print_answer
from benchdragon.cli.check import print_report
from benchdragon.cli.main import run
from benchdragon.i18n import use_language
from benchdragon.model.answer import Answer, Witness
from benchdragon.number_format import figures
from benchdragon.plans.schema import checked, read_plan


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
    codes = [(finding["code"], finding["kind"]) for finding in found["findings"]]
    assert codes == [("BD101", "contact")]
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
    assert [finding.kind for finding in report.findings] == ["margin"]
    assert report.clearance.value > 0.0
    assert check(read_plan("spiral-in", [*settings[:2], "limits.margin=0.009"])).safe


def test_a_limit_of_speed_is_checked() -> None:
    fast = check(read_plan("turn", ["walk.speed=1.3", "dragon.benches=20"]))
    assert [finding.kind for finding in fast.findings] == ["speed"]
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
    assert rows[0] == ["", "横坐标x (m)", "纵坐标y (m)", "速度 (m/s)"]
    head = read_plan("spiral-in", ["dragon.benches=40"]).build().motion([412.4738376821147])
    assert rows[1][1:] == [round(head.x[0, 0], 6), round(head.y[0, 0], 6), 1.0]
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
        (("solve", "disc", "spiral-in"), 3, "disc.radius"),
        (("solve", "pitch", "spiral-in", "--range", "a:b"), 2, "LOW..HIGH"),
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
    assert "smallest pitch: 0.45034 m (found)\n" in out  # rounded up: 0.45033 m would touch
    assert "in 0.450337" not in out
    code, out, _err = spoken(capsys, *words, "--brackets")
    value, lower, upper = found["value"], found["lower"], found["upper"]
    assert f"smallest pitch: {value!r} m (found; between {lower!r} and {upper!r})\n" in out
    code, out, _err = spoken(capsys, *words, "--method", "traversal", "--json")
    found = json.loads(out)
    assert (code, found["status"]) == (5, "undecided")
    assert found["value"] == pytest.approx(0.452)


def test_all_walkable_pitches_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["solve", "pitch", "spiral-in", "--set", "disc.radius=4.5", "--count", "3"]
    code, out, _err = spoken(capsys, *words, "--range", "0.44..0.46", "--json")
    assert code == 0
    ((low, high),) = json.loads(out)["safe"]
    assert low == pytest.approx(0.4503373930271955, abs=2e-12)
    assert high == 0.46
    assert json.loads(out)["borders"] == [[low]]
    code, out, _err = spoken(capsys, *words, "--range", "0.44..0.46")
    assert out.splitlines() == [
        f"safe from {low:.12g} m to 0.46 m (sizes tried there: 1, 0.01 m apart)",
        f"  {low:.12g} m is a border: just beyond it the walk is not safe",
    ]
    code, out, _err = spoken(capsys, *words, "--range", "0.40..0.41")
    assert (code, out.strip()) == (4, "no size tried is safe")


def test_limits_of_acceleration_and_turning_rate_are_checked() -> None:
    settings = ["dragon.benches=20", "walk.speed=1.0", "turn.ease=1.0"]
    report = check(read_plan("turn", [*settings, "limits.turning_rate=20"]))
    assert [finding.kind for finding in report.findings] == ["turning_rate"]
    found = report.findings[0]
    assert found.limit == pytest.approx(math.radians(20.0))
    assert found.value > found.limit
    assert check(read_plan("turn", [*settings, "limits.turning_rate=90"])).safe
    report = check(read_plan("turn", [*settings, "limits.acceleration=0.1"]))
    assert [finding.kind for finding in report.findings] == ["acceleration"]


COIL = ["disc.radius=5", "dragon.benches=20"]


def test_a_head_that_changes_its_speed_too_fast_is_found(capsys: pytest.CaptureFixture[str]) -> None:
    jolt = ["--set", "walk.profile=[[0, 0], [0.1, 1]]", *(w for s in COIL for w in ("--set", s))]
    limit = ["--set", "limits.head_acceleration=0.01"]
    code, out, _err = spoken(capsys, "check", "spiral-in", *jolt, *limit, "--json")
    (found,) = json.loads(out)["findings"]
    assert (code, found["kind"]) == (1, "head_acceleration")
    assert (found["value"], found["limit"], found["time"]) == (pytest.approx(10.0), 0.01, 0.0)
    assert "10.000 m/s^2 from t = 0 s on, the limit being 0.01 m/s^2" in found["text"]["en"]
    assert spoken(capsys, "check", "spiral-in", *jolt)[0] == 1  # 0.5 m/s^2 where the plan does not say
    assert spoken(capsys, "check", "spiral-in", *jolt, "--set", "limits.head_acceleration=10")[0] == 0
    assert spoken(capsys, "check", "spiral-in", *jolt, *limit, "--set", "walk.start=0.1")[0] == 0


def test_a_head_that_stops_too_fast_is_found() -> None:
    profile = "walk.profile=[[0, 0], [3, 1], [20, 1], [21, 0], [22, 0], [25, 1]]"
    plan = read_plan("spiral-in", [*COIL, profile])
    (found,) = check(plan).findings
    assert (found.kind, found.value, found.time) == ("head_acceleration", 1.0, 20.0)


def test_what_is_not_decided_is_said_and_not_taken_for_kept() -> None:
    plan = read_plan("spiral-in", [*COIL, "limits.acceleration=2", "limits.speed=2"])
    walk = plan.build()
    near = Witness(7.0, 7.0, (3,), (0.0, 0.0), math.nan)
    for lower, upper, decided in ((1.9, 2.1, False), (2.1, 2.2, True), (1.8, 1.9, None)):
        open_ = Answer(lower, lower, upper, "", "found", near)
        peaks = {"speed": open_, "acceleration": open_}
        found = all_findings(plan, walk, (0.0, 9.0), None, (), peaks, ())
        told = [] if decided is None else [(name, decided) for name in peaks]
        assert [(finding.kind, finding.decided) for finding in found] == told


@pytest.mark.parametrize("name", [name for name in QUANTITIES if name != "speed"])
def test_every_limit_holds_while_the_head_starts_and_stops(name: str) -> None:
    profile = "[[-20, 0], [-17, 1], [3, 1], [5, 0], [9, 0], [12, 1]]"
    settings = ["dragon.benches=15", f"walk.profile={profile}", "walk.end=30"]
    plan = read_plan("turn", settings)
    walk = plan.build()
    peak = greatest(walk, QUANTITIES[name], *plan.span(walk), tolerance=1e-7)
    unit = math.degrees(1.0) if name == "turning_rate" else 1.0
    for change, safe in ((1e-6, True), (-1e-6, False)):
        limit = peak.upper * unit * (1.0 + change)
        report = check(read_plan("turn", [*settings, f"limits.{name}={limit!r}"]))
        assert report.safe is safe
        assert [finding.kind for finding in report.findings] == ([] if safe else [name])
        assert report.peaks[name].lower <= peak.upper
        assert report.peaks[name].upper >= peak.lower
    assert QUANTITIES[name].text in report.findings[0].text


def test_what_is_just_as_fast_as_it_may_be_keeps_its_limit() -> None:
    even = check(read_plan("spiral-in", [*COIL, "limits.speed=1"]))
    assert (even.safe, even.greatest_speed.value) == (True, 1.0)
    parts = [{"kind": "line", "length": 60.0}]
    limits = {"acceleration": 0.25, "total_acceleration": 0.25, "head_acceleration": 0.25}
    data = {"schema": 1, "dragon": {"benches": 4}, "route": {"part": parts}, "limits": limits}
    data["walk"] = {"profile": [[0.1, 0.0], [4.1, 1.0]], "position": 20.0}
    assert check(checked(data, "line")).safe


def test_limits_are_told_of_where_they_are_kept(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["check", "spiral-in", "--set", "limits.lateral_acceleration=0.5"]
    words += [word for setting in COIL for word in ("--set", setting)]
    code, out, _err = spoken(capsys, *words, "--json")
    (found,) = json.loads(out)["peaks"]
    assert found["name"] == "lateral_acceleration"
    peak = found["peak"]
    assert (code, peak["unit"], peak["status"]) == (0, "m/s^2", "found")
    assert 0.19 < peak["lower"] <= peak["upper"] < 0.21
    assert "greatest lateral acceleration of a handle: 0.2" in spoken(capsys, *words)[1]
    report = check(read_plan("spiral-in", [*COIL, "limits.lateral_acceleration=0.5"]))
    assert "lateral acceleration of a handle at most 0.201 m/s^2 of 0.5 m/s^2 allowed" in sentence(
        report
    )


def test_the_greatest_head_speed_is_on_the_command_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    code, out, _err = spoken(capsys, "solve", "speed", "turn", "--json")
    assert code == 0
    assert json.loads(out)["value"] == pytest.approx(1.246266358157487, abs=1e-9)
    path = tmp_path / "paced.dragon.toml"
    words = ["solve", "speed", "turn", "--set", "walk.speed=1.5", "--set", "dragon.benches=20"]
    code, out, _err = spoken(capsys, *words, "--pace", "-o", str(path))
    assert code == 0
    assert "slowing down only where it must" in out
    assert check(read_plan(str(path))).safe
    assert spoken(capsys, "solve", "speed", "spiral-in")[0] == 2


@pytest.mark.parametrize(
    ("value", "up", "text"),
    [
        (0.4503373930271955, True, "0.45034"),
        (0.4503373930271955, False, "0.45033"),
        (1.246266358157487, False, "1.2462"),
        (412.4738376821147, False, "412.47"),
        (0.45, True, "0.45"),
        (2.0, False, "2.0"),
        (-0.000123456, True, "-0.00012345"),
        (1234567.0, True, "1234600"),
        (0.0, True, "0.0"),
    ],
)
def test_figures_are_rounded_to_the_side_that_stays_true(value: float, up: bool, text: str) -> None:
    assert figures(value, up=up) == text


def test_what_rounding_alone_adds_to_a_bracket_is_not_shown(capsys: pytest.CaptureFixture[str]) -> None:
    """A head at 1 m/s is the fastest handle; its bracket ends at 1.000000000001, not at 1.0001."""
    print_answer("speed", answer_with(1.0, 1.0, 1.0 + 1e-12), up=True, brackets=False)
    print_answer("speed", answer_with(1.0, 1.0, 1.0 + 1e-9), up=True, brackets=False)
    print_answer("room", answer_with(0.5 - 1e-12, 0.5, 0.5), up=False, brackets=False)
    print_answer("room", answer_with(0.5 - 1e-9, 0.5, 0.5), up=False, brackets=False)
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith(" ")]
    assert [line.split()[1] for line in lines] == ["1.0", "1.0001", "0.5", "0.49999"]


def test_what_holds_up_to_a_contact_alone_is_said_to(capsys: pytest.CaptureFixture[str]) -> None:
    """Up to the first time within the margin 5 cm are kept; later these benches touch."""
    words = ["check", "spiral-in", "--set", "dragon.benches=30"]
    _code, out, _err = spoken(capsys, *words, "--set", "limits.margin=0.05")
    lines = [line for line in out.splitlines() if not line.startswith(" ")]
    assert [line.partition(":")[0] for line in lines[2:]] == [
        "not checked", "first nearer than 0.05 m", "until then", "least clearance",
        "greatest speed of a handle",
    ]  # fmt: skip
    _code, out, _err = spoken(capsys, *words, "--set", "disc.radius=6")
    assert "until then" not in out


def test_a_speed_that_is_kept_is_not_said_to_exceed_its_limit() -> None:
    """1.246266 m/s of 1.24627 m/s allowed: in three digits 1.25 m/s were walked."""
    report = check(read_plan("spiral-in", [*COIL, "limits.speed=1.24627", "walk.speed=1.246266"]))
    assert report.safe
    assert "fastest handle 1.24627 m/s of 1.24627 m/s allowed" in sentence(report)
    assert "fastest handle 1.24627 m/s of 1.24627 m/s allowed" in sentence(report, Clock("", 0.0))


def answer_with(lower: float, value: float, upper: float) -> Answer:
    witness = Witness(412.4738376, 412.4738376, (1, 9), (1.23456, -7.891), -1e-17)
    return Answer(value, lower, upper, "m", "found", witness)


@pytest.mark.parametrize(
    ("up", "shown"), [(True, "size: 0.45001 m (found)"), (False, "size: 0.44999 m (found)")]
)
def test_readers_get_the_end_of_the_bracket_that_is_surely_true(
    capsys: pytest.CaptureFixture[str], up: bool, shown: str
) -> None:
    print_answer("size", answer_with(0.44999999, 0.45, 0.45000001), up=up, brackets=False)
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == shown
    assert lines[1].startswith("  benches 1 and 9 at t = 412.47 s, at (1.23, -7.89) m")


def test_an_open_bracket_shows_the_value(capsys: pytest.CaptureFixture[str]) -> None:
    print_answer("size", answer_with(0.1, 0.45, math.inf), up=True, brackets=False)
    assert capsys.readouterr().out.startswith("size: 0.45 m (found)")


def test_papers_tell_a_safe_walk_as_the_village_does() -> None:
    """The head's bench is called so, times are minutes, and a speed is no less than it is, in mm/s."""
    said = ("walk.start=-6", "people.unit=qiao", "people.count_head=false", "limits.speed=2")
    report = check(read_plan("turn", ["dragon.benches=30", "walk.end=94", *said]))
    near, fastest = report.clearance.witness, report.greatest_speed.value
    assert near is not None
    assert near.time is not None
    a, b = ("the head" if bench == 1 else f"qiao {bench - 1}" for bench in near.benches)
    told = sentence(report, Clock("", -6.0))
    minutes, seconds = divmod(math.floor(near.time + 6.5), 60)
    assert f" m, {a} with {b}, at {minutes}:{seconds:02d};" in told
    shown = float(re.search(r"fastest handle (\d\.\d{3}) m/s", told)[1])  # type: ignore[index]
    assert fastest <= shown < fastest + 0.001
    plain, cut = sentence(report), math.floor(100.0 * near.time) / 100.0
    assert f"bench {near.benches[0]} with bench {near.benches[1]}, at {cut:.2f} s" in plain


# The least gap of this coil is 1.47e-17 m: benches 1 and 20, 216.338 s.
HAIR = ("disc.radius=4.5", "route.pitch=0.4503373930271955", "dragon.benches=30")


@pytest.mark.parametrize("wall", [(), ('obstacle=[{kind="line", points=[[-90, -90], [90, -90]]}]',)])
def test_a_gap_that_rounding_hides_keeps_an_upper_end_and_is_never_told_as_0(
    capsys: pytest.CaptureFixture[str], wall: tuple[str, ...]
) -> None:
    plan = read_plan("spiral-in", [*HAIR, *wall])
    found = least_clearance(plan.build(), 0.0, plan.span(plan.build())[1])
    assert found.lower == 0.0 <= found.value < 1.47e-17 < found.upper < 2e-13
    open_still = check(plan)
    assert open_still.clearance.upper > 0.0
    hidden = replace(found, unit="m")
    square = tuple(replace(one, distance=hidden) for one in open_still.obstacles)
    shown = replace(
        open_still, first_contact=None, clearance=hidden, findings=(), obstacles=square, proved=True
    )
    print_report(shown)
    told = capsys.readouterr().out
    assert re.search(r"least clearance: less than 1\.\de-13 m \(found\)", told)
    gaps = re.findall(r"less than 1\.\de-13 m", sentence(shown))
    assert len(gaps) == 1 + len(wall)
    assert "m, bench 1 with bench 20, at" in sentence(shown, Clock("", 0.0))
    assert not re.search(r"(?<![\d.])0(\.0)? c?m\b", told + sentence(shown))


def test_what_surely_touches_has_no_clearance() -> None:
    found = check(read_plan("spiral-in", [*HAIR[::2], "route.pitch=0.45"]))
    assert (found.clearance.lower, found.clearance.upper) == (0.0, 0.0)


def test_a_graze_that_a_walk_ends_in_has_an_upper_end_of_its_clearance() -> None:
    report = check(read_plan("spiral-in", [*HAIR, "walk.end=216.33821411036504"]))
    assert not report.decided
    assert report.first_contact is not None
    assert report.first_contact.witness is not None
    assert report.first_contact.witness.gap <= 0.0
    assert report.clearance.lower == 0.0 < report.clearance.upper < 1e-12
