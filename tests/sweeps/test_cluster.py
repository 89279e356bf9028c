"""A sweep on a Dask cluster: the same table as in one process, bit by bit, whoever dies."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

import benchdragon
from benchdragon.errors import MachineError, MissingExtraError
from benchdragon.parallel import dask, place
from benchdragon.sweeps.sweep import Sweep
from tests.sweeps import work

pytestmark = pytest.mark.xdist_group("cluster")
# Only what hangs takes so long, s.
HANGS = 120.0
SCHEDULER = ["distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
WORKER = ["distributed.cli.dask_worker", "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny"]
WORKER += ["--no-dashboard", "--memory-limit", "0"]


@pytest.fixture(scope="module")
def whole() -> Sweep:
    """All of it in one go."""
    return work.swept()


@contextmanager
def started(folder: Path, *arguments: str) -> "Iterator[subprocess.Popen[bytes]]":
    """A process of the cluster."""
    paths = [str(Path(benchdragon.__file__).parents[1]), str(Path(__file__).parents[2])]
    process = subprocess.Popen(
        [sys.executable, "-m", *arguments], cwd=folder, stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL, env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
    )  # fmt: skip
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@pytest.fixture
def cluster(tmp_path: Path) -> "Iterator[tuple[str, list[subprocess.Popen[bytes]]]]":
    """The address of a scheduler, and the two workers that it has."""
    file = tmp_path / "scheduler.json"
    with started(tmp_path, *SCHEDULER, "--scheduler-file", str(file)) as scheduler:
        end = time.monotonic() + HANGS
        while not file.exists() or not file.read_text().endswith("}"):
            assert scheduler.poll() is None
            assert time.monotonic() < end, "it hangs"
            time.sleep(0.01)
        address = json.loads(file.read_text())["address"]
        with started(tmp_path, *WORKER, address) as one, started(tmp_path, *WORKER, address) as other:
            yield address, [one, other]


def test_a_cluster_of_this_machine_gives_the_same(whole: Sweep, tmp_path: Path) -> None:
    assert work.swept(tmp_path, place("dask", 2)).numbers().equals(whole.numbers())


def test_a_cluster_of_others_gives_the_same_though_a_worker_is_killed(
    whole: Sweep, cluster: "tuple[str, list[subprocess.Popen[bytes]]]"
) -> None:
    address, workers = cluster
    where = place(address)
    assert work.swept(executor=where).numbers().equals(whole.numbers())
    told: list[float] = []

    def kill(share: float, _text: str) -> None:
        told.append(share)
        if share < 1.0:
            workers[0].kill()

    assert work.swept(executor=where, progress=kill).numbers().equals(whole.numbers())
    assert told[0] < 1.0
    workers[0].wait()
    assert workers[1].poll() is None


def test_where_no_scheduler_answers_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("benchdragon.parallel.PATIENCE", 0.5)
    for address in ("tcp://127.0.0.1:9", "processe"):
        with pytest.raises(MachineError, match=rf"^no scheduler answers at {address}: "):
            work.swept(executor=dask(address))


def test_without_the_library_its_extra_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingExtraError, match=r"benchdragon\[cluster\]"):
        dask()
