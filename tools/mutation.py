"""Mutants that a tool makes: cosmic-ray's, of whole modules, and which of them no test sees.

`make mutation` tries those of `MODULES` (by default all kernels, proofs, certificates, the verdict),
each with the tests that fit the module: tests/ROOM/test_NAME.py, what tests/mutation/tests.toml adds,
and what rows of tests/mutants name for it. What was found stays in a session of cosmic-ray,
out/mutation/*.sqlite, so that a run that was broken off goes on where it was; a module that changed
begins anew. Of earlier runs, survivors without a reason are tried again. out/mutation/report.md lists,
room by room, what survives without a reason in tests/mutation/survivors.toml.

Why cosmic-ray, and why its operators are chosen from: `design/mutation_tools.py`.
"""

import ast
import hashlib
import json
import re
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tools import mutants  # noqa: E402

FOLDER = ROOT / "tests" / "mutation"
SESSIONS = ROOT / "out" / "mutation"
VERDICT = ("analysis/check.py", "analysis/findings.py", "analysis/certificate.py")
# One or two replacements of each operator: all twelve of a product, say, are seen by the same tests.
OPERATORS = re.compile(
    "core/(ReplaceBinaryOperator_(Add_Sub|Sub_Add|Mul_Div|Div_Mul|FloorDiv_Div|Mod_FloorDiv|Pow_Mul"
    "|BitAnd_BitOr|BitOr_BitAnd|LShift_RShift|RShift_LShift)"
    "|ReplaceComparisonOperator_(Lt_LtE|Lt_GtE|LtE_Lt|LtE_Gt|Gt_GtE|Gt_LtE|GtE_Gt|GtE_Lt|Eq_NotEq|NotEq_Eq"
    "|Is_IsNot|IsNot_Is)"
    "|ReplaceUnaryOperator_Delete_(USub|Not|Invert)|AddNot|ReplaceTrueWithFalse|ReplaceFalseWithTrue"
    "|ReplaceAndWithOr|ReplaceOrWithAnd|ReplaceBreakWithContinue|ReplaceContinueWithBreak|ExceptionReplacer"
    "|NumberReplacer|ZeroIterationForLoop)"
)
INVERSE = {ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.Gt: ast.LtE, ast.LtE: ast.Gt} | {
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is
}  # fmt: skip
# A mutant has so many times as long as the module's tests take without, and at least so long, s.
TIMES, LEAST = 5.0, 20.0
LATE = "no end"


@dataclass(frozen=True)
class Change:
    """What a mutant changes.

    Attributes:
        file: of the package.
        where: the function or class that the place stands in; empty outside of all.
        old: the lines there, without what they are indented by.
        new: what stands there in the mutant.
    """

    file: str
    where: str
    old: str
    new: str


class Shape(ast.NodeTransformer):
    """Leaves of a module what is to be held: no annotations and decorators; `not a < b` is `a >= b`."""

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        """A function without what it says of types and of how its parameters may be given."""
        given = node.args
        node.returns, node.decorator_list = None, []
        given.args = [*given.posonlyargs, *given.args, *given.kwonlyargs]
        given.posonlyargs, given.kwonlyargs = [], []
        given.defaults += [one for one in given.kw_defaults if one is not None]
        given.kw_defaults = []
        return self.generic_visit(node)

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        """A class without its decorators."""
        node.decorator_list = []
        return self.generic_visit(node)

    def visit_arg(self, node: ast.arg) -> ast.AST:
        """A parameter without its type."""
        node.annotation = None
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        """An assignment without its type."""
        node.annotation = ast.Constant(None)
        return self.generic_visit(node)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        """A comparison that is denied is the opposite one."""
        self.generic_visit(node)
        inner = node.operand
        if not (
            isinstance(node.op, ast.Not) and isinstance(inner, ast.Compare) and len(inner.ops) == 1
        ):
            return node
        inverse = INVERSE.get(type(inner.ops[0]))
        return ast.Compare(inner.left, [inverse()], inner.comparators) if inverse else node


def shape(text: str) -> str | None:
    """What decides how a module runs; None for what is no Python."""
    try:
        return ast.dump(Shape().visit(ast.parse(text)))
    except SyntaxError:
        return None


def changed(old: str, new: str) -> tuple[str, str]:
    """The lines in which two texts differ, each without what it is indented by."""
    one, other = old.splitlines(), new.splitlines()
    while one and other and one[0] == other[0]:
        del one[0], other[0]
    while one and other and one[-1] == other[-1]:
        del one[-1], other[-1]
    first, second = (" ".join(line.strip() for line in lines) for lines in (one, other))
    return first, second


