"""The public names as others use them: listed, equal, hashable, sequences, typed at the door."""

import inspect
import json
import pickle
import subprocess
import sys
import tarfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hatchling.builders.sdist import SdistBuilder

import benchdragon as bd

ROOT = Path(__file__).parents[1]
DRAGON = bd.Dragon.uniform(3)
ROUTE = bd.Route((bd.Line(50.0), bd.Arc(5.0, 1.0).moved((50.0, 0.0), 0.0)))
BEND = bd.Walk(
    bd.Dragon.uniform(2), bd.Route.joined([bd.Line(9.0), bd.Arc(5.0, degrees=90), bd.Line(9.0)])
)
WALK = bd.Walk(DRAGON, ROUTE, start=20.0)
MOTION = WALK.motion([0.0, 1.0])
PLAN = bd.read_plan(
    "spiral-in", ["disc.radius=4.5", "dragon.benches=40", "route.pitch=0.6", "limits.speed=2"]
)
# A proof of it takes half a second.
SHORT = bd.read_plan(
    "spiral-in", ["dragon.benches=4", "route.pitch=1.2", "route.start_turn=4", "walk.end=2"]
)
HALL = bd.read_plan(
    "spiral-in",
    ["disc.radius=2.9", "dragon.benches=4", "route.start_turn=9", "venue.rectangle=[14, 14]"],
)
WELL = bd.Obstacle.circle("well", (3.0, 4.0), 0.5)
TURN = bd.read_plan("turn", ["dragon.benches=4", "walk.end=20"])
SWEPT = bd.sweep(PLAN, {"route.pitch": [0.6]}, ["first_contact"])


def test_all_public_names_are_listed_before_any_is_used() -> None:
    script = "import benchdragon, json; print(json.dumps(dir(benchdragon)))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert set(bd.__all__) <= set(json.loads(done.stdout))
    assert all(getattr(bd, name) is not None for name in dir(bd))


def test_dragons_of_the_same_sizes_are_equal_and_the_same_key() -> None:
    assert bd.Dragon.uniform() == bd.Dragon.uniform()
    assert len({bd.Dragon.uniform(), bd.Dragon.uniform(), bd.Dragon.uniform(222)}) == 2
    plain: Any = bd.Dragon.uniform
    for changed in ("width", "head_length", "body_length", "tail_length", "front_inset", "rear_inset"):
        assert plain(**{changed: 1.9 if "length" in changed else 0.2}) != plain()
    plus, minus = (bd.Dragon.of_sizes([2.0], front_inset=zero) for zero in (0.0, -0.0))
    assert (plus == minus, hash(plus)) == (True, hash(minus))
    assert bd.Dragon.uniform() != "dragon"
    assert pickle.loads(pickle.dumps(DRAGON)) == DRAGON


def test_walks_of_equal_parts_are_equal_and_the_same_key() -> None:
    again = bd.Walk(bd.Dragon.uniform(3), bd.Route(ROUTE.curves), start=20.0)
    assert again == WALK
    assert len({again, WALK, bd.Walk(DRAGON, ROUTE, start=21.0)}) == 2
    assert bd.Walk(DRAGON, ROUTE, bd.SpeedProfile.constant(2.0), 20.0) != WALK


def test_a_dragon_is_a_sequence_of_benches() -> None:
    benches = [bd.Bench(3.41), bd.Bench(2.2, 0.4), bd.Bench(2.0, 0.2, 0.1, 0.3)]
    dragon = bd.Dragon(benches)
    assert list(dragon) == benches
    assert [dragon[i] for i in range(3)] == benches
    assert (dragon[-1], len(dragon)) == (benches[2], 3)
    assert bd.Dragon(dragon) == dragon
    assert benches[1] in dragon
    with pytest.raises(IndexError):
        dragon[3]


def test_a_route_is_a_sequence_of_curves_and_a_profile_one_of_knots() -> None:
    assert list(ROUTE) == list(ROUTE.curves)
    assert (len(ROUTE), ROUTE[-1]) == (2, ROUTE.curves[1])
    profile = bd.SpeedProfile((0.0, 5.0), (1.0, 0.5))
    assert list(profile) == [(0.0, 1.0), (5.0, 0.5)]
    assert (len(profile), profile[1]) == (2, (5.0, 0.5))
    assert bd.SpeedProfile(*zip(*profile, strict=True)) == profile


