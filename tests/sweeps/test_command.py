"""The command that makes a sweep anew, read by the program itself."""

import shlex
from pathlib import Path

import click
import pyarrow as pa
import pytest
from pyarrow import parquet

from benchdragon import Deviations, Plan, Points, RandomDances, Refinement, read_plan, sampled_points
from benchdragon.cli import sweep as verb
from benchdragon.plans.keys import meaning
from benchdragon.plans.schema import checked
from benchdragon.sweeps.command import (
    MOST_SEED,
    POINTS_FILE,
    plan_words,
    sweep_command,
    unsaid,
    vary_text,
)
from benchdragon.sweeps.points import Value, grid_points, listed_points, parse_vary
from benchdragon.sweeps.sweep import Design, Sweep

COIL, TURN = read_plan("spiral-in"), read_plan("turn")
PITCHES = grid_points({"route.pitch": [0.5, 0.55]})


def made(design: Design) -> Sweep:
    return Sweep(design.about(), pa.table({}))


def asked_again(line: str) -> Design:
    """What the verb would ask."""
    program, name, *words = shlex.split(line)
    assert (program, name) == ("benchdragon", "sweep")
    with verb.sweep.make_context("sweep", words) as context:
        options = context.params
        plan, settings = options.pop("plan"), options.pop("settings")
        verb._refuse_strays(plan, options)
        return verb._design(read_plan(plan, settings), options)


@pytest.mark.parametrize(
    "design",
    [
        Design(COIL, grid_points(parse_vary(["route.pitch=0.45..0.6..0.01"])), ("first_contact",)),
        Design(
            TURN, grid_points(parse_vary(["turn.ratio=1,1.5,3", "dragon.benches=50..60..5"])),
            ("clearance",),
        ),
        Design(
            read_plan("spiral-in", ["disc.radius=4.5", "dragon.width=0.25", 'meta.title="a b"']),
            PITCHES, ("smallest_pitch", "first_contact"), refinement=Refinement(30, 0.01),
        ),
        Design(COIL, grid_points({"route.clockwise": ["true"]}), ("first_contact",)),
        Design(
            COIL, sampled_points({"route.pitch": (0.4, 0.6), "dragon.benches": (20, 90)}, 7, 3),
            ("first_contact",),
        ),
        Design(
            COIL, sampled_points({"route.pitch": (0.4, 0.6)}, 7, method="sobol"), ("first_contact",)
        ),
        Design(COIL, PITCHES, ("tolerance",), RandomDances(draws=5, seed=4)),
        Design(COIL, PITCHES, ("tolerance",), RandomDances(5, Deviations(aside=0.03, play=0.01))),
        Design(COIL, PITCHES, ("tolerance",), RandomDances(5, Deviations())),
        Design(COIL, PITCHES, ("tolerance",), RandomDances(5, seed=MOST_SEED)),
        Design(
            COIL, PITCHES, ("tolerance", "first_contact"), RandomDances(5, Deviations(), 2),
            Refinement(4, 1e-9),
        ),
        Design(
            COIL, sampled_points({"route.pitch": (0.4, 0.6)}, 3, 9), ("tolerance",),
            RandomDances(5, seed=9),
        ),
        Design(COIL, grid_points({"route.pitch": [0.5, 1 / 3, 0.6]}), ("first_contact",)),
        Design(COIL, grid_points(parse_vary(["dragon.width=1e-1..3e-1..1e-2"])), ("first_contact",)),
    ],
)  # fmt: skip
def test_the_command_asks_the_same(design: Design) -> None:
    line = sweep_command(made(design), "a folder")
    again = asked_again(line)
    assert again.about() == {**design.about(), "plan": again.about()["plan"]}
    assert line.endswith("-o 'a folder'")


