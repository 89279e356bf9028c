"""Requests to a studio that is served, and what its answers say."""

from typing import Any

import httpx

from tests.studio.servers import PLAN, Served

JSON = {"content-type": "application/json"}


def post(studio: Served, path: str, plan: Any = PLAN, **more: Any) -> httpx.Response:
    language = more.pop("lang", "en")
    headers = more.pop("headers", {})
    body = {"plan": plan, **more}
    return studio.client.post(path, params={"lang": language}, json=body, headers=headers)


def error(response: httpx.Response) -> str:
    assert set(response.json()) == {"error"}
    return str(response.json()["error"])


def with_part(**tables: Any) -> dict[str, Any]:
    return {**PLAN, **tables}
