"""The permit annex in the planner's page, as it is printed: numbers, blanks, a drawing to scale."""

import io
import math
import re
from pathlib import Path

import numpy as np
import pypdfium2
import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.check import Report, check, sentence
from benchdragon.analysis.clock import Clock
from benchdragon.analysis.off_tracking import LEAST_GAIN, MOST_GAIN, off_tracking
from benchdragon.i18n import _, spoken_in
from benchdragon.planner.page import planner_page
from benchdragon.plans.schema import read_plan
from tests.browser.axe import needs_axe, violations
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import settled
from tests.browser.village import PLAN, village

SHEETS = {"en": "benches' sheets", "zh": "板凳单"}
SAID = (
    'event.place="Temple square"', 'event.place_zh="祠堂前"', 'event.date="2027-02-20"',
    'event.organiser="V 1"', "event.spectators=813", "event.marshals=1", "event.distance=3.25",
    "event.entrances=[[3, 0, 2.25], [20, 5, 4.5], [-20, -5]]",
    "venue.rectangle=[40, 30]", "limits.speed=1.73",
    "people.sway=0.013", 'people.source.sway="M 7"', "cues.clock=18:30",
    'obstacle=[{kind="circle", centre=[12, 9], radius=1, name="well 水井"}]',
)  # fmt: skip
# Headings of chapters, as an office asks for them.
CHAPTERS = (
    "At a glance", "The tail", "Basics", "The dragon and the dance", "Route and ground, to scale",
    "Timetable", "People", "Clearances and margins", "Speeds",
    "Spectators' line and posts for marshals", "Imprecision and its chance",
    "How it is organised, and tasks and marks of safety staff", "Fire safety",
    "Buffer areas and their signs", "Tickets and security checks",
    "Vehicles, parking and ways of the crowd", "Emergencies", "Figures and where they come from",
    "Version",
)  # fmt: skip


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Report:
    return check(read_plan(str(village(tmp_path_factory.mktemp("plan"), PLAN)), SAID))


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory, report: Report) -> Path:
    path = tmp_path_factory.mktemp("planner") / "planner.html"
    path.write_text(planner_page(report.plan, "en"), "utf-8")
    return path


def annex_of(pages: Pages, file: Path, language: Language, device: Device = "desktop") -> Page:
    """The planner, showing the annex of its dance."""
    page = pages.open(f"{file.as_uri()}#lang={language}", device)
    settled(page).get_by_role("button", name=SHEETS[language], exact=True).click()
    page.locator("#sheets").get_by_role("combobox").first.select_option("annex")
    expect(shown(page)).to_have_count(1)
    return page


def shown(page: Page) -> Locator:
    return page.locator("#sheets .annex")


def printed(page: Page) -> list[str]:
    """The text of each page without white space."""
    made = pypdfium2.PdfDocument(io.BytesIO(page.pdf(prefer_css_page_size=True)))
    for sheet in made:
        assert sheet.get_size() == pytest.approx((595.3, 841.9), abs=1.0)
    return ["".join(sheet.get_textpage().get_text_bounded().split()) for sheet in made]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_annex_on_paper_tells_what_the_check_found(
    pages: Pages, file: Path, report: Report, language: Language
) -> None:
    page = annex_of(pages, file, language)
    first, *others = printed(page)
    text = "".join([first, *others])
    clock = Clock("18:30", report.start)
    with spoken_in(language):
        verdict, chapters = sentence(report, clock), [_(name) for name in CHAPTERS]
    assert "".join(verdict.split()) in first
    assert first.index("BD401") < first.index("813")
    for word in ("Fruin", "3.25", "BD401"):
        assert word in first
    assert shown(page).get_by_role("heading", level=3).all_inner_texts() == chapters
    for name in chapters:
        assert "".join(name.split()) in text, name
    assert "".join(chapters[2].split()) not in first.replace("".join(verdict.split()), "")
    for word in ("2027-02-20", "V1", "1.73m/s", "0.013m", "M7", report.plan.sha256[:12]):
        assert word in text, word
    assert ("Templesquare" if language == "en" else "祠堂前") in text
    assert ("Templesquare" if language == "zh" else "祠堂前") not in text
    links = float(report.walk.dragon.links.sum())
    assert f"{links:.2f}m" in text
    for found, unit, up in (
        (report.clearance, "m", False), (report.obstacles[0].distance, "m", False),
        (report.greatest_speed, "m/s", True),
    ):  # fmt: skip
        rows = re.findall(rf"(\d+\.\d{{2,3}}){unit}(\d+\.\d{{4}})\.\.(\d+\.\d{{4}})", text)
        held = [row for row in rows if float(row[1]) <= found.lower and found.upper <= float(row[2])]
        assert held
        assert float(held[0][0]) == pytest.approx(found.sure(up=up), abs=1e-2)


