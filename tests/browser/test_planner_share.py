"""How a plan is sent to others: a link that opens it, as a QR code too; from disk its file."""

import io
import re
from collections.abc import Callable
from pathlib import Path

import pytest
import zxingcpp
from PIL import Image
from playwright.sync_api import Locator, Page, expect

from tests.browser.pages import Device, Language, Pages
from tests.browser.planners import Opened, change, settled
from tests.browser.players import until
from tests.browser.test_planner import shown_plan

ADDRESS = "https://dance.example/planner.html"
WORDS = {
    "en": {
        "share": "share",
        "benches": "number of benches",
        "close": "close",
        "code": "QR code of the link",
    },
    "zh": {"share": "分享", "benches": "板凳节数", "close": "关闭"},
}
# What a phone offers, and what it is asked to send.
SENDING = """() => {
  globalThis.sent = [];
  navigator.canShare = () => true;
  navigator.share = async ({ files, ...more }) => {
    sent.push(files ? { name: files[0].name, text: await files[0].text() } : more);
  };
}"""


@pytest.fixture
def web(pages: Pages, file: Path) -> Callable[..., Page]:
    """Opens the planner under an address of the web, which nobody is asked for."""

    def open_page(where: str = "", device: Device = "desktop", language: Language = "en") -> Page:
        page = pages.open(f"{ADDRESS}{where}", device, language, served=file)
        expect(page.locator("canvas")).to_be_visible()
        return settled(page)

    return open_page


def shared(page: Page, language: Language = "en") -> Locator:
    page.get_by_role("button", name=WORDS[language]["share"], exact=True).click()
    return page.get_by_role("dialog", name=WORDS[language]["share"])


@pytest.mark.parametrize(
    ("device", "language"), [("desktop", "en"), ("phone", "zh")], ids=["desktop", "phone"]
)
def test_the_code_on_the_screen_opens_the_same_plan(
    web: Callable[..., Page], device: Device, language: Language
) -> None:
    page = web(f"#lang={language}", device, language)
    change(page, WORDS[language]["benches"], "61")
    settled(page)
    dialog = shared(page, language)
    (read,) = zxingcpp.read_barcodes(Image.open(io.BytesIO(page.screenshot())))
    assert read.text == dialog.locator("code").text_content()
    assert len(read.text) < 110
    other = web(read.text.removeprefix(ADDRESS), device, language)
    assert shown_plan(other).dragon.benches == 61
    hashes = [one.evaluate("benchdragon.verdict.found.plan_sha256") for one in (page, other)]
    assert hashes[0] == hashes[1] == shown_plan(page).sha256
    dialog.get_by_role("button", name=WORDS[language]["close"]).click()
    expect(dialog).to_have_count(0)


def test_a_link_that_is_too_long_for_a_code_says_so(web: Callable[..., Page]) -> None:
    page = web()
    page.evaluate(
        """() => {
          const points = Array.from({ length: 400 }, (_unused, n) => [n, Math.sin(n ** 2)]);
          benchdragon.plan = { ...benchdragon.plan, route: { kind: "drawn", points } };
        }"""
    )
    dialog = shared(page)
    link = dialog.locator("code").text_content() or ""
    expect(dialog).to_contain_text(f"This link has {len(link)} letters: too many for a QR code")
    assert len(link) > 1000
    expect(dialog.get_by_role("img")).to_have_count(0)


def test_a_phone_sends_the_link(web: Callable[..., Page]) -> None:
    page = web(device="phone")
    page.evaluate(SENDING)
    dialog = shared(page)
    dialog.get_by_role("button", name="send ...").click()
    link = dialog.locator("code").text_content()
    assert page.evaluate("sent") == [{"title": "Bench dragon planner", "url": link}]


@pytest.mark.parametrize("phone", [True, False], ids=["a phone", "no phone"])
def test_from_disk_the_file_is_sent_and_the_page_says_why(opened: Opened, phone: bool) -> None:
    page = opened()
    change(page, "number of benches", "61")
    settled(page)
    page.evaluate(SENDING if phone else "void (navigator.canShare = undefined)")
    dialog = shared(page)
    expect(dialog).to_contain_text("it has no web address, and no link leads others to it")
    expect(dialog.get_by_role("img")).to_have_count(0)
    tail = dialog.locator("code").text_content() or ""
    assert re.fullmatch("#plan=[-_0-9A-Za-z]+", tail)
    if phone:
        dialog.get_by_role("button", name="send the plan file").click()
        until(page, "sent.length === 1")
        (sent,) = page.evaluate("sent")
        name, text = sent["name"], sent["text"]
    else:
        with page.expect_download() as download:
            dialog.get_by_role("button", name="save the plan file").click()
        name, text = download.value.suggested_filename, download.value.path().read_text("utf-8")
    assert name.endswith("-61.dragon.toml")
    assert "benches = 61" in text
    other = page.context.new_page()
    other.goto(page.url.split("#")[0] + tail)
    settled(other)
    assert shown_plan(other).sha256 == shown_plan(page).sha256
