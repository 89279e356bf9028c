"""What the player looks like: colours, languages, and room for every control at each size."""

import re

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from benchdragon.analysis.distance import nearest_each
from tests.browser.pages import Colours, Device, Language, Pages
from tests.browser.players import (
    DESK,
    HAND,
    Scene,
    drawn,
    look_at,
    on_screen,
    opened,
    pixels,
    ready,
    state,
    time_of,
    until,
    views,
)

# What opens each part of the page.
PARTS = {
    "main": "0",
    ".views": "document.querySelector('.views').open = true",
    ".events": "[['.views', false], ['.events', true]]"
    ".forEach(([name, open]) => { document.querySelector(name).open = open; })",
    ".card": "document.querySelector('.events').open = false; benchdragon.choose(8)",
    "dialog": "document.querySelector('.tools button:last-child').click()",
}
# All that can be operated, in one list: what it is and whether it lies where it can be hit.
HIT = """(root) => [...document.querySelectorAll(root + " :is(button, select, input, summary)")]
  .filter((one) => one.checkVisibility() && !one.matches(".mark"))
  .map((one) => {
    one.closest(".views, .card, .events ol")?.scrollTo(0, 0);
    const scrolls = one.closest(".views[open], .card, .events ol, dialog");
    if (scrolls) one.scrollIntoView({ block: "nearest" });
    const box = one.getBoundingClientRect();
    const hit = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
    const [right, bottom] = [innerWidth + 0.5, innerHeight + 0.5];
    const whole = box.left >= 0 && box.top >= 0 && box.right <= right && box.bottom <= bottom;
    const cut = one.scrollWidth > one.clientWidth + 1 && !one.matches("select, input");
    const label = one.closest("label");
    const name = one.getAttribute("aria-label") || one.textContent || label?.textContent;
    return { name, hit: one.contains(hit) || Boolean(label?.contains(hit)), whole, cut,
      size: [box.width, box.height] };
  })"""


IDEOGRAPH = re.compile(r"[\u4e00-\u9fff]")


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_everything_that_can_be_operated_has_a_name(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look, where="#t=20&bench=9")
    views(page)
    page.locator("details.events summary").click()
    client = page.context.new_cdp_session(page)
    nodes = client.send("Accessibility.getFullAXTree")["nodes"]
    operated = {
        "button",
        "slider",
        "combobox",
        "checkbox",
        "spinbutton",
        "DisclosureTriangle",
        "image",
        "group",
        "complementary",
    }
    found: dict[str, list[str]] = {}
    for node in nodes:
        role = node.get("role", {}).get("value")
        if role in operated and not node.get("ignored"):
            found.setdefault(role, []).append(node.get("name", {}).get("value", ""))
    assert operated - {"group"} <= set(found)
    assert all(name.strip() for role in operated - {"group"} for name in found.get(role, []))
    assert len(found["button"]) >= 20
    expect(page.locator("canvas")).to_have_attribute("aria-label", re.compile(r"t = 20\.0 s"))


