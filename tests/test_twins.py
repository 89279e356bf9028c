"""web/made holds what the Python modules say; what is not translated is an error."""

import ast
import json
import random
import re
import subprocess
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, ClassVar

import numpy as np
import pytest
from tools.make_twins import FOLDER
from tools.translation.expressions import ASKED
from tools.translation.names import FUNCTIONS, METHODS, OF_MODULES, UntranslatableError, camel
from tools.translation.patterns import javascript
from tools.translation.statements import Code

from benchdragon import SpeedProfile
from benchdragon.analysis.contact_search import REFINING
from benchdragon.kernels.random_numbers import draw_normals
from tests.engine.recording import MODULE, node

# What a function gives in both languages, where they differ: what is true, equal, within; places from
# the end; signs beyond 16 bits; formats; order; sets of pairs; generators; names that a loop keeps.
CODE = """
def answer():
    def numbers(limit):
        for n in range(limit):
            if n % 2:
                continue
            yield n

    pairs = {(1, 2): "a", (3, 4): "b"}
    seen = {(n, n + 1) for n in range(3)} | {(1, 2)}
    name, *rest = "𠮷野家"
    found = [n for word in ("a1", "b22") if (n := len(word)) > 2]
    total, left = 0, [3, 1, 2]
    while left:
        total += left.pop()
    text = "{low} to {high}"
    return [
        bool([]), bool(""), bool(0.0), bool({}), bool("0"), [1, [2]] == [1, [2]], (1, 2) in pairs,
        pairs[(3, 4)], pairs.get((9, 9), "none"), len(seen), len(set("aab")), name, rest, "𠮷野家"[-1],
        "𠮷野家"[1:],
        found, total, list(numbers(7)), text.format(low=f"{2.675:.2f}", high=f"{1e-7:g}"),
        f"{255:04X}{-7 % 5}",
        sorted([(2, "b"), (1, "z"), (2, "a")]), max(["bb", "a", "cc"], key=len), max([], default="-"),
        min([3, 1, 2]), min(2, 1),
        " a  b ".split(), "a,b,c".partition(","), ["" or "x", 0 or None, [] and 1], round(2.5),
        round(0.125, 2),
        any(n > 5 for n in numbers(9)), all(n < 5 for n in numbers(9)), [*zip("ab", [1, 2])], -7 // 2,
        [1] + [2], "a" * 3, not found, 1 if rest else 2, dict.fromkeys("aab", 1) == {"a": 1, "b": 1},
        "x" not in "abc", 1 < 2 <= 2, divmod(7, 2), repr("it's"), "Ab".lower().upper(),
        "a\\tb\\nc".splitlines(), "a/b/c".replace("/", "-"), "--a-b--".strip("-"), "  ".strip(),
    ]
"""
# Records: what a class shares with its records, one that is built on another, what is made once, and
# numbers that are checked when a record is made.
RECORDS = """
@dataclass
class Shape:
    called: ClassVar[str]

    @classmethod
    def of(cls, said):
        return cls(*[said.get(name) or default for name, default in cls.defaults()])

    def size(self):
        raise NotImplementedError

@dataclass
class Disc(Shape):
    called: ClassVar[str] = "a disc"
    radius: float = 2.0
    made: int = 0

    def __post_init__(self):
        if self.radius < 0.0:
            object.__setattr__(self, "radius", getattr(self, "least", 0.5))

    @staticmethod
    def defaults():
        return [("radius", 3.0), ("made", 0)]

    def size(self):
        self.made += 1
        return self.radius * self.radius

    @cached_property
    def area(self):
        return 3.0 * self.size()

@dataclass
class Ring(Disc):
    def size(self):
        return super().size() - 1.0

def scaled(share):
    return 10 * share

def told():
    disc, ring = Disc(-1.0), Ring.of({"radius": 4.0})
    later, shares = [partial(one.size) for one in (disc, ring)], []
    for share in (1, 2):
        shares.append(partial(scaled, share))
    known = [disc.area, disc.area, disc.made, ring.area, [one.called for one in (disc, ring)]]
    ring.__dict__["area"] = 7.0
    known += [one() for one in shares]
    return [*known, ring.area, [one() for one in later], disc.made, Disc().radius]
"""
PATTERNS = (
    r"(?P<a>\d+)\s*(?:km|m)?", r"[\]\-a\s]+", r"a.c$", r"^x{2,3}y{,2}\Z", r"(?<=\S)-(?=\w)",
    r"[^\n\"']*'",
)  # fmt: skip
TEXTS = ("12 km", "٣m", "]-a\x85", "abc", "a\nc", "abc\n", "xxyy", "xxx", "é-é", " -b", "it's", 'say "')


