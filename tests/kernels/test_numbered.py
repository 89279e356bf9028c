"""Names of the kernels: one name has one value in all of them, and columns of records differ."""

import importlib
from collections import defaultdict
from types import ModuleType

import pytest
from tools.make_constants import own_names

from benchdragon.hosts import built
from benchdragon.kernels.box import Box
from benchdragon.kernels.box_hierarchy import Hull
from benchdragon.kernels.numbered import Names, Numbered

PATHS = sorted(path for path in built.KERNELS.glob("*.py") if path.stem != "__init__")
KERNELS = [importlib.import_module(f"benchdragon.kernels.{path.stem}") for path in PATHS]


def own_classes(module: ModuleType) -> list[type]:
    classes = (one for one in vars(module).values() if isinstance(one, type))
    return [one for one in classes if one.__module__ == module.__name__]


def members(names: Names) -> dict[str, float]:
    return {name: getattr(names, name) for name in dir(names) if name.isupper()}


NAMES = [one for module in KERNELS for one in own_classes(module) if isinstance(one, Names)]


def test_one_name_has_one_value_in_all_kernels() -> None:
    values: dict[str, set[str]] = defaultdict(set)
    for module in KERNELS:
        for name in own_names(module):
            values[name].add(str(getattr(module, name)))
    assert len(values) > 300
    assert not {name: found for name, found in values.items() if len(found) > 1}


def test_one_name_is_that_of_one_class() -> None:
    found = [one.__name__ for module in KERNELS for one in own_classes(module)]
    assert len(found) > 150
    assert not {name for name in found if found.count(name) > 1}


@pytest.mark.parametrize("names", NAMES, ids=lambda names: names.__name__)
def test_a_number_has_one_name(names: Names) -> None:
    """But for that of a row that begins with others: BY says where they do."""
    found = {name: value for name, value in members(names).items() if name != "BY"}
    assert len(set(found.values())) == len(found)
    assert all(float(value).is_integer() for value in found.values())


def test_a_class_that_follows_another_has_its_names_too() -> None:
    assert len(Numbered) == 0
    assert members(Hull) == {**members(Box), "RADIUS": 6}
    assert (len(Box), len(Hull)) == (6, 7)
