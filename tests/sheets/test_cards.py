"""Sheets and the chalk plan measure from one peg."""

import re
from pathlib import Path

import pytest

from benchdragon.errors import InputError
from benchdragon.explain.bench_basis import bench_text
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.chalk import chalk_drawing, list_rows
from tests.sheets.village import small


@pytest.fixture(scope="module")
def ours(tmp_path_factory: pytest.TempPathFactory) -> Briefing:
    """What the papers of the small dance are made from."""
    return small(tmp_path_factory.mktemp("ours"), "route.at=[0.67,-1.5]")


@pytest.mark.parametrize("survey", [[], ["survey.crs=EPSG:4549", "survey.origin=[500000,3000000]"]])
def test_sheets_and_chalk_plan_measure_from_one_peg(
    tmp_path: Path, ours: Briefing, survey: list[str]
) -> None:
    for one in (ours, small(tmp_path, "chalk.peg=[2, 3]", *survey)):
        marks = chalk_drawing(one).marks
        start = marks.kinds.index("start")
        place = bench_text(one.plan, one.benches[0], one.called, one.ground).place[0]
        assert f" {marks.radius[start]:.2f} m from it " in place
        assert f" {round(marks.angle[start]) % 360}° from " in place
        _n, _way, x, y, *_rest = list(list_rows(marks))[start]
        told = [float(number) for number in re.findall(r"[xy] = (-?[\d.]+) m", place)]
        assert told == pytest.approx([x, y], abs=0.0076)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["chalk.peg=[1e8, 0]"], "m from the nearest mark, farther than 200 m"),
        (
            ["chalk.every=0.1", "route.start_turn=60", "walk.end=600"],
            "are more than 5000: ask for at least",
        ),
    ],
)
def test_marks_that_cannot_be_laid_out_are_refused_whatever_papers_are_wanted(
    tmp_path: Path, settings: list[str], said: str
) -> None:
    with pytest.raises(InputError, match=said):
        small(tmp_path, *settings)
