"""Why a proof needs no second search: places are looked over afterwards, in ball arithmetic.

The search (design/first_contact.py) draws its conclusions with bounds that hold for the exact chain,
from chains computed in doubles; it leaves room for `slack` metres in every distance. Afterwards each
computed handle is compared with the exact one, in ball arithmetic with 100 bits:

1. The head. What its computed place is off the route position that was asked for is its error along the
   route, with what that position is off the exact one at the times between which is searched.
2. The handles behind. From the enclosed place of the handle before (a ball of 1e-28 m), one Newton step
   leads to the exact place of the next; what the distance of the two then misses the link by, and the
   error of the handle before times its cosine, divided by the cosine at the rear, bounds what is left.
   The difference to the computed point is its error (`beside`), the difference of parameters times the
   arc per parameter its error along the route (`along`).
3. Joints. Where headings or places of two rows differ by rounding, every handle is off by as much more.
   Where a heading jumps by more and a handle may stand on either side of the kink, nothing is proved.
4. A distance of two benches moves by at most twice `lever` times `beside`, `lever` being what a corner
   moves when both handles of its bench move by 1; half the travel of both in a step by twice `lever`
   times `along`. While slack is not below their sum the search proves what it says. If it is, it is run
   again with more slack.
5. Cells, and the places that only say which pairs are near, are looked over too; they are widened by
   1e-7 m, and a tenth of that would do.

What is not done in balls, and said with every answer:

* Arithmetic between places and distances: differences, products and square roots of numbers below some
  tens of metres, a few dozen roundings each; 16 of the largest coordinate are allowed for.
* Bounds on speeds, angles and accelerations in a step: sums of positive terms, taken from the computed
  places and widened by 1e-12; unless a bench stands nearly square to the route that is far above what
  places are off by.
* Which benches can meet: boxes, widened by 1e-7 m. Turns of a spiral that cannot touch rest on no
  place: a closed form holds there with 1e-9 m to spare.
* That each handle stands at the nearest place one link behind, and follows without a leap: angles keep
  0.01 rad, and chords 0.1 %, from the limit.

What is taken as exact: the numbers stored for route and benches, so that pitch / 2 pi is the double.
Below: the errors found for the contest's dragon, and the brackets that they allow.
"""

from benchdragon.analysis.contact import contact_windows
from benchdragon.analysis.ledger import Ledger
from benchdragon.analysis.proof import errors, needed_slack, prove_contact
from benchdragon.plans.schema import read_plan


def main() -> None:
    """Print what was looked over."""
    walk = read_plan("spiral-in").build()
    ledger = Ledger()
    contact_windows(walk, 390.0, 430.0, most=1, ledger=ledger)
    found = errors(walk, ledger)
    print(f"places enclosed: {found.places}")
    print(f"beside {found.beside:.1e} m, along {found.along:.1e} m")
    print(f"others {found.others:.1e} m (1e-8 m would do)")
    print(f"slack needed: {needed_slack(walk, found, 6.0):.1e} m")
    answer = prove_contact(walk, 390.0, 430.0)
    if answer is not None:
        print(f"first contact {answer.status}: {answer.lower:.13f} .. {answer.upper:.13f} s")


if __name__ == "__main__":
    main()
