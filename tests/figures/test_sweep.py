"""Pictures of sweeps: what is drawn, read back from the figures."""

import itertools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection, QuadMesh, TriMesh
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from benchdragon import InputError, Plan, Points, read_plan
from benchdragon.figures.style import lay_out, write_picture
from benchdragon.figures.sweep import MOST_PANELS, layout, sweep_picture
from benchdragon.figures.sweep_curve import jumps
from benchdragon.figures.sweep_rows import COLOURS, OTHERS, answered
from benchdragon.kernels.curve import FloatArray
from benchdragon.sweeps.points import Value, grid_points, listed_points
from benchdragon.sweeps.rows import row_schema
from benchdragon.sweeps.sweep import Design, Sweep

PLAN = read_plan("spiral-in")
ASKED = "first_contact"


def made(points: Points, cells: Sequence[Mapping[str, Any]], plan: Plan = PLAN) -> Sweep:
    """A sweep with these answers, point by point; "found" where nothing else is said."""
    design = Design(plan, points, (ASKED,))
    rows = []
    for number, cell in enumerate(cells):
        row: dict[str, Any] = {"point": number, f"{ASKED}.status": "found"}
        row |= dict(zip(points.keys, points[number], strict=True))
        rows.append(row | {f"{ASKED}.{name}": value for name, value in cell.items()})
    return Sweep(design.about(), pa.Table.from_pylist(rows, row_schema(design.keys, design.asked)))


def exact(value: float, one: int = 1, two: int = 9) -> dict[str, Any]:
    return {"value": value, "lower": value, "upper": value, "bench_1": one, "bench_2": two}


def none(status: str, **more: Any) -> dict[str, Any]:
    return {"status": status, **more}


def over(
    values: Sequence[Value], cells: Sequence[Mapping[str, Any]], key: str = "route.pitch"
) -> Sweep:
    return made(grid_points({key: values}), cells)


def xy(line: Line2D) -> FloatArray:
    """The points of a line, (n, 2)."""
    return np.asarray(line.get_xydata(), dtype=np.float64)


def curves(panel: Axes) -> list[Line2D]:
    """What is drawn as a line, not as marks."""
    return [line for line in panel.lines if line.get_linestyle() == "-" and len(xy(line)) > 1]


def marks(panel: Axes, kind: str) -> list[Line2D]:
    return [line for line in panel.lines if line.get_marker() == kind]


def spans(panel: Axes) -> list[tuple[float, float, str]]:
    """From where to where it is hatched, and the reason in words."""
    hatched = [one for one in panel.patches if isinstance(one, Rectangle) and one.get_hatch()]
    return [(one.get_x(), one.get_x() + one.get_width(), str(one.get_label())) for one in hatched]


def legend(figure: Figure) -> list[str]:
    return [text.get_text() for one in figure.legends for text in one.get_texts()]


def stepped() -> Sweep:
    """Three points, then others decide and the answer jumps up, then it goes on."""
    cells = [exact(10.0 + n, 1, 9) for n in range(3)] + [exact(17.0 + n, 1, 8) for n in range(3)]
    return over([0.50, 0.51, 0.52, 0.53, 0.54, 0.55], cells)


def test_no_line_crosses_a_jump_and_both_its_ends_are_marked() -> None:
    figure = sweep_picture(stepped(), ASKED)
    (panel,) = figure.axes
    drawn = curves(panel)
    assert len(drawn) == 2
    for line in drawn:
        x = xy(line)[:, 0]
        assert x.max() <= 0.52 or x.min() >= 0.53
    ends: dict[tuple[float, float], Any] = {tuple(xy(line)[0]): line for line in marks(panel, "o")}
    assert set(ends) == {(0.52, 12.0), (0.53, 17.0)}
    assert to_hex(ends[0.52, 12.0].get_markerfacecolor()) == to_hex(ends[0.52, 12.0].get_color())
    assert ends[0.53, 17.0].get_markerfacecolor() == "white"
    assert "jump" in legend(figure)


def test_a_jump_down_has_its_lower_end_filled_too() -> None:
    cells = [exact(20.0 + n, 1, 9) for n in range(3)] + [exact(10.0 + n, 1, 8) for n in range(3)]
    (panel,) = sweep_picture(over([0.50, 0.51, 0.52, 0.53, 0.54, 0.55], cells), ASKED).axes
    faces = {xy(line)[0, 1]: line.get_markerfacecolor() for line in marks(panel, "o")}
    assert faces[22.0] == "white"
    assert faces[10.0] != "white"


