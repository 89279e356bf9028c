"""All engines give what kernels give as plain Python; the module is of these, and needs nothing."""

import importlib
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from benchdragon.engine import optimise, wasm
from benchdragon.hosts import built, native
from benchdragon.hosts.signature import signature
from benchdragon.hosts.wasm import Host, sections, told
from benchdragon.kernels import entries
from tests.browser.pages import Pages
from tests.engine.chromium import replayed_there
from tests.engine.recording import (
    LOADER,
    MODULE,
    again,
    all_replayed,
    compared,
    node,
    recorded,
    replayed,
)

ROOT = Path(__file__).parents[2]
# Of what stands there, or of 1. The library contracts products and sums, the module has another libm.
APART = 1e-12
AGAIN = "engine.wasm is of other sources or tools: run `make wasm`, and commit what it makes"
IMPORTS, EXPORTS = 2, 7

alike = pytest.mark.xdist_group("calls of every entry")  # which plain Python needs long for
needs_node = pytest.mark.skipif(node() is None, reason="no Node here to run engine.wasm in")


def pinned(lock: str) -> dict[str, str]:
    """The versions that a file of requirements pins."""
    text = (ROOT / lock).read_text(encoding="utf-8")
    return dict(re.findall(r"^([\w-]+)==([^\s;]+)", text, re.MULTILINE))


def test_the_module_is_of_these_sources_and_of_the_tools_that_are_pinned() -> None:
    stamp = told(MODULE.read_bytes())["stamp"]
    assert isinstance(stamp, dict)
    assert stamp["sources"] == built.source_hash(), AGAIN
    versions = pinned("requirements.lock") | pinned("requirements-wasm.lock")
    tools = {name: version for name, version in stamp["tools"].items() if name != "python"}
    assert tools == {name: versions[name] for name in wasm.TOOLS}, AGAIN


def all_entries() -> dict[str, Any]:
    """What entries take, by their names in the module."""
    for path in built.KERNELS.glob("*.py"):
        importlib.import_module(f"benchdragon.kernels.{path.stem}")
    found = wasm.table(map(signature, entries.ENTRIES.values()))
    assert len(found) == len(entries.ENTRIES)
    return found


def test_the_module_says_of_each_entry_what_it_takes() -> None:
    assert told(MODULE.read_bytes())["entries"] == all_entries(), AGAIN


def test_the_stamp_names_the_sources_and_the_tools(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wasm, "version", lambda name: f"1.2 of {name}")
    stamp = wasm.stamp()
    assert stamp["sources"] == built.source_hash()
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    assert stamp["tools"] == {"python": python, **{name: f"1.2 of {name}" for name in wasm.TOOLS}}


