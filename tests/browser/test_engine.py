"""engine.wasm in Chromium, on a page that may run nothing but its own script and WebAssembly."""

import base64
import hashlib
import json
from pathlib import Path

from benchdragon.kernels import jit
from benchdragon.kernels.signature import signature
from benchdragon.player.page import EXPORT, inlined
from tests.browser.pages import Pages
from tests.engine.recording import HERE, MODULE, compared, recorded

# Of what stands there, or of 1, as in Node.
APART = 1e-12
CALL = """
const decoded = (text) => Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
globalThis.replayed = async (module, calls, before) => {
  const memory = decoded(before).buffer;
  replay(await Engine.load(decoded(module)), calls, memory);
  let text = "";
  for (let at = 0; at < memory.byteLength; at += 32768)
    text += String.fromCharCode(...new Uint8Array(memory, at, Math.min(32768, memory.byteLength - at)));
  return btoa(text);
};
"""
PAGE = """<!doctype html><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src {policy}">
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


def test_every_entry_gives_in_chromium_what_the_engine_here_gives(pages: Pages, tmp_path: Path) -> None:
    folder = recorded(tmp_path)
    calls = json.loads((folder / "calls.json").read_text(encoding="utf-8"))
    module, before = (
        base64.b64encode(file.read_bytes()).decode() for file in (MODULE, folder / "before.bin")
    )
    opened = pages.open(page(tmp_path))
    memory = opened.evaluate("(given) => replayed(...given)", [module, calls, before])
    found = compared(calls, (folder / "after.bin").read_bytes(), base64.b64decode(memory))
    assert set(found) == {signature(function).symbol for function in jit.ENTRIES.values()}
    assert {name: each for name, each in found.items() if not each.worst <= APART} == {}
