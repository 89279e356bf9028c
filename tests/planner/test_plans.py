"""compute/plan.js: the plan, its hash, walk, span and sentences are those of Python."""

import tomllib
from pathlib import Path
from typing import Any

import pytest

from benchdragon.plans.presets import presets
from tests.engine.recording import node
from tests.planner.random_plans import plan
from tests.planner.twins import answered, asked, difference
from tests.plans.test_roster import ADDRESSES, NO_ADDRESSES, addressed

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")

# Entrances as they may be written, and as they may not.
ENTRANCES: list[Any] = [
    [[20, 3, "4 m"], [1, 2]], [[20]], [[20, 3, 0]], [[20, 3, -1.5]], [[20, 3, 4, 5]],
    [[1, 2], [20, 3, "wide"]], [20, 3], [[]], [["x", 3, -1]],
]  # fmt: skip
# Plans with something special in them, that random plans seldom have.
SPECIAL: dict[str, dict[str, Any]] = {
    "a cue in lines": {
        "cues": {"cue": [{"kind": "note", "at": 2, "text": "a\nb", "text_zh": "\u0007"}]}
    },
    "a source in lines": {"people": {"source": {"beside": "a\u2028b"}, "sheet": "\u202e"}},
    "a hold that begins when one ends": {
        "cues": {"cue": [{"kind": "hold", "at": at, "hold": 5} for at in (20, 25)]}
    },
    "texts beyond ASCII": {
        "obstacle": [{"kind": "circle", "centre": [1, 2], "radius": 1, "name": "井 é"}]
    },
    **{
        f"entrances {places}": {"event": {"entrances": places}, "venue": {"rectangle": [40, 30]}}
        for places in ENTRANCES
    },
    "cues alone": {"cues": {"tempo": 100}},
    "the usual bar": {"cues": {"bar": 4}},
    "another bar": {"cues": {"bar": 3}},
    "a stop for good": {"cues": {"cue": [{"kind": "stop", "head": 40}]}},
    "a cue after the end": {"cues": {"cue": [{"kind": "beat", "at": 5000}]}},
    "two holds at one time": {"cues": {"cue": [{"kind": "hold", "at": 9, "hold": 5}] * 2}},
    "a start without a stop": {"cues": {"cue": [{"kind": "start", "at": 9}]}},
    "braked too hard": {"cues": {"cue": [{"kind": "stop", "head": 0.1}]}},
    "an acceleration over the limit": {"cues": {"acceleration": 2}},
    "small and large numbers": {"walk": {"speed": 1e-6, "end": 1e8, "position": -1e-7}},
    "negative zero": {"walk": {"position": -0.0}, "route": {"kind": "spiral-in", "turned": -0.0}},
    "moved": {"route": {"kind": "spiral-in", "at": [1, 2], "turned": "0.25 turns"}},
    "a turn that leaves its disc": {
        "route": {"kind": "turn"},
        "disc": {"radius": 4.5},
        "turn": {
            "family": "arc-arc-arc", "radii": [1.9, 3.9], "curvature": 0.33,
            "entry_radius": 4.4, "exit_radius": 2.0,
        },
    },
    "three rounds": {"route": {"kind": "turn", "rounds": 3}, "dragon": {"benches": 40}},
    "a street through the edge of a square": {
        "route": {
            "kind": "turn", "rounds": 2, "at": [1, 2], "street": {"points": [[-60, 0], [-30, 3]]},
        },
        "dragon": {"benches": 40},
        "venue": {"rectangle": [44, 44]},
    },
    "a street that is too short": {"route": {"kind": "turn", "street": {"points": [[0, 0]]}}},
    "keys of turning back without rounds": {"route": {"kind": "turn", "back_radius": 2}},
    "rests by place and round": {
        "route": {"kind": "turn", "rounds": 3},
        "dragon": {"benches": 40},
        "cues": {"cue": [
            {"kind": "hold", "round": 2, "hold": 9}, {"kind": "note", "place": [6, 2], "round": 3},
            {"kind": "beat", "place": [6, 2]},
        ]},
    },
    "a place in a round that the walk does not reach": {
        "route": {"kind": "turn", "rounds": 3},
        "dragon": {"benches": 40},
        "walk": {"start": 0, "end": 20},
        "cues": {"cue": [{"kind": "note", "round": 3, "place": [6, 2]}]},
    },
    "a place of a walk that begins before its route": {
        "route": {"kind": "formation", "name": "three-plum-blossoms", "waist": 4.441},
        "dragon": {"benches": 6},
        "walk": {"speed": 0.5, "start": -65},
        "cues": {"cue": [{"kind": "beat", "place": [3.9, -8.1]}]},
    },
    "a round too many": {"cues": {"cue": [{"kind": "note", "round": 2}]}},
    "a place far away": {"cues": {"cue": [{"kind": "note", "place": [90, 0]}]}},
    "a cue at nothing": {"cues": {"cue": [{"kind": "note"}]}},
    "a slip of the pen": {"dragon": {"width": 1e-9}, "turn": {"ratio": 1e-4}},
    "a misspelt key": {"dragon": {"bodylength": 3}},
    "a misspelt table": {"wlak": {}},
    "an idle key": {"turn": {"ratio": 2}, "walk": {"speed": 1, "profile": [[0, 1]]}},
    "a base": {"base": "turn", "route": {"pitch": 1.8}, "turn": {"family": "arc-line-arc"}},
    "a base that is no plan": {"base": "sprial"},
    "an outline that crosses itself": {"venue": {"boundary": [[0, 0], [9, 9], [9, 0], [0, 9]]}},
    "an outline that folds back": {"venue": {"boundary": [[0, 0], [9, 0], [5, 0], [0, 9]]}},
    "obstacles of one name": {
        "obstacle": [
            {"kind": "circle", "centre": [9, 9], "radius": 1, "name": "well"},
            {"kind": "line", "points": [[0, 0], [1, 1]], "name": "well"},
            {"kind": "line", "points": [[0, 0], [0, 0]]},
        ]
    },
    "benches that cannot be": {
        "dragon": {"bench": [{"length": 1, "count": 3}, {"length": 0.3, "count": 2}]}
    },
    "a head that never arrives": {"walk": {"profile": [[0, 1], [5, 0]]}},
    "a disc that is too large": {"disc": {"radius": 20}},
    "a very long number as text": {"walk": {"speed": "1" * 1_000_000}},
    "as long a text as may be": {"walk": {"speed": "1" * 100}},
    "one sign more": {"walk": {"speed": "龙" * 101}},
}  # fmt: skip


