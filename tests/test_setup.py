"""What is set up: by `make demo` what the main job needs, by `make test` what developers need too."""

import re
import tomllib
from pathlib import Path

import pytest
from trove_classifiers import classifiers

ROOT = Path(__file__).parent.parent
LOCKS = [f"requirements{part}.lock" for part in ("", "-demo", "-mutation", "-wasm")]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
# For developers, for the manual, or to compile with: minutes and hundreds of megabytes.
DEVELOPERS = {
    "dask",
    "llvmlite",
    "mypy",
    "numba",
    "playwright",
    "pyarrow",
    "pytest",
    "sphinx",
    "ziglang",
}


def locked(name: str) -> dict[tuple[str, str], set[str]]:
    """The hashes of each version of a package in a list."""
    entry = re.compile(r"^([\w.-]+)==(\S+).*((?:\n    --hash=.*)+)", re.MULTILINE)
    text = (ROOT / name).read_text("utf-8")
    return {(m[1], m[2]): set(re.findall(r"sha256:\w+", m[3])) for m in entry.finditer(text)}


def names(requirements: list[str]) -> set[str]:
    """Normalised names of requirements."""
    return {re.split(r"[<>=!~;\[ ]", one)[0].lower().replace("_", "-") for one in requirements}


@pytest.mark.parametrize("name", LOCKS)
def test_a_list_names_hashes_and_no_address(name: str) -> None:
    assert locked(name)
    assert all(locked(name).values())
    assert "//" not in (ROOT / name).read_text("utf-8")


def test_the_main_job_takes_what_developers_have_and_no_more_than_it_needs() -> None:
    demo, whole = locked("requirements-demo.lock"), locked("requirements.lock")
    assert {package: hashes for package, hashes in demo.items() if whole.get(package) != hashes} == {}
    found = {name for name, _version in demo}
    wanted = [
        *PROJECT["project"]["dependencies"],
        *PROJECT["project"]["optional-dependencies"]["prove"],
    ]
    assert names(wanted) <= found
    assert names(PROJECT["dependency-groups"]["build"]) <= found
    assert found & DEVELOPERS == set()


def test_the_demo_is_set_up_without_what_developers_need() -> None:
    make = (ROOT / "Makefile").read_text("utf-8")
    rules = dict(re.findall(r"^([\w./-]+): (.*)$", make, re.MULTILINE))
    reached, open_ = set(), ["demo"]
    while open_:
        target = open_.pop()
        reached.add(target)
        open_ += [name for name in rules.get(target, "").split() if name not in reached]
    assert reached == {"demo", ".venv/demo", "requirements-demo.lock", "pyproject.toml"}


def test_classifiers_are_known_and_begin_with_the_oldest_python() -> None:
    said = PROJECT["project"]["classifiers"]
    assert set(said) <= classifiers
    versions = [one.rpartition(" :: ")[2] for one in said if one.startswith("Programming Language")]
    assert versions[:2] == ["3", PROJECT["project"]["requires-python"].removeprefix(">=")]
