"""Plans in addresses: short, and never read as another plan."""

import json
from collections.abc import Iterator
from functools import partial
from typing import Any, Protocol

import pytest
from playwright.sync_api import Browser

from benchdragon.inlining import inlined
from benchdragon.planner.messages import Preset
from benchdragon.plans.presets import presets
from benchdragon.plans.schema import Plan, checked, read_plan
from tests.browser.pages import clean_pages
from tests.browser.planners import text_of
from tests.planner import random_plans
from tests.planner.twins import tried

PRESETS = [Preset.model_validate(one).model_dump(mode="json") for one in presets()]
SCRIPT = """
globalThis.linked = async ({ plans, texts, presets }) => {
  const links = await Promise.all(plans.map((plan) => linkText(plan, presets)));
  const read = await Promise.all([...links, ...texts].map((text) => readLink(text, presets)));
  return { links, read };
};
"""


class Linked(Protocol):
    """Links of plans, and what these and other texts are read as."""

    def __call__(
        self, plans: list[Any], texts: list[str], known: list[Any] = ...
    ) -> dict[str, Any]: ...


@pytest.fixture(scope="module")
def linked(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Linked]:
    """What the module makes of plans and texts, in Chromium: what inflates is the browser's own."""
    file = tmp_path_factory.mktemp("links") / "links.html"
    script = f"{inlined('link.js')}\n{SCRIPT}"
    file.write_text(f'<!DOCTYPE html><script type="module">{script}</script>', "utf-8")
    with clean_pages(browser) as pages:
        page = pages.open(file.as_uri())

        def ask(plans: list[Any], texts: list[str], known: list[Any] = PRESETS) -> dict[str, Any]:
            asked = {"plans": plans, "texts": texts, "presets": known}
            found: dict[str, Any] = page.evaluate("(asked) => linked(asked)", asked)
            return found

        yield ask


def test_a_link_holds_the_plan_and_tells_what_differs_from_a_preset_alone(linked: Linked) -> None:
    changed = ["dragon.benches=60", "route.pitch=1.6", "walk.speed=0.9", "limits.margin=0.05"]
    plans = [preset.plan for preset in presets()] + [read_plan("turn", changed)]
    found = linked([plan.data() for plan in plans], [])
    for plan, link, read in zip(plans, found["links"], found["read"], strict=True):
        assert Plan.model_validate(read["plan"]).sha256 == plan.sha256
        assert set(link) <= set("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_")
    assert max(map(len, found["links"][:-1])) <= 40
    assert len(found["links"][-1]) <= 140
    assert json.loads(found["read"][-1]["says"]) == [
        "turn",
        {
            "dragon": {"benches": 60}, "limits": {"margin": 0.05}, "route": {"pitch": 1.6},
            "walk": {"speed": 0.9},
        },
    ]  # fmt: skip


def test_random_plans_come_out_of_their_links_as_they_were(linked: Linked) -> None:
    tried_ones = [tried(partial(checked, random_plans.plan(seed), "plan")) for seed in range(120)]
    plans = [one for one in tried_ones if isinstance(one, Plan)]
    assert len(plans) > 40
    found = linked([plan.data() for plan in plans], [])
    same = [
        plan.sha256 == Plan.model_validate(read["plan"]).sha256
        for plan, read in zip(plans, found["read"], strict=True)
    ]
    assert all(same)


def test_keys_stand_in_any_order(linked: Linked) -> None:
    data = read_plan("turn", ["dragon.benches=60"]).data()
    turned = json.loads(json.dumps(data), object_pairs_hook=lambda pairs: dict(reversed(pairs)))
    found = linked([data, turned, data | {"nothing": None}], [])
    assert len(set(found["links"])) == 1


def test_a_damaged_link_is_no_plan(linked: Linked) -> None:
    plan = read_plan("turn", ["dragon.benches=60", "route.pitch=1.65"])
    (link,) = linked([plan.data()], [])["links"]
    cut = [link[:n] for n in range(len(link))]
    swapped = [
        link[:n] + ("A" if link[n] != "A" else "B") + link[n + 1 :] for n in range(len(link) - 1)
    ]
    read = linked([], [*cut, *swapped, link + "AAAA"])["read"]
    others = [one["plan"] for one in read if one["plan"]]
    assert len(others) <= 2  # the last letters hold bits that nothing is said by
    assert [Plan.model_validate(one).sha256 for one in others] == [plan.sha256] * len(others)
    assert read[len(link) - 4]["says"].startswith('["turn",{"dragon":{"benches":60}')


def test_a_link_of_other_presets_is_no_plan(linked: Linked) -> None:
    """Those of another version of the page, which a link does not hold."""
    data = read_plan("turn", ["dragon.benches=60"]).data()
    (link,) = linked([data], [])["links"]
    others = json.loads(json.dumps(PRESETS))
    for one in others:
        one["plan"]["dragon"]["width"] = 0.31
    assert linked([], [link], others)["read"][0]["plan"] is None
    assert (
        linked([], [link], [one for one in PRESETS if one["name"] != "turn"])["read"][0]["plan"] is None
    )


@pytest.mark.parametrize(
    "data",
    [
        b"", b"null", b"[]", b'"turn"', b"{}", b'["turn"]', b'["turn", 5]', b'["", {"schema": 1}]',
        b'["nosuch", {}]', b'["turn", {"__proto__": {"dragon": 1}}]',
        b'["",' + b'{"a":' * 200_000 + b"1" + b"}" * 200_000 + b"]",
    ],
    ids=lambda data: data[:24].decode() or "nothing",
)  # fmt: skip
def test_a_link_of_other_data_is_no_plan(linked: Linked, data: bytes) -> None:
    (read,) = linked([], [text_of(data)])["read"]
    assert read["plan"] is None


def test_a_link_does_not_unfold_without_end(linked: Linked) -> None:
    link = text_of(b" " * 60_000_000)
    assert len(link) < 100_000
    (read,) = linked([], [link])["read"]
    assert read["plan"] is None
    assert len(read["says"]) <= 4_000_000
