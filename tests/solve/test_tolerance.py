"""Random dances: links, offsets, chances and their bounds."""

import json
import math
from concurrent.futures import Executor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchdragon import budget, parallel
from benchdragon.analysis.contact import first_contact
from benchdragon.cli.main import run
from benchdragon.errors import BenchDragonError, InputError, UnsureError
from benchdragon.explain.text import number as shown
from benchdragon.explain.tolerance import margin_lines
from benchdragon.i18n import spoken_in
from benchdragon.model.dragon import Dragon
from benchdragon.parallel import threads
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.solve.size import limit
from benchdragon.solve.tolerance import (
    CASES,
    Deviations,
    Draw,
    Tolerance,
    needed_pitch,
    tolerance,
    touches,
)
from tests.calculator import agree, chinese_or_not


def disc(pitch: float = 0.55, benches: int = 223) -> Plan:
    return read_plan(
        "spiral-in", [f"route.pitch={pitch}", "disc.radius=4.5", f"dragon.benches={benches}"]
    )


ROUTES = {
    "spiral": ("spiral-in", ["disc.radius=4.5", "dragon.benches=80"]),
    "turn": ("turn", ["dragon.benches=60"]),
    "line": ("turn", ["dragon.benches=40", "turn.family=arc-line-arc"]),
}


@pytest.mark.parametrize("name", ROUTES)
@pytest.mark.parametrize("deviations", [Deviations(), Deviations(aside=1e-9), Deviations(stray=1e-9)])
def test_people_who_are_all_but_exact_need_the_exact_pitch(name: str, deviations: Deviations) -> None:
    plan = read_plan(*ROUTES[name])
    found = tolerance(plan, deviations, 1)
    assert found.exact == limit(plan, "pitch").value
    # The line of one who strays is made of arcs, which leave the route by 1e-5 m.
    assert found.needed[0] == pytest.approx(found.exact, abs=5e-5 if deviations.stray else 1.1e-5)
    for side, touch in ((-1e-4, True), (1e-4, False)):
        near = plan.with_value("route.pitch", found.exact + side)
        assert touches(near, Draw(deviations, 1, 0)) is touch


def test_a_dance_touches_where_the_check_finds_a_contact() -> None:
    """A graze of the turn that evaluations each metre of the head passed over, 7 mm deep."""
    sizes = ["body_length=2.1", "tail_length=2.1", "head_length=3", "benches=120"]
    plan = read_plan("turn", ["route.pitch=1.03", *(f"dragon.{size}" for size in sizes)])
    walk = plan.build()
    assert first_contact(walk, *plan.span(walk)) is not None
    for deviations in (Deviations(), Deviations(aside=1e-9)):
        found = tolerance(plan, deviations, 2, own=True)
        assert found.touching()[0] == found.touching(1.03)[0] == 1.0
        assert found.needed == pytest.approx(found.exact, abs=1.1e-5)


def test_a_pitch_at_which_distances_leap_is_found() -> None:
    """The line of this dance is drawn by one arc more on one side of it."""
    plan = read_plan("spiral-in", ["disc.radius=4.5"])
    draw = Draw(CASES["stray"].deviations, 1, 202)
    pitch = needed_pitch(plan, draw, 0.4503373930272)
    assert not touches(plan.with_value("route.pitch", pitch), draw)
    assert touches(plan.with_value("route.pitch", pitch - 1.1e-5), draw)


def test_a_pitch_is_found_though_benches_meet_elsewhere_with_a_larger_one() -> None:
    """What is seen where they met before says nothing of where they meet now: it must be searched."""
    plan, draw = disc(), Draw(CASES["height"].deviations, 1, 696)
    pitch = needed_pitch(plan, draw, 0.4503373930272)
    assert not touches(plan.with_value("route.pitch", pitch), draw)
    assert touches(plan.with_value("route.pitch", pitch - 1.1e-5), draw)


def test_a_margin_is_kept_by_the_pitch_needed() -> None:
    plan = read_plan("turn", ["dragon.benches=30", "limits.margin=0.05"])
    found = tolerance(plan, Deviations(aside=1e-9), 1)
    assert found.exact == limit(plan, "pitch").value
    assert found.needed[0] == pytest.approx(found.exact, abs=1.1e-5)


def test_the_chance_at_the_plan_s_own_pitch_is_that_of_dances_walked_at_it() -> None:
    plan, deviations = disc(0.48, 60), Deviations(aside=0.02)
    found = tolerance(plan, deviations, 10, seed=3, own=True, executor=threads(2))
    assert found.hits == sum(touches(plan, Draw(deviations, 3, n)) for n in range(10))
    assert 0 < found.hits < 10
    assert found.touching() == found.touching(0.48)
    other = Tolerance(deviations, 3, found.exact, found.needed, 7)
    assert other.touching()[0] == 0.7
    with pytest.raises(InputError, match="own pitch"):
        tolerance(plan, deviations, 1).touching()


