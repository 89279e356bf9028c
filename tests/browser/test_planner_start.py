"""The planner without a plan: it asks for benches and square, and shows the dance that is proposed."""

import json
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from benchdragon.plans.schema import read_plan
from tests.browser.axe import needs_axe, violations
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import address, settled, verdict
from tests.browser.players import until

FIND = {"en": "Find our dance", "zh": "给我们排一场"}
WISHES = {
    "benches": 60, "length": 1.5, "width": 0.2, "head_length": 2, "inset": 0.15, "rectangle": [30, 20],
    "radius": None, "bearers": 2, "carry": "beside", "speed": 0.8, "most_speed": 1.5, "sway": 0.05,
    "imprecision": 0.1, "measured": [], "obstacles": [], "boundary": None, "kind": None, "rounds": 1,
    "street": None,
}  # fmt: skip
# In place of who searches for a dance: it keeps what it is asked, and answers when it is told to.
SEARCHER = """(able) => {
  const { answers, asking } = benchdragon;
  const has = answers.has.bind(answers);
  answers.has = (question) => (question === "propose" ? able : has(question));
  globalThis.search = { count: 0, asked: [] };
  answers.aside = () => ({
    ask: ({ question, wishes }, _signal, told) => {
      search.asked.push(question);
      Object.assign(search, { question, wishes, told, count: search.count + 1 });
      return new Promise((done, failed) => Object.assign(search, { done, failed }));
    },
    close: () => search.failed?.(new DOMException("", "AbortError")),
  });
  asking.build();
}"""


# All that the verdict's line says from now on.
SEEN = """() => {
  globalThis.seen = [];
  const line = document.querySelector(".verdict");
  new MutationObserver(() => seen.push(line.textContent)).observe(line, { childList: true });
}"""


def screen(page: Page) -> Locator:
    return page.locator(".wishes")


def begin(
    pages: Pages, file: Path, device: Device = "desktop", language: Language = "en", able: bool = True
) -> Page:
    """A page that has no plan, and that is answered by the test."""
    page = pages.open(f"{file.as_uri()}#lang={language}", device, language)
    until(page, "!!globalThis.benchdragon?.player")
    page.evaluate(SEARCHER, able)
    return page


def box(page: Page, name: str) -> Locator:
    return screen(page).get_by_role("textbox", name=name, exact=True)


def answer(page: Page, **answers: str) -> None:
    """Type answers into boxes, by the names of these."""
    for name, text in answers.items():
        box(page, NAMES[name]).fill(text)


NAMES = {
    "benches": "Benches", "each": "Length of a bench", "length": "length", "width": "width",
    "radius": "from its middle to its edge", "head": "Length of the head's bench",
    "wide": "Width of a bench",
}  # fmt: skip
SIXTY = {"benches": "60", "each": "1.5", "length": "30", "width": "20"}


def press(page: Page, language: Language = "en") -> None:
    screen(page).get_by_role("button", name=FIND[language]).click()


def asked(page: Page) -> Any:
    """The wishes for which a dance is searched."""
    until(page, "search.count > 0")
    assert page.evaluate("search.question") == "propose"
    return json.loads(page.evaluate("JSON.stringify(search.wishes)"))


def found(page: Page, plan: dict[str, Any] | None, *said: str, **fits: Any) -> None:
    nothing: dict[str, Any] = {"plan": plan, "said": said, "left": [], "benches": 0}
    page.evaluate("(found) => search.done(found)", nothing | fits)


def lost(page: Page, *said: str) -> None:
    """What the page says would be lost, before the dance is another one; and have it nevertheless."""
    before = page.evaluate("JSON.stringify(benchdragon.plan)")
    expect(page.locator(".unfit p")).to_have_text(list(said))
    assert page.evaluate("JSON.stringify(benchdragon.plan)") == before
    screen(page).get_by_role("button", name="show the new dance").click()


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_who_comes_without_a_plan_is_asked_beside_a_dance_that_walks(
    pages: Pages, bare_file: Path, device: Device, language: Language
) -> None:
    page = begin(pages, bare_file, device, language)
    expect(screen(page).get_by_role("heading", level=1)).to_be_visible()
    button = screen(page).get_by_role("button", name=FIND[language])
    expect(button).to_be_enabled()
    for hidden in (".verdict", ".panel", ".controls"):
        expect(page.locator(hidden)).to_be_hidden()
    expect(page.locator("canvas")).to_be_visible()
    until(page, "benchdragon.player.time > benchdragon.player.scene.start + 0.1")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    heights = screen(page).locator("button:visible, summary, select, .tick, .box input:visible")
    assert heights.evaluate_all("(all) => Math.min(...all.map((one) => one.clientHeight))") >= 40
    assert "plan=" not in page.url  # the dance that walks there is nobody's plan


