import hashlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import imageio_ffmpeg
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.text import Text
from PIL import Image
from pypdf import PdfReader

from benchdragon import Dragon, InputError, Line, Motion, Route, Walk, WalkError
from benchdragon.analysis.check import check
from benchdragon.analysis.distance import tightest_pairs, touching
from benchdragon.cli.main import run
from benchdragon.export import film
from benchdragon.export.encoders import EncoderError, Reel, encode_mp4, find_ffmpeg
from benchdragon.export.film import Film, FilmWarning, film_path, spread_times, still_paths, write_film
from benchdragon.export.film_scene import (
    THEMES,
    TOUCH,
    Look,
    MovingScene,
    Place,
    Scene,
    clock_text,
    near_text,
    round_length,
    sheet,
)
from benchdragon.figures.style import HEAD, MissingGlyphWarning
from benchdragon.plans.schema import Plan, read_plan
from tests.figures.test_square import NEAR as NEAR_WELL

SMALL = (320, 180)
TURN = read_plan("turn")
SPIRAL = read_plan("spiral-in")
# Benches that are wide enough for a small film, where each colour covers 2 by 2 pixels.
THICK = read_plan("turn", ["dragon.benches=8", "dragon.width=1.0"])
# Pixels of compressed films lie so near to the colours drawn.
NEAR = 40.0


def colour(name: str) -> np.ndarray[Any, Any]:
    return 255.0 * np.array(to_rgb(name))


