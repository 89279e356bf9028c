"""Lists of names as villages keep them."""

from pathlib import Path

import pytest

from benchdragon.errors import InputError
from benchdragon.i18n import use_language
from benchdragon.rosters.reading import Numbering, _at_two, _once, _Seat, read_roster
from benchdragon.rosters.roster import Person, Roster
from tests.counting import lines_run
from tests.rosters.lists import Cells, csv_bytes, ods_bytes, xlsx_bytes

TEN = Numbering(10, True, lambda bench: f"bench {bench}")
# The head has no number, and the tail none.
HEADED = Numbering(10, False, lambda bench: f"qiao {bench - 1}")

LIST: Cells = [
    ["石马村板凳龙名单", "", "", "", ""],
    ["", "", "", "", ""],
    ["桥 号", "姓名", "户主", "联系电话", "备注"],
    [1, "张三、李四", "张家", 13800000001, ""],
    ["第2桥", "王五 赵六", "王家", "138-0000-0002", "左手"],
    ["", "钱七", "", "", ""],
    ["三", "孙　八", "孙家", "", ""],
    ["４", "周九\n吴十", "周家", 13800000004.0, ""],
    ["5-6", "郑一、冯二、陈三、褚四", "郑家", "", "两桥"],
    [7, "卫五", "卫家", "", ""],
    [9, "蒋六/沈七", "蒋家", "", ""],
    ["龙尾", "韩八，杨九", "韩家", "", ""],
    ["合计", "17人", "", "", ""],
]


def read(tmp_path: Path, rows: Cells, numbering: Numbering = TEN) -> Roster:
    path = tmp_path / "list.csv"
    path.write_bytes(csv_bytes(rows))
    return read_roster(path, numbering)


def names(roster: Roster) -> dict[int, str]:
    return {n: " ".join(one.name for one in people) for n, people in roster.benches.items()}


def test_a_list_as_people_type_it(tmp_path: Path) -> None:
    roster = read(tmp_path, LIST)
    assert names(roster) == {
        1: "张三 李四", 2: "王五 赵六 钱七", 3: "孙八", 4: "周九 吴十", 5: "郑一 冯二", 6: "陈三 褚四",
        7: "卫五", 9: "蒋六 沈七", 10: "韩八 杨九",
    }  # fmt: skip
    assert roster.people(2)[0] == Person("王五", "王家", "138-0000-0002", "左手")
    assert roster.people(2)[2] == Person("钱七", "王家", "", "")
    assert roster.people(1)[1].phone == "13800000001"
    assert roster.people(8) == ()
    assert roster.notes == (
        "row 9: 郑一, 冯二, 陈三, 褚四 are dealt to bench 5, bench 6 in order",
        "bench 2 is in rows 5, 6: all of their people are taken for it",
        "row 13 was not read: taken for a sum: 合计 17人",
        "nobody is named for bench 8",
    )


def test_the_same_list_in_every_kind_of_file_is_the_same_roster(tmp_path: Path) -> None:
    files = {
        "a.xlsx": xlsx_bytes(LIST), "a.ods": ods_bytes(LIST), "a.csv": csv_bytes(LIST),
        "b.csv": csv_bytes(LIST, "utf-8"), "c.csv": csv_bytes(LIST, "gb18030", ";"),
        "d.txt": csv_bytes(LIST, "utf-16", "\t"), "e.tsv": csv_bytes(LIST, "gb18030", "\t"),
    }  # fmt: skip
    rosters = []
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
        rosters.append(read_roster(tmp_path / name, TEN))
    assert len(rosters[0].benches) == 9
    assert all(roster == rosters[0] for roster in rosters)
    phones = [[one.phone for people in r.benches.values() for one in people] for r in rosters]
    assert all(found == phones[0] for found in phones)


def test_a_village_that_does_not_count_its_head(tmp_path: Path) -> None:
    roster = read(
        tmp_path, [["节", "名字"], ["龙头", "甲一"], [1, "乙二"], ["8", "丙三"], [10, "丁四"]], HEADED
    )
    assert names(roster) == {1: "甲一", 2: "乙二", 9: "丙三"}
    assert "row 5: the dragon of 10 benches has no qiao 10: 丁四" in roster.notes


