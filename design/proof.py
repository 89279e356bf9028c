"""Why a proof believes no search: the head's way is cut into cells, each of which is shown by itself.

The search (design/first_contact.py) says where the first contact is. Everything that is called
proved is then shown again, by code that shares no arithmetic with it (the room `proofs`), in four
steps:

1. Chains. With the head at the end of a cell, each handle is led to a point of the route that is
   known with 128 bits. The distance of two such points misses the link by what ball arithmetic
   encloses; so how far the exact handle may be from its point is bounded from the head's to the
   tail's. Computed places are guesses alone: a wrong one gives no wrong bound.
2. Following. From one chain to the next each angle between bench and route stays below a right
   angle, so each handle goes with the one before it, forward and without a leap; and none of the
   places between two handles is a link away, so that it is the nearest. From then on a handle's way
   is no longer than what lies between its two places.
3. Pairs. In a cell no point of a bench moves more than its handles let it. Two benches keep the
   mean of their distances at both ends, less half of what both move (first order). Where that is
   not enough, their distance along a line is enclosed with its second derivative L: it lies above
   the chord by no more than L h^2 / 8 in a cell of length h (second order).
   A pair that this leaves in doubt is shown in halves of the cell, three times at most, with a chain
   between that ends at its rear bench: so one pair that is near shortens no cell for all others.
4. Meeting. At one head position right behind the last cell, two benches surely overlap, or are
   nearer than the margin.

Cells are found by trying: the next is longer by a tenth after one that held, half as long after one
that did not. How they were found proves nothing, and a certificate holds nothing but their ends.

None of this is new by itself. That a bound on motion and the distances at both ends show a whole
step free of contact is the adaptive dynamic collision checking of Schwarzer, Saha and Latombe; a
bound on the first derivative that passes over what cannot hold a root is the method of Piyavskii
and Shubert; to halve until bounds decide is branch and bound with intervals. What is added is a
chain whose links are kept, by the hundred, with bounds on what each handle does within a step.

Speeds are bounded over a cell from both its ends by how much they change (proofs/pace.py), which is
second order as well: what is given away is the square of the cell's length. To multiply enclosed ratios
of cosines from the head to the tail gives away the length, and more with every bench.

Below: how many cells either order needs for the last metre before the contest's first contact. The
first order ends earlier, since it is taken from doubles, and leaves room for their rounding. Then what
the certificates of the contest's first contact (its last second), of its smallest pitch and of its
greatest head speed take, the latter with the benches that decide.
"""

import math
import time
from collections.abc import Callable
from contextlib import nullcontext
from unittest.mock import patch

from benchdragon.analysis.certificate import certificate_of, verify
from benchdragon.analysis.proof import Claim, prove_contact
from benchdragon.analysis.speed_proof import SpeedClaim
from benchdragon.model.answer import Answer
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.proofs import cells, cover
from benchdragon.proofs.exact import guess_of, stored_dance
from benchdragon.solve.head_speed import prove_head_speed
from benchdragon.solve.size import limit

CONTACT, METRE = 412.4738376821147, 1.0
# The benches that decide, where these do: the smallest pitch, and the greatest head speed.
COIL = ["disc.radius=4.5", "dragon.benches=30", "route.start_turn=12"]
TURN = ["dragon.benches=8", "walk.start=-5", "walk.end=30"]


def last_metre(second_order: bool) -> list[float]:
    """The cells from a metre before the first contact on, as far as they go, m."""
    walk = read_plan("spiral-in").build()
    dance, guess = stored_dance(walk, 0.0), guess_of(walk)
    curved = cells.__name__ + ".curved_apart"
    with nullcontext() if second_order else patch(curved, lambda *_arguments: False):
        return cover.cells(dance, guess, CONTACT - METRE, CONTACT + METRE)


def main() -> None:
    """Print how many cells there are, and the bracket that they leave."""
    for name, second_order in (("first order alone", False), ("with the second", True)):
        at = last_metre(second_order)
        print(f"{name}: {len(at) - 1} cells, to {CONTACT - at[-1]:.1e} m before the contact")
        for off in (1e-1, 1e-3, 1e-6):
            print(f"  to {off:.0e} m before it: {sum(s < CONTACT - off for s in at)}")
    claims: list[Claim] = []
    answer = prove_contact(read_plan("spiral-in").build(), CONTACT - METRE, 413.0, claims=claims)
    if answer is not None:
        print(f"first contact {answer.status}: {answer.lower!r} .. {answer.upper!r} s")
        print(f"{answer.upper - answer.lower:.1e} s wide, {len(claims[0].cells) - 1} cells")
    certificates()


def certificates() -> None:
    """Print what the certificates of three answers take: to write, and to show again."""
    coil, turn = read_plan("spiral-in", COIL), read_plan("turn", TURN)
    near = read_plan("spiral-in", ["walk.start=411.5", "walk.end=413"])
    told("first contact", near, lambda kept, _speeds: contact_of(near, kept))
    told("smallest pitch", coil, lambda kept, _speeds: limit(coil, "pitch", prove=True, claims=kept))
    told("head speed", turn, lambda _kept, speeds: prove_head_speed(turn, claims=speeds))


def contact_of(plan: Plan, claims: list[Claim]) -> Answer | None:
    """The first contact of a plan, proved of what is written."""
    walk = plan.build()
    return prove_contact(walk, *plan.span(walk), claims=claims, plan=plan)


def told(
    name: str, plan: Plan, prove: Callable[[list[Claim], list[SpeedClaim]], Answer | None]
) -> None:
    """Print the bracket of an answer, and the size and times of its certificate."""
    claims, speeds = list[Claim](), list[SpeedClaim]()
    began = time.process_time()
    answer = prove(claims, speeds)
    shown = time.process_time()
    certificate = certificate_of(plan, claims, speeds)
    verify(certificate)
    again = time.process_time()
    ends = [claim.cells for claim in claims] + [claim.cells for claim in speeds]
    cells = sum(len(at) - 1 for at in ends)
    width = math.nan if answer is None else answer.upper - answer.lower
    print(
        f"{name}: {width:.1e} wide, {cells} cells, {len(certificate.model_dump_json())} bytes, "
        f"found and proved in {shown - began:.1f} s of CPU, shown again in {again - shown:.1f} s"
    )


if __name__ == "__main__":
    main()
