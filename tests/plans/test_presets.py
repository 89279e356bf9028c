"""Presets: the same name means the same plan everywhere."""

import re

import pytest

from benchdragon.plans.presets import REPORTERS, UNMEASURED, presets
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import built_in_names, read_text


def test_each_preset_is_the_built_in_plan_of_its_name() -> None:
    assert {one.name: one.plan.data() for one in presets()} == {
        name: read_plan(name).data() for name in built_in_names()
    }
    assert {one.name: one.title.zh for one in presets()} == {
        name: read_plan(name).title("zh") for name in built_in_names()
    }


@pytest.mark.parametrize("name", [name for name in REPORTERS if name not in UNMEASURED])
def test_a_villages_benches_are_as_long_as_its_file_derives_them(name: str) -> None:
    dragon = read_plan(name).dragon
    said = re.search(r"# derived: (\d+) m / (\d+) \+ 2 x ([0-9.]+) m", read_text(name))
    assert said is not None
    length, benches, inset = map(float, said.groups())
    assert (dragon.benches, dragon.front_inset, dragon.rear_inset) == (benches, inset, inset)
    assert dragon.body_length == dragon.tail_length == round(length / benches + 2.0 * inset, 2)


def test_what_was_reported_of_a_village_is_told_apart_from_what_is_derived_and_assumed() -> None:
    known = {one.name: {figure.key: figure.status for figure in one.figures} for one in presets()}
    keys = ("dragon.benches", "dragon.body_length", "dragon.width")
    told = {name: [figures[key] for key in keys] for name, figures in known.items()}
    assert told["xianju"] == ["reported", "derived", "assumed"]
    assert told["yongkang"] == ["reported", "reported", "assumed"]
    assert told["turn"] == ["reported"] * 3


def test_a_village_is_first_and_the_next_says_what_was_added_to_the_built_in_plan() -> None:
    village, first = presets()[:2]
    assert village.title.zh == "浦江"
    assert first.plan.sha256 == read_plan("spiral-in", ["disc.radius=4.5"]).sha256
    assert first.title.en == first.plan.title("en") == "Coiling in to the disc"
    assert "with a turning disc of 4.5 m added" in first.source.en
    assert "加了半径 4.5 m 的调头空间" in first.source.zh


def test_a_presets_chinese_title_is_chinese() -> None:
    assert [one.title.zh for one in presets() if re.search("[A-Za-z]", one.title.zh)] == []
