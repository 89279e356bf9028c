"""The open set of continuous-collision queries: its files, its proofs, and our answers to it."""

import dataclasses
import json
import math
import sys
from argparse import Namespace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("flint")

FOLDER = Path(__file__).parent.parent / "benchmarks"
NOBODY = Namespace(every=1, python="no-python-here", node_folder=".")
# A worker that answers as rivals' do: contact at the second pose of those that have an odd number.
WORKER = """
import json, sys, numpy as np
for line in sys.stdin:
    numbers, at, told = np.fromfile(line.strip()), 0, []
    while at < len(numbers):
        count = int(numbers[at])
        told.append((count * 1e-6, 1.0 if count % 2 else None))
        at += 4 + 6 * count
    print(json.dumps(told), flush=True)
"""


@pytest.fixture(scope="module")
def bench() -> Any:
    """The modules of the benchmark, and the set as it is committed."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(FOLDER))
        import query_draw
        import query_run
        import query_set
        import query_truth

        yield SimpleNamespace(
            draw=query_draw, run=query_run, set=query_set, truth=query_truth,
            dances=query_set.read_dances(), queries=query_set.read_queries(),
        )  # fmt: skip


def sample(bench: Any, count: int, answer: str = "", benches: int = 300) -> list[Any]:
    """So many queries with an answer, or any, from all over the set, of chains of so many benches."""
    fit = [
        query
        for query in bench.queries
        if query.answer == (answer or query.answer) and query.second < benches
    ]
    return fit[:: max(1, len(fit) // count)][:count]


def test_the_set_is_what_its_page_says(bench: Any) -> None:
    queries, page = bench.queries, (FOLDER / "queries" / "README.md").read_text("utf-8")
    assert len(queries) == 100_000
    assert all(f"`{name}`" in page for name in bench.set.COLUMNS)
    assert {query.answer for query in queries} <= {"touch", "apart", "open", ""}
    assert [query.dance for query in queries] == sorted(query.dance for query in queries)
    for query in queries:
        dance = bench.dances[query.dance]
        assert 0 <= query.first <= query.second - 2 < dance.benches - 2
        assert dance.span[0] <= query.start < query.end <= dance.span[1]
        if query.answer == "touch":
            assert query.start < query.low < query.high <= min(query.end, query.low + 1e-6)
        elif query.answer == "apart":
            assert query.separation > 0.0


def test_dances_are_those_of_their_numbers(bench: Any) -> None:
    assert {dance.kind for dance in bench.dances} == {"spiral", "turn", "arcs", "clothoids", "eights"}
    for number in range(0, len(bench.dances), len(bench.dances) // 10):
        assert bench.set.drawn(number) == bench.dances[number]


def test_files_hold_what_was_written(bench: Any, tmp_path: Path) -> None:
    some = [*sample(bench, 3, "touch"), *sample(bench, 3, "apart")]
    bench.set.write_queries(some, tmp_path / "queries.csv.xz")
    bench.set.write_dances(bench.dances[:3], tmp_path / "dances.json.xz")
    assert list(map(str, bench.set.read_queries(tmp_path / "queries.csv.xz"))) == list(map(str, some))
    assert bench.set.read_dances(tmp_path / "dances.json.xz") == bench.dances[:3]
    assert len(list(tmp_path.iterdir())) == 2


def shown(bench: Any, query: Any) -> bool:
    chain = bench.truth.Chain(bench.dances[query.dance], query.second + 1)
    found: bool = bench.truth.shown(chain, query)
    return found


def test_answers_are_proved_again_and_wrong_ones_are_not(bench: Any) -> None:
    for query in sample(bench, 5, "touch", 60):
        assert shown(bench, query)
        later = dataclasses.replace(query, low=query.high + 1e-8, high=query.high + 2e-8)
        sooner = dataclasses.replace(query, low=query.low - 1e-6, high=query.low - 0.5e-6)
        assert not shown(bench, later)
        assert not shown(bench, sooner)
        assert not shown(bench, dataclasses.replace(query, answer="apart", separation=1e-12))
    for query in sample(bench, 5, "apart", 60):
        assert shown(bench, query)
        assert not shown(bench, dataclasses.replace(query, separation=30.0 * query.separation))
        middle = 0.5 * (query.start + query.end)
        assert not shown(
            bench, dataclasses.replace(query, answer="touch", low=middle, high=middle + 1e-6)
        )


def test_heights_and_speeds_stay_within_their_bounds(bench: Any) -> None:
    bounded = 0
    for query in sample(bench, 8, benches=60):
        chain = bench.truth.Chain(bench.dances[query.dance], query.second + 1)
        pair, start = bench.truth.Pair(chain, query), query.start
        for head in (0.01, 0.1):
            a, b = chain.stand(start), chain.stand(start + head)
            motion, one, other = chain.motion(a, b), pair.seen(a), pair.seen(b)
            bow = pair._bow(motion, one.foot, head)
            if not np.isfinite(bow).all():  # too long a cell
                continue
            bounded += 1
            before = a
            for share in np.linspace(0.0, 1.0, 9)[1:]:
                at = chain.stand(start + share * head)
                chord = (1.0 - share) * one.height + share * other.height
                assert (pair.seen(at).height >= chord - 4.0 * share * (1.0 - share) * bow - 1e-10).all()
                assert (at.speed <= motion.speed).all()
                assert (at.at - before.at <= motion.speed * (at.s - before.s) + 1e-10).all()
                before = at
    assert bounded > 10


def test_a_pair_that_overlaps_is_seen_wherever_it_does(bench: Any) -> None:
    for query in sample(bench, 5, "touch", 60):
        chain = bench.truth.Chain(bench.dances[query.dance], query.second + 1)
        pair = bench.truth.Pair(chain, query)
        assert pair.overlap(chain.stand(query.high))
        assert not pair.overlap(chain.stand(query.low))
        assert not pair.keeps(query.end, 0.0)
        assert pair.keeps(query.low, 0.0)


def test_a_route_that_bends_too_much_is_refused(bench: Any) -> None:
    tight = dataclasses.replace(bench.dances[2], links=(9.0, 1.0))
    with pytest.raises(bench.truth.NotShownError, match="bends by more"):
        bench.truth.Chain(tight, 2)


def scored(bench: Any, count: int, benches: int) -> Any:
    proved = [q for q in bench.queries if q.answer in ("touch", "apart") and q.second < benches]
    asked = proved[:: len(proved) // count]
    return bench.run.score(asked, bench.run.ours(bench.dances, asked))


def test_this_package_misses_no_contact_of_two_hundred(bench: Any) -> None:
    found = scored(bench, 200, 60)
    assert (found.missed, found.late) == (0, 0)
    assert len(found.errors) > 50


def test_this_package_misses_no_contact_of_two_thousand(bench: Any) -> None:
    found = scored(bench, 2000, 120)
    assert (found.missed, found.late) == (0, 0)
    assert found.false <= 2
    assert len(found.errors) > 500


def test_answers_are_scored_by_the_truth(bench: Any) -> None:
    touch = bench.set.Query(0, 0, 2, 0.3, 1.0, 2.0, "touch", 1.5, 1.5 + 1e-9)
    apart = bench.set.Query(0, 0, 2, 0.3, 1.0, 2.0, "apart", separation=0.1)
    left = bench.set.Query(0, 0, 2, 0.3, 1.0, 2.0, "open")
    told = [None, 1.5 + 2e-6, 1.5 - 2e-6, 1.5, 1.2, None, 1.1]
    asked = [touch, touch, touch, touch, apart, apart, left]
    found = bench.run.score(asked, [(1e-6, s) for s in told])
    assert (found.missed, found.late, found.early, found.false) == (1, 1, 1, 1)
    assert found.errors == pytest.approx([2e-6, 2e-6, 5e-10], abs=1e-9)


def test_a_rival_is_given_poses_and_its_steps_are_the_heads_way(bench: Any, tmp_path: Path) -> None:
    asked = sample(bench, 6, benches=20)
    command = (sys.executable, "-c", WORKER)
    rival = bench.run.Rival("one", command, command, "", tmp_path, 0.05)
    told = bench.run.ask(rival, bench.dances, asked)
    for query, (seconds, s) in zip(asked, told, strict=True):
        count = math.ceil((query.end - query.start) / 0.05 - 1e-6) + 1
        assert seconds == pytest.approx(count * 1e-6)
        step = (query.end - query.start) / (count - 1)
        assert s == (pytest.approx(query.start + step) if count % 2 else None)


def test_a_pose_is_where_the_bench_is(bench: Any) -> None:
    (query,) = sample(bench, 1, "touch", 20)
    count, long, other, half, *poses = bench.run.poses(
        bench.dances[query.dance], [query], 0.05
    ).tolist()
    dance = bench.dances[query.dance]
    assert half == 0.5 * query.width
    assert long == pytest.approx(0.5 * (dance.link[query.first] + dance.front + dance.rear))
    assert other == pytest.approx(0.5 * (dance.link[query.second] + dance.front + dance.rear))
    x, y, turn = poses[:3]
    places = bench.draw.Asking(dance).place(np.array([query.start]))
    tail = x - (long - dance.rear) * math.cos(turn), y - (long - dance.rear) * math.sin(turn)
    i = query.first + 1
    assert tail == pytest.approx((places.x[i, 0], places.y[i, 0]), abs=1e-9)
    assert len(poses) == 6 * count


def test_rivals_that_are_not_installed_are_told_of(bench: Any) -> None:
    every = list(bench.run.rivals(NOBODY))
    assert {rival.step for rival in every} == {0.05, 0.01}
    assert all(rival.missing() for rival in every if rival.command[0].endswith("no-python-here"))
    assert {"pip install python-fcl", "pip install coal"} < {
        " ".join(rival.install.split()[:3]) for rival in every
    }
    json.dumps([rival.name for rival in every])
