"""Codes of findings, which never change, and the words of findings about the square."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from benchdragon.analysis.check import check, sentence
from benchdragon.analysis.findings import KINDS, named, shown_name, touch_text
from benchdragon.i18n import _, spoken_in
from benchdragon.model.obstacle import Obstacle
from benchdragon.plans.schema import read_plan

PAGES = Path(__file__).parents[2] / "docs"
ROW = re.compile(r"^\| `(BD\d{3})` \| (.+?) \| (.+?) \| (.+?) \|$", re.MULTILINE)
# Known for good: a code is never used again for something else.
CODES = {
    "contact": "BD101", "margin": "BD102", "walk": "BD103",
    "sway": "BD105", "imprecision": "BD106", "people": "BD107",
    "speed": "BD201", "acceleration": "BD202", "lateral_acceleration": "BD203",
    "total_acceleration": "BD204", "turning_rate": "BD205", "head_acceleration": "BD206",
    "most_speed": "BD207",
    "venue": "BD301", "venue_margin": "BD302", "obstacle": "BD303", "obstacle_margin": "BD304",
}  # fmt: skip
SAID = [
    "dragon.benches=20",
    "walk.end=60",
    "venue.rectangle=[60, 30]",
    "limits.venue_margin=0.5",
]
WELL = 'kind="circle", name="well", centre=[9, -6], radius=0.6, margin=0.3'
TREE = 'kind="circle", centre=[-9, 9], radius=0.6, margin=2.5'


def test_codes_stay_what_they_are() -> None:
    known = {kind: found.code for kind, found in KINDS.items()}
    assert CODES.items() <= known.items()
    assert len(set(known.values())) == len(known)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_manual_explains_each_code_in_the_words_of_the_program(language: str) -> None:
    page = (PAGES / language / "findings.md").read_text("utf-8")
    with spoken_in(language):
        said = [(found.code, _(found.text)) for found in KINDS.values()]
    assert [row[:2] for row in ROW.findall(page)] == said


def test_a_safe_check_names_the_obstacle_with_the_least_room() -> None:
    """The tree is farther off than the well, but asks for more."""
    report = check(read_plan("turn", [*SAID, f"obstacle=[{{{WELL}}}, {{{TREE}}}]"]))
    edge, well, tree = (answers.distance.lower for answers in report.obstacles)
    assert well < tree < well + 2.2
    said = sentence(report)
    kept, least = int(1000 * edge) / 1000, int(1000 * tree) / 1000
    assert f"at least {kept:.3f} m from the edge of the venue (0.5 m asked for)" in said
    text = f"at least {least:.3f} m from obstacle 2, the narrowest of 2 obstacles (2.5 m asked for)"
    assert text in said
    assert "well" not in said
    with spoken_in("zh"):
        assert "2 个障碍物中障碍物 2处最窄" in sentence(report)


def test_an_unsafe_check_names_what_comes_first() -> None:
    plan = read_plan("turn", [*SAID, f"obstacle=[{{{WELL}}}, {{{TREE}}}]"])
    both = plan.with_values({"obstacle.0.centre": [6.2, 2.0], "obstacle.1.centre": [4.5, 4.5]})
    report = check(both)
    times = {found.obstacle: found.time for found in report.findings}
    assert set(times) == {"well", "obstacle 2"}
    first = min(report.findings, key=lambda found: found.time or 0.0)
    assert first is not report.findings[0]
    text = f"Not safe: bench {first.benches[0]} comes nearer than 2.5 m to obstacle 2 at"
    assert sentence(report).startswith(text)
    assert sentence(report).endswith(" (one of 4 findings)")
    kinds = [(found.obstacle, found.kind) for found in report.findings]
    assert kinds == [
        (name, kind) for name in ("well", "obstacle 2") for kind in ("obstacle_margin", "obstacle")
    ]


def test_names_are_shown_in_the_language_in_use() -> None:
    venue = Obstacle.venue("venue", [(0, 0), (1, 0), (0, 1)])
    line = Obstacle.line("rope {a}", [(0, 0), (1, 0)])
    nameless, pitch = (replace(line, name=name) for name in ("obstacle 3", "pitch"))
    fake = replace(line, name="venue")  # a rope, which is called so
    assert [named(one) for one in (nameless, venue, fake, pitch)] == [
        "obstacle 3", "the venue", "venue", "pitch",
    ]  # fmt: skip
    assert touch_text(7, line) == "bench 7 touches rope {a}"
    with spoken_in("zh"):
        assert [named(nameless), touch_text(7, venue)] == ["障碍物 3", "第 7 节板凳越出场地"]
        assert [named(pitch), shown_name(pitch)] == ["“pitch”", "pitch"]
