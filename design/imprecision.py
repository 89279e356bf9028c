"""How coarsely may random dances be looked at, and how roughly may handles be put aside?

Run: python design/imprecision.py

1. Between two looks benches slide along one another by centimetres, while their distance changes in
   the second order only. So looks each metre, each two metres far from the end, lose little, less than
   a millimetre: printed is how much nearer benches come with looks each 5 cm.
2. A spiral is tightest at its inner end, but a line that strays may be tightest anywhere: looking at
   the last 60 m alone would call some dances clear that are not.
3. A handle gives along the route by a polynomial of second order. Printed is how far it then stands
   from the true parallel curve, over the width by which handles are put aside.
4. What that comes to in the answer: the pitch needed with coarse and with fine looks.
"""

import numpy as np

from benchdragon import imprecision
from benchdragon.imprecision import CASES, LAST_WAY, Draw, Slips, least_clearance
from benchdragon.kernels.sway import sway
from benchdragon.plan import Plan, read_plan

DRAWS = 20


def disc(pitch: float) -> Plan:
    """The contest's walk to the disc."""
    return read_plan("spiral-in", ["disc.radius=4.5", f"route.pitch={pitch}"])


def looks() -> None:
    """How much is lost between looks."""
    print("1. how much nearer benches come with looks each 5 cm, mm")
    for name in ("aside", "stray", "all"):
        lost = []
        for number in range(DRAWS):
            draw = Draw(CASES[name].slips, 1, number)
            lost.append(
                least_clearance(disc(0.5), draw) - least_clearance(disc(0.5), draw, (0.05, 0.05))
            )
        print(f"   {name:6} median {1e3 * np.median(lost):.4f}, greatest {1e3 * max(lost):.4f}")


def whole_walk() -> None:
    """How much lies before the end of the walk."""
    print(f"2. how much nearer benches come before the last {LAST_WAY:g} m, mm")
    for name in ("aside", "stray"):
        lost = []
        for number in range(DRAWS):
            draw = Draw(CASES[name].slips, 1, number)
            lost.append(least_clearance(disc(0.5), draw, (1.0, 1e4)) - least_clearance(disc(0.5), draw))
        print(f"   {name:6} median {1e3 * np.median(lost):.2f}, greatest {1e3 * max(lost):.2f}")


def parallel() -> None:
    """How far handles stand from where they should."""
    print("3. distance of swayed handles from their parallel curves, mm")
    walk = disc(0.5).build()
    s = walk.route.length
    motion = walk.motion([s])
    at = np.ascontiguousarray(motion.s.T)
    x, y = np.empty(at.shape), np.empty(at.shape)
    for width in (0.01, 0.02, 0.05):
        aside = np.asarray(width * np.random.default_rng(1).standard_normal(len(at)))
        sway(walk.route.rows, walk.dragon.links, at, s, aside, np.zeros(2), 1.0, x, y)
        near = np.linspace(-0.4, 0.4, 8001)
        off = []
        for i in range(len(at)):
            beside = np.minimum(motion.s[0, i] + near, s)
            reach = np.hypot(*(walk.route.point(beside) - [x[i, 0], y[i, 0]]).T)
            off.append(abs(float(reach.min()) - abs(aside[i])))
        print(f"   {100 * width:g} cm aside: greatest {1e3 * max(off):.4f}")


def answers() -> None:
    """What becomes of the pitch."""
    print("4. the pitch needed, m: coarse looks, fine looks")
    for number in range(4):
        draw = Draw(CASES["all"].slips, 1, number)
        coarse = imprecision.needed_pitch(disc(0.55), draw, 0.5)
        fine = imprecision.needed_pitch(disc(0.55), draw, 0.5, (0.1, 0.1))
        print(f"   {coarse:.5f} {fine:.5f}")
    plain = imprecision.needed_pitch(disc(0.55), Draw(Slips(), 1, 0), 0.45)
    print(f"   {plain:.5f} without slips")


if __name__ == "__main__":
    looks()
    whole_walk()
    parallel()
    answers()
