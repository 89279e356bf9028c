"""What is installed: one wheel for all machines, made without a compiler from the source archive."""

import json
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest
from hatchling.builders.sdist import SdistBuilder
from hatchling.builders.wheel import WheelBuilder

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src" / "benchdragon"
# What builders leave for one machine, and what the package never holds.
MADE = frozenset([".so", ".pyc"])
STRAYS = ("kernels-0-linux-x86-64.so", "kernels.pyd", "kernels.dll", "kernels.dylib", "runtime.o")


# What a plan that is checked has no need of, though it is installed or may be: it takes long to import.
UNNEEDED = ("llvmlite", "matplotlib", "numba", "rich", "scipy", "shapely", "ziglang")
# A check by what lies in the first folder, in an interpreter without what builds the kernels.
CHECK = """
import sys
sys.path.insert(0, sys.argv.pop(1))
sys.modules.update(dict.fromkeys(["numba", "llvmlite", "ziglang"]))
from benchdragon.__main__ import main
sys.argv = ["benchdragon", "check", "spiral-in", "--json"]
try:
    main()
finally:
    print(sys.modules["benchdragon"].__file__, *filter(sys.modules.get, sys.modules), file=sys.stderr)
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel that is built from the source archive, into which files of one machine have strayed."""
    folder = tmp_path_factory.mktemp("wheel")
    (archive,) = SdistBuilder(str(ROOT)).build(directory=str(folder))
    with tarfile.open(archive) as opened:
        opened.extractall(folder, filter="data")
    source = folder / Path(archive).name.removesuffix(".tar.gz")
    for stray in STRAYS:
        (source / "src" / "benchdragon" / "engine" / stray).write_bytes(b"for one machine")
    (made,) = WheelBuilder(str(source)).build(directory=str(folder))
    return Path(made)


def test_the_wheel_is_for_all_machines_and_holds_the_package_alone(wheel: Path) -> None:
    assert wheel.name.endswith("-py3-none-any.whl")
    found = (path for path in PACKAGE.rglob("*") if path.is_file() and path.suffix not in MADE)
    wanted = {path.relative_to(ROOT / "src").as_posix() for path in found}
    with zipfile.ZipFile(wheel) as opened:
        held = {name for name in opened.namelist() if ".dist-info/" not in name}
        (about,) = (name for name in opened.namelist() if name.endswith(".dist-info/WHEEL"))
        lines = opened.read(about).decode().splitlines()
    assert held == wanted
    assert "benchdragon/engine/engine.wasm" in held
    assert {"Root-Is-Purelib: true", "Tag: py3-none-any"} <= set(lines)


def test_the_wheel_alone_checks_a_dance_without_numba_and_without_a_compiler(
    wheel: Path, tmp_path: Path
) -> None:
    with zipfile.ZipFile(wheel) as opened:
        opened.extractall(tmp_path / "installed")
    done = subprocess.run(
        [sys.executable, "-I", "-c", CHECK, str(tmp_path / "installed")],
        capture_output=True, text=True, check=False, cwd=tmp_path,
        env=dict.fromkeys(["HOME", "PATH", "XDG_CACHE_HOME"], str(tmp_path)),
    )  # fmt: skip
    assert done.returncode == 1, done.stderr
    contact = json.loads(done.stdout)["first_contact"]
    assert contact["value"] == pytest.approx(412.473837682, abs=1e-9)
    where, *loaded = done.stderr.split()
    assert Path(where).is_relative_to(tmp_path)
    assert "wasmtime" in loaded
    assert set(UNNEEDED).isdisjoint(loaded)