def run(script: str) -> Any:
    """What a script writes, as JSON."""
    done = subprocess.run(
        [str(node()), "--input-type=module", "-e", script], capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout)


def made(path: str) -> str:
    """The address of a module of the page."""
    return (FOLDER.parent / path).as_uri()


@pytest.mark.skipif(node() is None, reason="no Node here")
def test_what_is_translated_answers_as_in_python() -> None:
    here: dict[str, Any] = {}
    exec(CODE, here)
    (function,) = ast.parse(CODE).body
    said = Code(lambda _name: None, lambda _name: None, lambda pattern, _flags: pattern).block(
        [function]
    )
    imports = f'import {{ py }} from "{made("compute/python.js")}";'
    there = run(f"{imports}\n{said}\nconsole.log(JSON.stringify(answer()));")
    assert there == json.loads(json.dumps(here["answer"]()))


@pytest.mark.skipif(node() is None, reason="no Node here")
def test_records_are_translated_with_what_they_are_built_on() -> None:
    here: dict[str, Any] = {
        "dataclass": dataclass, "ClassVar": ClassVar, "cached_property": cached_property,
        "partial": partial,
    }  # fmt: skip
    exec(RECORDS, here)
    code = Code(
        lambda name: [] if name.startswith(".") else None,
        lambda _name: None,
        lambda pattern, _flags: pattern,
    )
    code.kind = here.get
    *records, other, function = ast.parse(RECORDS).body
    said = [code.record(one) for one in records if isinstance(one, ast.ClassDef)]
    said += [code.function(one) for one in (other, function) if isinstance(one, ast.FunctionDef)]
    imports = f'import {{ py }} from "{made("compute/python.js")}";'
    there = run("\n".join([imports, *said, "console.log(JSON.stringify(told()));"]))
    assert there == here["told"]()


@pytest.mark.parametrize(
    "code",
    ["class A:\n @classmethod\n def f(cls): return 1\n def g(self): return self.f()",
     "class A:\n @other\n def f(self): return 1", "class A(B, C):\n x: int",
     "class A(B):\n x: int"],
)  # fmt: skip
def test_records_that_pages_could_not_have_are_an_error(code: str) -> None:
    class Both:
        def size(self) -> int:
            return 1

    known = Code(
        lambda name: ["y", "x"] if name == "A" else None,
        lambda _name: None,
        lambda pattern, _flags: pattern,
    )
    known.kind = lambda name: Both if name in ("B", "C") else None
    (node,) = ast.parse(code).body
    assert isinstance(node, ast.ClassDef)
    with pytest.raises(UntranslatableError):
        known.record(node)


@pytest.mark.skipif(node() is None, reason="no Node here")
def test_patterns_match_the_same() -> None:
    asked = [(javascript(one), text) for one in PATTERNS for text in TEXTS]
    imports = f'import {{ py }} from "{made("compute/python.js")}";'
    there = run(
        f"{imports}\nconst all = {json.dumps(asked)};\n"
        "console.log(JSON.stringify(all.map(([one, text]) => "
        '[py.pattern(one, "").findall(text), py.pattern(one, "").fullmatch(text) !== null])));'
    )
    here = [
        [re.findall(one, text), re.fullmatch(one, text) is not None]
        for one in PATTERNS
        for text in TEXTS
    ]
    assert there == here


