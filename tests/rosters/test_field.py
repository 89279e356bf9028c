"""Lists as villages send them: their own words for bearers, for benches and for nobody."""

from pathlib import Path

import pytest

from benchdragon.errors import InputError
from benchdragon.rosters.reading import Numbering, read_roster
from benchdragon.rosters.roster import Person, Roster, phones_of
from tests.rosters.lists import Cells, csv_bytes, xlsx_bytes
from tests.rosters.test_reading import names

CASES = Path(__file__).parents[1] / "cases" / "field"
EIGHT = "张三 李四 王五 赵六 钱七 孙八 周九 吴十"
TEN = Numbering(10, True, lambda bench: f"bench {bench}")
WORDS = """
    抬灯人 迎灯人 扛灯人 掌灯 掌灯人 灯手 抬桥人 扛桥人 换班人 换班 替换人员 抬灯人员 抬桥者 灯夫
    抬灯人姓名 抬灯人、换班人 抬桥的人
    后备人员 抬灯人1 抬灯人（左） 抬灯人甲 抬燈人 換班人 抬橋人 Bearers relief
"""
BEARERS = WORDS.split()


def read(folder: Path, rows: Cells, name: str = "list.csv") -> Roster:
    (folder / name).write_bytes(csv_bytes(rows))
    return read_roster(folder / name, TEN)


def refused(folder: Path, data: bytes) -> str:
    """Why a list is refused, in one sentence."""
    (folder / "list.csv").write_bytes(data)
    with pytest.raises(InputError) as told:
        read_roster(folder / "list.csv", TEN)
    assert "\n" not in str(told.value)
    return str(told.value)


def not_read(roster: Roster) -> list[str]:
    return [note for note in roster.notes if "was not read" in note]


def test_the_lists_of_the_field(tmp_path: Path) -> None:
    assert tmp_path
    found = {path.stem: read_roster(path, TEN) for path in sorted(CASES.glob("L*.csv"))}
    assert {name: names(roster) for name, roster in found.items()} == {
        "L02": dict(
            enumerate(["张三", "李四", "王五", "赵六", "钱七", "孙八", "周九", "吴十"], start=1)
        ),
        "L03": {1: "张三 李四", 2: "王五 赵六"},
        "L04": {1: "张三", 2: "李四", 4: "赵六 钱七", 5: "孙八 周九", 6: "吴十"},
        "L06": {1: "张三 李四"},
        "L07": {1: "张三", 2: "李四", 3: "王五"},
    }
    assert [not_read(found[name]) for name in ("L02", "L03", "L06", "L07")] == [[], [], [], []]
    assert not_read(found["L04"]) == ["row 4 was not read: 'A3' is no number of a bench: A3 王五"]
    phones = [one.phone for people in found["L07"].benches.values() for one in people]
    assert phones == ["13800000001", "13800000002", ""]


@pytest.mark.parametrize("heading", BEARERS)
def test_who_carries_is_known_by_each_villages_word_and_no_householder_is(
    tmp_path: Path, heading: str
) -> None:
    roster = read(
        tmp_path, [["桥号", "户主", heading, "电话"], [1, "张三", "李四", ""], [2, "赵六", "", ""]]
    )
    assert roster.people(1) == (Person("李四", "张三"),)
    assert roster.notes[0] == "row 3: no name: the householder, 赵六, is read as who carries"


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ([["桥号", "户主", "领队"], [1, "张三", "李四"]], "C, whose heading, 领队, is not known"),
        ([["桥号", "户主", "伙计"], [1, "张三", "阿福"]], "C, whose heading, 伙计, is not known"),
        ([["桥号", "姓名", "领头的"], [1, "张三", "李四"], [2, "王五", ""]], "heading, 领头的, is not"),
        ([["桥号", "姓名", ""], [1, "张三", "李四"], [2, "王五", "赵六"]], "C, which has no heading"),
        ([[1, "张三", "李四"], [2, "王五", "赵六"]], "C, which has no heading"),
        ([["桥号", "负责"], [1, "张三"]], "none that is known for those who carry (桥号, 负责)"),
        ([["次", "户主", "姓名"], [1, "张三", "李四"]], "none that is known for the numbers of"),
        ([["桥号", "户主", "Helper"], [1, "张三", "Bo Li"]], "C, whose heading, Helper, is not known"),
        ([["桥号", "姓名", "Helper"], [1, "张三", "Bo Li"]], "C, whose heading, Helper, is not known"),
        ([["", "户主", "姓名"], [1, "张三", "李四"]], "none that is known for the numbers of"),
    ],
)  # fmt: skip
def test_what_decides_who_carries_is_asked_for(tmp_path: Path, rows: Cells, said: str) -> None:
    why = refused(tmp_path, csv_bytes(rows))
    assert said in why
    assert "姓名 (name)" in why or "桥号 (bench)" in why


