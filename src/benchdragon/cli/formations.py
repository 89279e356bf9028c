"""The verb `formations`: the formations that plans can name, with their sizes and sources."""

from typing import TYPE_CHECKING, Any

from benchdragon.cli.console import print_json, print_rows
from benchdragon.cli.options import take, verb
from benchdragon.i18n import _, language

if TYPE_CHECKING:
    from benchdragon.model.formations import Formation


@verb("formations")
@take("json", "shared")
def formations(as_json: bool, quiet: bool) -> int:
    """The formations that plans can name: Chinese name, pinyin, sizes by default, and source.

    With --json also the shape of each, and what each size means and may be.
    """
    del quiet
    from benchdragon.model.formations import FORMATIONS

    kinds = list(FORMATIONS.values())
    if as_json:
        print_json({"formations": [_about(kind) for kind in kinds]})
        return 0
    columns = (_("name"), _("called"), _("sizes by default"), _("source"))
    rows = [(kind.name, _called(kind), _sizes(kind), _(kind.source)) for kind in kinds]
    print_rows(_("Formations"), columns, rows, words=len(columns))
    return 0


def _called(kind: "type[Formation]") -> str:
    """Its names, a line each; the English one for readers of English alone."""
    names = [kind.chinese, kind.pinyin]
    return "\n".join(names if language() == "zh" else [*names, kind.english])


def _sizes(kind: "type[Formation]") -> str:
    """Its sizes by default, a line each."""
    defaults = kind.defaults()
    return "\n".join(
        f"{name} {defaults[name]:g} {size.unit}".strip() for name, size in kind.sizes.items()
    )


def _about(kind: "type[Formation]") -> dict[str, Any]:
    """All that is known of a formation, as plain data in the language in use."""
    defaults = kind.defaults()
    return {
        "name": kind.name,
        "chinese": kind.chinese,
        "pinyin": kind.pinyin,
        "english": kind.english,
        "shape": _(kind.shape),
        "source": _(kind.source),
        "sizes": [
            {
                "name": name,
                "text": _(size.text),
                "default": defaults[name],
                "least": size.least,
                "most": size.most,
                "unit": size.unit,
            }
            for name, size in kind.sizes.items()
        ],
        "clockwise": defaults.get("clockwise"),
    }
