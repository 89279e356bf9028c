"""What readers draw: pictures of their own, and into axes of a figure of theirs."""

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import matplotlib
import numpy as np
import pytest
import shapely
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.figure import Figure

import benchdragon as bd
from benchdragon.figures.style import STYLE
from benchdragon.figures.walk import MOST_PANELS

PLAN = bd.read_plan("turn", ["dragon.benches=30", "walk.start=-5", "walk.end=20"])
WALK = PLAN.build()
MOTION = WALK.motion(np.linspace(-5.0, 20.0, 26))
HALL = bd.read_plan(
    "spiral-in",
    ["dragon.benches=4", "route.start_turn=9", "walk.end=2", "venue.rectangle=[14, 14]"],
)
COIL = bd.read_plan("spiral-in")
CONTACT = bd.first_contact(COIL.build(), 400.0, 430.0)


def axes_of(count: int = 1) -> list[Axes]:
    return list(Figure().subplots(1, count, squeeze=False).flat)


def benches(panel: Axes) -> list[PolyCollection]:
    return [one for one in panel.collections if isinstance(one, PolyCollection)]


@pytest.mark.parametrize(
    ("draw", "says"),
    [
        (WALK.route.plot, "x (m)"),
        (bd.Arc(5.0, 1.0).plot, "x (m)"),
        (MOTION.plot, "x (m)"),
        (PLAN.plot, "x (m)"),
        (lambda ax: MOTION.plot_speeds(ax, joints=True), "time (s)"),
        (lambda ax: bd.check(HALL).plot(ax), "x (m)"),
        (lambda ax: bd.clearance_curve(WALK, [0.0, 1.0, 2.0]).plot(ax, margin=0.1), "time (s)"),
        (lambda ax: bd.swept_area(WALK, 0.0, 5.0, margin=1.0).plot(ax), "x (m)"),
    ],
)
def test_what_is_drawn_on_axes_of_a_reader_stays_in_his_figure(
    draw: Callable[[Axes], Figure], says: str
) -> None:
    (panel,) = axes_of()
    before = {name: matplotlib.rcParams[name] for name in STYLE}
    assert draw(panel) is panel.figure
    assert panel.get_xlabel() == says
    assert panel.has_data()
    assert {name: matplotlib.rcParams[name] for name in STYLE} == before
    drawn: Any = draw
    own = drawn(None)
    assert own.axes[0].get_xlabel() == says


def test_a_motion_is_drawn_at_times_of_its_own_or_at_any_others() -> None:
    assert [one.get_title() for one in MOTION.plot(at=[0.5, 14.0]).axes] == ["t = 0.5 s", "t = 14 s"]
    spread = [one.get_title() for one in MOTION.plot().axes]
    assert (len(spread), spread[0], spread[-1]) == (MOST_PANELS, "t = −5 s", "t = 20 s")
    panels = axes_of(2)
    MOTION.plot(panels, at=[3.0, 4.0])
    assert [one.get_title() for one in panels] == ["t = 3 s", "t = 4 s"]
    MOTION.plot(np.array(panels))
    with pytest.raises(bd.InputError, match="3 times need as many axes, not 2"):
        MOTION.plot(panels, at=[1.0, 2.0, 3.0])
    with pytest.raises(bd.InputError, match="as many axes, not 0"):
        MOTION.plot([], at=[1.0])


def test_benches_have_the_colours_of_their_speeds_with_one_scale_beside_all() -> None:
    figure = MOTION.plot(at=[0.0, 14.0], colour="speed")
    first, second, scale = figure.axes
    assert scale.get_ylabel() == "speed (m/s)"
    still, turning = (
        len(np.unique(benches(one)[0].get_facecolor(), axis=0)) for one in (first, second)
    )
    assert turning > 2
    assert still < turning
    plain = MOTION.plot(at=14.0).axes[0]
    assert len(np.unique(benches(plain)[0].get_facecolor(), axis=0)) == 1
    wrong: Any = "heat"
    with pytest.raises(bd.InputError, match='colour must be "speed" or None'):
        MOTION.plot(colour=wrong)


def test_a_plan_is_drawn_with_its_disc_and_its_square() -> None:
    turning = PLAN.plot(at=14.0).axes[0]
    assert [one.get_label() for one in turning.patches] == ["disc"]
    assert turning.get_figure().get_suptitle() == PLAN.title("en")  # type: ignore[union-attr]
    hall = HALL.plot().axes[0]
    assert "edge of the venue" in hall.get_legend_handles_labels()[1]


def test_an_answer_is_drawn_where_its_witness_stands_with_what_meets() -> None:
    assert CONTACT is not None
    whole, close = CONTACT.plot(COIL).axes[:2]
    assert whole.get_title() == "t = 412.473838 s"
    assert close.get_title() == "benches 1 and 9: they touch"
    (panel,) = axes_of()
    CONTACT.plot(COIL.build(), panel)
    assert panel.get_title() == "benches 1 and 9: they touch"
    far = bd.first_contact(COIL.build(), 0.0, 1.0)
    assert far is None
    with pytest.raises(bd.InputError, match="names no benches that meet"):
        bd.greatest_speed(WALK, 0.0, 1.0).plot(WALK)
    wrong: Any = 1.0
    with pytest.raises(
        bd.InputError, match=r"of must be a Walk, not 1\.0: the plan or the walk that was"
    ):
        CONTACT.plot(wrong)


def test_a_route_is_drawn_along_its_points_with_its_joints() -> None:
    route = bd.Route.joined([bd.Line(10.0), bd.Arc(5.0, 3.0), bd.Line(10.0)])
    (panel,) = axes_of()
    route.plot(panel, label="loop")
    drawn, behind, start, joints = panel.lines
    line = shapely.LineString(np.asarray(drawn.get_xydata()))
    assert line.length == pytest.approx(route.length, rel=1e-4)
    assert behind.get_xdata()[0] == -10.0  # type: ignore[index]
    assert start.get_xydata().tolist() == [[0.0, 0.0]]  # type: ignore[union-attr]
    assert np.allclose(joints.get_xydata(), route.point(route.joints[1:-1]))
    assert drawn.get_label() == "loop"


def test_speeds_need_times_that_increase() -> None:
    figure = MOTION.plot_speeds()
    (mesh,) = (one for one in figure.axes[0].collections if isinstance(one, QuadMesh))
    assert np.array_equal(np.asarray(mesh.get_array()), MOTION.speed.T)
    for times in ([0.0], [1.0, 0.0]):
        with pytest.raises(bd.InputError, match="two or more times that increase"):
            WALK.motion(times).plot_speeds()


def test_the_ground_covered_and_its_line_are_drawn_as_they_are() -> None:
    area = bd.swept_area(WALK, 0.0, 5.0, margin=1.0)
    (panel,) = axes_of()
    area.plot(panel)
    for patch, shape in zip(panel.patches, (area.polygon, area.spectators), strict=True):
        box = patch.get_path().get_extents().extents
        assert np.allclose(box, shape.bounds)


def test_a_figure_of_ones_own_in_our_style_draws_chinese() -> None:
    """In a process that has drawn nothing yet, where no font of ours is known."""
    script = (
        "import warnings; warnings.simplefilter('error')\n"
        "import matplotlib; matplotlib.use('agg')\n"
        "import matplotlib.pyplot as plt, benchdragon as bd\n"
        "with bd.picture_style():\n"
        "    figure, panel = plt.subplots()\n"
        "    panel.set_xlabel('螺距 (m)')\n"
        "    figure.canvas.draw()\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
