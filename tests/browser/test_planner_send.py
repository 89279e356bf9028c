"""A dance is sent as a page that walks, as a picture, as letters, and opened by pasting it."""

import io
import re
from pathlib import Path

import pytest
import zxingcpp
from PIL import Image
from playwright.sync_api import Page, expect

from benchdragon.plans.schema import read_plan
from tests.browser.links import letters
from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import Opened, change, settled
from tests.browser.players import until
from tests.browser.test_planner import shown_plan
from tests.browser.test_planner_share import ADDRESS, SENDING, shared

WORDS = {
    "en": {"send": "send this dance", "benches": "number of benches"},
    "zh": {"send": "发给大家", "benches": "板凳节数"},
}
# A title that is no mark-up, but looks like it.
TITLE = 'the <b>old</b> </script> "well"'
PASTE = """(text) => {
  const clipboardData = new DataTransfer();
  clipboardData.setData("text/plain", text);
  document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
}"""


def sent(page: Page, device: Device, language: Language) -> tuple[str, str]:
    """Send the dance; the name of the file, and its text."""
    button = page.get_by_role("button", name=WORDS[language]["send"], exact=True)
    if device == "phone":
        page.evaluate(SENDING)
        button.click()
        until(page, "sent.length === 1")
        (file,) = page.evaluate("sent")
        return file["name"], file["text"]
    with page.expect_download() as download:
        button.click()
    return download.value.suggested_filename, download.value.path().read_text("utf-8")


@pytest.mark.parametrize(("device", "language"), [("phone", "zh"), ("desktop", "en")])
def test_a_dance_that_is_sent_walks_wherever_its_file_is_opened(
    pages: Pages, file: Path, tmp_path: Path, device: Device, language: Language
) -> None:
    page = settled(pages.open(f"{file.as_uri()}#lang={language}", device, language))
    page.evaluate(
        """(title) => {
          const { plan } = benchdragon;
          benchdragon.change({ ...plan, meta: { ...plan.meta, title, title_zh: title } }, true);
        }""",
        TITLE,
    )
    change(page, WORDS[language]["benches"], "61")
    settled(page)
    page.evaluate("document.querySelector('#papers').textContent = '[\"张三\"]'")  # as papers hold them
    name, text = sent(page, device, language)
    assert "张三" not in text
    assert re.fullmatch(r"[^<>/]+-61\.html", name)
    assert len(text) < 1.2 * file.stat().st_size
    path = tmp_path / name
    path.write_text(text, "utf-8")
    other = settled(pages.open(path.as_uri(), device, language))
    assert shown_plan(other).sha256 == shown_plan(page).sha256
    expect(other.locator("html")).to_have_attribute("lang", "zh-CN" if language == "zh" else "en")
    start = other.evaluate("benchdragon.player.scene.start")
    until(other, f"benchdragon.player.playing && benchdragon.player.time > {start}")
    # It is a page as good as the first: it can be sent on, and opened where a plan is.
    assert sent(other, device, language)[0] == name
    change(page, WORDS[language]["benches"], "9")
    page.locator(".panel .plan-file").set_input_files(path)
    until(page, "benchdragon.plan.dragon.benches === 61")


def test_a_page_that_was_sent_shows_a_picture_before_its_engine_is_there(
    opened: Opened, pages: Pages, tmp_path: Path
) -> None:
    page = opened()
    path = tmp_path / "sent.html"
    path.write_text(sent(page, "desktop", "en")[1], "utf-8")
    plain = path.read_text("utf-8").replace('type="module"', 'type="text/plain"')
    path.write_text(plain, "utf-8")
    still = pages.open(path.as_uri(), "phone")
    look = still.get_by_role("img", name="Coiling in to the disc")
    expect(look).to_be_visible()
    assert look.evaluate("(one) => one.naturalWidth") > 300
    expect(still.locator(".waiting")).to_have_count(2)
    assert still.evaluate("document.body.children[0].children.length") == 3


def test_a_plan_is_opened_by_pasting_it_anywhere(opened: Opened) -> None:
    page = opened("phone")
    plans = [read_plan("turn", [f"dragon.benches={n}"]) for n in (7, 8, 9)]
    texts = [
        f"tonight at eight: {ADDRESS}#t=3&plan={letters(plans[0])} - come!",
        f"\n{letters(plans[1])}\n",
        '# the plan\nschema = 1\nbase = "turn"\n[dragon]\nbenches = 9\n'
        f'[people]\naddress = "{ADDRESS}#plan={letters(plans[0])[:99]}"\n',
    ]
    for text, plan in zip(texts, plans, strict=True):
        page.evaluate(PASTE, text)
        until(page, f"benchdragon.plan.dragon.benches === {plan.value('dragon.benches')}")
    before = page.evaluate("JSON.stringify(benchdragon.plan)")
    told = page.locator(".told.none")
    for text, said in (
        ("see you tonight", "There is no plan in this: paste its link"),
        (f"#plan={letters(plans[0])[:-9]}", "The plan in this link cannot be read."),
        ("schema = 1\n[dragon]\nbenches = -1\n", "dragon.benches: expected at least 1"),
    ):
        page.evaluate(PASTE, text)
        expect(told).to_contain_text(said)
        page.keyboard.press("Escape")
        expect(told).to_have_count(0)
    assert page.evaluate("JSON.stringify(benchdragon.plan)") == before


def test_what_is_pasted_into_a_box_is_that_boxs(opened: Opened) -> None:
    page = opened()
    page.evaluate(
        """() => {
          const clipboardData = new DataTransfer();
          clipboardData.setData("text/plain", "not a plan");
          const box = document.querySelector(".panel input[type=text]");
          box.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
        }"""
    )
    page.evaluate("() => new Promise(requestAnimationFrame)")
    expect(page.locator(".told.none")).to_have_count(0)


@pytest.mark.parametrize("web", [True, False], ids=["on the web", "from disk"])
def test_a_picture_for_chats_has_the_title_and_a_code_that_opens_the_dance(
    pages: Pages, file: Path, web: bool
) -> None:
    where = ADDRESS if web else file.as_uri()
    page = settled(pages.open(where, served=file if web else None))
    change(page, "number of benches", "31")
    settled(page)
    dialog = shared(page)
    link = dialog.locator("code").text_content() or ""
    with page.expect_download() as download:
        dialog.get_by_role("button", name="save a picture with a code").click()
    assert download.value.suggested_filename == "Coiling-in-to-the-disc-31.png"
    picture = Image.open(io.BytesIO(download.value.path().read_bytes()))
    (read,) = zxingcpp.read_barcodes(picture)
    assert read.text == link
    assert link.startswith(f"{ADDRESS}#plan=" if web else "#plan=")
    # A chat shows it a third as large, and phones read it there.
    (small,) = zxingcpp.read_barcodes(picture.resize((picture.width // 2, picture.height // 2)))
    assert small.text == link
    bands = [picture.convert("L").crop((0, top, picture.width, top + 40)) for top in (60, 500)]
    assert all(min(band.tobytes()) < 128 for band in bands)  # title, dance


def test_no_kind_of_file_is_greyed_out(opened: Opened) -> None:
    page = opened("phone")
    kinds = page.locator("input[type=file]").evaluate_all("(all) => all.map((one) => one.accept)")
    assert set(kinds) <= {"", "image/*"}
    assert kinds.count("") == 1
