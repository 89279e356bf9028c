"""A browser for these tests, too."""

from tests.browser.conftest import browser, pages

__all__ = ["browser", "pages"]
