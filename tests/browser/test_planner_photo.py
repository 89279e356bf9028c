"""A photograph of the square below the dance: to scale, turned, kept on the device alone."""

from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Page, expect

from tests.browser.planners import change, number, settled
from tests.browser.players import drawn, pixels, until
from tests.browser.test_planner import shown_plan
from tests.browser.test_planner_grips import steps
from tests.browser.test_planner_square import SQUARE, Opened, opened, tap

__all__ = ["opened"]
# What a browser does that keeps nothing: it has no store, or refuses it.
REFUSING = {
    "none": "Object.defineProperty(globalThis, 'indexedDB', { value: undefined })",
    "refused": """IDBFactory.prototype.open = () => {
      throw new DOMException("", "SecurityError");
    };""",
    "full": """IDBObjectStore.prototype.put = () => {
      throw new DOMException("", "QuotaExceededError");
    };""",
}
STAYS = "It stays on this device"
GONE = "This browser does not keep it"


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    """A photograph, red to the left and green to the right."""
    image = Image.new("RGB", (3200, 1600), "#ff0000")
    image.paste("#00ff00", (1600, 0, 3200, 1600))
    image.save(tmp_path / "square.png")
    return tmp_path / "square.png"


def choose(page: Page, path: Path) -> None:
    """Take a file for a photograph."""
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="a photograph below").click()
    chooser.value.set_files(path)


def laid(page: Page, picture: Path, *, strong: str = "1") -> None:
    """Have a photograph of 20 m by 10 m about the middle of the square."""
    choose(page, picture)
    until(page, "benchdragon.photo.picture !== null")
    page.evaluate("Object.assign(benchdragon.photo, { middle: [0, 0], scale: 20 / 1600 })")
    page.get_by_role("slider", name="how strong it is").fill(strong)


def colours(page: Page, *places: tuple[float, float]) -> list[str]:
    """What the picture shows at places of the ground."""
    drawn(page)
    box = page.locator("canvas").bounding_box()
    assert box is not None
    at = page.evaluate("(at) => at.map((p) => benchdragon.player.camera.toScreen(...p))", places)
    dots = pixels(page, [(box["x"] + x, box["y"] + y) for x, y in at])
    return ["red" if r > g + 50 else "green" if g > r + 50 else "none" for r, g, _b in dots]


def stored(page: Page) -> int:
    """How many photographs the device keeps, once all is done that is under way."""
    return page.evaluate(  # type: ignore[no-any-return]
        """async () => {
          await benchdragon.photo.keeping;
          const base = await new Promise((done) => {
            const opening = indexedDB.open("benchdragon", 1);
            opening.onsuccess = () => done(opening.result);
          });
          const counting = base.transaction("photographs").objectStore("photographs").count();
          const count = await new Promise((done) => (counting.onsuccess = () => done(counting.result)));
          base.close();
          return count;
        }"""
    )


def reloaded(page: Page) -> Page:
    """The page, opened anew."""
    page.evaluate("benchdragon.photo.keeping.then(() => {})")
    page.reload()
    return settled(page)


def test_a_photograph_lies_below_to_scale_and_stays_in_the_page(opened: Opened, picture: Path) -> None:
    page = opened(more=SQUARE)
    before, url = shown_plan(page).sha256, page.url
    choose(page, Path(__file__))
    expect(page.get_by_text("cannot read test_planner_photo.py")).to_be_visible()
    choose(page, picture)
    until(page, "benchdragon.photo.picture !== null")
    expect(page.get_by_text("cannot read")).to_be_hidden()
    assert page.evaluate("benchdragon.photo.picture.width") == 1600
    page.evaluate("Object.assign(benchdragon.photo, { middle: [0, 0], scale: 10 / 1600 })")
    # The photograph is 10 m wide now, until two points 4 m apart are said to be 8 m apart.
    page.get_by_role("slider", name="how strong it is").fill("1")
    assert colours(page, (-4, 1.2), (4, 1.2), (-8, 1.2), (8, 1.2)) == ["red", "green", "none", "none"]
    page.get_by_role("button", name="two points and their distance").click()
    tap(page, -2, -1)
    tap(page, 2, -1)
    expect(number(page, "distance between the two points")).to_be_focused()
    change(page, "distance between the two points", "8米")
    assert page.evaluate("benchdragon.photo.scale") == pytest.approx(20 / 1600, rel=0.03)
    assert colours(page, (-8, 1.2), (8, 1.2), (-13, 0), (13, 0)) == ["red", "green", "none", "none"]
    page.get_by_role("button", name="move it").click()
    tap(page, 0, 2)
    tap(page, -3, 2)
    assert colours(page, (-12.5, 0), (-1.2, 1.2), (8, 1.2)) == ["red", "green", "none"]
    assert shown_plan(page).sha256 == before
    assert page.url.split("&")[0] == url.split("&")[0]
    assert steps(page) == 0
    change(page, "length of a bench", "2.1")
    settled(page)
    assert colours(page, (-12.5, 0), (-1.2, 1.2)) == ["red", "green"]
    page.get_by_role("button", name="take it away").click()
    assert colours(page, (-12.5, 0), (-1.2, 1.2)) == ["none", "none"]
    expect(page.get_by_role("button", name="take it away")).to_be_hidden()


