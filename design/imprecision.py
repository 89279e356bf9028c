"""How densely must random dances be evaluated, and what does it cost that no contact is missed?

Run it from the project's folder, as `python -m design.imprecision`.

1. Evaluations each metre of the head lose little on a spiral, less than a millimetre, because benches
   of neighbouring turns slide along one another. Round a turn a corner passes a bench within
   decimetres: there they lose centimetres. No fixed distance keeps a stated error on every route.
2. So handles walk on curves parallel to the route, which makes the bounds of exact dances hold for
   them (kernels/stray_chain.py): what a step may hide is bounded and halved. Boxing cells of the route
   for each bench, as for exact dances, would cost benches times cells; all pairs of a step cost less.
   Steps of an eighth of the shortest link are best: longer ones leave bounds too loose for the tail.
3. The pitch needed is sought with evaluations here and there, which is cheap, and the search that
   misses nothing is asked once or twice, at the end. Without deviations it gives what `solve pitch`
   gives.
4. On an inward spiral a bound in closed form (kernels/random_dance_bound.py) leaves little to be
   searched near the pitch needed: a few benches near the centre where sizes vary, a quarter of the
   dance or more where its handles are off the route, nearly all of it where everything deviates.
"""

import time

import numpy as np
from tests.solve.dances import Laid, brute, laid, open_parts

from benchdragon.kernels import time_of_impact
from benchdragon.kernels.every_pair import search_all_pairs
from benchdragon.kernels.time_of_impact import Goal
from benchdragon.plans.schema import read_plan
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, Deviations, Draw, needed_pitch

DRAWS = 5
PLANS = {
    "spiral-in": ("spiral-in", ["disc.radius=4.5", "route.pitch=0.55"]),
    "turn": ("turn", ["route.pitch=1.4"]),
}


def losses() -> None:
    """How much evaluations miss."""
    print("1. how much nearer benches come than evaluations say, mm: median, greatest")
    for name, (kind, settings) in PLANS.items():
        plan = read_plan(kind, settings)
        dances = [laid(plan, Draw(CASES["aside"].deviations, 1, n)) for n in range(DRAWS)]
        true = [brute(dance) for dance in dances]
        for step in (1.0, 0.2, 0.05):
            pairs = zip(dances, true, strict=True)
            lost = [1e3 * (brute(dance, step) - least) for dance, least in pairs]
            print(f"   {name:10} each {step:4g} m: {np.median(lost):9.4f} {max(lost):9.4f}")


def searched(dance: Laid, share: float) -> int:
    """Search a whole dance by steps of that share of the shortest link; how that ended."""
    benches, links = len(dance.dragon), dance.dragon.links
    first, second = np.empty((2, 24 * benches), dtype=np.int64)
    steps = 2 + int((dance.end - dance.start) / (share * float(links.min())))
    return search_all_pairs(
        time_of_impact.empty_search(benches + 1, benches, first.size), Goal.FIRST_TOUCH,
        dance.rows, links, dance.aside, dance.dragon.sizes, np.linspace(dance.start, dance.end, steps),
        first, second, 0.0, 1e-7, 1e-8, 20_000, np.zeros(time_of_impact.NOTES),
    )  # fmt: skip


def steps() -> None:
    """What the search costs by the length of its steps."""
    print("2. seconds of a search that misses nothing, by steps as a share of the shortest link")
    for name, (kind, settings) in PLANS.items():
        dance = laid(read_plan(kind, settings), Draw(CASES["aside"].deviations, 1, 0))
        for share in (0.06, 0.09, 0.125, 0.18, 0.25):
            began = time.thread_time()
            searched(dance, share)
            print(f"   {name:10} {share:5g}: {time.thread_time() - began:.3f}")


def pitches() -> None:
    """Pitches needed, and what each costs."""
    print("3. the pitch needed, m, and seconds a dance; the first line without deviations")
    for name, (kind, settings) in PLANS.items():
        plan = read_plan(kind, settings)
        exact = limit(plan, "pitch").value
        print(f"   {name}: solve pitch says {exact:.6f}")
        for case in (
            Deviations(),
            CASES["aside"].deviations,
            CASES["stray"].deviations,
            CASES["all"].deviations,
        ):
            began = time.thread_time()
            needed = needed_pitch(plan, Draw(case, 1, 0), exact)
            print(f"   {needed:.6f} {time.thread_time() - began:.2f}")


def left() -> None:
    """How much of dances must be searched: head's way times benches, as a share of all."""
    print("4. share of a dance that is left to be searched, by pitch")
    for name, case in CASES.items():
        for pitch in (0.46, 0.48, 0.5, 0.55):
            plan = read_plan("spiral-in", ["disc.radius=4.5", f"route.pitch={pitch}"])
            draw = Draw(case.deviations, 1, 0)
            dance, (parts,) = laid(plan, draw), open_parts(plan, draw, (1e-6,))
            work = float((parts[:, 1] - parts[:, 0]) @ parts[:, 2])
            whole = (dance.end - dance.start) * len(dance.dragon)
            print(f"   {name:8} {pitch:4g} m: {work / whole:.3f}")


if __name__ == "__main__":
    losses()
    steps()
    pitches()
    left()
