"""What a check did not look at is told beside the verdict; a route shorter than a dragon is found."""

import json
from pathlib import Path

import pytest

from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.not_looked_at import BRIEF, TEXTS
from benchdragon.analysis.records import verdict_of
from benchdragon.cli.check import print_report
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import read_plan

CASES = Path(__file__).parents[1] / "cases" / "village"
LINE = 'schema = 1\n[route]\nkind = "parts"\npart = [{{kind = "line", length = {length}}}]\n{more}'
SQUARE = "[venue]\nrectangle = [200, 200]\n[people]\nsway = 0.05\n[limits]\nspeed = 2\n"


def kinds(report: Report) -> list[str]:
    return [one.kind for one in report.not_looked_at]


def line(tmp_path: Path, length: float, more: str) -> Report:
    path = tmp_path / "line.dragon.toml"
    path.write_text(LINE.format(length=length, more=more), "utf-8")
    return check(read_plan(str(path)))


def test_a_street_without_walls_is_told_so_in_every_text(capsys: pytest.CaptureFixture[str]) -> None:
    report = check(read_plan(str(CASES / "street.dragon.toml")))
    assert report.safe
    assert kinds(report) == ["street", "speed", "behind"]
    way = float(report.walk.dragon.links.sum())
    print_report(report)
    printed = capsys.readouterr().out
    for one in report.not_looked_at:
        assert one.text in printed
        assert one.brief in sentence(report)
    assert f"{way:.3f} m of the dragon, benches 1 to 60, stand on a straight line" in printed
    record = json.loads(verdict_of(report).model_dump_json())["not_looked_at"]
    assert [(one["kind"], one["text"]["en"]) for one in record] == [
        (one.kind, one.text) for one in report.not_looked_at
    ]
    with spoken_in("zh"):
        assert f"起点后面的 {way:.3f} m 地面" in sentence(report)


def test_a_drawing_of_millimetres_is_shorter_than_its_dragon() -> None:
    report = check(read_plan(str(CASES / "no_unit.dragon.toml")))
    (found,) = report.findings
    assert (found.code, found.decided, report.safe) == ("BD104", True, False)
    assert "the drawn route is 0.135 m long, the dragon 100.210 m" in found.text
    assert "survey.unit" in sentence(report)
    assert kinds(report)[-2:] == ["behind", "still behind"]


def test_a_plan_that_says_all_leaves_nothing_out(tmp_path: Path) -> None:
    dragon = "[dragon]\nbenches = 5\n[walk]\nposition = 30\n"
    assert kinds(line(tmp_path, 50.0, dragon + SQUARE)) == []
    assert "not checked" not in sentence(line(tmp_path, 50.0, dragon + SQUARE))


@pytest.mark.parametrize(("short", "found"), [(-0.01, ["BD104"]), (0.01, [])])
def test_a_route_is_as_long_as_its_dragon_or_it_is_a_finding(
    tmp_path: Path, short: float, found: list[str]
) -> None:
    more = "[dragon]\nbenches = 5\n" + SQUARE
    links = float(line(tmp_path, 50.0, more).walk.dragon.links.sum())
    report = line(tmp_path, links + short, more)
    assert [one.code for one in report.findings] == found
    assert kinds(report) == (["behind", "still behind"] if found else ["behind"])


def test_a_walk_that_ends_early_says_which_benches_never_come_to_the_route(tmp_path: Path) -> None:
    report = line(tmp_path, 50.0, "[dragon]\nbenches = 5\n[walk]\nend = 3\n" + SQUARE)
    links = report.walk.dragon.links
    assert report.safe
    behind, still = report.not_looked_at
    assert float(behind.words["way"]) == pytest.approx(links.sum(), abs=1e-3)
    assert float(still.words["way"]) == pytest.approx(links.sum() - 3.0, abs=1e-3)
    assert (behind.words["first"], still.words["first"]) == ("1", "2")


@pytest.mark.parametrize("plan", ["spiral-in", "turn"])
def test_who_stands_on_the_spiral_stands_on_no_other_line(plan: str) -> None:
    assert kinds(check(read_plan(plan, ["dragon.benches=20", "walk.end=20"])))[:2] == [
        "square",
        "people",
    ]
    assert "behind" not in kinds(check(read_plan(plan, ["dragon.benches=20", "walk.end=20"])))


def test_what_stands_on_a_square_without_an_edge_leaves_the_edge_out(tmp_path: Path) -> None:
    well = '[[obstacle]]\nkind = "circle"\ncentre = [0, 50]\nradius = 1\n'
    assert kinds(line(tmp_path, 50.0, "[dragon]\nbenches = 5\n" + well))[0] == "venue"


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_manual_tells_each_kind(language: str) -> None:
    page = (Path(__file__).parents[2] / "docs" / language / "findings.md").read_text("utf-8")
    assert all(f"| `{kind}` |" in page for kind in TEXTS)
    assert TEXTS.keys() == BRIEF.keys()