def test_what_is_odd_is_named_by_its_row(tmp_path: Path) -> None:
    roster = read(tmp_path, [
        ["序号", "桥号", "姓名", "年龄", "电话", "户名"],
        [1, 1, "张三", 30, "13800000001", ""],
        [2, 2, "张三、李四", 31, "", ""],
        [3, 2, "李四", 31, "13800000003", ""],
        [4, 130, "周九", 31, "13800000009", ""],
        [5, "甲", "吴十", 31, "13800000005", ""],
        [6, 8, "***", "", "", ""],
        [7, 9, "", "", "13900000000", ""],
        [8, "2026-03-05", "郑一", "", "", ""],
        [9, "3-4", "王家人", "", "1.38E+10", ""],
        ["合计", "", "", 12, "", ""],
        [10, "", "无桥", "", "", ""],
    ])  # fmt: skip
    assert names(roster) == {1: "张三", 2: "张三 李四", 3: "王家人", 4: "王家人"}
    assert roster.people(2)[1].phone == "13800000003"
    assert roster.notes == (
        "row 6 was not read: '甲' is no number of a bench: 5 甲 吴十 31",
        "row 7 was not read: *** is no name",
        "row 8 was not read: no name, only 7 9",
        "row 9 was not read: the spreadsheet made a day of the bench's number (2026-03-05): "
        "format the column as text",
        "row 10 was not read: the spreadsheet rounded a phone number: format the column as text",
        "row 12 was not read: no number of a bench: 10 无桥",
        "row 5: the dragon of 10 benches has no bench 130: 周九",
        "row 10: 王家人 stands at each of bench 3, bench 4",
        "李四 is named twice at bench 2: in rows 3 and 4",
        "张三 is named at bench 1, bench 2: in rows 2, 3",
        "columns that are not read: 序号, 年龄",
        "row 11 was not read: taken for a sum: 合计 12",
        "nobody is named for bench 5 to bench 10",
    )
    assert not any("138" in note or "139" in note for note in roster.notes)


def test_a_row_below_one_that_was_not_understood_is_nobodys_bench(tmp_path: Path) -> None:
    roster = read(tmp_path, [["桥", "姓名"], [1, "张三"], ["甲", "李四"], ["", "王五"]])
    assert names(roster) == {1: "张三"}
    assert "row 4 was not read: no number of a bench: 王五" in roster.notes


def test_people_of_one_name_in_two_houses_are_two(tmp_path: Path) -> None:
    roster = read(
        tmp_path, [["桥", "姓名", "户主"], [1, "王伟", "甲"], [2, "王伟", "乙"], [3, "王伟", "甲"]]
    )
    told = [note for note in roster.notes if "王伟" in note]
    assert told == ["王伟 is named at bench 1, bench 3: in rows 2, 4"]


def test_phones_among_names_remarks_and_households_are_never_shown(tmp_path: Path) -> None:
    roster = read(
        tmp_path,
        [
            ["桥", "姓名", "户主", "备注"],
            [1, "张三 13800000001", "张家(0579-1234567)", "找13900000002"],
        ],
    )
    (person,) = roster.people(1)
    assert (person.name, person.household, person.remarks) == ("张三", "张家", "找")
    assert (person.phone, person.home_phone) == ("13800000001 13900000002", "0579-1234567")
    assert "138" not in repr(roster)


def test_blocks_side_by_side_and_two_columns_of_names(tmp_path: Path) -> None:
    roster = read(tmp_path, [
        ["桥号", "姓名", "姓名", "电话", "桥号", "姓名", "姓名", "电话"],
        [1, "张三", "李四", "13800000001", 3, "王五", "赵六", ""],
        [2, "钱七", "", "", 4, "孙八", "", ""],
    ])  # fmt: skip
    assert names(roster) == {1: "张三 李四", 2: "钱七", 3: "王五 赵六", 4: "孙八"}


def test_each_column_of_names_has_its_column_of_phones(tmp_path: Path) -> None:
    roster = read(
        tmp_path,
        [["bench", "name", "phone", "name 2", "phone 2"], [1, "Ann Lee", "1234567", "Bo", "7654321"]],
    )
    assert [(one.name, one.phone) for one in roster.people(1)] == [
        ("Ann Lee", "1234567"),
        ("Bo", "7654321"),
    ]


