"""Ten tasks of a researcher, by public names alone: each as it would be written in a script."""

import math
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

import benchdragon as bd


def test_walk_the_contests_dragon_and_read_a_table_of_it() -> None:
    motion = bd.read_plan("spiral-in").motion(np.arange(301.0))
    assert motion.x.shape == (301, 224)
    assert motion[300].x[0, 223] == pytest.approx(1.785033, abs=1e-6)
    assert motion[300].speed[0, 1] == pytest.approx(0.999709, abs=1e-6)


def test_lay_a_route_of_ones_own_and_find_where_its_benches_stand() -> None:
    route = bd.Route.joined(
        [bd.Line(60.0), bd.Clothoid(6.0, 0.0, 0.1), bd.Arc(10.0, degrees=200), bd.Line(30.0)]
    )
    walk = bd.Walk(bd.Dragon.uniform(20), route, start=45.0)
    motion = walk.motion([0.0, 40.0])
    inside = [bench for bench in motion.outlines()[1] if bench.bounds[0] > 60.0]
    assert 0 < len(inside) < 20
    assert walk.least_clearance().value > 0.1


def test_find_when_benches_first_touch_and_draw_it() -> None:
    coil = bd.read_plan("spiral-in")
    contact = coil.first_contact()
    assert contact is not None
    assert contact.value == pytest.approx(412.473837682, abs=1e-8)
    figure = contact.plot(coil)
    assert figure.axes[1].get_title() == "benches 1 and 9: they touch"


def test_sweep_a_size_and_go_on_with_the_answers_as_a_table() -> None:
    pandas = pytest.importorskip("pandas")
    plan = bd.read_plan("spiral-in", dragon={"benches": 40})
    with ThreadPoolExecutor(2) as threads:
        found = plan.sweep({"route.pitch": [0.45, 0.5, 0.55]}, ["first_contact"], executor=threads)
    table = found.to_dataframe()
    assert isinstance(table, pandas.DataFrame)
    late = table.set_index("route.pitch")["first_contact.value"]
    assert late.is_monotonic_increasing


def test_draw_four_answers_into_one_figure_with_axes_of_ones_own() -> None:
    turn = bd.read_plan("turn", {"dragon.benches": 60, "walk.start": 0.0, "walk.end": 40.0})
    motion = turn.motion(np.linspace(0.0, 40.0, 81))
    figure, ((whole, fast), (near, ground)) = plt.subplots(2, 2, figsize=(9.0, 9.0))
    motion.plot(whole, at=14.0, colour="speed")
    motion.plot_speeds(fast, joints=True)
    turn.clearance_curve(motion.times).plot(near)
    turn.swept_area(margin=1.0).plot(ground)
    whole.set_title("my own title")
    assert all(panel.has_data() for panel in (whole, fast, near, ground))
    assert whole.get_title() == "my own title"
    plt.close(figure)


def test_write_a_plan_in_code_and_judge_it() -> None:
    plan = bd.Plan(
        dragon={"benches": 30},
        route={"kind": "spiral-in", "pitch": 0.9, "start_turn": 10},
        disc={"radius": 3.0},
        obstacle=[{"kind": "circle", "name": "well", "centre": [0, 0], "radius": 0.6}],
        limits={"speed": 2.0},
    )
    report = plan.check()
    assert report.safe, str(report)
    assert report.obstacles[0].distance.value > 1.0
    with pytest.raises(bd.PlanError, match=r"did you mean route\.pitch"):
        plan.with_value("route.pich", 1.0)


def test_walk_with_a_speed_that_changes() -> None:
    plan = bd.read_plan("spiral-in", {"dragon.benches": 30})
    walk = plan.build()
    slow = bd.Walk(walk.dragon, walk.route, bd.SpeedProfile((0.0, 10.0), (0.0, 1.2)), walk.start)
    motion = slow.motion(np.linspace(0.0, 20.0, 201))
    assert motion.head_speed[0] == 0.0
    assert slow.greatest_speed(0.0, 20.0).value == pytest.approx(motion.speed.max(), rel=1e-6)
    assert motion.acceleration[50, 0] == pytest.approx(0.12)


def test_ask_how_small_the_pitch_and_how_fast_the_head_may_be() -> None:
    pitch = bd.read_plan("spiral-in", {"disc.radius": 4.5}).smallest_pitch()
    assert pitch.lower <= pitch.value <= pitch.upper
    assert pitch.value == pytest.approx(0.450337393, abs=1e-9)
    speed = bd.read_plan("turn").greatest_head_speed()
    assert speed.value == pytest.approx(1.246266358, abs=1e-9)


def test_make_a_film(tmp_path: Path) -> None:
    plan = bd.read_plan("turn", dragon={"benches": 10})
    film = plan.animate(tmp_path / "turn.gif", start=10.0, end=10.2, fps=10, size=(160, 90))
    assert film.read_bytes().startswith(b"GIF8")
    with pytest.raises(bd.BenchDragonError, match="there already"):
        plan.animate(film, start=10.0, end=10.2, fps=10, size=(160, 90))


def test_show_a_dance_in_a_notebook() -> None:
    plan = bd.read_plan("turn", {"dragon.benches": 10, "walk.start": 0.0, "walk.end": 20.0})
    player = plan.show()
    assert "<iframe" in player._repr_html_()
    assert "<svg" in plan._repr_html_()
    loop = bd.Walk(bd.Dragon.uniform(3), bd.Route((bd.Arc(9.0, 2.0 * math.pi),)), start=12.0)
    assert "<iframe" in bd.show(loop)._repr_html_()
