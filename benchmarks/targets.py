"""How long the contest's questions may take, and whether they keep to it: one process, warm.

Where scripts for the contest have a way of their own, it takes turns with ours as a rival.
"""

from collections.abc import Callable
from dataclasses import dataclass

from questions import DISC, QUESTIONS
from standard import against_c
from textbook import Stepped
from textbook import smallest_pitch as textbook_pitch
from timing import LEAST, Job, Options, digits, fastest, lines_of, repeats_of

from benchdragon import read_plan

# Pitches, m, between which the textbook looks, and how near it comes.
BETWEEN, PITCH_STEP, QUICK_STEP = (0.44, 0.46), 1e-4, 1e-2


@dataclass(frozen=True)
class Target:
    """How long a question may take, ms, and what else answers it."""

    milliseconds: float
    rival: str = ""
    job: Callable[[Options], Job] | None = None


def stepped_contact(_options: Options) -> Job:
    """The textbook's way to the first contact."""
    walk = read_plan("spiral-in").build()
    return lambda: Stepped(walk).first_contact(0.0, 430.0, 1.0, 1e-9)


def stepped_pitch(options: Options) -> Job:
    """The textbook's way to the smallest pitch."""
    disc = read_plan("spiral-in", [DISC])
    return lambda: textbook_pitch(disc, *BETWEEN, 1.0, QUICK_STEP if options.quick else PITCH_STEP)


TARGETS = {
    "first contact, 223 benches": Target(
        5.0, "textbook: each second, bisection to 1e-9 s", stepped_contact
    ),
    "smallest pitch, disc of 4.5 m": Target(
        10.0, "textbook: each second, bisection to 1e-4 m", stepped_pitch
    ),
    "greatest head speed of the turn": Target(20.0),
    "least clearance of the turn": Target(20.0),
    "the contest's five questions": Target(500.0),
    "first contact, 100,000 benches": Target(1000.0),
}
# The compiled march of the standard table may take so many times as long as the best C.
TIMES_C = 1.5


def targets(options: Options) -> list[str]:
    """Rows of all targets."""
    rows = [timed(name, target, options) for name, target in TARGETS.items()]
    c, name = against_c(options), "march of the standard table, 224 handles x 301 times"
    rows.append(row(name, 1e3 * c.ours, TIMES_C * 1e3 * c.best, f"C, {c.way}", 1e3 * c.best))
    columns = ("question", "ms", "target, ms", "met", "rival", "rival, ms", "rival / ours")
    return [
        "Warm, in one process, the least of several; plans are read beforehand, walks are made anew "
        "each time. The contest's five questions: the first part each second; the first contact, and "
        "the dragon then; the smallest pitch; the turn each second and its least clearance; the "
        f"greatest head speed. The target of the march is {TIMES_C:g} times what the best C takes.",
        "",
        *lines_of(columns, rows),
        "",
        "Why four take longer than was aimed at: a first contact is a walk of the whole dance in "
        "steps that no contact can slip through, and nearly all of its time goes to placing "
        "handles; a smallest pitch is two such walks, one that fails and one that does not, and "
        "some parts of others; a least clearance is looked for twice, once roughly in cells and "
        "once by placing the dragon near each low point; the march carries each angle in two "
        "doubles and the ratio of speeds besides, which the march in C does not.",
    ]


def timed(name: str, target: Target, options: Options) -> list[str]:
    """A row: one question, beside its rival if it has one."""
    job = QUESTIONS[name]()
    job()
    (once,) = fastest([job], 1)
    (ours,) = fastest([job], repeats_of(once, options))
    if target.job is None:
        return row(name, 1e3 * ours, target.milliseconds)
    beside, theirs = fastest([job, target.job(options)], 1 if options.quick else LEAST)
    ours = min(ours, beside)
    return row(name, 1e3 * ours, target.milliseconds, target.rival, 1e3 * theirs)


def row(
    name: str, ours: float, target: float, rival: str = "", theirs: float | None = None
) -> list[str]:
    """A row of the table; times in ms."""
    met = "yes" if ours <= target else "NO"
    ratio = None if theirs is None else theirs / ours
    return [name, digits(ours), digits(target), met, rival, digits(theirs), digits(ratio)]
