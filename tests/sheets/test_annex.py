"""The permit annex: what stands in the PDF is what plan and answers say, number by number."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from pypdf import PdfReader

from benchdragon.analysis.check import sentence
from benchdragon.analysis.crowd import Crowd, crowd_of, density_text, event_findings
from benchdragon.analysis.distance import boxes
from benchdragon.analysis.posts import EVERY, JOINED, _spaced, marshal_posts
from benchdragon.analysis.swept import rings, swept_area
from benchdragon.cli.main import run
from benchdragon.export.document import Document, Heading, Paragraph, Table
from benchdragon.i18n import LANGUAGES, _, spoken_in
from benchdragon.kernels.box import corner
from benchdragon.plans.people import PeopleTable
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.sheets import annex_facts as facts_of
from benchdragon.sheets.annex import annex_document, annex_names, write_annex
from benchdragon.sheets.annex_facts import AnnexFacts, Chance, annex_facts, deviations_of
from benchdragon.sheets.annex_first import NOT_CONSIDERED
from benchdragon.sheets.annex_tables import BLANK, basics, post_table, room_table
from benchdragon.sheets.briefing import Briefing
from tests.sheets.village import PLAN, ROSTER, briefing, small, village

SAID = (
    'event.place="Temple square"', 'event.place_zh="祠堂前"', 'event.date="2027-02-20"',
    'event.organiser="V 1"', "event.spectators=813", "event.marshals=1", "event.distance=3.25",
    "event.entrances=[[20, 5]]", "venue.rectangle=[40, 30]", "limits.speed=1.73",
    "people.sway=0.013", 'people.source.sway="M 7"', "cues.clock=18:30",
)  # fmt: skip


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> Briefing:
    return small(tmp_path_factory.mktemp("plan"), *SAID)


@pytest.fixture(scope="module")
def facts(told: Briefing) -> AnnexFacts:
    return annex_facts(told)


@pytest.fixture(scope="module")
def texts(told: Briefing, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The text of both PDFs without white space."""
    folder = tmp_path_factory.mktemp("annex")
    write_annex(folder, told)
    assert {path.name for path in folder.iterdir()} == set(annex_names())
    found: dict[str, str] = {}
    for name, file in zip(LANGUAGES, annex_names(), strict=True):
        pages = ["".join(page.extract_text().split()) for page in PdfReader(folder / file).pages]
        found |= {name: "".join(pages), f"{name} first": pages[0]}
    return found


def document(facts: AnnexFacts, language: str, folder: Path) -> Document:
    with spoken_in(language):
        return annex_document(facts, folder)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_pdf_holds_every_word_of_the_document(
    facts: AnnexFacts, texts: dict[str, str], language: str, tmp_path: Path
) -> None:
    for block in document(facts, language, tmp_path).blocks:
        words: list[str] = []
        match block:
            case Heading():
                words = [block.text]
            case Paragraph():
                words = [str(word) for word in block.words]
            case Table():
                words = [*block.columns, *(str(cell) for row in block.rows for cell in row)]
        for word in words:
            assert "".join(word.split()) in texts[language]


@pytest.mark.parametrize("language", LANGUAGES)
def test_numbers_are_those_of_the_plan_and_its_check(
    facts: AnnexFacts, texts: dict[str, str], language: str
) -> None:
    report, text = facts.briefing.report, texts[language]
    near, fast = report.clearance, report.greatest_speed
    edge = report.obstacles[0].distance
    for number in (
        "813", "2027-02-20", "V1", "3.25m", "1.73m/s", "0.013m", "M7", "2026-02-17",
        f"{facts.swept.area:.1f}m²", report.plan.sha256[:12], facts.briefing.sha256[:12],
        f"{float(report.walk.dragon.links.sum()):.2f}m",
    ):  # fmt: skip
        assert number in text
    for found, unit in ((near, "m"), (edge, "m"), (fast, "m/s")):
        shown = re.findall(rf"(\d+\.\d{{2,3}}){unit}(\d+\.\d{{4}})\.\.(\d+\.\d{{4}})", text)
        held = [
            tuple(map(float, row)) for row in shown
            if float(row[1]) <= found.lower and found.upper <= float(row[2])
        ]  # fmt: skip
        assert held
        assert held[0][0] == pytest.approx(found.sure(up=unit == "m/s"), abs=1e-2)
    assert facts.chance.shown
    high = math.ceil(1000.0 * facts.chance.share[2]) / 10.0
    assert (f"atmost{high:.1f}%" if language == "en" else f"至多{high:.1f}%") in text