def test_columns_of_other_things_are_no_reason_to_ask(tmp_path: Path) -> None:
    head = ["桥号", "姓名", "性别", "村", "灯笼颜色", "联系人", "组别"]
    rows: Cells = [
        head,
        [1, "李四", "男", "石马", "红", "张三", "一组"],
        [2, "王五", "女", "石马", "黄", "张三", ""],
    ]
    roster = read(tmp_path, rows)
    assert names(roster) == {1: "李四", 2: "王五"}
    assert roster.notes[-2] == "columns that are not read: 性别, 村, 灯笼颜色, 联系人, 组别"


def test_the_same_as_above(tmp_path: Path) -> None:
    rows: Cells = [
        ["桥号", "姓名", "户主", "电话", "备注"],
        [1, "张三", "张家", "13800000001", "左手"],
        [2, "同上", "", "", ""],
        [3, "〃", "李家", "", "同上"],
        ["同上", "李四", "同上", "", ""],
        [5, "同左", "", "", ""],
        [6, "王五", "", "", ""],
        [7, "", "", "", ""],
        [8, "同上", "", "", ""],
    ]
    roster = read(tmp_path, rows)
    assert names(roster) == {1: "张三", 2: "张三", 3: "张三 李四", 6: "王五"}
    assert roster.people(2) == (Person("张三", "张家", "13800000001"),)
    assert roster.people(3) == (
        Person("张三", "李家", "13800000001"), Person("李四", "李家"),
    )  # fmt: skip
    assert not_read(roster) == [
        "row 6 was not read: 5 is no name",
        "row 9 was not read: 同上 is no name",
    ]
    other = read(tmp_path, [["桥号", "户主", "抬灯人"], [1, "张三", "同左"], [2, "同上", "李四"]])
    assert other.benches == {1: (Person("张三", "张三"),), 2: (Person("李四", "张三"),)}


def test_a_quotation_mark_alone_is_what_stands_above_and_swallows_no_row(tmp_path: Path) -> None:
    text = '桥号,姓名,备注\n1,张三,x\n2,",\n3," ,"\n4,"王五\n赵六","a ""b"", c"\n5,"",""\n6,李四,"\n'
    (tmp_path / "list.csv").write_text(text, "utf-8")
    roster = read_roster(tmp_path / "list.csv", TEN)
    assert names(roster) == {1: "张三", 2: "张三", 3: "张三", 4: "王五 赵六", 6: "李四"}
    assert roster.people(3)[0].remarks == ""
    assert roster.people(4)[0].remarks == 'a "b", c'
    why = refused(tmp_path, '桥号,姓名\n1,张三\n2,"李四\n3,王五\n'.encode())
    assert "the quotation mark in line 3 is never closed" in why


NOBODYS = """
    本人 XXX xx ××× 张×× 某某 张某 王某某 初一 十五 廿三 替补 候补 正月十五 3月5日 十月初三晚上 元宵
    星期六 二十 同上 户主 自己 外请 戶主 2人 缺三人 大年初一 元宵晚上 正月半 人员待定 亲戚 待落实
"""


def test_what_stands_in_for_a_name_is_nobody_and_told_first(tmp_path: Path) -> None:
    for word in NOBODYS.split():
        rows: Cells = [
            ["桥号", "姓名", "户主", "年龄"],
            [1, word, "张三", 3],
            [2, f"{word}、李四", "", 4],
        ]
        roster = read(tmp_path, rows)
        assert names(roster) == {2: "李四"}, word
        assert roster.notes[:2] == tuple(f"row {row} was not read: {word} is no name" for row in (2, 3))


