"""The libraries that the planner carries: their versions, their notices, what they do."""

import json
import re
import subprocess
import tomllib
from pathlib import Path
from typing import Any

import pytest

from benchdragon.inlining import WEB
from tests.engine.recording import node

ROOT = Path(__file__).parents[2]
MODULE = WEB / "carried.js"
LIBRARIES = {
    MODULE: "smol-toml",
    WEB / "carried_code.js": "uqr",
    WEB / "carried_shapes.js": "clipper2-ts",
    WEB / "carried_zip.js": "fflate",
}
PLANS = sorted([*ROOT.glob("examples/*.toml"), *ROOT.glob("src/benchdragon/plans/builtin/*.toml")])
AGAIN = "{name} is of other versions: run `make carried`, and commit what it makes"

needs_node = pytest.mark.skipif(node() is None, reason="no Node here to run carried.js in")


def run(script: str, data: object) -> Any:
    """What a script makes of data, with what the module exports."""
    program = node()
    assert program is not None
    whole = f"""
        import {{ readFileSync }} from "node:fs";
        import {{ parse, stringify, TomlError }} from {json.dumps(MODULE.as_uri())};
        const data = JSON.parse(readFileSync(0, "utf-8"));
        const found = {script};
        console.log(JSON.stringify(found));
    """
    done = subprocess.run(
        [program, "--input-type=module", "-e", whole],
        input=json.dumps(data), capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize(("module", "library"), LIBRARIES.items(), ids=LIBRARIES.values())
def test_the_modules_are_of_the_locked_versions(module: Path, library: str) -> None:
    told = dict(re.findall(r"([\w-]+) (\d+\.\d+\.\d+)", module.read_text("utf-8").split("\n")[0]))
    lock = json.loads((ROOT / "package-lock.json").read_text("utf-8"))["packages"]
    assert set(told) == {library, "esbuild"}
    wanted = {name: lock[f"node_modules/{name}"]["version"] for name in told}
    assert told == wanted, AGAIN.format(name=module.name)


def test_the_lock_names_no_address_of_a_registry() -> None:
    lock = (ROOT / "package-lock.json").read_text("utf-8")
    assert '"resolved"' not in lock


def test_the_notice_names_what_is_carried_and_goes_into_the_wheel() -> None:
    text = (WEB / "carried.txt").read_text("utf-8")
    owners = (
        ("smol-toml", "Squirrel Chat et al."),
        ("uqr", "Project Nayuki"),
        ("clipper2-ts", "Angus Johnson"),
        ("fflate", "Barrett"),
    )
    for library, owner in owners:
        assert f"* {library}: " in text
        assert f"\n{library}\n" in text
        assert owner in text.rsplit(f"\n{library}\n", 1)[1]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert "src/benchdragon/web/carried.txt" in project["license-files"]


@pytest.mark.parametrize("module", LIBRARIES, ids=LIBRARIES.values())
def test_the_modules_make_no_code_of_texts(module: Path) -> None:
    """As the policy of a page forbids it."""
    assert not re.search(r"\beval\(|\bFunction\(|\bimport\(", module.read_text("utf-8"))


@needs_node
def test_plan_files_are_read_as_python_reads_them_and_written_so_that_it_does() -> None:
    texts = [path.read_text("utf-8") for path in PLANS]
    assert len(texts) > 10
    found = run("data.map((text) => [parse(text), stringify(parse(text))])", texts)
    for text, (read, written) in zip(texts, found, strict=True):
        assert read == tomllib.loads(text)
        assert tomllib.loads(written) == tomllib.loads(text)


@needs_node
def test_a_fault_in_a_plan_file_is_told_with_its_place() -> None:
    script = """(() => {
        try { parse(data); } catch (e) { return [e instanceof TomlError, e.line, e.column]; }
    })()"""
    assert run(script, "schema = 1\n[route]\nkind = \n") == [True, 3, 8]
