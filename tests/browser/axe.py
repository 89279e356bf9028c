"""What axe-core finds wrong in a page."""

from pathlib import Path

import pytest
from playwright.sync_api import Page

AXE = Path(__file__).parents[2] / "node_modules" / "axe-core" / "axe.min.js"
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
FOUND = """(rules) => axe.run(document, { runOnly: rules }).then(({ passes, violations }) => ({
  passes: passes.length,
  violations: violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`)),
}))"""

needs_axe = pytest.mark.skipif(not AXE.exists(), reason="axe-core is not here: npm ci")


def violations(page: Page) -> list[str]:
    """What axe finds wrong in a page as it is."""
    if not page.evaluate("typeof axe === 'object'"):
        page.evaluate(f"{AXE.read_text('utf-8')}\n0;")
    found = page.evaluate(FOUND, RULES)
    assert found["passes"] > 10
    return found["violations"]  # type: ignore[no-any-return]
