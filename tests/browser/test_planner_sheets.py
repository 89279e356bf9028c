"""The benches' sheets of the planner's page, as they are printed: what Python's say, on paper."""

import csv
import io
import re
import wave
from collections.abc import Callable
from datetime import date
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pypdfium2
import pytest
import zxingcpp
from playwright.sync_api import Locator, Page, expect

from benchdragon.analysis.beats import Score, counted_in, score_of
from benchdragon.analysis.bench_walks import bench_walks
from benchdragon.analysis.check import check
from benchdragon.analysis.ground import Ground
from benchdragon.analysis.timetable import timetable
from benchdragon.explain.bench_basis import bench_text
from benchdragon.explain.bench_text import BenchText
from benchdragon.explain.overview_text import overview_text
from benchdragon.explain.timetable_text import TimetableText, timetable_text
from benchdragon.export.metronome import sounds_of
from benchdragon.i18n import _, spoken_in
from benchdragon.planner.page import planner_page
from benchdragon.plans.people import called
from benchdragon.plans.roster import roster_of
from benchdragon.plans.schema import read_plan
from benchdragon.rosters.roster import Roster
from tests.browser.axe import needs_axe, violations
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import PITCH, change, settled
from tests.browser.village import PLAN, checked, village
from tests.rosters.lists import xlsx_bytes

NAMES = {"en": "benches' sheets", "zh": "板凳单"}
OVERVIEW = {"en": "the leader's overview", "zh": "领队总表"}
SAVE = re.compile("save as CSV|存成 CSV")
Opened = Callable[..., Page]
LIST = """桥号\t姓名\t户主\t电话
龙头\t张三、李四\t张家\t138-0000-0001
1\t王五\t王家\t
5\t赵六\t赵家\t
99\t钱七\t\t
"""


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small dance with people who count their benches in qiao."""
    return village(tmp_path_factory.mktemp("village"), PLAN)


@pytest.fixture(scope="module")
def sheets_file(tmp_path_factory: pytest.TempPathFactory, plan: Path) -> Path:
    """The planner's file, opened with that dance."""
    path = tmp_path_factory.mktemp("planner") / "planner.html"
    path.write_text(planner_page(read_plan(str(plan)), "en"), "utf-8")
    return path


@pytest.fixture
def opened_sheets(pages: Pages, sheets_file: Path) -> Opened:
    """Opens the planner, and in it the sheets of its dance."""

    def open_sheets(language: Language = "en", device: Device = "desktop") -> Page:
        page = pages.open(f"{sheets_file.as_uri()}#lang={language}", device)
        settled(page).get_by_role("button", name=NAMES[language], exact=True).click()
        expect(sheets(page).locator(".paper")).to_have_count(8)
        return page

    return open_sheets


def sheets(page: Page) -> Locator:
    return page.locator("#sheets")


def printed(page: Page) -> list[str]:
    """What stands on each page that is printed, without spaces."""
    expect(sheets(page)).to_have_attribute("aria-busy", "false")
    made = pypdfium2.PdfDocument(io.BytesIO(page.pdf(prefer_css_page_size=True)))
    for sheet in made:
        assert sheet.get_size() == pytest.approx((595.3, 841.9), abs=1.0)
    return ["".join(sheet.get_textpage().get_text_bounded().split()) for sheet in made]


class Entry(NamedTuple):
    """What the sheet of a bench has to say: its name, its people, what it does."""

    title: str
    people: list[str]
    text: BenchText


def told(path: Path, language: Language, roster: Roster) -> list[Entry]:
    """What the sheets of a plan and a list have to say."""
    plan = read_plan(str(path))
    report = check(plan)
    count, ground = len(report.walk.dragon), Ground.of(plan, report.walk.route)
    with spoken_in(language):

        def named(bench: int) -> str:
            people = _(", ").join(one.name for one in roster.people(bench))
            name = called(plan.people, bench, count)
            return _("{bench} ({people})").format(bench=name, people=people) if people else name

        return [
            Entry(
                called(plan.people, one.bench, count),
                [person.name for person in roster.people(one.bench)],
                bench_text(plan, one, named, ground),
            )
            for one in bench_walks(plan, report.walk, (report.start, report.end))
        ]