def test_a_photograph_is_turned_about_its_middle_with_its_two_points(
    opened: Opened, picture: Path
) -> None:
    page = opened(more=SQUARE)
    laid(page, picture)
    page.evaluate("benchdragon.photo.points = [[-4, 0], [4, 0]]")
    change(page, "turned to the left", "90")
    assert colours(page, (1.2, -8), (1.2, 8), (-8, 1.2), (8, 1.2)) == ["red", "green", "none", "none"]
    points = [end for point in page.evaluate("benchdragon.photo.points") for end in point]
    assert points == pytest.approx([0, -4, 0, 4])
    change(page, "turned to the left", "30")
    change(page, "turned to the left", "0")
    assert colours(page, (-8, 1.2), (8, 1.2), (1.2, -8)) == ["red", "green", "none"]


def test_a_photograph_is_there_again_with_its_plan_and_with_no_other(
    opened: Opened, picture: Path
) -> None:
    page = opened(more=SQUARE)
    laid(page, picture)
    change(page, "turned to the left", "90")
    expect(page.get_by_text(STAYS)).to_be_visible()
    assert stored(page) == 1
    page = reloaded(page)
    until(page, "benchdragon.photo.picture !== null")
    assert colours(page, (1.2, -8), (1.2, 8), (-8, 1.2)) == ["red", "green", "none"]
    assert page.evaluate("benchdragon.photo.turned") == 90
    # It stays as the plan changes, and comes with each plan that it lay under.
    change(page, "length of a bench", "2.1")
    settled(page)
    assert colours(page, (1.2, -8), (1.2, 8)) == ["red", "green"]
    page = reloaded(page)
    until(page, "benchdragon.photo.picture !== null")
    assert stored(page) == 1
    # A ready-made dance is on no such square.
    page.get_by_role("combobox", name="begin with").select_option("turn")
    settled(page)
    assert page.evaluate("benchdragon.photo.keeping.then(() => benchdragon.photo.picture)") is None
    page.get_by_role("button", name="undo", exact=True).click()
    settled(page)
    until(page, "benchdragon.photo.picture !== null")
    assert "photo" not in page.evaluate("JSON.stringify(benchdragon.plan)")


def test_a_photograph_that_is_taken_away_is_kept_no_more(opened: Opened, picture: Path) -> None:
    page = opened(more=SQUARE)
    laid(page, picture)
    choose(page, picture)  # another in its place
    until(page, "benchdragon.photo.turned === 0 && benchdragon.photo.scale !== 20 / 1600")
    assert stored(page) == 1
    page.get_by_role("button", name="take it away").click()
    assert stored(page) == 0
    page = reloaded(page)
    assert page.evaluate("benchdragon.photo.keeping.then(() => benchdragon.photo.picture)") is None


@pytest.mark.parametrize("how", list(REFUSING))
def test_a_browser_that_keeps_no_photograph_says_so_and_shows_it(
    opened: Opened, picture: Path, how: str
) -> None:
    page = opened(more=SQUARE)
    page.evaluate(f"() => {{ {REFUSING[how]} }}")
    laid(page, picture)
    expect(page.get_by_text(GONE)).to_be_visible()
    assert colours(page, (-8, 1.2), (8, 1.2)) == ["red", "green"]
