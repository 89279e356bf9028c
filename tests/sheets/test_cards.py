"""The benches' sheets and the overview: what they say is what the plan and the list say."""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pypdfium2
import pytest
import zxingcpp
from fpdf import FPDF
from pypdf import PdfReader

from benchdragon.analysis.bench_walks import Tightest
from benchdragon.analysis.check import clearance_text, sentence
from benchdragon.errors import InputError
from benchdragon.explain.bench_basis import bench_text
from benchdragon.explain.bench_text import tightest_line
from benchdragon.export.document import Paragraph, Table
from benchdragon.export.typeset import Typeset
from benchdragon.i18n import spoken_in
from benchdragon.plans.schema import read_plan
from benchdragon.rosters.roster import Person, Roster
from benchdragon.sheets.briefing import Briefing
from benchdragon.sheets.cards import BLANK, LEAST_MAP, MORE, Block, _fewer, write_benches
from benchdragon.sheets.chalk import chalk_drawing, list_rows
from benchdragon.sheets.options import Options
from benchdragon.sheets.overview import overview, write_overview
from benchdragon.sheets.small_map import Frame, SmallMap
from tests.sheets.village import PLAN, briefing, small, village

Written = Callable[..., list[str]]


@pytest.fixture(scope="module")
def ours(tmp_path_factory: pytest.TempPathFactory) -> Briefing:
    """What the papers of the small dance are made from."""
    return small(tmp_path_factory.mktemp("ours"), "route.at=[0.67,-1.5]")


def bare(text: str) -> str:
    """Text without the spaces and line ends at which a page breaks it."""
    return "".join(text.split())


def pages(path: Path) -> list[str]:
    return [bare(page.extract_text()) for page in PdfReader(path).pages]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_sheet_says_what_its_bench_does_and_who_is_beside(
    tmp_path: Path, ours: Briefing, language: str
) -> None:
    with spoken_in(language):
        write_benches(tmp_path / "b.pdf", ours, Options())
        found = pages(tmp_path / "b.pdf")
        assert len(found) == 8
        for bench, page in enumerate(found, start=1):
            said = bench_text(ours.plan, ours.benches[bench - 1], ours.named, ours.ground)
            assert bare(ours.called(bench)) in page
            for line in said.lines:
                assert bare(line) in page
            for person in ours.roster.people(bench):
                assert person.name in page
            assert bare(ours.foot) in page
            assert "138-0000" not in page
        assert "王五" in found[0], "who carries the bench behind"


@pytest.mark.parametrize(
    ("every", "language", "pattern"),
    [
        (None, "en", r"marks(\d+)and(\d+)ofthechalkplan,([\d.]+)mpastmark\1|atmark(\d+)of"),
        (0.7, "zh", r"在放样图的(\d+)号和(\d+)号标点之间，沿线过\1号([\d.]+)米|在放样图的(\d+)号标点"),
    ],
)
def test_a_sheet_says_between_which_chalk_marks_its_bench_starts(
    tmp_path: Path, every: float | None, language: str, pattern: str
) -> None:
    asked = small(tmp_path, *([f"chalk.every={every}"] if every else []))
    with spoken_in(language):
        write_benches(tmp_path / "b.pdf", asked, Options())
    drawing = chalk_drawing(asked)
    ways = []
    for bench, page in zip(asked.benches, pages(tmp_path / "b.pdf"), strict=True):
        told = re.search(pattern, page)
        assert told is not None
        first, second, past, at = told.groups()
        n = int(at or first) - 1
        assert at or int(second) == n + 2
        place = drawing.trail.route.point([drawing.marks.s[n] + float(past or 0.0)])[0]
        assert np.abs(place - bench.place).max() < 0.0051
        ways.append(at is None)
    assert not ways[0], "the head starts at a mark"
    assert any(ways)


