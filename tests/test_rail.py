"""The manual's page on rail vehicles: what its cells print and its text says, in both languages."""

import io
import re
from contextlib import redirect_stdout
from typing import Any

import numpy as np
import pytest

from benchdragon import Arc, Bench, Clothoid, Dragon, Line, Placement, Route, bench_offsets
from tests.test_docs import blocks, source

PRINTED = """
 R (m)   centre   a²/8R      end  (L²-a²)/8R   corner (mm)
   150  270.243 270.000  293.047     293.333  287.297
   300  135.030 135.000  146.631     146.667  145.184
   600   67.504  67.500   73.329      73.333   72.966
  1200   33.750  33.750   36.666      36.667   36.575
  4000   10.125  10.125   11.000      11.000   10.992
beside the exact formulas off by less than 1e-12 m: True
centre 40500 / R mm, ends 44000 / R mm
pivots 2.604 mm inside, by the approximation 2.604 mm
centre throw 137.636 mm, end throw 144.028 mm
place (m)  centre  a²/8R  leading  trailing  (L²-a²)/8R  (mm)
      -22    0.00   0.00     0.00      0.00        0.00
      -15    0.00   0.00     0.00      0.71        0.00
      -10    0.00   0.00     0.00      3.56        0.00
        0    3.38   0.00     0.00     21.19        0.00
       10   22.50  22.50     6.81     45.63       24.44
       20   45.00  45.00    27.72     70.07       48.89
       30   67.50  67.50    52.15     94.51       73.33
       40   90.01  90.00    76.59    118.93       97.78
       50  112.52 112.50   101.03    139.82      122.22
       60  131.65 135.00   125.46    146.63      146.67
       70  135.03 135.00   143.08    146.63      146.67
       82  135.03 135.00   146.63    146.63      146.67
middle: off by at most 0.015 mm
leading end: off by at most 0.024 mm
trailing end: off by at most 0.012 mm
centre: 3.375 mm, with the vehicle's middle at 0.00 m
leading end: 12.093 mm, with the vehicle's middle at 0.00 m
trailing end: 1.500 mm, with the vehicle's middle at 0.00 m
centre: 135.030389 mm (circle 135.030389 mm) from 9.00 m into the arc on; 5 m earlier 134.451 mm
leading end: 146.630832 mm (circle 146.630832 mm) from 22.00 m into the arc on; 5 m earlier 146.374 mm
trailing end: 146.630832 mm (circle 146.630832 mm) from 0.00 m into the arc on; 5 m earlier 145.485 mm
centre: at most 254.928 mm, +0.00 m from the curve's centre; circle 270.243 mm
leading end: at most 265.345 mm, +8.15 m from the curve's centre; circle 293.047 mm
trailing end: at most 265.345 mm, -8.15 m from the curve's centre; circle 293.047 mm
circle: centre 202.60 mm, ends 219.88 mm
joined directly: at most centre 202.60 mm, leading end 219.88 mm, trailing end 219.88 mm
  where the curvature changes sign: leading end -219.88 mm, trailing end 219.88 mm, 439.76 mm from one another
with transitions: at most centre 202.60 mm, leading end 219.88 mm, trailing end 219.88 mm
  where the curvature changes sign: leading end -63.55 mm, trailing end 63.55 mm, 127.11 mm from one another
both computations differ by less than 1e-9 m: True
"""  # noqa: E501 - as printed
LANGUAGES = ("en", "zh")


def run(language: str) -> tuple[str, dict[str, Any]]:
    """What the page's cells print, but for the one that sets the language, and what they leave."""
    cells = blocks(source(language, "rail.md"), "{code-cell}")
    cells = [cell for cell in cells if "use_language" not in cell]
    names: dict[str, Any] = {}
    with redirect_stdout(io.StringIO()) as printed:
        for cell in cells:
            exec(compile(cell, "rail.md", "exec"), names)
    return printed.getvalue(), names


@pytest.fixture(scope="module")
def pages() -> dict[str, tuple[str, dict[str, Any]]]:
    return {language: run(language) for language in LANGUAGES}


def numbers(text: str) -> list[str]:
    return re.findall(r"(?<![\w.])[-+]?\d[\d.]*(?:e-\d+)?|True|False", text)


def test_the_page_prints_these_numbers_in_both_languages(
    pages: dict[str, tuple[str, dict[str, Any]]],
) -> None:
    assert pages["en"][0].strip() == PRINTED.strip()
    assert numbers(pages["zh"][0]) == numbers(PRINTED)


def test_both_computations_of_the_page_agree_far_better_than_is_said(
    pages: dict[str, tuple[str, dict[str, Any]]],
) -> None:
    for _printed, names in pages.values():
        assert 0.0 < names["largest"] < 1e-11
        assert np.abs(names["by_hand"]).max() > 0.2


