"""Which benches of a dragon are alike: their kinds by size, and the groups that are boxed together."""

import math

from benchdragon.kernels.arrays import IntVector, Table
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel

# Kinds are boxed in at most so many groups; more would mean more pairs of boxes.
GROUPS = 3


@kernel
def same_size(sizes: FloatArray, i: int, kinds: FloatArray, k: int) -> bool:
    """Whether bench i is of kind k."""
    return (
        sizes[0, i] == kinds[0, k]
        and sizes[1, i] == kinds[1, k]
        and sizes[2, i] == kinds[2, k]
        and sizes[3, i] == kinds[3, k]
    )


@entry
def find_kinds(sizes: Table, kinds: Table, kind: IntVector, group: IntVector) -> int:
    """Fill kinds, (4, most), with the different sizes, and kind[i] with the number of bench i's.

    group[k] becomes the group of kind k: GROUPS at most, by length. Gives how many kinds there are; one
    more than `most` if they are too many. Sizes as in `box.place_box`.
    """
    count = 0
    for i in range(sizes.shape[1]):
        k = kind[i - 1] if i and same_size(sizes, i, kinds, kind[i - 1]) else 0
        while k < count and not same_size(sizes, i, kinds, k):
            k += 1
        if k == count:
            if count == kinds.shape[1]:
                return count + 1
            for n in range(4):
                kinds[n, k] = sizes[n, i]
            count += 1
        kind[i] = k
    group_by_length(kinds, count, group)
    return count


@kernel
def group_by_length(kinds: FloatArray, count: int, group: IntVector) -> None:
    """Part so many kinds into groups of like lengths, as equal in number as may be."""
    groups = min(GROUPS, count)
    for k in range(count):
        rank = 0
        for n in range(count):
            if kinds[0, n] < kinds[0, k] or (kinds[0, n] == kinds[0, k] and n < k):
                rank += 1
        group[k] = rank * groups // count


@kernel
def least_ways(
    links: FloatArray, kind: IntVector, group: IntVector, groups: int, ways: FloatArray, first: int
) -> None:
    """Fill ways[a, first + b] with at most the way, m, from a bench of group a back to one of group b.

    They are not neighbours; infinite where there are no two. The way along a route is no shorter than
    the links between.
    """
    for a in range(groups):
        for b in range(groups):
            ways[a, first + b] = math.inf
    for b in range(groups):
        behind, last = 0.0, -1  # from bench i back to the next of group b, two benches on or more
        for i in range(kind.shape[0] - 3, -1, -1):
            behind += links[i]
            if group[kind[i + 2]] == b:
                behind, last = links[i] + links[i + 1], i + 2
            a = group[kind[i]]
            if last >= 0:
                ways[a, first + b] = min(ways[a, first + b], behind)
