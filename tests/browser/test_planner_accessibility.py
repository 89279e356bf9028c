"""The planner as everybody can use it: axe finds nothing wrong."""

import pytest

from tests.browser.axe import needs_axe, violations
from tests.browser.pages import Device, Language
from tests.browser.planners import Opened, settle
from tests.browser.players import drawn

# What opens each part of the page.
PARTS = {
    "main": "0",
    "grips": "document.querySelector('.grips').classList.add('seen')",
    "lists": "document.querySelectorAll('details').forEach((one) => (one.open = true))",
    "evidence": "document.querySelectorAll('details').forEach((one) => (one.open = false));"
    " document.querySelector('.verdict').click(); document.querySelector('.evidence').open = true",
    "keys": "document.querySelector('dialog').close();"
    " document.querySelector('.tools button:last-child').click()",
    "link": "document.querySelector('dialog').close(); location.hash = '#plan=no'",
}


@needs_axe
@pytest.mark.parametrize(("device", "language"), [("desktop", "en"), ("phone", "zh")])
def test_axe_finds_nothing_wrong(opened: Opened, device: Device, language: Language) -> None:
    page = opened(device, f"#lang={language}")
    for part, show in PARTS.items():
        page.evaluate(show)
        if part == "link":
            settle(page, "link|链接")
        for colours in ("light", "dark"):
            page.emulate_media(color_scheme=colours)
            drawn(page)
            assert violations(page) == [], (part, colours)