def decoded(path: Path) -> tuple[str, np.ndarray[Any, Any]]:
    """What ffmpeg says of a small film, and all its frames, (frames, height, width, 3)."""
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-nostdin", "-i", str(path)]
    command += ["-fps_mode", "passthrough", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(command, capture_output=True, check=True)
    pixels = np.frombuffer(done.stdout, np.uint8).reshape(-1, SMALL[1], SMALL[0], 3)
    return done.stderr.decode(), pixels.astype(np.float64)


def scene_of(plan: Plan, times: list[float], look: Look, title: str = "x") -> tuple[Scene, Motion]:
    walk = plan.build()
    motion = walk.motion(times)
    return Scene(look, Place.of(walk, motion, plan.disc.radius), title), motion


def pixel_of(scene: Scene, x: float, y: float) -> tuple[int, int]:
    """Row and column at which a place on the ground (m) is drawn."""
    across, up = scene.panel.axes.transData.transform((x, y))
    return int(scene.look.size[1] - up), int(across)


def words_of(scene: Scene) -> list[str]:
    return [text.get_text() for text in scene.figure.findobj(Text) if isinstance(text, Text)]


@pytest.fixture(scope="module")
def filmed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("film") / "turn.mp4"
    write_film(Film(THICK, 0.0, 22.0, fps=6, speed_up=12.0), path, Look(SMALL))
    return path


def test_a_film_has_the_frames_the_size_and_the_length_that_were_asked(filmed: Path) -> None:
    about, frames = decoded(filmed)
    assert frames.shape == (12, 180, 320, 3)
    # Above what is written again.
    film_itself = about[: about.index("Output")]
    for wanted in ("Duration: 00:00:02.00", "h264", "yuv420p(tv, bt709", "320x180", " 6 fps"):
        assert wanted in film_itself


def test_the_head_is_filmed_where_the_motion_says(filmed: Path) -> None:
    scene, motion = scene_of(THICK, np.arange(0.0, 22.1, 2.0).tolist(), Look(SMALL))
    frames = decoded(filmed)[1]
    for n, frame in enumerate(frames):
        place = pixel_of(scene, motion.x[n, :2].mean(), motion.y[n, :2].mean())
        assert np.abs(frame[place] - colour(HEAD)).max() < NEAR, n
        # Of that colour is the head alone, above the legend.
        heads = np.argwhere(np.abs(frame[:165] - colour(HEAD)).max(axis=-1) < NEAR)
        farthest = np.hypot(*(heads - np.array(place)).T).max()
        assert farthest < 0.5 * np.hypot(3.41, 1.0) * scene.panel.scale * scene.look.unit + 2.0
    assert all(np.abs(b - a).max() > NEAR for a, b in pairwise(frames))


def test_a_film_may_be_played_before_it_is_all_there_and_says_whose_it_is(filmed: Path) -> None:
    data = filmed.read_bytes()
    assert data.index(b"moov") < data.index(b"mdat")
    assert THICK.sha256.encode() in data
    assert b"Turning" in data


def test_frames_are_drawn_as_whole_pictures_are() -> None:
    """What is laid over the still ground comes to the same as drawing all again."""
    walk = TURN.build()
    motion = walk.motion([0.0, 13.0])
    place = Place.of(walk, motion, 4.5)
    frames, fresh = MovingScene(Look(SMALL), place, "x"), Scene(Look(SMALL), place, "x")
    frames.frame(motion, 0)
    laid = np.array(frames.frame(motion, 1), dtype=np.float64)
    fresh.show(motion, 1)
    fresh.canvas.draw()
    assert np.abs(laid - np.array(fresh.canvas.buffer_rgba(), dtype=np.float64)).max() == 0.0


@pytest.mark.parametrize("size", [(64, 64), (74, 64), (72, 1000), (1080, 1920), (4096, 66)])
def test_frames_are_exactly_as_large_as_asked(size: tuple[int, int]) -> None:
    walk = TURN.build()
    motion = walk.motion([0.0])
    pixels = MovingScene(Look(size), Place.of(walk, motion, None), "x").frame(motion, 0)
    assert pixels.shape == (size[1], size[0], 4)


def test_a_gif_takes_the_place_of_mp4_where_no_ffmpeg_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setenv("PATH", str(tmp_path))
    arguments = ["view", "turn", "-o", str(tmp_path / "turn.mp4"), "--start", "0", "--end", "1.1"]
    arguments += ["--size", "320x180", "--fps", "30"]
    assert run([*arguments, "--quiet"]) == 0
    captured = capsys.readouterr()
    assert captured.err == (
        "Note: no ffmpeg is here, so the film becomes turn.gif; for MP4: "
        "pip install 'benchdragon[video]'\n"
    )
    assert captured.out == f"Written:\n  {tmp_path / 'turn.gif'}\n"
    assert [path.name for path in tmp_path.iterdir()] == ["turn.gif"]
    with Image.open(tmp_path / "turn.gif") as image:
        assert image.size == SMALL
        assert image.n_frames == 34  # type: ignore[attr-defined]
        # Thirds of a hundredth of a second are made up for.
        spans = []
        for n in range(34):
            image.seek(n)
            spans.append(image.info["duration"])
        assert sum(spans[:30]) == 1000
        assert set(spans) == {30, 40}
        assert image.info["loop"] == 0
        assert TURN.sha256.encode() in image.info["comment"]
    assert run([*arguments, "--quiet"]) == 2
    assert "turn.gif is there already; use --force" in capsys.readouterr().err


def test_the_ffmpeg_on_the_path_is_the_second_choice(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert find_ffmpeg() == imageio_ffmpeg.get_ffmpeg_exe()
    other = tmp_path / "ffmpeg"
    other.write_text("#!/bin/sh\n")
    other.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    assert find_ffmpeg() == str(other)


def test_odd_names_and_titles_do_no_harm(tmp_path: Path) -> None:
    plan = read_plan("turn", ["dragon.benches=3", 'meta.title="-a\\u0007\\nb$ %d"'])
    path = tmp_path / "-a:b %d.mp4"
    with pytest.warns(MissingGlyphWarning):
        write_film(Film(plan, 0.0, 0.1), path, Look(SMALL))
    about, frames = decoded(path)
    assert len(frames) == 4
    assert "-ab$ %d" in about


@pytest.mark.parametrize("suffix", [".mp4", ".gif"])
def test_an_interrupt_leaves_no_file_and_no_program(tmp_path: Path, suffix: str) -> None:
    begun: list[str] = []

    def stop(_share: float, text: str) -> None:
        begun.append(text)
        if len(begun) == 5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_film(Film(TURN, 0.0, 9.0, 10), tmp_path / f"a{suffix}", Look(SMALL), stop)
    assert begun[-1] == "frame 5 of 91"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_ctrl_c_ends_with_130_and_leaves_nothing(tmp_path: Path) -> None:
    path = tmp_path / "a.mp4"
    script = (
        "import signal, sys; from benchdragon.cli.main import run\n"
        # A background job of a shell is born deaf to SIGINT.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        f"sys.exit(run(['view', 'turn', '-o', {str(path)!r}, '--quiet']))"
    )
    with subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.PIPE) as process:
        while not list(tmp_path.iterdir()):
            assert process.poll() is None
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _out, said = process.communicate()
    assert process.returncode == 130
    assert said.strip() == b"interrupted; nothing half-written is left"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="masks of signals")
