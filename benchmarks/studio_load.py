"""A minute of fifty people at one studio, each moving a slider: errors, and how long answers take.

Run it as `python -m benchmarks.studio_load [--clients 50] [--seconds 60] [--workers N] [--digits 3]`.
A client asks for a verdict on the contest's dragon with another pitch each time its slider moves, a
few times a second while it moves, then rests and looks. As on the page, each move asks anew whether
the last answer has come or not; questions that a newer one replaced (409) are counted apart. First one
person alone moves a slider, waiting for each answer: what else the machine does slows down both.
"""

import argparse
import asyncio
import os
import platform
import random
import statistics
import subprocess
import sys
import time
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import httpx

from benchdragon.plans.schema import read_plan

# Seconds between moves of a slider, and moves until the hand rests; seconds of rest.
MOVE, MOVES, REST = 0.15, (3, 12), (1.0, 6.0)
PITCHES = (0.46, 0.60)
SUPERSEDED = 409
# Moves of the person who is alone first.
ALONE = 40


@dataclass
class Tally:
    """What came back."""

    statuses: Counter[str] = field(default_factory=Counter)
    seconds: list[float] = field(default_factory=list)

    async def ask(self, client: httpx.AsyncClient, plan: dict[str, Any], name: str) -> None:
        """One question, and how it went."""
        began = time.perf_counter()
        try:
            found = await client.post("/api/verdict", json={"plan": plan}, headers={"x-client": name})
        except httpx.HTTPError as error:
            self.statuses[type(error).__name__] += 1
            return
        self.statuses[str(found.status_code)] += 1
        if found.status_code == 200:
            self.seconds.append(time.perf_counter() - began)


def with_pitch(plan: dict[str, Any], dice: random.Random, digits: int) -> dict[str, Any]:
    """The plan with another pitch."""
    pitch = round(dice.uniform(*PITCHES), digits)
    return {**plan, "route": {**plan["route"], "pitch": pitch}}


async def person(
    number: int, client: httpx.AsyncClient, plan: dict[str, Any], tally: Tally, end: float, digits: int
) -> None:
    """Move the slider, rest, move it again, until the end."""
    dice = random.Random(number)
    asked: set[asyncio.Task[None]] = set()
    await asyncio.sleep(dice.uniform(0.0, REST[1]))
    while time.monotonic() < end:
        for _move in range(dice.randint(*MOVES)):
            moved = with_pitch(plan, dice, digits)
            task = asyncio.create_task(tally.ask(client, moved, f"person-{number}"))
            asked.add(task)
            task.add_done_callback(asked.discard)
            await asyncio.sleep(MOVE)
        await asyncio.gather(*asked)
        await asyncio.sleep(dice.uniform(*REST))


async def ready(client: httpx.AsyncClient) -> bool:
    """Whether all workers are."""
    queues = (await client.get("/healthz")).json()["workers"].values()
    return all(worker_queue["ready"] == worker_queue["workers"] for worker_queue in queues)


async def alone(client: httpx.AsyncClient, plan: dict[str, Any], digits: int) -> None:
    """One person who waits for each answer; how long those take."""
    tally, dice = Tally(), random.Random("alone")
    for _move in range(ALONE):
        await tally.ask(client, with_pitch(plan, dice, digits), "alone")
    print(f"alone: median {1e3 * statistics.median(tally.seconds):.0f} ms, {dict(tally.statuses)}")


async def load(base: str, clients: int, seconds: float, digits: int) -> Tally:
    """All of them at once."""
    plan = read_plan("spiral-in", ["disc.radius=4.5"]).data()
    tally = Tally()
    limits = httpx.Limits(max_connections=None, max_keepalive_connections=400)
    async with httpx.AsyncClient(base_url=base, timeout=120.0, limits=limits) as client:
        while not await ready(client):
            await asyncio.sleep(0.2)
        await alone(client, plan, digits)
        end = time.monotonic() + seconds
        await asyncio.gather(*(person(n, client, plan, tally, end, digits) for n in range(clients)))
    return tally


def main() -> int:
    """Serve, load, print; 1 if anything but answers and replaced questions came back."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--digits", type=int, default=9, help="of a pitch; 3: many are asked again")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    options = parser.parse_args()
    command = [
        sys.executable,
        "-m",
        "benchdragon",
        "--lang",
        "en",
        "studio",
        "--no-browser",
        "--port",
        "0",
    ]
    command += ["--workers", str(options.workers)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            base = (server.stdout.readline() if server.stdout else "").split(" at ")[1].split()[0]
            tally = asyncio.run(load(base, options.clients, options.seconds, options.digits))
        finally:
            server.terminate()
    good, replaced = tally.statuses.pop("200", 0), tally.statuses.pop(str(SUPERSEDED), 0)
    errors = tally.statuses.total()
    times = sorted(tally.seconds)
    print(f"{options.clients} clients, {options.seconds:g} s, {options.workers} workers,")
    print(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}\n")
    print("| answers | replaced by newer ones | errors | median (ms) | p95 (ms) | max (ms) |")
    print("|---:|---:|---:|---:|---:|---:|")
    at = [1e3 * one for one in (statistics.median(times), times[int(0.95 * len(times))], times[-1])]
    print(f"| {good} | {replaced} | {errors} | {at[0]:.0f} | {at[1]:.0f} | {at[2]:.0f} |")
    if errors:
        print(dict(tally.statuses))
    return int(errors > 0)


if __name__ == "__main__":
    sys.exit(main())
