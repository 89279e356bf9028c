"""What people write into the cells of a list."""

import pytest

from benchdragon.rosters.words import heading, is_sum, names_of, places, without_phones

NUMBERS = {
    "37": "37", "第37桥": "37", "37桥": "37", "三十七": "37", "37.0": "37", "３７": "37",
    "第 37 节": "37", "37号板凳": "37", "第三十七桥": "37", "bench 37": "37", "No. 37": "37",
    "#37": "37", "一二〇": "120", "一百零五": "105", "一百二十": "120", "廿一": "21", "十": "10",
    "①": "1", "两": "2",
    "3-5": "3-5", "3 – 5": "3-5", "第3至5桥": "3-5", "第三桥到第五桥": "3-5", "3～5": "3-5",
    "3、4、9": "3 4 9", "3,5-7": "3 5-7", "龙头": "head", "Head": "head", "龙尾": "tail",
    "head-3": "head-3",
    "": None, "甲": None, "37.5": None, "-5": None, "1-2-3": None, "2026-03-05": None, "一百二": None,
    "1234567890": None, "第桥": None, "12人": None,
    "桥5": "5", "5#": "5", "第8橋": "8", "5左": "5", "A3": None, "9-7": "9-7",
}  # fmt: skip


@pytest.mark.parametrize("text", NUMBERS)
def test_numbers_of_benches_as_people_write_them(text: str) -> None:
    found = places(text)
    if found is not None:
        ends = [[str(place.number or place.end) for place in both] for both in found]
        shown = " ".join(first if first == last else f"{first}-{last}" for first, last in ends)
    assert (None if found is None else shown) == NUMBERS[text]


NAMES = {
    "张三、李四": "张三|李四", "张三，李四；王五": "张三|李四|王五", "张三 李四": "张三|李四",
    "张三\n李四": "张三|李四", "张三/李四": "张三|李四", "张　三": "张三", "张 三 李 四": "张三|李四",
    "John Smith / Ann Lee": "John Smith|Ann Lee", "1.张三 2.李四": "张三|李四",
    "张三（锣）": "张三（锣）", "无": "", "待定": "", "—": "", "n/a": "", "张\u200b三": "张三",
    "王喆 李娜": "王喆|李娜", "阿依古丽·买买提": "阿依古丽·买买提", "": "",
}  # fmt: skip


@pytest.mark.parametrize("text", NAMES)
def test_names_of_a_cell(text: str) -> None:
    assert "|".join(names_of(text)) == NAMES[text]


@pytest.mark.parametrize(
    ("text", "rest", "phones"),
    [
        ("张三13800000001", "张三", ("13800000001",)),
        ("张三（138-0000-0001）", "张三", ("138-0000-0001",)),
        ("13800000001 13900000002", "", ("13800000001", "13900000002")),
        ("0579-12345678", "", ("0579-12345678",)),
        ("+44 20 7946 0000", "", ("+44 20 7946 0000",)),
        ("３号灯笼", "３号灯笼", ()),
    ],
)
def test_phones_are_told_apart_from_words(text: str, rest: str, phones: tuple[str, ...]) -> None:
    assert without_phones(text) == (rest, phones)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("桥号", "number"), ("桥 号", "number"), ("序号", "number"), ("Bench No.", "number"),
        ("#", "number"), ("姓名", "name"), ("姓名2", "name"), ("姓名（两人）", "name"),
        ("NAME", "name"), ("户主", "household"), ("联系电话：", "phone"), ("手机号", "phone"),
        ("备 注", "remarks"),
        ("Remarks", "remarks"), ("年龄", None), ("张三", None), ("37", None),
    ],
)  # fmt: skip
def test_headings(text: str, kind: str | None) -> None:
    found = heading(text)
    assert (found and found[0]) == kind


def test_sums() -> None:
    assert all(map(is_sum, ["合计", "总计：240人", "Total", "total: 5", "共 240 人"]))
    assert not any(map(is_sum, ["Summer", "张三", "37", "共同"]))