def test_a_picture_and_the_questions_are_there_before_the_engine(pages: Pages, bare_file: Path) -> None:
    page = pages.open("about:blank")
    page.add_init_script("WebAssembly.compile = () => new Promise(() => {})")
    page.goto(f"{bare_file.as_uri()}#lang=en")
    expect(page.locator(".look svg")).to_be_in_viewport(ratio=1)
    expect(page.locator(".look strong").first).to_be_hidden()  # its verdict is of nobody's plan
    expect(screen(page).get_by_role("button", name="starting ...")).to_be_disabled()
    answer(page, benches="60")
    screen(page).get_by_role("button", name="中文").click()
    expect(screen(page).get_by_role("button", name="正在启动")).to_be_disabled()
    expect(screen(page).get_by_role("textbox").first).to_have_value("60")


def test_answers_are_read_as_people_type_them_and_shown_as_they_were_understood(
    pages: Pages, bare_file: Path
) -> None:
    page = begin(pages, bare_file)
    answer(page, benches="六十条", each="一米五", length="30米", width="2000cm")
    press(page)
    assert asked(page) == WISHES
    for name, text in {"benches": "60", "each": "1.5", "width": "20"}.items():
        expect(box(page, NAMES[name])).to_have_value(text)


def test_what_follows_from_other_answers_follows_and_what_was_measured_is_told(
    pages: Pages, bare_file: Path
) -> None:
    page = begin(pages, bare_file)
    screen(page).get_by_text("All else is as usual").click()
    answer(page, each="2.2")
    box(page, NAMES["each"]).press("Tab")
    expect(box(page, NAMES["head"])).to_have_value("2.7")
    answer(page, benches="9", head="3m")
    box(page, "Sway").fill("3cm")
    screen(page).get_by_role("radio", name="round").check()
    answer(page, radius="r12")
    screen(page).get_by_role("radio", name="under it").check()
    press(page)
    changed = {
        "benches": 9, "length": 2.2, "head_length": 3, "rectangle": None, "radius": 12,
        "carry": "under", "sway": 0.03, "measured": ["sway"],
    }  # fmt: skip
    assert asked(page) == WISHES | changed


def test_what_cannot_be_read_is_asked_back_beside_its_box(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file)
    screen(page).get_by_text("All else is as usual").click()
    answer(page, benches="1000", each="150", length="30", wide="5 ft")
    screen(page).get_by_text("All else is as usual").click()
    press(page)
    told = screen(page).locator(".asked:visible")
    expect(told).to_have_count(4)
    expect(told.nth(0)).to_have_text("Benches: expected 2 to 500, not '1000'")
    expect(told.nth(1)).to_contain_text("write 150cm for centimetres")
    expect(told.nth(2)).to_have_text("Not answered yet.")
    expect(told.nth(3)).to_contain_text("expected a length from 1 cm to 2 m, such as 15cm, not '5 ft'")
    expect(box(page, NAMES["benches"])).to_be_focused()
    expect(box(page, NAMES["benches"])).to_have_attribute("aria-invalid", "true")
    expect(box(page, NAMES["benches"])).to_have_accessible_description(
        "Benches: expected 2 to 500, not '1000'"
    )
    assert page.evaluate("search.count") == 0
    told.nth(1).get_by_role("button", name="150 cm").click()
    expect(box(page, NAMES["each"])).to_have_value("1.5")
    answer(page, benches="60", width="20", wide="")
    press(page)
    assert asked(page) == WISHES
    expect(told).to_have_count(0)


