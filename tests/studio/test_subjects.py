"""Which plan an answer is about: its hash on all of them, and long questions found again."""

import itertools
from typing import Any

import httpx
import pytest

from benchdragon.plans.schema import Plan
from benchdragon.studio.app import SUBJECT
from benchdragon.studio.limits import Settings
from tests.studio.servers import PLAN, TURN, Served, wait_for

pytestmark = pytest.mark.xdist_group("studio")
ADDRESSES = (
    "verdict", "dance", "limit/pitch", "limit/width", "toml", "export/motion.csv", "export/motion.npz",
)  # fmt: skip
CLIENTS = (f"client-{n}" for n in itertools.count())


def post(studio: Served, path: str, plan: Any, client: str = "", **more: Any) -> httpx.Response:
    headers = {"x-client": client} if client else {}
    body = {"plan": plan, **more}
    return studio.client.post(f"/api/{path}", params={"lang": "en"}, json=body, headers=headers)


@pytest.mark.parametrize("path", ADDRESSES)
def test_every_answer_names_its_plan(studio: Served, path: str) -> None:
    for benches in (30, 31, 30):  # the last is among the answers kept
        plan = {**PLAN, "dragon": {"benches": benches}}
        found = post(studio, path, plan)
        assert found.status_code == 200
        assert found.headers[SUBJECT] == Plan.model_validate(plan).sha256


def test_a_refusal_names_its_plan_where_there_is_one(studio: Served) -> None:
    far = {**PLAN, "walk": {"end": 1e5}}
    found = post(studio, "verdict", far)
    assert found.status_code == 422
    assert found.headers[SUBJECT] == Plan.model_validate(far).sha256
    none = post(studio, "verdict", {**PLAN, "disc": {"radius": -1}})
    assert none.status_code == 422
    assert SUBJECT not in none.headers
    text = studio.client.post("/api/plan", json={"toml": "schema = 1"})
    assert text.status_code == 422
    assert SUBJECT not in text.headers


def test_a_long_question_and_the_refusal_of_one_name_their_plans(studio: Served) -> None:
    client = next(CLIENTS)
    turn = {**TURN, "dragon": {"benches": 223}}
    started, *others = (
        post(studio, "jobs", turn, client, question="turn") for _n in range(Settings().jobs_each)
    )
    crowded = post(studio, "jobs", PLAN, client, question="prove")
    name = started.json()["id"]
    about = studio.client.get(f"/api/jobs/{name}").json()
    for one in (*others, started):
        studio.client.delete(f"/api/jobs/{one.json()['id']}")
    wanted = Plan.model_validate(turn).sha256
    assert started.headers[SUBJECT] == about["plan_sha256"] == wanted
    assert crowded.status_code == 429
    assert crowded.headers[SUBJECT] == Plan.model_validate(PLAN).sha256


def taken(studio: Served, client: str) -> Any:
    headers = {"x-client": client} if client else {}
    return studio.client.get("/api/jobs", headers=headers).json()


def test_a_client_finds_its_long_questions_again_and_nobody_elses(studio: Served) -> None:
    mine, other = next(CLIENTS), next(CLIENTS)
    assert taken(studio, mine) == []
    name = post(studio, "jobs", TURN, mine, question="speed").json()["id"]
    nobodys = post(studio, "jobs", TURN, question="speed").json()["id"]
    found = taken(studio, mine)
    plan = Plan.model_validate(TURN)
    assert [(one["id"], one["question"], one["plan_sha256"]) for one in found] == [
        (name, "speed", plan.sha256)
    ]
    assert Plan.model_validate(found[0]["plan"]) == plan
    assert taken(studio, other) == []
    assert taken(studio, "") == []
    for one in (name, nobodys):
        wait_for(lambda one=one: studio.client.get(f"/api/jobs/{one}").json()["state"] == "done")
    assert [one["id"] for one in taken(studio, mine)] == [name]


def test_a_long_question_that_has_ended_is_forgotten_when_its_page_puts_it_away(studio: Served) -> None:
    client = next(CLIENTS)
    name = post(studio, "jobs", TURN, client, question="speed").json()["id"]
    wait_for(lambda: studio.client.get(f"/api/jobs/{name}").json()["state"] == "done")
    assert studio.client.delete(f"/api/jobs/{name}").json()["state"] == "done"
    assert taken(studio, client) == []
    assert studio.client.get(f"/api/jobs/{name}").status_code == 404
