"""Is a turn the best of its family? What a proof costs, and what it says of the paper's.

The paper concludes that its turn, two tangent arcs, cannot be optimised. Branch and bound over the
family's numbers (solve/turn_proof.py) settles that both ways: within two arcs the path inside the disc
cannot be shorter, wherever the joints lie; and with a line between the arcs it is shorter by metres.

A box of turns is left out by one of two bounds. Lengths have slopes in closed form (f - sin f by the
radius of an arc that turns by f), so that the mean value theorem bounds them to second order. And one
handle, the head at one place, is too fast on all turns of the box: its place is followed down the chain
by Newton's method over the box, with slopes by the family's numbers.

Boxes are halved across what varies the bound most; where no handle bounds them, across what moves the
turn farthest: a centimetre of a joint's radius moves the joint along the spiral by 17 cm.

The bound for two arcs is by lengths alone, with no witness: it holds at any speed of the head.
"""

import math
import time
from dataclasses import dataclass

from benchdragon.model.turns import TwoArcTurn
from benchdragon.plans.schema import read_plan
from benchdragon.solve.turn import best_turn
from benchdragon.solve.turn_goal import TurnGoal
from benchdragon.solve.turn_proof import proved_bound

JOINTS = ("turn.entry_radius=4.5", "turn.exit_radius=4.5")
# No bend is tighter than the paper's second arc, m.
PAPER = TwoArcTurn(1.7)
LEAST = math.floor(PAPER.radii[1] * 1e4) / 1e4


@dataclass(frozen=True)
class Case:
    """A question: name, settings, speed of the head, m/s, and how near the bound is to come, m."""

    name: str
    settings: tuple[str, ...]
    speed: float
    gap: float


CASES = (
    Case("two arcs, joints on the disc", ("turn.family=arc-arc", *JOINTS), 1.2, 1e-3),
    Case("two arcs, joints anywhere", ("turn.family=arc-arc",), 1.2, 1e-3),
    Case("arc, line, arc, joints on the disc", ("turn.family=arc-line-arc", *JOINTS), 1.3, 1e-2),
    Case("arc, line, arc, joints on the disc", ("turn.family=arc-line-arc", *JOINTS), 1.3, 1e-3),
    Case("arc, line, arc, joints anywhere", ("turn.family=arc-line-arc",), 1.3, 1e-3),
)


def main() -> None:
    """Print value, bound, boxes and seconds of each, and what the line between the arcs gains."""
    print(f"{'family':35s} m/s  path, m    no less than  apart, mm  boxes  CPU s")
    paths = {}
    for case in CASES:
        plan = read_plan("turn", [*case.settings, f"walk.speed={case.speed}"])
        goal = TurnGoal("way", least_radius=0.0 if "arc-arc" in case.settings[0] else LEAST)
        value = best_turn(plan, goal).way
        began = time.process_time()
        found = proved_bound(plan, goal, value, gap=case.gap)
        spent = time.process_time() - began
        print(
            f"{case.name:35s} {case.speed} {value:10.6f} {found.bound:13.6f} {1e3 * found.gap:10.2f} "
            f"{found.boxes:6d} {spent:6.1f}" + ("" if found.complete else "  not closed")
        )
        paths[case.name] = value, found.bound
    least, path = paths["two arcs, joints anywhere"][1], paths["arc, line, arc, joints on the disc"][0]
    print(f"\nthe paper's path {PAPER.length:.6f} m; with a line between the arcs {path:.6f} m:")
    print(f"at least {least - path:.4f} m shorter than any two arcs, and walked at 1.3 m/s")


if __name__ == "__main__":
    main()