def test_a_dragon_cannot_be_changed() -> None:
    for name in ("length", "width", "front_inset", "rear_inset", "links", "sizes"):
        with pytest.raises(AttributeError, match=f"a dragon cannot be changed \\({name}\\)"):
            setattr(DRAGON, name, np.ones(3))
        with pytest.raises(ValueError, match="read-only"):
            getattr(DRAGON, name)[..., 0] = 1.0


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda any_: bd.Walk(DRAGON, ROUTE, any_), "profile must be a SpeedProfile, not 1.0: Spee"),
        (lambda any_: bd.Walk(DRAGON, any_), "route must be a Route, not 1.0: Route((curve,)) is"),
        (lambda any_: bd.Walk(any_, ROUTE), "dragon must be a Dragon, not 1.0"),
        (bd.Dragon, "benches must be a list of Bench, not 1.0"),
        (lambda any_: bd.Dragon([bd.Bench(2.0), any_]), "bench 2 must be a Bench, not 1.0"),
        (bd.Route, "curves must be a list of curves, not 1.0"),
        (lambda any_: bd.Route((bd.Line(1.0), any_)), "curve 2 must be a Line, Arc, Spiral, Clot"),
        (bd.clearances, "placed must be a Placement, not 1.0"),
        (
            lambda any_: bd.tightest_pairs(MOTION, any_),
            "index must be a whole number from 0 to 1, not 1.0",
        ),
        (
            lambda any_: bd.tightest_pairs(MOTION, -int(any_)),
            "index must be a whole number from 0 to 1, not -1",
        ),
        (lambda any_: bd.tightest_pairs(MOTION, 0, any_), "count must be a whole number from 1 to"),
        (lambda any_: bd.first_contact(any_, 0.0, 1.0), "walk must be a Plan or a Walk, not 1.0"),
        (lambda any_: WALK.motion([0.0], workers=any_), "workers must be a whole number from 1 to 64"),
        (lambda any_: bd.three_pieces(1.7, 4.5, 4.5, any_), "radii must be a pair, not 1.0"),
        (lambda any_: bd.Turn(1.7, 4.5, 4.5, any_), "pieces must be triples (length, curvature, curv"),
    ],
)
def test_a_wrong_type_is_told_what_was_wanted(make: Callable[[Any], object], sentence: str) -> None:
    with pytest.raises(bd.InputError) as caught:
        make(1.0)
    assert sentence in str(caught.value)