def test_words_of_the_other_language_are_not_told(pages: Pages, file: Path) -> None:
    text = "".join(printed(annex_of(pages, file, "zh")))
    own = ("Larsson", "FireSafetyJournal", "GuidetoSafetyatSportsGrounds")
    for word in ("benchdragon", "Fruin", "EPJ", *own, "well水井", *re.findall(r"[0-9a-f]{12}", text)):
        text = text.replace(word, "")
    assert not re.findall(r"[A-Za-z]{4,}", text)


WAYS = {
    "en": (
        "6.75; 2.25 of it inside the spectators' line: below, 4.50 count; entrances not counted, since "
        "the plan does not say how wide they are: 3",
        "270 by flows that were seen, 369 by the Guide",
        "3.1 by flows that were seen, 2.3 by the Guide",
    ),
    "zh": (
        "6.75；其中 2.25 在观众线以内，下面只按 4.50 算；方案没有写多宽、没有算进去的入口：3",
        "270（按实际看到的人流），369（按《指南》）",
        "3.1（按实际看到的人流），2.3（按《指南》）",
    ),
}


@pytest.mark.parametrize("language", ["en", "zh"])
def test_ways_out_are_told_from_the_widths_that_the_plan_says(
    pages: Pages, file: Path, language: Language
) -> None:
    page = annex_of(pages, file, language)
    with spoken_in(language):
        names = [
            _("width of all ways out, m"), _("people a minute whom these let through at most"),
            _("minutes until all are out, at least"),
        ]  # fmt: skip
    rows = shown(page).get_by_role("row")
    for name, told in zip(names, WAYS[language], strict=True):
        expect(rows.filter(has_text=name).get_by_role("cell")).to_have_text([told])
    expect(shown(page)).to_contain_text("Fire Safety Journal")


def test_the_tail_s_greatest_speed_is_told_with_its_bench_and_its_time(
    pages: Pages, file: Path, report: Report
) -> None:
    annex = shown(annex_of(pages, file, "en"))
    row = annex.get_by_role("row").filter(has_text="greatest speed among them that was seen")
    told = row.get_by_role("cell").inner_text()
    found = re.fullmatch(r"([0-9.]+) m/s: (the head|bench \d+), ([0-9:]+) to ([0-9:]+)", told)
    assert found is not None, told
    times = np.linspace(report.start, report.end, 2001)
    speeds = report.walk.motion(times).speed[:, :-1]
    last = speeds[:, -10:].max(axis=0)
    assert float(found[1]) == pytest.approx(last.max(), abs=0.011)
    assert float(found[1]) >= last.max() - 1e-3
    bench = int(found[2].removeprefix("bench ").replace("the head", "1"))
    assert speeds[:, bench - 1].max() == pytest.approx(last.max(), abs=1e-3)


@pytest.mark.parametrize(
    ("settings", "ways", "source"),
    [
        ((), ["13.9", "0.7"], "assumption"),
        (("people.steering=0.05", 'people.source.steering="M 9"', "event.distance=1"), ["13.9"], "M 9"),
    ],
    ids=["assumed", "measured"],
)
def test_how_far_benches_leave_the_line_is_told_with_what_it_rests_on(
    pages: Pages, tmp_path: Path, settings: tuple[str, ...], ways: list[str], source: str
) -> None:
    plan = read_plan(str(village(tmp_path, PLAN)), [*SAID, *settings])
    gains = [plan.people.steering] if plan.people.steering else [LEAST_GAIN, MOST_GAIN]
    far = [off_tracking(plan, gain).farthest() for gain in gains]
    file = tmp_path / "planner.html"
    file.write_text(planner_page(plan, "en"), "utf-8")
    annex = shown(annex_of(pages, file, "en"))
    rows = annex.get_by_role("row").filter(has_text="how far any bench leaves the line")
    about = [f"about {math.ceil(10.0 * one) / 10.0} m" for one in far]
    told = [
        f"{some}, if bearers get back half of the way in {way} m ({source})"
        for some, way in zip(about, ways, strict=True)
    ]
    expect(rows.get_by_role("cell")).to_have_text(told)
    beyond = max(far) + plan.people.sway > (plan.event.distance or math.inf)
    assert beyond == bool(settings)
    expect(annex.get_by_text("benches may come beyond it")).to_have_count(int(beyond))


def test_benches_that_would_fold_are_said_to(pages: Pages, tmp_path: Path) -> None:
    plan = read_plan("turn", ["dragon.benches=5"])
    assert off_tracking(plan, MOST_GAIN).farthest() == math.inf
    file = tmp_path / "planner.html"
    file.write_text(planner_page(plan, "en"), "utf-8")
    annex = shown(annex_of(pages, file, "en"))
    expect(annex).to_contain_text("benches would fold, if bearers get back half of")
    expect(annex.get_by_text("benches may come beyond it")).to_have_count(1)