def assert_says(text: str, entry: Entry) -> None:
    for line in (entry.title, *entry.people, *entry.text.lines):
        assert "".join(line.split()) in text, line


@pytest.mark.parametrize("language", ["en", "zh"])
def test_sheets_on_paper_say_what_pythons_say(
    opened_sheets: Opened, plan: Path, language: Language
) -> None:
    page = opened_sheets(language)
    entries = told(plan, language, Roster())
    foot = re.compile(rf"{read_plan(str(plan)).sha256[:12]}-[0-9a-f]{{4}}·{date.today().isoformat()}")
    on_paper = printed(page)
    assert len(on_paper) == len(entries)
    for text, entry in zip(on_paper, entries, strict=True):
        assert_says(text, entry)
        assert foot.search(text)
    assert "print" not in "".join(on_paper)
    sheets(page).get_by_role("combobox").nth(1).select_option("quarter")
    quarters = printed(page)
    assert len(quarters) == 2
    for n, entry in enumerate(entries):
        assert_says(quarters[n // 4], entry)


@needs_axe
@pytest.mark.parametrize(("language", "device"), [("en", "desktop"), ("zh", "phone")])
def test_axe_finds_nothing_wrong_in_sheets(
    opened_sheets: Opened, language: Language, device: Device
) -> None:
    page = opened_sheets(language, device)
    given(page, LIST)
    for what in ("benches", "overview", "timetable", "chalk"):
        sheets(page).get_by_role("combobox").first.select_option(what)
        assert violations(page) == [], what


def test_one_bench_is_printed_alone(opened_sheets: Opened, plan: Path) -> None:
    page = opened_sheets("en", "phone")
    sheets(page).get_by_role("combobox", name="which benches").select_option("3")
    (text,) = printed(page)
    assert_says(text, told(plan, "en", Roster())[2])


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_overview_is_printed_and_saved(
    opened_sheets: Opened, plan: Path, language: Language
) -> None:
    page = opened_sheets(language)
    sheets(page).get_by_role("combobox").first.select_option("overview")
    text = "".join(printed(page))
    with page.expect_download() as found:
        sheets(page).get_by_role("button", name=SAVE).click()
    saved = Path(found.value.path()).read_text("utf-8-sig")
    _report, benches = checked(read_plan(str(plan)))
    assert all(one.tightest is None for one in benches)
    for entry in told(plan, language, Roster()):
        for line in (entry.title, entry.text.quick):
            assert "".join(line.split()) in text
            assert line in saved
    heads, *rows = saved.splitlines()
    assert [row.split(",")[-1] for row in rows] == ['""'] * 8
    assert heads.count(",") == 5


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_overview_says_what_pythons_says(pages: Pages, tmp_path: Path, language: Language) -> None:
    long = read_plan(str(village(tmp_path, PLAN.replace("benches = 8", "benches = 30"))))
    file = tmp_path / "planner.html"
    file.write_text(planner_page(long, "en"), "utf-8")
    page = pages.open(f"{file.as_uri()}#lang={language}")
    settled(page).get_by_role("button", name=NAMES[language], exact=True).click()
    expect(sheets(page).locator(".paper")).to_have_count(30)
    sheets(page).get_by_role("combobox").first.select_option("overview")
    shown = page.locator("#sheets .overview")
    with spoken_in(language):
        report, benches = checked(long)
        text = overview_text(report, benches, Ground.of(long, report.walk.route))
    assert 1 < len(text.tightest) <= 3
    told_here = shown.locator(":scope > p").all_inner_texts()
    lines = [*text.verdict, *text.tightest, *text.coming, *text.leaving]
    assert [line for line in told_here if line in lines] == lines
    assert shown.locator("tbody tr td:nth-child(3)").all_inner_texts() == list(text.starts)
    dashes = sum(one.tightest is None for one in benches)
    assert 0 < dashes < 30
    assert shown.locator("td", has_text=re.compile(r"^-$")).count() == dashes


# A dance with a stop, beside a well, with an entrance, by the clock.
TIMED = (
    PLAN
    + """[venue]
rectangle = [60, 50]
[[obstacle]]
kind = "circle"
name = "well"
centre = [12, 2]
radius = 0.5
[event]
entrances = [[-30, 3]]
[cues]
clock = "18:30"
[[cues.cue]]
kind = "hold"
head = 4
hold = 3
text = "bow"
text_zh = "拜庙"
"""
)


@pytest.fixture(scope="module")
def timed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plan file of that dance, and beside it the planner's page with it."""
    file = village(tmp_path_factory.mktemp("timed"), TIMED)
    file.with_name("planner.html").write_text(planner_page(read_plan(str(file)), "en"), "utf-8")
    return file


def shown_timetable(pages: Pages, timed: Path, language: Language) -> Page:
    """The page with the timetable of that dance."""
    page = pages.open(f"{timed.with_name('planner.html').as_uri()}#lang={language}")
    settled(page).get_by_role("button", name=NAMES[language], exact=True).click()
    expect(sheets(page).locator(".paper")).to_have_count(8)
    sheets(page).get_by_role("combobox").first.select_option("timetable")
    return page


def timetable_of(timed: Path, language: Language) -> tuple[TimetableText, list[list[str]], Score]:
    """What Python says of that dance, its times from the start, and its drum."""
    plan = read_plan(str(timed))
    walk = plan.build()
    start, end = plan.span(walk)
    with spoken_in(language):
        passings = timetable(plan, walk, start, end)
        text = timetable_text(plan, walk, (start, end), Ground.of(plan, walk.route), passings)
    held = [
        (one.head, one.until if one.name in ("bow", "拜庙") else None, one.tail) for one in passings
    ]
    seconds = [["" if one is None else f"{one - start:.1f}" for one in times] for times in held]
    return text, seconds, counted_in(score_of(plan, start, end))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_timetable_is_printed_and_saved_as_pythons(
    pages: Pages, timed: Path, language: Language
) -> None:
    page = shown_timetable(pages, timed, language)
    text, seconds, _score = timetable_of(timed, language)
    (bow,) = [row for row in text.rows if row[0] in ("bow", "拜庙")]
    assert re.fullmatch(r"18:30:0\d (to|至) 18:30:\d\d", bow[3])
    shown = sheets(page).locator(".timetable")
    rows = shown.locator("tbody tr").all()
    assert [tuple(row.locator("th, td").all_inner_texts()) for row in rows] == list(text.rows)
    assert tuple(shown.locator(":scope > p").all_inner_texts()) == text.lines
    on_paper = "".join(printed(page))
    for line in (*text.columns, *text.lines, *(cell for row in text.rows for cell in row)):
        assert "".join(line.split()) in on_paper, line
    with page.expect_download() as found:
        sheets(page).get_by_role("button", name=re.compile("CSV")).click()
    saved = list(csv.reader(io.StringIO(Path(found.value.path()).read_text("utf-8-sig"))))
    assert saved[0][: len(text.columns)] == list(text.columns)
    assert saved[1 : len(text.rows) + 1] == [
        [*("" if cell == "-" else cell for cell in row), *times]
        for row, times in zip(text.rows, seconds, strict=True)
    ]


def test_the_drum_is_saved_as_a_sound_file(pages: Pages, timed: Path) -> None:
    page = shown_timetable(pages, timed, "en")
    with page.expect_download() as found:
        sheets(page).get_by_role("button", name="save the drum").click()
    with wave.open(str(found.value.path())) as made:
        assert (made.getnchannels(), made.getsampwidth()) == (1, 2)
        rate, heard = made.getframerate(), np.frombuffer(made.readframes(made.getnframes()), "<i2")
    _text, _seconds, score = timetable_of(timed, "en")
    times = [time for time, _name in sounds_of(score, score.runs[0].start)]
    assert len(times) > 20
    loud = np.abs(heard) > 4000
    for time in times:
        n = round(time * rate)
        assert loud[n], time
        assert not loud[max(n - rate // 20, 0) : n].any(), time  # silent before each
    quiet = heard[round(times[-1] * rate) + rate // 2 :]
    assert not quiet.any()


def test_maps_show_the_entrances_that_the_plan_names(pages: Pages, tmp_path: Path) -> None:
    named = read_plan(str(village(tmp_path, PLAN)), ["event.entrances=[[9, 0], [-9, 30]]"])
    file = tmp_path / "planner.html"
    file.write_text(planner_page(named, "en"), "utf-8")
    page = pages.open(file.as_uri())
    settled(page).get_by_role("button", name=NAMES["en"], exact=True).click()
    sheet = sheets(page).locator(".paper").first
    for n, (x, y) in enumerate([(9.0, 0.0), (-9.0, 30.0)]):
        expect(sheet.locator("svg text", has_text=f"entrance {n + 1}")).to_have_count(1)
        mark = sheet.locator("svg circle.peg").nth(n)
        assert (float(mark.get_attribute("cx") or ""), float(mark.get_attribute("cy") or "")) == (x, -y)
    box = [
        float(one)
        for one in (sheet.locator("svg.map, .map svg").first.get_attribute("viewBox") or "").split()
    ]
    assert box[1] < -30.0 < box[1] + box[3]


def test_codes_open_the_player_at_ones_own_bench(opened_sheets: Opened, plan: Path) -> None:
    page = opened_sheets("en")
    address = read_plan(str(plan)).people.address

    def read() -> list[list[str]]:
        made = pypdfium2.PdfDocument(io.BytesIO(page.pdf(prefer_css_page_size=True)))
        pictures = [sheet.render(scale=200 / 72).to_pil() for sheet in made]
        return [sorted(one.text for one in zxingcpp.read_barcodes(picture)) for picture in pictures]

    wanted = [f"{address}#bench={bench}" for bench in range(1, 9)]
    assert read() == [[one] for one in wanted]
    sheets(page).get_by_role("combobox").nth(1).select_option("quarter")
    assert read() == [wanted[:4], wanted[4:]]


def test_cards_to_hang_round_the_neck_have_two_sides_beside_one_another(
    opened_sheets: Opened, plan: Path
) -> None:
    page = opened_sheets("zh")
    given(page, LIST)
    sheets(page).get_by_role("combobox").nth(1).select_option("lanyard")
    cards = sheets(page).locator(".paper .folded")
    expect(cards).to_have_count(8)
    expect(sheets(page).locator(".paper")).to_have_count(4)
    plan.with_name("names.tsv").write_text(LIST, "utf-8")
    entries = told(plan, "zh", roster_of(read_plan(str(plan), ["people.roster=names.tsv"])))
    for n, entry in enumerate(entries):
        front, back = ("".join(one.split()) for one in cards.nth(n).locator(".sheet").all_inner_texts())
        for line in (entry.title, entry.text.quick):
            assert "".join(line.split()) in front
        for line in (*entry.text.people, entry.text.tightest, *entry.text.stretches, entry.text.times):
            assert "".join(line.split()) in back
    on_paper = printed(page)
    assert len(on_paper) == 4
    made = pypdfium2.PdfDocument(io.BytesIO(page.pdf(prefer_css_page_size=True)))
    codes = [
        sorted(one.text for one in zxingcpp.read_barcodes(sheet.render(scale=200 / 72).to_pil()))
        for sheet in made
    ]
    address = read_plan(str(plan)).people.address
    wanted = [f"{address}#bench={bench}" for bench in range(1, 9)]
    assert codes == [wanted[n : n + 2] for n in range(0, 8, 2)]
    page.emulate_media(media="print")
    box = cards.first.locator(".sheet").first.bounding_box()
    assert box is not None
    millimetre = 96 / 25.4
    assert (box["width"] / millimetre, box["height"] / millimetre) == pytest.approx((86, 124), abs=0.2)


def test_the_benches_of_a_household_stand_on_its_sheet(opened_sheets: Opened, plan: Path) -> None:
    page = opened_sheets("en")
    tick = sheets(page).get_by_role("checkbox", name="by household")
    given(page, "bench\tname\nhead\t张三\n")
    expect(tick).to_have_count(0)
    names = "".join(f"{n}\t赵{n}\t赵家\n" for n in range(1, 6))
    listed = f"桥号\t姓名\t户主\n龙头\t张三\t张家\n{names}"
    sheets(page).get_by_role("textbox").fill(listed)
    sheets(page).get_by_role("button", name="take the rows above").click()
    tick.check()
    papers = sheets(page).locator(".paper")
    expect(papers).to_have_count(6)  # the head's, three of five benches, two of nobody
    plan.with_name("house.tsv").write_text(listed, "utf-8")
    entries = told(plan, "en", roster_of(read_plan(str(plan), ["people.roster=house.tsv"])))
    two = papers.nth(1).locator(".sheet")
    expect(two).to_contain_text("household: 赵家")
    for entry in entries[1:3]:
        for line in (entry.title, entry.text.quick, entry.text.tightest, *entry.text.stretches):
            expect(two).to_contain_text(line)
    expect(two.locator(".map .track")).to_have_count(2)
    for name in ("赵1", "赵2"):
        expect(two).to_contain_text(name)
    expect(papers.nth(3).locator(".map .track")).to_have_count(1)
    expect(papers.nth(4)).not_to_contain_text("household")
    sheets(page).get_by_role("combobox").nth(1).select_option("quarter")
    expect(sheets(page).locator(".sheet")).to_have_count(8)  # one on each, small as they are
    sheets(page).get_by_role("combobox").nth(1).select_option("a4")
    sheets(page).get_by_role("checkbox", name="large type").check()
    expect(papers).to_have_count(8)


def test_sheets_close_when_the_page_is_about_another_plan(opened_sheets: Opened) -> None:
    page = opened_sheets()
    page.evaluate("benchdragon.undo()")
    expect(sheets(page)).to_have_count(1)
    wider = "{...benchdragon.plan, route: {...benchdragon.plan.route, pitch: 1.3}}"
    page.evaluate(f"benchdragon.change({wider}, true)")
    expect(sheets(page)).to_have_count(0)


def test_a_dance_that_is_not_safe_has_no_sheets(pages: Pages, sheets_file: Path) -> None:
    page = settled(pages.open(f"{sheets_file.as_uri()}#lang=en"))
    change(page, PITCH, "0.3")
    settled(page).get_by_role("button", name=NAMES["en"], exact=True).click()
    expect(sheets(page)).to_contain_text(re.compile("of a plan that is safe alone. Not safe"))
    expect(sheets(page).locator(".paper")).to_have_count(0)
    page.keyboard.press("Escape")
    expect(sheets(page)).to_have_count(0)
    expect(page.get_by_role("button", name=NAMES["en"], exact=True)).to_be_focused()


def given(page: Page, text: str) -> None:
    """Give the page a list of names."""
    names = sheets(page).locator("details.names")
    names.locator("summary").click()
    names.get_by_role("textbox").fill(text)
    names.get_by_role("button").first.click()


def test_names_stand_on_sheets_and_nowhere_else(opened_sheets: Opened, plan: Path) -> None:
    page = opened_sheets("en")
    before = page.url
    given(page, LIST)
    names = sheets(page).locator("details.names")
    expect(names).to_contain_text("3 benches have people")
    expect(names).to_contain_text("row 5: the dragon of 8 benches has no qiao 99: 钱七")
    expect(names).to_contain_text("nobody is named for")
    plan.with_name("names.tsv").write_text(LIST, "utf-8")
    read = read_plan(str(plan), ["people.roster=names.tsv"])
    entries = told(plan, "en", roster_of(read))
    on_paper = printed(page)
    for text, entry in zip(on_paper, entries, strict=True):
        assert_says(text, entry)
        assert "138" not in text.replace(read.sha256[:12], "")
    assert "王五" in on_paper[0]  # which is next behind the head
    sheets(page).get_by_role("checkbox", name="print phone numbers").check()
    assert "李四phoneofthehousehold:138-0000-0001" in printed(page)[0]  # a row's, of no name
    sheets(page).get_by_role("button", name="close").click()
    expect(page.get_by_role("button", name=NAMES["en"], exact=True)).to_be_focused()
    assert page.url == before
    kept = page.evaluate("JSON.stringify([{...localStorage}, {...sessionStorage}, benchdragon.plan])")
    assert "张三" not in kept


def test_a_list_is_opened_from_a_workbook(opened_sheets: Opened, tmp_path: Path) -> None:
    page = opened_sheets("en")
    rows = [line.split("\t") for line in LIST.splitlines()]

    def give(name: str, data: bytes) -> None:
        (tmp_path / name).write_bytes(data)
        sheets(page).locator("input[type=file]").set_input_files(tmp_path / name)

    names = sheets(page).locator("details.names")
    names.locator("summary").click()
    alert, choice = sheets(page).get_by_role("alert"), names.get_by_role("combobox", name="sheet")
    first = sheets(page).locator(".paper").first
    give("torn.xlsx", b"PK\x03\x04 and more")
    expect(alert).to_contain_text("torn.xlsx is torn, or no workbook")
    give("names.xlsx", xlsx_bytes(rows))
    expect(first).to_contain_text("张三")
    expect(names).to_contain_text("3 benches have people")
    expect(alert.or_(choice)).to_have_count(0)
    give("several.xlsx", xlsx_bytes(rows, ("other", [["桥号", "姓名"], [1, "周一"]])))
    expect(choice).to_contain_text("several.xlsx has several sheets: choose one")
    expect(names).to_contain_text("none yet")
    expect(first).not_to_contain_text("张三")
    choice.select_option("other")
    expect(first).to_contain_text("周一")
    expect(names).to_contain_text("1 benches have people")
    choice.select_option("名单")
    expect(names).to_contain_text("3 benches have people")
    give("names.csv", LIST.replace("\t", ",").encode("gb18030"))
    expect(alert.or_(choice)).to_have_count(0)
    expect(first).to_contain_text("张三")


@pytest.mark.parametrize("paper", ["a4", "quarter", "lanyard"])
def test_all_of_a_sheet_finds_room(opened_sheets: Opened, paper: str) -> None:
    page = opened_sheets("en")
    crowd = "、".join(f"{family}小{one}" for family in "张李王赵钱孙" for one in "东南西北春夏秋冬前后")
    given(page, f"桥号\t姓名\n3\t{crowd}\n")
    sheets(page).get_by_role("combobox").nth(1).select_option(paper)
    sheets(page).get_by_role("checkbox", name="large type").check()
    more = re.compile(r"张小东.* and \d+ more")
    over = "(found) => found.filter((one) => one.scrollHeight > one.clientHeight + 1).length"
    assert sheets(page).locator(".sheet").evaluate_all(over) == 0
    fronts = sheets(page).locator(".sheet:has(h2)")
    expect(fronts).to_have_count(8)
    if paper != "a4":
        expect(fronts.nth(3)).to_contain_text(more)
    expect(fronts.first).not_to_contain_text(more)
    maps = fronts.locator(".map").evaluate_all(
        "(all) => all.map((one) => [one.clientHeight, one.style.minHeight])"
    )
    assert len(maps) >= 6
    assert min(tall for tall, _least in maps) >= 25 * 96 / 25.4 - 1
    assert len({tall for tall, least in maps if not least}) <= 1, "maps of sheets are of one size"


def test_a_name_in_the_table_is_no_formula(opened_sheets: Opened) -> None:
    page = opened_sheets("en")
    given(page, "桥号\t姓名\n3\t=HYPERLINK(A1)\n")
    sheets(page).get_by_role("combobox").first.select_option("overview")
    with page.expect_download() as found:
        sheets(page).get_by_role("button", name=SAVE).click()
    saved = Path(found.value.path()).read_text("utf-8-sig")
    assert '"\'=HYPERLINK(A1)"' in saved
    assert re.search(r'"-\d+\.\d\d"', saved)  # numbers stay numbers


SMALLEST = """() => {
  const shown = document.querySelector("#sheets .pages");
  const texts = document.createTreeWalker(shown, NodeFilter.SHOW_TEXT);
  let least = Infinity;
  for (let node = texts.nextNode(); node; node = texts.nextNode()) {
    const at = node.parentElement;
    if (!node.data.trim() || !at.getClientRects().length) continue;
    const scale = at.ownerSVGElement ? at.getScreenCTM().a : 1;
    least = Math.min(least, parseFloat(getComputedStyle(at).fontSize) * scale);
  }
  return least * 72 / 96;
}"""


def test_no_type_on_paper_is_smaller_than_seven_points(opened_sheets: Opened) -> None:
    page = opened_sheets()
    page.set_viewport_size({"width": 1366, "height": 768})
    for what, kind in ((1, "a4"), (1, "quarter"), (1, "lanyard"), (0, "overview"), (0, "chalk")):
        sheets(page).get_by_role("combobox").nth(what).select_option(kind)
        assert page.evaluate(SMALLEST) >= 7 - 1e-3


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_arrows_word_is_whole_and_beside_the_map(opened_sheets: Opened, language: Language) -> None:
    page = opened_sheets(language)
    for kind in ("a4", "quarter", "lanyard"):
        sheets(page).get_by_role("combobox").nth(1).select_option(kind)
        places = page.evaluate(
            """() => [".map > svg:first-child", "svg.compass", "svg.compass text"].map((one) =>
              document.querySelector("#sheets " + one).getBoundingClientRect().toJSON())"""
        )
        drawn, arrow, word = places
        assert drawn["right"] <= arrow["left"] + 0.1
        assert arrow["left"] <= word["left"] < word["right"] <= arrow["right"]


def test_what_is_printed_too_early_says_so(pages: Pages, sheets_file: Path) -> None:
    page = settled(pages.open(f"{sheets_file.as_uri()}#lang=en"))
    page.evaluate(
        "benchdragon.sheets.answers.aside = () => "
        "({ ask: () => new Promise(() => {}), close: () => {} })"
    )
    page.get_by_role("button", name=NAMES["en"], exact=True).click()
    made = pypdfium2.PdfDocument(io.BytesIO(page.pdf()))
    assert "notreadyyet" in "".join(made[0].get_textpage().get_text_bounded().split())


def test_all_papers_are_printed_one_after_another(opened_sheets: Opened) -> None:
    page = opened_sheets("zh")
    what = sheets(page).get_by_role("combobox", name="打印什么")
    alone = []
    for name in what.locator("option").evaluate_all("(all) => all.map(({ value }) => value)"):
        if name:
            what.select_option(name)
            alone += printed(page)
    assert len(alone) > 8
    what.select_option("")
    assert printed(page) == alone
    assert "全部单子" in page.title()


def opened_plan(pages: Pages, folder: Path, text: str, *settings: str) -> Page:
    """The sheets of another plan."""
    file = folder / "planner.html"
    file.write_text(planner_page(read_plan(str(village(folder, text)), settings), "en"), "utf-8")
    page = pages.open(f"{file.as_uri()}#lang=en")
    settled(page).get_by_role("button", name=NAMES["en"], exact=True).click()
    expect(sheets(page)).to_have_attribute("aria-busy", "false")
    return page


# Names on the map of a sheet, each with its box; and the venue's edge, in pixels of the page.
BOXES = """(map) => {
  const svg = map.querySelector("svg");
  const whole = svg.getBoundingClientRect();
  const { x, y, width, height } = svg.viewBox.baseVal;
  const { a, b, c, d, e, f } = svg.getScreenCTM();
  const names = [...svg.querySelectorAll("text")].map((text) => {
    const { left, top, right, bottom } = text.getBoundingClientRect();
    return [text.textContent, left, top, right, bottom];
  });
  const edge = document.querySelector("#sheets .shared .edge").getAttribute("points")
    .split(" ").map((point) => point.split(",").map(Number)).map(([u, v]) => [a * u + e, d * v + f]);
  return { names, edge };
}"""


@pytest.mark.parametrize(
    "thing",
    [
        'kind="rectangle", name="stage", centre=[-12, 13.6], size=[6, 2.8], margin=0.1',
        'kind="circle", name="the well", centre=[19.2, 0], radius=0.5, margin=0.1',
    ],
)
def test_no_name_on_a_map_lies_on_the_edge_of_the_venue_or_on_another(
    pages: Pages, tmp_path: Path, thing: str
) -> None:
    square = "venue.rectangle=[40, 30]", "venue.name=yard", f"obstacle=[{{{thing}}}]"
    page = opened_plan(pages, tmp_path, PLAN, *square, "event.entrances=[[12, 0], [12.8, 0]]")
    found = sheets(page).locator(".map").first.evaluate(BOXES)
    (left, top), (right, bottom) = (
        [most(one[k] for one in found["edge"]) for k in (0, 1)] for most in (min, max)
    )
    names = found["names"]
    assert len(names) == 4
    for n, (name, low_x, low_y, high_x, high_y) in enumerate(names):
        inside = left < low_x and high_x < right and top < low_y and high_y < bottom
        outside = high_x < left or low_x > right or high_y < top or low_y > bottom
        assert inside or outside, name
        for other, *box in names[:n]:
            apart = box[0] >= high_x or low_x >= box[2] or box[1] >= high_y or low_y >= box[3]
            assert apart, (name, other)


def test_benches_of_a_household_are_all_seen_on_their_map(opened_sheets: Opened) -> None:
    page = opened_sheets("en")
    given(page, "桥号\t姓名\t户主\n" + "".join(f"{n}\t赵{n}\t赵家\n" for n in range(1, 7)))
    sheets(page).get_by_role("checkbox", name="by household").check()
    several = sheets(page).locator(".sheet.several .map")
    expect(several).to_have_count(3)
    for n in range(3):
        names = several.nth(n).evaluate(
            """(map) => [...map.querySelectorAll("g text")].map((one) => one.getBoundingClientRect())
              .map(({ left, top, right, bottom }) => [left, top, right, bottom])"""
        )
        (a, b) = names
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
        first, second = (
            several.nth(n)
            .locator(".track")
            .evaluate_all("(all) => all.map((one) => Number(one.getAttribute('stroke-width')))")
        )
        assert first > second, "ways that lie on one another are both seen"


def test_what_the_list_says_is_printed_where_it_belongs(opened_sheets: Opened) -> None:
    page = opened_sheets("en")
    given(
        page,
        "桥号\t姓名\t户主\t电话\t备注\n1\t王五、赵六\t\t139-7\twet paint\n2\t钱七\t孙家\t139-8\tlame\n"
        "4\t孙八\t孙家\t\t\n5\t钱七\t\t\t\n6\t周九\t\t\t\n",
    )
    sheets(page).get_by_role("checkbox", name="print phone numbers").check()
    benches = printed(page)
    assert "王五赵六phoneofthehousehold:139-7" in benches[1]
    assert benches[1].count("139-7") == 1
    assert "钱七,phone139-8" in benches[2]
    assert "Ofyourhouseholdtoo:qiao4." in benches[2]
    assert "Ofyourhousehold" not in benches[1]
    assert "wetpaint" not in "".join(benches)
    assert ["Names:______" in one for one in benches] == [n in (0, 3, 7) for n in range(8)]
    sheets(page).get_by_role("combobox").first.select_option("overview")
    overview = "".join(printed(page))
    assert "王五,赵六(wetpaint),phoneofthehousehold:139-7" in overview
    assert "钱七139-8(lame)" in overview
    assert overview.count("(nobody)") == 3
    assert "5peopleinthelistofnames" in overview, "who is named at two benches counts once"


def test_head_and_tail_say_so_where_benches_are_counted_through(pages: Pages, tmp_path: Path) -> None:
    counted = ("people.count_head=true", "people.unit=bench")
    page = opened_plan(pages, tmp_path, PLAN, *counted)
    titles = sheets(page).locator(".sheet h2").all_inner_texts()
    assert titles[:2] == ["bench 1, the head", "bench 2"]
    assert titles[7] == "bench 8, the tail"


def test_at_night_without_a_code_the_map_gives_way_before_what_one_does(
    pages: Pages, tmp_path: Path
) -> None:
    told = []
    for n, address in enumerate(("https://dragon.test/ours", "")):
        (tmp_path / str(n)).mkdir()
        text = PLAN.replace("benches = 8", "benches = 40")
        page = opened_plan(pages, tmp_path / str(n), text, f"people.address={address}")
        sheets(page).get_by_role("combobox").nth(1).select_option("quarter")
        sheets(page).get_by_role("checkbox", name="large type").check()
        told.append("".join(printed(page)))
    turns = [one.count("walking,turnright") for one in told]
    assert turns[0] < turns[1] == 40
    assert "therestisintheplayer" in told[0]
    assert "therestisintheplayer" not in told[1]


def test_papers_of_another_list_or_title_bear_other_numbers(opened_sheets: Opened) -> None:
    page = opened_sheets("en")
    feet = set()
    for n in range(2):
        feet.add(sheets(page).locator(".sheet footer").first.inner_text())
        if not n:
            given(page, LIST)
    sheets(page).get_by_role("button", name="close").click()
    page.evaluate("benchdragon.change({...benchdragon.plan, meta: {title: 'Another'}}, true)")
    settled(page).get_by_role("button", name=NAMES["en"], exact=True).click()
    expect(sheets(page)).to_have_attribute("aria-busy", "false")
    feet.add(sheets(page).locator(".sheet footer").first.inner_text())
    assert len(feet) == 3
    assert len({foot.split("-")[0] for foot in feet}) == 1, "the dance is the same"
