"""Random plans as plain data: all kinds of routes, squares, cues and people; some of them are wrong."""

import math
import random
from typing import Any

Tables = dict[str, Any]

FORMATIONS = (
    "coil-in", "coil-out", "figure-eight", "three-plum-blossoms", "double-door", "straight-dragon",
    "tail-swing",
)  # fmt: skip


def length(dice: random.Random, low: float, high: float) -> Any:
    """A length between two, m, sometimes with a unit or as a whole number."""
    value = dice.uniform(low, high)
    form = dice.random()
    if form < 0.15:
        return f"{100.0 * value:.1f} cm"
    if form < 0.25 and high > low + 1.0:
        return max(round(value), 1)
    return round(value, dice.choice([1, 2, 3, 15]))


def dragon(dice: random.Random) -> Tables:
    if dice.random() < 0.2:
        one = {"length": length(dice, 1.2, 3.0), "count": dice.randrange(1, 9)}
        other = {"length": length(dice, 0.8, 2.0), "width": length(dice, 0.1, 0.5), "front_inset": 0.1}
        return {"bench": [one, other, {"length": 3, "rear_inset": "20 cm"}]}
    table: Tables = {"benches": dice.randrange(1, 60)}
    for key, low, high in (
        ("width", 0.1, 0.6), ("head_length", 1.0, 4.0), ("body_length", 0.9, 3.0),
        ("tail_length", 0.9, 3.0), ("front_inset", 0.0, 0.3), ("rear_inset", 0.0, 0.3),
    ):  # fmt: skip
        if dice.random() < 0.4:
            table[key] = length(dice, low, high)
    return table


def part(dice: random.Random) -> Tables:
    kind = dice.choice(["line", "arc", "clothoid", "spiral", "log-spiral"])
    hand = dice.choice([1, -1])
    if kind == "line":
        return {"kind": kind, "length": length(dice, 5.0, 60.0)}
    if kind == "arc":
        return {"kind": kind, "radius": length(dice, 2.5, 12.0), "angle": hand * dice.uniform(10, 300)}
    if kind == "spiral":
        radii = {"start_radius": length(dice, 4.0, 12.0), "end_radius": length(dice, 4.0, 12.0)}
        return {"kind": kind, "pitch": length(dice, 0.6, 2.0), **radii, "clockwise": hand > 0}
    bends = {
        "start_curvature": hand * dice.uniform(0.02, 0.3),
        "end_curvature": hand * dice.uniform(0.02, 0.3),
    }
    return {"kind": kind, "length": length(dice, 3.0, 20.0), **bends}


def formation(dice: random.Random) -> Tables:
    table: Tables = {"name": dice.choice(FORMATIONS)}
    sizes = {
        "coil-in": ["pitch", "outer_radius", "inner_radius", "clockwise"],
        "coil-out": ["pitch", "outer_radius", "clockwise"],
        "double-door": ["pitch", "between", "clockwise"],
        "figure-eight": ["radius", "rounds", "clockwise"],
        "three-plum-blossoms": ["radius", "waist", "rounds", "clockwise"],
        "straight-dragon": ["length"],
        "tail-swing": ["swing", "swings", "run", "radius", "clockwise"],
    }[table["name"]]
    ranges = {
        "pitch": (0.5, 2.0), "outer_radius": (6.0, 20.0), "inner_radius": (2.0, 5.0),
        "between": (0.0, 6.0), "radius": (4.0, 30.0), "waist": (3.0, 12.0), "length": (50.0, 400.0),
        "swing": (1.0, 7.0), "run": (20.0, 200.0),
    }  # fmt: skip
    for size in sizes:
        if dice.random() < 0.5:
            if size in ranges:
                table[size] = length(dice, *ranges[size])
            else:
                table[size] = dice.random() < 0.5 if size == "clockwise" else dice.randrange(1, 4)
    return table


def spiral_route(dice: random.Random) -> Tables:
    table = {"pitch": length(dice, 0.4, 1.5), "start_turn": dice.uniform(4, 18)}
    return table | ({"clockwise": dice.random() < 0.5} if dice.random() < 0.5 else {})


def beside(dice: random.Random, what: str) -> random.Random:
    """Dice for a key that came later: all else of a plan stays what its seed gave before."""
    return random.Random(f"{dice.getstate()[1][1]} {what}")


def turn_route(dice: random.Random) -> Tables:
    table: Tables = {"pitch": length(dice, 1.2, 2.2)}
    dice = beside(dice, "rounds")
    if dice.random() < 0.3:
        table["rounds"] = dice.randrange(1, 5)
        table |= {"outer_radius": length(dice, 5.0, 14.0)} if dice.random() < 0.4 else {}
        table |= {"back_radius": length(dice, 1.0, 3.0)} if dice.random() < 0.4 else {}
    return table


