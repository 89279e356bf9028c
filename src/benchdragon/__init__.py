"""Where every handle of a bench dragon is, and how fast, on any route: the one public door.

Names are fetched on first use, so that `benchdragon --help` need not wait for numba.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from benchdragon.clearance import Nearness, clearances, tightest_pairs
    from benchdragon.curves import Arc, Clothoid, Line, Route, Spiral
    from benchdragon.dragon import Bench, Dragon
    from benchdragon.errors import BenchDragonError, InputError, WalkError
    from benchdragon.kernels.status import Status
    from benchdragon.leader import SpeedProfile
    from benchdragon.motion import Motion, Walk
    from benchdragon.turns import TwoArcTurn

__version__ = "0.1.0"
__all__ = [
    "Arc",
    "Bench",
    "BenchDragonError",
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
    "TwoArcTurn",
    "Walk",
    "WalkError",
    "clearances",
    "tightest_pairs",
]

_ROOMS = {
    "Arc": "curves",
    "Bench": "dragon",
    "BenchDragonError": "errors",
    "Clothoid": "curves",
    "Dragon": "dragon",
    "InputError": "errors",
    "Line": "curves",
    "Motion": "motion",
    "Route": "curves",
    "SpeedProfile": "leader",
    "Spiral": "curves",
    "Status": "kernels.status",
    "TwoArcTurn": "turns",
    "Walk": "motion",
    "WalkError": "errors",
    "Nearness": "clearance",
    "clearances": "clearance",
    "tightest_pairs": "clearance",
}


def __getattr__(name: str) -> object:
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_ROOMS[name]}"), name)
