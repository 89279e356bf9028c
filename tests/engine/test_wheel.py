"""What is installed: one wheel for all machines, made without a compiler from the source archive."""

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