def test_an_interrupt_while_ffmpeg_starts_leaves_none_running(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It would write the file that was just removed."""
    started: list[subprocess.Popen[bytes]] = []

    class Interrupted(subprocess.Popen[bytes]):
        def __init__(self, *arguments: Any, **named: Any) -> None:
            super().__init__(*arguments, **named)
            started.append(self)
            os.kill(os.getpid(), signal.SIGINT)

    find_ffmpeg()  # starts a process of its own, once
    monkeypatch.setattr(subprocess, "Popen", Interrupted)
    reel = Reel(SMALL, 10, 40, iter(()), "x", "y")
    # Whoever runs in the background of a shell is born without ears for it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            encode_mp4(tmp_path / "a.mp4", reel)
    finally:
        signal.signal(signal.SIGINT, before)
    assert [process.returncode for process in started] == [-signal.SIGKILL]


def test_what_ffmpeg_complains_of_is_told(tmp_path: Path) -> None:
    frames: Iterator[memoryview] = (memoryview(bytes(320 * 180 * 4)) for _n in range(40))
    with pytest.raises(EncoderError, match=r"ffmpeg failed: .*No such file"):
        encode_mp4(tmp_path / "no" / "a.mp4", Reel(SMALL, 10, 40, frames, "x", "y"))


def test_a_film_ends_where_the_dragon_can_no_longer_stand() -> None:
    with pytest.warns(FilmWarning, match=r"shown up to t = 432\.7 s only: at t = 432\.8 s bench 1"):
        times = Film(SPIRAL, 400.0, None, fps=10, speed_up=1.0).times
    assert times[[0, -1]].tolist() == pytest.approx([400.0, 432.7])
    assert SPIRAL.build().motion(times).status.sum() == 0
    with pytest.warns(FilmWarning, match="shown up to"):
        spread = spread_times(SPIRAL, None, None, 3)
    assert SPIRAL.build().motion(spread).status.sum() == 0
    with pytest.raises(WalkError, match="folds"):
        assert Film(SPIRAL, 432.853, 433.0).times.size


def test_a_film_is_of_the_plans_own_span_unless_another_is_asked_for() -> None:
    assert Film(TURN, fps=1).asked_span == TURN.span()
    assert Film(TURN, end=5.0, fps=1).asked_span == (TURN.span()[0], 5.0)


def test_a_film_shows_its_start_and_its_end() -> None:
    shown = Film(TURN, -5.0, 5.0, fps=30, speed_up=2.0).times
    assert len(shown) == 151
    assert shown[[0, -1]].tolist() == [-5.0, pytest.approx(5.0)]
    assert Film(TURN, 5.0, 5.0).times.tolist() == [5.0]
    assert Film(TURN, None, -99.0).times[0] == -100.0


def test_benches_that_touch_are_told_by_colour_and_by_hatch() -> None:
    scene, motion = scene_of(SPIRAL, [412.0, 413.5], Look((1920, 1080)))
    scene.show(motion, 0)
    assert len(scene.panel.touching.get_paths()) == 0
    assert len(scene.panel.head.get_paths()) == 1
    scene.show(motion, 1)
    rows = touching(motion, 1)
    assert rows.tolist() == [0, 8]
    assert len(scene.panel.touching.get_paths()) == 2
    assert len(scene.panel.head.get_paths()) == 0
    assert len(scene.panel.body.get_paths()) == 221
    assert scene.panel.touching.get_hatch() == "xx"
    scene.canvas.draw()
    pixels = np.array(scene.canvas.buffer_rgba(), dtype=np.float64)[80:1000, :, :3]
    assert (np.abs(pixels - colour(TOUCH)).max(axis=-1) < 1.0).sum() > 500


def test_the_tightest_pair_is_ringed_and_its_gap_is_told(spoken: str) -> None:
    scene, motion = scene_of(TURN, [14.0], Look(SMALL))
    scene.show(motion, 0)
    wanted = {
        "en": ["t = 14.0 s", "benches 1 and 17: 33.4 cm apart", "head", "touching"],
        "zh": ["t = 14.0 s", "第 1 节与第 17 节板凳相距 33.4 cm", "龙头", "相碰"],
    }[spoken]
    assert set(wanted) <= set(words_of(scene))
    x, y = (np.asarray(data, dtype=np.float64) for data in scene.panel.ring.get_data())
    assert np.hypot(x[0] - motion.x[0, 0], y[0] - motion.y[0, 0]) < 0.6


@pytest.mark.parametrize(
    ("distance", "words"),
    [
        (0.33449, "benches 1 and 9: 33.4 cm apart"),
        (0.00042, "benches 1 and 9: 0.42 mm apart"),
        (1e-10, "benches 1 and 9 touch"),
        (-0.0081, "benches 1 and 9 overlap by 8.1 mm"),
        (-0.05, "benches 1 and 9 overlap by 5.0 cm"),
    ],
)
def test_gaps_are_told_as_people_measure_them(distance: float, words: str) -> None:
    nearest = tightest_pairs(TURN.build().motion([14.0]), 0)[0]
    assert near_text(replace(nearest, benches=(1, 9), distance=distance)) == words
    assert near_text(None) == ""


def test_a_dragon_of_two_benches_has_no_tightest_pair() -> None:
    walk = Walk(Dragon.uniform(benches=2), Route((Line(50.0),)), start=10.0)
    motion = walk.motion([0.0])
    scene = Scene(Look(SMALL), Place.of(walk, motion, None), "x")
    scene.show(motion, 0)
    assert scene.near.get_text() == ""
    assert len(scene.panel.ring.get_xdata()) == 0  # type: ignore[arg-type]


@pytest.mark.parametrize("theme", sorted(THEMES))
@pytest.mark.parametrize("size", [(1920, 1080), (800, 800), (1080, 1920), (320, 180)])
def test_words_stay_in_the_picture_and_apart(spoken: str, size: tuple[int, int], theme: str) -> None:
    walk = TURN.build()
    motion = walk.motion([-100.0, 14.0])
    place = Place.of(walk, motion, 4.5)
    title = "板凳龙 round the court of the old temple, " * 9
    pace = film.pace_text(12.5)
    scene = Scene(Look(size, theme), place, title, pace)
    scene.show(motion, 0)
    renderer = scene.canvas.get_renderer()
    texts = [text for text in scene.figure.findobj(Text) if text.get_text()]
    boxes = [text.get_window_extent(renderer) for text in texts]
    assert len(boxes) == 7
    for n, box in enumerate(boxes):
        assert box.x0 >= 0.0
        assert box.x1 <= size[0]
        assert box.y0 >= 0.0
        assert box.y1 <= size[1]
        assert not any(box.overlaps(other) for other in boxes[:n])
    assert scene.figure.get_facecolor()[:3] == to_rgb(THEMES[theme].paper)


def test_everything_stays_in_view_and_to_scale() -> None:
    scene, motion = scene_of(TURN, np.linspace(-100.0, 380.0, 25).tolist(), Look((1920, 1080)))
    low, high = np.transpose([scene.panel.axes.get_xlim(), scene.panel.axes.get_ylim()])
    for n, places in enumerate((motion.x, motion.y)):
        assert low[n] < places.min()
        assert places.max() < high[n]
    (left, bottom), (right, top) = scene.panel.axes.transData.transform([(0.0, 0.0), (1.0, 1.0)])
    assert right - left == pytest.approx(scene.panel.scale, rel=1e-4)
    assert top - bottom == pytest.approx(scene.panel.scale, rel=1e-4)


def test_a_bench_that_is_followed_stays_in_the_middle() -> None:
    walk, look = TURN.build(), Look(SMALL, follow=3, span=8.0)
    motion = walk.motion([0.0, 9.0])
    frames = MovingScene(look, Place.of(walk, motion, 4.5), "x")
    seen = [np.array(frames.frame(motion, n)) for n in (0, 1)]
    assert (seen[0] != seen[1]).any()
    middle = [np.mean(frames.panel.axes.get_xlim()), np.mean(frames.panel.axes.get_ylim())]
    between = [motion.x[1, 2:4].mean(), motion.y[1, 2:4].mean()]
    assert middle == pytest.approx(between, abs=1e-9)
    assert np.ptp(frames.panel.axes.get_xlim()) == pytest.approx(8.0)


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_stills_and_sheets_are_as_large_as_asked_and_hold_the_plans_name(
    tmp_path: Path, kind: str, spoken: str
) -> None:
    for extra in (["--at", "14"], ["--sheet", "3x2"]):
        path = tmp_path / f"{extra[0][2:]}.{kind}"
        arguments = ["view", "turn", "-o", str(path), "--size", "640x360", *extra]
        assert run([*arguments, "--quiet", "--lang", spoken]) == 0
        if kind == "png":
            with Image.open(path) as image:
                assert image.size == (640, 360)
                text = " ".join(map(str, image.info.values()))
        elif kind == "pdf":
            reader = PdfReader(path)
            text = " ".join(map(str, (reader.metadata or {}).values()))
            box = reader.pages[0].mediabox
            assert box.width / box.height == pytest.approx(16.0 / 9.0, rel=1e-3)
            assert b"/Type3" not in path.read_bytes()
        else:
            text = path.read_text("utf-8")
        assert TURN.sha256 in text
        assert {"en": "Turning", "zh": "调头"}[spoken] in text


def test_several_instants_make_several_stills(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "turn.png"
    arguments = ["view", "turn", "-o", str(path), "--at", "-5,0,0:14.5,0", "--size", "320x180"]
    assert run([*arguments, "--json", "--quiet"]) == 0
    answer = json.loads(capsys.readouterr().out)
    names = ["turn--5s.png", "turn-0s.png", "turn-14.5s.png"]
    assert [Path(name).name for name in answer["files"]] == names
    assert answer["times"] == [-5.0, 0.0, 14.5]
    digests = {hashlib.sha256((tmp_path / name).read_bytes()).hexdigest() for name in names}
    assert len(digests) == 3
    assert still_paths(path, [3.0]) == [path]


def test_a_sheet_has_a_panel_and_a_clock_for_each_instant() -> None:
    walk = TURN.build()
    times = spread_times(TURN, 0.0, 50.0, 6)
    assert times.tolist() == [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]
    motion = walk.motion(times)
    figure = sheet(Look(), Place.of(walk, motion, 4.5), "x", motion, 3, 2)
    words = [text.get_text() for text in figure.texts + figure.findobj(Text)]
    assert {clock_text(t) for t in times.tolist()} < set(words)
    places = [panel.get_position() for panel in figure.axes]
    assert len(places) == 6
    for n, place in enumerate(places):
        assert not any(place.overlaps(other) for other in places[:n])
    assert places[0].x0 < places[1].x0 < places[2].x0
    assert places[0].y0 > places[3].y0
    heads = [panel.lines[-2].get_xydata()[0] for panel in figure.axes]  # type: ignore[index]
    assert np.array(heads) == pytest.approx(np.stack([motion.x[:, 0], motion.y[:, 0]], axis=-1))


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("a.avi", "-o: expected a name that ends in .html, .mp4, .gif, .png, .svg, .pdf, not a.avi"),
        ("a.mp4 --size 33", "--size: expected two whole numbers with an x between, not '33'"),
        ("a.mp4 --size 1921x1080", "a size is two even numbers from 64 to 4096, not 1921x1080"),
        ("a.mp4 --size 99999x2", "a size is two even numbers from 64 to 4096, not 99999x2"),
        ("a.mp4 --at 3", "--at does not go with .mp4"),
        ("a.gif --sheet 2x2", "--sheet does not go with .gif"),
        ("a.png --fps 3", "--fps does not go with .png"),
        ("a.png --speed-up 3", "--speed-up does not go with .png"),
        ("a.png --end 3", "--end does not go with .png"),
        ("a.png --at 3 --start 1", "--start does not go with --at"),
        ("a.mp4 --span 3", "--span goes with --follow"),
        ("a.mp4 --follow 224", "benches have numbers from 1 to 223, not 224"),
        ("a.png --at 0 --follow 224", "benches have numbers from 1 to 223, not 224"),
        ("a.mp4 --start x", "--start: expected seconds (12.5), a clock time"),
        ("a.mp4 --start 5 --end 4", "the end (4 s) must not come before the start (5 s)"),
        ("a.mp4 --speed-up 0.001", "a film has at most 36000 frames, not 14498621"),
        ("a.mp4 --end 1e300", "a film has at most 36000 frames, not 3e+301"),
        ("a.gif --fps 60", "a GIF has at most 50 frames a second, not 60"),
        ("a.gif", "a GIF of 960x540 pixels has at most 771 frames, not 9666"),
        ("a.png --sheet 11x1", "a sheet has 1 to 10 columns and rows, not 11x1"),
        ("a.png --sheet 2x1 --at 1,2,3", "3 instants do not fit a sheet of 2x1"),
        ("a.png --at 0..101", "at most 100 stills, not 102"),
        ("a.png --at 0 --set dragon.benches=20001", "a picture shows at most 20000 benches"),
    ],
)
def test_what_cannot_be_is_refused_in_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: str, sentence: str
) -> None:
    name, *options = arguments.split()
    assert run(["view", "turn", "-o", str(tmp_path / name), *options, "--quiet"]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"Error: {sentence}")
    assert said.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_the_functions_check_what_they_are_given() -> None:
    for wrong in ({"fps": 0}, {"fps": 121}, {"speed_up": 0.0}, {"speed_up": float("nan")}):
        with pytest.raises(InputError):
            Film(TURN, 0.0, 1.0, **wrong)
    with pytest.raises(InputError, match="theme must be one of light, dark, not pink"):
        Look(theme="pink")
    with pytest.raises(InputError, match="span must be positive"):
        Look(follow=1, span=0.0)
    with pytest.raises(InputError, match=r"ends in \.mp4, \.gif, not a\.png"):
        film_path(Path("a.png"))


def test_scale_bars_have_round_lengths_and_clocks_a_real_minus() -> None:
    found = [round_length(most) for most in (0.7, 1.0, 4.99, 5.0, 1999.0, 0.03)]
    assert found == pytest.approx([0.5, 1.0, 2.0, 5.0, 1000.0, 0.02])
    assert [clock_text(t) for t in (-5.0, -0.04, 12.34)] == ["t = −5.0 s", "t = 0.0 s", "t = 12.3 s"]


def test_the_square_is_in_sight_and_what_touches_it_is_hatched_and_told() -> None:
    """Bench 1 stands in the well on its way out; the tightest pair is told while nothing touches."""
    walk, obstacles = NEAR_WELL.build(), NEAR_WELL.obstacles()
    touch = check(NEAR_WELL).obstacles[1].distance.witness
    assert touch is not None
    assert touch.time is not None
    motion = walk.motion([0.0, touch.time])
    scene = Scene(Look(SMALL), Place.of(walk, motion, 4.5, obstacles), "x")
    (left, right), (bottom, top) = scene.panel.frame.limits
    assert left < -30.0 < 30.0 < right
    assert bottom < -15.0 < 15.0 < top
    scene.show(motion, 0)
    assert not scene.panel.touching.get_paths()
    assert scene.panel.words.startswith("benches ")
    scene.show(motion, 1)
    assert len(scene.panel.touching.get_paths()) == 1
    assert scene.panel.words == "bench 1 touches well"
