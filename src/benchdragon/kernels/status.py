"""Exit statuses of placing a handle, making a turn, fitting a line, and a call of a long search."""

from enum import IntEnum


class Status(IntEnum):
    """Exit status of the search for a handle; anything but `OK` leaves NaN behind it."""

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


class Ended(IntEnum):
    """Exit status of a call of a long search, all of which lies in the caller's arrays."""

    DONE = 0
    MORE = 1  # the budget is spent: to be called again
    ROOM = 2  # an array is full: to be called again with a larger one that begins with the same
    FALLEN = 3  # the chain cannot stand


class Smoothing(IntEnum):
    """How drawn points become a route: through all, with corners rounded by arcs, or by clothoids."""

    NONE = 0
    G1 = 1
    G2 = 2


class FitStatus(IntEnum):
    """Whether there is a route along drawn points, or why not."""

    OK = 0
    ONE_PLACE = 1  # two points in succession are one
    DOUBLES_BACK = 2  # no clothoid of a length that is worth it leads from one point to the next
    NO_ROOM = 3  # the drawing is not known as well as the route is to keep to it
    HAIRPIN = 4  # a corner turns right back