def test_the_ground_within_the_line_is_told_before_the_strips_that_boards_pass_over(
    facts: AnnexFacts, tmp_path: Path, texts: dict[str, str]
) -> None:
    tables = {b.name: b for b in document(facts, "en", tmp_path).blocks if isinstance(b, Table)}
    (line, within), (strips, area), *_others = tables["swept"].rows
    assert (line, strips) == (
        "ground within the spectators' line, all of it",
        "of it, what boards pass over: strips along the route",
    )
    assert float(str(within).split()[0]) == pytest.approx(facts.within_line, abs=0.5)
    assert facts.within_line > facts.swept.area
    assert area == f"{facts.swept.area:.1f} m²"
    assert "t=0s" not in texts["en"], "the drawing tells times as all else does"
    assert "from18:30:00to18:30:12" in texts["en"]


def test_each_language_has_its_own_words_alone(texts: dict[str, str]) -> None:
    assert "Templesquare" in texts["en"]
    assert "祠堂前" in texts["zh"]
    assert not re.findall(r"[\u4e00-\u9fff]", texts["en"])
    said = texts["zh"]
    for word in ("benchdragon", "Fruin", "EPJ", *re.findall(r"[0-9a-f]{12}", said)):
        said = said.replace(word, "")
    assert not re.findall(r"[A-Za-z]{3,}", said)


def test_posts_and_timetable_tell_times_by_one_clock(facts: AnnexFacts, texts: dict[str, str]) -> None:
    clock = facts.briefing.clock
    times = [one.time for post in facts.posts for one in post.reasons if one.why == "tightest"]
    (shown,) = [clock.tell(time) for time in times]
    assert shown.startswith("18:30:")
    assert any(f" m at {shown}" in str(row[2]) for row in post_table(facts).rows)
    assert texts["en"].count("".join(clock.legend.split())) == 1
    assert f"mat{shown}" in texts["en"]


@pytest.mark.parametrize("language", LANGUAGES)
def test_neither_names_nor_telephones_of_bearers_are_told(texts: dict[str, str], language: str) -> None:
    for person in [one for people in ROSTER.benches.values() for one in people]:
        assert person.name not in texts[language]
        assert not person.phone or person.phone not in texts[language]


def test_what_the_plan_does_not_say_is_a_blank_that_is_named(tmp_path: Path) -> None:
    bare = small(tmp_path)
    missing = [name for name, value in basics(bare) if value == BLANK]
    assert missing == [
        "place", "date", "start of the dance", "organiser", "whom to ask", "spectators expected",
        "marshals",
    ]  # fmt: skip


def test_people_are_counted_from_the_list_of_names(facts: AnnexFacts, tmp_path: Path) -> None:
    tables = {b.name: b for b in document(facts, "en", tmp_path).blocks if isinstance(b, Table)}
    values = [row[1] for row in tables["people"].rows]
    assert values == ["8", "4", "5", "1", "813"]


def test_posts_stand_on_the_line_and_are_never_farther_apart_than_stated(facts: AnnexFacts) -> None:
    from shapely.geometry import LinearRing, Point

    rings = [LinearRing(ring) for ring in facts.swept.lines.outer]
    assert len(rings) == 1
    along = sorted(rings[0].project(Point(post.point)) for post in facts.posts)
    assert all(rings[0].distance(Point(post.point)) < 1e-6 for post in facts.posts)
    gaps = [b - a for a, b in zip(along, [*along[1:], along[0] + rings[0].length], strict=True)]
    assert max(gaps) <= EVERY + 1e-6
    why = {reason.why for post in facts.posts for reason in post.reasons}
    assert {"venue", "entrance", "tightest"} <= why
    assert "fastest" not in why, "all handles are as fast as the head"
    (entrance,) = [p for p in facts.posts if "entrance" in [one.why for one in p.reasons]]
    nearest = rings[0].distance(Point(20.0, 5.0))
    assert Point(entrance.point).distance(Point(20.0, 5.0)) <= nearest + JOINED
    assert len(post_table(facts).rows) == len(facts.posts)