def test_a_wrong_answer_in_a_folded_question_unfolds_it(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file)
    answer(page, **SIXTY)
    more = screen(page).get_by_text("All else is as usual")
    more.click()
    answer(page, wide="wide")
    more.click()
    expect(box(page, NAMES["wide"])).to_be_hidden()
    press(page)
    expect(box(page, NAMES["wide"])).to_be_focused()


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_the_dance_that_was_proposed_walks_and_what_was_said_can_be_read_again(
    pages: Pages, bare_file: Path, device: Device, language: Language
) -> None:
    page = begin(pages, bare_file, device, language)
    boxes = screen(page).locator(".box input:visible")
    for n, text in enumerate(SIXTY.values()):
        boxes.nth(n).fill(text)
    press(page, language)
    asked(page)
    until(page, "benchdragon.verdict !== null")
    page.evaluate(SEEN)
    page.evaluate("search.told(0.4, 'discs of 4 m')")
    expect(screen(page).get_by_role("progressbar")).to_have_attribute("value", "0.4")
    expect(screen(page).get_by_text("discs of 4 m")).to_be_visible()
    plan = read_plan("turn", ["dragon.benches=12"])
    found(page, plan.data(), "12 benches fit.", "They come out again.")
    expect(screen(page)).to_be_hidden()
    expect(page.locator(".proposed summary")).to_have_text("12 benches fit.")
    expect(page.locator(".proposed summary")).to_be_in_viewport()
    until(page, "benchdragon.player.scene.benches === 12 && benchdragon.player.playing")
    start = page.evaluate("benchdragon.player.scene.start")
    assert start <= page.evaluate("benchdragon.player.time") < start + 20
    settled(page)
    told = page.evaluate("seen")
    assert told
    assert not [one for one in told if "earlier plan" in one or "之前" in one]  # it was nobody's
    assert "plan=" in address(page)
    expect(page.get_by_role("button", name={"en": "undo", "zh": "撤销"}[language])).to_be_disabled()
    if device == "phone":
        expect(page.locator(".proposed p")).to_be_hidden()
        page.locator(".proposed summary").click()
    expect(page.locator(".proposed p")).to_have_text("They come out again.")
    expect(page.locator(".proposed p")).to_be_in_viewport(ratio=1)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    page.evaluate("benchdragon.change(structuredClone(benchdragon.presets[0].plan), true)")
    expect(page.locator(".proposed summary")).to_be_hidden()  # it told of another plan
    page.evaluate("benchdragon.undo()")
    expect(page.locator(".proposed summary")).to_be_visible()


@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_three_answers_make_a_dance_that_stays_on_the_square(
    pages: Pages, bare_file: Path, device: Device, language: Language
) -> None:
    page = pages.open(f"{bare_file.as_uri()}#lang={language}", device, language)
    until(page, "!!globalThis.benchdragon?.player")
    boxes = screen(page).locator(".box input:visible")
    for n, text in enumerate(("九条", "150cm", "20", "20米")):
        boxes.nth(n).fill(text)
    press(page, language)
    expect(screen(page)).to_be_hidden()
    expect(page.locator(".proposed summary")).to_contain_text("9")
    until(page, "benchdragon.player.scene.benches === 9 && benchdragon.player.playing")
    settled(page)
    expect(verdict(page)).to_have_class("verdict safe")
    plan = json.loads(page.evaluate("JSON.stringify(benchdragon.plan)"))
    assert (plan["dragon"]["benches"], plan["venue"]["rectangle"]) == (9, [20, 20])


def test_a_search_is_given_up_and_the_answers_stay(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file)
    answer(page, **SIXTY)
    press(page)
    asked(page)
    expect(box(page, NAMES["benches"])).to_be_disabled()
    screen(page).get_by_role("button", name="cancel").click()
    expect(screen(page).get_by_role("button", name=FIND["en"])).to_be_focused()
    expect(screen(page).get_by_role("progressbar")).to_have_count(0)
    expect(box(page, NAMES["benches"])).to_have_value("60")
    expect(screen(page).locator(".unfit")).to_be_empty()