@pytest.mark.parametrize("survey", [[], ["survey.crs=EPSG:4549", "survey.origin=[500000,3000000]"]])
def test_sheets_and_chalk_plan_measure_from_one_peg(
    tmp_path: Path, ours: Briefing, survey: list[str]
) -> None:
    for one in (ours, small(tmp_path, "chalk.peg=[2, 3]", *survey)):
        marks = chalk_drawing(one).marks
        start = marks.kinds.index("start")
        place = bench_text(one.plan, one.benches[0], one.named, one.ground).place[0]
        assert f" {marks.radius[start]:.2f} m from it " in place
        assert f" {round(marks.angle[start]) % 360}° from " in place
        _n, _way, x, y, *_rest = list(list_rows(marks))[start]
        told = [float(number) for number in re.findall(r"[xy] = (-?[\d.]+) m", place)]
        assert told == pytest.approx([x, y], abs=0.0076)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (["chalk.peg=[1e8, 0]"], "m from the nearest mark, farther than 200 m"),
        (
            ["chalk.every=0.1", "route.start_turn=60", "walk.end=600"],
            "are more than 5000: ask for at least",
        ),
    ],
)
def test_marks_that_cannot_be_laid_out_are_refused_whatever_papers_are_wanted(
    tmp_path: Path, settings: list[str], said: str
) -> None:
    with pytest.raises(InputError, match=said):
        small(tmp_path, *settings)


@pytest.mark.parametrize(("paper", "count"), [("a4", 8), ("quarter", 2), ("lanyard", 4)])
@pytest.mark.parametrize("night", [False, True])
def test_each_format_has_every_bench_in_its_foot_and_its_code(
    tmp_path: Path, ours: Briefing, paper: Literal["a4", "quarter", "lanyard"], count: int, night: bool
) -> None:
    path = tmp_path / "b.pdf"
    write_benches(path, ours, Options(paper=paper, night=night))
    found = pages(path)
    assert len(found) == count
    whole = "".join(found)
    assert whole.count(bare(ours.foot)) == 8 * (2 if paper == "lanyard" else 1)
    read = []
    for page in pypdfium2.PdfDocument(path):
        picture = np.asarray(page.render(scale=200 / 72).to_pil().convert("L"))
        read += [code.text for code in zxingcpp.read_barcodes(picture)]
    assert sorted(read) == [f"https://dragon.test/ours#bench={n + 1}" for n in range(8)]


