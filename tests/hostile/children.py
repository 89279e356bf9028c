"""Questions about strangers' plans, each in a child process: what came of it, and what it took."""

import contextlib
import gc
import io
import json
import os
import resource
import signal
import tempfile
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchdragon import budget
from benchdragon.cli.main import run

# A plan that all of them answer.
GOOD = 'base = "turn"\nschema = 1\n[dragon]\nbenches = 20\n[limits]\nspeed = 2\n'
# Each is asked of some of the plans; the first of all.
QUESTIONS = (
    "check PLAN --json", "solve pitch PLAN --json", "solve width PLAN --json",
    "solve length PLAN --json", "solve disc PLAN --json", "solve speed PLAN --json",
    "solve speed PLAN --json --pace -o OUT/b.dragon.toml", "solve turn PLAN --json",
    "timetable PLAN --json", "check PLAN --explain", "plan PLAN",
    "sheets PLAN -o OUT/papers.html", "view PLAN -o OUT/a.html", "motion PLAN --json",
    "margins PLAN --json --aside 0.02 --stray 0.02 --draws 2 -j 1",
)  # fmt: skip
# A question that takes longer than this is taken to be endless, CPU s.
ENDLESS = 300
# What a process comes to hold beside the tables of its question, bytes.
BESIDE = 500_000_000
ANSWERED, NOT_SAFE, WRONG, PLAN_WRONG, NO_SOLUTION, UNDECIDED = range(6)


@dataclass(frozen=True)
class Outcome:
    """What a command came to.

    Attributes:
        code: its exit code; None where it ended otherwise, as `fault` says.
        fault: what must not be; "" where all is well.
        over: whether it was refused as too much work or memory.
        seconds: of the CPU.
        memory: the most that it held beyond what it began with, which other tests may have left, bytes.
    """

    code: int | None
    fault: str
    over: bool
    seconds: float
    memory: int


def load() -> None:
    """Import what questions call, so that no child has to."""
    for question in QUESTIONS:
        with tempfile.TemporaryDirectory() as folder:
            _answer(Path(folder), GOOD, question)
    gc.freeze()  # or each child copies what the collector looks at


def asked(text: str, question: str, share: float) -> Outcome:
    """What comes of a question about the plan of a text, with so large a share of the budget."""
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        os.close(reading)
        with os.fdopen(writing, "w", encoding="utf-8") as told:
            print(_held(resource.getrusage(resource.RUSAGE_SELF)), file=told, flush=True)
            json.dump(_guarded(text, question, share), told)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading, encoding="utf-8") as told:
        began, said = int(told.readline()), told.read()
    _pid, status, used = os.wait4(child, 0)
    took = used.ru_utime + used.ru_stime, _held(used) - began
    if not said:
        return Outcome(None, f"killed: {signal.Signals(os.WTERMSIG(status)).name}", False, *took)
    code, fault, over = json.loads(said)
    most = share * budget.MEMORY + BESIDE
    if took[1] > most:
        fault = fault or f"it took {took[1] / 1e6:.0f} MB, where {most / 1e6:.0f} MB are stated"
    return Outcome(code, fault, over, *took)


def _held(used: resource.struct_rusage) -> int:
    """The most memory that a process held, bytes."""
    return used.ru_maxrss * 1024


def _guarded(text: str, question: str, share: float) -> tuple[int | None, str, bool]:
    resource.setrlimit(resource.RLIMIT_CPU, (ENDLESS, ENDLESS + 1))
    os.environ[budget.VARIABLE] = f"{share:g}"
    try:
        with tempfile.TemporaryDirectory() as folder:
            return _answer(Path(folder), text, question)
    except BaseException:
        return None, traceback.format_exc()[-1500:], False


def _answer(folder: Path, text: str, question: str) -> tuple[int | None, str, bool]:
    path = folder / "a.dragon.toml"
    path.write_text(text, encoding="utf-8", errors="replace")
    code, out, err = 0, io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        for command in question.replace("PLAN", str(path)).replace("OUT", str(folder)).split(";"):
            code = run([*command.split(), "--quiet"])
            if code > NOT_SAFE:
                break
    return code, fault_of(code, out.getvalue(), err.getvalue()), budget.VARIABLE in err.getvalue()


def fault_of(code: int, out: str, err: str) -> str:
    """What is wrong with an answer; "" if nothing is."""
    if "Traceback" in err or code not in range(6):
        return f"exit {code}: {err[-1500:]}"
    if code in (WRONG, PLAN_WRONG) and not err:
        return f"exit {code} without a word"
    if len(err) > 20_000:
        return f"{len(err)} signs on standard error"
    if out.startswith("{"):
        try:
            said = json.loads(out, parse_constant=_none)
        except ValueError as error:
            return f"no JSON: {error}"
        return _unsound(said)
    return ""


def _none(name: str) -> Any:
    raise ValueError(name)


def _unsound(answer: Any, name: str = "") -> str:
    """The part of an answer that says to be found and has no value; "" if there is none.

    Only a clearance may be infinite, which JSON has no word for either: then it has no upper end.
    """
    if isinstance(answer, list):
        return next((fault for fault in map(_unsound, answer) if fault), "")
    if not isinstance(answer, dict):
        return ""
    infinite = name == "clearance" and answer.get("upper", 0) is None
    good = answer.get("status") in ("found", "proved")
    if good and answer.get("value", 0) is None and not infinite:
        return f"{answer['status']} without a value"
    return next((fault for key, one in answer.items() if (fault := _unsound(one, key))), "")


def tried(
    seeds: Iterable[int], plans: Callable[[int], str], share: float
) -> Iterator[tuple[int, str, Outcome]]:
    """For each seed its questions, and what came of them."""
    for seed in seeds:
        text = plans(seed)
        for question in questions_of(seed):
            yield seed, question, asked(text, question, share)


def questions_of(seed: int) -> tuple[str, str]:
    """What is asked about the plan of a seed: a check, and one more by turns."""
    return QUESTIONS[0], QUESTIONS[1 + seed % (len(QUESTIONS) - 1)]
