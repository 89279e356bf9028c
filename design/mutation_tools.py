"""Which tool makes mutants of kernels and proofs, and how they are tried.

mutmut 3 puts all variants of a function beside it, behind a function that chooses one, and tries each
in a forked process: little time a mutant, and it learns by itself which tests run which function. But
it leaves alone what has a decorator other than `staticmethod` and `classmethod` (see
`_skip_node_and_children` of its `mutation/file_mutation.py`). Every kernel has one, `@kernel` or
`@entry`, and so has `check`: of kernels/separation_bounds.py it makes no mutant, of
kernels/time_of_impact.py 80, all of one function of 20. Where it works it mutates texts and arguments,
too: 855 mutants of check.py. It is no choice for kernels, and two tools would be two lists.

cosmic-ray changes the text of a module, whatever stands there, and keeps what it found in a session
that can be gone on with. What it lacks is made here, by `tools/mutation.py`:

* It replaces each operator by all others: of a product eleven mutants, which the same tests see. One or
  two of each are chosen; annotations (`float | None`) and decorators are left alone, and of mutants
  that run alike one is tried: of 728 of proofs/meeting.py, 208.
* Its own way to run tests is one command for all modules, in place: a pytest that imports everything
  anew, on the working tree. Here a copy of the package is broken, and a process forked from one that
  has imported NumPy, SciPy and pytest already runs the tests that fit the module; those first that run
  the changed line, the quickest ahead.

This page prints, for some modules, how many functions have a decorator, how many mutants each tool
makes, and how many are tried; and how many seconds a mutant takes either way: with cosmic-ray 8.7.0 and
mutmut 3.8.1, 1.0 s a mutant of proofs/meeting.py by a pytest for each, 0.43 s forked.

Others are no longer kept: mutatest (2022), MutPy (2019).
"""

import ast
import importlib.util
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tools import mutants, mutation  # noqa: E402

MODULES = [
    *mutation.VERDICT, "proofs/apart.py", "proofs/cells.py", "proofs/meeting.py",
    "kernels/separation_bounds.py", "kernels/time_of_impact.py",
]  # fmt: skip
SAMPLE, TRIED = "proofs/meeting.py", 8


def decorated(text: str) -> tuple[int, int]:
    """How many functions of a module have a decorator, of how many."""
    found = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
    return sum(bool(node.decorator_list) for node in found), len(found)


def of_mutmut(text: str) -> str:
    """How many mutants mutmut makes of a module."""
    if importlib.util.find_spec("mutmut") is None:
        return "(not here)"
    from mutmut.mutation.file_mutation import create_mutations

    return str(len(create_mutations("module.py", text)[1]))


def of_cosmic_ray(module: str, folder: Path) -> tuple[int, int]:
    """How many mutants cosmic-ray makes of a module, and how many of these are tried."""
    from cosmic_ray.work_db import WorkDB, use_db

    with use_db(str(folder / f"{module.replace('/', '.')}.sqlite"), WorkDB.Mode.create) as work:
        mutation.begin(module, work)
        return work.num_work_items, len(work.pending_work_items)


def timed(package: Path) -> tuple[float, float]:
    """Seconds a mutant, with a new pytest for each, and as it is done here, for the first mutants."""
    from cosmic_ray.work_db import WorkDB, use_db

    trial = mutation.Trial.of(SAMPLE, package)
    with use_db(str(package.parent / "timed.sqlite"), WorkDB.Mode.create) as work:
        mutation.begin(SAMPLE, work)
        items = mutation.left(SAMPLE, work)[:TRIED]
    path, tests = package / SAMPLE, [f"tests/{test}" for test in mutation.fitting(SAMPLE)]
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    times = [0.0, 0.0]
    for item in items:
        broken, place = mutation.mutated(trial.sound, item) or "", item.mutations[0]
        began = time.perf_counter()
        mutants.put(path, broken)
        environment = {"PYTHONPATH": str(package.parent), "PATH": ""}
        anew = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, check=False)
        times[0] += time.perf_counter() - began
        mutants.put(path, trial.sound)
        began = time.perf_counter()
        lives, _said = trial.lives(broken, place.start_pos[0], place.end_pos[0])
        times[1] += time.perf_counter() - began
        assert lives == (anew.returncode == 0), (item, anew.stdout)
    return times[0] / len(items), times[1] / len(items)


def main() -> None:
    """Print what each tool makes of these modules, and how long a mutant takes."""
    mutants.SERVER.set_forkserver_preload(mutants.SLOW)
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'module':30} decorated  mutmut  cosmic-ray  tried")
        for module in MODULES:
            text = (mutants.PACKAGE / module).read_text("utf-8")
            some, all_ = decorated(text)
            made, tried = of_cosmic_ray(module, Path(folder))
            print(f"{module:30} {some:3} of {all_:3} {of_mutmut(text):>7} {made:11} {tried:6}")
        anew, forked = timed(mutants.copied(Path(folder)))
    print(f"{TRIED} mutants of {SAMPLE}, s each: a pytest for each {anew:.2f}, forked {forked:.2f}")


if __name__ == "__main__":
    main()