@pytest.mark.parametrize(("paper", "night"), [("a4", False), ("quarter", True), ("lanyard", True)])
def test_many_people_at_a_bench_find_room_beside_a_map_and_the_rest_are_counted(
    tmp_path: Path,
    ours: Briefing,
    paper: Literal["a4", "quarter", "lanyard"],
    night: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    drawn: list[float] = []
    draw = SmallMap.draw

    def watched(plan: SmallMap, pdf: FPDF, frame: Frame, *more: Sequence[Any]) -> None:
        drawn.append(frame.height)
        draw(plan, pdf, frame, *more)

    monkeypatch.setattr(SmallMap, "draw", watched)
    many = tuple(Person(f"Maximilian Oberhofer {n}") for n in range(40))
    crowd = replace(ours, roster=Roster({1: many[:3], 3: many, 5: (Person("x" * 200),)}))
    write_benches(tmp_path / "b.pdf", crowd, Options(paper=paper, night=night))
    whole = "".join(pages(tmp_path / "b.pdf"))
    assert all(bare(person.name) in whole for person in many[:3])
    assert "36more" in whole, "on the sheets of neighbours"
    assert re.search(r"Oberhofer\d+and\d+more", whole)
    assert len(drawn) >= 6
    assert min(drawn) >= LEAST_MAP


def test_the_overview_names_all_people_of_a_bench_however_many(tmp_path: Path, ours: Briefing) -> None:
    many = tuple(Person(f"Maximilian Oberhofer {n}") for n in range(200))
    crowd = replace(ours, roster=Roster({3: many, 5: (Person("x" * 1000),)}))
    write_overview(tmp_path / "o.pdf", crowd, phones=False)
    whole = "".join(pages(tmp_path / "o.pdf"))
    assert all(bare(person.name) in whole for person in many)


def test_phones_are_printed_only_where_asked_for(tmp_path: Path, ours: Briefing) -> None:
    write_benches(tmp_path / "b.pdf", ours, Options(phones=True))
    write_overview(tmp_path / "o.pdf", ours, phones=True)
    write_overview(tmp_path / "silent.pdf", ours, phones=False)
    assert "138-0000-0002" in pages(tmp_path / "b.pdf")[0]
    assert "138-0000-0003" in "".join(pages(tmp_path / "o.pdf"))
    assert "138-0000" not in "".join(pages(tmp_path / "silent.pdf"))


def test_a_household_has_its_benches_on_one_sheet(tmp_path: Path, ours: Briefing) -> None:
    write_benches(tmp_path / "b.pdf", ours, Options(by="household"))
    found = pages(tmp_path / "b.pdf")
    assert len(found) == 8  # 张, 李 and 赵, and five benches of nobody
    assert all(name in found[0] for name in ("张家", "thehead", "qiao1", "王五"))
    assert "李家" in found[1]
    assert sum("赵家" in page for page in found) == 1


def test_a_household_of_several_benches_is_told_all_of_each(tmp_path: Path, ours: Briefing) -> None:
    family = Roster({n: (Person(f"赵{n}", household="赵家"),) for n in range(1, 9)})
    theirs = replace(ours, roster=family)
    write_benches(tmp_path / "b.pdf", theirs, Options(by="household"))
    found = pages(tmp_path / "b.pdf")
    assert len(found) == 4
    for bench in range(1, 9):
        page = found[(bench - 1) // 2]
        for line in bench_text(ours.plan, ours.benches[bench - 1], theirs.named, ours.ground).lines:
            assert bare(line) in page
    assert not any(bare(MORE) in page for page in found)


def test_what_gives_way_is_of_the_bench_of_which_most_is_left_and_each_says_so() -> None:
    facts = [Block(f"{n}{k}", spare=k > 0, entry=n) for n in (0, 1) for k in range(3)]
    fewer = facts
    for _time in range(2):
        fewer = _fewer(fewer, MORE, lambda block: block.spare)
    told = [(block.text, block.entry) for block in fewer]
    assert told == [("00", 0), ("01", 0), (MORE, 0), ("10", 1), ("11", 1), (MORE, 1)]


def test_the_same_sheets_are_the_same_bytes(tmp_path: Path, ours: Briefing) -> None:
    for name in ("a.pdf", "b.pdf"):
        write_benches(tmp_path / name, ours, Options(paper="quarter"))
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_overview_has_every_bench_its_people_and_the_notes(
    tmp_path: Path, ours: Briefing, language: str
) -> None:
    with spoken_in(language):
        write_overview(tmp_path / "o.pdf", ours, phones=False)
        found = pages(tmp_path / "o.pdf")
        whole = "".join(found)
        for bench in range(1, 9):
            x, y = ours.ground.seen([ours.benches[bench - 1].place])[0]
            said = [ours.called(bench), f"{x:z.2f}, {y:z.2f}"]
            near = ours.benches[bench - 1].tightest
            said += [tightest_line(near, ours.clock, ours.called, its=True)] if near else []
            said += [person.name for person in ours.roster.people(bench)]
            assert all(bare(one) in whole for one in said)
        assert bare(ours.roster.notes[0]) in whole
        assert all(bare(ours.foot) in page for page in found)


@pytest.mark.parametrize("clock", ["", "18:30"])
def test_sheets_and_overview_tell_times_by_one_clock(tmp_path: Path, clock: str) -> None:
    paced = small(tmp_path, "walk.start=-5", f"cues.clock={clock}")
    write_benches(tmp_path / "b.pdf", paced, Options())
    write_overview(tmp_path / "o.pdf", paced, False)
    legend = bare(paced.clock.legend)
    assert all(page.count(legend) == 1 for page in pages(tmp_path / "b.pdf"))
    overview = "".join(pages(tmp_path / "o.pdf"))
    assert overview.count(legend) == 1
    witness = paced.report.clearance.witness
    assert witness is not None
    assert witness.time is not None
    near = replace(paced.report.clearance, witness=replace(witness, benches=(1, 9)))
    told = sentence(replace(paced.report, clearance=near), paced.clock)
    assert re.search(rf", at {paced.clock.tell(witness.time)}(\D|$)", told)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_overview_lists_the_tightest_three_of_different_benches_first(
    ours: Briefing, language: str
) -> None:
    gaps = {2: (0.9, 6), 6: (0.9, 2), 3: (0.7, 7), 4: (0.8, 8), 5: (0.95, 1)}
    told = {
        n: Tightest(float(n), other, "left", gap, gap, (10.0 * n, 0.0))
        for n, (gap, other) in gaps.items()
    }
    benches = tuple(replace(one, tightest=told.get(one.bench)) for one in ours.benches)
    with spoken_in(language):
        given = replace(ours, benches=benches)
        blocks = overview(given, phones=False).blocks
        at = next(n for n, one in enumerate(blocks) if getattr(one, "anchor", "") == "tightest")
        lines = [str(one) for one in blocks[at + 1 : at + 4]]
        for line, bench in zip(lines, (3, 4, 2), strict=True):
            assert tightest_line(told[bench], given.clock, given.called, its=True) in line
            assert given.called(bench) in line
        assert tightest_line(told[5], given.clock, given.called, its=True) not in str(blocks[at + 4])
        told[4] = replace(told[4], place=(32.0, 0.0))  # 2 m from the tightest: one place to look at
        benches = tuple(replace(one, tightest=told.get(one.bench)) for one in ours.benches)
        said = str(overview(replace(given, benches=benches), phones=False).blocks[at + 1 : at + 4])
        for bench, listed in {3: True, 4: False, 2: True, 5: True}.items():
            line = tightest_line(told[bench], given.clock, given.called, its=True)
            assert (line in said) == listed


def test_a_bench_that_nobody_carries_has_a_line_for_names(tmp_path: Path, ours: Briefing) -> None:
    write_benches(tmp_path / "b.pdf", ours, Options())
    found = [f"Names:{BLANK}" in page for page in pages(tmp_path / "b.pdf")]
    assert found == [False, False, True, True, True, False, True, True]
    write_overview(tmp_path / "o.pdf", ours, phones=False)
    assert "".join(pages(tmp_path / "o.pdf")).count("(nobody)") == 5


def test_maps_of_all_sheets_are_of_one_size(
    tmp_path: Path, ours: Briefing, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[tuple[float, float]] = []

    def watched(_map: SmallMap, _pdf: FPDF, frame: Frame, *_more: Sequence[Any]) -> None:
        drawn.append((frame.width, frame.height))

    monkeypatch.setattr(SmallMap, "draw", watched)
    write_benches(tmp_path / "b.pdf", ours, Options(paper="quarter"))
    assert len(drawn) == 8
    assert len(set(drawn)) == 1


def test_no_name_or_number_on_a_map_lies_on_the_edge_of_the_venue(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    square = "venue.rectangle=[40, 30]", "venue.name=yard"
    stage = 'obstacle=[{kind="rectangle", name="stage", centre=[-12, 13.6], size=[6, 2.8], margin=0.1}]'
    well = 'obstacle=[{kind="circle", name="the well", centre=[19.2, 0], radius=0.5, margin=0.1}]'
    said: dict[str, tuple[float, float, float, float]] = {}

    def watched(pdf: FPDF, x: float, y: float, text: str = "") -> None:
        said[text] = (x, y - 0.36 * pdf.font_size_pt, x + pdf.get_string_width(text), y)

    monkeypatch.setattr(FPDF, "text", watched)
    for thing, name in ((stage, "stage"), (well, "the well")):
        told = small(tmp_path, *square, thing)
        pdf = Typeset(told.checked_on, "")
        pdf.add_page()
        pdf.set_font("Noto", "", 8)
        frame = Frame(10.0, 10.0, 90.0, 60.0)
        SmallMap(told).draw(pdf, frame, [1], ["x"])
        pdf.output()  # which closes its fonts
        place = SmallMap(told)._scaled(frame)
        (venue,) = [one for one in told.plan.obstacles() if one.kind == "venue"]
        corners = np.array(place(venue.outline))
        (left, top), (right, bottom) = corners.min(axis=0), corners.max(axis=0)
        low_x, low_y, high_x, high_y = said[name]
        assert left < low_x
        assert high_x < right
        assert top < low_y
        assert high_y < bottom


def test_ways_that_lie_on_one_another_are_all_seen(
    tmp_path: Path, ours: Briefing, monkeypatch: pytest.MonkeyPatch
) -> None:
    widths: list[float] = []
    draw = SmallMap._line

    def watched(pdf: FPDF, *more: Any) -> None:
        widths.append(pdf.line_width)
        draw(pdf, *more)

    monkeypatch.setattr(SmallMap, "_line", staticmethod(watched))
    pdf = Typeset(ours.checked_on, "")
    pdf.add_page()
    pdf.set_font("Noto", "", 8)
    SmallMap(ours).draw(pdf, Frame(10.0, 10.0, 90.0, 60.0), [1, 2, 3], ["a", "b", "c"])
    pdf.output()  # which closes its fonts
    _route, *ways = widths
    assert ways[0] > ways[1] > ways[2]


def test_remarks_are_for_the_leader_alone(tmp_path: Path, ours: Briefing) -> None:
    told = replace(ours, roster=Roster({2: (Person("王五", remarks="wet paint"),)}))
    write_overview(tmp_path / "o.pdf", told, phones=False)
    write_benches(tmp_path / "b.pdf", told, Options())
    assert "王五(wetpaint)" in "".join(pages(tmp_path / "o.pdf"))
    assert "wetpaint" not in "".join(pages(tmp_path / "b.pdf"))


def test_what_a_row_of_the_list_says_of_several_is_printed_once(tmp_path: Path, ours: Briefing) -> None:
    two = (Person("王五", "", "139-7", "wet paint"), Person("赵六", "", "139-7", "wet paint"))
    other = (Person("钱七", "", "139-8", "lame"), Person("孙八", "", "", "tall"))
    told = replace(ours, roster=Roster({2: two, 3: other}))
    write_overview(tmp_path / "o.pdf", told, phones=True)
    write_benches(tmp_path / "b.pdf", told, Options(phones=True))
    text = "".join(pages(tmp_path / "o.pdf"))
    assert "王五,赵六(wetpaint),phoneofthehousehold:139-7" in text
    assert "钱七139-8(lame),孙八(tall)" in text
    sheet = pages(tmp_path / "b.pdf")[1]
    assert "王五赵六phoneofthehousehold:139-7" in sheet
    assert sheet.count("139-7") == 1
    home = replace(two[0], phone="", home_phone="139-9")
    write_benches(tmp_path / "h.pdf", replace(ours, roster=Roster({2: (home,)})), Options(phones=True))
    assert "王五phoneofthehousehold:139-9" in pages(tmp_path / "h.pdf")[1]


def test_the_sheets_of_head_and_tail_say_so_where_benches_are_counted_through(
    tmp_path: Path, ours: Briefing
) -> None:
    counted = small(tmp_path, "people.count_head=true", "people.unit=bench")
    assert [counted.titled(n) for n in (1, 2, 8)] == [
        "bench 1, the head",
        "bench 2",
        "bench 8, the tail",
    ]
    assert [ours.titled(n) for n in (1, 2)] == [ours.called(1), ours.called(2)]
    with spoken_in("zh"):
        write_benches(tmp_path / "b.pdf", counted, Options())
    found = pages(tmp_path / "b.pdf")
    assert "第1节板凳（龙头）" in found[0]
    assert "第8节板凳（龙尾）" in found[7]
    assert "（龙" not in found[1]


def test_a_sheet_names_the_other_benches_of_its_households(tmp_path: Path, ours: Briefing) -> None:
    assert ours.kin(1) == f"Of your household too: {ours.called(2)}."
    assert ours.kin(2) == f"Of your household too: {ours.called(1)}."
    assert ours.kin(6) == ours.kin(3) == ""
    unsaid = replace(ours, roster=Roster({2: (Person("王五"),), 5: (Person("赵六"),)}))
    assert unsaid.kin(2) == "", "of no household are not of one"
    write_benches(tmp_path / "b.pdf", ours, Options())
    found = pages(tmp_path / "b.pdf")
    assert bare(ours.kin(2)) in found[1]
    assert "household" not in found[5]


def test_the_tightest_moments_tell_the_mark_where_a_marshal_stands(tmp_path: Path) -> None:
    ours = small(tmp_path, "dragon.benches=40")
    said = str(overview(ours, phones=False).blocks)
    told = [int(n) for n in re.findall(r"at mark (\d+) then: Tightest", said)]
    near = sorted(
        (one.tightest.upper, one.bench, one.tightest.time) for one in ours.benches if one.tightest
    )
    assert told
    _gap, bench, time = near[0]
    motion = ours.report.walk.motion([time])
    place = np.array([motion.x[0, bench - 1], motion.y[0, bench - 1]])
    apart = np.hypot(*(ours.marks.points - place).T)
    assert apart[told[0] - 1] == apart.min() < 1.0


def test_the_overview_says_once_what_all_benches_do_alike(ours: Briefing) -> None:
    quick = bench_text(ours.plan, ours.benches[0], ours.called, ours.ground).quick
    alike = replace(
        ours, benches=tuple(replace(one, stretches=ours.benches[0].stretches) for one in ours.benches)
    )
    table = next(one for one in overview(alike, phones=False).blocks if isinstance(one, Table))
    assert len(table.columns) == 4, "nor who comes nearest, for nobody does"
    assert quick in str(overview(alike, phones=False).blocks)
    assert all(quick not in row for row in table.rows)


def test_contents_name_the_page_on_which_the_map_stands(tmp_path: Path, ours: Briefing) -> None:
    notes = replace(ours, roster=replace(ours.roster, notes=tuple(f"note {n}" for n in range(12))))
    write_overview(tmp_path / "o.pdf", notes, phones=False)
    reader = PdfReader(tmp_path / "o.pdf")
    told = re.search(r"Where each bench starts\s+(\d+)", reader.pages[0].extract_text())
    assert told is not None
    shown = next(n for n, page in enumerate(reader.pages, 1) if "Figure 1." in page.extract_text())
    assert int(told[1]) == shown == 2


@pytest.mark.parametrize("every", [None, 0.5])
def test_the_overview_says_from_which_mark_to_come_in_and_at_which_it_ends(
    tmp_path: Path, every: float | None
) -> None:
    ours = small(tmp_path, *([f"chalk.every={every}"] if every else []))
    said = str(overview(ours, phones=False).blocks)
    marks = chalk_drawing(ours).marks
    start = marks.kinds.index("start") + 1
    assert (
        f"comes in at mark 1 of the chalk plan and walks slowly along the line to mark {start};" in said
    )
    assert f"the head stands inside, at mark {len(marks)}:" in said
    table = next(one for one in overview(ours, phones=False).blocks if isinstance(one, Table))
    assert table.rows[0][2] == str(start), "where the head starts there is a mark"
    for row, found in zip(table.rows, ours.benches, strict=True):
        place = ours.report.walk.motion([ours.report.start]).s[0, found.bench - 1]
        numbers = [int(n) for n in re.findall(r"\d+", str(row[2]))]
        assert (
            marks.s[numbers[0] - 1] <= place + 0.01 <= marks.s[min(numbers[-1], len(marks) - 1)] + 0.02
        )
    # The way in is the line on which the dragon stands at first.
    assert marks.s[0] == pytest.approx(ours.trail.low)
    assert marks.s[start - 1] == pytest.approx(ours.trail.start)


def test_the_overview_names_whom_papers_cannot_print(ours: Briefing) -> None:
    told = replace(ours, roster=Roster({1: (Person("王\U00010600"),), 2: (Person("王五"),)}))
    (line,) = told.odd_signs
    assert line.startswith("the head: 王\U00010600: no font here has \U00010600 (U+10600)")
    said = str(overview(told, phones=False).blocks)
    (printed,) = told.missing_signs
    assert printed in said
    notes = said[said.index("Notes on the list") : said.index("Where each bench starts")]
    assert notes.count("U+10600") == 1
    assert ours.odd_signs == ()


def test_the_overview_speaks_to_the_leader_without_keys_of_the_plan(tmp_path: Path) -> None:
    told = small(tmp_path, "people.sway=0.05", 'people.source.sway="measured"', "people.beside=0.01")
    said = str(overview(told, phones=False).blocks)
    assert "people." not in said
    assert "5 cm to each side, measured" in said
    assert "1 cm on each side of a bench, assumption" in said
    assert " your " not in said
    assert "behind you" not in said


def test_the_verdict_on_papers_tells_the_clearance_as_the_check_does(ours: Briefing) -> None:
    first, *_others = [b for b in overview(ours, phones=False).blocks if isinstance(b, Paragraph)]
    assert f" keep {clearance_text(ours.report)} m" in str(first.words)


def test_the_overview_says_so_where_nobody_need_stand_by(ours: Briefing) -> None:
    alone = tuple(replace(one, tightest=None) for one in ours.benches)
    text = str(overview(replace(ours, benches=alone), phones=False).blocks)
    assert "No bench of another coil comes within about 1.5 m of any" in text
    near = (replace(alone[0], tightest=Tightest(1.0, 6, "left", 0.9, 0.9, (0.0, 0.0))), *alone[1:])
    text = str(overview(replace(ours, benches=near), phones=False).blocks)
    assert "of any" not in text


def test_who_has_nobody_near_has_a_dash_that_is_explained_once(ours: Briefing) -> None:
    def cells(near: list[Tightest | None]) -> tuple[str, Table]:
        benches = tuple(
            replace(one, tightest=near[n % len(near)]) for n, one in enumerate(ours.benches)
        )
        blocks = overview(replace(ours, benches=benches), phones=False).blocks
        return str(blocks), next(one for one in blocks if isinstance(one, Table))

    some = Tightest(1.0, 6, "left", 0.9, 0.9, (0.0, 0.0))
    text, table = cells([some, None])
    assert text.count("-: no bench of another coil comes within about 1.5 m of it.") == 1
    assert [row[-1] == "-" for row in table.rows] == [n % 2 == 1 for n in range(len(table.rows))]
    text, table = cells([some])
    assert "-: no bench" not in text
    assert "tightest" in table.columns
    text, table = cells([None])
    assert "-: no bench" not in text
    assert "tightest" not in table.columns


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (
            (),
            r"edge to the tail is then the (?P<edge>[a-z ]*) of the venue: (?P<far>[0-9.]+) m away",
        ),
        (
            ("turn",),
            r"it is (?P<far>[0-9.]+) m to the (?P<edge>[a-z ]*) of the venue, which is met",
        ),
    ],
)
def test_the_overview_says_which_edge_is_on_the_way_out(
    tmp_path: Path, settings: tuple[str, ...], said: str
) -> None:
    square = ("venue.rectangle=[80, 60]",)
    text = PLAN if not settings else PLAN.replace("spiral-in", "turn").split("[route]")[0]
    folder = tmp_path / "plan"
    folder.mkdir()
    plan = read_plan(str(village(folder, text)), [*square, "event.entrances=[[39, 0], [-39, 29]]"])
    told = briefing(plan, Roster())
    found = re.search(said, str(overview(told, phones=False).blocks))
    assert found is not None
    walk, end = told.report.walk, told.report.end
    motion = walk.motion([end])
    if settings:
        x, y = motion.x[0, 0], motion.y[0, 0]
        heading = float(walk.route.heading([motion.s[0, 0]])[0])
        ways = [(math.cos(heading), math.sin(heading))]
    else:
        x, y = motion.x[0, -1], motion.y[0, -1]
        ways = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
    sides = (
        ("right edge", 40.0, 1, 0),
        ("far edge", 30.0, 0, 1),
        ("left edge", 40.0, -1, 0),
        ("near edge", 30.0, 0, -1),
    )
    far, name = min(
        ((to - (a * x + b * y)) / (u * a + v * b), side)
        for u, v in ways
        for side, to, a, b in sides
        if u * a + v * b > 1e-9
    )
    assert found["edge"] == name
    assert float(found["far"]) == pytest.approx(far, abs=0.051)
    away = [math.dist((x, y), one) for one in ((39, 0), (-39, 29))]
    told_of = str(overview(told, phones=False).blocks)
    n = away.index(min(away))
    to = ((39, 0), (-39, 29))[n]
    assert f"Entrance {n + 1} of the plan is then nearest" in told_of
    assert f": {abs(to[0] - x):.1f} m to the " in told_of
    assert f" and {abs(to[1] - y):.1f} m " in told_of
    # The way in: from the first mark to where the head starts.
    first = told.marks.points[0]
    way = told.trail.start - told.trail.low
    assert (
        f"the head walks {way:.0f} m: {math.ceil(way / 60.0 / told.plan.walk.speed)} min at" in told_of
    )
    away = [math.dist(first, one) for one in ((39, 0), (-39, 29))]
    assert f"Entrance {1 + away.index(min(away))} of the plan is nearest to mark 1" in told_of
    write_overview(tmp_path / "o.pdf", told, phones=False)
    words = "".join(pages(tmp_path / "o.pdf"))
    assert "entrance1" in words
    assert "entrance2" in words


def test_the_overview_says_what_stands_in_the_way_in_and_out(tmp_path: Path) -> None:
    (tmp_path / "plan").mkdir()
    text = PLAN.replace("spiral-in", "turn").split("[route]")[0]
    file = str(village(tmp_path / "plan", text))
    square = "venue.rectangle=[80, 60]"
    free = briefing(read_plan(file, [square]), Roster())
    said = str(overview(free, phones=False).blocks)
    assert "Straight on from there it is" in said
    assert "Back along the line from mark 1 it is" in said
    assert "in the way" not in said
    walk, end = free.report.walk, free.report.end
    head = walk.motion([end])
    ends = (
        (float(head.x[0, 0]), float(head.y[0, 0]), float(walk.route.heading([head.s[0, 0]])[0])),
        (*map(float, free.marks.points[0]), float(walk.route.heading([free.trail.low])[0]) + math.pi),
    )
    wide = float(walk.dragon.width.max())
    for (x, y, heading), words in zip(
        ends, ("Straight on from there", "Back along the line from mark 1,"), strict=True
    ):
        for aside, met in ((0.0, True), (0.5 * wide + 0.29, True), (0.5 * wide + 0.31, False)):
            u, v = math.cos(heading), math.sin(heading)
            at = [x + 6.0 * u - (1.0 + aside) * v, y + 6.0 * v + (1.0 + aside) * u]
            well = f'{{kind="circle", name="well", centre={at}, radius=1.0, margin=0.3}}'
            told = briefing(read_plan(file, [square, f"obstacle=[{well}]"]), Roster())
            assert (f"{words} well is in the way" in str(overview(told, phones=False).blocks)) is met


def test_at_night_without_a_code_the_map_gives_way_before_what_one_does(tmp_path: Path) -> None:
    (tmp_path / "plan").mkdir()
    text = PLAN.replace("8", "40", 1)
    assert text != PLAN
    coded = briefing(read_plan(str(village(tmp_path / "plan", text))), Roster())
    bare = briefing(coded.plan.with_value("people.address", ""), Roster())
    words = []
    for n, one in enumerate((coded, bare)):
        write_benches(tmp_path / f"{n}.pdf", one, Options("quarter", night=True))
        words.append("".join(page.extract_text() for page in PdfReader(tmp_path / f"{n}.pdf").pages))
    assert words[0].count("walking, turn right") < words[1].count("walking, turn right") == 40
    assert "the rest is in the player" in words[0]
    assert "the rest is in the player" not in words[1]


def test_names_of_benches_on_a_map_do_not_lie_on_one_another(
    tmp_path: Path, ours: Briefing, monkeypatch: pytest.MonkeyPatch
) -> None:
    white: list[tuple[float, float, float, float]] = []
    fill = FPDF.rect

    def watched(pdf: FPDF, x: float, y: float, w: float, h: float, *more: Any, **named: Any) -> None:
        if h > 2.0:  # QR codes are of lower ones
            white.append((x, y, x + w, y + h))
        fill(pdf, x, y, w, h, *more, **named)

    monkeypatch.setattr(FPDF, "rect", watched)
    family = Roster({n: (Person(f"赵{n}", household="赵家"),) for n in range(1, 9)})
    write_benches(tmp_path / "b.pdf", replace(ours, roster=family), Options(by="household"))
    assert len(white) == 8
    for a, b in zip(white[::2], white[1::2], strict=True):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
