"""Pictures of drawings: the points, each route and its tightest bend, under their names."""

import numpy as np

from benchdragon.figures.drawn import drawing_picture
from benchdragon.surveys.fitting import fitted
from benchdragon.surveys.lines import DrawnLine, corners_of

POINTS = [[0.0, 0.0], [20.0, 0.0], [30.0, 12.0]]


def test_the_picture_holds_the_drawing_and_each_route_with_its_tightest_bend() -> None:
    line = DrawnLine("", corners_of(POINTS))
    fits = {"arcs": fitted(line, "G1", 0.3), "clothoids": fitted(line, "G2", 0.3)}
    (panel,) = drawing_picture(POINTS, fits, "title").axes
    drawing, *others = panel.lines
    assert np.array_equal(np.column_stack(drawing.get_data()), POINTS)
    for (name, fit), route, mark in zip(fits.items(), others[::2], others[1::2], strict=True):
        assert route.get_label() == name
        assert np.allclose(np.column_stack(route.get_data())[-1], fit.route.end_pose[0])
        assert np.allclose(np.column_stack(mark.get_data())[0], fit.route.point(fit.s))
