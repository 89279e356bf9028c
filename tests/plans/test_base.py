"""A plan may start from another, a built-in one or a file beside it, and add to it."""

from pathlib import Path

import pytest

from benchdragon.plans.schema import Plan, checked, read_plan
from benchdragon.plans.toml import MOST_BASES, PlanError, built_in_names


def written(folder: Path, name: str, text: str) -> str:
    path = folder / f"{name}.dragon.toml"
    path.write_text(f"schema = 1\n{text}", encoding="utf-8")
    return str(path)


def test_a_plan_adds_to_a_built_in_one(tmp_path: Path) -> None:
    source = written(tmp_path, "own", 'base = "spiral-in"\n[route]\npitch = 0.6\n[disc]\nradius = 4\n')
    plan = read_plan(source, ["dragon.benches=50"])
    same = read_plan("spiral-in", ["route.pitch=0.6", "disc.radius=4", "dragon.benches=50"])
    assert plan.sha256 == same.sha256
    assert "base" not in plan.data()
    assert "base" not in plan.toml()


def test_obstacles_are_added_and_other_lists_replaced(tmp_path: Path) -> None:
    well = '[[obstacle]]\nname = "well"\nkind = "circle"\ncentre = [0, 0]\nradius = 1\n'
    gate = '[[obstacle]]\nname = "gate"\nkind = "line"\npoints = [[9, 0], [9, 3]]\n'
    written(tmp_path, "square", f'base = "turn"\n[venue]\nrectangle = [40, 30]\nangle = 5\n{well}')
    source = written(
        tmp_path,
        "dance",
        f'base = "square.dragon.toml"\n[venue]\nboundary = [[0,0],[9,0],[0,9]]\n{gate}',
    )
    plan = read_plan(source)
    assert [obstacle.name for obstacle in plan.obstacles()] == ["venue", "well", "gate"]
    assert plan.obstacles()[0].outline.tolist() == [[0, 0], [9, 0], [0, 9]]
    assert plan.route.kind == "turn"


def test_another_kind_of_route_replaces_that_of_the_base(tmp_path: Path) -> None:
    source = written(
        tmp_path,
        "own",
        'base = "turn"\n[[route.part]]\nkind = "line"\nlength = 900\n[walk]\nspeed = 2\n',
    )
    plan = read_plan(source)
    assert (plan.route.kind, plan.turn, plan.disc.radius) == (
        "parts",
        Plan.model_fields["turn"].default,
        None,
    )
    profiled = written(tmp_path, "fast", 'base = "turn"\n[walk]\nprofile = [[0, 1], [9, 2]]\n')
    assert read_plan(profiled).walk.profile == [(0.0, 1.0), (9.0, 2.0)]


@pytest.mark.parametrize(
    ("base", "sentence"),
    [
        (
            '"../turn.dragon.toml"',
            f"base must be one of {', '.join(built_in_names())} or the name of a file beside it",
        ),
        ('"/etc/passwd"', "base must be one of"),
        ("7", "base must be one of"),
        ("false", "base must be one of"),
        ('""', "base must be one of"),
        ('"a\\u0000b"', "base must be one of"),
        ('"nothing.dragon.toml"', "there is no plan nothing.dragon.toml"),
        ('"own.dragon.toml"', "own.dragon.toml: base = 'own.dragon.toml' comes back to itself"),
    ],
)
def test_a_base_that_cannot_be_is_refused(tmp_path: Path, base: str, sentence: str) -> None:
    with pytest.raises(PlanError) as caught:
        read_plan(written(tmp_path, "own", f"base = {base}\n"))
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_bases_do_not_go_on_for_ever(tmp_path: Path) -> None:
    for n in range(MOST_BASES + 1):
        written(tmp_path, f"p{n}", f'base = "p{n + 1}.dragon.toml"\n')
    written(tmp_path, f"p{MOST_BASES + 1}", 'base = "turn"\n')
    with pytest.raises(PlanError, match=f"the {MOST_BASES}th base in a row"):
        read_plan(str(tmp_path / "p0.dragon.toml"))
    assert read_plan(str(tmp_path / "p3.dragon.toml")).route.kind == "turn"


def test_a_plan_that_is_no_file_may_start_from_a_built_in_one_alone() -> None:
    data = {"schema": 1, "base": "turn", "walk": {"speed": 2.0}}
    assert checked(data, "sent").sha256 == read_plan("turn", ["walk.speed=2"]).sha256
    with pytest.raises(PlanError, match="base must be one of"):
        checked({"schema": 1, "base": "beside.dragon.toml"}, "sent")


def test_a_base_of_parts_may_be_moved_though_it_says_no_kind(tmp_path: Path) -> None:
    written(tmp_path, "line", '[[route.part]]\nkind = "line"\nlength = 900\n')
    moved = read_plan(written(tmp_path, "own", 'base = "line.dragon.toml"\n[route]\nat = [1, 2]\n'))
    assert moved.build().route.start_pose == ((1.0, 2.0), 0.0)
