"""The front end's types: what the models of the wire are in TypeScript, and that its checker agrees."""

import subprocess
import sys
from enum import StrEnum
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, NamedTuple

import pytest
from pydantic import BaseModel, ConfigDict, Field, RootModel
from tools.make_types import types

ROOT = Path(__file__).parents[2]
TSC = ROOT / "node_modules" / ".bin" / "tsc"


class State(StrEnum):
    WAITING = "waiting"
    DONE = "done"


class Place(NamedTuple):
    """Metres."""

    x: float
    y: float


class Curve(BaseModel):
    """A curve of a route.

    Its kind says which.
    """

    kind: Literal["line", "arc"]
    size: tuple[float, Literal["m"]]
    ends: tuple[Place, ...] = Field(description="Where it starts */ and ends.")


class Names(RootModel[dict[str, str]]):
    """Names by language."""


class Sent(BaseModel):
    model_config = ConfigDict(json_schema_serialization_defaults_required=True)

    curves: list[Curve]
    state: State = State.WAITING
    share: float | None = None
    names: Names
    rest: Any
    safe: bool = False
    schema_: Literal[1] = Field(1, alias="schema-version")


class Asked(BaseModel):
    workers: int = 1
    counts: dict[str, list[int | None]]


class _Hidden(BaseModel):
    x: int


DECLARED = """\
// Made from tests.player.test_messages by tools/make_types.py; to make it again: make generate

export interface Asked {
  workers?: number;
  counts: Record<string, Array<number | null>>;
}

/**
 * A curve of a route.
 *
 * Its kind says which.
 */
export interface Curve {
  kind: "line" | "arc";
  size: [number, "m"];
  /** Where it starts *\\/ and ends. */
  ends: Array<Place>;
}

/** Names by language. */
export type Names = Record<string, string>;

export type Place = [number, number];

export interface Sent {
  curves: Array<Curve>;
  state: State;
  share: number | null;
  names: Names;
  rest: unknown;
  safe: boolean;
  "schema-version": 1;
}

export type State = "waiting" | "done";
"""

# Each line below an `@ts-expect-error` is wrong, and the others are right: the checker sees to both.
PAGE = """\
/** @import { Sent } from "./messages.js" */

/** @param {Sent} sent */
export function told(sent) {
  const [x] = sent.curves[0].ends[0];
  // @ts-expect-error
  const name = sent.state === "gone";
  // @ts-expect-error
  const share = sent.share + x;
  // @ts-expect-error
  const missing = sent.nosuchfield;
  return [name, share, missing, sent["schema-version"] + x, sent.names.en.length];
}

/** @type {import("./messages.js").Asked} */
export const asked = { counts: { turns: [1, null] } };

// @ts-expect-error
export function untyped(value) {
  return value;
}
"""


def module_of(model: type[BaseModel]) -> ModuleType:
    """A module that defines one model."""
    module = ModuleType(model.__module__)
    module.__dict__[model.__name__] = model
    return module


def test_models_become_interfaces() -> None:
    assert types(sys.modules[__name__]) == DECLARED


def test_what_has_no_plain_type_is_an_error() -> None:
    class Open(BaseModel):
        model_config = ConfigDict(extra="allow")

    class Odd(BaseModel):
        x: int = Field(json_schema_extra={"not": {"const": 3}, "type": "object"})

    for model in (Open, Odd):
        with pytest.raises(ValueError, match="no type for"):
            types(module_of(model))


@pytest.mark.skipif(not TSC.exists(), reason="no TypeScript here: npm ci")
def test_the_checker_takes_the_interfaces_and_finds_what_is_wrong(tmp_path: Path) -> None:
    web = tmp_path / "src" / "benchdragon" / "web"
    web.mkdir(parents=True)
    (web / "messages.d.ts").write_text(DECLARED, "utf-8")
    (web / "page.js").write_text(PAGE, "utf-8")
    settings = (ROOT / "tsconfig.json").read_text("utf-8")
    (tmp_path / "tsconfig.json").write_text(settings, "utf-8")
    done = subprocess.run([TSC, "-p", tmp_path], capture_output=True, check=False, text=True)
    assert (done.returncode, done.stdout) == (0, "")
