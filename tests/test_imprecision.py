"""Random dances: links, offsets, chances and their bounds."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import binomtest

from benchdragon import imprecision
from benchdragon.cli import run
from benchdragon.contact import first_contact
from benchdragon.dragon import Dragon
from benchdragon.errors import BenchDragonError, InputError, UnsureError
from benchdragon.explain import number as shown
from benchdragon.explain_margins import margin_lines
from benchdragon.imprecision import CASES, Draw, Margins, Slips, least_clearance, margins
from benchdragon.kernels.sway import sway
from benchdragon.plan import Plan, read_plan
from benchdragon.solve import limit
from tests.calculator import agree, chinese_or_not


def disc(pitch: float = 0.55, benches: int = 223) -> Plan:
    return read_plan(
        "spiral-in", [f"route.pitch={pitch}", "disc.radius=4.5", f"dragon.benches={benches}"]
    )


def test_without_slips_a_dance_is_the_plan_s_own() -> None:
    pitch = limit(disc(), "pitch").value
    assert least_clearance(disc(pitch), Draw(Slips(), 1, 0)) == pytest.approx(0.0, abs=2e-4)
    assert margins(disc(), Slips(), 1).exact == pitch
    fine = least_clearance(disc(pitch), Draw(Slips(), 1, 0), (0.02, 0.5))
    assert fine == pytest.approx(0.0, abs=1e-6)


def test_finer_looks_find_the_same_to_a_millimetre() -> None:
    for name in ["aside", "stray", "all"] * 2:
        draw = Draw(CASES[name].slips, 3, len(name))
        coarse, fine = least_clearance(disc(0.5), draw), least_clearance(disc(0.5), draw, (0.1, 0.1))
        assert fine <= coarse <= fine + 1e-3


def test_longer_benches_need_what_the_exact_search_says() -> None:
    """Sizes alone are random here: the exact search walks the same benches, each with its own size."""
    draw = Draw(Slips(length=0.02, width=0.005), 5, 0)
    plain = disc(benches=60)
    needed = margins(plain, draw.slips, 1, seed=5).needed[0]
    for side, clear in ((-5e-4, False), (5e-4, True)):
        walk = plain.with_value("route.pitch", float(needed) + side).build()
        dragon = draw.dragon(walk.dragon)
        own = type(walk)(dragon, walk.route, walk.profile, walk.start)
        end = walk.profile.time(walk.route.length)
        assert (first_contact(own, 0.0, end) is None) is clear


def test_each_slip_changes_what_it_says() -> None:
    plain = Dragon.uniform(2000)

    def drawn(**slips: float) -> Dragon:
        return Draw(Slips(**slips), 1, 0).dragon(plain)

    assert np.std(drawn(length=0.02).length - plain.length) == pytest.approx(0.02, rel=0.1)
    assert np.std(drawn(width=0.01).width - plain.width) == pytest.approx(0.01, rel=0.1)
    play = drawn(play=0.01)
    assert np.std(play.links - plain.links) == pytest.approx(0.01, rel=0.1)
    assert (play.length == plain.length).all()
    level = drawn(height=0.1)
    assert (level.links <= plain.links).all()
    assert np.mean(plain.links - level.links) == pytest.approx(0.5 * 0.1**2 / 1.65, rel=0.1)


def test_the_trodden_line_strays_as_far_as_it_should_and_smoothly() -> None:
    spread, steps = [], []
    for number in range(40):
        lane, step = Draw(Slips(stray=0.02), 1, number).lane(400.0)
        spread.append(lane.std())
        steps.append(np.abs(np.diff(lane)).max() / step)
    assert np.mean(spread) == pytest.approx(0.02, rel=0.1)
    assert max(steps) < 0.02  # m per m: no kinks
    long, short = (Draw(Slips(stray=0.02), 1, 0).lane(way)[0] for way in (400.0, 100.0))
    assert long[: short.size] == pytest.approx(short)


def test_a_seed_gives_the_same_dances_for_any_number_of_threads() -> None:
    plan = disc(benches=60)
    one, two = (margins(plan, CASES["all"].slips, 6, seed=9, workers=n) for n in (1, 2))
    assert (one.needed == two.needed).all()
    more = margins(plan, CASES["all"].slips, 8, seed=9)
    assert set(one.needed) < set(more.needed)
    other = margins(plan, CASES["all"].slips, 6, seed=10)
    assert not set(one.needed) & set(other.needed)


def test_a_larger_pitch_than_needed_stays_clear_and_a_smaller_one_does_not() -> None:
    plan, slips = disc(benches=80), CASES["all"].slips
    needed = margins(plan, slips, 5, seed=4).needed
    for more in (-0.03, -0.001, 0.001, 0.03, 0.1):
        for number, pitch in enumerate(needed):
            at = plan.with_value("route.pitch", float(pitch) + more)
            clear = [least_clearance(at, Draw(slips, 4, n)) > 0.0 for n in range(5)]
            # Sorted: the dances that need less stay clear, and with more pitch this one does too.
            assert sum(clear) >= number + 1 if more > 0.0 else sum(clear) <= number


def test_the_bounds_of_a_chance_are_those_of_clopper_and_pearson() -> None:
    found = Margins(Slips(), 1, 0.45, np.linspace(0.45, 0.55, 101))
    for pitch in (0.44, 0.5, 0.545, 0.56):
        share, low, high = found.touching(pitch)
        hits = int((found.needed > pitch).sum())
        interval = binomtest(hits, 101).proportion_ci(0.95, "exact")
        assert (share, low, high) == pytest.approx((hits / 101, interval.low, interval.high))


def test_a_pitch_for_a_risk_is_sure_as_often_as_is_said() -> None:
    """Of many samples from a known distribution, at most 5 % may promise too small a pitch."""
    random = np.random.default_rng(3)
    wrong = 0
    for _trial in range(2000):
        needed = np.sort(random.random(100))
        wrong += Margins(Slips(), 1, 0.0, needed).pitch_for(0.1) < 0.9
    assert 0.01 < wrong / 2000 < 0.065
    assert math.isinf(Margins(Slips(), 1, 0.0, np.linspace(0, 1, 20)).pitch_for(0.1))
    assert Margins(Slips(), 1, 0.0, np.linspace(0, 1, 59)).pitch_for(0.05) == 1.0


def test_wrong_slips_and_draws_are_refused() -> None:
    with pytest.raises(InputError, match="at most 1 m"):
        Slips(aside=1.5)
    with pytest.raises(InputError, match="negative"):
        Slips(width=-0.1)
    with pytest.raises(InputError, match="draws must be"):
        margins(disc(), Slips(), 0)
    with pytest.raises(InputError, match=r"dance 1 has a bench that cannot be.*make the slips smaller"):
        margins(disc(), Slips(length=1.0), 1)


@pytest.mark.parametrize(
    ("settings", "error", "words"),
    [
        (["disc.radius=4.5", "limits.margin=60"], UnsureError, "no pitch was found"),
        (["disc.radius=4.5", "dragon.benches=2"], InputError, "no benches of this dragon can touch"),
        ([], InputError, "how far in the head comes"),
        (["disc.radius=4.5", "walk.start=1000"], BenchDragonError, None),
        (["disc.radius=4.5", "dragon.benches=20000"], InputError, "too long"),
    ],
)
def test_plans_that_have_no_such_pitch_are_refused_in_words(
    settings: list[str], error: type[BenchDragonError], words: str | None
) -> None:
    with pytest.raises(error, match=words):
        margins(read_plan("spiral-in", settings), Slips(), 1)


def test_the_plan_s_own_pitch_does_not_matter_and_other_routes_are_walked_too() -> None:
    slips = Slips(aside=0.02)
    near, far = (margins(disc(pitch, 60), slips, 3, seed=2) for pitch in (0.55, 1.5))
    assert near.needed == pytest.approx(far.needed, abs=2e-4)
    assert near.exact == pytest.approx(far.exact, abs=1e-9)
    turning = margins(read_plan("turn", ["dragon.benches=30"]), slips, 2)
    assert turning.exact == limit(read_plan("turn", ["dragon.benches=30"]), "pitch").value
    assert turning.needed[0] > 0.9 * turning.exact


def test_the_way_to_a_margin_is_explained(spoken: str, capsys: pytest.CaptureFixture[str]) -> None:
    plan, slips = disc(benches=60), Slips(aside=0.02, height=0.1)
    found = margins(plan, slips, 100, seed=1)
    lines = margin_lines(plan, found, float(found.needed[49]))
    agree(lines, 2)
    chinese_or_not(lines, spoken)
    text = " ".join(lines)
    assert shown(found.pitch_for(0.05)) in text
    assert shown(found.exact) in text
    assert "50/100 = 0.5" in text
    dragon = Draw(slips, 1, 0).dragon(plan.build().dragon)
    assert f"= {shown(float(dragon.links[1]))} m" in text
    few = margin_lines(plan, margins(plan, slips, 5, seed=1), 0.55)
    assert shown(0.95**5) in few[-1]
    words = ["margins", "spiral-in", "--set", "disc.radius=4.5", "--set", "dragon.benches=40"]
    assert run([*words, "--aside", "0.01", "--draws", "5", "--explain", "--json", "--quiet"]) == 0
    assert len(json.loads(capsys.readouterr().out)["explanation"]) >= 8


def test_the_verb_tells_pitches_and_chances(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["margins", "spiral-in", "--set", "disc.radius=4.5", "--set", "dragon.benches=60"]
    words += ["--draws", "20", "--quiet"]
    assert run([*words, "--aside", "0.02", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["cases"]["given"]
    assert found["draws"] == len(found["needed"]) == 20
    assert found["slips"]["aside"] == 0.02
    assert found["touching"]["pitch"] == 0.55
    assert found["pitch_for"]["0.02"] is None  # twenty dances are too few for one in fifty
    assert found["pitch_for"]["0.5"] in found["needed"]
    assert run([*words, "-o", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert all(case.text[:12] in out for case in CASES.values())
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "margins.pdf", "margins.png", "margins.svg",
    ]  # fmt: skip
    assert run([*words, "-o", str(tmp_path)]) == 2
    assert run(["margins", "examples/01_parade.dragon.toml", "--quiet"]) != 0
    assert "route.pitch" in capsys.readouterr().err


def test_benches_keep_their_links_however_far_the_line_strays(monkeypatch: pytest.MonkeyPatch) -> None:
    """A line that strays is longer or shorter than the drawn one: the tail comes to stand a metre off.

    In dance 69 handles once ran away to 1e69 m, put aside from places that far from their own.
    """
    worst = []

    def watched(*arguments: Any) -> None:
        sway(*arguments)
        links, x, y = arguments[1], *arguments[-2:]
        chords = np.hypot(np.diff(x, axis=0), np.diff(y, axis=0))
        worst.append(float(np.abs(chords - links[:, np.newaxis]).max()))

    monkeypatch.setattr(imprecision, "sway", watched)
    for n in range(66, 71):
        least_clearance(disc(0.45), Draw(CASES["stray"].slips, 1, n))
        least_clearance(disc(0.45), Draw(Slips(stray=0.2, aside=0.05), 1, n))
    assert len(worst) == 10
    assert max(worst) < 1e-9