def street(dice: random.Random) -> Tables:
    """A street from outside, which a square may cut."""
    x, y = dice.choice([-1, 1]) * dice.uniform(45, 60), dice.uniform(-30, 30)
    bend = [0.6 * x, dice.uniform(-25, 25)]
    table: Tables = {"points": [[x, y], bend, [0.4 * x, bend[1] + dice.uniform(-4, 4)]]}
    if dice.random() < 0.5:
        table |= {"deviation": length(dice, 0.5, 3.0), "radius": length(dice, 2.0, 5.0)}
    return table | ({"width": length(dice, 2.0, 9.0)} if dice.random() < 0.5 else {})


def parts_route(dice: random.Random) -> Tables:
    table: Tables = {"part": [part(dice) for _n in range(dice.randrange(1, 6))]}
    if dice.random() < 0.4:
        table["start"] = [dice.uniform(-9, 9), dice.randrange(-9, 9)]
    if dice.random() < 0.4:
        table["heading"] = dice.choice([dice.uniform(-200, 200), "0.3 turns", "1.5 rad"])
    return table


def programme_route(dice: random.Random) -> Tables:
    steps = [formation(dice) for _n in range(dice.randrange(1, 4))]
    for step in steps:
        if dice.random() < 0.5:
            step["at"] = [dice.uniform(-60, 60), dice.uniform(-60, 60)]
            step["turned"] = dice.uniform(-180, 180)
    return {"formation": steps, "radius": length(dice, 2.0, 8.0)}


def drawn_route(dice: random.Random) -> Tables:
    points, heading = [[dice.uniform(0, 1), 0]], dice.uniform(-3, 3)
    for _n in range(dice.randrange(2, 12)):
        heading += dice.uniform(-1.2, 1.2)
        step = dice.uniform(4, 25)
        x, y = points[-1]
        points.append([x + step * math.cos(heading), y + step * math.sin(heading)])
    table: Tables = {"points": points, "deviation": length(dice, 0.2, 3.0)}
    if dice.random() < 0.7:
        table["smooth"] = dice.choice(["none", "G1", "G2"])
    if dice.random() < 0.3:
        table["closed"] = True
    if dice.random() < 0.2:
        table |= {"drawn_within": "１ ｃｍ", "least_radius": length(dice, 0.5, 2.0)}
    return table


ROUTES = {
    "spiral-in": spiral_route,
    "turn": turn_route,
    "parts": parts_route,
    "formation": formation,
    "programme": programme_route,
    "drawn": drawn_route,
}


def route(dice: random.Random) -> Tables:
    kind = dice.choice([*ROUTES, "turn", "parts"])
    table = {"kind": kind, **ROUTES[kind](dice)}
    if dice.random() < 0.3:
        table["at"] = dice.choice([[0, 0], [dice.uniform(-20, 20), 3]])
    if dice.random() < 0.3:
        table["turned"] = dice.choice([0, dice.uniform(-180, 180)])
    if kind != "drawn" and beside(dice, "street").random() < 0.2:
        table["street"] = street(beside(dice, "where the street is"))
    return table


def turn(dice: random.Random) -> Tables:
    family = dice.choice(["arc-arc", "arc-line-arc", "arc-arc-arc"])
    table: Tables = {"family": family} if family != "arc-arc" or dice.random() < 0.5 else {}
    if family == "arc-arc" and dice.random() < 0.6:
        table["ratio"] = dice.choice([2, dice.uniform(0.8, 3.0)])
    if family != "arc-arc" and dice.random() < 0.5:
        table["radii"] = [length(dice, 1.6, 2.2), length(dice, 1.6, 2.2)]
    if family == "arc-arc-arc":
        table["curvature"] = dice.uniform(-0.3, 0.3)
    for key in ("entry_radius", "exit_radius"):
        if dice.random() < 0.2:
            table[key] = length(dice, 3.8, 4.5)
    if dice.random() < 0.3:
        table["ease"] = length(dice, 0.2, 1.0)
    return table


def walk(dice: random.Random) -> Tables:
    table: Tables = {}
    if dice.random() < 0.3:
        times = sorted(dice.sample(range(-20, 60), 4))
        table["profile"] = [[time, dice.choice([0, 0.5, dice.uniform(0.2, 2.0)])] for time in times]
        table["profile"][-1][1] = 1
    elif dice.random() < 0.6:
        table["speed"] = dice.choice(["30 m/min", 1, dice.uniform(0.3, 2.0)])
    if dice.random() < 0.3:
        table["start"] = dice.choice([0, "-1 min 5 s", dice.uniform(-50, 5)])
    if dice.random() < 0.3:
        table["end"] = dice.choice(["3 min 12 s", 70, dice.uniform(20, 200)])
    if dice.random() < 0.15:
        table["position"] = dice.uniform(0, 30)
    return table