def test_where_handles_run_there_are_posts_but_not_again_at_the_fastest(tmp_path: Path) -> None:
    # Two rushes, 10 m apart; only the faster one is where the fastest handle is.
    rushes = "[[0, 1], [1, 1], [1.5, 2.6], [2, 1], [12, 1], [12.5, 2.4], [13, 1]]"
    pace = f"walk.profile={rushes}", "walk.end=15", "dragon.benches=2"
    asked = []
    for run_from in (1.8, 2.5, 3.0):
        report = small(tmp_path, *pace, f"people.run_from={run_from}").report
        swept = swept_area(report.walk, report.start, report.end, margin=2.0, error=0.05)
        posts = marshal_posts(report, swept)
        asked.append([one for post in posts for one in post.reasons if one.why == "run"])
        assert "fastest" in [one.why for post in posts for one in post.reasons]
    assert [len(reasons) for reasons in asked] == [1, 0, 0]
    assert 12.0 <= asked[0][0].time <= 13.0
    assert 1.8 <= asked[0][0].value <= 2.5


def test_a_stop_of_the_head_makes_no_place_the_fastest(tmp_path: Path) -> None:
    text = PLAN + "[venue]\nboundary = [[-20, -20], [20, -20], [20, 20], [-20, 20]]\n"
    text += '[[cues.cue]]\nkind = "hold"\nat = 4\nhold = 3\n'
    report = briefing(read_plan(str(village(tmp_path, text)))).report
    assert report.walk.profile.stretches(report.start, report.end).speeds.min() == 0.0
    swept = swept_area(report.walk, report.start, report.end, margin=2.0, error=0.05)
    why = {reason.why for post in marshal_posts(report, swept) for reason in post.reasons}
    assert "fastest" not in why


def test_posts_tell_the_distances_that_the_check_found(facts: AnnexFacts) -> None:
    reasons = {one.why: one.value for post in facts.posts for one in post.reasons}
    report = facts.briefing.report
    (venue,) = [one for one in report.obstacles if one.obstacle.kind == "venue"]
    assert reasons["venue"] == venue.distance.sure(up=False)
    said = " ".join(str(row[2]) for row in post_table(facts).rows)
    cut = math.floor(1000.0 * reasons["tightest"]) / 1000.0
    assert f"benches nearest to one another: at least {cut:.3f} m at" in said
    cut = math.floor(1000.0 * reasons["venue"]) / 1000.0
    assert f"benches nearest to the venue's edge: at least {cut:.3f} m" in said


def test_a_line_on_which_nothing_is_wanted_has_posts_all_the_same() -> None:
    places = [along for along, _reasons in _spaced([], 90.0)]
    assert places == [0.0, 22.5, 45.0, 67.5]


def test_fewer_marshals_than_posts_are_told(facts: AnnexFacts, tmp_path: Path) -> None:
    said = [str(b.words) for b in document(facts, "en", tmp_path).blocks if isinstance(b, Paragraph)]
    assert any(f"{len(facts.posts)} posts and 1 marshals" in words for words in said)


def test_the_imprecision_of_the_plan_is_that_of_the_random_dances(tmp_path: Path) -> None:
    assert deviations_of(small(tmp_path, "people.imprecision=0.07")).aside == 0.07
    assert deviations_of(small(tmp_path)).aside == 0.02
    assert PeopleTable().imprecision == 0.0


