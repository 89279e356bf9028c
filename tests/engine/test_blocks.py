"""Groups of arrays as pointers give what NamedTuples give, and none is built that may dangle."""

import ctypes
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

from benchdragon.hosts import native
from tests.engine import groups

BUILT = """
import sys
from pathlib import Path
from benchdragon.engine import build, optimise, pieces, shims
from benchdragon.hosts import built
from benchdragon.kernels import entries
pieces.keep_pieces()
entries.compiler = shims.compiled
from tests.engine import groups
optimise.prepare()
machine = optimise.target_machine(built.processor())
try:
    build.link(build.machine_code([getattr(groups, sys.argv[1])], machine), Path(sys.argv[2]))
except optimise.BuildError as error:
    sys.exit(str(error))
print(list(map(len, (groups.add_up.overloads, groups.row_sum.overloads))))
"""


def build(name: str, path: Path) -> subprocess.CompletedProcess[str]:
    """Build a kernel of groups.py, which says how many pieces of code two others became."""
    return subprocess.run(
        [sys.executable, "-c", BUILT, name, str(path)], capture_output=True, text=True, check=False
    )


def test_groups_are_read_where_they_lie(tmp_path: Path) -> None:
    path = tmp_path / "groups.so"
    done = build("made_and_passed", path)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == [1, 1]  # though calls name 0 and 1
    call = native.bound(groups.made_and_passed, ctypes.CDLL(str(path)))
    random = np.random.default_rng(37)
    rows = groups.Rows(random.random((9, 4)), np.array([3, 0, 4, 1, 2]))
    given, out, wanted = groups.Weighed(random.random(5), rows), np.zeros((5, 5)), np.zeros((5, 5))
    assert abs(call(given, out) - groups.made_and_passed(given, wanted)) <= 1e-12
    assert np.count_nonzero(wanted) >= 15
    np.testing.assert_allclose(out, wanted, rtol=1e-14)


def test_no_kernel_returns_a_group(tmp_path: Path) -> None:
    done = build("returned", tmp_path / "groups.so")
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert (
        "bd_groups_returned, or what it calls: a kernel returns a Block[tests.engine.groups.Rows]"
        in done.stderr
    )


def test_no_kernel_makes_a_group_where_arrays_are_counted(tmp_path: Path) -> None:
    done = build("counted", tmp_path / "groups.so")
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert "a Block[tests.engine.groups.Rows] is made where arrays are counted" in done.stderr