def test_what_the_plan_does_not_say_is_a_blank_that_is_named(pages: Pages, tmp_path: Path) -> None:
    bare = read_plan(str(village(tmp_path, PLAN)))
    file = tmp_path / "planner.html"
    file.write_text(planner_page(bare, "en"), "utf-8")
    annex = shown(annex_of(pages, file, "en"))
    missing = "place, date, start of the dance, organiser, whom to ask, spectators expected, marshals"
    expect(annex).to_contain_text(f"The plan does not say: {missing}. Fill these in by hand.")
    blanks = annex.locator(".basics td:has(.blank)")
    expect(blanks).to_have_count(len(missing.split(", ")))
    expect(annex).to_contain_text("unknown: the plan has no venue")
    values = annex.get_by_role("table", name="numbers of people").locator("td").all_inner_texts()
    assert values == ["8", "", "", "", ""]
    crowd = annex.get_by_role("table", name="the crowd").locator("td").all_inner_texts()
    assert crowd[-3:] == ["", "", ""]
    expect(annex).not_to_contain_text("Fire Safety Journal")


def test_posts_are_told_from_what_stays_on_the_square(pages: Pages, file: Path, report: Report) -> None:
    annex = shown(annex_of(pages, file, "en"))
    rows = annex.get_by_role("table", name="posts for marshals").locator("tbody tr")
    names = {"entrance 1": (3.0, 0.0), "entrance 2": (20.0, 5.0), "well 水井": (12.0, 9.0)}
    names["entrance 3"] = (-20.0, -5.0)
    dots = annex.locator("circle.post")
    expect(dots).to_have_count(rows.count())
    for n in range(rows.count()):
        told = rows.nth(n).locator("td").first.inner_text()
        name, _from, steps = told.removeprefix("from ").partition(": ")
        x, y = names[name]
        for step in steps.split(", ") if steps else []:
            far, way = re.fullmatch(r"([\d.]+) m (.*)", step).groups()  # type: ignore[union-attr]
            x += {"to the right": 1, "to the left": -1}.get(way, 0) * float(far)
            y += {"forward": 1, "back": -1}.get(way, 0) * float(far)
        at = float(dots.nth(n).get_attribute("cx") or ""), -float(dots.nth(n).get_attribute("cy") or "")
        assert (x, y) == pytest.approx(at, abs=0.11)
    expect(annex).to_contain_text(f"There are {rows.count()} posts and 1 marshals")
    assert report.plan.event.marshals == 1


def test_the_ground_is_drawn_to_the_scale_that_stands_beside_it(pages: Pages, file: Path) -> None:
    page = annex_of(pages, file, "en")
    page.emulate_media(media="print")
    told = shown(page).locator(".kept p").first.inner_text()
    scale = int(re.search(r"1:(\d+)", told).group(1))  # type: ignore[union-attr]
    edge = shown(page).locator(".ground .edge")
    size = edge.evaluate("(one) => [one.getBBox(), one.getScreenCTM().a].map((b) => b.width ?? b)")
    millimetre = 96 / 25.4
    assert size[0] == 40
    assert size[0] * size[1] / millimetre == pytest.approx(40_000 / scale, rel=2e-3)
    bar = shown(page).locator(".ground .bar").bounding_box()
    metres = int(shown(page).locator(".ground .scale").inner_text().split()[0])
    assert bar is not None
    assert bar["width"] / millimetre == pytest.approx(1000 * metres / scale, abs=0.5)


def test_bearers_are_counted_and_not_named(pages: Pages, file: Path) -> None:
    page = annex_of(pages, file, "zh")
    names = page.locator("#sheets details.names")
    names.locator("summary").click()
    names.get_by_role("textbox").fill("桥号\t姓名\t电话\n龙头\t张三\t138-0000-0001\n1\t王五\t\n")
    names.get_by_role("button").first.click()
    values = shown(page).get_by_role("table", name="人数").locator("td")
    expect(values.nth(1)).to_have_text("2")
    expect(values.nth(2)).to_have_text("6")
    text = shown(page).inner_text()
    assert "张三" not in text
    assert "138" not in text


@needs_axe
@pytest.mark.parametrize(("language", "device"), [("en", "desktop"), ("zh", "phone")])
def test_axe_finds_nothing_wrong_in_the_annex(
    pages: Pages, file: Path, language: Language, device: Device
) -> None:
    page = annex_of(pages, file, language, device)
    assert violations(page) == []
    assert page.evaluate("document.getElementById('sheets').scrollWidth <= innerWidth")