def test_dances_that_cannot_be_drawn_leave_the_chance_open(facts: AnnexFacts, tmp_path: Path) -> None:
    none = replace(facts, chance=Chance(facts.chance.deviations, 0, 0))
    words = [str(b.words) for b in document(none, "en", tmp_path).blocks if isinstance(b, Paragraph)]
    assert any("nothing is said of the chance" in text for text in words)
    assert not any("drawn at random" in text for text in words)


def test_no_chance_is_told_that_is_not_shown_to_be_below_the_risk(
    facts: AnnexFacts, tmp_path: Path
) -> None:
    off = facts.chance.deviations
    # By 20 dances, of which none hits, no more is shown than that 16.8 % are enough.
    tried = [(draws, hits, Chance(off, draws, hits).shown) for draws in (20, 110) for hits in (0, 1, 2)]
    assert [told for *_drawn, told in tried] == [False, False, False, True, True, False]
    few = replace(facts, chance=Chance(off, 20, 0))
    words = [str(b.words) for b in document(few, "en", tmp_path).blocks if isinstance(b, Paragraph)]
    (said,) = [text for text in words if "drawn at random" in text]
    assert "no number is told" in said
    assert "at most" not in said


def test_dances_are_drawn_no_further_once_too_many_hit(tmp_path: Path) -> None:
    found = annex_facts(small(tmp_path, "people.imprecision=1", "limits.margin=0.04")).chance
    assert (found.hits, found.shown) == (2, False)
    assert found.draws < facts_of.DRAWS


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_first_page_holds_verdict_crowd_and_what_was_not_considered(
    told: Briefing, facts: AnnexFacts, texts: dict[str, str], language: str
) -> None:
    page = texts[f"{language} first"]
    with spoken_in(language):
        (nearest,), crowded = facts.nearest, facts.crowd.density
        assert nearest.witness is not None
        assert nearest.witness.time is not None
        assert crowded is not None
        expected = [
            sentence(told.report, told.clock), told.clock.tell(nearest.witness.time),
            _(NOT_CONSIDERED), f"{facts.crowd.ground:.0f}m²", "Fruin", "813",
            f"{math.ceil(10.0 * crowded) / 10.0:.1f}",
        ]  # fmt: skip
    for text in expected:
        assert "".join(text.split()) in page, text


def test_ground_for_spectators_is_what_lies_outside_the_line(facts: AnnexFacts) -> None:
    """Beside random places, each looked at from where the benches are at many times."""
    report, dice = facts.briefing.report, np.random.default_rng(36)
    edge = next(one.outline for one in report.plan.obstacles() if one.kind == "venue")
    places = shapely.points(dice.uniform(edge.min(axis=0), edge.max(axis=0), (4000, 2)))
    motion = report.walk.motion(np.linspace(report.start, report.end, 200))
    boards = shapely.union_all(
        [
            shapely.Polygon([corner(boxes(motion, t), n, k) for k in range(4)])
            for t in range(200) for n in range(len(report.walk.dragon))
        ]
    )  # fmt: skip
    line = shapely.union_all(
        [shapely.Polygon(ring) for ring in rings(boards.buffer(3.25, quad_segs=32)).outer]
    )
    free = float(np.mean(~shapely.contains(line, places)))
    venue = shapely.Polygon(edge).area
    assert facts.crowd.ground == pytest.approx(free * venue, abs=0.03 * venue)
    assert facts.crowd.way == pytest.approx(line.distance(shapely.Polygon(edge).boundary), abs=0.1)
    assert facts.crowd.ground is not None
    assert facts.crowd.density == 813 / facts.crowd.ground
    (found,), place = facts.nearest, shapely.Point(20, 5)
    assert found.value == pytest.approx(boards.distance(place), abs=0.05)
    assert found.witness is not None
    assert found.witness.time is not None
    table = boxes(report.walk.motion([found.witness.time]), 0)
    bench = shapely.Polygon([corner(table, found.witness.benches[0] - 1, k) for k in range(4)])
    assert bench.distance(place) == pytest.approx(found.value, abs=5e-3)


