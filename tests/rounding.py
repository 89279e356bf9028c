"""How wide a bracket must be at least: by how much computed distances may be off where it was found."""

from benchdragon.analysis.contact_search import SLACK
from benchdragon.analysis.distance import boxes, nearness
from benchdragon.analysis.nearby import errors_at
from benchdragon.model.answer import Witness
from benchdragon.model.walk import Walk


def pair_off(walk: Walk, found: Witness, slack: float = SLACK) -> float:
    """What the distance of the witness's two benches may be off by, m; `slack` at least."""
    i, j = (number - 1 for number in found.benches)
    off = errors_at(walk, found.s)[1]
    return max(slack, float(off[i] + off[j]))


def closing_rate(walk: Walk, found: Witness, step: float = 1e-5) -> float:
    """How fast the witness's benches come nearer before they are where they were found, m per m."""
    i, j = (number - 1 for number in found.benches)
    farther, nearer = (
        nearness(boxes(walk.placement([found.s - n * step]), 0), i, j).distance for n in (2, 1)
    )
    return (farther - nearer) / step
