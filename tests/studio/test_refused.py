"""What the studio refuses, in a sentence: plans, bodies, files, addresses."""

import json
from typing import Any

import pytest

from benchdragon.studio.security import HEADERS
from tests.studio.posts import JSON, error, post, with_part
from tests.studio.servers import PLAN, Served


@pytest.mark.parametrize(
    ("plan", "text"),
    [
        (1, "plan: wanted a table, not 1"),
        ({"schema": 1}, "plan: route is missing"),
        (with_part(disc={"radius": -1}), "plan: disc.radius: wanted more than 0.0, not -1"),
        (
            with_part(disc={"radious": 1}),
            "plan: disc.radious is not a known key; did you mean disc.radius?",
        ),
        (with_part(route={"kind": "spiral-in", "pitch": "x"}), "wanted a number, or text with a unit"),
        (with_part(dragon={"benches": 2.5}), "wanted a whole number"),
        (with_part(dragon={"benches": True}), "wanted a whole number"),
        (with_part(disc={"radius": 100}), "must be smaller than the radius of start_turn"),
        (with_part(walk={"speed": 0}), "the head never comes to the end of its walk"),
        (with_part(walk={"end": 1e5}), "past the end of the route"),
        (with_part(dragon={"benches": 3501}), "at most 3500 benches, not 3501"),
        (with_part(disc={"radius": 1e-300}), "plan: disc.radius: wanted at least 1e-06, not 1e-300"),
        (with_part(disc={"radius": 10**300}), "plan: disc.radius: wanted at most 100000000.0, not 1"),
        (
            with_part(walk={"start": 1e-9}),
            "the studio takes numbers from 1e-06 to 1e+06, and 0, not 1e-09",
        ),
        (
            with_part(disc={"radius": 5e6}),
            "the studio takes numbers from 1e-06 to 1e+06, and 0, not 5e+06",
        ),
    ],
)
def test_a_plan_that_cannot_be_used_gets_the_command_lines_sentence(
    studio: Served, plan: Any, text: str
) -> None:
    found = post(studio, "/api/verdict", plan)
    assert found.status_code == 422
    assert text in error(found)
    assert error(post(studio, "/api/verdict", plan, lang="zh")) != error(found)


@pytest.mark.parametrize(
    ("body", "status", "text"),
    [
        (b"", 400, "the body is not JSON"),
        (b"{", 400, "the body is not JSON"),
        (b'{"plan": "\xff"}', 400, "the body is not JSON: 'utf-8'"),
        (b'{"plan": NaN}', 400, "NaN is no number there"),
        (b'{"plan": -Infinity}', 400, "-Infinity is no number there"),
        (b'{"plan": "\\ud800"}', 400, "the body is not JSON"),
        (b"[" * 33 + b"]" * 33, 400, "wanted brackets at most 32 deep"),
        (b"[" * 100_000, 400, "wanted brackets at most 32 deep"),
        (b'{"plan": ' + b"9" * 5000 + b"}", 400, "the body is not JSON"),
        (b'{"plan": {"schema": 1, "route": {"kind": "turn", "pitch": 1e999}}}', 422, "a finite number"),
        (
            b'{"plan": {"schema": 1, "route": {"kind": "turn", "pitch": ' + b"9" * 999 + b"}}}",
            422,
            "number",
        ),
        (b"[]", 422, "body: wanted a table"),
        (b"null", 422, "body"),
        (b'{"plan": {}, "plans": {}}', 422, "plan"),
        (b"{}", 422, "plan is missing"),
    ],
)
def test_hostile_bodies_get_a_sentence(studio: Served, body: bytes, status: int, text: str) -> None:
    for path in ("/api/verdict", "/api/limit/pitch", "/api/toml", "/api/export/png", "/api/jobs"):
        found = studio.client.post(path, content=body, headers=JSON)
        assert found.status_code == status, path
        assert text in error(found)


@pytest.mark.parametrize(
    ("toml", "text"),
    [
        ("schema = 1\n[rou", "plan is not TOML"),
        ("a = " + "[" * 5000, "plan is nested too deeply"),
        ("a." * 100 + "a = 1", "wanted brackets at most 32 deep"),
        ("schema = 1\n[route]\nkind = 'turn'\npitch = nan", "route.pitch: wanted a finite number"),
        ("schema = 1\n[route]\nkind = 'turn'\npitch = 1979-05-27", "route.pitch: wanted a number"),
        ("schema = 1\n[route]\nkind = 'turn'\n[dragon]\nbenches = 5000", "at most 3500 benches"),
    ],
)
def test_wrong_plan_files_get_a_sentence(studio: Served, toml: str, text: str) -> None:
    found = studio.client.post("/api/plan", json={"toml": toml}, params={"lang": "en"})
    assert found.status_code == 422
    assert text in error(found)


def test_other_requests_that_are_wrong_get_a_sentence(studio: Served) -> None:
    body = json.dumps({"plan": PLAN})
    client = studio.client
    assert client.post("/api/verdict", content=body).status_code == 415
    assert (
        client.post("/api/verdict", content=body, headers={"content-type": "text/plain"}).status_code
        == 415
    )
    assert error(client.get("/api/verdict")) == "this address does not take that method"
    assert client.get("/api/verdict").headers["allow"] == "POST"
    assert error(client.get("/api/verdict/")) == "there is nothing at this address"
    assert client.post("/api/verdict?lang=fr", content=body, headers=JSON).status_code == 422
    wrong = {**JSON, "x-client": "; drop"}
    assert "X-Client" in error(client.post("/api/verdict", content=body, headers=wrong))
    assert post(studio, "/api/jobs", question="why").status_code == 422
    assert post(studio, "/api/jobs", question="turn", options={"longest": -1}).status_code == 422


def test_only_our_own_names_and_pages_are_served(studio: Served) -> None:
    client, port = studio.client, studio.base.rsplit(":", 1)[1]
    for host in ("localhost", f"LOCALHOST:{port}", "127.0.0.1:1", "[::1]", f"[::1]:{port}"):
        assert client.get("/healthz", headers={"host": host}).status_code == 200, host
    for host in ("evil.example", "localhost.evil.example", "10.0.0.1", "", "a@localhost", "[", "x:y"):
        found = client.get("/healthz", headers={"host": host})
        assert found.status_code in {400, 421}, host
    assert client.get("/healthz", headers={"origin": studio.base}).status_code == 200
    for origin in ("null", "http://evil.example", "http://127.0.0.1:1", "file://", "http://["):
        found = client.get("/healthz", headers={"origin": origin})
        assert found.status_code == 403, origin
        assert error(found) == "a page from elsewhere may not ask here"


def test_every_answer_bears_the_headers(studio: Served) -> None:
    paths = ("/", "/nothing", "/openapi.json", "/api/presets", "/api/verdict")
    found = [studio.client.get(path) for path in paths]
    found += [
        post(studio, "/api/verdict"),
        studio.client.post("/"),
        studio.client.get("/", headers={"host": "x"}),
    ]
    for response in found:
        assert HEADERS.items() <= dict(response.headers).items(), response.url
    assert "unsafe" not in HEADERS["content-security-policy"]
