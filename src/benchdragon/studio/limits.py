"""How a studio is set up, and every limit it keeps, with its reason: the one place for both."""

import os
from dataclasses import dataclass, field

from benchdragon.errors import InputError
from benchdragon.i18n import _

MEGABYTE = 1_000_000


def _cores() -> int:
    return max(1, min(os.cpu_count() or 1, 8))


@dataclass(frozen=True)
class PlanLimits:
    """What a studio's plan may ask for; the command line takes far larger ones.

    Attributes:
        benches: a little more than the longest dragon reported (Huayuan, 3,500); a verdict on it
            still comes within the time limits.
        parts: pieces of a route; more cannot be edited on a screen.
        profile: points of the head's speed over time; likewise.
        largest: of any number in a plan (m, s, degrees ...): beyond it squares lose their digits.
        smallest: of any number but 0: below it quotients overflow.
    """

    benches: int = 3_500
    parts: int = 200
    profile: int = 500
    largest: float = 1e6
    smallest: float = 1e-6


@dataclass(frozen=True)
class Settings:
    """A studio: where it listens, how many compute, what it bears.

    Attributes:
        host: address to listen at; loopback, so that nobody else gets in unasked.
        port: 0 takes any that is free.
        names: further host names by which it may be called, beside loopback's and `host`.
        workers: processes for quick answers; files and long questions have one each beside them.
        plans: limits of plans.
        body: bytes of a request; a plan of `plans.parts` parts and 3,500 benches of their own sizes,
            repeated by count, needs a tenth of it.
        drain: bytes of a request too large that are still taken, and thrown away, so that the caller
            hears the sentence and not of a broken connection.
        depth: of brackets in a request; a plan has 6.
        body_seconds: a request must have come whole by then, lest idle ones hold their place.
        places: handles times times of an exported motion: 10 s of writing a spreadsheet or so. Where a
            walk has more, files hold fewer times.
        connections: open at once; beyond, the server turns callers away before it reads anything.
        queue: requests that may wait for quick answers or files; at a tenth of a second each the last
            waits some seconds.
        wait_seconds: a request that has waited so long is told to come back.
        seconds: run time of each kind of question; the worker is then replaced.
        abandoned_seconds: a question whose client is gone may run on for so long, since a new worker
            takes some seconds to start; then it is stopped, and its worker replaced.
        jobs: long questions that may wait; each may run for minutes.
        jobs_each: of one client, waiting or running, so that nobody fills the queue alone.
        kept_jobs: ended jobs whose results can still be fetched; a result is some 100 KB at most.
        kept_seconds: for so long.
        draws: random dances of a question for margins: 1,000 tell a chance to 3 %.
        cache: bytes of answers kept.
        memory: bytes that a worker may take beyond those it has when warm, lest the machine suffer.
        grace: seconds that running questions get when the studio closes.
        spawns: workers that may die in a row before they are ready; then those who ask are told.
        respawn_seconds: until it is then tried again, over and over: what killed them may be gone.
    """

    host: str = "127.0.0.1"
    port: int = 8000
    names: tuple[str, ...] = ()
    workers: int = field(default_factory=_cores)
    plans: PlanLimits = PlanLimits()
    body: int = 256 * 1024
    drain: int = 16 * MEGABYTE
    depth: int = 32
    body_seconds: float = 20.0
    places: int = 400_000
    connections: int = 512
    queue: int = 128
    wait_seconds: float = 30.0
    seconds: tuple[tuple[str, float], ...] = (
        ("open", 5.0), ("toml", 5.0), ("verdict", 60.0), ("limit", 60.0), ("dance", 60.0),
        ("export", 120.0), ("job", 900.0),
    )  # fmt: skip
    abandoned_seconds: float = 3.0
    jobs: int = 8
    jobs_each: int = 2
    kept_jobs: int = 64
    kept_seconds: float = 600.0
    draws: int = 1_000
    cache: int = 32 * MEGABYTE
    memory: int = 2_000 * MEGABYTE
    grace: float = 3.0
    spawns: int = 3
    respawn_seconds: float = 5.0

    def time_limit(self, kind: str) -> float:
        """Seconds that a question of this kind ("limit/pitch" is of the kind "limit") may run."""
        return dict(self.seconds)[kind.partition("/")[0]]


def too_much(wanted: str, most: object, came: object) -> InputError:
    """What to say where a studio bears less than the command line."""
    return InputError(
        _("the studio takes at most {most} {wanted}, not {came}: use the command line").format(
            wanted=wanted, most=most, came=came
        )
    )
