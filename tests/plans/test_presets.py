"""Presets: the same name means the same plan everywhere."""

import re

from benchdragon.plans.presets import presets
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import built_in_names


def test_a_preset_called_like_a_built_in_plan_is_that_plan() -> None:
    built_in = {name: read_plan(name) for name in built_in_names()}
    titles = {plan.title(language): plan for plan in built_in.values() for language in ("en", "zh")}
    named = 0
    for preset in presets():
        alike = [
            built_in.get(preset.name), titles.get(preset.title.en), titles.get(preset.title.zh),
            titles.get(preset.plan.title("en")), titles.get(preset.plan.title("zh")),
        ]  # fmt: skip
        for plan in filter(None, alike):
            named += 1
            assert plan == preset.plan
    assert named == 5 * len(built_in)


def test_the_first_preset_says_what_was_added_to_the_built_in_plan() -> None:
    first = presets()[0]
    assert first.plan.sha256 == read_plan("spiral-in", ["disc.radius=4.5"]).sha256
    assert first.title.en == first.plan.title("en") == "Coiling in to the disc"
    assert "with a turning disc of 4.5 m added" in first.source.en
    assert "加了半径 4.5 m 的调头空间" in first.source.zh


def test_a_presets_chinese_title_is_chinese() -> None:
    assert [one.title.zh for one in presets() if re.search("[A-Za-z]", one.title.zh)] == []
