"""Formations: figures that bench dragons dance, by their names, with sources, as routes of given sizes.

Each lies about the origin and begins and ends at its outer edge where it can, so that routes to and
from it need not cross it. Lines, arcs and Archimedean spirals; headings never jump, curvatures do.
No source that was read gives the geometry of a formation: except for the coils, which are those of the
contest, it is this project's own, and each `source` says so.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from benchdragon.errors import InputError, finite
from benchdragon.i18n import N_, _
from benchdragon.kernels.formations import MOST_PARTS, FormationKind, formation_parts
from benchdragon.kernels.route_parts import PART_COLUMNS, tightest_bend
from benchdragon.model.curves import Route, curves_of


@dataclass(frozen=True)
class Size:
    """What a size of a formation means, and between what it must lie.

    Attributes:
        text: in a few words.
        least: the smallest that may be, m; of a count, a number.
        most: the largest.
        unit: "m", or "" of a count.
    """

    text: str
    least: float
    most: float
    unit: str = "m"


class Smaller(NamedTuple):
    """That one size must be smaller than another, times a factor; and how that is written."""

    size: str
    factor: float
    than: str
    written: str


PITCH = Size(N_("distance between neighbouring turns of the spiral"), 0.1, 100.0)
OUTER = Size(N_("radius at the outer end of the coil"), 1.0, 1000.0)
INNER = Size(N_("radius at the inner end of the coil"), 0.5, 1000.0)
ROUNDS = Size(N_("how many times it is walked round"), 1, 20, "")
# Of coils.
COILED = (
    Smaller("inner_radius", 1.0, "outer_radius", "outer_radius"),
    Smaller("pitch", 1.0, "outer_radius", "outer_radius"),
)


class SizeError(InputError):
    """A size of a formation that cannot be.

    Attributes:
        size: its name.
    """

    def __init__(self, size: str, text: str) -> None:
        super().__init__(text)
        self.size = size


@dataclass(frozen=True)
class Formation:
    """A formation of given sizes, m; its centre is the origin.

    Attributes:
        name: as plans say it.
        chinese: its name.
        pinyin: of that.
        english: its name in English.
        shape: what it looks like, in words.
        source: who names it, and whose its geometry is.
        sizes: what each size means, by its name.
        smaller: which of them must be smaller than others.
        tightest: the sizes of which the smallest makes its tightest bend; none where it has no bend.

    Examples:
        >>> bd.formation("figure-eight").chinese
        '8字'
    """

    name: ClassVar[str]
    chinese: ClassVar[str]
    pinyin: ClassVar[str]
    english: ClassVar[str]
    shape: ClassVar[str]
    source: ClassVar[str]
    sizes: ClassVar[Mapping[str, Size]]
    smaller: ClassVar[tuple[Smaller, ...]] = ()
    tightest: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        for name, size in self.sizes.items():
            value = finite(name, getattr(self, name), size.unit)
            if not size.least <= value <= size.most:
                raise SizeError(
                    name,
                    _("{name} of {formation} must lie in {least} .. {most}, not at {value}").format(
                        name=name, formation=self.name, value=f"{value:g} {size.unit}".strip(),
                        least=f"{size.least:g}", most=f"{size.most:g} {size.unit}".strip(),
                    ),
                )  # fmt: skip
            if not size.unit and value != int(value):
                text = _("{name} of {formation} must be a whole number, not {value}")
                raise SizeError(name, text.format(name=name, formation=self.name, value=f"{value:g}"))
        for name, factor, other, than in self.smaller:
            value, most = getattr(self, name), factor * getattr(self, other)
            if value >= most:
                text = _("{name} of {formation} ({value} m) must be smaller than {than} ({most} m)")
                values = {"value": f"{value:g}", "than": than, "most": f"{most:g}"}
                raise SizeError(name, text.format(name=name, formation=self.name, **values))

    @classmethod
    def defaults(cls) -> dict[str, Any]:
        """Each size and, where it has two hands, `clockwise`, as they are if nothing is said."""
        return {field.name: field.default for field in fields(cls)}

    @classmethod
    def of(cls, said: Mapping[str, Any]) -> Self:
        """The formation of the given sizes; missing ones, or None, are as by default."""
        told = {name: said.get(name) for name in cls.defaults()}
        return cls(*[cls.defaults()[name] if of is None else of for name, of in told.items()])

    @classmethod
    def kind(cls) -> FormationKind:
        """Which it is to the kernels."""
        return FormationKind[cls.name.upper().replace("-", "_")]

    def build(self) -> Route:
        """Its route, about the origin."""
        parts = np.empty((MOST_PARTS, PART_COLUMNS))
        sizes = np.array([getattr(self, name) for name in self.sizes], np.float64)
        count = formation_parts(type(self).kind(), sizes, getattr(self, "clockwise", False), parts)
        return Route(curves_of(parts[:count]))

    @property
    def narrowest(self) -> str:
        """The size that widens its tightest bend; "" where it has none."""
        return min(self.tightest, key=lambda size: getattr(self, size), default="")

    @property
    def least_radius(self) -> float:
        """The radius of its tightest bend, m; infinite where it has none."""
        return least_radius(self.build())


def least_radius(route: Route) -> float:
    """The radius of a route's tightest bend, m: of lines, arcs and Archimedean spirals."""
    bend, _where = tightest_bend(route.rows)
    return 1.0 / bend if bend > 0.0 else math.inf


