import hashlib
import warnings
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.figure import Figure
from PIL import Image
from pypdf import PdfReader

from benchdragon import Dragon, InputError, Line, Route, Walk
from benchdragon.figures.style import MissingGlyphWarning, drawable, write_picture
from benchdragon.figures.walk import (
    dragon_picture,
    head_angle_picture,
    speed_map,
    speed_scale,
    walk_pictures,
)
from benchdragon.i18n import use_language
from benchdragon.plans.schema import read_plan
from benchdragon.version import __version__

PLAN = read_plan("spiral-in")
WALK = PLAN.build()


def test_benches_are_drawn_to_scale() -> None:
    walk = Walk(Dragon.uniform(benches=3), Route((Line(50.0),)), start=10.0)
    corners = walk.motion([0.0]).corners()[0]
    assert corners[0, :, 0].max() == pytest.approx(10.275)
    assert np.ptp(corners[0, :, 0]) == pytest.approx(3.41)
    assert np.ptp(corners[1, :, 0]) == pytest.approx(2.20)
    assert np.ptp(corners[:, :, 1]) == pytest.approx(0.30)


def test_the_picture_holds_every_bench_and_marks_the_head() -> None:
    figure = dragon_picture(WALK.motion([0.0, 300.0]), "two", (0, 1))
    assert len(figure.axes) == 2
    for panel in figure.axes:
        bodies, head = (c for c in panel.collections if isinstance(c, PolyCollection))
        assert len(bodies.get_paths()) == 222
        assert len(head.get_paths()) == 1
        assert head.get_hatch()
        assert panel.get_xlabel() == "x (m)"
        assert panel.get_aspect() == 1.0


def test_a_dragon_that_cannot_stand_is_drawn_as_far_as_it_does() -> None:
    walk = Walk(Dragon.uniform(benches=30), Route(read_plan("turn").build().route.curves[1:]))
    motion = walk.motion([10.0, 5000.0], throw=False)
    assert motion.status.all()
    bodies = [
        c
        for c in dragon_picture(motion, "", (0, 1)).axes[0].collections
        if isinstance(c, PolyCollection)
    ]
    assert 0 < len(bodies[0].get_paths()) < 29


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_every_kind_is_written_in_both_languages_with_hash_and_version(
    tmp_path: Path, language: str, kind: str
) -> None:
    use_language(language)
    try:
        motion = WALK.motion(np.arange(0.0, 301.0, 30.0))
        figures = [dragon_picture(motion, "盘入 θ"), speed_map(motion), head_angle_picture(motion)]
        for i, figure in enumerate(figures):
            write_picture(figure, tmp_path / f"{i}.{kind}", "盘入", PLAN.sha256)
    finally:
        use_language("en")
    path = tmp_path / f"0.{kind}"
    if kind == "png":
        with Image.open(path) as image:
            text = " ".join(map(str, image.info.values()))
    elif kind == "pdf":
        reader = PdfReader(path)
        text = " ".join(map(str, (reader.metadata or {}).values()))
        assert b"NotoSansSC-Regular" in path.read_bytes()
        assert b"/Type3" not in path.read_bytes()
    else:
        text = path.read_text("utf-8")
    assert PLAN.sha256 in text
    assert f"benchdragon {__version__}" in text


def test_the_same_plan_gives_the_same_bytes(tmp_path: Path) -> None:
    digests = set()
    for name in ("a.svg", "b.svg"):
        write_picture(speed_map(WALK.motion([0.0, 1.0])), tmp_path / name, "x", PLAN.sha256)
        digests.add(hashlib.sha256((tmp_path / name).read_bytes()).hexdigest())
    assert len(digests) == 1


def test_a_sign_that_no_font_has_is_named_and_never_a_box() -> None:
    with pytest.warns(MissingGlyphWarning, match=r"𠮷 \(U\+20BB7\)"):
        assert drawable("a𠮷$") == r"a?\$"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert drawable("板凳龙 −θ 5₁") == "板凳龙 −θ 5₁"


def test_pictures_of_one_time_leave_out_the_maps() -> None:
    assert list(walk_pictures(WALK, np.array([3.0]), "x", None)) == ["dragon"]
    assert list(walk_pictures(WALK, np.array([3.0, 1.0]), "x", None)) == ["dragon"]
    assert list(walk_pictures(WALK, np.array([1.0, 3.0]), "x", 4.5)) == [
        "dragon",
        "speeds",
        "head-angle",
    ]


