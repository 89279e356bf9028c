"""engine.wasm in Chromium, on a page that may run nothing but its own script and WebAssembly."""

import base64
import hashlib
import json
from pathlib import Path

from benchdragon.inlining import EXPORT, inlined
from tests.browser.pages import Pages
from tests.engine.recording import HERE, MODULE, all_replayed, compared, recorded

# Of what stands there, or of 1, as in Node.
APART = 1e-12
# Files are chosen and downloaded: as text of the debugger's protocol the memory took half a minute.
CALL = """
globalThis.replayed = async () => {
  const [module, calls, before] = document.querySelector("input").files;
  const memory = await before.arrayBuffer();
  replay(await Engine.load(await module.arrayBuffer()), JSON.parse(await calls.text()), memory);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([memory]));
  link.download = "replayed.bin";
  link.click();
};
"""
PAGE = """<!doctype html><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src {policy}">
<input type="file" multiple>
<script type="module">{script}</script>
"""


def page(folder: Path) -> str:
    """The address of a page that can replay a recording."""
    replay = EXPORT.sub("", (HERE / "replay.js").read_text(encoding="utf-8"))
    script = inlined("engine.js") + replay + CALL
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    file = folder / "page.html"
    policy = f"'sha256-{digest}' 'wasm-unsafe-eval'"
    file.write_text(PAGE.format(policy=policy, script=script), encoding="utf-8")
    return file.as_uri()


def test_every_entry_gives_in_chromium_what_plain_python_gives(pages: Pages, tmp_path: Path) -> None:
    folder = recorded(tmp_path)
    calls = json.loads((folder / "calls.json").read_text(encoding="utf-8"))
    opened = pages.open(page(tmp_path))
    opened.set_input_files("input", [MODULE, folder / "calls.json", folder / "before.bin"])
    with opened.expect_download() as saved:
        opened.evaluate("replayed()")
    memory = saved.value.path().read_bytes()
    found = compared(calls, (folder / "after.bin").read_bytes(), memory)
    assert set(found) == all_replayed()
    assert {name: each for name, each in found.items() if not each.worst <= APART} == {}
