"""How handles follow one another along a route: tables of the way back to the next, and their use.

Handle i + 1 is one link behind handle i, so that its place depends on that of handle i alone. A table
is cubics between nodes on stretches of route, one for each length of link.
"""

import math
from typing import NamedTuple

from benchdragon.kernels.arrays import IntTable, IntVector, Table, Vector
from benchdragon.kernels.chain import Placements, march
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.drawn_route import cubic, even
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.frames import QUANTUM, position
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.status import Status

# Resolution of ways behind, m, and of their changes, m a metre; in four bytes up to LARGEST.
FINE, LARGEST = 1e-9, 2.1
# The longest stretch, m, and its most nodes.
LONGEST, MOST_NODES = 20.0, 4096
# Borders nearer to one another than this, m, count as one.
NARROW = 1e-6
# The most bisections for the place of the handle in front.
HALVINGS = 60


class NodeStretch(Numbered):
    """Columns of stretches.

    The position of the first node, m, the distance of nodes, m, the first one's number, and how many.
    """

    START, STEP, FIRST, NODES = range(4)


STRETCH_COLUMNS = len(NodeStretch)


class WayNode(Numbered):
    """Columns of nodes: the way behind, m, and its change, m a metre."""

    WAY, RATE = 0, 1


class Tables(NamedTuple):
    """Tables of all lengths of links."""

    links: Vector  # m, (kinds,)
    ends: IntVector  # number of the stretch behind each kind's last, (kinds,)
    stretches: Table  # (stretches, STRETCH_COLUMNS)
    nodes: IntTable  # ways and their changes, in FINE, (2, nodes)
    kinds: IntVector  # of each bench


@kernel
def stands(rows: FloatArray, links: FloatArray, s: float, at: FloatArray, places: Placements) -> bool:
    """Whether one bench stands with its front handle at s, m: placed in slot 0."""
    at[0] = s
    march(rows, links, at, 0, 1, places)
    return bool(places.failed[0, 0] == Status.OK)


@kernel
def front_of(
    rows: FloatArray, links: FloatArray, rear: float, low: float, high: float, at: FloatArray,
    places: Placements,
) -> float:  # fmt: skip
    """The position of a bench's front handle, m, whose rear handle is at `rear`, m."""
    a, b = rear, rear + 2.0 * LARGEST + links[0]
    for _halving in range(HALVINGS):
        s = 0.5 * (a + b)
        sound = s < high and stands(rows, links, max(s, low), at, places)
        if sound and position(rows, places, 1, 0) < rear:
            a = s
        else:
            b = s
    return 0.5 * (a + b)


@entry
def find_edges(
    rows: Table, joints: Vector, links: Vector, low: float, high: float, at: Vector, places: Placements,
    edges: Vector,
) -> int:  # fmt: skip
    """Fill edges with the ends of stretches, m, no longer than LONGEST, from low to high: how many.

    They are at joints; given one link, also where the rear handle of its bench is at a joint.
    """
    edges[0], count = low, 1
    for n in range(joints.shape[0] * (1 + links.shape[0])):
        border = joints[n % joints.shape[0]]
        if n >= joints.shape[0]:
            border = front_of(rows, links, border, low, high, at, places)
        if low < border < high:
            k, count = count, count + 1
            while edges[k - 1] > border:
                edges[k], k = edges[k - 1], k - 1
            edges[k] = border
    edges[count], kept, last = high, 1, 0
    for k in range(1, count):
        if min(edges[k] - edges[kept - 1], high - edges[k]) > NARROW:
            edges[kept], kept = edges[k], kept + 1
    edges[kept] = high
    for k in range(kept):
        last += max(math.ceil((edges[k + 1] - edges[k]) / LONGEST), 1)
    total = last + 1
    for k in range(kept - 1, -1, -1):
        a, b = edges[k], edges[k + 1]
        parts = max(math.ceil((b - a) / LONGEST), 1)
        for n in range(parts, 0, -1):
            edges[last], last = even(a, b, n, parts + 1), last - 1
    return total


@kernel
def behind(tables: Tables, kind: int, s: float) -> tuple[float, float]:
    """The position of the next handle, m, and its change a metre of this one's, which is at s, m."""
    low, high = tables.ends[kind - 1] if kind > 0 else 0, tables.ends[kind] - 1
    while low < high:
        middle = (low + high + 1) // 2
        if tables.stretches[middle, NodeStretch.START] <= s:
            low = middle
        else:
            high = middle - 1
    step, nodes = tables.stretches[low, NodeStretch.STEP], tables.nodes
    along = (s - tables.stretches[low, NodeStretch.START]) / step
    node = min(max(math.floor(along), 0), int(tables.stretches[low, NodeStretch.NODES]) - 2)
    f, k = along - node, node + int(tables.stretches[low, NodeStretch.FIRST])
    a, rise = nodes[WayNode.WAY, k] * FINE, (nodes[WayNode.WAY, k + 1] - nodes[WayNode.WAY, k]) * FINE
    r0, r1, rest = nodes[WayNode.RATE, k] * FINE, nodes[WayNode.RATE, k + 1] * FINE, 1.0 - f
    way = cubic(a, a + rise, step * r0, step * r1, f)
    rate = 6.0 * f * rest * rise / step + rest * (1.0 - 3.0 * f) * r0 + f * (3.0 * f - 2.0) * r1
    return s - tables.links[kind] - way, 1.0 - rate