def test_where_nothing_fits_it_says_so_and_offers_as_many_as_do(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file)
    answer(page, **SIXTY)
    press(page)
    asked(page)
    found(page, None, "60 benches do not fit on this square.", benches=41)
    expect(
        screen(page).get_by_role("alert").filter(has_text="60 benches do not fit")
    ).to_be_in_viewport()
    screen(page).get_by_role("button", name="take 41 benches").click()
    until(page, "search.count === 2")
    assert asked(page) == WISHES | {"benches": 41}
    expect(screen(page).locator(".unfit")).to_be_empty()
    found(page, None, "They fit if their bearers walk under them.", under=True)
    screen(page).get_by_role("button", name="walk under the benches").click()
    until(page, "search.count === 3")
    assert asked(page) == WISHES | {"benches": 41, "carry": "under"}
    found(page, None, "Nothing fits.")
    expect(screen(page).get_by_text("Nothing fits.")).to_be_visible()
    expect(screen(page).get_by_role("button", name="take")).to_have_count(0)
    expect(screen(page).get_by_role("button", name="walk under")).to_have_count(0)


@pytest.mark.parametrize("own", [True, False])
def test_another_dance_keeps_the_event_and_the_names_of_the_page(
    pages: Pages, bare_file: Path, own: bool
) -> None:
    page = begin(pages, bare_file)
    titles = ["Our dance", page.evaluate("benchdragon.presets[1].title.en")]
    plan = read_plan("spiral-in", ["dragon.benches=12"]).data() | {
        "meta": {"title": titles[0] if own else titles[1]},
        "event": {"entrances": [[3, 4]], "date": "2026-02-17"},
        "people": {"unit": "qiao", "count_head": False, "sway": 0.02},
    }
    page.evaluate("(plan) => void benchdragon.change(plan, true)", plan)
    page.get_by_role("button", name="my benches").click()
    answer(page, **SIXTY)
    press(page)
    asked(page)
    proposed = read_plan("spiral-in", ["dragon.benches=60", "people.sway=0.05"]).data()
    found(page, proposed | {"meta": {"title": "Another"}}, "All 60 benches fit.")
    until(page, "benchdragon.plan.dragon.benches === 60")
    there = json.loads(page.evaluate("JSON.stringify(benchdragon.plan)"))
    assert there["meta"]["title"] == ("Our dance" if own else "Another")
    assert there["event"]["entrances"] == [[3, 4]]
    assert (there["people"]["unit"], there["people"]["sway"]) == ("qiao", 0.05)


@pytest.mark.parametrize("kept", [3, 2, 1])
def test_another_dance_keeps_the_rounds_their_rests_and_the_hour(
    pages: Pages, bare_file: Path, kept: int
) -> None:
    page = begin(pages, bare_file)
    rests = [{"kind": "hold", "round": n, "hold": 60} for n in (2, 3)]
    bow = {"kind": "hold", "at": 5, "hold": 20, "text": "bow"}
    rounds = ["dragon.benches=12", "route.rounds=3"]
    plan = read_plan("turn", rounds).data() | {
        "cues": {"clock": "18:30", "tempo": 100, "cue": [*rests, bow]}
    }
    page.evaluate("(plan) => void benchdragon.change(plan, true)", plan)
    page.get_by_role("button", name="my benches").click()
    answer(page, **SIXTY)
    press(page)
    assert asked(page)["rounds"] == 3
    proposed = read_plan("turn", ["dragon.benches=60", f"route.rounds={kept}", "walk.end=900"]).data()
    found(page, proposed, "All 60 benches fit.")
    lost(page, CALLS.format(count=4 - kept), BACK)
    until(page, "benchdragon.plan.dragon.benches === 60")
    there = json.loads(page.evaluate("JSON.stringify(benchdragon.plan)"))
    assert there["route"].get("rounds", 1) == kept
    assert (there["cues"]["clock"], there["cues"]["tempo"]) == ("18:30", 100)
    assert there["cues"].get("cue", []) == rests[: kept - 1]
    assert there["walk"]["end"] == (900 if kept == 1 else None)


STREET = [[-60, 0], [-30, 2], [-20, 6]]
CALLS = "Rests and calls of the dance before are left out: {count}."
BACK = "Undo brings back the dance before, with all of that."


