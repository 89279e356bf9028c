"""Benches of a dragon by their kinds, and the room that searches along walks begin with."""

import numpy as np

from benchdragon.errors import InputError
from benchdragon.i18n import _
from benchdragon.kernels import search_room, workspace
from benchdragon.kernels.box_hierarchy import Kinds
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.kinds import find_kinds
from benchdragon.kernels.route import IntArray
from benchdragon.kernels.search_room import Beginning
from benchdragon.kernels.workspace import Benches
from benchdragon.model.walk import Walk

# Different sizes of benches whose contacts can be searched: each is boxed in each cell.
MOST_SIZES = 2_000
# Cells of a route: 1e6 cells need 100 MB.
MOST_CELLS = 2_000_000
# Handles times head positions that are placed at a time: 60 MB.
PLACES = 1_000_000
# At first there is room for so many parts of cells and pairs of boxes a cell, and for no more than so
# many in all; for so many pairs in a step, members of it, cells in doubt. Each is widened on demand.
A_CELL, AT_FIRST = 64, 1_000_000
PAIRS, MEMBERS, DOUBTS = 1_000, 256, 64


def in_columns(told: dict[int, float]) -> FloatArray:
    """Numbers in the order of their columns."""
    return np.array([told[n] for n in range(len(told))], dtype=np.float64)


def beginnings() -> IntArray:
    """The initial sizes of searches' workspaces, for the engine: see kernels/search_room.py."""
    named = {
        Beginning.A_CELL: A_CELL,
        Beginning.AT_FIRST: AT_FIRST,
        Beginning.FIRST_PAIRS: PAIRS,
        Beginning.FIRST_MEMBERS: MEMBERS,
        Beginning.FIRST_DOUBTS: DOUBTS,
        Beginning.MOST_CELLS: MOST_CELLS,
        Beginning.PLACES: PLACES,
    }
    return np.array([named[n] for n in range(search_room.BEGINNINGS)], dtype=np.int64)


def too_many_kinds(sizes: FloatArray) -> InputError:
    """That benches of these sizes, (4, benches), are of too many different ones."""
    text = _("contacts can be searched for at most {most} different sizes, not {count}")
    return InputError(text.format(most=MOST_SIZES, count=len({*zip(*sizes.tolist(), strict=True)})))


def kinds_of(sizes: FloatArray) -> tuple[IntArray, Kinds]:
    """The kind of each bench of these sizes, (4, benches), and the kinds.

    Raises:
        InputError: if they are too many.
    """
    benches = sizes.shape[1]
    most = min(MOST_SIZES, benches)
    found, kind = np.empty((4, most)), np.empty(benches, dtype=np.int64)
    group = np.empty(most, dtype=np.int64)
    count = find_kinds(sizes, found, kind, group)
    if count > most:
        raise too_many_kinds(sizes)
    return kind, Kinds(np.array([row[:count] for row in found.tolist()]), group[:count])


def walk_tables(walk: Walk) -> workspace.Walk:
    """A dragon on its route as tables for the kernels.

    Raises:
        InputError: if its benches are of too many kinds.
    """
    dragon = walk.dragon
    kind, kinds = kinds_of(dragon.sizes)
    ahead = [0.0]
    for link in dragon.links.tolist()[:-1]:
        ahead.append(ahead[-1] + link)
    benches = Benches(dragon.links, dragon.sizes, kind, np.array(ahead), np.array([dragon.lever]))
    return workspace.Walk(walk.route.rows, benches, kinds)
