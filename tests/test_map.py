"""The map and the table of rooms are those of the contract and of the imports that are there."""

from collections import Counter

import pytest
from tools.make_map import Stairs, arrows, circles, floors, not_down, page, room

HOUSE = (("roof",), ("east", "west"), ("ground",))
DOWN = {("roof", "east"): 3, ("roof", "ground"): 2, ("west", "ground"): 1}


def test_the_table_of_rooms_stands_between_its_comments() -> None:
    assert "| [`kernels`](src/benchdragon/kernels) |" in page()


def test_all_arrows_point_down_and_none_lead_in_a_circle() -> None:
    house, found = floors(), arrows()
    assert {name for arrow in found for name in arrow} == {name for floor in house for name in floor}
    assert not_down(found, house) == []
    assert circles(found) == []


@pytest.mark.parametrize("wrong", [("ground", "roof"), ("east", "west"), ("west", "roof")])
def test_an_arrow_that_does_not_point_down_is_told_of(wrong: tuple[str, str]) -> None:
    assert not_down(DOWN, HOUSE) == []
    assert not_down({**DOWN, wrong: 1}, HOUSE) == [wrong]


def test_a_circle_is_told_of_even_through_other_rooms() -> None:
    assert circles(DOWN) == []
    assert circles({*DOWN, ("ground", "west")}) == [("ground", "west")]
    round_ = [("a", "b"), ("b", "c"), ("c", "a"), ("c", "d")]
    assert circles(round_) == [("a", "b"), ("a", "c"), ("b", "c")]


def test_an_import_is_counted_once_for_each_pair_of_modules() -> None:
    found = arrows()
    # These two modules import others of the package, whatever becomes of the rest.
    assert found["__main__", "cli"] == found["__main__", "i18n"] == 1
    assert found["plans", "model"] > found["plans", "kernels"] >= 1
    assert ("kernels", "model") not in found
    assert not any(a == b for a, b in found)


def test_every_number_stands_where_its_row_and_its_column_meet() -> None:
    house = floors()
    names = [name for floor in house for name in floor]
    stairs = Stairs(house, Counter({(names[0], names[1]): 7, (names[1], names[3]): 12}))
    drawn = stairs.drawn()
    for (a, b), count in stairs.found.items():
        x, y = stairs.at(a, b)
        assert f'<text x="{x:g}" y="{y + 4.5:g}" class="count">{count}</text>' in drawn
    assert drawn.count('marker-end="url(#tip)"') == 2
    assert all(f">{name}</text>" in drawn for name in names)


def test_a_room_says_what_it_holds() -> None:
    kernels, errors = room("kernels"), room("errors")
    assert kernels.text.startswith("Compiled arithmetic")
    assert (kernels.is_folder, errors.is_folder, errors.files) == (True, False, 1)
    assert kernels.files > 10
    assert kernels.lines > 2_000
