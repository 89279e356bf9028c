"""What every key of a plan file means: its section, text, unit and an example."""

from collections.abc import Mapping
from dataclasses import dataclass

from benchdragon.i18n import N_
from benchdragon.plans.chalk import ChalkTable
from benchdragon.plans.cues import CuesTable, CueTable
from benchdragon.plans.drawn import PieceTable, SurveyTable
from benchdragon.plans.event import EventTable
from benchdragon.plans.faults import kinds_of
from benchdragon.plans.formations import StepTable
from benchdragon.plans.people import PeopleTable, SourcesTable
from benchdragon.plans.routes import (
    DrawnRoute,
    FormationRoute,
    PartsRoute,
    ProgrammeRoute,
    SpiralInRoute,
    StreetTable,
    TurnRoute,
)
from benchdragon.plans.schema import Plan
from benchdragon.plans.square import OBSTACLE_KEYS, OBSTACLES, ObstacleTable, VenueTable
from benchdragon.plans.tables import (
    PARTS,
    BenchTable,
    CurvePart,
    DiscTable,
    DragonTable,
    Key,
    LimitsTable,
    MetaTable,
    Table,
    TurnTable,
    WalkTable,
)


@dataclass(frozen=True)
class Section:
    """A table of plan files: its header, which may name a kind, what it is for, and its keys."""

    header: str
    text: str
    table: type[Table]
    keys: Mapping[str, Key]


INSETS = {
    "front_inset": Key(N_("from the front edge to the front hole"), "27.5 cm", "m"),
    "rear_inset": Key(N_("from the rear edge to the rear hole"), "27.5 cm", "m"),
}


PLACED = {
    "at": Key(N_("where the origin of the dance lies on the square, x and y"), [6, -2], "m"),
    "turned": Key(N_("angle by which the whole dance is turned, to the left"), 30, "deg"),
}


STREETED = {
    "street": Key(
        N_("a street that is walked first: see [route.street]"), {"points": [[-40, 0], [-15, 0]]}
    ),
    **PLACED,
}
DRAWING = {
    "points": Key(N_("points of the line, each x and y"), [[0, 0], [12, 0], [20, 6]], "m"),
    "piece": Key(
        N_("its surveyed parts, in place of points: see [[route.piece]]"),
        [{"start": [0, 0], "heading": 0, "length": 12}],
    ),
    "file": Key(
        N_("a CSV, GeoJSON, KML, LandXML, DXF or SVG file beside the plan, in place of points"),
        "walk.geojson",
    ),
    "layer": Key(N_("layer or name of the line in the file, where it holds several"), "route"),
    "deviation": Key(N_("most by which the route and the drawing may differ"), "20 cm", "m"),
    "smooth": Key(
        N_("none: as drawn, clothoids through points; G1: corners by arcs; G2: by clothoids"), "G2"
    ),
    "least_radius": Key(
        N_("radius that every bend must have at least; else half the longest link"), 1.5, "m"
    ),
    "joint_gap": Key(N_("how far apart surveyed parts may be where they are joined"), "5 mm", "m"),
    "joint_kink": Key(N_("largest kink between parts that is straightened"), 0.05, "deg"),
    "drawn_within": Key(
        N_("how far points may lie from what was drawn; counts as deviation"), "1 mm", "m"
    ),
}


def _obstacle_section(obstacle: type[ObstacleTable]) -> Section:
    (kind,) = kinds_of(obstacle)
    means = {"kind": Key(N_("kind of the obstacle"), kind), **obstacle.keys, **OBSTACLE_KEYS}
    return Section(f'[[obstacle]] kind = "{kind}"', obstacle.about, obstacle, means)


