"""Calls done again by engine.wasm in Chromium, on a page that may run nothing else."""

import base64
import hashlib
from pathlib import Path

from benchdragon.inlining import EXPORT, inlined
from tests.browser.pages import Pages
from tests.engine.recording import HERE, MODULE

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


def replayed_there(pages: Pages, folder: Path, to: Path) -> bytes:
    """The memory after all calls of a folder, done by a page in the folder `to`."""
    opened = pages.open(page(to))
    opened.set_input_files("input", [MODULE, folder / "calls.json", folder / "before.bin"])
    with opened.expect_download() as saved:
        opened.evaluate("replayed()")
    return saved.value.path().read_bytes()