def test_longer_benches_need_what_the_exact_search_says() -> None:
    """Sizes alone are random here: the exact search walks the same benches, each with its own size."""
    draw = Draw(Deviations(length=0.02, width=0.005), 5, 0)
    plain = disc(benches=60)
    needed = tolerance(plain, draw.deviations, 1, seed=5).needed[0]
    for side, clear in ((-1e-5, False), (0.0, True)):
        walk = plain.with_value("route.pitch", float(needed) + side).build()
        dragon = draw.dragon(walk.dragon)
        own = type(walk)(dragon, walk.route, walk.profile, walk.start)
        end = walk.profile.time(walk.route.length)
        assert (first_contact(own, 0.0, end) is None) is clear


def test_each_slip_changes_what_it_says() -> None:
    plain = Dragon.uniform(2000)

    def drawn(**deviations: float) -> Dragon:
        return Draw(Deviations(**deviations), 1, 0).dragon(plain)

    assert np.std(drawn(length=0.02).length - plain.length) == pytest.approx(0.02, rel=0.1)
    assert np.std(drawn(width=0.01).width - plain.width) == pytest.approx(0.01, rel=0.1)
    play = drawn(play=0.01)
    assert np.std(play.links - plain.links) == pytest.approx(0.01, rel=0.1)
    assert (play.length == plain.length).all()
    level = drawn(height=0.1)
    assert (level.links <= plain.links).all()
    assert np.mean(plain.links - level.links) == pytest.approx(0.5 * 0.1**2 / 1.65, rel=0.1)


def test_a_dance_that_a_bound_all_but_clears_is_sought_no_farther_than_it_may_be() -> None:
    """At the first pitch tried only benches far apart are open: their distance says nothing."""
    plan, draw = disc(), Draw(CASES["stray"].deviations, 1, 338)
    needed = needed_pitch(plan, draw, limit(plan, "pitch").value)
    assert not touches(plan.with_value("route.pitch", needed), draw)
    assert touches(plan.with_value("route.pitch", needed - 1.1e-5), draw)


def test_a_seed_gives_the_same_dances_for_any_number_of_threads() -> None:
    plan = disc(benches=60)
    one, two = (
        tolerance(plan, CASES["all"].deviations, 6, seed=9, executor=threads(n)) for n in (1, 2)
    )
    assert (one.needed == two.needed).all()
    more = tolerance(plan, CASES["all"].deviations, 8, seed=9)
    assert set(one.needed) < set(more.needed)
    other = tolerance(plan, CASES["all"].deviations, 6, seed=10)
    assert not set(one.needed) & set(other.needed)


def test_a_larger_pitch_than_needed_stays_clear_and_a_smaller_one_does_not() -> None:
    plan, deviations = disc(benches=80), CASES["all"].deviations
    needed = tolerance(plan, deviations, 5, seed=4).needed
    for more in (-0.03, -1e-5, 0.0, 0.03, 0.1):
        for number, pitch in enumerate(needed):
            at = plan.with_value("route.pitch", float(pitch) + more)
            clear = [not touches(at, Draw(deviations, 4, n)) for n in range(5)]
            # Sorted: the dances that need less stay clear, and with more pitch this one does too.
            assert sum(clear) >= number + 1 if more >= 0.0 else sum(clear) <= number


def test_a_pitch_for_a_risk_is_sure_as_often_as_is_said() -> None:
    """Of many samples from a known distribution, at most 5 % may promise too small a pitch."""
    random = np.random.default_rng(3)
    wrong = 0
    for _trial in range(2000):
        needed = np.sort(random.random(100))
        wrong += Tolerance(Deviations(), 1, 0.0, needed).pitch_for(0.1) < 0.9
    assert 0.01 < wrong / 2000 < 0.065
    assert math.isinf(Tolerance(Deviations(), 1, 0.0, np.linspace(0, 1, 20)).pitch_for(0.1))


def test_a_pitch_from_which_a_risk_begins_is_sure_as_often_as_is_said() -> None:
    wrong = 0
    for seed in range(1000):
        needed = np.sort(np.random.default_rng(seed).random(80))
        one = Tolerance(Deviations(), 1, 0.0, needed)
        wrong += one.pitch_from(0.1) > 0.9
        assert one.pitch_from(0.1) < one.pitch_for(0.1)
    assert 0.01 * 1000 < wrong < 0.06 * 1000  # 5 % allowed; a bound that is never wrong is too wide
    assert Tolerance(Deviations(), 1, 0.0, np.ones(1)).pitch_from(0.5) == 0.0


def test_59_draws_are_just_enough_for_1_in_20() -> None:
    assert Tolerance(Deviations(), 1, 0.0, np.linspace(0, 1, 59)).pitch_for(0.05) == 1.0


def test_wrong_slips_and_draws_are_refused() -> None:
    with pytest.raises(InputError, match="at most 1 m"):
        Deviations(aside=1.5)
    with pytest.raises(InputError, match="negative"):
        Deviations(width=-0.1)
    with pytest.raises(InputError, match="draws must be a whole number from 1"):
        tolerance(disc(), Deviations(), 0)
    with pytest.raises(
        InputError, match="dance 1 has a bench that cannot be; make the deviations smaller"
    ):
        tolerance(disc(), Deviations(length=1.0), 1)