SIZES = {
    "name": Key(N_("name of the formation: see `benchdragon formations`"), "coil-in"),
    "pitch": Key(N_("of coils: distance between neighbouring turns of the spiral"), "80 cm", "m"),
    "outer_radius": Key(N_("of coils: radius at the outer end"), 12, "m"),
    "inner_radius": Key(N_("of coils: radius at the inner end"), 3, "m"),
    "between": Key(N_("of double-door: distance between the coils' outer circles"), 2, "m"),
    "radius": Key(
        N_("of figure-eight, tail-swing: radius of the bends; of three-plum-blossoms: of the petals"),
        20, "m",
    ),
    "waist": Key(N_("of three-plum-blossoms: radius of the bends between the petals"), 6, "m"),
    "length": Key(N_("of straight-dragon: length of the line"), 300, "m"),
    "swing": Key(N_("of tail-swing: how wide the tail swings from side to side"), 4.5, "m"),
    "swings": Key(N_("of tail-swing: how many times it swings to the other side"), 6),
    "run": Key(N_("of tail-swing: length of the lines before and behind the bends"), 100, "m"),
    "rounds": Key(N_("of figure-eight and three-plum-blossoms: how many rounds are walked"), 2),
    "clockwise": Key(
        N_("of all but straight-dragon: whether the first bend is walked clockwise; else so"), False
    ),
}  # fmt: skip


def _part_section(part: type[CurvePart]) -> Section:
    (kind,) = kinds_of(part)
    means = {"kind": Key(N_("kind of the part"), kind), **part.keys}
    return Section(f'[[route.part]] kind = "{kind}"', part.about, part, means)


