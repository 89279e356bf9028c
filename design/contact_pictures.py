"""The pictures of the manual's page on contact (docs/contact.svg): `make picture` writes them.

All are of the contest's dragon, of bench 1 and bench 9, which touch first: the chain at contact; swept
boxes of cells of the route; the separation, its lower bounds and the bisection; the cells of the proof.
No words stand in them, so that both languages show the same file.
"""

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from benchdragon import Dragon, Walk, read_plan
from benchdragon.kernels import motion_bounds
from benchdragon.kernels.box import BOX_COLUMNS, box_distance, boxes_at, corner
from benchdragon.kernels.chain import empty_placements
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.separation_bounds import separation_lower_bound
from benchdragon.proofs import cover
from benchdragon.proofs.exact import guess_of, stored_dance

CONTACT = 412.4738376821147
FIRST, SECOND = 0, 8
START, END = 410.0, 413.0
FREE, HIT, SPLIT, PARTNER = "#2f7d4f", "#c8452e", "#f3d3c9", "#e0a030"
PLAIN, LINE = "#b9c3cd", "#1b2733"
CELL, WINDOW, SAMPLES = 0.75, 2.6, 9
NARROWEST = 4e-3


def corners(boxes: FloatArray, i: int) -> FloatArray:
    """The corners of a box, (4, 2), m."""
    return np.array([corner(boxes, i, k) for k in range(4)])


def boxes_of(walk: Walk, s: float) -> FloatArray:
    """All benches with the head at s."""
    placed = walk.placement([s])
    boxes = np.empty((len(walk.dragon.links), BOX_COLUMNS))
    boxes_at(walk.dragon.sizes, placed.x.T.copy(), placed.y.T.copy(), 0, boxes)
    return boxes


def frame(axes: Axes, at: tuple[float, float]) -> None:
    """Show some metres about a place, at one scale, without axes."""
    axes.set_xlim(at[0] - WINDOW, at[0] + WINDOW)
    axes.set_ylim(at[1] - WINDOW, at[1] + WINDOW)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])


def draw_chain(axes: Axes, walk: Walk) -> tuple[float, float]:
    """The chain at contact; the place of contact, m."""
    boxes, placed = boxes_of(walk, CONTACT), walk.placement([CONTACT])
    for i in range(60):
        colour = HIT if i in (FIRST, SECOND) else PLAIN
        axes.add_patch(Polygon(corners(boxes, i), fc=colour, ec=LINE, lw=0.6))
    way = walk.route.point(np.linspace(CONTACT - 60.0, CONTACT, 600))
    axes.plot(*way.T, color=LINE, lw=0.5, ls=":")
    axes.plot(placed.x[0, :60], placed.y[0, :60], ".", color=LINE, ms=4)
    x, y = corners(boxes, FIRST)[np.argmin([box_gap_to(boxes, k) for k in range(4)])]
    frame(axes, (x, y))
    return x, y


def box_gap_to(boxes: FloatArray, k: int) -> float:
    """How far corner k of the first bench is from the second, m."""
    point = np.array(boxes)
    point[FIRST, :2] = corner(boxes, FIRST, k)
    point[FIRST, 4:] = 0.0
    return float(box_distance(point, FIRST, SECOND))


def swept(walk: Walk, begin: float) -> FloatArray:
    """The corners of the box of all that a body bench sweeps while its front handle walks a cell, m."""
    links = walk.dragon.links
    one = Walk(Dragon([walk.dragon[1]]), walk.route)
    places = [boxes_of(one, s) for s in np.linspace(begin, begin + CELL, SAMPLES)]
    points = np.concatenate([corners(boxes, 0) for boxes in places])
    axis = places[SAMPLES // 2][0, 2:4]
    frame_ = np.array([axis, [-axis[1], axis[0]]])
    low, high = (points @ frame_.T).min(axis=0), (points @ frame_.T).max(axis=0)
    assert (high - low)[0] > links[1]
    square = np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]])
    sides: FloatArray = square @ frame_
    return sides


def overlap(one: FloatArray, other: FloatArray) -> bool:
    """Whether two rectangles overlap, by the separating axis theorem."""
    for sides in (one, other):
        for k in (0, 1):
            axis = sides[k + 1] - sides[k]
            if max((one @ axis).min(), (other @ axis).min()) > min(
                (one @ axis).max(), (other @ axis).max()
            ):
                return False
    return True


