"""`benchdragon formations`: what plans can name."""

import json

import pytest

from benchdragon.cli.main import run
from benchdragon.model.formations import FORMATIONS, formation


def test_the_table_names_every_formation_with_its_sizes_and_source(
    spoken: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["formations"]) == 0
    shown = capsys.readouterr().out
    for kind in FORMATIONS.values():
        assert kind.name in shown
        assert kind.chinese in shown
        assert kind.pinyin in shown
        assert (kind.english in shown) == (spoken == "en")
    assert "inner_radius 2.5 m" in shown
    assert "rounds 1" in shown
    assert {"en": "CUMCM", "zh": "本项目自定"}[spoken] in shown


def test_the_json_says_what_each_size_means_and_may_be(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["formations", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert [one["name"] for one in said["formations"]] == list(FORMATIONS)
    for one in said["formations"]:
        sizes = {size["name"]: size["default"] for size in one["sizes"]}
        assert formation(one["name"], **sizes) == formation(one["name"])
        assert all(size["least"] <= size["default"] <= size["most"] for size in one["sizes"])
        assert all(size["text"] and size["unit"] in ("m", "") for size in one["sizes"])
        assert "" not in (one["source"], one["shape"], one["pinyin"])
    assert said["formations"][0]["clockwise"] is True
    assert {one["name"]: one["clockwise"] for one in said["formations"]}["straight-dragon"] is None
