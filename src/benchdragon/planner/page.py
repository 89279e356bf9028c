"""The planner as one HTML file: modules of the pages, the kernels in WebAssembly, presets and words.

The file fetches nothing, and its content security policy forbids it. It computes in Workers, whose
script stands in it too.
"""

import base64
import zlib
from functools import partial
from pathlib import Path

from benchdragon.files import write_whole
from benchdragon.hosts import built
from benchdragon.i18n import Words, _, both, language
from benchdragon.inlining import WEB, chinese, html_page, inlined
from benchdragon.model.formations import FORMATIONS, Formation
from benchdragon.planner.first_look import first_look
from benchdragon.planner.messages import FormationSize, NamedFormation, Preset, WantedPapers
from benchdragon.plans.presets import presets
from benchdragon.plans.schema import Plan
from benchdragon.version import __version__

STYLES = (
    "style.css", "explain.css", "planner.css", "asking.css", "grips.css", "mine.css", "print.css",
    "sheets.css",
)  # fmt: skip
PAGE, WORKER = "planner_start.js", "compute/worker.js"
ENGINE = built.ENGINE / built.MODULE
# Owners of other code in the file.
NOTICES = (ENGINE.with_name("NOTICE.txt"), WEB / "carried.txt")


def planner_page(
    plan: Plan | None = None, spoken: str | None = None, papers: WantedPapers | None = None
) -> str:
    """The planner.

    Args:
        plan: what it opens with; None: what its browser keeps, else a preset.
        spoken: the language that it begins in, "en" or "zh"; None: that in use.
        papers: of the plan, which it opens on.
    """
    held = {
        "version": __version__,
        "words": chinese(PAGE, WORKER),
        "presets": [Preset.model_validate(one).model_dump(mode="json") for one in presets()],
        "formations": [_named(one).model_dump(mode="json") for one in FORMATIONS.values()],
        "plan": None if plan is None else plan.data(),
        "papers": None if papers is None else papers.model_dump(mode="json"),
        "worker": _deflated(f'"use strict";\n{inlined(WORKER)}\nserve(globalThis);\n'.encode()),
        "engine": _deflated(ENGINE.read_bytes()),
    }
    notices = "\n".join(path.read_text("utf-8") for path in NOTICES)
    return html_page(
        "planner.html.jinja", PAGE, STYLES, spoken or language(), held,
        title="benchdragon", notices=notices, look=first_look(plan or presets()[0].plan),
    )  # fmt: skip


def _named(formation: type[Formation]) -> NamedFormation:
    """What pages know of a formation."""
    usual = formation.defaults()
    sizes = [
        FormationSize(
            name=name, text=both(partial(_, size.text)), least=size.least, most=size.most,
            unit=size.unit, usual=usual[name],
        )
        for name, size in formation.sizes.items()
    ]  # fmt: skip
    title = Words(en=formation.english, zh=formation.chinese)
    return NamedFormation(name=formation.name, title=title, sizes=sizes)


def _deflated(data: bytes) -> str:
    """Bytes deflated, in base64."""
    packer = zlib.compressobj(9, wbits=-zlib.MAX_WBITS)
    return base64.b64encode(packer.compress(data) + packer.flush()).decode()


def write_planner(path: Path, plan: Plan | None = None) -> None:
    """Write the planner, whole or not at all."""
    write_whole(path, planner_page(plan))
