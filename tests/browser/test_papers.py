"""Papers as a page that opens on them, and as files that installed browsers print."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import pypdfium2
import pytest
import zxingcpp
from playwright.sync_api import expect

from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in
from benchdragon.planner import printing
from benchdragon.planner.papers import PAPERS
from tests.browser.firefox import firefox_path
from tests.browser.pages import Pages, browser_path
from tests.browser.planners import address
from tests.browser.test_planner_sheets import sheets
from tests.browser.village import PLAN, village

LIST = "桥号,姓名,户主,电话\n龙头,张三,张家,138-0000-0001\n1,王五,张家,\n5,赵六,赵家,\n"
MILLIMETRE = 72 / 25.4


@pytest.fixture
def plan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A small dance with a list of names."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "names.csv").write_text(LIST, "utf-8")
    return village(tmp_path, PLAN + 'roster = "names.csv"\n')


def texts(path: Path) -> list[str]:
    """What stands on each page of a file, without spaces."""
    pages = pypdfium2.PdfDocument(path)
    for page in pages:
        assert page.get_size() == pytest.approx((595.3, 841.9), abs=1.0)
    return ["".join(page.get_textpage().get_text_bounded().split()) for page in pages]


def test_the_page_opens_on_the_papers_asked_for(pages: Pages, plan: Path) -> None:
    with spoken_in("zh"):
        assert run(["sheets", str(plan), "--only", "benches", "--by", "household", "--quiet"]) == 0
    page = pages.open(plan.with_name("papers.html").as_uri())
    expect(sheets(page)).to_have_attribute("aria-busy", "false")
    expect(sheets(page).locator(".paper")).to_have_count(7)
    expect(sheets(page).locator(".paper").first).to_contain_text("张三")
    expect(sheets(page).get_by_role("checkbox", name="按户排")).to_be_checked()
    assert page.evaluate("document.documentElement.lang") == "zh-CN"
    sheets(page).get_by_role("combobox", name="打印什么").select_option("")
    expect(sheets(page)).to_have_attribute("aria-busy", "false")
    kinds = "(all) => all.map((one) => one.dataset.paper)"
    assert tuple(sheets(page).locator(".kind").evaluate_all(kinds)) == PAPERS
    assert "张三" not in page.evaluate(
        "JSON.stringify([{...localStorage}, benchdragon.plan, location.hash])"
    )


def test_a_page_that_is_sent_to_another_plan_shows_no_papers(pages: Pages, plan: Path) -> None:
    assert run(["sheets", str(plan), "--quiet"]) == 0
    page = pages.open(plan.with_name("papers.html").as_uri())
    expect(sheets(page)).to_have_attribute("aria-busy", "false")
    before = address(page)
    page.evaluate(
        "benchdragon.change({...benchdragon.plan, walk: {...benchdragon.plan.walk, end: 11}}, true)"
    )
    expect(sheets(page)).to_have_count(0)
    address(page, before)
    page.reload()
    expect(page.locator(".verdict:is(.safe, .tight)")).to_have_count(1)
    expect(sheets(page)).to_have_count(0)


@pytest.mark.parametrize("name", ["chromium", "firefox"])
def test_an_installed_browser_prints_all_papers(
    plan: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    path = {"chromium": browser_path, "firefox": firefox_path}[name]()
    if path is None:
        pytest.skip(f"no {name} here")
    monkeypatch.setattr(printing, "find_browser", lambda: path)
    line = ["sheets", str(plan), "--pdf", "out", "--only", ",".join(PAPERS), "--phones", "--quiet"]
    with spoken_in("zh"):
        assert run(line) == 0
    assert sorted(one.name for one in Path("out").iterdir()) == sorted(f"{one}.pdf" for one in PAPERS)
    benches = texts(Path("out/benches.pdf"))
    if name == "firefox" and not benches[-1]:
        benches.pop()  # it puts a white page behind, now and then
    assert len(benches) == 8
    assert "张三，电话138-0000-0001" in benches[0]
    assert "王五" in benches[1]
    codes = []
    for page in pypdfium2.PdfDocument("out/benches.pdf"):
        codes += [one.text for one in zxingcpp.read_barcodes(page.render(scale=200 / 72).to_pil())]
    assert sorted(codes) == [f"https://dragon.test/ours#bench={n}" for n in range(1, 9)]
    overview = "".join(texts(Path("out/overview.pdf")))
    assert all(one in overview for one in ("我们的舞龙", "赵六", "龙尾"))


def test_cards_are_printed_to_their_size(plan: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = browser_path()
    if path is None:
        pytest.skip("no Chromium here")
    monkeypatch.setattr(printing, "find_browser", lambda: path)
    line = ["sheets", str(plan), "--pdf", "out", "--only", "benches", "--paper", "lanyard", "--quiet"]
    assert run(line) == 0
    made = pypdfium2.PdfDocument("out/benches.pdf")
    assert len(made) == 4
    edges = [one.get_bounds() for one in made[0].get_objects()]
    sides = [
        (left, low, right, high)
        for left, low, right, high in edges
        if right - left < 2 < 200 < high - low
    ]
    wide = max(right for _left, _low, right, _high in sides) - min(left for left, *_more in sides)
    assert wide / MILLIMETRE == pytest.approx(2 * 86, abs=0.3)
    assert {round((high - low) / MILLIMETRE) for _left, low, _right, high in sides} == {124}


def test_an_interrupt_ends_the_browser_too(plan: Path) -> None:
    path = browser_path()
    if path is None:
        pytest.skip("no Chromium here")
    command = [sys.executable, "-m", "benchdragon", "sheets", str(plan), "--pdf", "out", "--quiet"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
        while not children.read_text().strip():
            assert process.poll() is None
            time.sleep(0.05)
        (child,) = children.read_text().split()
        process.send_signal(signal.SIGINT)
        assert process.stderr is not None
        said = process.stderr.read()
    assert process.returncode == 130
    assert "papers.html" in said
    assert not Path(f"/proc/{child}").exists()
    assert list(Path("out").iterdir()) == []
