"""Drawings in plans: the tables that hold what was drawn, and files that are read into them."""

import math
from typing import Annotated, Any

from pydantic import Field, TypeAdapter, ValidationError

from benchdragon.errors import InputError
from benchdragon.kernels.curve import MOST_METRES
from benchdragon.model.curves import AnyCurve, Arc, Clothoid, Line
from benchdragon.plans.idle import Idle
from benchdragon.plans.source import Fault, Source
from benchdragon.plans.tables import (
    LEAST,
    Curvature,
    Degrees,
    Length,
    LengthOrZero,
    Metres,
    Number,
    Table,
)
from benchdragon.plans.toml import PlanError
from benchdragon.surveys.coordinates import Survey
from benchdragon.surveys.lines import DrawnLine
from benchdragon.surveys.reading import outline, read_line

# Curvatures at both ends of a piece that differ by less than this, 1/m, are those of an arc.
SAME_BEND = 1e-12
_LENGTH: TypeAdapter[float] = TypeAdapter(LengthOrZero)


class SurveyTable(Table):
    """What the coordinates of the plan's files mean; `origin` is what lies at (0, 0) in the plan."""

    crs: Annotated[str, Field(max_length=40)] | None = None
    unit: Annotated[str, Field(max_length=40)] | None = None
    origin: tuple[Number, Number] | None = None

    @property
    def north(self) -> bool:
        """Whether y points north, which a system of coordinates alone tells."""
        return self.crs is not None

    def build(self) -> Survey:
        """The same, checked."""
        return Survey(self.crs, self.unit, self.origin)


class PieceTable(Table):
    """A surveyed line, arc or clothoid, where it was surveyed."""

    start: tuple[Metres, Metres]
    heading: Degrees
    length: Length
    start_curvature: Curvature = 0.0
    end_curvature: Curvature = 0.0

    def build(self) -> AnyCurve:
        """The curve."""
        heading = math.radians(self.heading)
        a, b = self.start_curvature, self.end_curvature
        if a == b == 0.0:
            return Line(self.length, self.start, heading)
        if abs(a - b) > SAME_BEND or abs(a) * MOST_METRES < 1.0:
            return Clothoid(self.length, a, b, self.start, heading)
        return Arc(1.0 / abs(a), self.length * a, self.start, heading, many=True)


def piece_of(curve: AnyCurve) -> dict[str, Any]:
    """The table of a line, arc or clothoid."""
    (x, y), heading = curve.start_pose
    first, last = curve.curvature([0.0, curve.length]).tolist()
    table: dict[str, Any] = {
        "start": [x, y], "heading": math.degrees(heading), "length": curve.length,
    }  # fmt: skip
    return table | ({"start_curvature": first, "end_curvature": last} if first or last else {})


def with_drawings(data: dict[str, Any], source: Source) -> tuple[dict[str, Any], tuple[str, ...]]:
    """A plan's tables with what its files hold in place of their names, and what was passed over there.

    `file` of [route], [route.street] and [venue] is a file beside the plan. One origin serves all;
    where [survey] does not say it, it is that of the first file, and said from then on.

    Raises:
        PlanError: for a file that cannot be read, or is not beside the plan.
        MissingExtraError: for a format that needs the extra `survey`.
    """
    named = [name for name in ("venue", "route", "route.street") if _names_file(_table(data, name))]
    try:
        survey = SurveyTable.model_validate(data.get("survey", {})).build() if named else Survey()
    except ValidationError:
        return data, ()  # the plan's own check says what is wrong
    except InputError as error:
        raise PlanError(source.sentences([Fault("survey", str(error))])) from None
    clashes = [clash.text for name in named for clash in _clashes(name, _table(data, name))]
    if clashes:
        raise PlanError(source.sentences([Fault("", text) for text in clashes]))
    found, told = dict(data), list[str]()
    for name in named:
        said = _table(found, name)
        table = {key: value for key, value in said.items() if key not in ("file", "layer")}
        layer = said.get("layer")
        try:
            path = source.beside(said["file"])
            if name == "venue":
                corners, survey = outline(path, survey, layer, told.append)
                table["boundary"] = corners.tolist()
            else:
                line, survey = read_line(path, survey, layer, told.append)
                keys = _drawn(line, table.get("drawn_within"))
                if name == "route.street":
                    keys.pop("closed", None)
                table = {**table, **keys, **{k: table[k] for k in ("closed",) if k in table}}
        except InputError as error:
            raise PlanError(source.sentences([Fault(f"{name}.file", str(error))])) from None
        if name == "route.street":
            found["route"] = {**found["route"], "street": table}
        else:
            found[name] = table
    if named:
        found["survey"] = {
            key: value
            for key, value in {"crs": survey.crs, "origin": survey.origin}.items()
            if value is not None
        }
    return found, tuple(told)


def _table(data: dict[str, Any], name: str) -> Any:
    """The table of a dotted name, if there is one."""
    at: Any = data
    for step in name.split("."):
        at = at.get(step) if isinstance(at, dict) else None
    return at


def _clashes(name: str, table: dict[str, Any]) -> list[Idle]:
    """What a table says beside its file that the file says too."""
    others = ("boundary", "rectangle") if name == "venue" else ("points", "piece")
    return [
        Idle((*name.split("."), "file"), f"{name}.{other}", f"{name}.{other}")
        for other in others
        if table.get(other) is not None
    ]


def _names_file(table: object) -> bool:
    return isinstance(table, dict) and isinstance(table.get("file"), str) and isinstance(
        table.get("layer", ""), str
    )  # fmt: skip


def _drawn(line: DrawnLine, said: object) -> dict[str, Any]:
    """The keys of [route] that hold a line; `said` is the `drawn_within` of the plan."""
    found: dict[str, Any] = {}
    if line.bent:
        found["piece"] = [piece_of(curve) for curve in line.pieces()]
    else:
        found["points"] = line.corners[:, :2].tolist()
    if line.closed:
        found["closed"] = True
    if line.off:
        found["drawn_within"] = _added(said, line.off)
    return found


def _added(said: object, off: float) -> object:
    """How far a drawing is off, m: what the plan says of it, and what was lost in reading it."""
    try:
        own = _LENGTH.validate_python(0.0 if said is None else said)
    except ValidationError:
        return said  # the plan's own check says what is wrong
    return max(own + off, LEAST)
