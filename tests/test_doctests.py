"""Each public name has an example, which runs and gives what it says."""

import doctest
import inspect
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import benchdragon as bd

# The kernels', whose words are part of the engine that is built of them.
WITHOUT = {"Status"}
FLAGS = doctest.ELLIPSIS


@pytest.fixture(scope="module")
def threads() -> Iterator[Executor]:
    with ThreadPoolExecutor(2) as pool:
        yield pool


def examples(name: str) -> list[doctest.Example]:
    """Those of a function, or of a class and what makes it."""
    of: Any = getattr(bd, name)
    texts = [of.__doc__ or "", (of.__init__.__doc__ or "") if inspect.isclass(of) else ""]
    return [one for text in texts for one in doctest.DocTestParser().get_examples(text)]


@pytest.mark.parametrize("name", sorted({*bd.__all__} - WITHOUT))
def test_a_public_name_has_an_example_that_runs(name: str, tmp_path: Path, threads: Executor) -> None:
    if name.startswith("prove_"):
        pytest.importorskip("flint")
    if name.lower().startswith("compar"):
        coil = bd.read_plan("spiral-in")
        contact = bd.first_contact(coil)
        assert contact is not None
        found = coil.motion(contact.value)
        bd.write_result2(tmp_path / "result2.xlsx", found.x, found.y, found.speed)
    given = {"bd": bd, "np": np, "folder": tmp_path, "threads": threads}
    told = examples(name)
    assert told
    test = doctest.DocTest(told, given, name, None, 0, None)
    said: list[str] = []
    done = doctest.DocTestRunner(optionflags=FLAGS).run(test, out=said.append)
    assert not done.failed, "".join(said)
