"""Pages made from docstrings: one for each public name, with its picture, and those about modules."""

import ast
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

import benchdragon as bd

# What draws the picture of a name.
PICTURES = {
    "Arc": "bd.Arc(6.0, degrees=270).plot()",
    "Clothoid": "bd.Clothoid(40.0, 0.0, 0.2).plot()",
    "Dragon": 'bd.read_plan("spiral-in", {"dragon.benches": 9}).motion(60.0).plot()',
    "Formation": 'bd.formation("three-plum-blossoms").build().plot()',
    "LogSpiral": "bd.LogSpiral(30.0, 0.1, 1.0).plot()",
    "Motion": 'bd.read_plan("turn").motion([14.0, 60.0]).plot(colour="speed")',
    "Obstacle": """bd.read_plan("turn", {
    "dragon.benches": 30, "route.at": [0, 0],
    "obstacle": [{"kind": "circle", "centre": [6.0, 6.0], "radius": 1.0}],
}).plot(at=40.0)""",
    "Plan": 'bd.read_plan("turn").plot(at=14.0)',
    "Report": 'bd.read_plan("spiral-in").check().plot()',
    "Route": "bd.Route.joined([bd.Line(20.0), bd.Arc(6.0, degrees=180), bd.Line(9.0)]).plot()",
    "Spiral": "bd.Spiral(0.55, 40.0, 9.0).plot()",
    "SweptArea": 'bd.read_plan("turn", {"dragon.benches": 30}).swept_area().plot()',
    "TwoArcTurn": 'bd.read_plan("turn", turn={"ratio": 2.0}).build().route.plot()',
    "clearance_curve": 'bd.read_plan("spiral-in").clearance_curve(np.arange(380.0, 414.0, 0.1)).plot()',
    "first_contact": """plan = bd.read_plan("spiral-in")
plan.first_contact().plot(plan)""",
    "plot_speeds": 'bd.read_plan("turn").motion(np.linspace(-10.0, 60.0, 281)).plot_speeds()',
    "smallest_pitch": """plan = bd.read_plan("question-3")
pitch = plan.smallest_pitch()
pitch.plot(plan.with_value("route.pitch", pitch.upper))""",
}
# The names under which a picture is shown, too: functions, and what they return.
SAME = {
    "check": "Report", "formation": "Formation", "two_arcs": "TwoArcTurn", "swept_area": "SweptArea",
    "plot_motion": "Motion", "plot_plan": "Plan", "plot_report": "Report", "plot_route": "Route",
    "plot_area": "SweptArea", "plot_clearance": "clearance_curve", "plot_answer": "first_contact",
    "ClearanceCurve": "clearance_curve",
    "Answer": "first_contact", "Walk": "Motion", "read_plan": "Plan",
}  # fmt: skip
PICTURE = {"en": "Picture", "zh": "图"}
# Titles of pages about modules, and the modules in each.
MODULES = tomllib.loads(Path(__file__).with_name("modules.toml").read_text("utf-8"))


def write_pages(folder: Path, language: str) -> None:
    """Write a page for each public name, and its picture, into a folder of the manual's sources."""
    bd.use_language(language)
    pages = {f"{name}.md": _page(name, PICTURE[language]) for name in bd.__all__}
    _write(folder, pages, {f"{name}.png" for name in PICTURES})
    for name, code in PICTURES.items():
        _draw(code, folder / f"{name}.png")


def write_modules(folder: Path, language: str) -> None:
    """Write the pages about modules into a folder of the manual's sources."""
    _write(folder, {f"{name}.md": _modules(page, language) for name, page in MODULES.items()}, set())


def _write(folder: Path, pages: dict[str, Iterator[str]], others: set[str]) -> None:
    """Have these pages in a folder, and others, and no more; what is the same stays as it is."""
    folder.mkdir(exist_ok=True)
    for path in folder.iterdir():
        if path.name not in {*pages, *others}:
            path.unlink()
    for name, lines in pages.items():
        path, text = folder / name, "\n".join(lines)
        if not path.exists() or path.read_text("utf-8") != text:
            path.write_text(text, "utf-8")


def _modules(page: dict[str, Any], language: str) -> Iterator[str]:
    """The lines of a page about modules."""
    yield from (f"# {page[language]}", "", page.get("about", {}).get(language, ""), "")
    for name, chinese in page["modules"].items():
        yield from (f"## {name}", "", chinese if language == "zh" else "", "")
        yield from ("```{eval-rst}", f".. automodule:: benchdragon.{name}", "```", "")


def _draw(code: str, path: Path) -> None:
    """The picture that the last line of some code draws."""
    *before, last = ast.parse(code).body
    assert isinstance(last, ast.Expr), "the last line draws"
    given = {"bd": bd, "np": np}
    exec(compile(ast.Module(before, []), "picture", "exec"), given)
    figure = eval(compile(ast.Expression(last.value), "picture", "eval"), given)
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)


def _page(name: str, picture: str) -> Iterator[str]:
    """The lines of a page."""
    of = getattr(bd, name)
    kind = "autoclass" if isinstance(of, type) else "autofunction"
    yield from (f"# {name}", "", "```{eval-rst}", f".. {kind}:: benchdragon.{name}")
    if kind == "autoclass" and ">>>" in (of.__init__.__doc__ or ""):
        yield "   :special-members: __init__"
    yield from ("```", "")
    drawn = SAME.get(name, name)
    if drawn in PICTURES:
        yield from (
            f"## {picture}",
            "",
            "```python",
            PICTURES[drawn],
            "```",
            "",
            f"![{drawn}]({drawn}.png)",
            "",
        )
