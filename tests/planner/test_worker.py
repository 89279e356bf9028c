"""compute/worker.js: it warms up beside questions, and takes a new engine for one that grew large."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from benchdragon.inlining import WEB
from benchdragon.planner.page import ENGINE
from benchdragon.plans.schema import read_plan
from tests.engine.recording import node
from tests.planner.test_solve import small

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the Worker in")


@pytest.fixture(scope="module")
def life(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What a Worker says: see serve_worker.mjs."""
    program = node()
    assert program is not None
    file = tmp_path_factory.mktemp("worker") / "plans.json"
    plan = read_plan("spiral-in", ["dragon.benches=9", "route.start_turn=4"])
    file.write_text(json.dumps({"small": plan.data(), "large": small(23)}), "utf-8")
    script = Path(__file__).with_name("serve_worker.mjs")
    done = subprocess.run(
        [program, script, WEB, ENGINE, file], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def test_a_worker_of_whom_nothing_is_asked_has_kernels_compiled(life: dict[str, Any]) -> None:
    assert life["warmed"] > 30  # calls; to begin with there is one of malloc


def test_a_question_that_comes_while_the_worker_warms_up_is_answered(life: dict[str, Any]) -> None:
    assert life["asked"]["id"] == 1
    assert life["asked"]["answer"]["plan_sha256"] == life["again"]["answer"]["plan_sha256"]
    assert life["heard"] == [None, 1, 2, 3, 4, 5, 6, 7, 8, 10]  # ready, and nothing of the warming


def test_an_engine_that_grew_large_gives_way_to_a_new_one(life: dict[str, Any]) -> None:
    assert life["after"] == 2
    assert life["large"]["answer"]["sentence"] == life["asked"]["answer"]["sentence"]


def test_a_question_without_memory_is_refused_in_a_sentence_and_the_next_is_answered(
    life: dict[str, Any],
) -> None:
    assert life["without"]["refusal"].startswith("This browser has not enough memory for that")
    assert life["again"]["answer"]["sentence"] == life["asked"]["answer"]["sentence"]


def test_a_question_that_takes_too_much_is_refused_in_a_sentence_and_the_next_is_answered(
    life: dict[str, Any],
) -> None:
    assert life["over"]["refusal"].startswith("this takes more memory than a question may: at least ")
    assert life["last"]["answer"]["sentence"] == life["asked"]["answer"]["sentence"]


def test_a_dance_that_nobody_waits_for_is_given_up_between_slices(life: dict[str, Any]) -> None:
    assert life["dance"] > 50  # calls of kernels
    assert 0.2 * life["dance"] <= life["given"] < 0.4 * life["dance"]
