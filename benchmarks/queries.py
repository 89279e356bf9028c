"""An open set of 100,000 continuous-collision queries: `make`, `prove` and `run`.

`make` draws dances and queries and writes benchmarks/queries/*.xz without answers. `prove` adds the
answers that it can prove in ball arithmetic, dance by dance; stopped, it goes on where it was. `run`
asks this package and those rivals that are installed, and with --write keeps the table in
benchmarks/QUERIES.md.
"""

import argparse
import json
import sys
import time
from collections import Counter
from pathlib import Path

from query_draw import queries_of
from query_run import ours, table, taken
from query_set import (
    Dance,
    Query,
    by_dance,
    dance_of,
    drawn,
    read_dances,
    read_queries,
    write_dances,
    write_queries,
)
from query_truth import proved_all
from run import machine

WANTED = 100_000
# What was proved is written so often, s.
KEEPING = 60.0
RESULTS = Path(__file__).parent / "QUERIES.md"
INTRODUCTION = (
    "# Continuous-collision queries", "",
    "Written by `make queries`. What is asked, and how answers were proved, is told in "
    "[queries](queries/README.md). This package solves the chain within the query. Rivals are given "
    "poses at every step of the head, made beforehand and not timed, and move benches from pose to "
    "pose as each of them does. One thread each, in one run, by processor time. A false negative is a "
    "contact not told, or told more than 1e-6 m late; a contact told more than 1e-6 m too soon is told "
    "early. A graze that rounding leaves open counts as a contact told.", "",
)  # fmt: skip


def make(_options: argparse.Namespace) -> None:
    """Draw dances until there are enough queries about them."""
    dances, queries = list[Dance](), list[Query]()
    while len(queries) < WANTED:
        number = len(dances)
        dances.append(drawn(number))
        queries += queries_of(number, dances[-1])
        if number % 20 == 0:
            print(f"{number} dances, {len(queries)} queries", file=sys.stderr)
    write_dances(dances)
    write_queries(queries[:WANTED])


def prove(options: argparse.Namespace) -> None:
    """Prove the answers of queries that have none yet; with --again, of those that are open too."""
    dances, queries = read_dances(), read_queries()
    done, kept, began = list[Query](), time.monotonic(), time.process_time()
    for number, asked in by_dance(queries, dance_of):
        wanted = ("", "open") if options.again else ("",)
        tried = iter(proved_all(dances[number], [q for q in asked if q.answer in wanted]))
        done += [next(tried) if query.answer in wanted else query for query in asked]
        if time.monotonic() - kept > KEEPING or len(done) == len(queries):
            write_queries(done + queries[len(done) :])
            kept, count = time.monotonic(), Counter(query.answer for query in done)
            print(
                f"{len(done)} queries, {time.process_time() - began:.0f} s: {dict(count)}",
                file=sys.stderr,
            )
        if options.seconds and time.process_time() - began > options.seconds:
            write_queries(done + queries[len(done) :])
            break


def run(options: argparse.Namespace) -> None:
    """Ask this package and its rivals, and print the table."""
    lines = [*INTRODUCTION, machine(), "", *table(options), ""]
    print("\n".join(lines))
    if options.write:
        RESULTS.write_text("\n".join(lines), encoding="utf-8")


def answer(options: argparse.Namespace) -> None:
    """Print what the engine of this process answers, as JSON: seconds, and where contact is told, m."""
    print(json.dumps(ours(*taken(options.every))))


def parsed() -> argparse.Namespace:
    """What was asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    verbs = parser.add_subparsers(required=True)
    verbs.add_parser("make").set_defaults(job=make)
    proving, running, own = (verbs.add_parser(name) for name in ("prove", "run", "ours"))
    proving.add_argument("--again", action="store_true", help="try open queries anew")
    proving.add_argument("--seconds", type=float, help="of processor time, after which to stop")
    running.add_argument("--write", action="store_true", help="write benchmarks/QUERIES.md")
    running.add_argument(
        "--python", default=sys.executable, help="the Python that has python-fcl, coal"
    )
    running.add_argument("--node-folder", default=".", help="the folder whose node_modules has planck")
    for verb in (running, own):
        verb.add_argument("--every", type=int, default=1, help="of so many dances ask about one")
    for verb, job in ((proving, prove), (running, run), (own, answer)):
        verb.set_defaults(job=job)
    return parser.parse_args()


def main() -> None:
    """Do one of these."""
    options = parsed()
    options.job(options)


if __name__ == "__main__":
    main()