def test_too_many_people_on_the_ground_are_a_finding(facts: AnnexFacts, tmp_path: Path) -> None:
    ground = facts.crowd.ground or 0.0
    for people, codes in ((int(3.59 * ground), []), (int(3.61 * ground), ["BD402"])):
        plan = facts.briefing.plan.with_value("event.spectators", people)
        found = event_findings(plan, facts.swept, crowd_of(plan, facts.swept))
        assert [one.code for one in found] == codes
    said = ["people can walk about", "walking is slowed", "people are touched against their will"]
    said += ["dangerous forces begin", "critical even where nobody moves"]
    assert [density_text(one) for one in (1.99, 2.0, 3.6, 5.6, 7.1)] == said
    full = Crowd(20_000, 0.0, 0.0)
    assert full.density == math.inf
    (one,) = event_findings(read_plan("spiral-in"), facts.swept, full)
    assert one.text.startswith("there is no ground for 20000 spectators")
    assert Crowd(0, 0.0, 0.0).density == 0.0
    assert Crowd(5, None, None).density is None
    (table,) = [
        b for b in document(replace(facts, crowd=full), "en", tmp_path).blocks
        if isinstance(b, Table) and b.name == "crowd"
    ]  # fmt: skip
    assert [row[1] for row in table.rows[:4]] == [
        "20000", "0 m²", "there is no ground for them",
        "none: the line reaches the edge of the venue",
    ]  # fmt: skip


def test_what_is_wrong_with_the_crowd_is_said_in_the_terminal_and_on_the_first_page(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = village(tmp_path, PLAN)
    settings = (
        "event.spectators=20000",
        "venue.rectangle=[40, 30]",
        "event.entrances=[[3, 0], [20, 5]]",
    )
    words = [
        "sheets",
        str(path),
        "-o",
        str(tmp_path / "papers.html"),
        "--only",
        "annex",
        "--pdf",
        str(tmp_path / "papers"),
        "--lang",
        "en",
    ]
    assert run([*words, *(word for one in settings for word in ("--set", one))]) == 0
    told = " ".join(capsys.readouterr().err.split())
    assert "BD401: entrance 1 lies inside the spectators' line" in told
    assert "entrance 2" not in told
    assert "BD402: 20000 spectators on" in told
    page = PdfReader(tmp_path / "papers" / "annex.en.pdf").pages[0].extract_text()
    assert page.index("BD401") < page.index("BD402") < page.index("Table 1")


def test_a_plan_without_a_venue_knows_of_no_ground(tmp_path: Path) -> None:
    found = annex_facts(small(tmp_path, "event.spectators=20000"))
    assert found.crowd == Crowd(20_000, None, None)
    assert found.findings == ()
    tables = {b.name: b for b in document(found, "en", tmp_path).blocks if isinstance(b, Table)}
    assert [row[1] for row in tables["crowd"].rows] == [
        "20000", "unknown: the plan has no venue", "unknown", "unknown: the plan has no venue"
    ]  # fmt: skip


@pytest.mark.parametrize("setting", ['event.place="a\\nb"', "event.spectators=-1", "event.distance=0"])
def test_what_cannot_be_of_an_event_is_refused(setting: str) -> None:
    with pytest.raises(PlanError, match="event"):
        read_plan("spiral-in", [setting])


def test_the_event_does_not_change_the_name_of_a_plan() -> None:
    plain = read_plan("spiral-in")
    assert read_plan("spiral-in", ["event.spectators=5"]).sha256 == plain.sha256
    assert "event" not in plain.data()


def test_the_room_for_people_counts_between_benches(tmp_path: Path) -> None:
    asked = ("people.sway=0.01", "people.imprecision=0.02", "people.beside=0.1", "limits.margin=0.04")
    rows = room_table(small(tmp_path, *asked)).rows
    # 0.04, then twice the sway, twice the imprecision, and the people of both benches.
    assert [row[2] for row in rows] == ["0.04 m", "0.06 m", "0.1 m", "0.3 m"]
    assert rows[3][1] == "room for bearers on each side of a bench 0.1 m (assumption)"
