"""Where every handle of a bench dragon is, and how fast, on any route: the one public door.

Names are fetched on first use, so that `benchdragon --help` need not wait for numba.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from benchdragon.answer import Answer, Witness
    from benchdragon.clearance import Nearness, clearances, tightest_pairs
    from benchdragon.contact import (
        ClearanceCurve,
        Window,
        clearance_curve,
        contact_windows,
        first_contact,
        least_clearance,
    )
    from benchdragon.curves import Arc, Clothoid, Line, Route, Spiral
    from benchdragon.dragon import Bench, Dragon
    from benchdragon.errors import BenchDragonError, InputError, UnsureError, WalkError
    from benchdragon.kernels.status import Status
    from benchdragon.leader import SpeedProfile
    from benchdragon.motion import Motion, Walk
    from benchdragon.speeds import greatest_speed
    from benchdragon.turns import Turn, TwoArcTurn, three_pieces, two_arcs

__version__ = "0.1.0"
__all__ = [
    "Answer",
    "Arc",
    "Bench",
    "BenchDragonError",
    "ClearanceCurve",
    "Clothoid",
    "Dragon",
    "InputError",
    "Line",
    "Motion",
    "Nearness",
    "Route",
    "SpeedProfile",
    "Spiral",
    "Status",
    "Turn",
    "TwoArcTurn",
    "UnsureError",
    "Walk",
    "WalkError",
    "Window",
    "Witness",
    "clearance_curve",
    "clearances",
    "contact_windows",
    "first_contact",
    "greatest_speed",
    "least_clearance",
    "three_pieces",
    "tightest_pairs",
    "two_arcs",
]

_ROOMS = {
    "Answer": "answer",
    "Arc": "curves",
    "Bench": "dragon",
    "BenchDragonError": "errors",
    "ClearanceCurve": "contact",
    "Clothoid": "curves",
    "Dragon": "dragon",
    "InputError": "errors",
    "Line": "curves",
    "Motion": "motion",
    "Nearness": "clearance",
    "Route": "curves",
    "SpeedProfile": "leader",
    "Spiral": "curves",
    "Status": "kernels.status",
    "Turn": "turns",
    "TwoArcTurn": "turns",
    "UnsureError": "errors",
    "Walk": "motion",
    "WalkError": "errors",
    "Window": "contact",
    "Witness": "answer",
    "clearance_curve": "contact",
    "clearances": "clearance",
    "contact_windows": "contact",
    "first_contact": "contact",
    "greatest_speed": "speeds",
    "least_clearance": "contact",
    "three_pieces": "turns",
    "tightest_pairs": "clearance",
    "two_arcs": "turns",
}


def __getattr__(name: str) -> object:
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_ROOMS[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
