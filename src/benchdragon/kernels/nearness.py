"""How near two boxes are and where: a row of numbers, which hosts put into words."""

from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.box import Box, box_distance, box_gap, corner, nearest_corner, offset
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered


class Closest(Numbered):
    """Columns of the nearness of a pair."""

    FIRST, SECOND = 0, 1
    # distance and gap, m, as `box_distance` and `box_gap` say,
    DISTANCE, GAP = 2, 3
    # the point of each that is nearest to the other, m; of overlapping boxes the deepest corner twice,
    POINTS = 4
    # what meets: the box whose corner it is, which corner, the other box, and the feature of it.
    OWNER, CORNER, OTHER, FEATURE = range(8, 12)


NEARNESS = Closest.FEATURE + 1


class BoxFeature(Numbered):
    """Features of a box: front, rear, left and right side; then the corners that these make."""

    SIDES = 2
    CORNERS = 4


@kernel
def foot(boxes: Table, j: int, x: float, y: float) -> tuple[float, float, int]:
    """The point of box j nearest to (x, y), m, and its feature."""
    along, across = offset(boxes, j, x, y)
    half, wide = boxes[j, Box.HALF_LENGTH], boxes[j, Box.HALF_WIDTH]
    a, b = min(max(along, -half), half), min(max(across, -wide), wide)
    ux, uy = boxes[j, Box.UX], boxes[j, Box.UY]
    end, flank = 1 if along < 0.0 else 0, 1 if across < 0.0 else 0
    feature = end if abs(along) - half > abs(across) - wide else BoxFeature.SIDES + flank
    if abs(along) > half and abs(across) > wide:
        feature = BoxFeature.CORNERS + 2 * end + flank
    return boxes[j, Box.CX] + a * ux - b * uy, boxes[j, Box.CY] + a * uy + b * ux, feature


@kernel
def corner_feature(which: int) -> int:
    """The feature that a corner of box.ALONG is."""
    return BoxFeature.CORNERS + 2 * (1 if which in (1, 2) else 0) + which // 2


@entry
def nearness(boxes: Table, i: int, j: int, row: Vector) -> None:
    """Fill a row with how near boxes i and j are."""
    row[Closest.FIRST], row[Closest.SECOND] = min(i, j), max(i, j)
    row[Closest.DISTANCE], row[Closest.GAP] = box_distance(boxes, i, j), box_gap(boxes, i, j)
    mine, which = nearest_corner(boxes, i, j)
    owner, other = (i, j) if mine else (j, i)
    x, y = corner(boxes, owner, which)
    there_x, there_y, feature = foot(boxes, other, x, y)
    if row[Closest.DISTANCE] <= 0.0:
        there_x, there_y = x, y
    own, far = (
        (Closest.POINTS, Closest.POINTS + 2) if owner < other else (Closest.POINTS + 2, Closest.POINTS)
    )
    row[own], row[own + 1], row[far], row[far + 1] = x, y, there_x, there_y
    row[Closest.OWNER] = owner
    row[Closest.CORNER] = which
    row[Closest.OTHER] = other
    row[Closest.FEATURE] = feature


@kernel
def called(row: Vector, i: int, j: int) -> None:
    """Number the boxes of rows 0 and 1 as i < j."""
    first = row[Closest.OWNER] == 0
    row[Closest.FIRST], row[Closest.SECOND] = i, j
    row[Closest.OWNER], row[Closest.OTHER] = (i, j) if first else (j, i)
