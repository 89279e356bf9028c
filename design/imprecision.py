"""How densely must random dances be evaluated, and what does it cost that no contact is missed?

Run: python design/imprecision.py

1. Evaluations each metre of the head lose little on a spiral, less than a millimetre, because benches
   of neighbouring turns slide along one another. Round a turn a corner passes a bench within
   decimetres: there they lose centimetres. No fixed distance keeps a stated error on every route.
2. So handles walk on curves parallel to the route, which makes the bounds of exact dances hold for
   them (kernels/perturbed.py): what a step may hide is bounded and halved. Boxing cells of the route
   for each bench, as for exact dances, would cost benches times cells; all pairs of a step cost less.
   Steps of an eighth of the shortest link are best: longer ones leave bounds too loose for the tail.
3. The pitch needed is sought with evaluations here and there, which is cheap, and the search that
   misses nothing is asked once or twice, at the end. Without deviations it gives what `solve pitch`
   gives.
4. On an inward spiral a bound in closed form (solve/dance_bound.py) leaves little to be searched near
   the pitch needed: a few benches near the centre where sizes vary, a third of the dance where all of
   its handles are off the route.
"""

import time

import numpy as np

from benchdragon.plans.schema import read_plan
from benchdragon.solve import random_dance as module
from benchdragon.solve.random_dance import RandomDance
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import CASES, Deviations, Draw, needed_pitch, random_dance

DRAWS = 5
PLANS = {
    "spiral-in": ("spiral-in", ["disc.radius=4.5", "route.pitch=0.55"]),
    "turn": ("turn", ["route.pitch=1.4"]),
}


def evaluated(dance: RandomDance, step: float) -> float:
    """The least distance at places of the head so far apart, m."""
    grid = np.linspace(dance.start, dance.end, 2 + int((dance.end - dance.start) / step))
    return min(dance.nearest(at)[0].distance for at in np.array_split(grid, 1 + len(grid) // 500))


def losses() -> None:
    """How much evaluations miss."""
    print("1. how much nearer benches come than evaluations say, mm: median, greatest")
    for name, (kind, settings) in PLANS.items():
        dances = [
            random_dance(read_plan(kind, settings), Draw(CASES["aside"].deviations, 1, n))
            for n in range(DRAWS)
        ]
        true = [dance.least() for dance in dances]
        for step in (1.0, 0.2, 0.05):
            lost = [
                1e3 * (evaluated(dance, step) - least)
                for dance, least in zip(dances, true, strict=True)
            ]
            print(f"   {name:10} each {step:4g} m: {np.median(lost):9.4f} {max(lost):9.4f}")


def steps() -> None:
    """What the search costs by the length of its steps."""
    print("2. seconds of a search that misses nothing, by steps as a share of the shortest link")
    chosen = module.STEP
    for name, (kind, settings) in PLANS.items():
        dance = random_dance(read_plan(kind, settings), Draw(CASES["aside"].deviations, 1, 0))
        dance.touch()
        for share in (0.06, 0.09, 0.125, 0.18, 0.25):
            module.STEP = share
            began = time.thread_time()
            dance.touch()
            print(f"   {name:10} {share:5g}: {time.thread_time() - began:.3f}")
    module.STEP = chosen


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
    print("4. share of each dance that is left to be searched, for five dances, by pitch")
    for name, case in CASES.items():
        for pitch in (0.46, 0.48, 0.5, 0.55):
            plan = read_plan("spiral-in", ["disc.radius=4.5", f"route.pitch={pitch}"])
            shares = []
            for n in range(DRAWS):
                dance = random_dance(plan, Draw(case.deviations, 1, n))
                parts = dance.open(1e-6) if dance.open else ()
                work = sum((part.end - part.start) * part.count for part in parts)
                shares.append(work / ((dance.end - dance.start) * len(dance.dragon)))
            print(f"   {name:8} {pitch:4g} m: " + " ".join(f"{share:.3f}" for share in shares))


if __name__ == "__main__":
    losses()
    steps()
    pitches()
    left()