def test_a_curve_that_others_go_on_with_is_not_broken() -> None:
    cells = [exact(10.0 + n, 1, 9) for n in range(3)] + [exact(13.5 + 2.0 * n, 1, 8) for n in range(3)]
    (panel,) = sweep_picture(over([0.50, 0.51, 0.52, 0.53, 0.54, 0.55], cells), ASKED).axes
    one, two = curves(panel)
    assert xy(one)[-1] == pytest.approx([0.525, 12.75])
    assert xy(two)[0] == pytest.approx([0.525, 12.75])
    assert one.get_color() != two.get_color()
    assert marks(panel, "o") == []


def test_what_is_too_small_to_be_seen_is_no_jump_nor_is_a_change_by_the_same_benches() -> None:
    x, who = np.arange(6.0), np.array([0, 0, 0, 1, 1, 1])
    assert jumps(x, np.array([0.0, 1.0, 2.0, 7.0, 8.0, 9.0]), who).tolist() == [0, 0, 1, 0, 0]
    assert not jumps(x, np.array([0.0, 1.0, 2.0, 7.0, 8.0, 9.0]), np.zeros(6, dtype=int)).any()
    assert not jumps(x, np.array([0.0, 1.0, 1.0, 1.005, 1.005, 1.005]), who).any()
    assert jumps(x, np.array([0.0, 1.0, 1.0, 1.02, 1.02, 1.02]), who)[2]
    # Where points lie so near to one another that the line would stand upright it is one.
    near = np.array([0.0, 1.0, 2.0, 2.001, 3.0, 4.0])
    assert jumps(near, np.array([0.0, 1.0, 1.0, 1.005, 1.005, 1.005]), who)[2]
    # As many who decide as points: no slope says that it is not a jump.
    assert jumps(np.arange(3.0), np.array([0.0, 1.0, 2.0]), np.arange(3)).all()


def test_where_there_is_no_answer_it_is_hatched_half_way_by_the_reason(spoken: str) -> None:
    cells = [
        none("refused"), none("unwalkable"), exact(1.0), exact(2.0), none("clear", lower=9.0),
        none("clear", lower=9.5), none("undecided"),
    ]  # fmt: skip
    sweep = over([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7], cells)
    figure = sweep_picture(sweep, ASKED)
    (panel,) = figure.axes
    words = {
        "en": ("cannot be", "cannot be walked", "no contact", "undecided", "no contact up to here"),
        "zh": ("方案不成立", "走不通", "无碰撞", "未能判定", "到此为止无碰撞"),
    }[spoken]
    found = spans(panel)
    assert [word for _left, _right, word in found] == list(words[:4])
    ends = [(0.1, 0.15), (0.15, 0.25), (0.45, 0.65), (0.65, 0.7)]
    for (left, right, _word), end in zip(found, ends, strict=True):
        assert (left, right) == pytest.approx(end)
    assert set(words) <= set(legend(figure))
    (clear,) = marks(panel, "^")
    assert xy(clear) == pytest.approx(np.array([[0.5, 9.0], [0.6, 9.5]]))


def test_no_line_is_drawn_across_points_without_an_answer() -> None:
    cells = [exact(1.0), exact(2.0), none("unwalkable"), exact(4.0), exact(5.0)]
    (panel,) = sweep_picture(over([1.0, 2.0, 3.0, 4.0, 5.0], cells), ASKED).axes
    assert [np.ptp(xy(line)[:, 0]) for line in curves(panel)] == [1.0, 1.0]


def test_answers_without_a_finite_value_and_unlimited_ones_are_hatched() -> None:
    cells = [exact(1.0), exact(2.0), none("unlimited", value=30.0), none("clear", value=math.inf)]
    (panel,) = sweep_picture(over([1.0, 2.0, 3.0, 4.0], cells), ASKED).axes
    assert [word for _left, _right, word in spans(panel)] == ["unlimited", "no contact"]


def test_what_has_no_answer_keeps_the_status_of_its_row() -> None:
    states = ["found", "proved", "undecided", "unlimited", "infeasible", "clear", "lost"]
    sweep = over([float(n) for n in range(len(states))], [none(one, value=math.inf) for one in states])
    assert answered(sweep, ASKED).why.tolist() == states


def test_wide_brackets_are_seen_and_narrow_ones_are_not() -> None:
    cells: list[dict[str, Any]] = [exact(float(n)) for n in range(4)]
    (panel,) = sweep_picture(over([1.0, 2.0, 3.0, 4.0], cells), ASKED).axes
    assert not [one for one in panel.collections if isinstance(one, PolyCollection)]
    cells[1] |= {"lower": 0.5, "upper": 1.75}
    figure = sweep_picture(over([1.0, 2.0, 3.0, 4.0], cells), ASKED)
    (band,) = (one for one in figure.axes[0].collections if isinstance(one, PolyCollection))
    corners = np.asarray(band.get_paths()[0].vertices)
    assert {0.5, 1.75} <= set(corners[corners[:, 0] == 2.0, 1])
    assert "bracket" in legend(figure)