def fitting(module: str) -> list[str]:
    """The tests of a module, from the folder `tests`."""
    room, _, name = module.rpartition("/")
    own = f"{room}/test_{name}"
    found = [own] if (ROOT / "tests" / own).exists() else []
    found += tomllib.loads((FOLDER / "tests.toml").read_text("utf-8")).get(module, [])
    found += [test for one in mutants.mutants() if one.file == module for test in one.tests]
    files = {test for test in found if "::" not in test}
    pages = ("planner/", "browser/", "cli/")  # slower than all others together
    kept = [one for one in found if one in files or one.partition("::")[0] not in files]
    return list(dict.fromkeys(one for one in kept if not one.startswith(pages)))


def reasons() -> dict[Change, str]:
    """Why each survivor that is known of survives."""
    tables = tomllib.loads((FOLDER / "survivors.toml").read_text("utf-8")).get("survivors", [])
    return {
        Change(table["file"], table["where"], old, new): table["why"]
        for table in tables
        for old, new in table["changes"]
    }


def chosen(words: Sequence[str]) -> list[str]:
    """The modules that are asked for; without words all that a tool is to mutate."""
    rooms = [
        str(path.relative_to(mutants.PACKAGE))
        for room in ("proofs", "kernels")
        for path in sorted((mutants.PACKAGE / room).glob("*.py"))
        if path.name != "__init__.py"
    ]
    found = list(words) or [*VERDICT, *rooms]
    for module in found:
        if not (mutants.PACKAGE / module).is_file():
            raise ValueError(f"no such module in {mutants.PACKAGE}: {module}")
    return found


def session_of(module: str) -> Path:
    """Where the session of a module, as it is, is kept."""
    text = (mutants.PACKAGE / module).read_bytes() + OPERATORS.pattern.encode()
    name = module.removesuffix(".py").replace("/", ".")
    return SESSIONS / f"{name}-{hashlib.sha256(text).hexdigest()[:12]}.sqlite"


