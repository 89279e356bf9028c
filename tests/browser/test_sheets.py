"""The code on a bench's sheet opens the player at that bench."""

from pathlib import Path

import numpy as np
import pypdfium2
import pytest
import zxingcpp
from playwright.sync_api import expect

from benchdragon.i18n import spoken_in
from benchdragon.planner.papers import wanted_papers, write_papers
from benchdragon.plans.people import called
from benchdragon.player.page import player_page, write_player
from benchdragon.player.scene import checked_dance
from tests.browser.pages import Language, Pages
from tests.browser.players import ready
from tests.browser.village import ROSTER, small


def test_the_code_on_a_sheet_opens_the_player_at_its_bench(pages: Pages, tmp_path: Path) -> None:
    player = tmp_path / "player.html"
    ours = small(tmp_path, "people.address=player.html")
    write_player(player, checked_dance(ours))
    papers = tmp_path / "papers.html"
    wanted = {"paper": "a4", "by": "bench", "night": False, "phones": False}
    write_papers(papers, ours.plan, wanted_papers(["benches"], ROSTER, wanted))
    printed = pages.open(papers.as_uri())
    expect(printed.locator("#sheets")).to_have_attribute("aria-busy", "false")
    sheet = pypdfium2.PdfDocument(printed.pdf(prefer_css_page_size=True))[5]
    picture = np.asarray(sheet.render(scale=150 / 72).to_pil().convert("L"))
    (code,) = zxingcpp.read_barcodes(picture)
    assert code.text == "player.html#bench=6"
    page = ready(pages.open(f"{tmp_path.as_uri()}/{code.text}", "phone", "zh", "light"))
    assert page.evaluate("[benchdragon.chosen, benchdragon.follows]") == [5, True]
    seen = page.evaluate(
        """() => {
          const { camera, boxes } = benchdragon;
          const [x, y] = camera.toScreen(boxes.x[5], boxes.y[5]);
          return [x / innerWidth, y];
        }"""
    )
    assert 0.3 < seen[0] < 0.7
    page = ready(pages.open(f"{player.as_uri()}#t=2&bench=6", "phone", "zh", "light"))
    assert page.evaluate("[benchdragon.chosen, benchdragon.follows]") == [5, False]


@pytest.mark.parametrize(("head", "language"), [("true", "en"), ("false", "zh")])
def test_a_card_calls_each_bench_as_its_sheet_does(
    head: str, language: Language, pages: Pages, tmp_path: Path
) -> None:
    player = tmp_path / "player.html"
    ours = small(tmp_path, f"people.count_head={head}")
    player.write_text(player_page(checked_dance(ours), language), "utf-8")
    page = ready(pages.open(player.as_uri(), "phone", language, "light"))
    plan = {"en": " (bench {n} of the plan)", "zh": "（方案里的第 {n} 节）"}[language]
    for bench in range(1, 9):
        page.evaluate(f"benchdragon.choose({bench - 1})")
        with spoken_in(language):
            name = called(ours.plan.people, bench, 8)
        assert page.locator("aside.card h2").inner_text() == name + plan.format(n=bench)
        buttons = page.locator("aside.card nav button").all_inner_texts()
        with spoken_in(language):
            beside = [called(ours.plan.people, n, 8) for n in (bench - 1, bench + 1) if 1 <= n <= 8]
        assert [text.strip("\u2190\u2192 ") for text in buttons] == beside


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_card_calls_the_nearest_bench_as_the_village_does(
    language: Language, pages: Pages, tmp_path: Path
) -> None:
    player = tmp_path / "player.html"
    ours = small(tmp_path, "dragon.benches=30")
    player.write_text(player_page(checked_dance(ours), language), "utf-8")
    page = ready(pages.open(player.as_uri(), "phone", language, "light"))
    page.evaluate("benchdragon.choose(2)")
    other = page.evaluate("benchdragon.scene.sent.nearest.other[2]")
    assert other > 0
    with spoken_in(language):
        name = called(ours.plan.people, other, 30)
    assert name in page.locator("aside.card dd").nth(5).inner_text()
