"""Where every handle of a bench dragon is, and how fast, on any route: the one public door."""

from benchdragon.curves import Arc, Clothoid, Line, Route, Spiral
from benchdragon.dragon import Bench, Dragon
from benchdragon.errors import BenchDragonError, InputError, WalkError
from benchdragon.kernels.status import Status
from benchdragon.leader import SpeedProfile
from benchdragon.motion import Motion, Walk
from benchdragon.turns import TwoArcTurn

__all__ = [
    "Arc",
    "Bench",
    "BenchDragonError",
    "Clothoid",
    "Dragon",
    "InputError",
    "Line",
    "Motion",
    "Route",
    "SpeedProfile",
    "Spiral",
    "Status",
    "TwoArcTurn",
    "Walk",
    "WalkError",
]
__version__ = "0.1.0"