@dataclass(frozen=True)
class CoilIn(Formation):
    """In along a spiral, from its outer end at (outer_radius, 0)."""

    name: ClassVar = "coil-in"
    chinese: ClassVar = "盘龙"
    pinyin: ClassVar = "pán lóng"
    english: ClassVar = "coil in"
    shape: ClassVar = N_("in along one spiral, from its outer end to its inner end")
    source: ClassVar = N_(
        "the contest's problem, CUMCM 2024 A, whose spiral this is; clockwise as in Xianyou (press, "
        "2025), where the heads are the centre; the sizes are this project's own"
    )
    sizes: ClassVar = {"pitch": PITCH, "outer_radius": OUTER, "inner_radius": INNER}
    smaller: ClassVar = COILED
    tightest: ClassVar = ("inner_radius",)

    pitch: float = 0.8
    outer_radius: float = 12.0
    inner_radius: float = 3.0
    clockwise: bool = True


@dataclass(frozen=True)
class CoilOut(Formation):
    """Out along a spiral, to its outer end at (outer_radius, 0)."""

    name: ClassVar = "coil-out"
    chinese: ClassVar = "出龙"
    pinyin: ClassVar = "chū lóng"
    english: ClassVar = "coil out"
    shape: ClassVar = N_(
        "out along one spiral; with the pitch of a coil in, turned by 180 degrees and walked the "
        "other way round, it lies half-way between the turns of the spiral in"
    )
    source: ClassVar = N_(
        "the contest's problem, CUMCM 2024 A: the way out is the way in, turned by 180 degrees; the "
        "sizes are this project's own"
    )
    sizes: ClassVar = {"pitch": PITCH, "inner_radius": INNER, "outer_radius": OUTER}
    smaller: ClassVar = COILED
    tightest: ClassVar = ("inner_radius",)

    pitch: float = 0.8
    inner_radius: float = 3.0
    outer_radius: float = 12.0
    clockwise: bool = True


@dataclass(frozen=True)
class DoubleDoor(Formation):
    """Out of one coil, straight across, into its mirror image; centres on the axis of x."""

    name: ClassVar = "double-door"
    chinese: ClassVar = "双开门"
    pinyin: ClassVar = "shuāng kāi mén"
    english: ClassVar = "double door"
    shape: ClassVar = N_(
        "out of one coil, straight across and into a second one, its mirror image: the two leaves of "
        "a door, one opening as the other closes"
    )
    source: ClassVar = N_(
        "danced in Huayuan, Dongyang, by dragons of 1788 and 3500 benches; no source gives its "
        "geometry, which is this project's own"
    )
    sizes: ClassVar = {
        "pitch": PITCH,
        "outer_radius": OUTER,
        "inner_radius": INNER,
        "between": Size(N_("distance between the outer circles of the two coils"), 0.0, 1000.0),
    }
    smaller: ClassVar = COILED
    tightest: ClassVar = ("inner_radius",)

    pitch: float = 0.8
    outer_radius: float = 9.0
    inner_radius: float = 2.5
    between: float = 2.0
    clockwise: bool = True


@dataclass(frozen=True)
class FigureEight(Formation):
    """Two loops joined by straight lines that cross at right angles at the origin.

    It begins at the tip of the loop at positive x.
    """

    name: ClassVar = "figure-eight"
    chinese: ClassVar = "8字"
    pinyin: ClassVar = "bā zì"
    english: ClassVar = "figure of eight"
    shape: ClassVar = N_(
        "two loops, walked in opposite senses, whose lines cross at right angles: the dragon stays "
        "free of contact only if it is shorter than a loop, 6.7 times the radius"
    )
    source: ClassVar = N_(
        "danced in Anshan, Xianju (China News, 2024), and in Youlong, Anhui; no source gives its "
        "geometry, which is this project's own"
    )
    sizes: ClassVar = {"radius": Size(N_("radius of the bends"), 0.5, 1000.0), "rounds": ROUNDS}
    tightest: ClassVar = ("radius",)

    radius: float = 40.0
    rounds: int = 1
    clockwise: bool = True

    @property
    def loop(self) -> float:
        """Length from the crossing round one loop back to it, m."""
        return (2.0 + 1.5 * math.pi) * self.radius