def obstacle(dice: random.Random) -> Tables:
    kind = dice.choice(["circle", "rectangle", "polygon", "line"])
    x, y = dice.uniform(-30, 30), dice.uniform(-30, 30)
    table: Tables = {"kind": kind}
    if kind == "circle":
        table |= {"centre": [x, y], "radius": length(dice, 0.3, 3.0)}
    elif kind == "rectangle":
        table |= {"centre": [x, y], "size": [length(dice, 0.5, 4.0), 1], "angle": dice.uniform(0, 90)}
    else:
        corners = [[x, y], [x + 3, y + dice.uniform(-1, 1)], [x + dice.uniform(-1, 4), y + 4]]
        table["points"] = corners + ([[x + 1, y + 1]] if dice.random() < 0.2 else [])
    if dice.random() < 0.3:
        table["name"] = dice.choice(["well", "井", "stage"])
    if dice.random() < 0.3:
        table["margin"] = length(dice, 0.1, 0.5)
    return table


def cues(dice: random.Random) -> Tables:
    found: list[Tables] = []
    time = 5.0
    for n in range(dice.randrange(1, 5)):
        time += dice.uniform(4, 15)
        where: Tables = {"at": round(time, 2)} if dice.random() < 0.6 else {"head": round(time, 2)}
        later = beside(dice, f"cue {n}")
        if later.random() < 0.2:
            where = {"round": later.randrange(1, 3)} if later.random() < 0.5 else {}
            where |= {"place": [later.uniform(-9, 9), later.uniform(-9, 9)]}
        kind = dice.choice(["beat", "hold", "stop", "note", "tempo"])
        more: Tables = {"hold": dice.uniform(1, 5)} if kind == "hold" else {}
        more |= {"tempo": dice.randrange(60, 140)} if kind == "tempo" else {}
        found.append({"kind": kind, **where, **more})
        if kind == "stop":
            time += dice.uniform(8, 20)
            found.append({"kind": "start", "at": round(time, 2), "text": "go"})
    table: Tables = {"cue": found}
    if dice.random() < 0.3:
        table["tempo"] = dice.uniform(60, 120)
    if dice.random() < 0.3:
        table |= {"bar": dice.choice([3, 4]), "clock": "２４:００"}
    if dice.random() < 0.3:
        table["acceleration"] = dice.uniform(0.2, 0.5)
    return table


def plan(seed: int, wrong: float = 0.1) -> Tables:
    """The plan of a seed, into which something wrong is put at a probability."""
    dice = random.Random(seed)
    data: Tables = {"schema": 1, "route": route(dice), "dragon": dragon(dice), "walk": walk(dice)}
    kind = data["route"]["kind"]
    if kind == "turn":
        data["turn"] = turn(dice)
    if kind in ("turn", "spiral-in") and dice.random() < 0.4:
        data["disc"] = {"radius": dice.choice([4.5, length(dice, 4.2, 6.0)])}
    if dice.random() < 0.4:
        data["limits"] = {"speed": "2 m/s", "margin": length(dice, 0.02, 0.2)}
    if dice.random() < 0.25:
        data["venue"] = {"rectangle": [80, 70.5], "angle": dice.uniform(0, 90)}
        data.setdefault("limits", {})["venue_margin"] = "50 cm"
    if dice.random() < 0.3:
        data["obstacle"] = [obstacle(dice) for _n in range(dice.randrange(1, 4))]
    if dice.random() < 0.3:
        data["cues"] = cues(dice)
    if dice.random() < 0.2:
        data["people"] = {"beside": "40 cm", "sway": length(dice, 0.1, 0.3), "unit": "qiao"}
        data["people"]["count_head"] = dice.random() < 0.5
    if dice.random() < wrong:
        spoil(dice, data)
    return data


WRONG: tuple[Any, ...] = (None, "", "x", -1, 0, 1e-9, 10**12, True, [], {}, "3 lb", [1, 2, 3], 2.5)


def spoil(dice: random.Random, data: Tables) -> None:
    """Put something wrong under a key, or under one that is not known, or take one out."""
    name = dice.choice(list(data))
    table = data[name]
    if isinstance(table, list):
        table = dice.choice(table)
    if not isinstance(table, dict) or not table:
        data[name] = dice.choice(WRONG)
        return
    key = dice.choice(list(table))
    choice = dice.random()
    if choice < 0.5:
        table[key] = dice.choice(WRONG)
    elif choice < 0.75:
        table[key[:-1] + "x"] = table[key]
    else:
        del table[key]