def draw_boxes(axes: Axes, walk: Walk, at: tuple[float, float]) -> None:
    """Swept boxes of all cells near the place: those of the two turns that meet stand out."""
    cells = np.arange(CONTACT - 60.0, CONTACT, CELL)
    boxes = [swept(walk, begin) for begin in cells]
    near = [k for k, box in enumerate(boxes) if np.abs(box.mean(axis=0) - at).max() < WINDOW + 1.0]
    own = int(np.argmin([np.hypot(*(boxes[k].mean(axis=0) - at)) for k in near]))
    mine = near[own]
    partners = [
        k
        for k in near
        if abs(k - mine) * CELL > 2.0 * walk.dragon.links[0] and overlap(boxes[mine], boxes[k])
    ]
    for k in near:
        axes.add_patch(Polygon(boxes[k], fc="none", ec=PLAIN, lw=0.6))
    for k in partners:
        axes.add_patch(Polygon(boxes[k], fc=PARTNER, alpha=0.35, ec=LINE, lw=0.8))
    axes.add_patch(Polygon(boxes[mine], fc=HIT, alpha=0.8, ec=LINE, lw=1.0))
    frame(axes, at)


def interval(walk: Walk, begin: float, end: float) -> tuple[float, float]:
    """The pair's distance at the begin of an interval, and its lower bound over all of it, m."""
    links, ends = walk.dragon.links[: SECOND + 1], np.array([begin, end])
    places = empty_placements(len(links) + 1, 2)
    handles = np.empty((len(links) + 1, motion_bounds.HANDLE_COLUMNS))
    motion_bounds.place_chain(walk.route.rows, links, ends, 0, 2, places)
    motion_bounds.bound_handles(walk.route.rows, links, places, 0, 1, handles)
    boxes, sweeps = np.empty((4, BOX_COLUMNS)), np.empty((2, motion_bounds.BENCH_COLUMNS))
    both = [boxes_of(walk, s) for s in ends]
    for k, i in enumerate((FIRST, SECOND)):
        boxes[k], boxes[2 + k] = both[0][i], both[1][i]
        motion_bounds.bound_bench(handles, i, walk.dragon.sizes, i, sweeps[k])
    return box_distance(boxes, 0, 1), separation_lower_bound(
        boxes, sweeps, 2, 0, 1, end - begin, np.inf
    )


def draw_bisection(axes: Axes, below: Axes, walk: Walk) -> None:
    """The separation with its bounds over the intervals that were culled; these, row by row, below."""
    at = np.linspace(START, CONTACT, 400)
    axes.plot(at, [interval(walk, s, s + 1e-9)[0] for s in at], color=LINE, lw=1.4)
    axes.axhline(0.0, color=LINE, lw=0.6)
    stack, count = [(START, END, 0)], 0
    while stack:
        begin, end, depth = stack.pop()
        count += 1
        bound = interval(walk, begin, end)[1]
        free = bound > 0.0
        colour = FREE if free else SPLIT
        below.barh(-depth, end - begin, left=begin, height=0.8, color=colour, ec="white", lw=0.4)
        if free:
            axes.plot([begin, end], [bound, bound], color=FREE, lw=2.0)
        elif end - begin > NARROWEST:
            half = 0.5 * (begin + end)
            if half < CONTACT:
                stack.append((half, end, depth + 1))
            stack.append((begin, half, depth + 1))
    axes.axvline(CONTACT, color=HIT, lw=1.0)
    below.axvline(CONTACT, color=HIT, lw=1.0)
    axes.set_ylabel("m")
    axes.tick_params(labelbottom=False)
    below.set_xlabel("s, m")
    below.set_yticks([])
    print(f"{count} intervals")


def draw_proof(axes: Axes, walk: Walk) -> None:
    """The lengths of the cells of a proof over the head's last metres."""
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    ends = np.array(cover.cells(dance, guess, CONTACT - 2.0, CONTACT - 1e-9))
    axes.step(ends[:-1], np.diff(ends), where="post", color=FREE, lw=1.2)
    axes.set_yscale("log")
    axes.set_xlabel("s, m")
    axes.set_ylabel("m")
    axes.axvline(CONTACT, color=HIT, lw=1.0)
    axes.locator_params(axis="x", nbins=5)
    print(f"{len(ends) - 1} cells")


def main(path: Path) -> None:
    """Write the file."""
    mpl.rcParams.update({"svg.hashsalt": "contact", "font.size": 9})
    walk = read_plan("spiral-in").build()
    figure = Figure(figsize=(9.0, 8.4), layout="constrained")
    grid = figure.add_gridspec(3, 2, height_ratios=(1.5, 0.75, 0.45))
    at = draw_chain(figure.add_subplot(grid[0, 0]), walk)
    draw_boxes(figure.add_subplot(grid[0, 1]), walk, at)
    above = figure.add_subplot(grid[1, 0])
    draw_bisection(above, figure.add_subplot(grid[2, 0], sharex=above), walk)
    draw_proof(figure.add_subplot(grid[1:, 1]), walk)
    for letter, axes in zip("abcd", [*figure.axes[:3], figure.axes[4]], strict=True):
        axes.set_title(letter, loc="left", fontweight="bold")
    figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "contact.svg"))