# What the text says, by language, and the numbers that it must say there.
SAID: list[tuple[str, str, tuple[float, ...]]] = [
    (r"page is (\S+) m long, its pivots are (\S+) m", r"车辆长 (\S+) m，定距 (\S+) m", (26.0, 18.0)),
    (r"terms (\d+)/R and (\d+)/R", r"中的 (\d+)/R 和 (\d+)/R", (40500.0, 44000.0)),
    (r"2 = (\S+) m before it", r"2 = (\S+) m 时", ((26.0 + 18.0) / 2.0,)),
    (r"\$L/3\$ = (\S+) m from", r"\$L/3\$ = (\S+) m。", (round(26.0 / 3.0, 2),)),
    (r"is on the arc, (\S+) mm in (\d+) m", r"半径 (\d+) m 时为 (\S+) mm", (2.6, 300.0)),
    (r"are good to (\S+) mm at (\d+) m", r"半径 (\d+) m 时近似式的误差不超过 (\S+) mm", (0.3, 150.0)),
    (
        r"A straight, a clothoid of (\d+) m, an arc of (\d+) m",
        r"直线、(\d+) m 长的\S+、半径 (\d+) m",
        (60.0, 300.0),
    ),
    (
        r"of (\d+) m with an arc of (\d+) m and (\d+) m",
        r"两段 (\d+) m \S+夹 (\d+) m 长、半径 (\d+) m",
        (20.0, 5.0, 150.0),
    ),
    (
        r"Two arcs of (\d+) m radius, left then right, (\d+) m each; .* transitions of (\d+) m",
        r"两段半径 (\d+) m 的圆曲线，先左后右，各长 (\d+) m；.*四段 (\d+) m",
        (200.0, 60.0, 30.0),
    ),
]  # fmt: skip


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("statement", SAID, ids=lambda statement: statement[0])
def test_the_text_says_the_numbers_of_the_cells(
    statement: tuple[str, str, tuple[float, ...]], language: str
) -> None:
    text = re.sub(r"(?<=[^\x00-\xff])\n", "", source(language, "rail.md"))
    pattern = {"en": statement[0], "zh": statement[1]}[language]
    found = re.search(pattern, " ".join(text.split()))
    assert found is not None
    assert sorted(float(number) for number in found.groups()) == sorted(statement[2])


def test_the_cells_are_of_the_sizes_that_the_text_says(
    pages: dict[str, tuple[str, dict[str, Any]]],
) -> None:
    names = pages["en"][1]
    assert (names["length"], names["a"], names["overhang"]) == (26.0, 18.0, 4.0)
    kinds = {
        "entry": [(60.0, 0.0, 0.0), (60.0, 0.0, 300.0), (100.0, 300.0, 300.0)],
        "short": [
            (60.0, 0.0, 0.0), (20.0, 0.0, 150.0), (5.0, 150.0, 150.0), (20.0, 150.0, 0.0),
            (60.0, 0.0, 0.0),
        ],
    }  # fmt: skip
    for name, pieces in kinds.items():
        for curve, (length, *radii) in zip(names[name], pieces, strict=True):
            bends = [1.0 / radius if radius else 0.0 for radius in radii]
            np.testing.assert_allclose(curve.curvature([0.0, curve.length]), bends, atol=1e-15)
            assert curve.length == pytest.approx(length)
    direct, eased = names["reverse"].values()
    assert [curve.length for curve in direct] == pytest.approx([60.0] * 4)
    assert [curve.length for curve in eased] == pytest.approx([60, 30, 60, 30, 30, 60, 30, 60])


def test_the_trailing_end_is_thrown_from_22_m_before_the_transition_on() -> None:
    """A seventh of the arc's throw beside the transition's beginning, and none 22 m before."""
    vehicle = Dragon([Bench(26.0, 3.1, 4.0, 4.0)])
    track = Route.joined((Line(60.0), Clothoid(60.0, 0.0, 1 / 300), Arc(300.0, 0.5)))
    found = bench_offsets(
        Placement(vehicle, track, np.linspace(59.0, 90.0, 3101)), points=[(-13.0, 0.0)]
    )
    s, throw = found.s[:, 0], -found.offset[:, 0]
    assert np.abs(throw[s <= 38.0]).max() < 1e-12
    assert (throw[s > 38.5] > 0.0).all()
    share = np.interp(60.0, s, throw) / 0.146630832
    assert round(1.0 / share) == 7


@pytest.mark.parametrize("seed", range(8))
def test_a_throw_is_the_formula_with_a_mean_of_the_curvature_to_first_order(seed: int) -> None:
    """The weight is linear from the first of the three points to the second, and on to the third."""
    random = np.random.default_rng(seed)
    bends = random.uniform(-1.0, 1.0, 4) / 400.0
    curves = [Clothoid(30.0, *pair) for pair in zip(bends, np.roll(bends, -1), strict=True)]
    track = Route.joined(curves)
    placed = Placement(Dragon([Bench(26.0, 3.1, 4.0, 4.0)]), track, random.uniform(30.0, 110.0, 10))
    for ahead in (0.0, 13.0, -13.0, 11.0, 4.0):
        found = bench_offsets(placed, points=[(ahead, 0.0)])
        for t in range(10):
            low, knot, high = np.sort([*placed.s[t], found.s[t, 0]])
            s = np.linspace(low, high, 20001)
            weight = np.interp(s, [low, knot, high], [0.0, 1.0, 0.0])
            mean = np.trapezoid(weight * track.curvature(s), s) / np.trapezoid(weight, s)
            formula = 0.5 * (81.0 - ahead**2) * mean
            assert found.offset[t, 0] == pytest.approx(formula, abs=2e-4)