def test_each_pair_has_one_colour_and_the_rare_ones_share_grey() -> None:
    pairs = [(1, n) for n in range(3, 15)]
    many = [pair for n, pair in enumerate(pairs) for _ in range(2 + (n < len(COLOURS)))]
    cells = [exact(float(n), *pair) for n, pair in enumerate(many)]
    sweep = over([float(n) for n in range(len(many))], cells)
    found = answered(sweep, ASKED)
    colours = dict(zip(found.names, found.colours(), strict=True))
    assert len({colours[pair] for pair in pairs[: len(COLOURS)]}) == len(COLOURS)
    assert {colours[pair] for pair in pairs[len(COLOURS) :]} == {OTHERS}
    figure = sweep_picture(sweep, ASKED)
    words = legend(figure)
    assert words[: len(COLOURS)] == [f"benches {a} and {b}" for a, b in pairs[: len(COLOURS)]]
    assert words[len(COLOURS)] == "others"
    for line in curves(figure.axes[0]):
        assert line.get_color() == colours[many[round(float(np.mean(xy(line)[:, 0])))]]


def test_stretches_that_are_long_enough_are_named() -> None:
    (panel,) = sweep_picture(stepped(), ASKED).axes
    assert [text.get_text() for text in panel.texts] == ["1–9", "1–8"]


def test_handles_and_other_limits_are_told_apart() -> None:
    cells: list[dict[str, Any]] = [{"value": float(n), "handle": 3} for n in range(3)]
    cells += [{"value": 3.0 + n} for n in range(3)]
    figure = sweep_picture(over([float(n) for n in range(6)], cells), ASKED)
    assert legend(figure) == ["handle 3", "another limit"]
    assert "black" in {line.get_color() for line in curves(figure.axes[0])}


def test_texts_stand_side_by_side_without_a_line() -> None:
    cells = [exact(1.0), exact(2.0), none("refused")]
    (panel,) = sweep_picture(over(["arc-arc", "b$", "c"], cells, "turn.family"), ASKED).axes
    assert [text.get_text() for text in panel.get_xticklabels()] == ["arc-arc", r"b\$", "c"]
    assert curves(panel) == []
    assert len(marks(panel, ".")) == 2
    assert [(left, right) for left, right, _word in spans(panel)] == [(1.5, 2.5)]


def test_equal_answers_have_a_scale_that_can_be_read() -> None:
    cells = [exact(412.0), exact(412.0 + 1e-10)]
    (panel,) = sweep_picture(over([1.0, 2.0], cells), ASKED).axes
    low, high = panel.get_ylim()
    assert high - low > 1e-4


# Two keys.
MAPPED = {"route.pitch": [0.5, 0.6, 0.7], "dragon.width": [0.2, 0.3]}


def mapped(cells: Sequence[Mapping[str, Any]]) -> Figure:
    return sweep_picture(made(grid_points(MAPPED), cells), ASKED, "x")


def hatched(panel: Axes) -> list[PolyCollection]:
    return [one for one in panel.collections if isinstance(one, PolyCollection) and one.get_hatch()]


def test_a_grid_is_a_map_with_each_answer_in_its_cell_and_contours() -> None:
    values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    figure = mapped([exact(value) for value in values])
    panel, bar = figure.axes
    (mesh,) = (one for one in panel.collections if isinstance(one, QuadMesh))
    assert np.asarray(mesh.get_array()).reshape(2, 3).tolist() == [[1.0, 3.0, 5.0], [2.0, 4.0, 6.0]]
    assert panel.get_xlabel() == "route.pitch (m)"
    assert panel.get_ylabel() == "dragon.width (m)"
    assert bar.get_ylabel() == "first contact (s)"
    assert mesh.get_clim() == (1.0, 6.0)
    assert {text.get_text() for text in panel.texts} == {"2", "3", "4", "5"}
    assert hatched(panel) == []


