"""`make bench`: how fast answers are, beside rivals and beside an older version, in one run.

What is compared takes turns, repeat by repeat, and the fastest of each counts, so that a machine that
slows down slows both. `--write` keeps the tables in benchmarks/RESULTS.md.
"""

import argparse
import datetime
import os
import platform
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from before import before_and_after, described, engines, source_of
from searches import contact_growth, quick_answers, spiral_bound, turns
from standard import standard_table
from startup import memory, sizes, whole_processes
from targets import targets
from timing import Options
from walking import growth, large_jobs, threads

HERE = Path(__file__).parent


@dataclass(frozen=True)
class Table:
    """A table of the results: its heading, and what measures it."""

    heading: str
    job: Callable[[Options], list[str]]


def frames(_options: Options) -> list[str]:
    """The player's pictures in a browser."""
    return printed("frame_time")


def sliders(_options: Options) -> list[str]:
    """The planner's answers to one person."""
    return printed("sliders")


def browsers(_options: Options) -> list[str]:
    """The planner's answers in Firefox beside Chromium."""
    return printed("browsers")


TABLES = {
    "targets": Table("Targets", targets),
    "before": Table("Before and after", before_and_after),
    "engines": Table("Engines", engines),
    "processes": Table("Whole processes", whole_processes),
    "memory": Table("Memory", memory),
    "sizes": Table("Sizes", sizes),
    "standard": Table("The standard table", standard_table),
    "growth": Table("Growth", growth),
    "bound": Table("The bound for spirals", spiral_bound),
    "contact": Table("First contact of longer dragons", contact_growth),
    "turns": Table("Turns", turns),
    "quick": Table("Quick answers", quick_answers),
    "large": Table("Large jobs", large_jobs),
    "threads": Table("Threads", threads),
    "frames": Table("The player's frames, in Chromium that draws without a GPU", frames),
    "sliders": Table("The planner, one person moving a slider", sliders),
    "browsers": Table("The planner, in Firefox beside Chromium", browsers),
}


def printed(name: str) -> list[str]:
    """The table that another script of this folder prints."""
    command = [sys.executable, "-m", f"benchmarks.{name}"]
    done = subprocess.run(command, cwd=HERE.parent, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout.splitlines()


def machine() -> str:
    """What the figures were measured on."""
    name = platform.processor() or platform.machine()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            name = line.split(":")[1].strip()
            break
    gcc = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=True).stdout
    return (
        f"{datetime.datetime.now(datetime.UTC).date()}, {described(HERE.parent)}; {name}, "
        f"{os.cpu_count()} cores; Python {platform.python_version()}, NumPy {version('numpy')}, "
        f"Wasmtime {version('wasmtime')}; {gcc.splitlines()[0]}"
    )


def asked() -> argparse.Namespace:
    """The options, refused where they do not go together."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="smaller sizes, fewer repeats")
    parser.add_argument("--write", action="store_true", help="write benchmarks/RESULTS.md")
    parser.add_argument("--before", metavar="FOLDER", help="another checkout, timed beside this one")
    parser.add_argument("--only", nargs="+", choices=TABLES, help="these tables alone")
    options = parser.parse_args()
    if options.write and (options.quick or options.only):
        parser.error("--write keeps all tables, at full size: neither --quick nor --only")
    if options.before:
        source_of(options.before)
    if shutil.which("gcc") is None:
        sys.exit("the C rival needs gcc, and there is none")
    return options


def main() -> None:
    """Measure, print each table when it is there, and with --write keep them all."""
    options = asked()
    parts = [["# Results of `make bench`", "", machine(), ""]]
    print("\n".join(parts[0]), flush=True)
    for name in options.only or TABLES:
        table, began = TABLES[name], time.perf_counter()
        parts.append(
            [f"## {table.heading}", "", *table.job(Options(options.quick, options.before)), ""]
        )
        print("\n".join(parts[-1]), flush=True)
        print(f"({name}: {time.perf_counter() - began:.0f} s)", file=sys.stderr)
    if options.write:
        text = "\n".join("\n".join(part) for part in parts)
        (HERE / "RESULTS.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
