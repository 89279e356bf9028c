"""How near two boxes are and where: a row of numbers, which hosts tell in words."""

from benchdragon.kernels import box
from benchdragon.kernels.arrays import Table, Vector
from benchdragon.kernels.box import box_distance, box_gap, corner, nearest_corner, offset
from benchdragon.kernels.entries import entry, kernel

# Columns of what is told of a pair: its rows, the smaller first,
FIRST, SECOND = 0, 1
# distance and gap, m, as `box_distance` and `box_gap` say,
DISTANCE, GAP = 2, 3
# the point of each that is nearest to the other, m; of overlapping boxes the deepest corner twice,
POINTS = 4
# what meets: the row of the one whose corner that is, which corner, the other's row, and what of it.
OWNER, CORNER, OTHER, FEATURE = 8, 9, 10, 11
NEARNESS = 12
# Features of a box: front, rear, left and right side, and from here on the corners that these make.
SIDES, CORNERS = 2, 4


@kernel
def foot(boxes: Table, j: int, x: float, y: float) -> tuple[float, float, int]:
    """The point of box j nearest to (x, y), m, and its feature."""
    along, across = offset(boxes, j, x, y)
    half, wide = boxes[j, box.HALF_LENGTH], boxes[j, box.HALF_WIDTH]
    a, b = min(max(along, -half), half), min(max(across, -wide), wide)
    ux, uy = boxes[j, box.UX], boxes[j, box.UY]
    end, flank = 1 if along < 0.0 else 0, 1 if across < 0.0 else 0
    feature = end if abs(along) - half > abs(across) - wide else SIDES + flank
    if abs(along) > half and abs(across) > wide:
        feature = CORNERS + 2 * end + flank
    return boxes[j, box.CX] + a * ux - b * uy, boxes[j, box.CY] + a * uy + b * ux, feature


@kernel
def corner_feature(which: int) -> int:
    """The feature that a corner of box.ALONG is."""
    return CORNERS + 2 * (1 if which in (1, 2) else 0) + which // 2


@entry
def nearness(boxes: Table, i: int, j: int, row: Vector) -> None:
    """Fill a row with how near boxes i and j are."""
    row[FIRST], row[SECOND] = min(i, j), max(i, j)
    row[DISTANCE], row[GAP] = box_distance(boxes, i, j), box_gap(boxes, i, j)
    mine, which = nearest_corner(boxes, i, j)
    owner, other = (i, j) if mine else (j, i)
    x, y = corner(boxes, owner, which)
    there_x, there_y, feature = foot(boxes, other, x, y)
    if row[DISTANCE] <= 0.0:
        there_x, there_y = x, y
    own, far = (POINTS, POINTS + 2) if owner < other else (POINTS + 2, POINTS)
    row[own], row[own + 1], row[far], row[far + 1] = x, y, there_x, there_y
    row[OWNER], row[CORNER], row[OTHER], row[FEATURE] = owner, which, other, feature


@kernel
def called(row: Vector, i: int, j: int) -> None:
    """Call the boxes of rows 0 and 1 by the numbers i < j."""
    first = row[OWNER] == 0
    row[FIRST], row[SECOND] = i, j
    row[OWNER], row[OTHER] = (i, j) if first else (j, i)
