"""What is set up: by `make demo` what the main job needs, by `make test` what developers need too."""

import re
import tomllib
from pathlib import Path

import pytest
from trove_classifiers import classifiers

ROOT = Path(__file__).parent.parent
LOCKS = [f"requirements{part}.lock" for part in ("", "-demo", "-engine", "-mutation", "-wasm")]
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


def test_the_library_is_built_with_what_its_extra_names_alone() -> None:
    engine, whole = locked("requirements-engine.lock"), locked("requirements.lock")
    assert {package: hashes for package, hashes in engine.items() if whole.get(package) != hashes} == {}
    wanted = names(PROJECT["project"]["optional-dependencies"]["build"])
    assert {name for name, _version in engine} == wanted


def reached_from(target: str) -> set[str]:
    """What make makes or looks at before a target, and that; no sources, which a pattern names."""
    make = (ROOT / "Makefile").read_text("utf-8")
    rules = dict(re.findall(r"^([\w./-]+): (.*)$", make, re.MULTILINE))
    reached, open_ = set(), [target]
    while open_:
        target = open_.pop()
        reached.add(target)
        asked = re.sub(r"\$\(wildcard .*\)", "", rules.get(target, "")).split()
        open_ += [name for name in asked if name not in reached]
    return reached


DEMO = {".venv/demo", "requirements-demo.lock", "pyproject.toml"}


def test_demo_and_library_are_made_without_what_developers_need() -> None:
    assert reached_from("demo") == {"demo", *DEMO}
    made = {"engine", ".venv/engine", ".venv/built", "requirements-engine.lock", *DEMO}
    assert reached_from("engine") == {*made, "src/benchdragon/hosts/signature.py"}


def test_classifiers_are_known_and_begin_with_the_oldest_python() -> None:
    said = PROJECT["project"]["classifiers"]
    assert set(said) <= classifiers
    versions = [one.rpartition(" :: ")[2] for one in said if one.startswith("Programming Language")]
    assert versions[:2] == ["3", PROJECT["project"]["requires-python"].removeprefix(">=")]