def compared(plans: dict[str, dict[str, Any]]) -> dict[str, str]:
    """Where Python and its twin differ, by the plans' names."""
    twins = asked("plans.mjs", list(plans.values()))
    pairs = zip(plans.items(), twins, strict=True)
    found = {name: difference(answered(data), twin) for (name, data), twin in pairs}
    return {name: text for name, text in found.items() if text}


def spiral(**tables: Any) -> dict[str, Any]:
    base = {} if "base" in tables else {"route": {"kind": "spiral-in"}}
    return {"schema": 1, **base, **tables}


def read(path: Path) -> dict[str, Any]:
    return tomllib.loads(path.read_text("utf-8"))


def test_random_plans_are_the_same() -> None:
    assert compared({f"{seed}": plan(seed) for seed in range(40)}) == {}


def test_what_is_wrong_is_said_in_the_same_words() -> None:
    assert compared({f"{seed}": plan(seed, 1.0) for seed in range(2000, 2060)}) == {}


def test_special_plans_are_the_same() -> None:
    assert compared({name: spiral(**tables) for name, tables in SPECIAL.items()}) == {}


def test_the_page_opens_the_same_addresses() -> None:
    long = "https://example.org/ " + 300 * "x"
    assert compared({text: addressed(text) for text in (*ADDRESSES, *NO_ADDRESSES, long[:250])}) == {}


def test_presets_and_examples_are_the_same() -> None:
    plans = {one.name: one.plan.data() for one in presets()}
    files = (ROOT / "examples").glob("*.toml")
    plans |= {path.name: read(path) for path in files if "drawn" not in path.name}
    assert len(plans) > 20
    assert compared(plans) == {}


def test_drawings_with_repeated_points_are_the_same() -> None:
    lines = [[[0, 0], [0, 0], [30, 0], [30, 20], [30, 20]], [[0, 0], [0, 0]],
             [[0, 0], [30, 0], [30, 20], [0, 0]], [[0, 0], [30, 0], [0, 0]]]  # fmt: skip
    plans = {
        f"{points} {closed}": {"schema": 1, "dragon": {"benches": 4}, "route": {
            "kind": "drawn", "points": points, "closed": closed, "deviation": 1.0,
        }}
        for points in lines for closed in (False, True)
    }  # fmt: skip
    assert compared(plans) == {}


def test_files_and_surveyed_pieces_are_refused_with_what_to_do() -> None:
    piece = {"start": [0, 0], "heading": 0, "length": 12}
    (read_file, line) = asked(
        "plans.mjs",
        [
            {"schema": 1, "route": {"kind": "drawn", "file": "walk.csv"}},
            {"schema": 1, "route": {"kind": "drawn", "piece": [piece]}},
        ],
    )
    assert "the command line does" in read_file["error"]
    assert "the command line does" in line["walk"]["error"]
