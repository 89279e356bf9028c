"""Keys of plans that have no effect beside what else a plan chooses."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from benchdragon.i18n import _


@dataclass(frozen=True)
class Idle:
    """A key that has no effect beside what a plan chooses.

    Attributes:
        path: of the key, table by table; a name may hold dots.
        beside: the key of the choice.
        because: "KEY = VALUE" of the choice.
        missing: whether the key has no effect without it.
    """

    path: tuple[str | int, ...]
    beside: str
    because: str
    missing: bool = False

    @property
    def key(self) -> str:
        """The dotted key."""
        return ".".join(map(str, self.path))

    @property
    def text(self) -> str:
        """The same in a sentence, in the language in use."""
        if self.missing:
            text = _("{key} has no effect without one of {because}: take it out, or say one of them")
            return text.format(key=self.key, because=self.because)
        text = _("{key} has no effect beside {because}: take it out")
        return text.format(key=self.key, because=self.because)


# Keys of [turn] that belong to some families alone.
FAMILIES = {
    "ratio": ("arc-arc",),
    "radii": ("arc-line-arc", "arc-arc-arc"),
    "curvature": ("arc-arc-arc",),
}

# Sizes of formations, which belong to some of them alone.
FORMATION_SIZES = {
    "coil-in": ("pitch", "outer_radius", "inner_radius", "clockwise"),
    "coil-out": ("pitch", "inner_radius", "outer_radius", "clockwise"),
    "figure-eight": ("radius", "rounds", "clockwise"),
    "three-plum-blossoms": ("radius", "waist", "rounds", "clockwise"),
    "double-door": ("pitch", "outer_radius", "inner_radius", "between", "clockwise"),
    "straight-dragon": ("length",),
    "tail-swing": ("swing", "radius", "swings", "run", "clockwise"),
}
ALL_SIZES = frozenset(size for sizes in FORMATION_SIZES.values() for size in sizes)
# Keys of a drawn route that have no effect beside its points, pieces or file.
DRAWN = {
    "points": ("piece", "file", "layer", "joint_gap", "joint_kink"),
    "piece": ("points", "file", "layer"),
    "file": ("points", "piece"),
}


# Tables of which some keys have no effect beside others.
CHOOSING = ("dragon", "route", "disc", "turn", "walk", "venue", "limits")


def idle_keys(data: dict[str, Any], latest: Sequence[str] = ()) -> list[Idle]:
    """The keys of a plan's tables that have no effect beside others; None counts as not said.

    What a table chooses decides, not its numbers: a body's length is no error where a head and a tail
    are all there is. Of several ways to say a drawing that under `latest` keys, just said, is chosen.
    """
    tables = {name: _said(data.get(name)) for name in CHOOSING}
    route, turn = tables["route"], tables["turn"]
    kind = "parts" if "part" in route else route.get("kind")
    found = []
    if kind in ("parts", "drawn", "spiral-in", "formation", "programme"):
        idle = [("turn", name) for name in turn]
        idle += [("disc", name) for name in tables["disc"]] if kind != "spiral-in" else []
        found += [Idle(path, "route.kind", f'route.kind = "{kind}"') for path in idle]
    if kind == "turn":
        family = turn.get("family", "arc-arc")
        strays = [
            name for name, families in FAMILIES.items() if name in turn and family not in families
        ]
        found += [Idle(("turn", name), "turn.family", f'turn.family = "{family}"') for name in strays]
        found += _idle_back(route)
    if kind == "formation":
        found += _idle_sizes(route, ("route",))
    if kind == "programme" and isinstance(route.get("formation"), list):
        for i, one in enumerate(route["formation"]):
            found += _idle_sizes(_said(one), ("route", "formation", i))
    found += _idle_drawing(route, "route", latest) if kind == "drawn" else []
    found += _idle_drawing(_said(route.get("street")), "route.street", latest)
    if tables["walk"].get("profile") and "speed" in tables["walk"]:
        found.append(Idle(("walk", "speed"), "walk.profile", "walk.profile"))
    if tables["dragon"].get("bench"):
        others = [("dragon", name) for name in tables["dragon"] if name != "bench"]
        found += [Idle(path, "dragon.bench", "[[dragon.bench]]") for path in others]
    return found + _idle_on_the_square(tables["venue"], tables["limits"])


def _idle_on_the_square(venue: dict[str, Any], limits: dict[str, Any]) -> list[Idle]:
    """The keys about the venue's edge that have no effect beside others, or without them."""
    found = []
    others: list[tuple[str, str]]
    if "boundary" in venue:
        others = [("venue", name) for name in ("rectangle", "centre", "angle") if name in venue]
        found += [Idle(path, "venue.boundary", "venue.boundary") for path in others]
    elif "rectangle" not in venue and "file" not in venue:
        others = [("venue", name) for name in ("centre", "angle") if name in venue]
        others += [("venue", "name")] if venue.get("name") else []
        others += [("limits", "venue_margin")] if "venue_margin" in limits else []
        found += [
            Idle(path, "venue", "venue.rectangle, venue.boundary, venue.file", missing=True)
            for path in others
        ]
    if "layer" in venue and "file" not in venue:
        found.append(Idle(("venue", "layer"), "venue", "venue.file", missing=True))
    return found


def _idle_back(route: dict[str, Any]) -> list[Idle]:
    """The keys of a coil about how the head turns back, where it never does and no street leads in."""
    rounds, street = route.get("rounds"), "street" in route
    if isinstance(rounds, int) and rounds > 1:
        return []
    names = ["back_radius"] if street else ["back_radius", "outer_radius"]
    because = "route.rounds" if street else "route.rounds, route.street"
    strays = [name for name in names if name in route]
    return [Idle(("route", name), "route.rounds", because, missing=True) for name in strays]


def _idle_drawing(table: dict[str, Any], where: str, latest: Sequence[str]) -> list[Idle]:
    """The keys of a drawing, in the table of such a name, that have no effect beside others."""
    ways = sorted(DRAWN, key=lambda name: f"{where}.{name}" not in latest)
    chosen = next((name for name in ways if name in table), "")
    idle = [(*where.split("."), name) for name in DRAWN.get(chosen, ()) if name in table]
    return [Idle(path, f"{where}.{chosen}", f"{where}.{chosen}") for path in idle]


def _idle_sizes(table: dict[str, Any], path: tuple[str | int, ...]) -> list[Idle]:
    """The sizes in a formation's table that its formation does not have."""
    own = FORMATION_SIZES.get(str(table.get("name")))
    strays = [] if own is None else [name for name in table if name in ALL_SIZES and name not in own]
    beside = ".".join(map(str, (*path, "name")))
    because = f'{beside} = "{table.get("name")}"'
    return [Idle((*path, name), beside, because) for name in strays]


def _said(table: object) -> dict[str, Any]:
    if not isinstance(table, dict):
        return {}
    return {name: value for name, value in table.items() if value is not None}


def drop(data: dict[str, Any], idle: Sequence[Idle]) -> None:
    """Take keys out of a plan's tables."""
    for one in idle:
        table: Any = data
        for folder in one.path[:-1]:
            table = table[folder]
        del table[one.path[-1]]


def drop_replaced(data: dict[str, Any], keys: Sequence[str]) -> None:
    """Take out of a plan's tables what has no effect beside the choices under `keys`, just made."""
    made = set(keys)
    drop(data, [idle for idle in idle_keys(data, keys) if idle.beside in made and idle.key not in made])
