"""What people type: usual command lines, and mistyped ones, each with what must be seen."""

import json
from pathlib import Path

import pytest

import benchdragon.parallel
from benchdragon.cli.main import run
from benchdragon.parallel import threads

SHORT = "spiral-in --set walk.end=5 --set dragon.benches=9"
COIL = "spiral-in --set disc.radius=2 --set dragon.benches=9 --set route.start_turn=8"
TURN = "turn --set dragon.benches=3 --set walk.start=0 --set walk.end=3"
SURVEY = Path(__file__).parents[2] / "examples" / "11_drawn_walk.dragon.toml"
# One after another in one folder: a line, and what is seen; behind a tilde, that it ends with 1.
USUAL = [
    ("help", "Judge:"),
    ("help check", "Example:\n  benchdragon check spiral-in"),
    ("help solve", "The smallest pitch of the spiral"),
    ("help solve turn", "--objective"),
    ("check -h", "PLAN is a *.dragon.toml file"),
    ("--help", "Papers:"),
    ("--version", "benchdragon, version"),
    ("-V", "benchdragon, version"),
    ("plan", "question-3  Coiling in to the disc"),
    ("plan --json", '"name": "gaochun"'),
    ("plan turn", 'kind = "turn"'),
    ("plan turn --json", '"pitch": 1.7'),
    ("plan gaochun", "as reported"),
    ("plan turn --set route.pitch=1.8 -o mine.dragon.toml", "Written:\n  mine.dragon.toml"),
    ("plan mine.dragon.toml --head-speed 0.8 -o slow.dragon.toml", "slow.dragon.toml"),
    ("check mine.dragon.toml --set walk.end=-90", "SAFE from t = -100.00 s to t = -90.00 s"),
    (f"check {SHORT}", "SAFE from t = 0 s to t = 5.00 s"),
    (f"check {SHORT} --json", '"safe": true'),
    (f"check {SHORT} --explain", "Step by step"),
    (f"check {SHORT} --brackets", "between"),
    (f"check {SHORT} --show-plan", "benches = 9"),
    (f"check {SHORT} --quiet", "least clearance"),
    (f"check {SHORT} -o verdict --format svg", "verdict/clearance.svg"),
    (f"check {SHORT} --prove --certificate shown.json", "proved that no benches come too near"),
    ("check pujiang --set dragon.benches=9", "SAFE"),
    ("check question-3 --set walk.end=5 --set dragon.benches=9", "SAFE"),
    ("check turn --set route.pitch=0.5 --set dragon.benches=60", "~BD101: benches 1 and 15 touch"),
    ("verify shown.json", "proved: no two non-adjacent benches nearer than 0 m"),
    ("verify shown.json --json", '"verified"'),
    ("motion spiral-in --at 60", "60\t51\tBody 51\t-8.686317"),
    ("motion spiral-in --at 3:12 --only 0", "192\t0\tHead\t6.442721"),
    ("motion spiral-in --at 3min12s --only 0 --json", '"time": [192.0]'),
    ("motion spiral-in --at 0..10..5 --only 0..2", "10\t2\tBody 2"),
    ("motion spiral-in --at 0,60,3:12 --only 1,51", "192\t51"),
    ("motion turn --at -10..10..10 --only 0 --json", '"time": [-10.0, 0.0, 10.0]'),
    ("motion spiral-in --at 60 --only 0 --explain", "Step by step"),
    ("motion spiral-in --at 300 --only 0 --leader rk4", "apart"),
    ("motion spiral-in --at 0..9 -o out --format csv", "out/motion.csv"),
    ("motion spiral-in --at 0..9 -o out --format csv --force --json", '"files": ["out/motion.csv"]'),
    (f"solve pitch {COIL} -o tight.dragon.toml", "smallest pitch: 0.58296 m (found)"),
    ("check tight.dragon.toml", "SAFE"),
    (f"solve width {COIL} --set route.pitch=0.7 --json", '"value": 0.4526035'),
    (f"solve length {COIL} --set route.pitch=0.7", "longest bench: 2.8956 m"),
    (f"solve disc {COIL} --set route.pitch=0.5", "smallest disc radius"),
    (f"solve pitch {COIL} --range 0.5..0.8 --count 3", "is a border"),
    (f"solve speed {TURN} -o fast.dragon.toml", "greatest head speed: 1.9999 m/s"),
    (f"solve speed {TURN} --set walk.speed=1.6 --pace", "slowing down only where it must"),
    (f"solve square {SHORT}", "smallest circle"),
    (f"sweep {SHORT} --vary route.pitch=0.5..0.6..0.05 -o rows", "3 points of route.pitch"),
    ("sweep --status rows --json", '"complete": true'),
    ("atlas rows -o atlas.html", "atlas.html"),
    (f"area {SHORT}", "ground covered"),
    (f"area {SHORT} -o area.svg --json", '"files": ["area.svg"]'),
    (f"timetable {SHORT}", "the head sets out"),
    (f"view {SHORT} -o dance.html", "dance.html"),
    (f"view {SHORT} -o still.png --at 1 --size 320x180", "still.png"),
    (f"planner {SHORT} -o planner.html --json", '"files": ["planner.html"]'),
    (f"sheets {SHORT} --only overview -o papers.html", "papers.html"),
    (f"margins {COIL} --aside 0.01 --draws 2", "without deviations: 0.58"),
    (f"survey {SURVEY}", "of the drawing"),
    ("formations --json", '"coil-in"'),
    ("schema --table", "\npitch\t"),
    ("starter -o contest.py", "contest.py"),
    ("compare pitch=0.450338", "~figures that agree: 5"),
    ("doctor", "ok  python"),
    ("completion fish", "complete --no-files --command benchdragon"),
]  # fmt: skip
# What is refused: each by itself, with its exit code.
MISTYPED = [
    ("chek turn", 2, "there is no command chek; did you mean check?"),
    ("checks turn", 2, "did you mean check?"),
    ("CHECK turn", 2, "did you mean check?"),
    ("motoin turn", 2, "did you mean motion?"),
    ("vie turn", 2, "did you mean view?"),
    ("re -o out", 2, "did you mean reproduce?"),
    ("ch turn", 2, "did you mean check?"),
    ("solv pitch turn", 2, "did you mean solve?"),
    ("pitch turn", 2, "did you mean solve pitch?"),
    ("solve ptch turn", 2, "did you mean pitch?"),
    ("solve turns turn", 2, "did you mean turn?"),
    ("film turn", 2, "known: new, plan"),
    ("help chek", 2, "did you mean check?"),
    ("check", 2, "Missing argument 'PLAN' (benchdragon check --help)"),
    ("check turn turn", 2, "(benchdragon check --help)"),
    ("check turn --sett route.pitch=1", 2, "there is no option --sett; did you mean --set?"),
    ("check turn --jsn", 2, "did you mean --json?"),
    ("check turn --prov", 2, "did you mean --prove, or --prove-all?"),
    ("check turn -o", 2, "'-o' requires an argument"),
    ("check turn --lang de", 2, "'de' is not one of 'en', 'zh'"),
    ("check tunr", 3, "there is no plan tunr"),
    ("check Turn", 3, "did you mean turn?"),
    ("check question3", 3, "did you mean question-3?"),
    ("check spiral", 3, "did you mean spiral-in?"),
    ("check turn.dragon.toml", 3, "did you mean turn?"),
    ("check village", 3, "did you mean village.dragon.toml?"),
    ("check vilage.toml", 3, "did you mean village.dragon.toml?"),
    ("planner gaochn -o x.html", 3, "did you mean gaochun?"),
    ("check turn --set pitch=0.5", 3, "pitch is not a known key; did you mean route.pitch?"),
    ("check turn --set benches=9", 3, "did you mean dragon.benches?"),
    ("check turn --set speed=1", 3, "did you mean walk.speed, or limits.speed?"),
    ("check turn --set pich=1", 3, "did you mean route.pitch?"),
    ("check turn --set route.pich=1", 3, "did you mean route.pitch?"),
    ("check turn --set rout.pitch=1", 3, "did you mean route.pitch?"),
    ("check turn --set Route.Pitch=1", 3, "did you mean route.pitch?"),
    ("check turn --set route.pitch", 3, "expected KEY=VALUE"),
    ("check turn --set route.pitch:0.5", 3, "expected KEY=VALUE"),
    ("check turn --set route.pitch=abc", 3, "expected a number, or text with a unit"),
    ("check turn --set route.pitch=-1", 3, "expected more than 0.0, not -1"),
    ("check spiral-in --set route.pitch=3", 4, "end the walk before that (in a plan by disc.radius"),
    ("check turn --certificate a.json", 2, "--certificate goes with --prove alone"),
    ("check turn --prove --certificate a.txt", 2, "expected a name that ends in .json, not a.txt"),
    ("motion turn --at 0:300:1", 2, "a range start..stop..step (0..300..1), not '0:300:1'"),
    ("motion turn --at 0-300", 2, "not '0-300'"),
    ("motion spiral-in --at 500", 4, "past the end of the route"),
    ("motion turn --at 0 --only 0..999", 2, "from 0 to 223 with commas, or a range (0..5)"),
    ("motion turn --at 3 -o out --format xls", 2, "did you mean xlsx?"),
    ("motion turn --format csv", 2, "--format goes with -o alone"),
    ("solve pitch turn --range 0.4:0.6", 2, "LOW..HIGH (0.4..0.6), not '0.4:0.6'"),
    ("solve pitch spiral-in -o tight.json", 2, "-o: expected a name that ends in .toml"),
    ("solve turn turn --plan-file x.toml", 2, "there is no option --plan-file"),
    ("solve place turn", 2, "the plan has no venue to be placed in"),
    ("sweep spiral-in --vary pitch=1,2 -o rows", 2, "did you mean route.pitch?"),
    ("sweep spiral-in --vary route.pitch=0.5:0.6:0.1 -o rows", 3, "0.5:0.6:0.1"),
    ("sweep spiral-in --vary route.pitch=0.5..0.6 -o rows", 2, "KEY=FIRST..LAST..STEP"),
    ("sweep spiral-in --vary route.pitch=1,2 -o rows --ask clearence", 2, "did you mean clearance?"),
    ("sweep", 2, "expected a PLAN and -o DIR"),
    ("view turn -o x.avi", 2, "expected a name that ends in .html, .mp4"),
    ("view turn", 2, "Missing option"),
    ("view turn -o x", 2, "expected a name that ends in .html"),
    ("sheets turn --only overveiw", 2, "did you mean overview?"),
    ("area turn --paper A9", 2, "'A9' is not one of"),
    ("new -o x.toml", 2, "there is no terminal to ask in: add --benches"),
    ("compare nothing.xlsx", 2, "nothing.xlsx"),
    ("verify nothing.json", 2, "nothing.json"),
    ("survey turn", 3, "survey speaks of drawn routes"),
    ("completion powershell", 2, "'powershell' is not one of 'bash', 'zsh', 'fish'"),
]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working folder, in which a sweep's points are asked one after another."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.setattr(benchdragon.parallel, "processes", lambda _workers: threads(1))
    return tmp_path


def test_usual_lines_show_what_was_asked_for(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert len(USUAL) >= 60
    faults = []
    for line, seen in USUAL:
        code = run(line.split())
        out, err = capsys.readouterr()
        if seen.removeprefix("~") not in out or code != seen.startswith("~") or "Traceback" in err:
            faults.append((line, code, out[:200], err[:200]))
        if "--json" in line:
            assert next(iter(json.loads(out).items())) == ("format", 1), line
    assert faults == []


def test_mistyped_lines_are_refused_in_one_sentence(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert len(MISTYPED) >= 60
    (folder / "village.dragon.toml").touch()
    faults = []
    for line, wanted, seen in MISTYPED:
        code = run(line.split())
        out, err = capsys.readouterr()
        one = err.startswith("Error: ") and err.count("\n") == 1
        if code != wanted or out or not one or seen not in err:
            faults.append((line, code, out[:200], err[:300]))
    assert faults == []
    assert [path.name for path in folder.iterdir()] == ["village.dragon.toml"]