def test_householders_are_the_bearers_where_no_others_are_named(tmp_path: Path) -> None:
    roster = read(tmp_path, [["节号", "户主", "电话"], [1, "张三", "13800000001"]])
    assert roster.people(1) == (Person("张三", "张三", "13800000001"),)
    assert roster.notes[0] == "there is no column of names: householders are read as those who carry"


def test_a_list_without_headings_is_guessed(tmp_path: Path) -> None:
    roster = read(
        tmp_path,
        [["1", "张三、李四", "13800000001", "好"], ["2", "王五", "", ""], ["", "赵六", "", ""]],
    )
    assert names(roster) == {1: "张三 李四", 2: "王五 赵六"}
    assert roster.people(1)[0].phone == "13800000001"
    assert roster.notes[:2] == (
        "there is no row of headings: column A is read as numbers, B as names",
        "columns that are not read: D",
    )


@pytest.mark.parametrize(
    "text", ["1 张三、李四\n2 王五\n", "第1桥：张三、李四\n第2桥：王五\n", "1　张三，李四\n2　王五"]
)
def test_lines_that_nothing_parts(tmp_path: Path, text: str) -> None:
    (tmp_path / "list.txt").write_text(text, "utf-8")
    assert names(read_roster(tmp_path / "list.txt", TEN)) == {1: "张三 李四", 2: "王五"}


def test_cells_that_are_merged_downwards_say_the_same_in_each_row(tmp_path: Path) -> None:
    rows: Cells = [["桥号", "姓名", "户名"], [1, "张三", "张家"], ["", "李四", ""], [2, "王五", ""]]
    (tmp_path / "a.xlsx").write_bytes(xlsx_bytes(rows, merged=["A2:A3", "C2:C4"]))
    roster = read_roster(tmp_path / "a.xlsx", TEN)
    assert names(roster) == {1: "张三 李四", 2: "王五"}
    assert [one.household for people in roster.benches.values() for one in people] == ["张家"] * 3


def test_notes_are_in_the_language_in_use(tmp_path: Path) -> None:
    use_language("zh")
    try:
        notes = read(
            tmp_path, [["桥", "姓名", "年龄"], [1, "张三", 3], [2, "张三", 4], ["甲", "李四", 5]]
        ).notes
    finally:
        use_language("en")
    assert len(notes) == 4
    assert not any(word in note for note in notes for word in ("row", "named", "read"))


def test_the_villages_example_is_whole() -> None:
    path = Path(__file__).parents[2] / "examples" / "12_village_names.csv"
    roster = read_roster(path, Numbering(120, True, str))
    assert roster.notes == ()
    assert sorted(roster.benches) == list(range(1, 121))
    assert sum(map(len, roster.benches.values())) == 241


def test_a_list_without_numbers_is_refused_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no column of bench numbers") as told:
        read(tmp_path, [["张三"], ["李四"]])
    assert "\n" not in str(told.value)


def test_a_bench_in_rows_that_are_apart_is_told_and_in_rows_one_after_the_other_is_not(
    tmp_path: Path,
) -> None:
    rows: Cells = [
        ["桥号", "姓名"], [1, "张三"], [1, "李四"], [2, "王五"], [3, "赵六"], [2, "钱七"], [4, "孙八"]
    ]  # fmt: skip
    notes = read(tmp_path, rows).notes
    assert "bench 2 is in rows 4, 6: all of their people are taken for it" in notes
    assert not any("bench 1 is in rows" in note for note in notes)


def test_a_number_that_stands_twice_where_hardly_any_does_may_be_a_slip(tmp_path: Path) -> None:
    rows: Cells = [["桥号", "姓名"], [1, "张三"], [2, "李四"], [2, "王五"], [4, "赵六"], [5, "孙八"]]
    notes = read(tmp_path, rows).notes
    assert "bench 2 is in rows 3, 4: all of their people are taken for it" in notes
    # So may a row without a number, which goes on about the bench above.
    without: Cells = [*rows[:3], ["", "王五"], *rows[4:]]
    assert (
        "bench 2 is in rows 3, 4: all of their people are taken for it" in read(tmp_path, without).notes
    )
    # In a list with a row for each of two bearers nothing is odd about it.
    pairs: Cells = [["桥号", "姓名"], *([n, f"张{n}{k}"] for n in (1, 2, 3) for k in "ab"), [4, "赵六"]]
    assert not any("in rows" in note for note in read(tmp_path, pairs).notes)