@kernel
def fill_stretch(
    rows: FloatArray, kind: int, n: int, span: tuple[float, float], count: int, at: FloatArray,
    places: Placements, tables: Tables,
) -> float:  # fmt: skip
    """Fill stretch n of a table with so many nodes; returns its error, m, infinite if it has none."""
    (low, high), row, looks, error = span, tables.stretches[n], 4 * count - 3, 0.0
    links, inside = tables.links[kind : kind + 1], (high - low) * 1e-10  # rates of this side
    first = (
        int(tables.stretches[n - 1, NodeStretch.FIRST] + tables.stretches[n - 1, NodeStretch.NODES])
        if n > 0
        else 0
    )
    if first + count > tables.nodes.shape[1]:
        return math.inf
    row[NodeStretch.START] = low
    row[NodeStretch.STEP] = (high - low) / (count - 1)
    row[NodeStretch.FIRST] = first
    row[NodeStretch.NODES] = count
    for look in range(2):  # at nodes, then at all places
        for k in range(0, looks, 1 if look else 4):
            s = even(low + inside, high - inside, k, looks)
            if not stands(rows, links, s, at, places):
                return math.inf
            rear = position(rows, places, 1, 0)
            way, rate = s - rear - links[0], 1.0 - places.ratio[1, 0]
            if max(abs(way), abs(rate)) > LARGEST:
                return math.inf
            if look:
                error = max(error, abs(behind(tables, kind, s)[0] - rear))
            else:
                tables.nodes[WayNode.WAY, first + k // 4] = math.floor(way / FINE + 0.5)
                tables.nodes[WayNode.RATE, first + k // 4] = math.floor(rate / FINE + 0.5)
    return error


@entry
def tabulate(
    rows: Table, joints: Vector, kind: int, low: float, high: float, most: float, at: Vector,
    places: Placements, edges: Vector, tables: Tables,
) -> float:  # fmt: skip
    """Put the table of a kind of link behind those before it: from low to high, m, in stretches.

    Returns its error, m; infinite if that is more than `most`, or where a table cannot be made.
    """
    links, worst = tables.links[kind : kind + 1], 0.0
    n = tables.ends[kind - 1] if kind > 0 else 0
    for k in range(find_edges(rows, joints, links, low, high, at, places, edges) - 1):
        error, count = math.inf, 3
        tables.ends[kind] = n + 1
        while error > most:
            if count > MOST_NODES:
                return math.inf
            error = fill_stretch(rows, kind, n, (edges[k], edges[k + 1]), count, at, places, tables)
            if error == math.inf:
                return error
            count = 2 * count - 1
        worst, n = max(worst, error), n + 1
    return worst


@kernel
def framed(places: FloatArray, speeds: FloatArray, along: float, step: float) -> float:
    """The position that frames give a handle, m, so many steps behind the first."""
    k = min(math.floor(along), places.shape[0] - 2)
    rise = QUANTUM * step
    return cubic(
        places[k] * QUANTUM, places[k + 1] * QUANTUM, speeds[k] * rise, speeds[k + 1] * rise, along - k
    )


@entry
def compare_followed(
    rows: Table, links: Vector, tables: Tables, framed_at: Vector, framed_speeds: Vector, step: float,
    shares: Vector, heads: Vector, first: int, last: int, at: Vector, places: Placements,
) -> float:  # fmt: skip
    """The greatest error of any handle's position, m, at shares of the frames' steps first <= t < last.

    The head is at heads, m; its frames have positions and speeds in quanta, a step, s, apart.
    """
    worst = 0.0
    for t in range(first, last):
        n = (t - first) % at.shape[0]
        if n == 0:
            for k in range(min(at.shape[0], last - t)):
                at[k] = heads[t + k]
            march(rows, links, at, 0, min(at.shape[0], last - t), places)
        if places.failed[0, n] != Status.OK:
            return math.inf
        s = framed(framed_at, framed_speeds, shares[t], step)
        for i in range(links.shape[0] + 1):
            worst = max(worst, abs(s - position(rows, places, i, n)))
            if i < links.shape[0]:
                s, _rate = behind(tables, tables.kinds[i], s)
    return worst


@entry
def look_at_followed(
    tables: Tables, heads: Vector, paces: Vector, first: int, last: int, fastest: Table, ends: Vector,
    speeds: Vector,
) -> tuple[float, float, float]:  # fmt: skip
    """The least and the greatest speed of all handles, m/s, and its greatest change from time to time.

    At times first <= t < last, with the head at heads, m, and its speeds, m/s. Keeps in `fastest`, (2,
    benches), the greatest speed of each bench and the number of its time, in `ends` the position of the
    last handle, m, and in `speeds` those of all handles.
    """
    low, high, change = math.inf, -math.inf, 0.0
    for t in range(first, last):
        s, ratio = heads[t], 1.0
        for i in range(speeds.shape[0]):
            speed = ratio * paces[t]
            low, high = min(low, speed), max(high, speed)
            if t > 0:
                change = max(change, abs(speed - speeds[i]))
            speeds[i] = speed
            if i == speeds.shape[0] - 1:
                ends[t] = s
                break
            if t == 0 or speed > fastest[0, i]:
                fastest[0, i], fastest[1, i] = speed, t
            s, rate = behind(tables, tables.kinds[i], s)
            ratio *= rate
    return low, high, change