@pytest.mark.parametrize(
    "code",
    ["import os", "with open(x) as y: pass", "with open(x): pass",
     "for n in x: pass\nelse: pass", "lambda *a: a", "f(**x)",
     "x.rjust(2)", "sorted(*x, reverse=True)",
     "x[::2]", "*a, b = x", "x @ y",
     "async def f(): pass", 're.sub(x, "", y)', '"{}".format(1)', "f(b=1)"],
)  # fmt: skip
def test_what_is_not_translated_is_an_error(code: str) -> None:
    with pytest.raises(UntranslatableError):
        Code(lambda _name: None, lambda _name: None, lambda pattern, _flags: pattern).block(
            ast.parse(code).body
        )


@pytest.mark.parametrize(
    "code",
    ["def f(x):\n return [wait(one) for one in x]", "f = lambda: wait(1)", "wait(1)",
     "def f():\n return Plain(a=1)", "def f():\n return Plain(a=1, b=2, c=3)"],
)  # fmt: skip
def test_nothing_waits_where_it_cannot_and_no_record_lacks_a_key(code: str) -> None:
    said = Code(
        lambda _name: None, lambda _name: None, lambda pattern, _flags: pattern,
        plain=lambda name: {"a": (None, ""), "b": (None, "")} if name == "Plain" else None,
        waits=lambda name: "made" if name == "wait" else "",
    )  # fmt: skip
    with pytest.raises(UntranslatableError):
        said.block(ast.parse(code).body)
    sound = "def f(x):\n return Plain(b=wait(x, 1), a=0)"
    there = said.block(ast.parse(sound).body)
    assert "async function f(x)" in there
    assert "({ a: 0, b: (await wait(x, 1)) })" in there


@pytest.mark.parametrize(
    ("name", "said"),
    [("bench_text", "benchText"), ("_of_all", "_ofAll"), ("MOST_ROWS", "MOST_ROWS"),
     ("Roster", "Roster"), ("_", "_"), ("new", "new_"), ("N_", "N_")],
)  # fmt: skip
def test_names_are_those_of_javascript(name: str, said: str) -> None:
    assert camel(name) == said


@pytest.mark.skipif(node() is None, reason="no Node here")
def test_profiles_of_pages_tell_the_same_numbers() -> None:
    dice = random.Random(7)
    asked: list[Any] = []
    here: list[list[float]] = []
    for _profile in range(200):
        times = sorted({dice.choice([0.0, dice.uniform(-50.0, 90.0)]) for _knot in range(5)})
        speeds = [dice.choice([0.0, dice.uniform(0.0, 3.0)]) for _knot in times]
        profile = SpeedProfile(tuple(times), tuple(speeds))
        t = dice.choice([*times, dice.uniform(-90.0, 120.0)])
        way = dice.choice([float(profile.distance(t)), dice.uniform(-50.0, 50.0)])
        asked.append((times, speeds, t, way))
        past = profile.past(t, (way, 1e-20))
        found: list[Any] = [
            profile.speed(t), profile.acceleration(t), profile.distance(t), profile.time(way),
        ]  # fmt: skip
        here.append([*map(float, found), (past > 0) - (past < 0)])
    there = run(
        f'import {{ SpeedProfile }} from "{made("made/profile.js")}";\n'
        f'import "{made("compute/arrays.js")}";\n'
        f"const asked = {json.dumps(asked)};\nconst told = asked.map(([times, speeds, t, way]) => {{\n"
        "const one = new SpeedProfile(times, speeds), past = one.past(t, [way, 1e-20]);\n"
        "const found = [one.speed(t), one.acceleration(t), one.distance(t), one.time(way)];\n"
        "return [...found.map(String), past > 0 ? 1 : past < 0 ? -1 : 0];\n});\n"
        "console.log(JSON.stringify(told));"
    )
    assert [[*map(float, one)] for one in there] == here