def test_a_householder_carries_where_a_row_names_nobody(tmp_path: Path) -> None:
    roster = read(tmp_path, [
        ["桥号", "姓名", "户主", "电话", "备注"],
        [1, "张三", "张家", "", ""], [2, "", "李四", "13800000002", "左手"],
        [3, "待定", "王五", "", ""], [4, "", "***", "", ""],
    ])  # fmt: skip
    assert roster.people(2) == (Person("李四", "李四", "13800000002", "左手"),)
    assert roster.people(3) == roster.people(4) == ()
    assert roster.notes[:3] == (
        "row 4 was not read: no name, only 3 待定 王五",
        "row 5 was not read: no name, only 4 ***",
        "row 3: no name: the householder, 李四, is read as who carries",
    )


def test_a_table_that_chinese_commas_part_is_one(tmp_path: Path) -> None:
    rows = ["桥号，姓名，户主，备注", "1，张三、李四，张家，左手", "2，王五，王家，"]
    for mark in "，；":
        path = tmp_path / "list.csv"
        path.write_text("\n".join(rows).replace("，", mark), "utf-8")
        roster = read_roster(path, Numbering(2, True, str))
        assert names(roster) == {1: "张三 李四", 2: "王五"}
        assert roster.people(1)[1] == Person("李四", "张家", "", "左手")
        assert roster.notes == ()


def test_a_bench_that_two_rows_name_by_other_words_is_told(tmp_path: Path) -> None:
    rows: Cells = [["桥号", "姓名"], [1, "张三"], [9, "李四"], ["龙尾", "王五"]]
    notes = read(tmp_path, rows, HEADED).notes
    assert "qiao 9 is in rows 3, 4: all of their people are taken for it" in notes


def test_one_name_in_many_households_is_work_in_proportion_to_them() -> None:
    def work(count: int) -> tuple[int, int]:
        people = [Person("张三", f"{n} 家", "") for n in range(count)]
        seats = [_Seat(1 + n % 10, person, n) for n, person in enumerate(people)]
        return lines_run(lambda: list(_at_two(seats, TEN))), lines_run(lambda: _once(other, TEN, ""))

    other = [_Seat(1, Person(f"张{n}", "", ""), n) for n in range(180)]
    (few, once), (many, _same) = work(100), work(400)
    assert many < 6 * few
    assert once < 60 * len(other)


def test_of_one_name_a_household_or_else_a_phone_tells_who_is_who() -> None:
    said: list[tuple[int, str, str, str]] = [
        (1, "A", "x", ""),
        (2, "A", "x", "5"),
        (3, "A", "y", "x"),
        (4, "A", "", "5"),
        (5, "B", "", ""),
    ]
    seats = [_Seat(bench, Person(name, home, phone), bench) for bench, name, home, phone in said]
    assert list(_at_two(seats, TEN)) == [
        "A is named at bench 2, bench 4: in rows 2, 4",
        "A is named at bench 1 to bench 3: in rows 1, 2, 3",
    ]
    blank = _Seat(6, Person("A", "", ""), 6)
    assert list(_at_two([*seats[:3], blank], TEN)) == [
        "A is named at bench 1 to bench 3, bench 6: in rows 1, 2, 3, 6"
    ]


def test_a_head_that_is_called_number_0_is_told(tmp_path: Path) -> None:
    roster = read(tmp_path, [["桥号", "姓名"], [0, "张三"], ["龙头", "李四"], [1, "王五"]], HEADED)
    assert names(roster)[1] == "张三 李四"
    assert [note for note in roster.notes if "taken for the head" in note] == [
        "row 2: bench 0 is taken for the head"
    ]
    counted = read(tmp_path, [["桥号", "姓名"], [0, "张三"], [1, "王五"]])
    assert not any("taken for the head" in note for note in counted.notes)


