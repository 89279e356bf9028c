"""What strangers put in plan files, opened in the page: refused in Python's words, nothing stays."""

import pytest

from benchdragon.plans.schema import checked
from benchdragon.plans.toml import MOST_ENTRIES, MOST_KEYS, PlanError, parsed
from tests.hostile.test_doors import BASE, WRONG
from tests.planner.twins import asked

FOREIGN = {
    "a prototype": "[__proto__]\nforeign = 1\n",
    "a prototype of a table": "[walk.__proto__]\nforeign = 1\n",
    "a constructor": "[constructor.prototype]\nforeign = 1\n",
    "a unit that all tables have": 'walk.speed = "1 constructor"\n',
    "a kind that all tables have": 'route.kind = "constructor"\n',
    "a formation that all tables have": """[route]
kind = "formation"
name = "constructor"
pitch = 1
""",
    "a name that all tables have": "walk.toString = 1\n",
}


def test_texts_without_end_are_refused_in_a_sentence() -> None:
    *found, last = asked("doors.mjs", [BASE + text for text in WRONG.values()])
    assert [one.get("kind") for one in found] == ["PlanError"] * len(WRONG)
    assert max(len(one["error"]) for one in found) < 10_000
    assert last == {"foreign": None}


def test_a_table_that_is_there_twice_is_refused_in_pythons_words() -> None:
    text = f'{BASE}[people]\nunit = "qiao"\n[people]\nroster = "names.csv"\n'
    found, _last = asked("doors.mjs", [text])
    assert found["error"].endswith(
        "[people] is defined twice: delete this line, and move its keys below the first [people]"
    )


def test_what_javascript_has_in_every_table_is_no_key_of_a_plan() -> None:
    *found, last = asked("doors.mjs", [BASE + text for text in FOREIGN.values()])
    assert [one.get("kind") for one in found] == ["PlanError"] * len(FOREIGN)
    assert last == {"foreign": None}
    for text, one in zip(FOREIGN.values(), found, strict=True):
        with pytest.raises(PlanError) as refused:
            checked(parsed(BASE + text, "plan"), "plan")
        assert str(refused.value) == one["error"]


def test_a_base_that_javascript_has_in_every_table_is_none() -> None:
    found, _last = asked("doors.mjs", ['schema = 1\nbase = "constructor"\n'])
    assert found["error"].startswith("plan: base must be one of ")


@pytest.mark.parametrize(("signs", "most"), [("=[{", MOST_KEYS), (",", MOST_ENTRIES)])
def test_as_many_keys_as_python_reads_are_not_too_many(signs: str, most: int) -> None:
    many = f"{BASE}#" + signs * ((most - BASE.count("=")) // len(signs))
    found, refused, _last = asked("doors.mjs", [many, many + 3 * signs])
    assert found["plan"]["schema"] == 1
    wanted = "plan is too long for a plan: at most 500000 keys and 1000000 entries are read"
    assert refused["error"] == wanted