# What a screen reader may read out by itself: live regions, and the value of what has the focus.
LISTEN = """() => {
  globalThis.heard = [];
  const live = "output, [aria-live]:not([aria-live=off]), [role=status], [role=alert], [role=timer]";
  const slider = document.querySelector(".axis input");
  let value = slider.value;
  const listen = () => {
    if (slider.value !== value) heard.push(`value ${slider.value}`);
    value = slider.value;
    if (benchdragon.playing) requestAnimationFrame(listen);
  };
  benchdragon.face.playButton.addEventListener("click", () => requestAnimationFrame(listen));
  new MutationObserver((changes) => changes.forEach(({ type, target, attributeName }) => {
    const element = target instanceof Element ? target : target.parentElement;
    if (type === "attributes") heard.push(element.getAttribute(attributeName));
    else if (element.closest(live)) heard.push(element.closest(live).textContent);
  })).observe(document.body, { subtree: true, childList: true, characterData: true,
    attributes: true, attributeFilter: ["aria-valuetext", "aria-label", "aria-valuenow"] });
}"""


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_screen_readers_hear_events_and_rest_and_nothing_between(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    (event,) = [one for one in turn.dance.occasions if one.kind == "fastest"]
    joint = max(one.time for one in turn.dance.occasions if one.kind == "joint")
    assert event.time - 1.2 < joint < event.time
    page = opened(pages, turn, look, where=f"#t={event.time - 1.2:.3f}")
    until(page, "document.querySelector('.spoken').textContent !== ''")
    page.evaluate("benchdragon.speed = 2")
    page.evaluate(LISTEN)
    page.locator("button.play").click()
    until(page, f"benchdragon.time > {event.time + 0.3}")
    said = f"t = {event.time:.1f} s. {getattr(event.text, look[1])}"
    # The first is the button's own name.
    assert page.evaluate("heard") == [{"en": "pause", "zh": "暂停"}[look[1]], said]
    page.locator("button.play").click()
    until(
        page,
        "document.querySelector('.spoken').textContent.startsWith("
        "`t = ${benchdragon.time.toFixed(1)} s`)",
    )
    spoken = page.locator(".spoken").inner_text()
    rest = page.evaluate("heard.slice(2).filter((text) => !text.startsWith('value '))")
    picture = str(page.locator("canvas").get_attribute("aria-label"))
    play = {"en": "play", "zh": "播放"}[look[1]]
    assert sorted(rest) == sorted([play, f"{time_of(page):.1f} s", spoken, picture])


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize(
    ("width", "height"), [(320, 568), (390, 844), (768, 1024), (1366, 768), (740, 360)]
)
def test_nothing_overflows_and_every_control_can_be_hit(
    pages: Pages, turn: Scene, language: Language, width: int, height: int
) -> None:
    page = opened(pages, turn, ("phone" if width < 800 else "desktop", language, "light"))
    page.set_viewport_size({"width": width, "height": height})
    for part, show in PARTS.items():
        page.evaluate(show)
        drawn(page)
        wide = page.evaluate(
            "[document.scrollingElement.scrollWidth, document.scrollingElement.scrollHeight]"
        )
        assert wide[0] <= width, part
        assert wide[1] <= height, part
        found = page.evaluate(HIT, part)
        assert len(found) >= {"main": 14, "dialog": 1}.get(part, 4), part
        wrong = [one for one in found if not (one["hit"] and one["whole"]) or one["cut"]]
        assert wrong == [], part
        small = [one for one in found if min(one["size"]) < 20]
        assert small == [], part


def test_a_face_turned_with_the_phone_keeps_the_dragon_in_sight(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn, HAND)
    for width, height in ((844, 390), (390, 844)):
        page.set_viewport_size({"width": width, "height": height})
        until(page, f"benchdragon.camera.width === {width}")
        inside = page.evaluate(
            """[...benchdragon.stand.x].every((x, i) => { const { camera, stand } = benchdragon;
              const [px, py] = camera.toScreen(x, stand.y[i]);
              return px > 0 && py > 0 && px < camera.width && py < camera.height; })"""
        )
        assert inside
    scale = state(page, "camera.scale")
    page.keyboard.press("+")
    page.set_viewport_size({"width": 844, "height": 390})
    until(page, "benchdragon.camera.width === 844")
    assert state(page, "camera.scale") == pytest.approx(1.4 * scale)


@pytest.mark.parametrize("size", [(390, 844), (360, 640), (844, 390)])
def test_a_benchs_card_leaves_the_picture_its_room_on_a_phone(
    pages: Pages, turn: Scene, size: tuple[int, int]
) -> None:
    page = opened(pages, turn, HAND)
    page.set_viewport_size({"width": size[0], "height": size[1]})
    until(page, f"benchdragon.camera.width === {size[0]}")
    page.evaluate("benchdragon.choose(8)")
    until(page, "document.querySelector('.card').checkVisibility()")
    stage, card = (
        page.locator(name).evaluate("(one) => one.getBoundingClientRect().toJSON()")
        for name in (".stage", ".card")
    )
    beside = card["left"] >= stage["right"] - 1
    assert beside == (size[0] > size[1])
    assert beside or card["top"] >= stage["bottom"] - 1
    assert stage["height"] >= 0.28 * size[1]
    assert not page.locator(".summary").is_visible()
    page.evaluate("benchdragon.choose(-1)")
    expect(page.locator(".summary")).to_be_visible()


def legend_colour(page: Page, value: float) -> list[float]:
    """What the legend says a value looks like: by its ends, and the colours between them."""
    ends = [
        text.replace("\u2212", "-") for text in page.locator(".legend .ends span").all_inner_texts()
    ]
    low, high = (float(re.findall(r"-?[\d.]+", text)[0]) for text in ends)
    strip = page.locator(".strip").evaluate("(one) => getComputedStyle(one).backgroundImage")
    stops = np.array(
        [[float(part) for part in found] for found in re.findall(r"rgb\((\d+), (\d+), (\d+)\)", strip)]
    )
    share = min(max((value - low) / (high - low), 0.0), 1.0) * (len(stops) - 1)
    return [float(np.interp(share, range(len(stops)), stops[:, n])) for n in range(3)]


@pytest.mark.parametrize("colours", ["light", "dark"])
def test_colours_are_those_of_the_legend(pages: Pages, turn: Scene, colours: Colours) -> None:
    page = opened(pages, turn, ("desktop", "en", colours))
    time, bench = 18.0, 5
    page.evaluate(f"benchdragon.jump({time})")
    motion = turn.walk.motion([time])
    nearest = nearest_each(motion, 1.0)[0][0]
    values = {
        "speed": motion.speed[0],
        "clearance": np.minimum(nearest, 1.0),
        "acceleration": motion.acceleration[0],
    }
    choice = views(page).get_by_label("colour by")
    assert not page.locator(".legend").is_visible()
    seen = set()
    for kind, value in values.items():
        choice.select_option(kind)
        for number in (bench, 12):
            look_at(page, number, 150.0)
            (found,) = pixels(page, [on_screen(page, number, 0.45, 0.1)])
            assert found == pytest.approx(legend_colour(page, float(value[number - 1])), abs=26.0), kind
            seen.add(tuple(found))
        assert page.locator(".legend > span").first.inner_text()
    assert len(seen) > 3
    choice.select_option("plain")
    drawn(page)
    assert not page.locator(".legend").is_visible()


@pytest.mark.parametrize("look", [HAND, DESK, ("desktop", "en", "dark")], ids="-".join)
def test_benches_that_touch_are_hatched(
    pages: Pages, contact: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, contact, look)
    (first,) = [one for one in contact.dance.occasions if one.kind == "contact"]
    for time, touches in ((first.time - 0.5, False), (first.time + 0.2, True)):
        page.evaluate(f"benchdragon.jump({time})")
        for bench in (*first.benches, 5) if touches else first.benches[:1]:
            look_at(page, bench, 150.0)
            # Closer than stripes are wide, wherever these lie among the dots of the screen.
            ends = [on_screen(page, bench, along, -0.1) for along in (-0.28, 0.28)]
            line = np.linspace(ends[0], ends[1], 161)
            found = np.array(pixels(page, line.tolist()))
            red = (np.abs(found - [230, 0, 76]).max(axis=1) < 40).sum()
            black = (found.max(axis=1) < 60).sum()
            hatched = bool(red > 3 and black > 3)
            assert hatched is (touches and bench != 5)
    text = page.locator(".tight").inner_text() or page.locator("canvas").get_attribute("aria-label")
    assert {"en": "benches 1 and", "zh": "第 1 节"}[look[1]] in str(text)


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_the_language_changes_and_nothing_else(
    pages: Pages, turn: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, turn, look, where="#t=12.5&bench=4")
    page.evaluate("benchdragon.paintBy('speed')")
    for language in ("en", "zh", "en"):
        if page.locator("html").get_attribute("lang") != {"en": "en", "zh": "zh-CN"}[language]:
            page.locator(".tools button").first.click()
        drawn(page)
        assert page.locator("h1").inner_text() == getattr(turn.dance.title, language)
        assert (time_of(page), state(page, "chosen"), state(page, "kind")) == (12.5, 3, "speed")
        said = page.evaluate(
            """[...document.querySelectorAll("main *")].flatMap((one) =>
              [one.getAttribute("aria-label"), one.title,
                ...[...one.childNodes].filter((node) => node.nodeType === 3).map((node) => node.data)])
              .filter((text) => text && /[a-z]{3}|[\u4e00-\u9fff]/.test(text))"""
        )
        chinese = [text for text in said if IDEOGRAPH.search(text)]
        assert len(said) > 40
        if language == "en":
            assert chinese == ["中文"]
        else:
            assert set(said) - set(chinese) <= {"English", "main"}


def test_light_and_dark_by_the_system_and_by_hand(pages: Pages, turn: Scene) -> None:
    page = opened(pages, turn)
    corner = [(5.0, 80.0)]
    bright = {"light": [255, 255, 255], "dark": [14, 17, 22]}
    for colours in ("light", "dark"):
        page.emulate_media(color_scheme=colours)
        drawn(page)
        assert pixels(page, corner) == [bright[colours]]
    button = page.get_by_role("button", name="light or dark")
    for colours in ("light", "dark"):
        button.click()
        drawn(page)
        assert page.locator("html").get_attribute("data-theme") == colours
        assert pixels(page, corner) == [bright[colours]]
    page.emulate_media(color_scheme="light")
    drawn(page)
    assert pixels(page, corner) == [bright["dark"]]


def language_of(page: Page) -> str | None:
    """The language that a page says it is in."""
    return page.locator("html").get_attribute("lang")


def test_language_and_theme_are_found_again(pages: Pages, turn: Scene, contact: Scene) -> None:
    page = opened(pages, turn)
    page.get_by_role("button", name="中文").click()
    page.get_by_role("button", name="浅色或深色").click()
    page.get_by_role("button", name="浅色或深色").click()
    assert page.locator("html").get_attribute("data-theme") == "dark"
    for scene in (turn, contact):  # reloaded, and another file
        page.goto(scene.files["en"])
        ready(page)
        assert language_of(page) == "zh-CN"
        assert page.locator("html").get_attribute("data-theme") == "dark"
        assert "lang" not in page.url
    # What the address says goes first, and keeps up.
    page.goto("about:blank")
    page.goto(f"{turn.files['zh']}#lang=en&theme=light&t=10")
    ready(page)
    assert (language_of(page), time_of(page)) == ("en", 10.0)
    assert page.locator("html").get_attribute("data-theme") == "light"
    page.get_by_role("button", name="中文").click()
    until(page, "location.hash === '#lang=zh&theme=light&t=10'")


BLOCKED = """Object.defineProperty(globalThis, "localStorage", {
  get() { throw new DOMException("The operation is insecure.", "SecurityError"); },
});"""
FULL = """Storage.prototype.setItem = () => {
  throw new DOMException("no room", "QuotaExceededError");
};"""


@pytest.mark.parametrize("block", [BLOCKED, FULL], ids=["blocked", "full"])
def test_language_and_theme_stand_in_the_address_where_nothing_is_stored(
    pages: Pages, turn: Scene, block: str
) -> None:
    page = pages.open("about:blank")
    page.add_init_script(block)
    page.goto(turn.files["zh"])
    ready(page)
    page.get_by_role("button", name="English").click()
    page.get_by_role("button", name="light or dark").click()
    page.keyboard.press("ArrowRight")
    until(page, f"location.hash.includes('t={turn.start + 1:g}')")
    assert {"lang=en", "theme=light"} < {*page.url.partition("#")[2].split("&")}
    page.reload()
    ready(page)
    assert language_of(page) == "en"
    assert time_of(page) == turn.start + 1
    page.emulate_media(color_scheme="dark")
    drawn(page)
    assert page.locator("html").get_attribute("data-theme") == "light"


@pytest.mark.parametrize("where", ["#lang=xx&theme=plaid", "#lang=&theme="])
def test_choices_that_are_none_leave_the_file_as_it_is(pages: Pages, turn: Scene, where: str) -> None:
    page = opened(pages, turn, ("desktop", "zh", "dark"), where=where)
    assert language_of(page) == "zh-CN"
    assert page.locator("html").get_attribute("data-theme") == "dark"
