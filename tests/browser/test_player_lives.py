"""Where the player lives: in notebooks, old browsers, spoilt files, without scripts."""

from pathlib import Path

import pytest

from benchdragon.player.page import player_page, show
from tests.browser.pages import Language, Pages
from tests.browser.players import Scene, until


def test_a_notebook_shows_the_player_in_its_sandbox(pages: Pages, turn: Scene, tmp_path: Path) -> None:
    notebook = tmp_path / "notebook.html"
    shown = show(turn.walk.motion([3.0, 9.0])).html
    head = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><p>Out [1]</p>'
    notebook.write_text(f"{head}{shown}", "utf-8")
    page = pages.open(notebook.as_uri())
    inside = page.frame_locator("iframe")
    inside.get_by_role("button", name="play", exact=True).click()
    inside.get_by_role("button", name="pause", exact=True).click()
    clock = inside.locator(".clock")
    assert 3.0 <= float(clock.inner_text().split()[2]) <= 9.0
    inside.get_by_role("button", name="keys").click()
    dialog = inside.get_by_role("dialog")
    assert dialog.is_visible()
    dialog.get_by_role("button").click()
    dialog.wait_for(state="detached")
    inside.locator(".tools button").first.click()
    assert inside.get_by_role("button", name="播放", exact=True).is_visible()
    assert inside.locator("footer").inner_text().endswith(wire_version(turn))


def wire_version(scene: Scene) -> str:
    """Name and version of what wrote the page."""
    return f"benchdragon {scene.dance.version}"


def test_an_old_browser_is_told_so(pages: Pages, turn: Scene, tmp_path: Path) -> None:
    path = tmp_path / "old.html"
    page = player_page(turn.dance, "zh")
    path.write_text(
        page.replace("<head>", "<head><script>delete globalThis.DecompressionStream</script>"), "utf-8"
    )
    assert "2023" in pages.open(path.as_uri()).locator("main").inner_text()


@pytest.mark.parametrize(("language", "said"), [("en", "damaged"), ("zh", "损坏")])
def test_a_spoilt_file_is_told_of(
    pages: Pages, turn: Scene, tmp_path: Path, language: Language, said: str
) -> None:
    path = tmp_path / "spoilt.html"
    frames = turn.dance.frames.model_copy(update={"packed": turn.dance.frames.packed[:-800]})
    path.write_text(player_page(turn.dance.model_copy(update={"frames": frames}), language), "utf-8")
    page = pages.open(path.as_uri())
    until(page, "!document.querySelector('.waiting')")
    assert said in page.locator("main").inner_text()


def test_a_page_whose_script_does_not_run_says_what_to_do(
    pages: Pages, turn: Scene, tmp_path: Path
) -> None:
    path = tmp_path / "cut.html"
    path.write_text(player_page(turn.dance, "en").split('<script type="module">')[0], "utf-8")
    page = pages.open(path.as_uri())
    page.get_by_text("open this file in a browser").wait_for()
    page.get_by_text("请用浏览器打开").wait_for()
