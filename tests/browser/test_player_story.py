"""The guided story: why a dance ends, or where it is tightest, in half a minute."""

from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from benchdragon.analysis.check import check
from tests.browser.pages import Colours, Device, Language, Pages
from tests.browser.players import (
    DESK,
    HAND,
    LOOKS,
    Scene,
    drawn,
    opened,
    seconds,
    state,
    time_of,
    until,
)
from tests.browser.test_player_labels import APART, written

NAMES = {
    "contact": {"en": "Why it ends here", "zh": "为什么到此为止"},
    "turn": {"en": "The tightest moment", "zh": "最紧的时刻"},
}
MET = {
    "obstacle": {"en": "Where it touches an obstacle", "zh": "哪里碰到障碍物"},
    "venue": {"en": "Where it leaves the venue", "zh": "哪里越出场地"},
}
MEETS = "camera, face: { story: { met } }"
# The story's place, and what it tells of the dance.
TOLD = """() => {
  const { face, time, camera, ringed } = benchdragon;
  const now = [...document.querySelectorAll(".captions p")]
    .filter((one) => one.checkVisibility({ visibilityProperty: true }));
  return { at: face.story.at, time, scale: camera.scale, texts: now.map((one) => one.textContent),
    pair: ringed && [ringed.i + 1, ringed.j + 1], spoken: face.spoken.textContent };
}"""
# Whether where the pair is nearest is on the canvas, and nothing of the page over it.
SEEN = """() => {
  const { camera, ringed } = benchdragon;
  const box = document.querySelector("canvas").getBoundingClientRect();
  return [ringed.from, ringed.to].every((point) => {
    const [x, y] = camera.toScreen(...point);
    return document.elementFromPoint(box.x + x, box.y + y)?.tagName === "CANVAS";
  });
}"""
# Story time without waiting for it; a step so long, and then held.
PASS = "(seconds) => { for (let n = 0; n < 20 * seconds; n++) benchdragon.face.story.turn(0.05); }"
STEP = f"""([n, seconds]) => {{
  const {{ story }} = benchdragon.face;
  story.go(n);
  ({PASS})(seconds);
  story.pause(true);
}}"""


def told(page: Page, look: tuple[Device, Language, Colours], name: str) -> None:
    """Begin the story by its button, and hold it."""
    page.get_by_role("button", name=NAMES[name][look[1]]).click()
    page.keyboard.press("Space") if look[0] == "desktop" else None
    page.evaluate("benchdragon.face.story.pause(true)")


def covered(page: Page) -> list[str]:
    """Words on the canvas that lie on the pair they tell of."""
    labels = [one for one in written(page) if "(" in one["text"]]
    assert len(labels) == 1
    boxes = [(one["text"], [one["x"], one["y"], one["half"] + 6.0, 11.0]) for one in labels]
    return [text for text, box in boxes if page.evaluate(APART, box)["covers"]]


@pytest.mark.parametrize("look", LOOKS, ids="-".join)
@pytest.mark.parametrize("name", ["contact", "turn"])
def test_a_story_goes_from_the_whole_dance_to_its_pair(
    pages: Pages,
    scenes: Callable[[str], Scene],
    name: str,
    look: tuple[Device, Language, Colours],
) -> None:
    scene = scenes(name)
    kind = {"contact": "contact", "turn": "tightest"}[name]
    (about,) = [one for one in scene.dance.occasions if one.kind == kind]
    page = opened(pages, scene, look)
    told(page, look, name)
    steps = []
    lengths = page.evaluate("benchdragon.face.story.steps.map(({ seconds }) => seconds)")
    assert 25 <= sum(lengths) <= 35
    for n in range(5):
        page.evaluate(STEP, [n, lengths[n] - 0.2])
        drawn(page)
        one = page.evaluate(TOLD)
        assert len(one["texts"]) == 1
        assert one["texts"] == [one["spoken"]]
        if n:
            assert tuple(one["pair"]) == tuple(about.benches)
            assert page.evaluate(SEEN), n
            assert covered(page) == [], n
        steps.append(one)
    assert [one["at"] for one in steps] == [0, 1, 2, 3, 4]
    assert steps[0]["scale"] < steps[1]["scale"] < steps[2]["scale"]
    assert steps[0]["time"] < steps[1]["time"] < steps[2]["time"] < steps[4]["time"]
    assert steps[3]["time"] == pytest.approx(about.time)
    assert f"{about.time:.2f} s" in steps[3]["texts"][0]
    assert len({one["texts"][0] for one in steps}) == 5
    if name == "contact":
        assert page.evaluate("benchdragon.boxes.pair(...benchdragon.face.story.pair).distance") < 0


