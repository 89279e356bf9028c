"""How often a check goes back up to Python between kernels."""

import json
import os
import subprocess
import sys
from itertools import groupby
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CALLS = """
import json, sys
from benchdragon.analysis.check import check
from benchdragon.plans.schema import read_plan
from tests.engine.questions import wrap

def counted(name, served):
    def call(*values):
        calls.append(name.removeprefix("benchdragon.kernels."))
        return served(*values)
    return call

calls, plan = [], read_plan(*json.loads(sys.argv[1]))
wrap(counted)
walk, built = plan.build(), len(calls)
check(plan)
print(json.dumps(calls[2 * built:]))
"""


def visits(*plan: object) -> list[str]:
    """The modules whose entries a check calls in turn, once its route is laid.

    Calls of one module in a row count once: so does a question, from its opening to its end, where
    Python only counts work and tells progress between steps.
    """
    done = subprocess.run(
        [sys.executable, "-c", CALLS, json.dumps(plan)],
        capture_output=True, text=True, check=True, cwd=ROOT,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([*sys.path, str(ROOT)])},
    )  # fmt: skip
    calls = [name for name in json.loads(done.stdout) if not name.startswith("question.")]
    return [module for module, _calls in groupby(name.rpartition(".")[0] for name in calls)]


@pytest.mark.parametrize(("plan", "most"), [("spiral-in", 5), ("turn", 10)])
def test_a_check_goes_back_up_to_python_a_few_times(plan: str, most: int) -> None:
    assert len(visits(plan)) <= most
