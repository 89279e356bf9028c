"""Every option of every verb has an effect, or is refused: each is given, and the outcome compared."""

import re
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import benchdragon.analysis.check
import benchdragon.cli.console
import benchdragon.cli.doctor
import benchdragon.model.placement
import benchdragon.paper.reproduce
import benchdragon.parallel
import benchdragon.solve.turn
import benchdragon.sweeps.rows
from benchdragon.__main__ import asked_language
from benchdragon.cli.main import run
from benchdragon.errors import InputError
from benchdragon.i18n import spoken_in
from benchdragon.model.answer import Answer
from benchdragon.parallel import Place, threads
from benchdragon.plans.routes import TurnRoute
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.solve.turn import BestTurn
from benchdragon.solve.turn_goal import TurnGoal
from benchdragon.sweeps.questions import Outcome as Asked
from benchdragon.sweeps.questions import outcome as asked
from tests.cli.verbs import VERBS, options

# A dance of a few metres, to be asked about often.
SMALL = ["--set", "dragon.benches=4", "--set", "route.pitch=1.2", "--set", "route.start_turn=4"]
COIL = ["dragon.benches=9", "route.start_turn=8", "route.pitch=0.7", "disc.radius=2"]
DISC = [word for setting in COIL for word in ("--set", setting)]
SHORT = [*SMALL, "--set", "walk.end=2"]
TURN = ["turn", "--set", "dragon.benches=3", "--set", "walk.end=3", "--set", "walk.start=0"]

MOTION = ["motion", "spiral-in", *SMALL, "--at", "3"]
NPZ = ["-o", "out", "--format", "npz"]
CHECK = ["check", "spiral-in", *SHORT]
SIZES = {name: ["solve", name, "spiral-in", *DISC] for name in ("pitch", "width", "length")}
SIZES["disc"] = ["solve", "disc", "spiral-in", *DISC, "--set", "route.pitch=0.5"]
# Some of the sizes are safe: where none is, each takes a search of the whole coil.
RANGES = {"pitch": "0.5..0.8", "width": "0.2..0.6", "length": "1.6..3", "disc": "0.5..0.8"}
SOLVE = SIZES["pitch"]
TRAVERSAL = [*SOLVE, "--method", "traversal", "--pitch-step", "0.1", "--time-step", "2"]
RANGE = [*SOLVE, "--range", "0.5..0.8", "--count", "3"]
SPEED = ["solve", "speed", *TURN]
PACED = [*SPEED, "--pace", "-o", "paced.toml"]
BEST = ["solve", "turn", *TURN]
# Between the disc's joints some boxes tell how much better another turn may be.
BOUNDED = [*BEST, "--set", "turn.entry_radius=4.5", "--set", "turn.exit_radius=4.5"]
HALL = ["dragon.benches=4", "disc.radius=2.9", "route.pitch=0.9", "route.start_turn=5"]
IN_HALL = [word for setting in (*HALL, "venue.rectangle=[14, 14]") for word in ("--set", setting)]
PLACE = ["solve", "place", "spiral-in", *IN_HALL]
SQUARE = ["solve", "square", "spiral-in", *IN_HALL]
MARGINS = ["margins", "spiral-in", *DISC, "--aside", "0.01", "--draws", "4"]
ROWS = ["sweep", "spiral-in", *SMALL, "--set", "walk.end=3", "-o", "rows"]
SWEEP = [*ROWS, "--vary", "route.pitch=1.2,1.3"]
SAMPLE = [*ROWS, "--vary", "route.pitch=1.2..1.4", "--sample", "3"]
TOUCHING = [*SWEEP, "--ask", "tolerance", "--draws", "2"]
REFINED = [*SWEEP, "--ask", "clearance", "--refine", "4"]
# Of its drawing something is passed over, which is told.
PASSED = str(Path(__file__).parents[1] / "cases" / "field" / "F16.dragon.toml")
SURVEY = ["survey", str(Path(__file__).parents[2] / "examples" / "11_drawn_walk.dragon.toml")]
VIEW = ["view", "spiral-in", *SHORT, "-o", "dance.html"]
PLANNER = ["planner", "spiral-in", *SHORT, "-o", "planner.html"]
STILL = ["view", "spiral-in", *SHORT, "-o", "still.png", "--size", "320x180"]
SHEET = [*STILL, "--sheet", "2x1"]
FILM = ["view", "spiral-in", *SHORT, "-o", "film.gif", "--size", "320x180", "--end", "0.3"]
AREA = ["area", "spiral-in", *SHORT]
TIMES = ["timetable", "spiral-in", *SHORT]
DRAWN = [*AREA, "-o", "area.svg"]
MINE = ["plan", "spiral-in", *SHORT, "-o", "mine.dragon.toml"]
STARTER = ["starter", "-o", "a.py"]
REPRODUCE = ["reproduce", "-o", "out"]
VERIFY = ["verify", "certificate.json"]
CERTIFIED = [*CHECK, "--prove", "--certificate", "certificate.json"]
NEW = ["new", "-o", "new.toml", "--benches", "4", "--bench-length", "1.5", "--bench-width", "0.2"]
PROPOSED = [*NEW, "--square", "20x20"]
WELL = [
    "plan", "spiral-in", "--set", 'obstacle=[{kind="circle", centre=[1, 2], radius=1.0}]', "-o",
    "well.dragon.toml",
]  # fmt: skip


