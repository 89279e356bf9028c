"""Draw the map of rooms and the arrows between them, and write the table of rooms into CONTRIBUTING.md.

Floors come from the import contract in pyproject.toml, arrows from the imports that are there, what a
room holds from the first line of its docstring. So neither can drift, and a test holds both to what
this makes. The picture is written as text, not drawn by matplotlib: the same rooms give the same bytes
whatever is installed, and a change shows as a few lines.
"""

import math
import re
import tomllib
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import grimp

import benchdragon

ROOT = Path(__file__).resolve().parents[1]
NAME = "benchdragon"
PACKAGE = Path(benchdragon.__file__).parent
PAGE, PICTURE = ROOT / "CONTRIBUTING.md", ROOT / "docs" / "rooms.svg"
MARKED = re.compile(r"(?<=<!-- rooms -->\n).*(?=<!-- end of rooms -->)", re.DOTALL)
# Lines are told in steps of this: a table that changed with every line would only be in the way.
ABOUT = 100

# A floor is a tuple of rooms, those who import first; an arrow is a pair, importer and imported.
Floor = tuple[str, ...]
Arrow = tuple[str, str]


def floors() -> tuple[Floor, ...]:
    """The floors of the import contract, the top one first."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    contracts = settings["tool"]["importlinter"]["contracts"]
    (layers,) = (contract["layers"] for contract in contracts if contract["type"] == "layers")
    return tuple(tuple(layer.split(" | ")) for layer in layers)


def arrows() -> Counter[Arrow]:
    """How many modules of one room import how many of another: pairs of modules, by pairs of rooms."""
    graph = grimp.build_graph(NAME, cache_dir=None, exclude_type_checking_imports=True)
    pairs = (
        (module, other)
        for module in graph.modules - {NAME}  # the front door only hands out what is in the rooms
        for other in graph.find_modules_directly_imported_by(module)
    )
    rooms = ((module.split(".")[1], other.split(".")[1]) for module, other in pairs)
    return Counter(arrow for arrow in rooms if arrow[0] != arrow[1])


def not_down(found: Collection[Arrow], house: Sequence[Floor]) -> list[Arrow]:
    """The arrows that lead up, or to a room on the same floor."""
    height = {room: n for n, floor in enumerate(house) for room in floor}
    return sorted((a, b) for a, b in found if height[b] <= height[a])


def circles(found: Collection[Arrow]) -> list[Arrow]:
    """Pairs of rooms that import one another, at once or through others."""
    reach = set(found)
    while more := {(a, d) for a, b in reach for c, d in reach if b == c} - reach:
        reach |= more
    return sorted((a, b) for a, b in reach if a < b and (b, a) in reach)


@dataclass(frozen=True)
class Room:
    """A folder of the package, or a module beside them.

    Attributes:
        name: as it is imported.
        text: what it holds, in a line.
        files: how many modules it has.
        lines: of all of them.
    """

    name: str
    text: str
    files: int
    lines: int

    @property
    def is_folder(self) -> bool:
        """Whether it holds more than itself."""
        return (PACKAGE / self.name).is_dir()


def room(name: str) -> Room:
    """What there is to tell of a room."""
    folder = PACKAGE / name
    files = sorted(folder.glob("*.py")) if folder.is_dir() else [folder.with_suffix(".py")]
    first = folder / "__init__.py" if folder.is_dir() else files[0]
    said = re.match(r'"""(.*?)("""|$)', first.read_text("utf-8"), re.MULTILINE)
    if said is None:
        raise ValueError(f"{first} does not begin with a docstring")
    lines = sum(len(file.read_text("utf-8").splitlines()) for file in files)
    return Room(name, said[1], len(files), lines)


def summary(house: Sequence[Floor], found: Mapping[Arrow, int]) -> str:
    """The house in numbers, in one sentence."""
    rooms = [room(name) for floor in house for name in floor]
    folders = sum(one.is_folder for one in rooms)
    return (
        f"{folders} rooms and {len(rooms) - folders} modules beside them on {len(house)} floors; "
        f"{len(found)} arrows, of {sum(found.values())} imports; "
        f"{len(not_down(found, house))} arrows that do not point down, {len(circles(found))} circles."
    )


def table(house: Sequence[Floor], found: Mapping[Arrow, int]) -> str:
    """The rooms as a table in Markdown, the top floor first."""
    lines = ["| floor | room | what it holds | files | lines, up to |", "|---:|---|---|---:|---:|"]
    for height, floor in zip(range(len(house), 0, -1), house, strict=True):
        for one in map(room, floor):
            path = f"src/{NAME}/{one.name}" + ("" if one.is_folder else ".py")
            about = ABOUT * math.ceil(one.lines / ABOUT)
            lines.append(
                f"| {height} | [`{one.name}`]({path}) | {one.text} | {one.files} | {about:,} |"
            )
    return "\n".join(["", summary(house, found), "", *lines, "", ""])


def page() -> str:
    """CONTRIBUTING.md with the table as it is now."""
    house, found = floors(), arrows()
    return MARKED.sub(lambda _old: table(house, found), PAGE.read_text("utf-8"))


# The picture's sizes, in its own units: a step of the stairs to the right and down, a room's box, and
# the margins on the left, on the right, above the stairs and below.
STEP, DROP, BOX, TALL, LEFT, RIGHT, HEAD, FOOT = 54, 36, 86, 26, 96, 20, 62, 18
INK, FAINT, LINE, PAPER, BAND = "#1b2733", "#5b6b7b", "#8fa3b8", "#ffffff", "#f1f4f8"
FOLDER, MODULE = "#d5e6f7", "#ececec"
STYLE = f"""\
text {{ font: 14px "DejaVu Sans", Verdana, Arial, sans-serif; fill: {INK}; }}
.title {{ font-size: 18px; font-weight: bold; }}
.faint {{ fill: {FAINT}; }}
.line {{ fill: none; stroke: {LINE}; stroke-width: 1.2; }}
.count {{ font-size: 12px; text-anchor: middle; }}
.room {{ font-weight: bold; text-anchor: middle; }}"""
HOW_TO_READ = (
    "Along its row, to the right, a room imports.",
    "Down its column it is imported: arrows point down only.",
    "A number: so many imports of one module by another.",
    "Grey boxes are single modules.",
)


def text(x: float, y: float, said: str, kind: str) -> str:
    """A line of text that stands on y."""
    return f'<text x="{x:g}" y="{y:g}" class="{kind}">{said}</text>'


def box(x: float, y: float, wide: float, tall: float, look: str) -> str:
    """A box with rounded corners about (x, y)."""
    place = f'x="{x - wide / 2:g}" y="{y - tall / 2:g}" width="{wide:g}" height="{tall:g}"'
    return f'<rect {place} rx="6" {look}/>'


def tint(count: int) -> str:
    """A colour for so many imports: the more, the darker, and black text is read on all of them."""
    share = min(count, 20) / 20
    red, green, blue = (round(a + share * (b - a)) for a, b in ((255, 255), (250, 196), (235, 84)))
    return f"#{red:02x}{green:02x}{blue:02x}"


@dataclass(frozen=True)
class Stairs:
    """The picture: each room on a step of its own, each arrow right along a row and down a column."""

    house: Sequence[Floor]
    found: Mapping[Arrow, int]

    @property
    def rooms(self) -> list[str]:
        """All rooms, from the top of the stairs."""
        return [name for floor in self.house for name in floor]

    def at(self, row: str, column: str) -> tuple[float, float]:
        """The middle of a cell: where the row of one room meets the column of another."""
        rooms = self.rooms
        return LEFT + (rooms.index(column) + 0.5) * STEP, HEAD + (rooms.index(row) + 0.5) * DROP

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return LEFT + len(self.rooms) * STEP + RIGHT, HEAD + len(self.rooms) * DROP + FOOT

    def bands(self) -> Iterator[str]:
        """A band for each floor, its number at the left."""
        wide = self.size[0]
        for n, floor in enumerate(self.house):
            top, bottom = self.at(floor[0], floor[0])[1], self.at(floor[-1], floor[-1])[1]
            if n % 2:
                tall = bottom - top + DROP
                yield box(wide / 2, (top + bottom) / 2, wide - 16, tall, f'fill="{BAND}"')
            yield text(20, (top + bottom) / 2 + 5, f"{len(self.house) - n}", "faint")

    def lines(self) -> Iterator[str]:
        """A line along each row to the farthest room, an arrow down each column to its room."""
        for name in self.rooms:
            x, y = self.at(name, name)
            if to := [self.at(name, b)[0] for a, b in self.found if a == name]:
                yield f'<path class="line" d="M{x:g} {y:g}H{max(to):g}"/>'
            if of := [self.at(a, name)[1] for a, b in self.found if b == name]:
                end = y - TALL / 2 - 2
                yield f'<path class="line" d="M{x:g} {min(of):g}V{end:g}" marker-end="url(#tip)"/>'

    def boxes(self) -> Iterator[str]:
        """The rooms, and the numbers where arrows turn."""
        for (a, b), count in sorted(self.found.items()):
            x, y = self.at(a, b)
            yield box(x, y, 30, 19, f'fill="{tint(count)}" stroke="{LINE}"')
            yield text(x, y + 4.5, f"{count}", "count")
        for name in self.rooms:
            x, y = self.at(name, name)
            x += (STEP - BOX) / 2  # there is room to the left of a step, none to the right
            fill = FOLDER if room(name).is_folder else MODULE
            yield box(x, y, BOX, TALL, f'fill="{fill}" stroke="{INK}"')
            yield text(x, y + 5, name, "room")

    def drawn(self) -> str:
        """All of it as SVG."""
        wide, tall = self.size
        said = [summary(self.house, self.found), *HOW_TO_READ]
        foot = tall - FOOT - 24 * len(HOW_TO_READ)
        parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {tall}" role="img">',
            f"<title>The rooms of {NAME}</title>",
            f"<desc>{' '.join(said)}</desc>",
            f"<style>\n{STYLE}\n</style>",
            '<marker id="tip" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="8" markerHeight="8" '
            f'orient="auto"><path d="M0 0L8 4L0 8z" fill="{FAINT}"/></marker>',
            box(wide / 2, tall / 2, wide - 2, tall - 2, f'fill="{PAPER}" stroke="{LINE}"'),
            text(20, 30, f"The rooms of {NAME}: who imports whom", "title"),
            text(20, 50, "floor", "faint"),
            *self.bands(), *self.lines(), *self.boxes(),
            *(text(60, foot + 24 * n, line, "faint") for n, line in enumerate(HOW_TO_READ)),
            "</svg>",
        ]  # fmt: skip
        return "\n".join(parts) + "\n"


def picture() -> str:
    """The map as it is now."""
    return Stairs(floors(), arrows()).drawn()


def files() -> dict[Path, str]:
    """The page and the picture as they are now."""
    return {PAGE: page(), PICTURE: picture()}