def test_a_story_goes_on_by_itself_is_held_and_stepped_by_keys_and_ended(
    pages: Pages, contact: Scene
) -> None:
    page = opened(pages, contact)
    page.get_by_role("button", name=NAMES["contact"]["en"]).click()
    assert not page.get_by_role("button", name=NAMES["contact"]["en"]).is_visible()
    first = time_of(page)
    until(page, f"benchdragon.time > {first + 0.3}")
    page.locator("canvas").focus()
    page.keyboard.press("Space")
    held = time_of(page)
    drawn(page)
    drawn(page)
    assert time_of(page) == held
    page.keyboard.press("Space")
    until(page, f"benchdragon.time > {held}")
    for key, at in (("ArrowRight", 1), ("ArrowRight", 2), ("ArrowLeft", 1)):
        page.keyboard.press(key)
        assert state(page, "face.story.at") == at
    page.evaluate(PASS, 5.9)
    page.evaluate(PASS, 0.5)
    assert state(page, "face.story.at") == 2
    page.evaluate(PASS, 40)
    assert state(page, "face.story.at") == 4
    assert state(page, "face.story.runs") is False
    page.keyboard.press("Escape")
    assert not page.locator(".story").is_visible()
    assert page.get_by_role("button", name=NAMES["contact"]["en"]).is_visible()
    until(page, "location.hash.startsWith('#t=412.97')")


def test_each_caption_of_a_story_is_told_once_and_no_value_between(
    pages: Pages, contact: Scene
) -> None:
    page = opened(pages, contact)
    page.evaluate(
        """() => {
          globalThis.heard = [];
          const { spoken, axis } = benchdragon.face;
          const watch = (one, tell, how) =>
            new MutationObserver(() => heard.push(tell())).observe(one, how);
          watch(spoken, () => spoken.textContent, { childList: true });
          watch(axis.slider, () => "value", { attributes: true });
        }"""
    )
    page.evaluate("benchdragon.face.tell()")
    for _quarter in range(32):
        page.evaluate(PASS, 1.0)
        drawn(page)
    until(page, "!benchdragon.face.story.runs")
    for _picture in range(4):
        page.evaluate("benchdragon.put(benchdragon.time)")
        drawn(page)
    texts = page.evaluate("benchdragon.face.story.steps.map(({ text }) => text)")
    told = page.evaluate("heard")
    assert [one for one in told if one != "value"] == texts
    assert len(told) - len(texts) <= 1  # its time at rest


@pytest.mark.parametrize("how", ["play", "axis", "drag"])
def test_a_story_gives_way_to_hands(pages: Pages, contact: Scene, how: str) -> None:
    page = opened(pages, contact)
    page.evaluate("benchdragon.face.tell(undefined, 1)")
    if how == "play":
        page.locator("button.play").click()
        assert (state(page, "face.story.open"), state(page, "playing")) == (False, True)
    elif how == "axis":
        page.evaluate("benchdragon.jump(410)")
        assert (state(page, "face.story.open"), time_of(page)) == (False, 410.0)
    else:
        page.locator("canvas").hover(position={"x": 300, "y": 200})
        page.mouse.wheel(0, 200)
        until(page, "!benchdragon.face.story.runs")
        before = state(page, "camera.scale")
        drawn(page)
        assert state(page, "camera.scale") == before


def test_a_story_goes_on_in_the_other_language(pages: Pages, contact: Scene) -> None:
    page = opened(pages, contact)
    page.evaluate("benchdragon.face.tell(undefined, 2, true)")
    english = page.evaluate(TOLD)
    page.get_by_role("button", name="中文").click()
    chinese = page.evaluate(TOLD)
    assert (chinese["at"], state(page, "face.story.paused")) == (2, True)
    assert chinese["texts"] != english["texts"]
    assert "慢放" in chinese["texts"][0]


