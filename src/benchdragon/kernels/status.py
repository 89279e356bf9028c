"""How placing a handle can end, and a call of a long search; and what is wrong with an engine."""

from enum import IntEnum


class Status(IntEnum):
    """How the search for a handle ended; anything but `OK` leaves NaN behind it."""

    OK = 0
    BEFORE_ROUTE = 1  # the head stands behind everything that the route offers
    AFTER_ROUTE = 2  # the head has walked past the route's end
    ROUTE_TOO_SHORT = 3  # no place behind the handle is one link away: the tail hangs out
    FOLDED = 4  # a bench stands square to the route: speeds run away
    LINK_OVER_DIAMETER = 5  # the same on an arc that the link cannot lie within


class Ended(IntEnum):
    """How a call of a long search ended, all of which lies in the caller's arrays."""

    DONE = 0
    MORE = 1  # the budget is spent: to be called again
    ROOM = 2  # an array is full: to be called again with a larger one that begins with the same
    FALLEN = 3  # the chain cannot stand


class EngineError(Exception):
    """The engine of the name that is its argument, from BENCHDRAGON_ENGINE, cannot serve."""