@pytest.mark.parametrize(
    "name", ["张初一", "万一", "周一", "陆十", "Max", "Alex", "李元宵", "王十五", "和平"]
)
def test_names_that_only_look_like_days_are_names(tmp_path: Path, name: str) -> None:
    assert names(read(tmp_path, [["桥号", "姓名"], [1, name]])) == {1: name}


@pytest.mark.parametrize(
    ("said", "wanted"),
    [
        ("张三和李四", "张三 李四"), ("张三、李四和王五", "张三 李四 王五"),
        ("张三 和 李四", "张三 李四"),
        ("张和平与李和", "张和平 李和"), ("张三跟李四及王五", "张三 李四 王五"),
        ("欧阳锋和诸葛亮", "欧阳锋 诸葛亮"),
        ("张三-李四", "张三 李四"), ("张三。李四", "张三 李四"), ("張三與李四", "張三 李四"),
        ("张和平", "张和平"), ("和珅", "和珅"), ("张和", "张和"),
        ("Ann Lee and Bo Li", "Ann Lee Bo Li"),
        ("阿依古丽·买买提", "阿依古丽·买买提"), ("Smith-Jones", "Smith-Jones"),
    ],
)  # fmt: skip
def test_two_people_that_a_word_joins(tmp_path: Path, said: str, wanted: str) -> None:
    assert names(read(tmp_path, [["桥号", "姓名"], [1, said]])) == {1: wanted}


def test_two_names_of_two_signs_with_nothing_between_are_told(tmp_path: Path) -> None:
    roster = read(tmp_path, [["桥号", "姓名"], [1, "张三李四"], [2, "欧阳建国"], [3, "张杨建国"]])
    assert [note for note in roster.notes if "one person" in note] == [
        "row 2: 张三李四 is taken for one person: if they are several, part their names by 、"
    ]


def test_places_at_a_bench(tmp_path: Path) -> None:
    said = [
        "1-1",
        "1-2",
        "2—1",
        "2-2",
        "3",
        "5左",
        "5右",
        "6(左)",
        "6（前）",
        "7-左",
        "８号",
        "桥9",
        "第10橋",
    ]
    rows: Cells = [
        ["桥号", "姓名"],
        *([one, f"张{sign}"] for one, sign in zip(said, "甲乙丙丁戊己庚辛壬癸子丑寅", strict=True)),
    ]
    assert names(read(tmp_path, rows)) == {
        1: "张甲 张乙", 2: "张丙 张丁", 3: "张戊", 5: "张己 张庚", 6: "张辛 张壬", 7: "张癸",
        8: "张子", 9: "张丑", 10: "张寅",
    }  # fmt: skip
    others = ["第4桥第1位", "4桥2号位", "第五桥第一人", "左6", "７＃"]
    rows = [
        ["桥号", "姓名"],
        *([one, f"张{sign}"] for one, sign in zip(others, "甲乙丙丁戊", strict=True)),
    ]
    assert names(read(tmp_path, rows)) == {4: "张甲 张乙", 5: "张丙", 6: "张丁", 7: "张戊"}
    # Without a bench whose first place is named a dash is from one bench to another.
    assert names(read(tmp_path, [["桥号", "姓名"], ["1-2", "张三、李四"], ["3-5", "王五"]])) == {
        1: "张三", 2: "李四", 3: "王五", 4: "王五", 5: "王五",
    }  # fmt: skip
    strokes = [["桥号", "姓名"], ["1/1", "张三"], ["1/2", "李四"], ["4/1", "王五"], ["7/8", "赵六"]]
    assert names(read(tmp_path, strokes)) == {1: "张三 李四", 4: "王五", 7: "赵六", 8: "赵六"}
    # Nobody counts benches backwards to so small a number as that of a place.
    assert names(read(tmp_path, [["桥号", "姓名"], ["4-2", "张三"], ["9-7", "李四"]])) == {
        4: "张三", 7: "李四", 8: "李四", 9: "李四",
    }  # fmt: skip
    mixed = read(
        tmp_path,
        [["桥号", "姓名"], ["1-2", "张三"], ["4-1", "李四"], ["4-2", "王五"], ["5～6", "赵六"]],
    )
    assert names(mixed) == {4: "李四 王五", 5: "赵六", 6: "赵六"}
    assert mixed.notes[0] == (
        "row 2 was not read: 1-2 may be several benches, or a place at one: write 1至2, "
        "or the bench alone"
    )