Outcome = tuple[object, ...]
Come = Callable[[list[str], Sequence[str]], Outcome]


class Case(NamedTuple):
    """A command line, what is added to it, and one that is run before both."""

    base: list[str]
    added: list[str]
    before: Sequence[str] = ()


def called(line: Sequence[str]) -> str:
    """What is typed of a command line to call its verb."""
    return " ".join(line[:2]) if line[0] == "solve" else line[0]


CASES: dict[str, Case] = {
    "motion --set": Case(MOTION, ["--set", "route.pitch=0.6"]),
    "motion --at": Case(MOTION, ["--at", "4"]),
    "motion --only": Case(MOTION, ["--only", "1"]),
    "motion --output": Case(MOTION, NPZ),
    "motion --format": Case([*MOTION, *NPZ], ["--format", "csv"]),
    "motion --force": Case([*MOTION, *NPZ], ["--force"], [*MOTION, *NPZ]),
    "motion --json": Case(MOTION, ["--json"]),
    "motion --leader": Case(MOTION, ["--leader", "rk4"]),
    "motion --step": Case([*MOTION, "--at", "9", "--leader", "rk4"], ["--step", "1.5"]),
    "motion --keep-going": Case([*MOTION, "--at", "3,999"], ["--keep-going"]),
    "motion --workers": Case([*MOTION, "--at", "0..9..0.1", *NPZ], ["--workers", "2"]),
    "motion --explain": Case(MOTION, ["--explain"]),
    "check --set": Case(CHECK, ["--set", "walk.end=3"]),
    "check --prove": Case(CHECK, ["--prove"]),
    "check --prove-all": Case([*CHECK, "--prove"], ["--prove-all"]),
    "verify --json": Case(VERIFY, ["--json"], CERTIFIED),
    "verify --lang": Case(VERIFY, ["--lang", "zh"], CERTIFIED),
    "verify --quiet": Case(VERIFY, ["--quiet"], CERTIFIED),
    "check --output": Case(CHECK, ["-o", "out", "--format", "svg"]),
    "check --format": Case([*CHECK, "-o", "out", "--format", "svg"], ["--format", "pdf"]),
    "check --force": Case(
        [*CHECK, "-o", "out", "--format", "svg"], ["--force"], [*CHECK, "-o", "out", "--format", "svg"]
    ),
    "check --certificate": Case([*CHECK, "--prove"], ["--certificate", "certificate.json"]),
    "check --json": Case(CHECK, ["--json"]),
    "check --explain": Case(CHECK, ["--explain"]),
    "check --brackets": Case(CHECK, ["--brackets"]),
    "check --show-plan": Case(CHECK, ["--show-plan"]),
    "survey --set": Case(SURVEY, ["--set", "route.smooth=G1"]),
    "survey --json": Case(SURVEY, ["--json"]),
    "plan --json": Case(["plan", "turn"], ["--json"]),
    "plan --set": Case(["plan", "turn"], ["--set", "route.pitch=1.8"]),
    "plan --head-speed": Case(["plan", "turn", "-o", "mine.toml"], ["--head-speed", "0.6 m/s"]),
    "plan --output": Case(["plan", "turn"], ["-o", "mine.toml"]),
    "plan --force": Case(
        ["plan", "turn", "-o", "mine.toml"], ["--force"], ["plan", "turn", "-o", "mine.toml"]
    ),
    "new --json": Case(PROPOSED, ["--json"]),
    "new --output": Case(PROPOSED, ["-o", "other.toml"]),
    "new --benches": Case(PROPOSED, ["--benches", "5"]),
    "new --bench-length": Case(PROPOSED, ["--bench-length", "1.6"]),
    "new --bench-width": Case(PROPOSED, ["--bench-width", "0.3"]),
    "new --head-length": Case(PROPOSED, ["--head-length", "2.5"]),
    "new --inset": Case(PROPOSED, ["--inset", "0.2"]),
    "new --square": Case(PROPOSED, ["--square", "22x20"]),
    "new --radius": Case(NEW, ["--radius", "12"]),
    "new --bearers": Case(PROPOSED, ["--bearers", "1"]),
    "new --carry": Case(PROPOSED, ["--carry", "under"]),
    "new --speed": Case(PROPOSED, ["--speed", "0.5"]),
    "new --most-speed": Case(PROPOSED, ["--most-speed", "1.2"]),
    "new --sway": Case(PROPOSED, ["--sway", "2cm"]),
    "new --imprecision": Case(PROPOSED, ["--imprecision", "20cm"]),
    "new --kind": Case(PROPOSED, ["--kind", "spiral-in"]),
    "new --rounds": Case([*PROPOSED, "--carry", "under"], ["--rounds", "2"]),
    "new --beside": Case(PROPOSED, ["--beside", "well.dragon.toml"], WELL),
    "new --roster": Case(PROPOSED, ["--roster", "names.csv"]),
    "new --force": Case(PROPOSED, ["--force"], PROPOSED),
    "starter --output": Case(["starter", "-o", "a.py"], ["-o", "a.ipynb"]),
    "starter --force": Case(STARTER, ["--force"], STARTER),
    "starter --json": Case(STARTER, ["--json"]),
    "starter --lang": Case(STARTER, ["--lang", "zh"]),
    "formations --json": Case(["formations"], ["--json"]),
    "schema --table": Case(["schema"], ["--table"]),
    "solve --lang": Case(["solve", "--help"], ["--lang", "zh"]),
    **{
        f"solve {size} {name}": case
        for size, line in SIZES.items()
        for name, case in {
            "--set": Case(line, ["--set", "dragon.head_length=2.5"]),
            "--range": Case(line, ["--range", RANGES[size]]),
            "--count": Case([*line, "--range", RANGES[size], "--json"], ["--count", "4"]),
            "--prove": Case(line, ["--prove"]),
            "--output": Case(line, ["-o", "sized.toml"]),
            "--certificate": Case([*line, "--prove"], ["--certificate", "proof.json"]),
            "--force": Case([*line, "-o", "mine.dragon.toml"], ["--force"], MINE),
            "--json": Case(line, ["--json"]),
            "--brackets": Case(line, ["--brackets"]),
            "--explain": Case(line, ["--explain"]),
        }.items()
    },
    "solve pitch --method": Case(TRAVERSAL[:-6], TRAVERSAL[-6:]),
    "solve pitch --pitch-step": Case(TRAVERSAL, ["--pitch-step", "0.15"]),
    "solve pitch --time-step": Case([*TRAVERSAL, "--explain"], ["--time-step", "4"]),
    "solve speed --set": Case(SPEED, ["--set", "limits.speed=1.5"]),
    "solve speed --pace": Case(SPEED, ["--pace"]),
    "solve speed --force": Case(PACED, ["--force"], PACED),
    "solve speed --prove": Case(SPEED, ["--prove"]),
    "solve speed --output": Case(SPEED, ["-o", "fast.toml"]),
    "solve speed --certificate": Case([*SPEED, "--prove"], ["--certificate", "speed.json"]),
    "solve speed --json": Case(SPEED, ["--json"]),
    "solve speed --explain": Case(SPEED, ["--explain"]),
    "solve speed --brackets": Case(SPEED, ["--brackets"]),
    "solve turn --set": Case(BEST, ["--set", "route.pitch=1.8"]),
    "solve turn --objective": Case(BEST, ["--objective", "length"]),
    "solve turn --least-radius": Case(BEST, ["--least-radius", "1.6"]),
    "solve turn --longest": Case(BEST, ["--longest", "12"]),
    "solve turn --longest-way": Case(BEST, ["--longest-way", "12"]),
    "solve turn --prove": Case(BOUNDED, ["--prove"]),
    "solve turn --within": Case([*BOUNDED, "--prove"], ["--within", "3"]),
    "solve turn --boxes": Case([*BOUNDED, "--prove"], ["--boxes", "2"]),
    "solve turn --certificate": Case([*BOUNDED, "--prove"], ["--certificate", "turn.json"]),
    "solve turn --output": Case(BEST, ["-o", "best.toml"]),
    "solve turn --force": Case([*BEST, "-o", "best.toml"], ["--force"], [*BEST, "-o", "best.toml"]),
    "solve turn --json": Case(BEST, ["--json"]),
    "solve turn --explain": Case(BEST, ["--explain"]),
    "solve place --set": Case(PLACE, ["--set", "venue.rectangle=[15, 14]"]),
    "solve place --output": Case(PLACE, ["-o", "placed.toml"]),
    "solve place --force": Case(
        [*PLACE, "-o", "placed.toml"], ["--force"], [*PLACE, "-o", "placed.toml"]
    ),
    "solve place --json": Case(PLACE, ["--json"]),
    "solve place --brackets": Case(PLACE, ["--brackets"]),
    "solve square --set": Case(SQUARE, ["--set", "route.turned=30"]),
    "solve square --error": Case(SQUARE, ["--error", "0.1"]),
    "solve square --json": Case(SQUARE, ["--json"]),
    "margins --set": Case([*MARGINS, "--json"], ["--set", "limits.margin=0.1"]),
    **{
        f"margins --{deviation}": Case([*MARGINS, "--json"], [f"--{deviation}", "0.02"])
        for deviation in ("aside", "stray", "play", "height", "length", "width")
    },
    "margins --draws": Case(MARGINS, ["--draws", "5"]),
    "margins --seed": Case([*MARGINS, "--json"], ["--seed", "2"]),
    "margins --workers": Case([*MARGINS, "--workers", "1"], ["--workers", "2"]),
    "margins --output": Case(MARGINS, ["-o", "out"]),
    "margins --force": Case([*MARGINS, "-o", "out"], ["--force"], [*MARGINS, "-o", "out"]),
    "margins --json": Case(MARGINS, ["--json"]),
    "margins --explain": Case(MARGINS, ["--explain"]),
    "sweep --set": Case(SWEEP, ["--set", "dragon.width=0.4"]),
    "sweep --vary": Case(SWEEP, ["--vary", "dragon.width=0.2,0.3"]),
    "sweep --points": Case(ROWS, ["--points", str(Path(__file__).with_name("points.csv"))]),
    "sweep --sample": Case(SAMPLE, ["--sample", "4"]),
    "sweep --method": Case(SAMPLE, ["--method", "sobol"]),
    "sweep --seed": Case(SAMPLE, ["--seed", "2"]),
    "sweep --ask": Case(SWEEP, ["--ask", "clearance"]),
    "sweep --draws": Case(TOUCHING, ["--draws", "3"]),
    **{
        f"sweep --{deviation}": Case(TOUCHING, [f"--{deviation}", "0.2"])
        for deviation in ("aside", "stray", "play", "height", "length", "width")
    },
    "sweep --refine": Case(REFINED, ["--refine", "5"]),
    "sweep --to": Case(REFINED, ["--to", "0.9"]),
    "sweep --on": Case(SWEEP, ["--on", "dask"]),
    "sweep --workers": Case(SWEEP, ["--workers", "3"]),
    "sweep --output": Case(SWEEP, ["-o", "elsewhere"]),
    "sweep --status": Case(["sweep"], ["--status", "rows"], SWEEP),
    "sweep --json": Case(SWEEP, ["--json"]),
    "margins --on": Case(MARGINS, ["--on", "dask"]),
    "view --set": Case(VIEW, ["--set", "dragon.width=0.4"]),
    "view --output": Case(VIEW, ["-o", "other.html"]),
    "view --json": Case(VIEW, ["--json"]),
    "view --force": Case(VIEW, ["--force"], VIEW),
    "view --start": Case(VIEW, ["--start", "1"]),
    "view --end": Case(VIEW, ["--end", "1"]),
    "planner --set": Case(PLANNER, ["--set", "dragon.width=0.4"]),
    "planner --output": Case(PLANNER, ["-o", "other.html"]),
    "planner --json": Case(PLANNER, ["--json"]),
    "planner --force": Case(PLANNER, ["--force"], PLANNER),
    "area --set": Case(AREA, ["--set", "dragon.width=0.5"]),
    "area --output": Case(AREA, ["-o", "area.svg"]),
    "area --format": Case(DRAWN, ["--format", "geojson"]),
    "area --start": Case(AREA, ["--start", "1"]),
    "area --end": Case(AREA, ["--end", "1"]),
    "area --margin": Case(AREA, ["--margin", "50 cm"]),
    "area --error": Case(AREA, ["--error", "1 mm"]),
    "area --scale": Case(DRAWN, ["--scale", "1:500"]),
    "area --paper": Case(DRAWN, ["--paper", "A4"]),
    "area --force": Case(DRAWN, ["--force"], DRAWN),
    "area --json": Case(AREA, ["--json"]),
    "area --brackets": Case(AREA, ["--brackets"]),
    "timetable --set": Case(TIMES, ["--set", "cues.clock=18:30"]),
    "timetable --json": Case(TIMES, ["--json"]),
    "view --speed-up": Case(FILM, ["--speed-up", "0.5"]),
    "view --fps": Case(FILM, ["--fps", "10"]),
    "view --at": Case(STILL, ["--at", "1"]),
    "view --sheet": Case(STILL, ["--sheet", "2x1"]),
    "view --size": Case(STILL, ["--size", "400x200"]),
    "view --theme": Case(STILL, ["--theme", "dark"]),
    "view --follow": Case(STILL, ["--follow", "2"]),
    "view --span": Case([*STILL, "--follow", "2"], ["--span", "20"]),
    "reproduce --output": Case(REPRODUCE, ["-o", "elsewhere"]),
    "reproduce --force": Case(REPRODUCE, ["--force"]),
    "reproduce --docs": Case(REPRODUCE, ["--docs", "pages"]),
    "doctor --json": Case(["doctor"], ["--json"]),
    **{
        f"{called(line)} --lang": Case(line, ["--lang", "zh"])
        for line in (
            *(MOTION, CHECK, *SIZES.values(), SPEED, BEST, PLACE, SQUARE, MARGINS, SWEEP, VIEW, STILL),
            *(AREA, TIMES, SURVEY, PROPOSED, PLANNER),
            *(["doctor"], ["plan"], ["formations"], ["schema"], ["help", "check"]),
        )
    },
    **{
        f"{called(line)} --quiet": Case(line, ["--quiet"])
        for line in (
            *(["motion", PASSED, "--at", "3"], CHECK, *SIZES.values(), SPEED, BEST, PLACE, SQUARE),
            *(MARGINS, SWEEP, VIEW, STILL, AREA, ["timetable", PASSED], PROPOSED),
        )
    },
}
# What these say comes after minutes of work: tests/paper/test_reproduce.py runs them.
ELSEWHERE = {f"reproduce --{name}" for name in ("json", "explain", "lang", "quiet")}
# These want a workbook: tests/cli/test_compare.py gives them.
ELSEWHERE |= {
    f"compare --{name}" for name in ("as", "tolerance", "literature", "json", "lang", "quiet")
}
# These want a sweep: tests/cli/test_atlas.py gives them.
ELSEWHERE |= {f"atlas --{name}" for name in ("output", "force", "json", "lang", "quiet")}
# Where it opens a browser: tests/planner/test_page.py gives it.
ELSEWHERE |= {"planner --quiet"}
# These want a plan with a list of names: tests/cli/test_sheets.py gives it.
ELSEWHERE |= {
    f"sheets --{name}"
    for name in (
        "set",
        "only",
        "paper",
        "by",
        "night",
        "phones",
        "output",
        "pdf",
        "force",
        "json",
        "lang",
        "quiet",
    )
}
# Nothing is said on standard error, nor in a language, that could be left out.
SILENT = {f"{verb} --quiet" for verb in ("plan", "formations", "schema", "starter", "doctor", "survey")}