@dataclass(frozen=True)
class ThreePlumBlossoms(Formation):
    """The outline of three round petals, with bends the other way between them.

    The centres of petals and bends are corners of a regular hexagon of side radius + waist. It begins
    at the tip of the petal at positive x.
    """

    name: ClassVar = "three-plum-blossoms"
    chinese: ClassVar = "三梅花"
    pinyin: ClassVar = "sān méi huā"
    english: ClassVar = "three plum blossoms"
    shape: ClassVar = N_(
        "once or more along the outline of three round petals, which does not cross itself: the "
        "dragon stays free of contact if it is shorter than the outline"
    )
    source: ClassVar = N_(
        "danced in Anshan, Xianju (China News, 2024); no source gives its geometry, which is this "
        "project's own"
    )
    sizes: ClassVar = {
        "radius": Size(N_("radius of the petals"), 0.5, 1000.0),
        "waist": Size(N_("radius of the bends between the petals"), 0.5, 1000.0),
        "rounds": ROUNDS,
    }
    # Petals whose centres lie 3 ** 0.5 * (radius + waist) apart must not meet.
    smaller: ClassVar = (
        Smaller("radius", math.sqrt(3.0) / (2.0 - math.sqrt(3.0)), "waist", "6.46 * waist"),
    )
    tightest: ClassVar = ("waist", "radius")

    radius: float = 18.0
    waist: float = 6.0
    rounds: int = 1
    clockwise: bool = True


@dataclass(frozen=True)
class StraightDragon(Formation):
    """A straight line along the axis of x, its middle at the origin."""

    name: ClassVar = "straight-dragon"
    chinese: ClassVar = "一字长龙"
    pinyin: ClassVar = "yī zì cháng lóng"
    english: ClassVar = "one straight line"
    shape: ClassVar = N_("a straight line")
    source: ClassVar = N_(
        "danced in Pujiang; the name says a straight line, whose length is this project's own"
    )
    sizes: ClassVar = {"length": Size(N_("length of the line"), 1.0, 10_000.0)}

    length: float = 300.0


@dataclass(frozen=True)
class TailSwing(Formation):
    """A line, alternating bends, and a line, along the axis of x; the middle is the origin."""

    name: ClassVar = "tail-swing"
    chinese: ClassVar = "甩尾"
    pinyin: ClassVar = "shuǎi wěi"
    english: ClassVar = "tail swing"
    shape: ClassVar = N_(
        "straight on, then bends to and fro, through which the tail is led from side to side; on a "
        "route every bench goes where the head went, so that a tail which leaves the track, or is "
        "faster than the rest, as when it is cracked like a whip, cannot be expressed"
    )
    source: ClassVar = N_(
        "danced in Pujiang; the tail swings by 4 to 5 m: Pujiang in Beijing (China Daily, 2025); no "
        "source gives its geometry, which is this project's own"
    )
    sizes: ClassVar = {
        "swing": Size(N_("how wide the tail swings from side to side"), 0.1, 1000.0),
        "radius": Size(N_("radius of the bends"), 0.5, 1000.0),
        "swings": Size(N_("how many times it swings from one side to the other"), 1, 100, ""),
        "run": Size(N_("length of the straight lines before and behind the bends"), 0.0, 10_000.0),
    }
    smaller: ClassVar = (Smaller("swing", 2.0, "radius", "2 * radius"),)
    tightest: ClassVar = ("radius",)

    swing: float = 4.5
    radius: float = 5.0
    swings: int = 6
    run: float = 260.0
    clockwise: bool = True


FORMATIONS: Mapping[str, type[Formation]] = {
    one.name: one
    for one in (
        CoilIn, CoilOut, FigureEight, ThreePlumBlossoms, DoubleDoor, StraightDragon, TailSwing,
    )
}  # fmt: skip


def formation(name: str, **sizes: Any) -> Formation:
    """The formation of a name, its sizes as given, m, else as by default.

    Raises:
        InputError: for a name that none has, and for sizes that it has not or that cannot be.

    Examples:
        >>> bd.formation("coil-in", pitch=0.7).pitch
        0.7
    """
    if not isinstance(name, str) or name not in FORMATIONS:
        text = _("expected one of {known}, not {name}")
        raise InputError(text.format(known=", ".join(FORMATIONS), name=name))
    known = FORMATIONS[name].defaults()
    for size in sizes:
        if size not in known:
            text = _("{formation} has no size {name}; it has {known}")
            raise InputError(text.format(formation=name, name=size, known=", ".join(known)))
    return FORMATIONS[name](**sizes)