def test_with_reduced_motion_a_story_cuts(pages: Pages, contact: Scene) -> None:
    page = opened(pages, contact)
    page.emulate_media(reduced_motion="reduce")
    page.evaluate("benchdragon.face.tell(undefined, 1)")
    drawn(page)
    goal = page.evaluate("benchdragon.pairScale(...benchdragon.face.story.pair)")
    assert state(page, "camera.scale") == pytest.approx(goal)
    times = page.evaluate(
        f"() => {{ const seen = new Set(); for (let n = 0; n < 58; n++) {{"
        f" ({PASS})(0.1); seen.add(benchdragon.time); }} return [...seen]; }}"
    )
    assert len(times) <= 7  # a picture a second
    height = state(page, "camera.height")
    page.evaluate("benchdragon.face.story.end()")
    until(page, f"benchdragon.camera.height > {height}")
    page.evaluate("benchdragon.fit()")
    page.locator(".mark.contact").click()
    assert state(page, "camera.scale") == pytest.approx(page.evaluate("benchdragon.pairScale(0, 8)"))


@pytest.mark.parametrize("look", [HAND, DESK], ids="-".join)
def test_a_jump_to_an_event_goes_near_its_pair(
    pages: Pages, contact: Scene, look: tuple[Device, Language, Colours]
) -> None:
    page = opened(pages, contact, look)
    before = state(page, "camera.scale")
    (about,) = [one for one in contact.dance.occasions if one.kind == "contact"]
    box = page.locator(".mark.contact").bounding_box()
    assert box is not None
    press = page.touchscreen.tap if look[0] == "phone" else page.mouse.click
    press(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    assert time_of(page) == pytest.approx(about.time)
    until(page, f"benchdragon.camera.scale >= benchdragon.pairScale(0, {about.benches[1] - 1}) - 1e-6")
    drawn(page)
    assert state(page, "camera.scale") > before
    assert page.evaluate(SEEN)


@pytest.mark.parametrize("name", ["single"])
def test_a_dance_in_which_nothing_is_near_has_no_story(
    pages: Pages, scenes: Callable[[str], Scene], name: str
) -> None:
    page = opened(pages, scenes(name))
    assert not page.locator(".tell").is_visible()


@pytest.mark.parametrize("look", [DESK, HAND], ids="-".join)
@pytest.mark.parametrize(("name", "kind"), [("pole", "obstacle"), ("yard", "venue")])
def test_a_story_tells_how_a_bench_touches_an_obstacle_or_leaves_the_venue(
    pages: Pages,
    scenes: Callable[[str], Scene],
    name: str,
    kind: str,
    look: tuple[Device, Language, Colours],
) -> None:
    scene = scenes(name)
    (finding,) = [one for one in check(scene.plan).findings if one.kind == kind]
    page = opened(pages, scene, look)
    page.get_by_role("button", name=MET[kind][look[1]]).click()
    lengths = page.evaluate("benchdragon.face.story.steps.map(({ seconds }) => seconds)")
    assert 20 <= sum(lengths) <= 35
    texts = []
    for n, length in enumerate(lengths):
        page.evaluate(STEP, [n, length - 0.2])
        drawn(page)
        (text,) = page.evaluate(TOLD)["texts"]
        texts.append(text)
        if n:
            met = state(page, "face.story.met")
            assert (met["i"] + 1, met["obstacle"]) == (finding.benches[0], 0)
            assert page.evaluate(SEEN.replace("ringed", "met").replace("camera, met", MEETS)), n
            label = [one for one in written(page) if "(" in one["text"]]
            assert [one["text"].split("(")[1] for one in label] == [f"{finding.benches[0]}, {name})"]
    assert time_of(page) == pytest.approx(finding.time)
    assert finding.time is not None
    assert seconds(finding.time) in texts[-1]
    assert name in texts[0]
    assert state(page, "face.story.met.distance") <= 1e-3
    page.get_by_role("button", name={"en": "中文", "zh": "English"}[look[1]]).click()
    assert page.evaluate(TOLD)["texts"][0] not in texts