def colours_of(figure: Figure) -> tuple[QuadMesh, str]:
    """The mesh of a map of speeds, and at which ends its colour bar goes on."""
    (mesh,) = (one for one in figure.axes[0].collections if isinstance(one, QuadMesh))
    assert mesh.colorbar is not None
    return mesh, mesh.colorbar.extend


def test_speeds_near_the_centre_leave_the_rest_readable(spoken: str) -> None:
    """The fold in the middle is four times as fast; the scale is that of the walk before it."""
    motion = WALK.motion(np.linspace(0.0, 442.0, 500), throw=False)
    assert np.nanmax(motion.speed) > 4.0
    figure = speed_map(motion)
    mesh, extend = colours_of(figure)
    low, high = mesh.get_clim()
    assert extend == "both"
    usual = motion.speed[motion.times <= 400.0]
    assert low <= usual.min()
    assert usual.max() <= high
    assert np.ptp(usual) > 0.5 * (high - low)
    title = figure.axes[0].get_title()
    time, handle = np.unravel_index(np.nanargmax(motion.speed), motion.speed.shape)
    told = f"{motion.speed[time, handle]:.4g} m/s", f"{motion.times[time]:.4g} s"
    for text in (*told, f"{np.nanmin(motion.speed):.4g} m/s"):
        assert text in title
    assert {"en": f"handle {handle}", "zh": f"{handle} 号把手"}[spoken] in title
    assert mesh.cmap(2.0) != mesh.cmap(1.0)
    assert mesh.cmap(-1.0) != mesh.cmap(0.0)


def test_speeds_without_a_peak_have_the_whole_scale() -> None:
    motion = WALK.motion(np.linspace(0.0, 300.0, 100))
    figure = speed_map(motion)
    mesh, extend = colours_of(figure)
    assert mesh.get_clim() == (motion.speed.min(), motion.speed.max())
    assert extend == "neither"
    assert figure.axes[0].get_title() == "Speed of every handle"


def table_of(usual: float, peak: float) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Speeds of 3 handles at 100 times: 1 m/s and around, and one instant beyond it."""
    table = np.ones((100, 3))
    table[:, 1] += usual
    table[50, 2] += peak
    return table


@pytest.mark.parametrize(
    ("usual", "peak", "scale"),
    [
        (0.01, 1.0, (1.0, 1.01)),
        (0.01, -0.5, (1.0, 1.01)),
        (0.01, 0.03, (1.0, 1.03)),
        (0.0, 1.0, (1.0, 2.0)),  # nothing but the peak to be told apart
        (1e-9, 1.0, (1.0, 2.0)),
        (0.0, 0.0, (0.99, 1.01)),
        (1e-15, 0.0, (0.99, 1.01)),
    ],
)
def test_the_scale_of_speeds_is_that_of_most_instants(
    usual: float, peak: float, scale: tuple[float, float]
) -> None:
    assert speed_scale(table_of(usual, peak)) == pytest.approx(scale, abs=1e-12)


def test_scales_of_dragons_that_stand_still_or_stand_nowhere() -> None:
    assert speed_scale(np.zeros((9, 3))) == (0.0, 0.01)
    assert speed_scale(np.full((9, 3), np.nan)) == (0.0, 1.0)
    half = np.full((9, 3), np.nan)
    half[:4, :2] = [1.0, 1.5]
    assert speed_scale(half) == (1.0, 1.5)
    lost = Walk(WALK.dragon, Route(read_plan("turn").build().route.curves[1:]))
    mesh, extend = colours_of(speed_map(lost.motion([1e6, 1e6 + 1.0], throw=False)))
    assert (mesh.get_clim(), extend) == ((0.0, 1.0), "neither")


@pytest.mark.parametrize(("peak", "end"), [(1.0, "max"), (-0.5, "min")])
def test_the_bar_goes_on_only_where_speeds_do(peak: float, end: str) -> None:
    motion = WALK.motion(np.linspace(0.0, 300.0, 100))
    motion.__dict__["speed"] = table_of(0.01, peak).repeat(75, axis=1)[:, :224]
    assert colours_of(speed_map(motion))[1] == end


def test_a_dragon_too_long_to_be_seen_is_refused() -> None:
    walk = Walk(Dragon.uniform(benches=20_001), WALK.route)
    with pytest.raises(InputError, match="a picture shows at most 20000 benches, not 20001"):
        walk_pictures(walk, np.array([0.0]), "x", None)
