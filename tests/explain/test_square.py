"""How a check searched the square, with the numbers of the case."""

import re

import pytest

from benchdragon.analysis.check import check
from benchdragon.explain.contact import check_lines
from benchdragon.explain.square import MOST_OBSTACLES, square_lines
from benchdragon.plans.schema import read_plan
from tests.figures.test_square import NEAR, PLAN, SAID


def test_a_check_without_a_square_says_nothing_of_one() -> None:
    assert square_lines(check(read_plan("turn", ["dragon.benches=20", "walk.end=60"]))) == []


def test_each_size_of_bench_is_told_with_its_stretch_of_route() -> None:
    report = check(PLAN)
    lines = check_lines(report)
    heads = report.walk.head_position([report.start, report.end])
    told = [re.findall(r"[-\d.]+", line) for line in lines if line.startswith("Size of bench")]
    assert [(row[0], row[1]) for row in told] == [("1", "1"), ("2", "19")]
    assert float(told[0][3].rstrip(".")) == pytest.approx(heads[1], abs=1e-6)
    tail = report.walk.placement(heads).s
    low, high, way = float(told[1][2]), float(told[1][3]), float(told[1][4])
    assert low == pytest.approx(tail[0, -2], abs=1e-5)
    assert way == pytest.approx(high - low, abs=1e-5)


def test_the_least_distance_is_worked_out_from_point_to_point() -> None:
    report = check(PLAN)
    (line,) = (line for line in square_lines(report) if line.startswith("Least distance from well"))
    said = float(re.findall(r"= ([\d.]+) m; bracket", line)[0])
    assert said == pytest.approx(report.obstacles[1].distance.value, abs=1e-7)


def test_a_margin_that_is_not_kept_is_told_with_its_bracket() -> None:
    lines = square_lines(check(NEAR))
    (line,) = (line for line in lines if "is the first to come nearer than 0.3 m to well" in line)
    assert "Bench 1 is the first" in line


def test_of_many_obstacles_those_with_the_least_room_are_told() -> None:
    posts = ", ".join(f'{{kind="circle", centre=[{20 + n}, -9], radius=0.1}}' for n in range(9))
    lines = square_lines(check(read_plan("turn", [*SAID[:-1], f"obstacle=[{posts}]"])))
    assert len([line for line in lines if line.startswith("Least distance")]) == MOST_OBSTACLES
    assert lines[-1].startswith(f"The other obstacles, {10 - MOST_OBSTACLES} of them")