def test_the_module_imports_nothing() -> None:
    kinds = [kind for kind, _content in sections(MODULE.read_bytes())]
    assert EXPORTS in kinds
    assert IMPORTS not in kinds


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with calls of every entry."""
    return recorded(tmp_path_factory.mktemp("recording"))


def differences(folder: Path, memory: bytes) -> dict[str, Any]:
    """The entries that left another memory than plain Python did, and how far off it is."""
    calls = json.loads((folder / "calls.json").read_text(encoding="utf-8"))
    found = compared(calls, (folder / "after.bin").read_bytes(), memory)
    assert set(found) == all_replayed()
    return {name: each for name, each in found.items() if not each.worst <= APART}


@alike
def test_every_entry_of_the_library_gives_what_plain_python_gives(folder: Path) -> None:
    library = native.load_library()
    if library is None:
        pytest.skip("no library was built from these kernels")
    assert differences(folder, again(folder, lambda entry: native.bound(entry, library))) == {}


@alike
def test_every_entry_of_the_module_gives_what_plain_python_gives(folder: Path) -> None:
    assert differences(folder, again(folder, Host(MODULE.read_bytes()).bound)) == {}


@alike
@needs_node
def test_every_entry_gives_in_node_what_plain_python_gives(folder: Path) -> None:
    memory, _seconds = replayed(folder)
    assert differences(folder, memory) == {}


@alike
def test_every_entry_gives_in_chromium_what_plain_python_gives(
    folder: Path, pages: Pages, tmp_path: Path
) -> None:
    assert differences(folder, replayed_there(pages, folder, tmp_path)) == {}


# What a script of a page may do wrong, and what it is told.
WRONG = {
    "engine.call('bd_nearness_nearness', boxes, 0)": "TypeError: bd_nearness_nearness takes 4 ",
    "engine.call('bd_nearness_nearness', [1, 2], 0, 1, row)": (
        "TypeError: boxes must be a 2-dimensional array of float64"
    ),
    "engine.call('bd_nearness_nearness', engine.array('d', [12]), 0, 1, row)": "TypeError: boxes ",
    "engine.call('bd_nearness_nearness', engine.array('q', [2, 6]), 0, 1, row)": "TypeError: boxes ",
    "engine.call('bd_nearness_nearness', boxes, boxes, 1, row)": "TypeError: i must be a number",
    "engine.call('bd_nearness_nearness', boxes, 0.5, 1, row)": "RangeError: ",
    "engine.call('bd_spiral_bound_corner_none')": "TypeError: there is no bd_spiral_bound_corner_none",
    "engine.call('bd_grid_put_known', 1, boxes)": "TypeError: grid must be an object of its fields",
    "engine.call('bd_grid_put_known', { side: 1 }, boxes)": "TypeError: grid.side must be a 1-",
    "engine.array('d', [2 ** 29])": "RangeError: no memory for 536870912 numbers",
    "engine.array('d', [2 ** 28 - 1])": "RangeError: no memory for 268435455 numbers",
}
# As often as would fill memory twice, were the scratch of a call never given back.
CALLS = """
const many = 2000;
const sizes = engine.array("d", [4, many]);
const [x, y] = [0, 1].map(() => engine.array("d", [many + 1, 1]));
for (let i = 0; i <= many; i++) [x.view[i], y.view[i]] = [2 * i, 0];
sizes.view.fill(0.5);
engine.call("bd_box_least_distance", sizes, x, y);
const before = memory.buffer.byteLength;
for (let n = 0; n < 200; n++) {
  engine.free(engine.array("d", [many]));
  engine.call("bd_box_least_distance", sizes, x, y);
}
said.push(memory.buffer.byteLength - before);
"""


def run(script: str) -> list[Any]:
    """What a script says that has an engine, two boxes, a row and the module's memory."""
    program = node()
    assert program is not None
    whole = f"""
        import {{ readFileSync }} from "node:fs";
        import {{ Engine }} from {json.dumps(LOADER.as_uri())};
        const engine = await Engine.load(readFileSync({json.dumps(str(MODULE))}));
        const [said, boxes, {{ memory }}] = [[], engine.array("d", [2, 6]), engine.exports];
        const row = engine.array("d", [1]);
        {script}
        console.log(JSON.stringify(said));
    """
    done = subprocess.run(
        [program, "--input-type=module", "-e", whole], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    found: list[Any] = json.loads(done.stdout)
    return found


@needs_node
def test_what_an_entry_cannot_read_is_refused() -> None:
    tries = "".join(
        f"try {{ {code}; said.push(''); }} catch (e) {{ said.push(`${{e}}`); }}\n" for code in WRONG
    )
    assert [
        (said, text)
        for said, text in zip(run(tries), WRONG.values(), strict=True)
        if not said.startswith(text)
    ] == []


@needs_node
def test_scratch_and_arrays_are_given_back() -> None:
    assert run(CALLS) == [0]


def test_without_zig_nothing_is_begun(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(wasm.importlib.util, "find_spec", lambda _name: None)  # type: ignore[attr-defined]
    with pytest.raises(optimise.BuildError, match="ziglang is not here: `make wasm` installs it"):
        wasm.build_module(tmp_path / "made")
    assert not (tmp_path / "made").exists()


@pytest.mark.parametrize("size", [0, 127, 128, 20_000])
def test_a_custom_section_can_be_read_again(size: int) -> None:
    text = b"x" * size
    module = b"\0asm\1\0\0\0" + wasm.custom_section("name", text)
    assert list(sections(module)) == [(0, b"\4name" + text)]


READER = """
target datalayout = "e-m:e-i64:64-i128:128-f80:128-n8:16:32:64-S128"
target triple = "x86_64-unknown-linux-gnu"
define linkonce_odr ptr @NRT_MemInfo_data_fast(ptr %a) {{
  %b = getelementptr {{ {fields} }}, ptr %a, i32 0, i32 3
  %c = load ptr, ptr %b, align 8
  ret ptr %c
}}
define i32 @inner(ptr %found, ptr %trouble, i64 %block) {{
  %a = inttoptr i64 %block to ptr
  %b = call ptr @NRT_MemInfo_data_fast(ptr %a)
  store i64 1, ptr %b
  ret i32 0
}}
"""


def test_blocks_of_memory_are_read_where_the_runtime_of_a_target_keeps_them() -> None:
    optimise.prepare()
    machine = wasm.target_machine()
    text = READER.format(fields="i64, ptr, ptr, ptr, i64")
    shim = optimise.SHIM.format(symbol="shim", inner="inner")
    module = optimise.joined([text, shim], machine, {"shim"})
    assert str(machine.target_data).startswith("e-m:e-p:32:32")
    optimise.optimise(module, machine)
    # A count of 8 bytes, then two pointers of 4.
    assert "getelementptr i8, ptr %block, i32 16" in str(module)
    strange = READER.format(fields="ptr, i64, ptr, ptr, i64")
    with pytest.raises(optimise.BuildError, match=r"no longer those of engine/runtime\.c"):
        optimise.joined([strange, shim], machine, {"shim"})


def test_the_notice_names_what_is_linked_in() -> None:
    text = (built.ENGINE / "NOTICE.txt").read_text(encoding="utf-8")
    for name in ("Zig contributors", "Rich Felker", "Sun Microsystems", "Anaconda, Inc."):
        assert f"{name}" in text
