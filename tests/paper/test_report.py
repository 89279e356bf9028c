"""The report: links lead somewhere, numbers are the run's, in both languages, as HTML and PDF."""

import json
import math
import multiprocessing
import re
from contextlib import suppress
from html.parser import HTMLParser
from itertools import takewhile
from pathlib import Path

import pytest
from pypdf import PageObject, PdfReader
from pypdf.generic import ContentStream

from benchdragon.errors import InputError, UnsureError
from benchdragon.export.document import (
    Block,
    Document,
    Formula,
    Heading,
    Inline,
    Link,
    Listing,
    Paragraph,
    Picture,
    Reference,
    Table,
)
from benchdragon.export.forms import MM
from benchdragon.export.pages import MARGIN, write_pdf
from benchdragon.export.publish import write_html
from benchdragon.export.typeset import breakable
from benchdragon.i18n import spoken_in, use_language
from benchdragon.model.numbering import handle_text
from benchdragon.paper.report import report
from benchdragon.paper.reproduce import pages_from, reproduce
from benchdragon.paper.results import Results, searched
from benchdragon.parallel import PATIENCE
from benchdragon.plans.schema import read_plan
from benchdragon.solve.tolerance import CASES
from tests.test_number_format import SIGNED_ZERO

pytestmark = pytest.mark.xdist_group("paper")

ENGLISH = re.compile(r"[A-Za-z]{2,} [a-z]{2,} [a-z]{2,}")


# A picture laid on a page of the PDF: where its lower left corner is.
DRAWN = re.compile(r"1\.0+ 0 0 1\.0+ ([\d.]+) ([\d.]+) cm /Drawn\d+ Do Q")
# Of a page's height, so much at most is empty below what stands on it.
EMPTY = 0.4


def contents(page: PageObject) -> str:
    """The streams of a page, as text."""
    streams = page.get_contents()
    assert streams is not None
    return streams.get_data().decode("latin-1")


