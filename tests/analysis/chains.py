"""The chain of a walk as proofs look it over."""

from benchdragon import Walk
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.route import IntArray


def chain_at(walk: Walk, s: float) -> tuple[FloatArray, IntArray, FloatArray, FloatArray, FloatArray]:
    """Links, row, u, x and y of the dragon with its head at s, m."""
    motion = Walk(walk.dragon, walk.route).motion([s])
    row, u = motion.state(0)
    return walk.dragon.links, row, u, motion.x[0], motion.y[0]
