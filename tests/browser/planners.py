"""The planner as tests open it in a browser."""

import base64
import re
import zlib
from collections.abc import Callable

from playwright.sync_api import Locator, Page, expect

from tests.browser.players import until

Opened = Callable[..., Page]
PITCH = "spiral pitch"
SETTLED = """document.getElementById("planner")?.ariaBusy === "false"
  && [...document.querySelectorAll("[data-stale]")].every((one) => !one.checkVisibility())
  && document.querySelectorAll(".verdict:is(.safe, .tight, .unsafe)").length === 1"""


def verdict(page: Page) -> Locator:
    return page.locator(".verdict")


def sentence(page: Page) -> Locator:
    """The verdict in a sentence, which screen readers tell and paper shows."""
    return page.locator(".sentence")


def details(page: Page) -> Locator:
    """What is behind the verdict, opened."""
    verdict(page).click()
    return page.get_by_role("dialog")


def number(page: Page, name: str) -> Locator:
    return page.get_by_role("textbox", name=name, exact=True)


def change(page: Page, name: str, value: str) -> None:
    """Give a size of the plan another value."""
    number(page, name).fill(value)
    number(page, name).press("Enter")


def settle(page: Page, pattern: str) -> None:
    """Wait for a verdict that reads so."""
    expect(sentence(page)).to_have_text(re.compile(pattern))


def settled(page: Page) -> Page:
    """The page, once it shows verdict and dance of its plan.

    It is asked in one: an expectation that does not hold yet reads all of the page out each time.
    """
    until(page, SETTLED)
    return page


def address(page: Page, *former: str) -> str:
    """The page's address, once it holds another plan than former addresses do."""
    held = [re.findall(r"plan=[^&]*", url) for url in ("", *former)]
    page.wait_for_url(lambda url: re.findall(r"plan=[^&]*", url) not in held)
    return page.url


def on_its_way(page: Page, name: str, way: str) -> None:
    """Have questions of one name go another way: it gets `go`, which asks the Worker, and `signal`."""
    page.evaluate(
        f"""() => {{
          const way = {way};
          const {{ quick, slower, drawing }} = benchdragon.answers;
          for (const lane of [quick, slower, drawing]) {{
            const ask = lane.ask.bind(lane);
            lane.ask = (asked, signal, told) => {{
              const go = () => ask(asked, signal, told);
              return asked.question === {name!r} ? way(go, signal) : go();
            }};
          }}
        }}"""
    )


class Held:
    """Questions of one name that are held up on their way until they are let go."""

    def __init__(self, page: Page, name: str) -> None:
        self.page, self.name = page, name
        # Else a question that is long on its way is given up for a newer one.
        page.evaluate(
            """for (const one of ["verdicts", "sketches", "dances"]) {
              benchdragon[one].patience = 1e9;
              // An answer would set this back.
              Object.defineProperty(benchdragon[one].resting, "delay", { get: () => 1e9, set() {} });
            }"""
        )
        page.evaluate("(name) => { (globalThis.heldUp ??= {})[name] = []; }", name)
        on_its_way(
            page,
            name,
            f"""(go, signal) => new Promise((done, failed) => {{
              signal?.addEventListener("abort", () => failed(new DOMException("", "AbortError")));
              heldUp[{name!r}].push(() => go().then(done, failed));
            }})""",
        )

    def wait(self, count: int) -> None:
        """Wait until so many have been asked."""
        until(self.page, f"heldUp[{self.name!r}].length >= {count}")

    def let_go(self, number: int) -> None:
        self.page.evaluate(f"void heldUp[{self.name!r}][{number}]()")


class Refused:
    """Questions of one name that have no answer until they are answered again."""

    def __init__(self, page: Page, name: str) -> None:
        self.page, self.name = page, name
        page.evaluate("(name) => void (globalThis.refused ??= new Set()).add(name)", name)
        memory = 'Promise.reject(new Error("memory"))'
        on_its_way(page, name, f"(go) => refused.has({name!r}) ? {memory} : go()")

    def end(self) -> None:
        self.page.evaluate("(name) => void refused.delete(name)", self.name)


def text_of(data: bytes) -> str:
    """Data as the address of a page holds a plan, without a right checksum."""
    packer = zlib.compressobj(9, wbits=-zlib.MAX_WBITS)
    packed = packer.compress(data) + packer.flush()
    return base64.urlsafe_b64encode(b"sums" + packed).decode().rstrip("=")