SECTIONS = (
    Section(
        "", N_("The plan itself."), Plan,
        {
            "schema": Key(N_("version of the format: always 1, in the first line"), 1),
            "base": Key(
                N_("a plan that this one adds to: a built-in one, or a file beside it"), "spiral-in"
            ),
        },
    ),
    Section(
        "[meta]", N_("What people call the plan; without effect on the dance."), MetaTable,
        {
            "title": Key(N_("title in English"), "Coiling in"),
            "title_zh": Key(N_("title in Chinese"), "盘入"),
            "author": Key(N_("who made the plan"), "Li"),
            "notes": Key(N_("anything worth keeping"), "walked in 2024"),
        },
    ),
    Section(
        "[dragon]", N_("The benches, where all but head and tail are alike."), DragonTable,
        {
            "benches": Key(N_("number of benches, head and tail included"), 223),
            "width": Key(N_("width of every bench"), "30 cm", "m"),
            "head_length": Key(N_("length of the head's bench"), 3.41, "m"),
            "body_length": Key(N_("length of the benches between head and tail"), 2.2, "m"),
            "tail_length": Key(N_("length of the tail's bench"), 2.2, "m"),
            **INSETS,
            "bench": Key(N_("every bench its own sizes: see [[dragon.bench]]"), [{"length": 3.41}]),
        },
    ),
    Section(
        "[[dragon.bench]]",
        N_("A bench of its own sizes, head first; in place of the keys of [dragon]."), BenchTable,
        {
            "length": Key(N_("length of the bench"), "2 m", "m"),
            "width": Key(N_("width of the bench"), "20 cm", "m"),
            **INSETS,
            "count": Key(N_("how many such benches follow one another"), 25),
        },
    ),
    Section(
        '[route] kind = "spiral-in"', N_("In along one spiral, to the disc or to the centre."),
        SpiralInRoute,
        {
            "kind": Key(N_("kind of the route"), "spiral-in"),
            "pitch": Key(N_("distance between neighbouring turns of the spiral"), "55 cm", "m"),
            "start_turn": Key(N_("turns from the centre to where the head starts"), 16),
            "clockwise": Key(N_("whether the dragon coils in clockwise"), True),
            **STREETED,
        },
    ),
    Section(
        '[route] kind = "turn"',
        N_("In along a spiral, through the turn of [turn], out along the spiral's twin."), TurnRoute,
        {
            "kind": Key(N_("kind of the route"), "turn"),
            "pitch": Key(N_("distance between neighbouring turns of both spirals"), "1.7 m", "m"),
            "rounds": Key(N_("how many times the dance coils in and out"), 3),
            "outer_radius": Key(
                N_("radius at which the head goes back in; else where the whole dragon is out"), 9, "m"
            ),
            "back_radius": Key(
                N_("radius of the bend by which it goes back; else as in the turn"), 1.5, "m"
            ),
            **STREETED,
        },
    ),
    Section(
        '[route] kind = "parts"', N_("Any parts, each moved to where the one before it ends."),
        PartsRoute,
        {
            "kind": Key(N_("kind of the route; may be left out beside parts"), "parts"),
            "part": Key(N_("the parts in walking order: see [[route.part]]"), [{"kind": "line"}]),
            "start": Key(N_("where the route starts, x and y"), [0, 0], "m"),
            "heading": Key(N_("direction in which it starts, from x to y"), 90, "deg"),
            **STREETED,
        },
    ),
    *(_part_section(part) for part in PARTS),
    Section(
        '[route] kind = "formation"',
        N_("One formation by its name; sizes that are not said are as `benchdragon formations` lists."),
        FormationRoute,
        {"kind": Key(N_("kind of the route"), "formation"), **SIZES, **STREETED},
    ),
    Section(
        '[route] kind = "programme"',
        N_("Formations one after another, joined by the shortest connections of arcs and lines."),
        ProgrammeRoute,
        {
            "kind": Key(N_("kind of the route"), "programme"),
            "formation": Key(
                N_("the formations in order: see [[route.formation]]"), [{"name": "coil-in"}]
            ),
            "radius": Key(N_("radius of the arcs of the connections"), 3, "m"),
            **STREETED,
        },
    ),
    Section(
        '[route] kind = "drawn"', N_("Near a line that was drawn or surveyed."), DrawnRoute,
        {
            "kind": Key(N_("kind of the route"), "drawn"),
            **DRAWING,
            "closed": Key(N_("whether the line ends where it starts"), True),
            **PLACED,
        },
    ),
    Section(
        "[route.street]",
        N_("A street that is walked before the dance, from outside the square or on it; it lies where "
           "it was drawn, wherever the dance is moved to."),
        StreetTable,
        {
            **DRAWING,
            "radius": Key(N_("radius of the arcs by which it leads to the dance"), 3, "m"),
            "width": Key(N_("width of the opening by which it leads through the venue's edge"), 6, "m"),
        },
    ),
    Section(
        "[[route.formation]]", N_("A formation of a programme, and where it is danced."), StepTable,
        {
            **SIZES,
            "at": Key(
                N_("where its centre lies, x and y; else it begins where the one before it ends"),
                [7.5, 0], "m",
            ),
            "turned": Key(N_("by how much it is turned about its centre; beside at alone"), 180, "deg"),
        },
    ),
    Section(
        "[[route.piece]]", N_("A surveyed line, arc or clothoid; curvatures are positive to the left."),
        PieceTable,
        {
            "start": Key(N_("where it starts, x and y"), [0, 0], "m"),
            "heading": Key(N_("direction in which it starts, from x to y"), 90, "deg"),
            "length": Key(N_("length of the part"), 12, "m"),
            "start_curvature": Key(N_("curvature at its start; positive to the left"), 0, "1/m"),
            "end_curvature": Key(N_("curvature at its end; positive to the left"), 0.125, "1/m"),
        },
    ),
    Section(
        "[survey]", N_("What the coordinates of the plan's files mean; one origin for all of them."),
        SurveyTable,
        {
            "crs": Key(
                N_("wgs84, gcj02, bd09 or a code such as EPSG:4549; y points north; else plain metres"),
                "gcj02",
            ),
            "unit": Key(N_("of files that do not say it: m, cm, mm, km, in, ft or us-ft"), "mm"),
            "origin": Key(
                N_("what lies at (0, 0) in the plan: x and y of the file, or longitude and latitude"),
                [120.15, 28.92],
            ),
        },
    ),
    Section(
        "[disc]", N_("The turning disc: a circle about the spiral's centre; not beside parts."),
        DiscTable,
        {"radius": Key(N_("its radius; for a turn 4.5 m where nothing is said"), 4.5, "m")},
    ),
    Section(
        "[turn]", N_('The turn between the spirals; beside route.kind = "turn" alone.'), TurnTable,
        {
            "family": Key(N_("arc-arc, arc-line-arc or arc-arc-arc"), "arc-line-arc"),
            "ratio": Key(N_("first radius over second; of arc-arc alone"), 2),
            "radii": Key(N_("radii of the first and the last arc; not of arc-arc"), [2, 2], "m"),
            "curvature": Key(N_("of the middle arc, positive left; of arc-arc-arc alone"), 0.1, "1/m"),
            "entry_radius": Key(N_("radius at which it leaves the spiral; else the disc's"), 4.2, "m"),
            "exit_radius": Key(N_("radius at which it joins the other; else as it left"), 4.2, "m"),
            "ease": Key(N_("length of clothoids between its pieces"), 0.5, "m"),
        },
    ),
    Section(
        "[walk]", N_("The head's walk."), WalkTable,
        {
            "speed": Key(N_("constant speed of the head; not beside walk.profile"), 0.6, "m/s"),
            "profile": Key(
                N_("times and speeds of the head, joined by straight lines"), [[0, 0], [5, 0.6]],
                "s, m/s",
            ),
            "start": Key(N_("when the walk starts; else at 0"), -100, "s"),
            "end": Key(N_("when the walk ends; else where the route's kind says"), "3 min 12 s", "s"),
            "position": Key(
                N_("route position of the head at time 0; else where the route's kind says"), 20, "m"
            ),
        },
    ),
    Section(
        "[limits]", N_("What the walk must keep."), LimitsTable,
        {
            "speed": Key(N_("greatest speed of any handle"), 2, "m/s"),
            "acceleration": Key(N_("greatest acceleration of any handle along the route"), 1, "m/s^2"),
            "lateral_acceleration": Key(N_("greatest lateral acceleration of any handle"), 1, "m/s^2"),
            "total_acceleration": Key(N_("greatest total acceleration of any handle"), 1.5, "m/s^2"),
            "turning_rate": Key(N_("greatest turning rate of any bench"), 60, "deg/s"),
            "head_acceleration": Key(N_("greatest change of the head's own speed"), 0.5, "m/s^2"),
            "margin": Key(N_("margin: the clearance that non-adjacent benches must keep"), "5 cm", "m"),
            "venue_margin": Key(
                N_("distance that benches must keep from the venue's edge; else limits.margin"),
                "50 cm", "m",
            ),
        },
    ),
    Section(
        "[venue]", N_("The edge of the venue, which no bench may cross: its corners or a rectangle."),
        VenueTable,
        {
            "boundary": Key(
                N_("its corners in going round, each x and y"), [[-9, -6], [9, -6], [9, 6], [-9, 6]],
                "m",
            ),
            "rectangle": Key(N_("its length and width; in place of corners"), [30, 20], "m"),
            "centre": Key(N_("centre of the rectangle, x and y; else the origin"), [0, 0], "m"),
            "angle": Key(N_("direction of the rectangle's length, from x to y; else 0"), 30, "deg"),
            "name": Key(N_("what people call it; else venue"), "temple square"),
            "file": Key(
                N_("a DXF, GeoJSON, KML, CSV or SVG file beside the plan, in place of corners"),
                "square.dxf",
            ),
            "layer": Key(N_("layer or name of the edge in the file, where it holds several"), "edge"),
        },
    ),
    *(_obstacle_section(obstacle) for obstacle in OBSTACLES),
    Section(
        "[people]", N_("Who carries the benches, the room that they need, and how fast they go."),
        PeopleTable,
        {
            "roster": Key(N_("a list of names beside the plan: .xlsx, .ods or .csv"), "names.xlsx"),
            "sheet": Key(N_("sheet of the list, where it has several; else the first"), "2027"),
            "unit": Key(N_("what benches are counted in: bench, qiao (桥) or jie (节)"), "qiao"),
            "count_head": Key(N_("whether the head's bench is number 1; else the next one is"), False),
            "beside": Key(N_("room for bearers on each side of every bench"), "35 cm", "m"),
            "ahead": Key(N_("room that is to be free before the head's bench"), "1 m", "m"),
            "sway": Key(N_("how far benches sway to a side"), "5 cm", "m"),
            "imprecision": Key(N_("how far bearers stray from their line"), "10 cm", "m"),
            "steering": Key(
                N_("how fast bearers steer back: an offset falls to 37 % over 1 / steering"), 0.2, "1/m"
            ),
            "step": Key(N_("length of a step, by which distances are told"), "60 cm", "m"),
            "hurry_from": Key(N_("speed from which walking is called hurrying"), 1.2, "m/s"),
            "run_from": Key(N_("speed from which it is called running"), 1.8, "m/s"),
            "most_speed": Key(N_("greatest speed at which a bench can be carried"), 2.0, "m/s"),
            "address": Key(
                N_("where the player of the dance will be on the web: what QR codes open"),
                "https://example.org/dance.html",
            ),
            "source": Key(
                N_("where these numbers come from: see [people.source]"), {"beside": "measured"}
            ),
        },
    ),
    Section(
        "[people.source]",
        N_("Where the numbers of [people] come from; one without a source is an assumption."),
        SourcesTable,
        {
            name: Key(N_("source of the number of the same name in [people]"), "measured in 2026")
            for name in SourcesTable.model_fields
        },
    ),
    Section(
        "[cues]", N_("Time: tempo and drum, holds, stops and starts of the head."), CuesTable,
        {
            "tempo": Key(N_("beats a minute; else a step a beat at the head's speed"), 96),
            "bar": Key(N_("beats of a bar"), 4),
            "acceleration": Key(
                N_("at which the head brakes and starts; else limits.head_acceleration"), 0.3, "m/s^2"
            ),
            "clock": Key(N_("time of day at which the dance starts"), "18:30"),
            "cue": Key(N_("drum, holds and so on: see [[cues.cue]]"), [{"kind": "beat", "at": 60}]),
        },
    ),
    Section(
        "[[cues.cue]]", N_("A cue, at a time or at a place of the head."), CueTable,
        {
            "kind": Key(N_("beat (a stroke of the drum), hold, stop, start, tempo or note"), "hold"),
            "at": Key(N_("when: from then on the head stands, or goes on"), "2 min 30 s", "s"),
            "head": Key(
                N_("in place of a time: metres that the head has walked since the start of the dance"),
                "40 m", "m",
            ),
            "place": Key(
                N_("in place of a time: a point on the ground, to which the head is nearest then, for "
                   "the first time, or in the round of the cue"),
                [3, -8], "m",
            ),
            "round": Key(N_("in place of a time: the round that the head begins then"), 2),
            "hold": Key(N_("for how long the head stands; of a hold alone"), "20 s", "s"),
            "tempo": Key(N_("beats a minute from then on; of kind tempo alone"), 120),
            "text": Key(N_("what it is called; else its kind"), "bow to the temple"),
            "text_zh": Key(N_("the same in Chinese"), "拜庙"),
        },
    ),
    Section(
        "[chalk]",
        N_("The chalk line, and the peg; without effect on the dance."), ChalkTable,
        {
            "stray": Key(
                N_("how far the line may stray where ticks are joined straight; else half a link"),
                0.3, "m",
            ),
            "peg": Key(
                N_("where the peg stands, x and y, from which all papers measure; else the "
                   "route's centre"),
                [1, 2], "m",
            ),
        },
    ),
    Section(
        "[event]",
        N_("What the permit annex says of the event; without effect on the dance."),
        EventTable,
        {
            "place": Key(N_("where it is"), "Temple square, Anshan"),
            "place_zh": Key(N_("where it is, in Chinese"), "安山祠堂广场"),
            "date": Key(N_("the day, or the days"), "2027-02-20"),
            "organiser": Key(N_("who answers for the event"), "Anshan village"),
            "contact": Key(N_("who is asked about it"), "Li"),
            "spectators": Key(N_("how many spectators are expected"), 800),
            "marshals": Key(N_("how many marshals there will be"), 24),
            "distance": Key(
                N_("of the spectators' line from the ground that benches cover; else 2 m"), 2, "m"
            ),
            "entrances": Key(
                N_("where people come in, each x and y, and how wide it is if that is known"),
                [[20, 0, 4], [-20, 0]], "m",
            ),
        },
    ),
)  # fmt: skip