def test_the_phone_of_a_household_is_not_its_second_names(tmp_path: Path) -> None:
    head = ["桥号", "户主", "电话", "抬灯人1", "抬灯人2"]
    roster = read(
        tmp_path, [head, [1, "张三", "13800000001", "李四", "王五"], [2, "赵六", "13800000002", "钱七"]]
    )
    assert phones_of(roster.people(1)) == (["", ""], ["13800000001"])
    assert phones_of(roster.people(2)) == ([""], ["13800000002"])
    said = read(
        tmp_path,
        [
            ["桥号", "户主", "户主电话", "抬灯人", "抬灯人电话"],
            [1, "张三", "1380000001", "李四", "1380000002"],
        ],
    )
    assert phones_of(said.people(1)) == (["1380000002"], ["1380000001"])
    self = read(
        tmp_path,
        [
            ["桥号", "户主", "电话", "抬灯人"],
            [1, "张三", "13800000001", "同左"],
            [2, "李四", "13800000002", "李四"],
        ],
    )
    assert phones_of(self.people(2)) == (["13800000002"], [])
    two = read(
        tmp_path,
        [
            ["桥号", "姓名", "户主", "电话"],
            [1, "李四、王五", "张家", "13800000001"],
            [2, "赵六", "赵家", "13800000002"],
        ],
    )
    assert phones_of(two.people(1)) == (["", ""], ["13800000001"])
    assert phones_of(two.people(2)) == (["13800000002"], [])
    each = read(tmp_path, [["桥号", "姓名", "电话"], [1, "李四、王五", "13800000001 13800000002"]])
    assert phones_of(each.people(1)) == (["13800000001", "13800000002"], [])


BIG5: Cells = [
    ["橋號", "戶主", "抬燈人", "備註"], [1, "張三", "陳國強、李建華", "左手"], ["龍尾", "趙六", "", ""]
]  # fmt: skip


def test_lists_in_every_encoding_in_use_say_the_same(tmp_path: Path) -> None:
    found = []
    for n, encoding in enumerate(("big5", "cp950", "gb18030", "gbk", "utf-16", "utf-8", "utf-8-sig")):
        (tmp_path / f"{n}.csv").write_bytes(csv_bytes(BIG5, encoding))
        found.append(read_roster(tmp_path / f"{n}.csv", TEN))
    assert names(found[0]) == {1: "陳國強 李建華", 10: "趙六"}
    assert all(roster == found[0] for roster in found)
    # A single short row in simplified signs, one of them rare, is never taken for Big5.
    for name in ("王喆", "张三", "李赟"):
        (tmp_path / "list.csv").write_bytes(csv_bytes([["桥号", "姓名"], [1, name]], "gb18030"))
        assert names(read_roster(tmp_path / "list.csv", TEN)) == {1: name}


def test_utf_8_with_a_torn_sign_is_refused_and_not_read_as_another_encoding(tmp_path: Path) -> None:
    data = csv_bytes([["桥号", "姓名"], [1, "张三"], [2, "李四王五"]], "utf-8")
    assert "line 3 is torn" in refused(tmp_path, data[:-3] + b"\r\n")


def test_a_workbook_is_asked_in_the_same_way(tmp_path: Path) -> None:
    rows: Cells = [["桥号", "户主", "管事的"], [1, "张三", "李四"]]
    (tmp_path / "list.xlsx").write_bytes(xlsx_bytes(rows))
    with pytest.raises(InputError, match="管事的"):
        read_roster(tmp_path / "list.xlsx", TEN)