def placed(name: str, calls: list[str]) -> Callable[..., Place]:
    """A place of that name, which is one thread, and writes down that it was asked for."""

    def call(*arguments: object) -> Place:
        calls.append(f"{name} {arguments}")
        return threads(1)

    return call


def timeless(*arguments: Any) -> Asked:
    """What a sweep's question comes to, as if it took no time."""
    return replace(asked(*arguments), seconds=0.0)


@pytest.fixture
def recorded(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Calls of what cannot be seen from outside, or takes minutes, which then is not done."""
    calls: list[str] = []

    def stopped(name: str) -> Callable[..., Any]:
        def call(*arguments: Any, **_options: Any) -> None:
            said = [repr(argument) for argument in arguments if not callable(argument)]
            raise InputError(f"{name} {said}")

        return call

    def pooled(pool: Any) -> Callable[..., Any]:
        def call(workers: int) -> Any:
            calls.append(f"{workers} threads")
            return pool(workers)

        return call

    def told() -> AbstractContextManager[Progress]:
        calls.append("progress")
        return nullcontext(silent)

    def best(plan: Plan, goal: TurnGoal, **_options: Any) -> BestTurn:
        calls.append(repr(goal))
        assert isinstance(plan.route, TurnRoute)
        turn = plan.route.turn(plan)
        way = Answer(turn.length, turn.length, turn.length, "m", "found")
        return BestTurn(plan, turn, way, turn.length, turn.length, None, way, ())

    # A picture of the clearance is of few times: thousands take half a second.
    monkeypatch.setattr(benchdragon.analysis.check, "SAMPLES", 40)
    monkeypatch.setattr(benchdragon.analysis.check, "LAST_SAMPLES", 10)
    # Progress is told after seconds that these never take: what counts is that it would be.
    monkeypatch.setattr(benchdragon.cli.console, "Lines", told)
    monkeypatch.setattr(benchdragon.cli.doctor, "seconds_a_handle", lambda: 5e-8)
    monkeypatch.setattr(benchdragon.model.placement, "ThreadPoolExecutor", pooled(ThreadPoolExecutor))
    for name in ("processes", "dask"):  # here in one thread, as if they were there
        monkeypatch.setattr(benchdragon.parallel, name, placed(name, calls))
    monkeypatch.setattr(benchdragon.sweeps.rows, "outcome", timeless)
    monkeypatch.setattr(benchdragon.solve.turn, "best_turn", best)
    monkeypatch.setattr(benchdragon.paper.reproduce, "reproduce", stopped("reproduce"))
    monkeypatch.setattr("webbrowser.open", calls.append)
    return calls


@pytest.fixture
def outcome(
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    recorded: list[str],
) -> Come:
    """What a command line comes to in an empty folder, after another one: text, code, files, calls."""
    count = 0

    def come(line: list[str], before: Sequence[str]) -> Outcome:
        nonlocal count
        count += 1
        folder = tmp_path / str(count)
        folder.mkdir()
        monkeypatch.chdir(folder)
        if before:
            run(before)
        capfd.readouterr()
        recorded.clear()
        with spoken_in(asked_language(line) or "en"):
            code = run(line)
        said = re.sub(r'"seconds": [^,}]*', "", "".join(capfd.readouterr()))
        files = {
            str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(folder.rglob("*"))
            if path.is_file()
        }
        return code, said, files, list(recorded)

    return come


def test_every_option_of_every_verb_is_given() -> None:
    known = {f"{name} {option}" for name, verb in VERBS.items() for option in options(verb)}
    assert known == {*CASES, *ELSEWHERE, *SILENT}


@pytest.fixture(scope="module")
def known() -> dict[str, Outcome]:
    """What bare command lines come to, by what they and those before them say."""
    return {}


@pytest.mark.xdist_group("options")  # most command lines serve several of them
@pytest.mark.parametrize("name", CASES)
def test_an_option_has_an_effect(outcome: Come, known: dict[str, Outcome], name: str) -> None:
    base, added, before = CASES[name]
    said = repr((base, before))
    if said not in known:
        known[said] = outcome(base, before)
        assert outcome(base, before) == known[said], "the same twice, else nothing could be told"
    assert outcome([*base, *added], before) != known[said]


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ([*MOTION, "--format", "csv"], "--format goes with -o alone"),
        ([*MOTION, "--format", "xlsx,csv,png"], "--format goes with -o alone"),
        ([*MOTION, "--force"], "--force goes with -o alone"),
        ([*AREA, "--force"], "--force goes with -o alone"),
        ([*AREA, "--format", "dxf"], "--format goes with -o alone"),
        ([*AREA, "--scale", "1:100"], "--scale goes with .svg, .pdf alone"),
        ([*AREA, "-o", "area.dxf", "--paper", "A4"], "--paper goes with .svg, .pdf alone"),
        ([*MOTION, "--step", "0.1"], "--step goes with --leader rk4 alone"),
        ([*MOTION, "--leader", "adaptive", "--step", "1"], "--step goes with --leader rk4 alone"),
        ([*MOTION, "-o", "x", "--format", "png", "--only", "1"], "--only goes with xlsx, csv"),
        ([*CHECK, "--format", "png"], "--format goes with -o alone"),
        ([*CHECK, "--force"], "--force goes with -o, --certificate alone"),
        ([*CHECK, "--certificate", "a.json"], "--certificate goes with --prove alone"),
        ([*SPEED, "--certificate", "a.json"], "--certificate goes with --prove alone"),
        ([*PACED, "--prove"], "--prove does not go with --pace"),
        (["plan", "turn", "--force"], "--force goes with -o alone"),
        (["plan", "-o", "x"], "--output goes with PLAN alone"),
        (["plan", "--set", "route.pitch=1"], "--set goes with PLAN alone"),
        ([*SOLVE, "--pitch-step", "0.1"], "--pitch-step goes with --method traversal alone"),
        ([*SOLVE, "--time-step", "1"], "--time-step goes with --method traversal alone"),
        ([*SOLVE, "--count", "50"], "--count goes with --range alone"),
        ([*SPEED, "--force"], "--force goes with -o, --certificate alone"),
        ([*BEST, "--force"], "--force goes with -o, --certificate alone"),
        ([*PLACE, "--force"], "--force goes with -o alone"),
        ([*RANGE, "--prove"], "--prove does not go with --range"),
        ([*RANGE, "-o", "a.toml"], "--output does not go with --range"),
        ([*RANGE, "--brackets"], "--brackets does not go with --range"),
        ([*RANGE, "--method", "traversal"], "--method does not go with --range"),
        ([*TRAVERSAL, "--prove"], "--prove does not go with --method traversal"),
        ([*MARGINS, "--force"], "--force goes with -o alone"),
        ([*ROWS, "--points", "x.csv", "--sample", "3"], "--sample does not go with --points"),
        ([*SWEEP, "--method", "sobol"], "--method goes with --sample alone"),
        ([*SWEEP, "--seed", "2"], "--seed goes with --sample, --ask tolerance alone"),
        ([*SWEEP, "--draws", "2"], "--draws goes with --ask tolerance alone"),
        ([*SWEEP, "--stray", "0.1"], "--stray goes with --ask tolerance alone"),
        ([*SWEEP, "--to", "0.1"], "--to goes with --refine alone"),
        ([*SWEEP, "--on", "tcp://1.2.3.4:5", "-j", "2"], "--workers does not go with --on tcp"),
        ([*SWEEP, "--status", "rows"], "--status goes alone, without a plan"),
        (["sweep", "--status", "rows", "--ask", "width"], "--status goes alone, without a plan"),
        ([*ROWS, "--sample", "3"], "--sample needs ranges: --vary KEY=LOW..HIGH"),
        ([*SWEEP, "--points", "x.csv"], "expected --vary or --points, and not both"),
        (ROWS, "expected --vary or --points, and not both"),
        (SWEEP[:2], "expected a PLAN and -o DIR, or --status DIR"),
        ([*STILL, "--span", "3"], "--span goes with --follow alone"),
        ([*VIEW, "--theme", "dark"], "--theme does not go with .html"),
        ([*VIEW, "--at", "3"], "--at does not go with .html"),
        ([*STILL, "--end", "3"], "--end does not go with .png"),
    ],
)
def test_an_option_without_effect_is_refused(
    capfd: pytest.CaptureFixture[str], line: list[str], sentence: str
) -> None:
    assert run(line) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert f"Error: {sentence}" in err