def test_cells_without_an_answer_are_hatched_and_empty() -> None:
    cells = [exact(1.0), none("clear"), exact(3.0), none("clear"), none("refused"), exact(6.0)]
    figure = mapped(cells)
    panel = figure.axes[0]
    (mesh,) = (one for one in panel.collections if isinstance(one, QuadMesh))
    assert np.ma.getmaskarray(np.ma.asarray(mesh.get_array())).ravel().tolist() == [
        False,
        False,
        True,
        True,
        True,
        False,
    ]
    found = {str(one.get_label()): one for one in hatched(panel)}
    assert set(found) == {"no contact", "cannot be"} == set(legend(figure))
    (two,) = found["no contact"].get_paths()
    assert np.ptp(np.asarray(two.vertices), axis=0) == pytest.approx([0.2, 0.1])
    (one,) = found["cannot be"].get_paths()
    assert np.asarray(one.vertices).min(axis=0) == pytest.approx([0.65, 0.15])


def test_labels_of_contours_do_not_lie_upon_one_another() -> None:
    x, y = np.linspace(0.4, 0.6, 30), np.linspace(0.2, 0.4, 30)
    points = grid_points({"route.pitch": x.tolist(), "dragon.width": y.tolist()})
    cells = [exact(math.tanh(200.0 * (points[n][0] - 0.5))) for n in range(len(points))]  # type: ignore[operator]
    panel = sweep_picture(made(points, cells), ASKED).axes[0]
    turn = panel.transAxes.inverted()
    places = [turn.transform(panel.transData.transform(text.get_position())) for text in panel.texts]
    assert places
    for one, other in itertools.combinations(places, 2):
        assert (np.abs(one - other) > 0.05).any()


def scattered(count: int = 60) -> tuple[Points, list[dict[str, Any]]]:
    """Points that are no grid; from a pitch on there is no answer."""
    random = np.random.default_rng(1)
    x, y = random.uniform(0.4, 0.6, count), random.uniform(0.2, 0.4, count)
    points = listed_points({"route.pitch": x.tolist(), "dragon.width": y.tolist()})
    return points, [exact(a + b) if a < 0.5 else none("unwalkable") for a, b in zip(x, y, strict=True)]


def test_scattered_points_are_joined_by_triangles_and_hatched_where_one_has_no_answer() -> None:
    points, cells = scattered()
    panel = sweep_picture(made(points, cells), ASKED).axes[0]
    mesh: Any = next(one for one in panel.collections if isinstance(one, TriMesh))
    drawn = np.asarray(mesh._triangulation.get_masked_triangles())
    x = np.array(points.columns[0])
    assert len(drawn)
    assert (x[drawn] < 0.5).all()
    (gaps,) = hatched(panel)
    assert len(gaps.get_paths()) + len(drawn) == len(mesh._triangulation.triangles)
    for path in gaps.get_paths():
        assert np.asarray(path.vertices)[:, 0].max() >= 0.5


def test_points_on_a_line_and_points_without_any_answer_are_drawn_all_the_same(tmp_path: Path) -> None:
    line = listed_points({"route.pitch": [0.4, 0.5, 0.6], "dragon.width": [0.2, 0.3, 0.4]})
    figures = [
        sweep_picture(made(line, [exact(1.0), exact(2.0), none("clear")]), ASKED),
        sweep_picture(made(line, [none("clear")] * 3), ASKED),
        mapped([none("refused")] * 6),
        mapped([exact(1.0)] * 6),
        sweep_picture(over([1.0, 2.0], [none("lost")] * 2), ASKED),
        sweep_picture(over([1.0], [exact(2.0)]), ASKED),
        sweep_picture(made(scattered()[0], [none("clear")] * 60), ASKED),
    ]
    for figure in figures:
        write_picture(figure, tmp_path / "x.svg", "x", PLAN.sha256)
    assert len(hatched(figures[2].axes[0])) == 1


# Three keys and more.
def test_a_grid_of_three_keys_has_a_map_for_each_value_of_the_third() -> None:
    points = grid_points({**MAPPED, "dragon.body_length": [2.0, 2.1, 2.2, 2.3]})
    figure = sweep_picture(made(points, [exact(float(n)) for n in range(len(points))]), ASKED)
    maps = [axes for axes in figure.axes if axes.get_title()]
    assert [axes.get_title() for axes in maps] == [
        f"dragon.body_length = {value} m" for value in ("2", "2.1", "2.2", "2.3")
    ]
    limits = {one.get_clim() for axes in maps for one in axes.collections if isinstance(one, QuadMesh)}
    assert limits == {(0.0, 23.0)}
    third = next(one for one in maps[2].collections if isinstance(one, QuadMesh))
    assert np.asarray(third.get_array()).reshape(2, 3)[1, 2] == 4 * 5 + 2


