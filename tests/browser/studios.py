"""The studio as tests open it in a browser."""

import re
from collections.abc import Callable

from playwright.sync_api import Locator, Page, expect

Opened = Callable[..., Page]


def verdict(page: Page) -> Locator:
    return page.locator(".verdict")


def number(page: Page, name: str) -> Locator:
    return page.get_by_role("spinbutton", name=name, exact=True)


def change(page: Page, name: str, value: str) -> None:
    """Give a size of the plan another value."""
    number(page, name).fill(value)
    number(page, name).press("Enter")


def settle(page: Page, pattern: str) -> None:
    """Wait for a verdict that reads so."""
    expect(verdict(page)).to_have_text(re.compile(pattern))


def settled(page: Page) -> Page:
    """The page, once it shows verdict, limit and dance of its plan."""
    expect(page.locator("#studio")).to_have_attribute("aria-busy", "false")
    expect(page.locator("[data-stale]")).to_have_count(0)
    expect(page.locator(".verdict:is(.safe, .unsafe)")).to_have_count(1)
    return page
