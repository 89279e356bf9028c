"""The planner as one HTML file: modules of the pages, the kernels in WebAssembly, presets and words.

The file fetches nothing, and its content security policy forbids it. It computes in Workers, whose
script stands in it too.
"""

import base64
import zlib
from dataclasses import asdict
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from benchdragon import engine
from benchdragon.files import whole_file
from benchdragon.i18n import _, both, language
from benchdragon.inlining import WEB, chinese, content_hash, inert, inlined, joined_styles
from benchdragon.planner.messages import Preset
from benchdragon.plans.presets import presets
from benchdragon.plans.schema import Plan
from benchdragon.version import __version__

STYLES = ("style.css", "explain.css", "planner.css", "grips.css", "print.css")
PAGE, WORKER = "planner_start.js", "compute/worker.js"
ENGINE = Path(engine.__file__).with_name("engine.wasm")
# Whose code is in the file, beside ours.
NOTICES = (ENGINE.with_name("NOTICE.txt"), WEB / "carried.txt")
# Bytes that a file may have.
MOST_BYTES = 2_000_000


def planner_page(plan: Plan | None = None, spoken: str | None = None) -> str:
    """The planner.

    Args:
        plan: what it opens with; None: what its browser keeps, else a preset.
        spoken: the language that it begins in, "en" or "zh"; None: that in use.
    """
    script = inlined(PAGE) + "\nawait start();\n"
    style = joined_styles(STYLES)
    environment = Environment(
        loader=PackageLoader("benchdragon"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
    )
    spoken = spoken or language()
    return environment.get_template("planner.html.jinja").render(
        language=spoken,
        version=__version__,
        hashes={"script": content_hash(script), "style": content_hash(style)},
        style=style,
        script=script,
        waiting=asdict(
            both(lambda: _("Nothing moves? Then open this file in a browser: previews do not run it."))
        ),
        notices="\n".join(path.read_text("utf-8") for path in NOTICES),
        held={
            "version": inert(__version__),
            "language": inert(spoken),
            "words": inert(chinese(PAGE, WORKER)),
            "presets": inert([Preset.model_validate(one).model_dump(mode="json") for one in presets()]),
            "plan": inert(None if plan is None else plan.data()),
            "worker": inert(f'"use strict";\n{inlined(WORKER)}\nserve(globalThis);\n'),
            "engine": inert(_deflated(ENGINE.read_bytes())),
        },
    )


def _deflated(data: bytes) -> str:
    """Bytes deflated, in base64."""
    packer = zlib.compressobj(9, wbits=-zlib.MAX_WBITS)
    return base64.b64encode(packer.compress(data) + packer.flush()).decode()


def write_planner(path: Path, plan: Plan | None = None) -> None:
    """Write the planner, whole or not at all."""
    with whole_file(path) as temporary:
        temporary.write_text(planner_page(plan), "utf-8", newline="\n")
