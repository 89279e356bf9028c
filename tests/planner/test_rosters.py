"""compute/roster.js: a list of names says the same in the page as in Python, and of the same is odd."""

import inspect
import json
import random
from base64 import b64encode
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from benchdragon.errors import InputError
from benchdragon.i18n import LANGUAGES, spoken_in
from benchdragon.plans.people import PeopleTable, called
from benchdragon.rosters import names as roster_names
from benchdragon.rosters import words as roster_words
from benchdragon.rosters.names import like_two
from benchdragon.rosters.reading import Numbering, read_roster
from benchdragon.rosters.roster import Roster
from benchdragon.rosters.words import (
    doubtful,
    heading,
    is_name,
    is_other,
    is_sum,
    names_of,
    places,
    with_places,
    without_phones,
)
from tests.engine.recording import node
from tests.planner.twins import asked
from tests.planner.verdicts import words
from tests.rosters import test_field, test_reading, test_words
from tests.rosters.lists import csv_bytes
from tests.rosters.test_field import BEARERS

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

VILLAGE = Path(__file__).parents[2] / "examples" / "12_village_names.csv"
WORKBOOK = b"PK\x03\x04"
# Random lists, and what their cells are put together from.
SEEDS = 60
NUMBERS = (
    "1", "2", "第3桥", "四", "5-6", "7、8", "９", "10.0", "龙头", "龙尾", "12", "", "", "合计", "总计",
    "甲", "2026-03-05", "一百二", "0", "bench 4", "head-2", "3月5日", "1#", "桥5", "4-1", "4-2", "5左",
    "同上", "1-2", "6（右）", "#7", "第8橋", "1/2", "4/1", "4/2", "第4桥第1位",
)  # fmt: skip
NAMES = (
    "张三", "李四、王五", "王 五 赵六", "欧阳 修", "John Smith", "无", "", "#REF!", "钱七13800000001",
    "孙", "1.周一 2.吴二", "郑，冯；陈", "王喆\n李娜", 'a"b', "张三（锣）", "—", "陈国强李建华",
    ": 赵一 : 13700000009 :", "x" * 70, "37", "张\u200b三", "同上", "〃", '"', "本人", "初一", "XXX",
    "张三和李四", "张和平 与 王五", "张三李四", "同左", "某某", "3月5日", "龍王五",
)  # fmt: skip
HOUSES = ("张家", "李家", "", "", "王家 13900000002")
PHONES = ("13800000001", "138-0000-0002", "1.38E+10", "", "", "0579-12345678", "13800000003.0", "没有")
REMARKS = ("左手", "", "", "灯笼13700000009", "head", "＝1+1")


class Asked(NamedTuple):
    """A list as a file, and how the village numbers its benches."""

    data: bytes
    name: str
    benches: int
    count_head: bool


@pytest.fixture(scope="module")
def harvest(tmp_path_factory: pytest.TempPathFactory) -> list[Asked]:
    """The lists of the tests of rosters, but for workbooks, which the page does not read."""
    found: list[Asked] = []

    def kept(path: Path, numbering: Numbering, sheet: str = "") -> Roster:
        data = path.read_bytes()
        if not data.startswith(WORKBOOK):
            found.append(Asked(data, path.name, numbering.count, numbering.count_head))
        return read_roster(path, numbering, sheet)

    with pytest.MonkeyPatch.context() as patch:
        for module in (test_reading, test_field):
            patch.setattr(module, "read_roster", kept)
            for name, test in inspect.getmembers(module, inspect.isfunction):
                wanted: list[str] = list(inspect.signature(test).parameters)
                if name.startswith("test_") and wanted == ["tmp_path"]:
                    call: Callable[..., None] = test
                    call(tmp_path_factory.mktemp("list"))
    found.append(Asked(VILLAGE.read_bytes(), VILLAGE.name, 120, True))
    return found