def test_failed_formulas_are_nobody_and_names_of_one_sign_are_told(tmp_path: Path) -> None:
    said = ["#N/A", "欧阳 锋", "张三+李四", "锋", "#REF!"]
    rows: Cells = [["桥号", "姓名"], *([bench, name] for bench, name in enumerate(said, 1))]
    roster = read(tmp_path, rows)
    assert names(roster) == {2: "欧阳锋", 3: "张三 李四", 4: "锋"}
    assert [note for note in roster.notes if "one sign" in note] == [
        "row 5: 锋 is a name of one sign: part names by 、 and not by spaces"
    ]


def test_two_names_that_nothing_parts_are_one_person_and_told(tmp_path: Path) -> None:
    said = ["陈国强李建华", "欧阳建国", "买买提·艾力江", "阿卜杜拉", "陈国强、李建华", "John Smithson"]
    rows: Cells = [["桥号", "姓名"], *([bench, name] for bench, name in enumerate(said, 1))]
    roster = read(tmp_path, rows)
    assert names(roster)[1] == "陈国强李建华"
    assert [note for note in roster.notes if "one person" in note] == [
        "row 2: 陈国强李建华 is taken for one person: if they are several, part their names by 、"
    ]


def test_a_chinese_comma_behind_a_number_is_told(tmp_path: Path) -> None:
    path = tmp_path / "list.csv"
    path.write_text("桥号,姓名\n1,张三\n3，王小3张大3\n甲，赵六\n4,李四\n", "utf-8")
    roster = read_roster(path, Numbering(4, True, str))
    assert [note for note in roster.notes if "not read" in note] == [
        "row 3 was not read: the comma behind 3 is a Chinese one (，): type an English one (,)",
        "row 4 was not read: '甲，赵六' is no number of a bench: 甲，赵六",
    ]


@pytest.mark.parametrize(
    ("text", "wanted", "unread"),
    [
        ("桥号，姓名\n1，张三，李四\n2，王五\n", {1: "张三 李四", 2: "王五"}, []),
        ("桥号，姓名，备注\n1，张三，左手\n2，李四，右手,慢\n", {1: "张三", 2: "李四"}, []),
        (
            "桥号，姓名，备注\n1，张三，左手，钱七\n2，王五，\n", {1: "张三", 2: "王五"},
            ["columns that are not read: D (row 2)"],
        ),
        ("桥号,姓名\n1,张三，李四\n2,王五\n", {1: "张三 李四", 2: "王五"}, []),
    ],
)  # fmt: skip
def test_chinese_commas_part_columns_or_names_and_nothing_is_lost_in_silence(
    tmp_path: Path, text: str, wanted: dict[int, str], unread: list[str]
) -> None:
    (tmp_path / "list.csv").write_text(text, "utf-8")
    roster = read_roster(tmp_path / "list.csv", Numbering(2, True, str))
    assert names(roster) == wanted
    assert [note for note in roster.notes if "not read" in note] == unread


def test_who_is_named_at_two_benches_is_one_person(tmp_path: Path) -> None:
    roster = read(
        tmp_path,
        [["桥号", "姓名", "户主"], [1, "张三、李四", "甲"], ["2-3", "张三", "甲"], [4, "张三", "乙"]],
    )
    assert sum(len(people) for people in roster.benches.values()) == 5
    assert roster.persons == 3


@pytest.mark.parametrize(
    ("people", "persons"),
    [
        ([("甲", ""), ("", "1")], 2),
        ([("甲", ""), ("", "1"), ("甲", "1")], 1),
        ([("甲", "1"), ("乙", "1"), ("乙", "2"), ("丙", "3")], 2),
        ([("甲", "1"), ("乙", "2"), ("", "")], 1),
        ([("", ""), ("", "")], 1),
    ],
)
def test_namesakes_are_others_only_by_another_household_and_phone(
    people: list[tuple[str, str]], persons: int
) -> None:
    benches: dict[int, tuple[Person, ...]] = {
        n: (Person("张三", *marks),) for n, marks in enumerate(people, start=1)
    }
    assert Roster(benches).persons == persons
    assert Roster({**benches, 99: (Person("李四"),)}).persons == persons + 1