# Sound arguments of every public constructor and function.
CALLS: dict[str, tuple[Any, ...]] = {
    "Arc": (5.0, 1.0),
    "Bench": (2.0, 0.3, 0.1, 0.1),
    "Step": (bd.formation("coil-in"), (0.0, 0.0), 1.0),
    "connections": (((0.0, 0.0), 0.0), ((9.0, 0.0), 1.0), 2.0),
    "formation": ("coil-in",),
    "programme": ([bd.Step(bd.formation("coil-in"))], 2.0),
    "Clothoid": (5.0, 0.0, 0.1),
    "LogSpiral": (5.0, 0.2, 0.1),
    "Dragon": ([bd.Bench(2.0)],),
    "Line": (5.0,),
    "Route": ((bd.Line(5.0),),),
    "SpeedProfile": ((0.0,), (1.0,)),
    "Spiral": (1.0, 10.0, 5.0),
    "Turn": (1.7, 4.5, 4.5, ((1.0, 0.2, 0.2),)),
    "Deviations": (0.01,),
    "Placement": (DRAGON, ROUTE, [20.0, 21.0]),
    "TwoArcTurn": (1.7, 4.5, 2.0),
    "Walk": (DRAGON, ROUTE, WALK.profile, 0.0),
    "TurnGoal": (),
    "grade": ("pitch", 0.45),
    "first_overlap": (WALK, [0.0, 1.0]),
    "traversed_pitch": (PLAN, 0.1, 9.0),
    "difference_velocities": (WALK, [0.5], 0.1, "central"),
    "head_positions": (PLAN.build(), [1.0], "rk4", 0.5),
    "limit_rates": (PLAN, "pitch", PLAN.smallest_pitch()),
    "slowed": (TURN,),
    "sweep_command": (SWEPT,),
    "kept_tolerances": (),
    "picture_style": (),
    "use_language": ("en",),
    "bench_offsets": (MOTION, 1),
    "Wishes": (2, 1.5, 0.15, 2.0, 0.15),
    "bench_walks": (PLAN, WALK, (0.0, 1.0)),
    "plot_answer": (bd.least_clearance(WALK, 0.0, 2.0), WALK),
    "plot_area": (bd.swept_area(WALK, 0.0, 2.0),),
    "plot_clearance": (bd.clearance_curve(WALK, [0.0, 1.0, 2.0]),),
    "plot_motion": (MOTION,),
    "plot_plan": (PLAN,),
    "plot_report": (bd.check(SHORT),),
    "plot_route": (ROUTE,),
    "plot_speeds": (MOTION,),
    "plot_sweep": (SWEPT,),
    "chalk_plan": (bd.Trail.of(WALK, 0.0, 1.0), 1.0, (0.0, 0.0)),
    "propose": (bd.Wishes(2, 1.5, 0.15, radius=9.0, kind="spiral-in"),),
    "roster_of": (PLAN,),
    "timetable": (PLAN, WALK, 0.0, 1.0),
    "as_html": (DRAGON,),
    "best_place": (HALL,),
    "best_turn": (TURN,),
    "check": (PLAN,),
    "enclosing": (WALK, 0.0, 2.0),
    "swept_area": (WALK, 0.0, 2.0),
    "clearance_curve": (WALK, [0.0, 1.0, 2.0]),
    "clearances": (MOTION,),
    "contact_windows": (WALK, 0.0, 2.0),
    "first_contact": (WALK, 0.0, 2.0),
    "first_touch": (WALK, WELL, 0.0, 2.0),
    "least_distance": (WALK, WELL, 0.0, 2.0),
    "greatest_head_speed": (PLAN,),
    "greatest_speed": (WALK, 0.0, 2.0),
    "least_clearance": (WALK, 0.0, 2.0),
    "off_tracking": (WALK, 0.2, 0.0, 2.0),
    "steering_gain": (BEND, 2, 0.2),
    "limit": (PLAN, "pitch"),
    "prove_contact": (WALK, 0.0, 2.0),
    "prove_report": (bd.check(SHORT),),
    "show": (MOTION,),
    "smallest_pitch": (PLAN,),
    "three_pieces": (1.7, 4.5, 4.5, (2.0, 2.0)),
    "tightest_pairs": (MOTION, 0, 1),
    "RandomDances": (2, bd.Deviations(0.01), 1),
    "Refinement": (8, 0.01),
    "listed_points": ({"route.pitch": [0.5, 0.6]},),
    "sampled_points": ({"route.pitch": (0.5, 0.6)}, 3, 1, "sobol"),
    "sweep": (PLAN, {"route.pitch": [0.6]}, ["first_contact"]),
    "tolerance": (PLAN, bd.Deviations(0.01), 2),
    "two_arcs": (1.7, 4.5, 4.5, 2.0),
}
# What the package makes, and nobody else has to.
MADE = {
    "BenchOffTracking", "BenchWalk", "ChalkPlan", "OffTracking", "Passing", "Person", "Proposal",
    "Roster", "TooSmall", "Trail",
    "Answer", "BestTurn", "BoundingCircle", "BoundingRectangle", "ClearanceCurve", "Comparison",
    "Connection", "Enclosing", "Formation", "Grade", "Motion", "Nearness", "Obstacle", "Offsets",
    "Pace", "PlacedDance", "Plan", "Points", "Report", "Rings", "Status", "Sweep", "SweptArea",
    "Tolerance", "Widest", "Window", "Witness",
    "BenchDragonError", "InputError", "NoSolutionError", "PlanError", "UnsureError", "WalkError",
}  # fmt: skip