@pytest.mark.parametrize("kept", [True, False])
def test_another_dance_keeps_the_street_or_says_so_before_and_undo_brings_it_back(
    pages: Pages, bare_file: Path, kept: bool
) -> None:
    page = begin(pages, bare_file)
    rests = [{"kind": "hold", "place": place, "hold": 60} for place in ([-45, 1.5], [3, 3])]
    plan = read_plan("turn", ["dragon.benches=12"]).data() | {"cues": {"cue": rests}}
    plan["route"]["street"] = {"points": STREET}
    page.evaluate("(plan) => void benchdragon.change(plan, true)", plan)
    page.get_by_role("button", name="my benches").click()
    answer(page, **SIXTY)
    press(page)
    assert asked(page)["street"] == {"points": STREET}
    proposed = read_plan("turn", ["dragon.benches=60"]).data()
    if kept:
        proposed["route"]["street"] = {"points": STREET}
        found(page, proposed, "All 60 benches fit.")
        lost(page, CALLS.format(count=1), BACK)  # the rest on the square
    else:
        found(page, proposed, "All 60 benches fit.", left=["The street is left out."])
        lost(page, "The street is left out.", CALLS.format(count=2), BACK)
    until(page, "benchdragon.plan.dragon.benches === 60")
    there = json.loads(page.evaluate("JSON.stringify(benchdragon.plan)"))
    assert there["route"].get("street") == ({"points": STREET} if kept else None)
    assert there.get("cues") == ({"cue": rests[:1]} if kept else None)
    page.get_by_role("button", name="undo", exact=True).click()
    assert page.evaluate("benchdragon.plan.route.street.points") == STREET
    assert page.evaluate("benchdragon.plan.cues.cue.length") == 2


def test_a_drawn_route_gives_way_to_a_coil_after_that_was_said(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file)
    drawn = {"kind": "drawn", "points": [[0, 0], [40, 0], [60, 30]]}
    plan = read_plan("spiral-in", ["dragon.benches=12"]).data() | {"route": drawn, "disc": {}}
    page.evaluate("(plan) => void benchdragon.change(plan, true)", plan)
    page.get_by_role("button", name="my benches").click()
    answer(page, **SIXTY)
    press(page)
    asked(page)
    found(page, read_plan("turn", ["dragon.benches=60"]).data(), "All 60 benches fit.")
    lost(page, "The route of the plan before gives way to a coil.", BACK)
    until(page, "benchdragon.plan.route.kind === 'turn'")


def test_a_page_that_cannot_search_asks_nothing(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file, able=False)
    expect(screen(page).get_by_role("button", name=FIND["en"])).to_have_count(0)
    expect(box(page, NAMES["benches"])).to_have_count(0)
    expect(screen(page).get_by_role("combobox", name="Ready-made dances")).to_be_visible()


def test_who_has_a_plan_is_not_asked_and_may_ask_for_another(
    pages: Pages, file: Path, bare_file: Path
) -> None:
    page = settled(pages.open(f"{file.as_uri()}#lang=en"))
    expect(screen(page)).to_be_hidden()
    page.evaluate("void benchdragon.change(benchdragon.presets[1].plan, true)")
    link = address(page)
    for where in (f"{bare_file.as_uri()}#{link.partition('#')[2]}", bare_file.as_uri()):
        page.goto("about:blank")
        page.goto(where)
        settled(page)
        expect(screen(page)).to_be_hidden()
        page.get_by_label("keep the plan in this browser").check()
    page.evaluate(SEARCHER, True)
    page.get_by_role("button", name="my benches").click()
    expect(box(page, NAMES["benches"])).to_be_focused()
    expect(box(page, NAMES["benches"])).to_have_value("223")  # as the plan of the page has it
    page.keyboard.press("Escape")
    expect(screen(page)).to_be_hidden()
    expect(page.get_by_role("button", name="my benches")).to_be_focused()
    assert page.evaluate("benchdragon.plan.dragon.benches") == 223


