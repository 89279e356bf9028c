"""The chalk plan of the planner's page: Python's numbers, on one page of paper, and as a file."""

import csv
import io
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pypdfium2
import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.chalk import ARM, ChalkPlan, Tick, chalk_plan
from benchdragon.analysis.chalk_line import Trail
from benchdragon.analysis.ground import Ground, peg_line
from benchdragon.i18n import spoken_in
from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import Plan, checked, read_plan
from tests.browser.pages import Language, Pages
from tests.browser.planners import settled

NAMES = {"en": "benches' sheets", "zh": "板凳单"}
BENDS = [{"kind": "arc", "radius": 6, "angle": 90}, {"kind": "line", "length": 20}]
STREET = {"kind": "parts", "part": [{"kind": "line", "length": 70}, *BENDS, *BENDS]}
DANCES = {
    "contest": read_plan("spiral-in", ["walk.end=20"]),
    "village": read_plan("pujiang", ["dragon.benches=20", "venue.rectangle=[40, 30]"]),
    "street": checked(
        {
            "schema": 1,
            "dragon": {"benches": 6},
            "route": STREET,
            "walk": {"speed": 1.0, "position": 14, "end": 80},
        },
        "plan",
    ),
}
LETTERS = {"tail": "A", "head": "B", "end": "C"}


def laid(plan: Plan) -> tuple[ChalkPlan, Ground]:
    """The chalk plan that Python makes."""
    walk = plan.build()
    ground = Ground.of(plan, walk.route)
    found = chalk_plan(Trail.of(walk, *plan.span(walk)), float(walk.dragon.links.min()), ground)
    assert found is not None
    return found, ground


def told(ticks: Iterable[Tick]) -> list[Any]:
    """Ticks of a tape as the table should have them: from its beginning on, to the centimetre."""
    return [
        (tick.out, rounded(tick.along), rounded(tick.aside), LETTERS.get(tick.kind, ""))
        for tick in sorted(ticks, key=lambda one: one.along)
    ]


def rounded(length: float) -> Any:
    return pytest.approx(length, abs=0.0051)


def read(cell: str) -> tuple[bool, float, float, str]:
    """A tick as a cell of the table has it."""
    found = re.fullmatch(r"(×?)(-?[\d.]+)(?: ([◁▷])([\d.]+))?(?: ([ABC]))?", cell)
    assert found is not None, cell
    out, along, side, aside, letter = found.groups()
    return out == "×", float(along), float(aside or 0) * (-1.0 if side == "▷" else 1.0), letter or ""


def opened(pages: Pages, folder: Path, plan: Plan, language: Language) -> tuple[Page, Locator]:
    """The planner with the chalk plan of a dance."""
    file = folder / "planner.html"
    file.write_text(planner_page(plan, "en"), "utf-8")
    page = pages.open(f"{file.as_uri()}#lang={language}", "desktop")
    settled(page).get_by_role("button", name=NAMES[language], exact=True).click()
    sheets = page.locator("#sheets")
    expect(sheets.locator(".paper").first).to_be_attached(timeout=60_000)
    sheets.get_by_role("combobox").first.select_option("chalk")
    expect(sheets.locator(".chalk")).to_be_attached()
    expect(sheets).to_have_attribute("aria-busy", "false")
    return page, sheets.locator(".chalk")


@pytest.mark.parametrize(
    ("name", "language"), [("contest", "en"), ("village", "zh"), ("street", "en"), ("street", "zh")]
)
def test_the_table_on_the_one_page_has_pythons_numbers(
    pages: Pages, tmp_path: Path, name: str, language: Language
) -> None:
    found, ground = laid(DANCES[name])
    page, shown = opened(pages, tmp_path, DANCES[name], language)
    made = pypdfium2.PdfDocument(io.BytesIO(page.pdf(prefer_css_page_size=True)))
    (sheet,) = made
    assert sheet.get_size() == pytest.approx((595.3, 841.9), abs=1.0)
    words = re.sub(r"\s", "", sheet.get_textpage().get_text_bounded())
    for text in shown.locator("td").all_inner_texts():
        assert re.sub(r"\s", "", text) in words
    for n, star in enumerate(found.stars):
        rows = shown.locator("table.spokes").nth(n).locator("tbody tr").all()
        cells = [row.locator("td").all_inner_texts() for row in rows]
        for k in range(star.spokes):
            own = [one for one in found.ticks if (one.star, one.tape) == (n, k + 1)]
            assert [read(row[k]) for row in cells if row[k]] == told(own)
        assert f"{star.chord:.2f}" in words
    legs = shown.locator("table.legs tbody tr").all()
    for n, (leg, row) in enumerate(zip(found.legs, legs, strict=True), start=1):
        own = [one for one in found.ticks if (one.star, one.tape) == (-1, n)]
        start, end = leg.place, [p + leg.length * u for p, u in zip(leg.place, leg.way, strict=True)]
        number, first, last, length, swing, ticks = row.locator("td").all_inner_texts()
        assert (number, float(length)) == (str(n), rounded(leg.length))
        for place, wanted in ((first, start), (last, end)):
            assert [float(one) for one in place.split(", ")] == [rounded(one) for one in wanted]
        if n == 1:
            assert swing == "-"
        else:
            assert float(swing[1:]) * (1.0 if swing[0] == "◁" else -1.0) == rounded(leg.swing)
        assert [read(one) for one in ticks.split("; ")] == told(own)
    assert f"{found.stray:.2f}" in words
    assert f"{0.5 * found.stray:.2f}" in words
    if len(found.legs) > 1:
        assert f"{ARM:g}" in words
    with spoken_in(language):
        for one in DANCES[name].obstacles():
            line = peg_line(ground, one.outline.tolist())
            assert one.kind != "venue" or re.sub(r"\s", "", line) in words


def test_the_picture_shows_each_spoke_and_each_tick_where_it_is(pages: Pages, tmp_path: Path) -> None:
    found, _ground = laid(DANCES["village"])
    _page, shown = opened(pages, tmp_path, DANCES["village"], "zh")
    assert shown.locator(".map .tape").count() == found.stars[0].spokes
    assert shown.locator(".map .cross").count() == sum(tick.out for tick in found.ticks)
    dots = shown.locator(".map circle.mark").evaluate_all(
        "all => all.map((one) => [Number(one.getAttribute('cx')), -Number(one.getAttribute('cy'))])"
    )
    wanted = [tick.point for tick in found.ticks if not tick.out]
    assert [tuple(one) for one in dots] == [pytest.approx(one, abs=6e-4) for one in wanted]


def test_ticks_are_saved_for_total_stations(pages: Pages, tmp_path: Path) -> None:
    found, ground = laid(DANCES["village"])
    page, _shown = opened(pages, tmp_path, DANCES["village"], "en")
    with page.expect_download() as given:
        page.locator("#sheets").get_by_role("button", name="save ticks as CSV").click()
    rows = list(csv.reader(io.StringIO(Path(given.value.path()).read_text("utf-8-sig"))))
    assert len(rows) == 1 + len(found.ticks)
    for row, tick in zip(rows[1:], found.ticks, strict=True):
        assert row[1:4] == [str(tick.star + 1), str(tick.tape), LETTERS.get(tick.kind, "")]
        numbers = [tick.s, tick.along, tick.aside, *ground.seen_at(tick.point), *tick.point]
        assert [float(one) for one in row[4:]] == pytest.approx(numbers, abs=6e-4)
