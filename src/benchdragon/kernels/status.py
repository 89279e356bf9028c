"""The few ways in which placing a handle and making a turn end, and what is wrong with an engine."""

from enum import IntEnum


class Status(IntEnum):
    """How the search for a handle ended; anything but `OK` leaves NaN behind it."""

    OK = 0
    BEFORE_ROUTE = 1  # the head stands behind everything that the route offers
    AFTER_ROUTE = 2  # the head has walked past the route's end
    ROUTE_TOO_SHORT = 3  # no place behind the handle is one link away: the tail hangs out
    FOLDED = 4  # a bench stands square to the route: speeds run away
    LINK_OVER_DIAMETER = 5  # the same on an arc that the link cannot lie within


class TurnStatus(IntEnum):
    """Whether there is a turn of some numbers, or why not."""

    OK = 0
    TOO_NEAR = 1  # a joint with a spiral lies where that turns too sharply about its centre
    NO_ARCS = 2  # no two arcs of the ratio are tangent to the spirals and to each other
    NO_LINE = 3  # the circles of the arcs overlap: no line is tangent to both
    NO_CIRCLE = 4  # no circle of the middle curvature is tangent to both arcs
    NOT_EASED = 5  # Newton's method found no lengths with which the eased turn ends in place
    NO_ROOM = 6  # the clothoids leave no room for the arcs


class EngineError(Exception):
    """The engine of the name that is its argument, from BENCHDRAGON_ENGINE, cannot serve."""