def random_list(seed: int) -> Asked:
    """A list with all that people may write, in one of the encodings in use."""
    dice = random.Random(seed)
    heads = [("桥号", "姓名", "户主", "电话", "备注"), ("bench", "name", "name 2", "phone"), ()]
    head = dice.choice(heads)
    kinds = {"姓名": NAMES, "name": NAMES, "name 2": NAMES, "户主": HOUSES, "电话": PHONES,
             "phone": PHONES, "备注": REMARKS}  # fmt: skip
    columns = head or ("桥号", "姓名", "电话")
    rows = [list(head)] if head else []
    rows += [
        [dice.choice(kinds.get(one, NUMBERS)) for one in columns]
        for _row in range(dice.randrange(3, 25))
    ]
    if dice.random() < 0.3:
        rows.insert(0, ["石马村板凳龙"])
    encoding, mark = dice.choice(
        [("utf-8-sig", ","), ("gb18030", ";"), ("utf-16", "\t"), ("utf-8", "\t")]
    )
    data = csv_bytes(rows, encoding, mark)
    return Asked(data, f"{seed}.csv", dice.choice([5, 10, 120]), dice.random() < 0.5)


def here(asked_list: Asked, language: str, folder: Path) -> dict[str, Any]:
    """What Python says of a list."""
    path = folder / asked_list.name
    path.write_bytes(asked_list.data)
    people = PeopleTable(count_head=asked_list.count_head)
    name = partial(called, people, count=asked_list.benches)
    with spoken_in(language):
        try:
            found = read_roster(path, Numbering(asked_list.benches, asked_list.count_head, name))
        except InputError as error:
            return {"error": str(error), "kind": "InputError"}
    benches = {str(n): [asdict(one) for one in there] for n, there in found.benches.items()}
    return {"benches": benches, "notes": list(found.notes)}


def meant(text: str) -> list[Any]:
    """What a cell means in all ways in which Python may read it."""
    found = places(text)
    ranges = None if found is None else [[(one.number, one.end) for one in ends] for ends in found]
    halved = with_places("4-1、6-1")
    again = places(text, halved)
    return [
        heading(text), ranges, names_of(text), without_phones(text), is_sum(text), is_name(text),
        is_other(text), sorted(with_places(text)), doubtful(text, halved),
        again and [[one.number for one in ends] for ends in again], like_two(text),
    ]  # fmt: skip


def cells() -> list[str]:
    """Words of all kinds: those of the tests, and all that the module itself knows."""
    spelled = [word for line in roster_words.SPELLINGS.values() for word in line.split()]
    known = [*roster_words.OTHERS, *roster_names.STANDING_IN, *roster_names.ABOVE, *BEARERS]
    known += [*roster_words.NOBODY, *roster_words.HEADS, *roster_words.TAILS, *roster_names.TWO_SIGNS]
    family = [f"{two} 修" for two in roster_names.TWO_SIGNS]
    family += [f"{one}建国和{one}三" for one in sorted(roster_names.ONE_SIGN)]
    digits = [f"第{sign}桥" for sign in roster_words.NUMERALS]
    digits += [f"正月{sign}" for sign in roster_words.NUMERALS]
    digits += [chr(old) for old in roster_words.SIMPLE]
    random_ones = [*NUMBERS, *NAMES, *HOUSES, *PHONES, *REMARKS]
    sums = ["合计", "总计：240人", "Total", "共 240 人", "Summer", "共同"]
    phones = [mark for test in (test_words.test_phones_are_told_apart_from_words,)
              for mark in (one[0] for one in vars(test)["pytestmark"][0].args[1])]  # fmt: skip
    return [
        *test_words.NUMBERS,
        *test_words.NAMES,
        *spelled,
        *known,
        *family,
        *digits,
        *random_ones,
        *sums,
        *phones,
    ]


def test_lists_say_the_same_and_the_same_is_odd(harvest: list[Asked], tmp_path: Path) -> None:
    lists = [*harvest, *(random_list(seed) for seed in range(SEEDS))]
    assert len(harvest) > 20
    every = [(one, language) for one in lists for language in LANGUAGES]
    questions = [
        {
            "data": b64encode(one.data).decode(), "name": one.name, "count": one.benches,
            "people": {"count_head": one.count_head, "unit": "bench"}, "language": language,
        }
        for one, language in every
    ]  # fmt: skip
    twins = asked("rosters.mjs", {"lists": questions, "cells": cells(), "words": words()})
    for (one, language), twin in zip(every, twins["lists"], strict=True):
        assert twin == here(one, language, tmp_path), one.data.decode(errors="replace")
    for text, twin in zip(cells(), twins["cells"], strict=True):
        assert twin == json.loads(json.dumps(meant(text))), text
