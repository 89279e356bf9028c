"""`make quick` runs a test of every room; `.ci/run` what takes minutes, and then all others."""

import os
import re
import subprocess
from pathlib import Path

import pytest

import benchdragon

ROOT = Path(__file__).parent.parent
QUICK, LONG, PLAIN = (
    (ROOT / "tests" / f"{name}.txt").read_text("utf-8").splitlines()
    for name in ("quick", "long", "plain")
)
ROOMS = {path.parent.name for path in Path(benchdragon.__file__).parent.glob("*/__init__.py")}

# Stands for make: it says what it was asked for, and fails where it is told to.
MAKE = """\
#!/bin/sh
echo "made $*"
for target in "$@"; do [ "$target" != "$FAILING" ] || exit 1; done
"""


def test_every_room_has_a_quick_test() -> None:
    assert {line.split("/")[1] for line in QUICK if line.count("/") > 1} >= ROOMS
    assert len(ROOMS) > 10


@pytest.mark.parametrize("line", [*QUICK, *LONG, *PLAIN])
def test_every_test_of_a_list_is_there(line: str) -> None:
    file, _colons, name = line.partition("::")
    function = re.escape(name.partition("[")[0])
    assert re.search(rf"^def {function}\(", (ROOT / file).read_text("utf-8"), re.MULTILINE)


BEFORE = ".venv/kernels-plain manual-test long-test page-test"
MADE = [f"made {BEFORE} JOBS=3 WORKERS=2 -k --output-sync", "made test"]


@pytest.mark.parametrize(
    ("failing", "code"),
    [
        ("nothing", 0),
        (".venv/kernels-plain", 1),
        ("long-test", 1),
        ("test", 1),
    ],
)
def test_integration_ends_with_the_tests_and_fails_where_others_do(
    tmp_path: Path, failing: str, code: int
) -> None:
    # With these before all others nothing is missed on this machine, and nothing installed.
    tools = ("make", "cc", "chromium-headless-shell", "firefox-esr", "fc-list", "npm", "node")
    for name in tools:
        path = tmp_path / name
        path.write_text(MAKE if name == "make" else "#!/bin/sh\necho here\n", "utf-8")
        path.chmod(0o755)
    done = subprocess.run(
        [ROOT / ".ci" / "run"], capture_output=True, text=True, check=False,
        env={"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}", "FAILING": failing},
    )  # fmt: skip
    assert (done.stdout.splitlines(), done.returncode) == (MADE, code)