@pytest.mark.parametrize(
    ("settings", "error", "words"),
    [
        (["disc.radius=4.5", "limits.margin=60"], UnsureError, "no pitch was found"),
        (["disc.radius=4.5", "dragon.benches=2"], InputError, "no benches of this dragon can touch"),
        ([], InputError, "how far in the head comes"),
        (["disc.radius=4.5", "dragon.benches=20000"], InputError, "too long"),
    ],
)
def test_plans_that_have_no_such_pitch_are_refused_in_words(
    settings: list[str],
    error: type[BenchDragonError],
    words: str | None,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(budget.VARIABLE, "10")  # the first takes 4 % more than one question may
    with pytest.raises(error, match=words):
        tolerance(read_plan("spiral-in", settings), Deviations(), 1)


def test_the_plan_s_own_pitch_does_not_matter_and_other_routes_are_walked_too() -> None:
    deviations = Deviations(aside=0.02)
    near, far = (tolerance(disc(pitch, 60), deviations, 3, seed=2) for pitch in (0.55, 1.5))
    assert near.needed == pytest.approx(far.needed, abs=1e-5)
    assert near.exact == pytest.approx(far.exact, abs=1e-9)
    turning = tolerance(read_plan("turn", ["dragon.benches=30"]), deviations, 2)
    assert turning.exact == limit(read_plan("turn", ["dragon.benches=30"]), "pitch").value
    assert turning.needed[0] > 0.9 * turning.exact


def test_the_way_to_a_margin_is_explained(capsys: pytest.CaptureFixture[str]) -> None:
    plan, deviations = disc(benches=30), Deviations(aside=0.02, height=0.1)
    found = tolerance(plan, deviations, 60, seed=1)
    plan = plan.with_value("route.pitch", float(found.needed[29]))
    found = replace(found, hits=30)
    few = tolerance(plan, deviations, 5, seed=1, own=True)
    dragon = Draw(deviations, 1, 0).dragon(plan.build().dragon)
    words = ["margins", "spiral-in", "--set", "disc.radius=4.5", "--set", "dragon.benches=40"]
    words += ["--aside", "0.01", "--draws", "5", "--explain", "--json", "--quiet"]
    for spoken in ("en", "zh"):
        with spoken_in(spoken):
            lines = margin_lines(plan, found)
            told = margin_lines(plan, few)
        agree(lines, 2)
        chinese_or_not(lines, spoken)
        text = " ".join(lines)
        assert shown(found.pitch_for(0.05)) in text
        assert shown(found.exact) in text
        assert "30/60 = 0.5" in text
        assert f"= {shown(float(dragon.links[1]))} m" in text
        assert shown(0.95**5) in told[-1]
        assert run([*words, "--lang", spoken]) == 0
        assert len(json.loads(capsys.readouterr().out)["explanation"]) >= 8


def test_the_verb_tells_pitches_and_chances(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[int] = []
    pool = parallel._pool

    def counted(count: int) -> AbstractContextManager[Executor]:
        begun.append(count)
        return pool(count)

    monkeypatch.setattr(parallel, "_pool", counted)
    words = ["margins", "spiral-in", "--set", "disc.radius=4.5", "--set", "dragon.benches=30"]
    words += ["--quiet"]
    assert run([*words, "--aside", "0.02", "--json", "--draws", "20"]) == 0
    found = json.loads(capsys.readouterr().out)["cases"]["given"]
    assert found["draws"] == len(found["needed"]) == 20
    assert found["deviations"]["aside"] == 0.02
    assert found["touching"]["pitch"] == 0.55
    assert found["pitch_for"]["0.02"] is None  # twenty dances are too few for one in fifty
    assert found["pitch_for"]["0.5"] in found["needed"]
    words += ["--draws", "2"]
    begun.clear()
    assert run([*words, "-o", str(tmp_path)]) == 0
    assert len(begun) == 1  # all cases are walked by the same workers
    out = capsys.readouterr().out
    assert all(case.text[:12] in out for case in CASES.values())
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "margins.pdf", "margins.png", "margins.svg",
    ]  # fmt: skip
    assert run([*words, "-o", str(tmp_path)]) == 2
    assert run(["margins", "examples/01_parade.dragon.toml", "--quiet"]) != 0
    assert "route.pitch" in capsys.readouterr().err


def test_the_share_done_is_told_to_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[tuple[float, str]] = []
    bar = nullcontext(lambda share, text: told.append((share, text)))
    monkeypatch.setattr("benchdragon.cli.tolerance.shown_progress", lambda *_given: bar)
    words = ["margins", "spiral-in", "--set", "disc.radius=4.5", "--set", "dragon.benches=30"]
    assert run([*words, "--aside", "0.01", "--draws", "4"]) == 0
    assert told == [(0.25 * n, "as given") for n in range(5)]
