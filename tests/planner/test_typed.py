"""Numbers that people type into the page are read as `benchdragon new` reads them, or asked back."""

import unicodedata

import pytest

from benchdragon.cli.new_answers import MIXED, length_to, read_count, read_speed
from benchdragon.errors import InputError
from tests.engine.recording import node
from tests.planner.twins import asked

pytestmark = pytest.mark.skipif(node() is None, reason="no Node here to run the page's modules in")
READERS = {"m": length_to(1e6, 0.0), "m/s": read_speed, "": read_count}
TYPED = [
    *((text, "m") for text in (
        "150cm", "1,5", "1米5", "1米85", "1.5", "1.5m", "1.5米", "1.50 m", "150公分", "一米五",
        "一米八",
        "1m50cm", "1 m 50 cm", "１.５", "１５０ｃｍ", "1。5", "0x5", "1e1", "5尺", "5 ft",
        "15 cm左右", "约1.5米", "1.5.",
        "1,5 m", "1.2.3", "NaN", "1/2", "1500mm", "1米50公分", "1_5", "+1.5", "100二十", "一百二",
        "1.5 M",
        "1.5 m/s", "1e999", "abc", "公分", "1米五", "0.15km",
    )),
    *((text, "m/s") for text in ("0.8", "0.8 m/s", "0.8米/秒", "0,8", "0.8米", "0.8米每秒", "0.8 s")),
    *((text, "") for text in ("120", "120条", "一百二十", "1,000", "120 benches", "120人", "12 m")),
]  # fmt: skip
# What `new` reads, and the page asks back: it may be meant otherwise; and what it knows beyond `new`.
DOUBTED = {("1 5", "m"), ("1米5米", "m"), ("1 .5", "m")}
BEYOND = {
    ("2.88 km/h", "m/s"): 0.8,
    ("48 m/min", "m/s"): 0.8,
    ("-5 s", "s"): -5.0,
    ("1 min 5 s", "s"): 65.0,
}


def read(text: str, unit: str) -> float | None:
    if MIXED.search(unicodedata.normalize("NFKC", text)):
        return None
    try:
        return float(READERS[unit]("x", text, "1"))
    except InputError:
        return None


def test_the_page_reads_what_new_reads_and_nothing_else() -> None:
    found = asked("typed.mjs", TYPED)
    wanted = [read(text, unit) for text, unit in TYPED]
    assert dict(zip(TYPED, found, strict=True)) == pytest.approx(
        dict(zip(TYPED, wanted, strict=True)), nan_ok=False
    )
    assert sum(value is None for value in wanted) >= 12
    assert asked("typed.mjs", sorted(DOUBTED)) == [None] * len(DOUBTED)
    assert asked("typed.mjs", list(BEYOND)) == pytest.approx(list(BEYOND.values()))
