"""For all tests: one hypothesis profile, the same examples each time; languages; results."""

import gc
import shutil
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, settings

from benchdragon.i18n import use_language

if TYPE_CHECKING:
    from benchdragon.paper.results import Results

HERE = Path(__file__).parent
# Where pages are tested, or asked what Python is asked.
PAGES = (HERE / "browser", HERE / "planner")
# Tests that take five seconds or more by themselves.
LONG = {*(HERE / "long.txt").read_text("utf-8").splitlines()}

settings.register_profile(
    "benchdragon",
    deadline=None,
    derandomize=True,
    max_examples=40,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("benchdragon")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Modules and tests stay to the end: garbage is sought among them no more."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests of pages, and long ones. These begin: who comes last runs alone.

    Tests that share what their module makes once are kept in one process: each would make it anew.
    """
    for item in items:
        file = item.path.relative_to(HERE.parent).as_posix()
        if item.path.parent in PAGES:
            item.add_marker("pages")
        elif LONG & {f"{file}::{item.name}", f"{file}::{item.name.split('[')[0]}"}:
            item.add_marker("long")
        if _shares(item) and not item.get_closest_marker("xdist_group"):
            item.add_marker(pytest.mark.xdist_group(file))
    items.sort(key=lambda item: item.get_closest_marker("long") is None)


def _shares(item: pytest.Item) -> bool:
    """Whether a test asks for what its module makes once; long ones are spread all the same."""
    if item.get_closest_marker("long") or not isinstance(item, pytest.Function):
        return False
    return any(one[-1].scope == "module" for one in item._fixtureinfo.name2fixturedefs.values())


@pytest.fixture(scope="session")
def found() -> "Results":
    """What the paper comes to: in a test fewer turns will do, fewer dances, and no proofs."""
    from benchdragon.paper import results  # takes seconds, which most tests can do without

    told: list[tuple[float, str]] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(results, "FRONT_SPEEDS", (1.3,))
        patch.setattr(results, "AGAIN", 1)
        patch.setattr(results, "find_spec", lambda _name: None)  # tests/paper/test_proofs.py proves
        computed = results.results(lambda share, text: told.append((share, text)))
    shares = [share for share, _text in told]
    assert shares == [pytest.approx(n / results.STEPS) for n in range(results.STEPS)]
    return computed


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory, found: "Results") -> Path:
    """A folder that `reproduce` has filled."""
    from benchdragon.paper import reproduce as reproducing

    folder = tmp_path_factory.mktemp("out")
    told: list[tuple[float, str]] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reproducing, "results", lambda _progress: found)
        written = reproducing.reproduce(folder, progress=lambda share, text: told.append((share, text)))
    assert written.files == reproducing.planned_files(folder)
    shares = [share for share, _text in told]
    assert shares == sorted(shares)
    assert reproducing.COMPUTED == shares[0] < shares[-1] < 1.0
    assert all(text for _share, text in told)
    return folder


@pytest.fixture
def ready(folder: Path, found: "Results", monkeypatch: pytest.MonkeyPatch) -> None:
    """`reproduce` finds answers and pictures ready, and writes its report and answers alone."""
    from benchdragon.paper import reproduce as reproducing

    def copy(to: Path, *_rest: object) -> None:
        to.mkdir(parents=True, exist_ok=True)
        for name in reproducing.PICTURES:
            for kind in ("svg", "pdf"):
                shutil.copy(folder / f"{name}.{kind}", to)

    monkeypatch.setattr(reproducing, "results", lambda _progress: found)
    monkeypatch.setattr(reproducing, "_write_tables", lambda *_arguments: None)
    monkeypatch.setattr(reproducing, "all_figures", lambda _found: {})
    monkeypatch.setattr(reproducing, "_write_pictures", copy)


@pytest.fixture(params=["en", "zh"])
def spoken(request: pytest.FixtureRequest) -> Iterator[str]:
    """A language, spoken for the length of a test."""
    use_language(request.param)
    yield request.param
    use_language("en")