@pytest.mark.parametrize(
    ("venue", "typed", "told"),
    [
        ({}, True, {"rectangle": [30, 20], "boundary": None}),
        ({"rectangle": [40, 30]}, False, {"rectangle": [40, 30], "boundary": None}),
        (
            {"rectangle": [40, 30], "centre": [5, 1], "angle": 90},
            True,
            {"rectangle": None, "boundary": [[-5, 16], [-5, -14], [15, -14], [15, 16]]},
        ),
        (
            {"boundary": [[0, 0], [50, 0], [25, 40]]},
            False,
            {"rectangle": None, "boundary": [[0, 0], [50, 0], [25, 40]]},
        ),
    ],
    ids=["typed", "kept", "moved", "drawn"],
)
def test_the_square_of_the_page_stays_in_place_with_what_stands_there(
    pages: Pages, file: Path, venue: dict[str, Any], typed: bool, told: dict[str, Any]
) -> None:
    page = settled(pages.open(f"{file.as_uri()}#lang=en"))
    page.evaluate(SEARCHER, True)
    well = {"kind": "circle", "name": "well", "centre": [6, 5], "radius": 0.6, "margin": 0}
    page.evaluate(
        "(more) => benchdragon.change({ ...benchdragon.plan, ...more }, true)",
        {"obstacle": [well], "venue": venue},
    )
    page.get_by_role("button", name="my benches").click()
    if typed:
        answer(page, length="30", width="20")
    press(page)
    wishes = asked(page)
    assert wishes["obstacles"] == [well]
    assert (wishes["benches"], wishes["radius"]) == (223, None)
    assert {"rectangle": wishes["rectangle"]} == {"rectangle": told["rectangle"]}
    if told["boundary"]:
        assert {tuple(map(round, corner)) for corner in wishes["boundary"]} == {
            tuple(corner) for corner in told["boundary"]
        }
    else:
        assert wishes["boundary"] is None


def test_students_are_one_tap_away_from_the_contests_questions(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file)
    screen(page).get_by_role("button", name="3: why the pitch cannot be smaller").click()
    expect(screen(page)).to_be_hidden()
    until(page, "benchdragon.plan.meta.title === 'Coiling in to the disc'")
    until(page, "search.asked.includes('limit/pitch')")


def test_plans_are_opened_from_a_file_a_list_and_a_link(
    pages: Pages, bare_file: Path, tmp_path: Path
) -> None:
    path = tmp_path / "own.dragon.toml"
    path.write_text("schema = 1\n[route]\nkind = 'turn'\n[dragon]\nbenches = 7\n", "utf-8")
    page = begin(pages, bare_file)
    screen(page).get_by_text("I have a plan already").click()
    screen(page).locator("input[type=file]").set_input_files(path)
    expect(screen(page)).to_be_hidden()
    assert page.evaluate("benchdragon.plan.dragon.benches") == 7
    settled(page)
    link = address(page)

    page = begin(pages, bare_file)
    screen(page).get_by_role("combobox", name="Ready-made dances").select_option("turn")
    expect(screen(page)).to_be_hidden()
    assert page.evaluate("benchdragon.plan.dragon.benches") == 223

    page = begin(pages, bare_file)
    screen(page).get_by_text("I have a plan already").click()
    paste = screen(page).get_by_role("textbox", name="or paste its link")
    paste.fill("https://example.org/")
    expect(screen(page).get_by_text("There is no plan in this: paste its link")).to_be_visible()
    paste.fill(f"look at this: {link} - tonight!")
    expect(screen(page)).to_be_hidden()
    until(page, "benchdragon.plan.dragon.benches === 7")


def test_the_language_is_changed_and_the_answers_stay(pages: Pages, bare_file: Path) -> None:
    page = begin(pages, bare_file)
    answer(page, benches="60")
    screen(page).get_by_role("button", name="中文").click()
    expect(screen(page).get_by_role("button", name=FIND["zh"])).to_be_visible()
    expect(screen(page).get_by_role("textbox").first).to_have_value("60")
    expect(page.locator("canvas")).to_be_visible()
    expect(page.locator(".panel")).to_be_hidden()


def test_motion_waits_where_people_asked_for_less(pages: Pages, bare_file: Path) -> None:
    page = pages.open("about:blank")
    page.emulate_media(reduced_motion="reduce")
    page.goto(f"{bare_file.as_uri()}#lang=en")
    until(page, "!!globalThis.benchdragon?.player && benchdragon.root.ariaBusy === 'false'")
    assert not page.evaluate("benchdragon.player.playing")


@needs_axe
@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_axe_finds_nothing_wrong_where_it_asks(
    pages: Pages, bare_file: Path, device: Device, language: Language
) -> None:
    page = begin(pages, bare_file, device, language)
    page.evaluate("document.querySelectorAll('.wishes details').forEach((one) => (one.open = true))")
    press(page, language)
    expect(screen(page).locator(".asked:visible")).not_to_have_count(0)
    for colours in ("light", "dark"):
        page.emulate_media(color_scheme=colours)
        assert violations(page) == [], colours