def mutated(text: str, item: Any) -> str | None:
    """A module's text with a mutation of cosmic-ray; None where there is none."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    mutation = item.mutations[0]
    made: str | None = mutate_code(text, get_operator(mutation.operator_name)(), mutation.occurrence)
    return made


def begin(module: str, work: Any) -> None:
    """Put all mutants of a module into an empty session; what is not tried is skipped at once.

    That is: operators not chosen, annotations, what is no Python, and what another mutant does, too.
    """
    from cosmic_ray.commands import init
    from cosmic_ray.work_item import WorkerOutcome, WorkResult

    path = mutants.PACKAGE / module
    text = path.read_text("utf-8")
    init([path], work, {})
    seen, skipped = {shape(text), None}, []
    for item in sorted(work.work_items, key=order):
        wanted = OPERATORS.fullmatch(item.mutations[0].operator_name)
        made = shape(mutated(text, item) or "") if wanted else None
        skipped += [item.job_id] if made in seen else []
        seen.add(made)
    work.set_multiple_results(skipped, WorkResult(WorkerOutcome.SKIPPED))


def order(item: Any) -> tuple[tuple[int, int], str, int]:
    """Mutants go as their places stand in the module."""
    one = item.mutations[0]
    return one.start_pos, one.operator_name, one.occurrence


def change_of(module: str, item: Any) -> Change:
    """What a mutant of a session changes."""
    text = (mutants.PACKAGE / module).read_text("utf-8")
    return Change(
        module, item.mutations[0].definition_name or "", *changed(text, mutated(text, item) or "")
    )


def found_in(module: str) -> Iterator[tuple[Change, bool, str]]:
    """Of each mutant that was tried: what it changes, whether it survives, and what was said of it."""
    from cosmic_ray.work_db import WorkDB, use_db
    from cosmic_ray.work_item import TestOutcome, WorkerOutcome

    with use_db(str(session_of(module)), WorkDB.Mode.open) as work:
        for item, result in sorted(work.completed_work_items, key=lambda pair: order(pair[0])):
            if result.worker_outcome != WorkerOutcome.SKIPPED:
                survives = result.test_outcome == TestOutcome.SURVIVED
                yield change_of(module, item), survives, result.output or ""


def left(module: str, work: Any) -> list[Any]:
    """What is to be tried: what was not, and survivors without a reason."""
    from cosmic_ray.work_item import TestOutcome

    known = reasons()
    again = [
        item
        for item, result in work.completed_work_items
        if result.test_outcome == TestOutcome.SURVIVED and change_of(module, item) not in known
    ]
    return sorted([*work.pending_work_items, *again], key=order)


@dataclass(frozen=True)
class Trial:
    """How the mutants of a module are tried.

    Attributes:
        module: of the package.
        package: a copy of it, to be broken.
        sound: the module's text.
        tests: all that fit it, the quickest first.
        runs: the lines of the module that each runs.
        patience: how long all may take, s.
    """

    module: str
    package: Path
    sound: str
    tests: list[str]
    runs: dict[str, set[int]]
    patience: float

    @classmethod
    def of(cls, module: str, package: Path) -> "Trial":
        """Run the tests without any mutant first.

        Raises:
            ValueError: if no tests are known, or they fail.
        """
        if not (tests := fitting(module)):
            raise ValueError("no tests are known: name some in tests/mutation/tests.toml")
        began = time.monotonic()
        ending, said = mutants.run(tests, package, module.startswith(mutants.BUILT), seen=module)
        if ending != mutants.PASSED:
            raise ValueError(f"its tests do not pass without mutants\n{said}")
        patience = max(LEAST, TIMES * (time.monotonic() - began))
        found = json.loads(package.with_name(mutants.SEEN).read_text("utf-8"))
        runs = {test: set(lines) for test, _took, lines in sorted(found, key=lambda one: one[1])}
        return cls(module, package, (package / module).read_text("utf-8"), list(runs), runs, patience)

    def lives(self, broken: str, first: int, last: int) -> tuple[bool, str]:
        """Whether no test sees these lines broken, and what pytest says.

        The tests that run one of them go first, the quickest ahead; then all: some may take what
        another has computed.
        """
        lines = set(range(first, last + 1))
        near = [test for test in self.tests if lines & self.runs[test]]
        path, plain = self.package / self.module, self.module.startswith(mutants.BUILT)
        mutants.put(path, broken)
        try:
            for tests in filter(None, (near, self.tests if near != self.tests else [])):
                ending, said = mutants.run(tests, self.package, plain, self.patience)
                if ending != mutants.PASSED:
                    return False, said
        finally:
            mutants.put(path, self.sound)
        return True, said


def try_module(module: str, package: Path) -> None:
    """Try the mutants of a module that are left, on a copy of the package.

    Raises:
        ValueError: if no tests are known, or they fail without any mutant.
    """
    from cosmic_ray.work_db import WorkDB, use_db
    from cosmic_ray.work_item import TestOutcome, WorkerOutcome, WorkResult

    with use_db(str(session_of(module)), WorkDB.Mode.create) as work:
        if not work.num_work_items:
            begin(module, work)
        items = left(module, work)
        trial = Trial.of(module, package) if items else None
        for n, item in enumerate(items):
            assert trial is not None
            broken, place = mutated(trial.sound, item) or "", item.mutations[0]
            lives, said = trial.lives(broken, place.start_pos[0], place.end_pos[0])
            outcome = TestOutcome.SURVIVED if lives else TestOutcome.KILLED
            late = said if said.startswith(LATE) else None
            work.set_result(item.job_id, WorkResult(WorkerOutcome.NORMAL, late, outcome))
            old, new = changed(trial.sound, broken)
            told = f"{module} {n + 1}/{len(items)} {outcome.value}: {old} -> {new}"
            print(told, file=sys.stderr, flush=True)


def report(modules: Iterable[str]) -> tuple[str, int]:
    """What was found, room by room; and how many survive without a reason."""
    known, rooms, open_ = reasons(), dict[str, list[str]](), 0
    for module in modules:
        if not session_of(module).exists():
            continue
        found = list(found_in(module))
        alive = [change for change, survives, _said in found if survives]
        bare = [change for change in alive if change not in known]
        late = sum(said.startswith(LATE) for _change, _survives, said in found)
        open_ += len(bare)
        lines = rooms.setdefault(module.partition("/")[0], [])
        lines.append(
            f"* `{module}`: {len(found)} mutants tried, {len(found) - len(alive)} killed ({late} of"
            f" them by time), {len(alive) - len(bare)} survive with a reason, {len(bare)} without"
        )
        lines += [f"  * `{one.where}`: `{one.old}` -> `{one.new}`" for one in bare]
    text = "".join(f"## {room}\n\n" + "\n".join(lines) + "\n\n" for room, lines in rooms.items())
    return f"# Mutants that a tool made\n\n{text}", open_


def main(words: Sequence[str]) -> int:
    """Try the mutants of these modules, all without words; 1 if some survive without a reason."""
    SESSIONS.mkdir(parents=True, exist_ok=True)
    mutants.SERVER.set_forkserver_preload(mutants.SLOW)
    failed = False
    try:
        modules = chosen(words)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    try:
        with tempfile.TemporaryDirectory() as folder:
            package = mutants.copied(Path(folder))
            for module in modules:
                try:
                    try_module(module, package)
                except ValueError as error:
                    failed = True
                    print(f"{module}: {error}", file=sys.stderr)
    finally:
        text, open_ = report(modules)
        whole = SESSIONS / "report.md.part"
        whole.write_text(text, "utf-8")
        whole.replace(SESSIONS / "report.md")
        print(text)
    return 2 if failed else int(open_ > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
