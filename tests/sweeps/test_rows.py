"""Rows of a sweep: a point's values, and the numbers of each answer or why there is none."""

from typing import Any

import pyarrow as pa
import pytest

from benchdragon.analysis.contact import first_contact
from benchdragon.analysis.speed import greatest_speed
from benchdragon.errors import BenchDragonError
from benchdragon.hosts.built import source_hash
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.sweeps.questions import RandomDances
from benchdragon.sweeps.rows import FIELDS, TIMED, Ask, made_by, row_schema
from benchdragon.version import __version__

ASKED = ("first_contact", "greatest_speed")


@pytest.fixture(scope="module")
def plan() -> Plan:
    return read_plan("spiral-in", ["dragon.benches=8", "disc.radius=4.5"])


def ask(plan: Plan, *keys: tuple[str, str], asked: tuple[str, ...] = ASKED) -> Ask:
    return Ask(plan, keys, asked, RandomDances(draws=3))


def row(batch: Any, at: int = 0) -> dict[str, Any]:
    """A row without how long it took."""
    return {name: cell for name, cell in batch.to_pylist()[at].items() if not name.endswith(TIMED)}


def test_columns_are_the_point_the_keys_and_the_fields_of_each_question() -> None:
    keys = [("route.pitch", "float64"), ("dragon.benches", "int64"), ("a.b", "string")]
    schema = row_schema(keys, ["width", "disc"])
    assert schema.names == [
        "point", *[key for key, _kind in keys],
        *[f"{name}.{field}" for name in ("width", "disc") for field in FIELDS],
    ]  # fmt: skip
    assert schema.field("point").type == pa.int64()
    for key, kind in keys:
        assert str(schema.field(key).type) == kind.replace("float64", "double")
    assert schema.field("disc.bench_2").type == pa.int32()


def test_a_row_holds_the_numbers_of_each_answer(plan: Plan) -> None:
    batch = ask(plan, ("disc.radius", "float64"))([(7, (0.5,)), (3, (4.5,))])
    meets = plan.with_value("disc.radius", 0.5)
    walk = meets.build()
    contact, speed = first_contact(walk, *meets.span(walk)), None
    assert contact is not None
    near = contact.witness
    assert near is not None
    with pytest.raises(BenchDragonError) as told:
        speed = greatest_speed(walk, *meets.span(walk))
    assert speed is None
    found = row(batch)
    assert found == {
        "point": 7,
        "disc.radius": 0.5,
        "first_contact.value": contact.value,
        "first_contact.lower": contact.lower,
        "first_contact.upper": contact.upper,
        "first_contact.status": "found",
        "first_contact.bench_1": near.benches[0],
        "first_contact.bench_2": near.benches[1],
        "first_contact.handle": None,
        "first_contact.time": near.time,
        "first_contact.s": near.s,
        "first_contact.x": near.point[0],
        "first_contact.y": near.point[1],
        "first_contact.message": None,
        **{f"greatest_speed.{field}": None for field in FIELDS if field != TIMED},
        "greatest_speed.status": "unwalkable",
        "greatest_speed.message": str(told.value),
    }
    assert all(cell >= 0.0 for cell in batch["first_contact.seconds"].to_pylist())


def test_a_row_of_a_clear_dance_tells_until_when_and_an_answer_about_one_bench_its_handle(
    plan: Plan,
) -> None:
    found = row(ask(plan, ("disc.radius", "float64"))([(3, (4.5,))]))
    walk = plan.build()
    end = plan.span(walk)[1]
    speed = greatest_speed(walk, *plan.span(walk))
    assert speed.witness is not None
    assert (found["first_contact.status"], found["first_contact.lower"]) == ("clear", end)
    for field in ("value", "upper", "bench_1", "time", "x", "message"):
        assert found[f"first_contact.{field}"] is None
    assert found["greatest_speed.bench_1"] == speed.witness.benches[0]
    assert found["greatest_speed.bench_2"] is None
    assert found["greatest_speed.handle"] == speed.witness.handle
    assert found["greatest_speed.value"] == speed.value


def test_a_plan_that_cannot_be_is_a_row_that_says_why(plan: Plan) -> None:
    batch = ask(plan, ("route.pitch", "float64"))([(0, (-1.0,)), (1, (0.5,))])
    with pytest.raises(BenchDragonError) as told:
        plan.with_value("route.pitch", -1.0)
    refused, sound = row(batch), row(batch, 1)
    for name in ASKED:
        assert refused[f"{name}.status"] == "refused"
        assert refused[f"{name}.message"] == str(told.value)
        assert refused[f"{name}.value"] is None
        assert sound[f"{name}.status"] in {"found", "clear"}


def test_texts_and_numbers_under_one_key_stand_as_texts(plan: Plan) -> None:
    batch = ask(plan, ("route.pitch", "string"))([(0, (0.5,)), (1, ("wide",))])
    assert batch["route.pitch"].to_pylist() == ["0.5", "wide"]
    assert batch["first_contact.status"].to_pylist() == ["clear", "refused"]


def test_points_that_are_lost_have_rows(plan: Plan) -> None:
    batch = ask(plan, ("route.pitch", "float64")).lost([(4, (0.5,)), (5, (0.6,))], "it died")
    assert batch["point"].to_pylist() == [4, 5]
    assert batch["route.pitch"].to_pylist() == [0.5, 0.6]
    for name in ASKED:
        assert batch[f"{name}.status"].to_pylist() == ["lost"] * 2
        assert batch[f"{name}.message"].to_pylist() == ["it died"] * 2
        assert batch[f"{name}.value"].null_count == 2


def test_rows_tell_which_program_made_them(plan: Plan) -> None:
    batch = ask(plan, ("route.pitch", "float64"))([(0, (0.5,))])
    assert batch.schema.metadata == made_by()
    assert made_by() == {b"benchdragon": __version__.encode(), b"kernels": source_hash().encode()}
