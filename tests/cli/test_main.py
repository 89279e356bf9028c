import json
import signal
import subprocess
import sys
from pathlib import Path
from queue import SimpleQueue
from typing import NoReturn

import numpy as np
import pytest
from rich.cells import cell_len

from benchdragon.cli import doctor
from benchdragon.cli.console import Lines, shown_progress
from benchdragon.cli.main import program, run
from benchdragon.cli.parsing import MOST_TIMES, parse_handles, parse_lengths, parse_time, parse_times
from benchdragon.errors import InputError
from benchdragon.hosts import compiled
from benchdragon.hosts.serving import Serving
from benchdragon.hosts.trouble import EngineError, Trouble
from benchdragon.i18n import _
from benchdragon.plans.schema import read_plan
from benchdragon.version import __version__

EXAMPLES = Path(__file__).parents[2] / "examples"


def answered(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of one command line."""
    code = run(arguments)
    captured = capsys.readouterr()
    return code, captured.out, captured.err


@pytest.mark.parametrize(
    ("text", "times"),
    [
        ("12.5", [12.5]),
        ("3:12", [192.0]),
        ("-1:30", [-90.0]),
        ("-0:30", [-30.0]),
        ("1:02:03.5", [3723.5]),
        ("90 s", [90.0]),
        ("3 min 12 s, 1h", [192.0, 3600.0]),
        ("-1 min 30 s", [-90.0]),
        ("0..3", [0.0, 1.0, 2.0, 3.0]),
        ("0..1..0.25", [0.0, 0.25, 0.5, 0.75, 1.0]),
        ("0..0.3..0.1", [0.0, 0.1, 0.2, 0.3]),
        ("5..-5..-5", [5.0, 0.0, -5.0]),
        ("7, 0..2 ,3:00", [7.0, 0.0, 1.0, 2.0, 180.0]),
        ("-100..-98", [-100.0, -99.0, -98.0]),
        ("0:58 .. 1:02 .. 2 s", [58.0, 60.0, 62.0]),
    ],
)
def test_times_are_read_the_way_people_write_them(text: str, times: list[float]) -> None:
    assert parse_times(text).tolist() == pytest.approx(times, abs=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "", "x", "nan", "inf", "1e999", "1,,2", "0..9..", "..9", "0..1..1..1", "12 kg", "3 min -12 s",
        # Neither a clock time nor, any longer, a range.
        "0:300:1", "0:300", "1:75", "1:60:00", "1:2:3:4", "3:", "0:9:0.5:1",
    ],
)  # fmt: skip
def test_times_that_make_no_sense_are_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"^--at: expected seconds .* a range start\.\.stop\.\.step"):
        parse_times(text)


@pytest.mark.parametrize("text", ["0..9..0", "0..9..-1", "9..0", "9..0..1"])
def test_ranges_that_never_end_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="never get from start to stop"):
        parse_times(text)


@pytest.mark.parametrize("text", ["0..1e6", "0..1..1e-300", "0..1e300", "0..999999,0..5"])
def test_too_many_times_are_refused_before_they_fill_the_memory(text: str) -> None:
    with pytest.raises(InputError, match=f"at most {MOST_TIMES} times"):
        parse_times(text)


@pytest.mark.parametrize("text", ["0..9", "1,2", "x", "0:300", ""])
def test_one_time_is_one_time(text: str) -> None:
    assert parse_time("--start", "1:02:03") == parse_time("--start", " 3723 s ") == 3723.0
    with pytest.raises(InputError, match=r"^--start: expected seconds"):
        parse_time("--start", text)


def test_a_range_of_sizes_takes_units() -> None:
    assert parse_lengths("--range", "0.4..0.6") == (0.4, 0.6)
    assert parse_lengths("--range", "40 cm..0.6 m") == pytest.approx((0.4, 0.6))
    for text in ("0.4", "0.4:0.6", "a..b", "1..2..3", "..", "0.4..inf", "1 s..2 s"):
        with pytest.raises(InputError, match=r"^--range: expected two sizes in metres, LOW\.\.HIGH"):
            parse_lengths("--range", text)


@pytest.mark.parametrize("name", ["spiral-in", "turn"])
def test_without_times_motion_gives_each_second_of_the_walk_that_check_judges(
    capsys: pytest.CaptureFixture[str], name: str
) -> None:
    code, out, _err = answered(
        capsys, "motion", name, "--only", "0", "--json", "--set", "walk.start=-1"
    )
    plan = read_plan(name, ["walk.start=-1"])
    start, end = plan.span(plan.build())
    times = json.loads(out)["time"]
    assert code == 0
    assert times == [float(t) for t in range(int(start), int(end) + 1)]
    assert end - times[-1] < 1.0


def test_files_are_named_in_json_if_wanted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ("motion", "spiral-in", "--at", "0..2", "--format", "csv", "--explain", "--json")
    code, out, _err = answered(capsys, *arguments, "-o", str(tmp_path))
    found = json.loads(out)
    assert code == 0
    assert found["files"] == [str(tmp_path / "motion.csv")]
    assert found["plan_sha256"] == read_plan("spiral-in").sha256
    assert found["explanation"]


def test_handles_are_checked_against_the_dragon() -> None:
    assert parse_handles("0,5,223", 223) == [0, 5, 223]
    assert parse_handles(None, 223) is None
    for text in ("224", "-1", "x", "1;2", ""):
        with pytest.raises(InputError, match="expected handle numbers from 0 to 223"):
            parse_handles(text, 223)


def test_motion_as_json_is_one_object_with_the_plans_name(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = answered(
        capsys, "motion", "spiral-in", "--at", "0,300", "--only", "0,1", "--json", "--quiet"
    )
    answer = json.loads(out)
    assert (code, err) == (0, "")
    assert answer["time"] == [0.0, 300.0]
    assert answer["handle"] == [0, 1]
    motion = read_plan("spiral-in").build().motion([0.0, 300.0])
    for key in ("x", "y", "speed"):
        assert np.array(answer[key]) == pytest.approx(getattr(motion, key)[:, :2], abs=1e-12)
    assert answer["plan_sha256"] == read_plan("spiral-in").sha256
    assert answer["version"] == __version__
    assert answer["status"] == [0, 0]


def test_motion_as_a_table_shows_the_papers_handles(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _err = answered(capsys, "motion", "spiral-in", "--at", "60")
    assert code == 0
    assert "5.799209" in out
    assert "-8.797992" in out
    assert [line.split("\t")[1] for line in out.splitlines() if line.startswith("60\t")] == [
        "0", "1", "51", "101", "151", "201", "223",
    ]  # fmt: skip


def test_settings_change_the_answer(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ("motion", "spiral-in", "--at", "0", "--only", "0", "--json")
    _code, out, _err = answered(capsys, *arguments, "--set", "route.pitch=0.6")
    assert json.loads(out)["x"][0][0] == pytest.approx(9.6)


def test_files_are_written_once_and_again_only_when_forced(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["motion", str(EXAMPLES / "01_parade.dragon.toml"), "-o", str(tmp_path / "out")]
    kinds = ["--format", "csv,xlsx,npz,parquet,nc,png,svg,pdf"]
    code, out, _err = answered(capsys, *arguments, *kinds)
    written = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert code == 0
    assert sorted(Path(line.strip()).name for line in out.splitlines()[1:]) == written
    assert len(written) == 5 + 3 * 3
    stamp = (tmp_path / "out" / "motion.csv").stat().st_mtime_ns
    code, _out, err = answered(capsys, *arguments, *kinds)
    assert code == 2
    assert "is there already; use --force" in err
    assert (tmp_path / "out" / "motion.csv").stat().st_mtime_ns == stamp
    assert answered(capsys, *arguments, "--format", "csv,svg", "--force")[0] == 0
    assert (tmp_path / "out" / "motion.csv").stat().st_mtime_ns > stamp


@pytest.mark.parametrize(
    ("arguments", "code", "sentence"),
    [
        (
            ["motion", "spiral-in", "--at", "0..442"],
            2,
            "3101 rows are too many for a screen (at most 400): choose times",
        ),
        (["motion", "turn", "--set", "walk.speed=0"], 3, "never comes to the end of its walk: set"),
        (["motion", "spiral-in", "--at", "x"], 2, "expected seconds (12.5), a clock time"),
        (["motion", "spiral-in", "--at", "3", "--only", "500"], 2, "expected handle numbers"),
        (["motion", "spiral-in", "--at", "3", "--set", "x"], 3, "expected KEY=VALUE"),
        (["motion", "spiral-in", "--at", "3", "--set", "route.pitch=-1"], 3, "more than 0.0"),
        (["motion", "nowhere", "--at", "3"], 3, "there is no plan nowhere"),
        (["check", "spiral-in", "--set", "route.pitch=1.7"], 4, "by disc.radius or walk.end"),
        (["motion", "spiral-in", "--at", "500"], 4, "past the end of the route"),
        (["motion", "spiral-in", "--at", "0..300"], 2, "rows are too many for a screen"),
        (["motion", "spiral-in", "--at", "3", "--leader", "x"], 2, "Invalid value for '--leader'"),
        (["motion", "turn", "--at", "3,99", "--leader", "rk4"], 2, "rk4 needs the head on one spiral"),
        (["motion", "turn", "--at", "0..60000", "--json"], 2, "JSON holds at most"),
        (["motion"], 2, "Missing argument 'PLAN'"),
        (["dance"], 2, "there is no command dance"),
        (["motion", "turn", "--att", "3"], 2, "there is no option --att; did you mean --at?"),
        (["motion", "turn", "--at", "3", "-o", "/proc/x"], 2, "/proc/x"),
        (["motion", "turn", "--at", "3", "-o", "x", "--format", "docx"], 2, "expected some of xlsx"),
    ],
)
def test_wrong_input_gets_one_sentence_and_its_exit_code(
    capsys: pytest.CaptureFixture[str], arguments: list[str], code: int, sentence: str
) -> None:
    found, out, err = answered(capsys, *arguments)
    assert found == code
    assert out == ""
    assert sentence in err
    assert "Traceback" not in err


@pytest.mark.parametrize(
    ("plan", "times"),
    [
        (("spiral-in",), [0, 60, 120, 180, 240, 300, 360, 420]),
        (("turn",), [-100, -40, 20, 80, 140, 200, 260, 320, 380]),
        (("spiral-in", "--set", "walk.end=3"), [0, 1, 2, 3]),
    ],
)
def test_without_times_a_screen_shows_the_whole_walk_in_a_dozen(
    capsys: pytest.CaptureFixture[str], plan: tuple[str, ...], times: list[int]
) -> None:
    code, out, _err = answered(capsys, "motion", *plan, "--only", "0")
    assert code == 0
    rows = [line.split("\t")[:2] for line in out.splitlines() if "\t" in line][1:]
    assert [(int(time), int(handle)) for time, handle in rows] == [(time, 0) for time in times]


def test_a_table_has_lines_on_a_screen_and_tabs_elsewhere(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    question = ("motion", "spiral-in", "--at", "60", "--only", "0..1")
    _code, piped, _err = answered(capsys, *question)
    title, header, *rows, _numbering = piped.splitlines()
    assert (title, header.split("\t")[:2]) == ("Coiling in", ["time (s)", "handle"])
    assert [row.split("\t")[:4] for row in rows] == [
        ["60", "0", "Head", "5.799209"], ["60", "1", "Body 1", "7.456758"],
    ]  # fmt: skip
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "100")
    _code, shown, _err = answered(capsys, *question)
    assert "\t" not in shown
    assert "│ 60       │      1 │         Body 1 │ 7.456758 │" in shown


def test_keep_going_gives_the_sound_part_and_says_what_failed(
    capsys: pytest.CaptureFixture[str],
) -> None:
    arguments = ("motion", "spiral-in", "--at", "0,500", "--only", "0", "--json", "--keep-going")
    code, out, err = answered(capsys, *arguments)
    answer = json.loads(out)
    assert code == 4
    assert answer["x"][0][0] == pytest.approx(8.8)
    assert answer["x"][1] == [None]
    assert answer["status"] == [0, 2]
    assert err.startswith("1 of 2 times are incomplete; the first: at t = 500 s ")
    assert "past the end of the route" in err


def test_keep_going_tells_failures_of_all_slices(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("benchdragon.model.walk.SLICE_PLACES", 1000)  # four times a slice
    walk = (
        "motion",
        "spiral-in",
        "--at",
        "430..445..1",
        "-o",
        str(tmp_path / "out"),
        "--format",
        "csv",
    )
    code, _out, err = answered(capsys, *walk, "--keep-going")
    assert code == 4
    assert "3 of 16 times are incomplete; the first: at t = 443 s " in err


def test_runge_kutta_says_how_far_it_is_from_the_closed_form(
    capsys: pytest.CaptureFixture[str],
) -> None:
    arguments = ("motion", "spiral-in", "--at", "300", "--leader", "rk4", "--step", "1")
    code, out, _err = answered(capsys, *arguments)
    assert code == 0
    assert "rk4 and the closed form put the head at most 1" in out.replace("\n", " ")
    assert "e-10 m apart" in out


def test_the_schema_is_json(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _err = answered(capsys, "schema")
    assert code == 0
    assert json.loads(out)["properties"]["dragon"]


def test_the_doctor_names_versions_fonts_and_cache(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _err = answered(capsys, "doctor", "--json")
    found = json.loads(out)
    assert code == 0
    assert found["benchdragon"] == __version__
    assert {"python", "numpy", "wasmtime", "fonts", "engine", "ffmpeg", "browser"} <= set(found)
    assert found["speed"].endswith(" ns to place a handle")
    assert "NotoSansSC-Regular.ttf" in answered(capsys, "doctor")[1]


def test_the_doctor_ends_with_what_a_troupe_can_do(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def last() -> str:
        return answered(capsys, "doctor", "--lang", "en")[1].splitlines()[-1]

    assert last().startswith("All that sheets, chalk plan, drum and player need is here")
    monkeypatch.setattr(doctor, "FONT_FILES", (Path("gone.ttf"),))
    assert last().startswith("The package's fonts are missing")


@pytest.mark.parametrize(
    ("engine", "folder", "text", "good"),
    [
        ("native", "/own", "library built ahead of time: ", True),
        ("plain", "/own", "plain Python, as BENCHDRAGON_ENGINE says", False),
        ("wasm", "/own", "builds it", True),
        ("wasm", None, "set XDG_CACHE_HOME to a folder of your own", True),
    ],
)
def test_the_doctor_says_which_engine_serves_how_fast_and_how_to_get_the_other(
    engine: str, folder: str | None, text: str, good: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(doctor, "serving", lambda: Serving(engine, lambda function: function))
    monkeypatch.setattr(compiled, "kept_folder", lambda: folder and Path(folder))
    monkeypatch.setattr(doctor, "seconds_a_handle", lambda: 1.2e-8)
    found, speed = doctor.engine()
    assert text in found.value
    assert found.good == good
    assert ("pip install 'benchdragon[build]'" in found.value) == (engine == "wasm")
    assert ("XDG" in found.value) == (folder is None)
    assert speed.value == "12 ns to place a handle"


@pytest.mark.parametrize("late", [False, True])
def test_the_doctor_says_what_is_wrong_with_the_engine(
    late: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def wrong() -> NoReturn:
        raise EngineError(Trouble.NO_WASMTIME, "gone")

    monkeypatch.setattr(doctor, "seconds_a_handle" if late else "serving", wrong)
    (found,) = doctor.engine()
    assert found.value.startswith("Wasmtime does not run here (gone)")
    assert not found.good


@pytest.mark.parametrize("words", ["--help", "motion --help", "solve", "solve pitch --help"])
def test_help_imports_nothing_heavy(words: str) -> None:
    script = (
        f"import sys; from benchdragon.cli.main import run; run({words.split()!r}); "
        "heavy = {'numpy', 'wasmtime', 'scipy', 'matplotlib', 'pydantic', 'rich'} & set(sys.modules); "
        "sys.exit(str(heavy) if heavy else 0)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "Usage: benchdragon" in done.stdout + done.stderr


def test_an_interrupt_leaves_nothing_half_written(tmp_path: Path) -> None:
    script = (
        "import os, signal, sys; import benchdragon.export.tables as tables\n"
        "from benchdragon.cli.main import run\n"
        # A background job of a shell is born deaf to SIGINT.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def stop(*_): os.kill(os.getpid(), signal.SIGINT)\n"
        "tables._long = lambda *a: stop()\n"
        f"sys.exit(run(['motion', 'spiral-in', '--at', '0..9', '-o', {str(tmp_path)!r}]))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 130
    assert "interrupted" in done.stderr
    assert signal.SIGINT.value == 2
    assert sorted(path.name for path in tmp_path.iterdir()) == ["motion.xlsx"]


def test_a_closed_pipe_is_no_error() -> None:
    command = f"{sys.executable} -m benchdragon motion spiral-in --at 0..300 --json --quiet | head -c 9"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.stdout == '{"format"'


def test_a_sign_that_cannot_be_drawn_is_named_once_in_a_plain_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["motion", str(EXAMPLES / "01_parade.dragon.toml"), "-o", str(tmp_path), "--quiet"]
    arguments += ["--format", "png", "--set", 'meta.title="𠮷"']
    code, _out, err = answered(capsys, *arguments)
    assert code == 0
    assert err == "Note: no font here has the signs 𠮷 (U+20BB7)\n"


LOOKS = ".html, .mp4, .gif, .png, .svg, .pdf"


@pytest.mark.parametrize(
    ("words", "ending"),
    [
        ("view turn -o x.txt", LOOKS),
        ("view turn -o html", LOOKS),
        ("view turn -o x.html.gz", LOOKS),
        ("view turn -o x", LOOKS),
        ("solve speed turn --pace -o x.json", ".toml"),
        ("solve turn turn -o x.html", ".toml"),
    ],
)
def test_names_that_promise_another_kind_of_file_are_refused(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: str,
    ending: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, err = answered(capsys, *words.split())
    assert (code, out) == (2, "")
    assert f": expected a name that ends in {ending}, not {words.split()[-1]}" in err
    assert list(tmp_path.iterdir()) == []


def test_the_list_of_verbs_says_whole_sentences(
    capsys: pytest.CaptureFixture[str], spoken: str
) -> None:
    code, out, _err = answered(capsys, "--help")
    said = "".join(out.split())
    assert code == 0
    assert "..." not in said.replace("[ARGS]...", "")
    for name, verb in program.commands.items():
        sentence = "".join(_(verb.help or "").split("\n\n")[0].split())
        assert name + sentence in said
    assert max(cell_len(line) for line in out.splitlines()) <= 80


def test_a_line_each_thirty_seconds_tells_how_far_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    over: SimpleQueue[bool] = SimpleQueue()

    def wait(seconds: float) -> bool:
        assert seconds == 30.0
        return over.get()

    for told in ([], [(0.0, "first")], [(0.25, "first"), (0.75, "second"), (0.75, "")]):
        with Lines(wait) as progress:
            for share, text in told:
                progress(share, text)
            for last in (False, False, True):
                over.put(last)
    out, err = capsys.readouterr()
    assert out == ""
    assert err.splitlines() == [
        "30 s so far",
        "60 s so far",
        "30 s so far; first",
        "60 s so far; first",
        "30 s so far; 75 % done; second",
        "60 s so far; 75 % done; second",
    ]


def test_progress_is_told_unless_it_is_to_be_quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    assert isinstance(shown_progress(False), Lines)
    assert not isinstance(shown_progress(True), Lines)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    assert not isinstance(shown_progress(False), Lines)