@pytest.fixture(scope="module")
def chinese(folder: Path, found: Results, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the report in Chinese, as a page and as a PDF."""
    there = tmp_path_factory.mktemp("chinese")
    with spoken_in("zh"):
        spoken = report(found)
        write_html(there / "report.html", spoken, folder)
        write_pdf(there / "report.pdf", spoken, folder)
    return there


@pytest.fixture(scope="module")
def printed(folder: Path) -> list[str]:
    """The text of each page of the PDF in English."""
    return [page.extract_text() for page in PdfReader(folder / "report.pdf").pages]


class Page(HTMLParser):
    """Anchors, links, sources and words of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.sources: list[str] = []
        self.words: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        del tag
        given = dict(attrs)
        self.anchors |= {given["id"] or ""} if "id" in given else set()
        self.links += [given["href"] or ""] if "href" in given else []
        self.sources += [given["src"] or ""] if "src" in given else []

    def handle_data(self, data: str) -> None:
        self.words.append(data)


def test_the_page_needs_nothing_beside_it(folder: Path, found: Results) -> None:
    page = Page((folder / "report.html").read_text("utf-8"))
    drawn = [block for block in report(found).blocks if isinstance(block, Picture | Formula)]
    assert len(page.sources) == len(drawn) > 25
    assert all(source.startswith("data:image/svg+xml;base64,") for source in page.sources)
    assert page.links
    assert all(link.startswith("#") and link[1:] in page.anchors for link in page.links)


def test_links_lead_to_the_documentation_where_that_is_given(found: Results) -> None:
    words = [part for block in report(found, "docs/en/").blocks for part in parts(block)]
    links = {part.target for part in words if isinstance(part, Link)}
    assert "docs/en/established.html#smallest-pitch" in links
    assert "docs/en/established.html#first-contact" in links
    assert "#how-smallest-pitch" in links


def parts(block: object) -> list[Inline]:
    if isinstance(block, Paragraph):
        return list(block.words)
    return [cell for row in block.rows for cell in row] if isinstance(block, Table) else []


def test_every_key_number_of_the_run_stands_in_both_files(folder: Path, printed: list[str]) -> None:
    answers = json.loads((folder / "answers.json").read_text("utf-8"))
    turn = answers["turn"]
    wanted = [
        f"{answers['pitch']['smallest']['value']:.12f}",
        f"{answers['contact']['first']['value']:.9f}",
        f"{turn['greatest_head_speed']['value']:.12f}",
        f"{turn['length_m']:.10f}",
        f"{turn['better'][0]['way']:.4f}",
        f"{answers['margins']['all']['median_m']:.4f}",
        f"{answers['rates']['smallest_pitch'][1]['exact'] * 10.0:.8f}",
    ]
    page = "".join(Page((folder / "report.html").read_text("utf-8")).words)
    pages = "".join(printed)
    for number in wanted[:5]:
        assert number in page
        assert number in pages.replace("\n", "")
    for number in wanted[5:]:
        assert number in page


def test_the_answers_and_how_each_is_known_stand_before_all_chapters(
    folder: Path, found: Results, printed: list[str]
) -> None:
    opening = list(takewhile(lambda block: not isinstance(block, Heading), report(found).blocks))
    (table,) = (block for block in opening if isinstance(block, Table))
    pitch, contact = found.smallest, found.report.first_contact
    assert contact is not None
    for row, (value, known) in zip(
        table.rows,
        (
            (f"{found.motion.x[300, 223]:.6f}, {found.motion.y[300, 223]:.6f}", "4e-15"),
            (
                f"{contact.value:.9f} s: bench 1 touches bench 9",
                f"{contact.upper - contact.lower:.1e} s",
            ),
            (f"{pitch.value:.12f} m", f"{pitch.upper - pitch.lower:.1e} m"),
            (f"{found.two_arcs.length:.10f} m", "best found"),
            (f"{found.head_speed.value:.12f} m/s", "found, bracket"),
        ),
        strict=True,
    ):
        asked, answer, how, _paper = row
        assert isinstance(asked, Link)
        assert isinstance(how, Link)
        assert value in str(answer)
        assert known in how.text
        assert re.sub(r"\s", "", value) in re.sub(r"\s", "", printed[0].partition("Contents")[0])
    assert "0.452 m" in table.rows[2]
    page = (folder / "report.html").read_text("utf-8")
    assert page.index(f"{pitch.value:.12f} m") < page.index("<nav>") < page.index("<h2 id=")


def test_the_paper_s_figures_and_claims_are_all_there(folder: Path) -> None:
    page = "".join(Page((folder / "report.html").read_text("utf-8")).words)
    for number in (
        "0.452 m",
        "consistent with pitches in steps of 0.004 or 0.002 m",
        "4.0055, 0.9841, -2.1575, 0.8639",
        "1 m/s",
        "(1)",
        "(6)",
        "Fig 1",
        "Fig 4",
    ):
        assert number in page, number


def test_the_handle_that_decides_is_named_as_elsewhere(found: Results, spoken: str) -> None:
    assert found.head_speed.witness is not None
    assert found.head_speed.witness.handle == 3
    words = " ".join(str(part) for block in report(found).blocks for part in parts(block))
    assert handle_text(3, 223) in words


def test_the_turn_is_said_to_be_shorter_in_two_senses(found: Results, folder: Path) -> None:
    deeper = json.loads((folder / "answers.json").read_text("utf-8"))["turn"]["deeper_joints"]
    assert deeper["length_m"] < found.two_arcs.length < deeper["way_m"]
    assert deeper["clearance"]["lower"] == pytest.approx(0.271, abs=1e-3)
    page = "".join(Page((folder / "report.html").read_text("utf-8")).words)
    for number in (deeper["length_m"], deeper["way_m"], deeper["clearance"]["lower"]):
        assert f"{number:.4f} m" in page


def test_no_zero_of_the_report_has_a_sign(folder: Path) -> None:
    page = "|".join(Page((folder / "report.html").read_text("utf-8")).words)
    assert "|0.000000|" in page  # y of the head at 0 s, -3e-14 m
    assert SIGNED_ZERO.findall(page) == []


def test_the_pdf_has_an_outline_pictures_and_links(folder: Path, found: Results) -> None:
    pdf = PdfReader(folder / "report.pdf")
    drawn = [block for block in report(found).blocks if isinstance(block, Picture | Formula)]
    assert pdf.metadata is not None
    assert "benchdragon" in (pdf.metadata.creator or "")
    assert len([entry for entry in pdf.outline if not isinstance(entry, list)]) == 9
    assert sum(len(DRAWN.findall(contents(page))) for page in pdf.pages) == len(drawn)
    assert any("/Annots" in page for page in pdf.pages)


def test_pictures_are_drawn_as_on_a_page_of_their_own(folder: Path) -> None:
    """Ends and joins of lines, widths, dashes and colours that a page sets reach no picture on it."""
    # Joins, ends, mitre limit, width, dashes, colours; a page of matplotlib's starts with these.
    fresh = {
        "J": [0], "j": [0], "M": [10], "w": [1], "d": [[], 0], "G": [0], "g": [0],
    }  # fmt: skip
    shown = 0
    for page in PdfReader(folder / "report.pdf").pages:
        stack, state = [], dict(fresh)
        for operands, operator in ContentStream(page.get_contents(), page.pdf).operations:
            name = operator.decode()
            if name == "q":
                stack.append(dict(state))
            elif name == "Q":
                state = stack.pop()
            elif name in {"RG", "K"}:
                state["G"] = list(operands)
            elif name in {"rg", "k"}:
                state["g"] = list(operands)
            elif name in fresh:
                state[name] = list(operands)
            elif name == "Do" and operands[0].startswith("/Drawn"):
                assert state == fresh
                shown += 1
    assert shown > 25


def test_what_is_said_to_suffice_is_not_rounded_down(found: Results) -> None:
    by_name = {block.name: block for block in report(found).blocks if isinstance(block, Table)}
    exact, dances = found.smallest.value, found.dances
    rows = by_name["needed-pitches"].rows
    for name, row in zip(CASES, rows, strict=True):
        one = dances.tolerance(name)
        for risk, cell in ((0.1, row[3]), (0.05, row[4])):
            low, high = (float(end) for end in str(cell).split(".."))
            assert low <= one.pitch_from(risk) <= one.pitch_for(risk) <= high < low + 0.01
        assert 0.0 <= exact + 0.01 * float(str(row[6])) - one.pitch_for(0.05) <= 1e-4
        low, high = (float(end) for end in str(row[5]).rstrip(")").partition("(")[2].split(".."))
        assert low <= 100.0 * dances.vouched[name].chance[1]
        assert high >= 100.0 * dances.vouched[name].chance[2]
    said = " ".join(str(cell) for row in by_name["claims"].rows for cell in row)
    upward = math.ceil(1000.0 * dances.tolerance("aside").pitch_for(0.05)) / 1000.0
    assert f"{upward:.3f} m with the first alone dropped" in said


def test_deviations_stand_in_the_order_of_the_rows_above(found: Results) -> None:
    (table,) = (
        one for one in report(found).blocks if isinstance(one, Table) and one.name == "needed-pitches"
    )
    *single, together = (str(row[1]).split(", ") for row in table.rows)
    assert together == [size for sizes in single for size in sizes]


def test_the_report_speaks_chinese(chinese: Path) -> None:
    text = (chinese / "report.html").read_text("utf-8")
    assert '<html lang="zh-Hans">' in text
    words = "".join(Page(text.partition("</style>")[2]).words)
    assert ENGLISH.findall(re.sub(r"[\w/.]+(\.py|\.md)|benchdragon[\w.]*", "", words)) == []
    assert "最小螺距" in words
    pages = "".join(page.extract_text() for page in PdfReader(chinese / "report.pdf").pages)
    assert "\u200b" not in pages
    assert "最小螺距" in pages


def test_both_languages_say_the_same_blocks(found: Results) -> None:
    english = report(found)
    use_language("zh")
    try:
        chinese = report(found)
    finally:
        use_language("en")
    assert [type(block) for block in english.blocks] == [type(block) for block in chinese.blocks]
    for one, other in zip(english.blocks, chinese.blocks, strict=True):
        if isinstance(one, Heading | Picture):
            assert isinstance(other, Heading | Picture)
            assert vars(one).get("anchor") == vars(other).get("anchor")
            assert vars(one).get("name") == vars(other).get("name")
        if isinstance(one, Table) and isinstance(other, Table):
            assert [len(row) for row in one.rows] == [len(row) for row in other.rows]


def test_tables_and_pictures_are_numbered_captioned_and_referred_to(
    found: Results, spoken: str
) -> None:
    del spoken
    document = report(found)
    shown = [block for block in document.blocks if isinstance(block, Table | Picture)]
    names = [block.name for block in shown]
    assert len(set(names)) == len(names) == len(document.labels)
    assert len({document.labels[name] for name in names}) == len(names)
    captions = [block.caption for block in shown]
    assert all(captions)
    assert len(set(captions)) == len(captions)
    referred = {
        part.name for block in document.blocks for part in parts(block) if isinstance(part, Reference)
    }
    assert referred == set(names)


def test_each_caption_stands_once_in_both_files(
    folder: Path, found: Results, printed: list[str]
) -> None:
    document = report(found)
    page = "".join(Page((folder / "report.html").read_text("utf-8")).words)
    pdf = "".join(printed)
    for label in document.labels.values():
        assert page.count(f"{label}. ") == 1, label
        assert pdf.count(f"{label}. ") == 1, label


def test_the_contents_lead_to_the_pages_of_all_chapters(found: Results, printed: list[str]) -> None:
    listed = re.findall(r"^(.+?)\s*(\d+)$", printed[0].partition("Contents")[2], re.MULTILINE)
    numbers = {text.strip(): int(number) for text, number in listed}
    for heading in report(found).headings:
        assert heading.text in printed[numbers[heading.text] - 1], heading.text
        if numbers[heading.text] > 1:
            assert heading.text in printed[0]
    assert report(found).date in printed[0]


@pytest.mark.parametrize("where", ["folder", "chinese"])
def test_no_page_but_the_last_is_half_empty(where: str, request: pytest.FixtureRequest) -> None:
    written: Path = request.getfixturevalue(where)
    pages = PdfReader(written / "report.pdf").pages
    height = float(pages[0].mediabox.height)
    for number, page in enumerate(pages[:-1], start=1):
        assert lowest(page) < EMPTY * height, f"page {number}"


def lowest(page: PageObject) -> float:
    """How far above the page's lower edge its last line or picture stands, points; not its number."""
    low = [float(y) for _x, y in DRAWN.findall(contents(page))]

    def visit(text: str, cm: list[float], tm: list[float], *_font: object) -> None:
        if text.strip() and tm[5] * cm[3] + cm[5] > MARGIN / MM:
            low.append(tm[5] * cm[3] + cm[5])

    page.extract_text(visitor_text=visit)
    return min(low)


def test_chinese_lines_may_break_after_signs_but_not_before_stops() -> None:
    assert breakable("板凳。龙 a b") == "板\u200b凳。\u200b龙\u200b a b"
    assert breakable("龙（板「凳」）走") == "龙\u200b（板\u200b「凳」）\u200b走\u200b"


def laid_out(tmp_path: Path, folder: Path, *blocks: Block) -> PdfReader:
    """A document of these blocks after a heading, as a PDF."""
    document = Document("t", "en", "2000-01-01", (Heading("Chapter", "here"), *blocks))
    write_pdf(tmp_path / "some.pdf", document, folder)
    return PdfReader(tmp_path / "some.pdf")


def test_signs_that_no_font_has_are_printed_by_their_code(tmp_path: Path, folder: Path) -> None:
    said = laid_out(tmp_path, folder, Paragraph(("gong \U00010600",))).pages[0].extract_text()
    assert "gong 〔U+10600〕" in said


def test_listings_stand_as_they_are_typed(tmp_path: Path, folder: Path) -> None:
    listing = Listing("benchdragon sweep <plan>\n    --ask x")
    assert "benchdragon sweep <plan>\n" in laid_out(tmp_path, folder, listing).pages[0].extract_text()
    document = Document("t", "en", "2000-01-01", (listing,))
    write_html(tmp_path / "some.html", document, folder)
    text = (tmp_path / "some.html").read_text("utf-8")
    assert "<pre>benchdragon sweep &lt;plan&gt;\n    --ask x</pre>" in text


def test_a_link_is_never_broken_and_its_stops_stay_with_it(tmp_path: Path, folder: Path) -> None:
    count = 70
    lines = [
        Paragraph(("龙" * n + "（", Link("如何 得知", "#here"), "）。板凳"))
        for n in range(1, count + 1)
    ]
    pdf = laid_out(tmp_path, folder, *lines)
    links = sum(len(page.get("/Annots", [])) for page in pdf.pages)
    assert links == count
    text = "\n".join(page.extract_text() for page in pdf.pages)
    assert re.findall(r"^[）。]|（\s*$", text, re.MULTILINE) == []


@pytest.mark.parametrize("above", range(8, 28, 2))
def test_no_picture_that_waits_parts_a_table_of_numbers(
    tmp_path: Path, folder: Path, above: int
) -> None:
    rows = tuple((f"row{n}", "1.5") for n in range(12))
    table = Table("numbers", "Some.", ("name", "value"), (1, 1), rows, numbers=True)
    pictures = Picture("turn-disc", "A turn."), Picture("turn-dragon", "A dragon.")
    pdf = laid_out(tmp_path, folder, *[Paragraph(("words",))] * above, *pictures, table)
    (page,) = (page for page in pdf.pages if "Table 1. Some." in page.extract_text())
    assert "row0" in page.extract_text()
    assert "row11" in page.extract_text()


@pytest.mark.parametrize("above", range(14, 28, 2))
def test_no_table_of_numbers_leaves_a_fifth_of_a_page_empty(
    tmp_path: Path, folder: Path, above: int
) -> None:
    rows = tuple((f"row{n}", "1.5") for n in range(30))
    table = Table("numbers", "Some.", ("name", "value"), (1, 1), rows, numbers=True)
    page = laid_out(tmp_path, folder, *[Paragraph(("words",))] * above, table).pages[0]
    assert lowest(page) - MARGIN / MM < 0.2 * float(page.mediabox.height)


@pytest.mark.parametrize("name", ["report.html", "report.pdf"])
def test_files_are_not_huge(folder: Path, name: str) -> None:
    assert 100_000 < (folder / name).stat().st_size < 12_000_000


@pytest.mark.usefixtures("ready")
def test_a_written_report_leads_to_pages_that_are_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pages = tmp_path / "pages"
    pages.mkdir()
    (pages / "established.html").write_text("here", "utf-8")
    monkeypatch.chdir(tmp_path)
    out = Path("deep/out")
    reproduce(out, docs="pages")
    page = Page((out / "report.html").read_text("utf-8"))
    away = [link for link in page.links if not link.startswith("#")]
    assert away
    assert all((out / link.partition("#")[0]).resolve().is_file() for link in away)
    assert pages_from(out, "https://example.org/manual") == "https://example.org/manual"
    with pytest.raises(InputError, match="no pages"):
        reproduce(tmp_path / "other", docs="nowhere")
    assert not (tmp_path / "other").exists()


def test_a_search_that_dies_is_told_and_none_outlives_the_run() -> None:
    plan = read_plan("turn")
    with searched(plan, (1.3,)) as better:
        (child,) = multiprocessing.active_children()
        child.kill()
        with pytest.raises(UnsureError, match="died"):
            better()
    with suppress(KeyboardInterrupt), searched(plan, (1.3,)):
        (child,) = multiprocessing.active_children()
        raise KeyboardInterrupt
    child.join(PATIENCE)
    assert not child.is_alive()
    free = plan.model_copy(update={"limits": plan.limits.model_copy(update={"speed": None})})
    with searched(free, (1.3,)) as better, pytest.raises(InputError, match="limit of speed"):
        better()
