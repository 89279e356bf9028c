"""Why a proof needs no second search: places are looked over afterwards, in ball arithmetic.

The search (design/first_contact.py) draws its conclusions with bounds that hold for the exact chain,
from chains computed in doubles; it leaves room for `slack` metres in every distance. Three kinds of
error stand between the two:

1. Places. A computed handle is some way off the exact one. Afterwards each is enclosed: from the exact
   place of the handle before (a ball of 1e-28 m), one Newton step with 100 bits leads to the exact
place
   of the next; what the distance of the two then misses the link by, divided by the cosine between
bench
   and route, bounds what is left. The difference to the computed point is its error (`beside`), the
   difference of parameters times the arc per parameter its error along the route (`along`).
2. Where the head is put. That is a choice, not an error: the chain behind is exact for the place at
   which the head stands, and steps still join. Only the times of the answer are moved by it (`head`).
3. Arithmetic between places and verdict: differences, products and square roots of numbers below some
   tens of metres, a few dozen roundings each; 16 of the largest coordinate are allowed for. Bounds on
   speeds and angles are sums of positive terms, widened by 1e-12, far above their own roundings.

A distance of two benches moves by at most twice `lever` times `beside`, `lever` being what a corner
moves when both handles of its bench move by 1; the travel of both in a step by four times `along`.
While slack is not below their sum the search proves what it says. If it is, it is run again with more
slack.

Cells, and the places that only say which pairs are near, are widened by 1e-7 m and need no more.
That benches follow without a leap rests on angles that keep 0.01 rad, and chords that keep 0.1 %, from
the limit: no rounding matters there.

What is taken as exact: the numbers stored for route and benches, so that pitch / 2 pi is the double.
Below: the errors found for the contest's dragon, and the brackets that they allow.
"""

from benchdragon.contact import contact_windows
from benchdragon.ground import Ledger
from benchdragon.plan import read_plan
from benchdragon.prove import errors, needed_slack, prove_contact


def main() -> None:
    """Print what was looked over."""
    walk = read_plan("spiral-in").build()
    ledger = Ledger()
    contact_windows(walk, 390.0, 430.0, most=1, ledger=ledger)
    found = errors(walk, ledger)
    print(f"places enclosed: {found.places}")
    print(f"beside {found.beside:.1e} m, along {found.along:.1e} m, head {found.head:.1e} m")
    print(f"others {found.others:.1e} m (1e-8 m would do)")
    print(f"slack needed: {needed_slack(walk, found, 6.0):.1e} m")
    answer = prove_contact(walk, 390.0, 430.0)
    if answer is not None:
        print(f"first contact {answer.status}: {answer.lower:.13f} .. {answer.upper:.13f} s")


if __name__ == "__main__":
    main()