def test_a_last_row_that_is_not_full_lies_as_near_as_a_full_one() -> None:
    between = []
    for lengths in ([2.0, 2.1, 2.2, 2.3], [2.0, 2.1, 2.2, 2.3, 2.4, 2.5]):
        points = grid_points({**MAPPED, "dragon.body_length": lengths})
        figure = sweep_picture(made(points, [exact(float(n)) for n in range(len(points))]), ASKED)
        lay_out(figure)
        above, below = figure.axes[0], figure.axes[3]
        between.append(above.get_position().y0 - below.get_position().y1)
        assert figure.axes[1].xaxis.get_tick_params()["labelbottom"] is (len(lengths) == 4)
    assert between[0] == pytest.approx(between[1], abs=1e-6)


def test_of_too_many_maps_some_are_drawn_and_the_rest_are_counted() -> None:
    points = grid_points({**MAPPED, "dragon.body_length": np.linspace(2.0, 3.0, 20).tolist()})
    sweep = made(points, [exact(float(n)) for n in range(len(points))])
    found = layout(answered(sweep, ASKED))
    assert (len(found.panels), found.left_out) == (MOST_PANELS, 20 - MOST_PANELS)
    assert found.panels[0] == (2.0,)
    assert found.panels[-1] == (3.0,)
    figure = sweep_picture(sweep, ASKED)
    assert figure.get_supxlabel() == "8 more are not drawn"


def test_a_sample_of_three_keys_has_a_picture_for_each_with_all_answers() -> None:
    random = np.random.default_rng(2)
    keys = ("route.pitch", "dragon.width", "dragon.body_length")
    points = listed_points({key: random.uniform(0.3, 0.4, 40).tolist() for key in keys})
    cells = [exact(float(n), 1, 3 + n % 2) if n % 4 else none("unwalkable") for n in range(40)]
    figure = sweep_picture(made(points, cells), ASKED)
    assert [axes.get_xlabel() for axes in figure.axes] == [f"{key} (m)" for key in keys]
    for number, axes in enumerate(figure.axes):
        (dots,) = axes.collections
        wanted = [(points[n][number], float(n)) for n in range(40) if n % 4]
        assert np.asarray(dots.get_offsets()) == pytest.approx(np.array(wanted))
        assert len({tuple(colour) for colour in np.asarray(dots.get_facecolor())}) == 2
        (rug,) = axes.lines
        assert len(xy(rug)) == 10
    assert legend(figure) == ["benches 1 and 3", "benches 1 and 4", "cannot be walked"]


def test_texts_beside_numbers_tell_pictures_apart_with_the_same_colours() -> None:
    points = grid_points({"route.clockwise": ["true", "false"], "route.pitch": [0.5, 0.6, 0.7]})
    cells = [exact(1.0, 1, 9), exact(2.0, 1, 9), exact(3.0, 1, 8)]
    cells += [exact(1.0, 1, 8), exact(2.0, 1, 8), exact(3.0, 1, 9)]
    figure = sweep_picture(made(points, cells), ASKED)
    one, two = figure.axes
    assert one.get_title() == "route.clockwise = true"
    first = [curves(panel)[0].get_color() for panel in (one, two)]
    last = [curves(panel)[-1].get_color() for panel in (one, two)]
    assert first == last[::-1]
    assert first[0] != first[1]


def test_a_key_with_one_value_takes_no_axis() -> None:
    points = grid_points({"dragon.width": [0.3], "route.pitch": [0.5, 0.6]})
    (panel,) = sweep_picture(made(points, [exact(1.0), exact(2.0)]), ASKED).axes
    assert panel.get_xlabel() == "route.pitch (m)"
    assert len(curves(panel)) == 1


def test_a_question_that_was_not_asked_is_refused() -> None:
    with pytest.raises(InputError, match="did not ask clearance, but first_contact"):
        sweep_picture(stepped(), "clearance")


def test_nothing_of_a_picture_is_cut_off_in_either_language(spoken: str) -> None:
    points = grid_points({**MAPPED, "dragon.body_length": [2.0, 2.1, 2.2, 2.3]})
    maps = made(points, [exact(1e-5 * n) if n % 5 else none("clear") for n in range(len(points))])
    for sweep in (stepped(), maps):
        figure = sweep_picture(sweep, ASKED, f"{spoken} 盘入 <b> $x$")
        lay_out(figure)
        box = figure.bbox
        parts = [*figure.legends, *figure.axes, *([figure._suptitle] if figure._suptitle else [])]  # type: ignore[attr-defined]
        for part in parts:
            around = part.get_tightbbox()
            assert around.x0 >= box.x0 - 1
            assert around.x1 <= box.x1 + 1
            assert around.y0 >= box.y0 - 1
            assert around.y1 <= box.y1 + 1