# What reads or writes files: tested with them.
FILES = {
    "animate", "compare", "read_plan", "read_points", "read_sweep", "write_result1", "write_result2",
    "write_result4",
}  # fmt: skip


def test_every_public_constructor_and_function_is_tried() -> None:
    assert {*CALLS, *MADE, *FILES} == set(bd.__all__)


@pytest.mark.parametrize("name", CALLS)
def test_wrong_types_are_refused_as_input(name: str) -> None:
    make, sound = getattr(bd, name), CALLS[name]
    make(*sound)
    parameters = inspect.signature(make).parameters.values()
    for i, parameter in zip(range(len(sound)), parameters, strict=False):
        for wrong in ("x", None, object(), [[1.0, 2.0], "x"]):
            if wrong is None is parameter.default:
                continue
            with pytest.raises(bd.InputError):
                make(*sound[:i], wrong, *sound[i + 1 :])


@pytest.mark.parametrize(
    "ask",
    [
        WALK.motion,
        lambda wrong: list(WALK.motions(wrong)),
        lambda wrong: WALK.motion([0.0], workers=wrong),
        WALK.head_position,
        WALK.head_where_tail,
        ROUTE.point,
        ROUTE.heading,
        ROUTE.curvature,
        lambda wrong: bd.bench_offsets(MOTION, points=[wrong]),
        WALK.profile.speed,
        WALK.profile.acceleration,
        WALK.profile.distance,
        WALK.profile.time,
        bd.SpeedProfile.constant,
        lambda wrong: bd.Spiral.between(wrong, 1.0, 2.0),
    ],
)
def test_wrong_types_of_methods_are_refused_as_input(ask: Callable[[Any], object]) -> None:
    for wrong in ("x", None, object(), [[1.0, 2.0], "x"]):
        with pytest.raises(bd.InputError):
            ask(wrong)


def test_a_motion_is_a_table_of_pandas() -> None:
    pandas = pytest.importorskip("pandas")
    motion = WALK.motion([2.0, 0.0, 1.0])
    table = motion.to_dataframe()
    assert isinstance(table, pandas.DataFrame)
    assert table.index.names == ["time", "handle"]
    assert list(table.columns) == ["x", "y", "s", "speed", "acceleration"]
    assert len(table) == 3 * 4
    for name in table.columns:
        assert np.array_equal(
            table[name].unstack("handle", sort=False).to_numpy(), getattr(motion, name)
        )
    assert table.loc[(1.0, 3), "x"] == motion.x[2, 3]


@pytest.mark.parametrize(("library", "method"), [("pandas", "to_dataframe"), ("xarray", "to_xarray")])
def test_without_the_extra_it_is_named(
    monkeypatch: pytest.MonkeyPatch, library: str, method: str
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(bd.BenchDragonError, match=r"pip install 'benchdragon\[data\]'"):
        getattr(MOTION, method)()


def test_the_source_archive_holds_all_that_tests_read(tmp_path: Path) -> None:
    (archive,) = SdistBuilder(str(ROOT)).build(directory=str(tmp_path))
    with tarfile.open(archive) as opened:
        held = {name.partition("/")[2] for name in opened.getnames()}
    single = {
        ".ci/run",
        "CONTRIBUTING.md",
        "Makefile",
        "README.zh-CN.md",
        "docs/modules.toml",
        "requirements-demo.lock",
        "requirements-engine.lock",
        "requirements-mutation.lock",
        "requirements-wasm.lock",
        "requirements.lock",
        "tests/long.txt",
        "tests/plain.txt",
        "tests/quick.txt",
        "tsconfig.json",
    }
    folders = ("benchmarks", "design", "docs/en", "docs/zh", "examples", "src", "tests", "tools")
    made = {".pyc", ".so"}
    found = (
        path
        for folder in folders
        for path in (ROOT / folder).rglob("*.*")
        if path.suffix not in made and path.parent.name not in {"reference", "modules"}
    )
    assert single | {path.relative_to(ROOT).as_posix() for path in found} <= held
