"""For all tests: one hypothesis profile, the same examples each time; languages; results."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from benchdragon.i18n import use_language
from benchdragon.paper import reproduce as reproducing
from benchdragon.paper import results
from benchdragon.paper.results import Results

settings.register_profile(
    "benchdragon",
    deadline=None,
    derandomize=True,
    max_examples=40,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("benchdragon")


@pytest.fixture(scope="session")
def found() -> Results:
    """What the paper comes to; fewer turns and fewer dances will do in a test."""
    told: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(results, "FRONT_SPEEDS", (1.3,))
        patch.setattr(results, "DRAWS", 12)
        computed = results.results(told.append)
    assert len(told) == results.STEPS
    return computed


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory, found: Results) -> Path:
    """A folder that `reproduce` has filled."""
    folder = tmp_path_factory.mktemp("out")
    told: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reproducing, "results", lambda _advance: found)
        written = reproducing.reproduce(folder, advance=told.append)
    assert written.files == reproducing.planned_files(folder)
    assert len(told) == reproducing.STEPS - results.STEPS
    return folder


@pytest.fixture(params=["en", "zh"])
def spoken(request: pytest.FixtureRequest) -> Iterator[str]:
    """A language, spoken for the length of a test."""
    use_language(request.param)
    yield request.param
    use_language("en")