@pytest.mark.skipif(node() is None, reason="no Node here")
def test_what_translations_may_ask_of_python_is_there_and_asked_for() -> None:
    there = set(
        run(
            f'import {{ py }} from "{made("compute/python.js")}";'
            f'import "{made("compute/arrays.js")}";'
            "console.log(JSON.stringify(Object.keys(py)));"
        )
    )
    assert {*FUNCTIONS - {"set"}, *METHODS, *OF_MODULES.values(), *ASKED.values()} <= there
    said = [
        path.read_text("utf-8") for path in [*FOLDER.iterdir(), FOLDER.parent / "compute/python.js"]
    ]
    own = {"union"}  # of what CODE above tries
    assert there - own <= set(re.findall(r"\bpy\.(\w+)", "".join(said)))


def test_no_file_is_made_that_nobody_asks_for() -> None:
    pages = [path.read_text("utf-8") for path in FOLDER.parent.rglob("*.js")]
    asked = {name for text in pages for name in re.findall(r'/(\w+)\.js"', text)}
    assert {path.stem for path in FOLDER.iterdir()} <= asked


@pytest.mark.skipif(node() is None, reason="no Node here")
def test_lists_of_numbers_hold_what_an_entry_of_the_engine_leaves_there() -> None:
    """Lists, those in groups of groups, and what an entry leaves in a list."""
    drawn = np.empty(3)
    draw_normals(7, 2, 1, drawn)
    there = run(
        'import { readFileSync } from "node:fs";\n'
        f'const {{ Engine }} = await import("{made("engine.js")}");\n'
        f'const {{ withArenaAsync }} = await import("{made("compute/arena.js")}");\n'
        f'await import("{made("compute/arrays.js")}");\n'
        f'const {{ py }} = await import("{made("compute/python.js")}");\n'
        f"const engine = await Engine.load(readFileSync({json.dumps(str(MODULE))}));\n"
        "const found = await withArenaAsync(engine, async () => {\n"
        "const own = py.array([0, 0, 0]), named = py.array([1, 2], 'q');\n"
        'py.entry("bd_random_numbers_draw_normals", 7, 2, 1, own);\n'
        "const rows = py.reshape(py.array([1, 2, 3, 4]), -1, 2);\n"
        "py.set(rows, [1, 0], 9);\n"
        "return [py.tolist(own), py.tolist(named), py.tolist(py.slice(rows, 1, null)),\n"
        "py.at(rows, -1), py.tolist(py.full([2, 1], -1, 'q'))];\n});\n"
        "console.log(JSON.stringify(found));"
    )
    assert there == [drawn.tolist(), [1, 2], [[9, 4]], [9, 4], [[-1], [-1]]]


@pytest.mark.skipif(node() is None, reason="no Node here")
def test_refining_takes_its_share_of_the_work_of_a_question_and_no_more() -> None:
    there = run(
        f'import {{ left, question, refined, spend }} from "{made("compute/budget.js")}";\n'
        "const found = await question(async () => {\n"
        "const caught = refined(0), share = left();\n"
        "try { spend(share + 1); } catch (error) { caught(error); }\n"
        "caught.ended();\n"
        "let other = '';\n"
        "try { refined(1)(new TypeError('wrong')); } catch (error) { other = error.message; }\n"
        "return [share, other];\n}, 1, { work: 1000 });\n"
        "const after = await question(async () => {\n"
        "refined(1).ended();\nreturn left();\n}, 1, { work: 1000 });\n"
        "console.log(JSON.stringify([...found, after]));"
    )
    assert there == [REFINING * 1000.0, "wrong", 1000.0]
