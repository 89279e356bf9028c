"""The list of names beside a plan."""

import json
from pathlib import Path

import pytest

from benchdragon.plans.roster import roster_of
from benchdragon.plans.schema import checked, read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.rosters.roster import Roster
from tests.rosters.lists import Cells, csv_bytes

PLAN = """schema = 1
[dragon]
benches = 4
[route]
kind = "spiral-in"
pitch = 1.0
[people]
roster = "names.csv"
unit = "qiao"
count_head = false
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    rows: Cells = [
        ["桥", "姓名", "电话"],
        ["龙头", "张三", "13800000001"],
        [1, "李四", ""],
        [7, "王五", ""],
    ]
    (tmp_path / "names.csv").write_bytes(csv_bytes(rows))
    (tmp_path / "a.dragon.toml").write_text(PLAN, "utf-8")
    return tmp_path / "a.dragon.toml"


def test_the_people_of_a_plan_by_what_its_village_calls_the_benches(plan: Path) -> None:
    roster = roster_of(read_plan(str(plan)))
    assert [roster.people(n)[0].name for n in (1, 2)] == ["张三", "李四"]
    assert roster.notes == (
        "row 4: the dragon of 4 benches has no qiao 7: 王五",
        "nobody is named for qiao 2, the tail",
    )


def test_a_plan_without_a_list_has_an_empty_roster(plan: Path) -> None:
    assert roster_of(read_plan("spiral-in")) == Roster()


def test_names_are_neither_in_the_plan_nor_in_its_hash(plan: Path) -> None:
    with_list = read_plan(str(plan))
    roster_of(with_list)
    said = json.dumps(with_list.data(), ensure_ascii=False) + with_list.toml() + repr(with_list)
    assert "张三" not in said
    assert "13800000001" not in said
    without = read_plan(str(plan), ["people.roster="])
    assert without.sha256 == with_list.sha256


@pytest.mark.parametrize(
    "name", ["../names.csv", "/etc/passwd", "a/b.csv", "..", "missing.csv", "a\\b.csv"]
)
def test_other_files_are_refused_with_the_line_of_the_key(plan: Path, name: str) -> None:
    plan.write_text(PLAN.replace('"names.csv"', f"'{name}'"), "utf-8")
    with pytest.raises(PlanError, match=r"a\.dragon\.toml:8: people\.roster") as told:
        roster_of(read_plan(str(plan)))
    assert "\n" not in str(told.value)


def test_nothing_lies_beside_a_plan_that_was_not_read_from_a_file(plan: Path) -> None:
    data = read_plan(str(plan)).data()
    with pytest.raises(PlanError, match="nothing lies beside it"):
        roster_of(checked(data, "plan"))


# What is no web address and no relative file, whatever a phone may make of it.
NO_ADDRESSES = (
    "javascript:alert(1)", "JavaScript:alert(1)", " javascript:alert(1)", "java\tscript:alert(1)",
    "java\nscript:x", "\u0001javascript:x", "javascript\u200b:x", "data:text/html,x", "file:///etc/x",
    "vbscript:x", "tel:110", "sms:+861380000", "mailto:a@b", "intent://x#Intent;end", "blob:https://a/b",
    "WIFI:T:WPA;S:x;;", "C:\\x.html", "//evil.example/x", "/\\evil.example", "\\\\evil\\x", "/x.html",
    "http:/a", "https:a.html", "https://", "https:///x", "https:\\\\a", "http://?x", "http://:80/x",
    "http\u017f://a", "https://good.example@evil.example/", "https://a b/", "https://a.example/ x",
    "ftp://a/x", "a b.html", "#bench=1", "?x", "x:y/z", "./a:b", "view-source:https://a",
    "feed:https://a", "http://good.example\\@evil.example",
)  # fmt: skip
ADDRESSES = (
    "", "https://example.org/dance.html", "HTTPS://example.org", "http://localhost:8080/a?b=c:d#e",
    "https://[2001:db8::1]/x.html", "https://板凳龙.中国/夜.html", "dance.html", "夜/dance.html#t=2",
    "../dance.html?x=https://a/b", "./dance.html", "a@b.html",
)  # fmt: skip


def addressed(address: str) -> dict[str, object]:
    """A plan whose players are at an address."""
    return {"schema": 1, "route": {"kind": "spiral-in"}, "people": {"address": address}}


@pytest.mark.parametrize("address", NO_ADDRESSES)
def test_what_papers_would_have_a_phone_open_is_a_web_address_or_a_relative_file(address: str) -> None:
    with pytest.raises(PlanError, match=r"people\.address: expected ") as told:
        checked(addressed(address), "plan")
    assert repr(address)[:80] in str(told.value)
    assert "\n" not in str(told.value)


def test_addresses_of_the_web_and_relative_files_are_taken_as_they_are() -> None:
    for address in ADDRESSES:
        assert checked(addressed(address), "plan").people.address == address