@pytest.mark.parametrize(
    "columns",
    [
        {"route.pitch": [0.5, 1 / 3], "dragon.benches": [20, 30]},
        {"route.pitch": [1.0, 2.0], "route.clockwise": ["true", "false"]},
    ],
)
def test_points_of_a_list_come_from_a_file(
    columns: dict[str, list[Value]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    design = Design(COIL, listed_points(columns), ("first_contact",))
    monkeypatch.chdir(tmp_path)
    keys = pa.schema([(key, getattr(pa, kind)()) for key, kind in design.keys])  # as in the rows
    parquet.write_table(pa.table(columns, keys), POINTS_FILE)
    line = sweep_command(made(design), "x")
    assert "--vary" not in line
    assert asked_again(line).about() == design.about()


def test_seeds_are_as_large_as_the_option_takes() -> None:
    (kind,) = (one.type for one in verb.sweep.params if one.name == "seed")
    assert isinstance(kind, click.IntRange)
    assert kind.max == MOST_SEED


SAMPLE = {"route.pitch": (0.4, 0.6)}


@pytest.mark.parametrize(
    ("design", "why"),
    [
        (
            Design(COIL, sampled_points(SAMPLE, 3, 9), ("tolerance",), RandomDances(5, seed=8)),
            "its points have the seed 9, its random dances 8, and --seed is for both",
        ),
        (
            Design(COIL, PITCHES, ("tolerance",), RandomDances(5, seed=MOST_SEED + 1)),
            "--seed is at most 2147483648, not 2147483649",
        ),
        (
            Design(COIL, sampled_points(SAMPLE, 3, 2**62), ("first_contact",)),
            f"--seed is at most 2147483648, not {2**62}",
        ),
        *(
            (
                Design(COIL, grid_points({**SAMPLE, "meta.title": [text]}), ("first_contact",)),
                "--vary cannot say the values of meta.title",
            )
            for text in ("a,b", "1", " a", "a..b", "")
        ),
    ],
)
def test_what_no_command_line_can_say_is_told_in_a_sentence(design: Design, why: str) -> None:
    said = sweep_command(made(design), "out/x")
    assert said == unsaid(made(design)) == f"No command line makes this sweep: {why}."


def test_a_seed_that_nothing_draws_with_does_not_matter() -> None:
    design = Design(COIL, sampled_points(SAMPLE, 3, 9), ("first_contact",), RandomDances(5, seed=8))
    assert unsaid(made(design)) is None
    design = Design(COIL, PITCHES, ("first_contact",), RandomDances(seed=2**40))
    assert unsaid(made(design)) is None


def test_even_steps_are_told_as_steps_and_others_one_by_one() -> None:
    assert vary_text("a.b", [0.45, 0.46, 0.47]) == "a.b=0.45..0.47..0.01"
    assert vary_text("a.b", [3, 2, 1]) == "a.b=3..1..-1"
    assert vary_text("a.b", [0.1, 0.2, 0.4]) == "a.b=0.1,0.2,0.4"
    assert vary_text("a.b", [0.1, 0.2]) == "a.b=0.1,0.2"
    assert vary_text("a.b", [1, 1, 1]) == "a.b=1,1,1"
    assert vary_text("a.b", [1, 2.0, 3]) == "a.b=1,2.0,3"
    assert vary_text("a.b", ["x", "y", "z"]) == "a.b=x,y,z"
    thirds = [n / 3.0 for n in range(4)]
    assert parse_vary([vary_text("a.b", thirds)])["a.b"] == thirds


def test_a_plan_that_is_no_built_in_one_with_a_few_values_is_a_file() -> None:
    eight = read_plan(str(Path(__file__).parents[2] / "examples" / "02_eight.dragon.toml"))
    assert plan_words(eight) is None
    assert plan_words(TURN) == ["turn"]
    data = TURN.data()
    del data["limits"]["speed"]  # which no setting takes away
    assert plan_words(checked(data, "x")) is None
    sizes = [f"dragon.{key}=0.2" for key in ("front_inset", "rear_inset", "width")]
    lengths = [f"dragon.{key}=2" for key in ("head_length", "body_length", "tail_length")]
    few = [*sizes, *lengths, "route.pitch=0.6", "walk.speed=2"]
    assert len(plan_words(read_plan("spiral-in", few)) or []) == 1 + 2 * len(few)
    assert plan_words(read_plan("spiral-in", [*few, "walk.start=1", "dragon.benches=9"])) is None
    design = Design(eight, grid_points({"walk.speed": [0.5, 1.0]}), ("clearance",))
    line = sweep_command(made(design), "x")
    assert line.startswith("benchdragon sweep plan.dragon.toml --vary walk.speed=0.5,1.0 ")


@pytest.mark.parametrize(
    ("plan", "key", "unit", "text"),
    [
        (COIL, "route.pitch", "m", "distance between neighbouring turns of the spiral"),
        (TURN, "route.pitch", "m", "distance between neighbouring turns of both spirals"),
        (COIL, "disc.radius", "m", "its radius"),
        (COIL, "dragon.benches", "", "number of benches"),
    ],
)
def test_a_key_is_told_with_its_unit_as_its_plan_has_it(
    plan: Plan, key: str, unit: str, text: str
) -> None:
    found = meaning(plan, key)
    assert found.unit == unit
    assert found.text.startswith(text)


def test_keys_of_parts_are_told_by_the_parts_kind() -> None:
    plan = read_plan(str(Path(__file__).parents[2] / "examples" / "02_eight.dragon.toml"))
    for number, part in enumerate(plan.data()["route"]["part"]):
        key = "length" if "length" in part else "angle"
        assert meaning(plan, f"route.part.{number}.{key}").text
    with pytest.raises(ValueError, match=r"no section has route\.part\.0\.colour"):
        meaning(plan, "route.part.0.colour")


def test_points_know_how_they_were_drawn() -> None:
    points: Points = sampled_points({"route.pitch": (0.4, 0.6)}, 4, 2)
    assert points.sample is not None
    assert (points.sample.ranges, points.sample.seed) == (((0.4, 0.6),), 2)
    assert PITCHES.sample is None


def test_a_plan_with_a_square_is_named_by_its_settings() -> None:
    well = 'obstacle=[{kind="circle", name="well", centre=[3, 1], radius=0.5}]'
    plan = read_plan("spiral-in", ["venue.rectangle=[40, 30]", well])
    words = plan_words(plan)
    assert words is not None
    assert words[0] == "spiral-in"
    assert read_plan(words[0], words[2::2]).sha256 == plan.sha256
