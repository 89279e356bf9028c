"""Films, stills and contact sheets of a plan's dance, as files.

Frames are drawn one after another and go straight to the encoder, so that a long film needs no more
memory than a short one; a GIF alone is held whole, and is limited for it.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from benchdragon.analysis.asked import asked_of
from benchdragon.errors import InputError, in_order, of_kind, positive
from benchdragon.export.encoders import ENCODERS, Reel, find_ffmpeg
from benchdragon.export.film_scene import SPAN, Look, MovingScene, Place, Scene, sheet
from benchdragon.figures.style import write_picture
from benchdragon.files import refuse_existing, whole_file
from benchdragon.i18n import _, language
from benchdragon.kernels.curve import FloatArray
from benchdragon.model.walk import Motion, Walk
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent
from benchdragon.version import __version__

# Twenty minutes at 30 frames a second.
MOST_FRAMES = 36_000
# Pixels of all frames of a GIF, which Pillow holds at one byte each.
MOST_GIF_PIXELS = 400_000_000
# Players show a GIF slowly that asks for more frames a second.
MOST_FPS, MOST_FPS_GIF = 120, 50
MOST_STILLS, MOST_SIDE = 100, 10
# Instants among which the last is sought at which the dragon stands, for a contact sheet.
SAMPLES = 2001
# What is right where nothing is asked.
SIZES = {".mp4": (1920, 1080), ".gif": (960, 540)}
RATES = {".mp4": 30, ".gif": 20}


class FilmWarning(UserWarning):
    """A film is not quite what was asked for."""


@dataclass(frozen=True)
class Film:
    """A dance, or a part of it, as frames.

    Args:
        plan: what is danced.
        start: s of the dance; None: where the plan's walk starts.
        end: s of the dance; None: where the plan's walk ends. No frame comes after it.
        fps: frames a second.
        speed_up: seconds of the dance in a second of the film.

    Raises:
        InputError: for what cannot be, or too many frames.
    """

    plan: Plan
    start: float | None = None
    end: float | None = None
    fps: int = RATES[".mp4"]
    speed_up: float = 1.0

    def __post_init__(self) -> None:
        positive("speed_up", self.speed_up)
        if not 1 <= self.fps <= MOST_FPS:
            text = _("a film has 1 to {most} frames a second, not {fps}")
            raise InputError(text.format(most=MOST_FPS, fps=self.fps))
        if self.asked_frames > MOST_FRAMES:
            text = _(
                "a film has at most {most} frames, not {count}: show a shorter part, speed it up, "
                "or take fewer frames a second"
            )
            raise InputError(text.format(most=MOST_FRAMES, count=f"{self.asked_frames:.10g}"))

    @cached_property
    def walk(self) -> Walk:
        """What moves."""
        return self.plan.build()

    @cached_property
    def asked_span(self) -> tuple[float, float]:
        """First and last second that was asked for."""
        _walk, start, end = asked_of(self.plan, self.start, self.end, self.walk)
        in_order(start, end)
        return start, end

    @property
    def asked_frames(self) -> float:
        """How many frames that makes."""
        start, end = self.asked_span
        return (end - start) / self.speed_up * self.fps * (1.0 + 1e-12) // 1.0 + 1.0

    @cached_property
    def times(self) -> FloatArray:
        """Times of all frames, s; up to where the dragon can no longer stand, with a warning then.

        Raises:
            WalkError: if it cannot stand at the first.
        """
        seconds = np.arange(self.asked_frames, dtype=np.float64) * (self.speed_up / self.fps)
        return sound_times(self.walk, self.asked_span[0] + seconds)


def sound_times(walk: Walk, times: FloatArray) -> FloatArray:
    """Those of `times`, s, before the first at which the dragon cannot stand; a warning says so.

    Raises:
        WalkError: if it cannot stand at the first.
    """
    done = 0
    for motion in walk.motions(times, throw=False):
        failed = np.flatnonzero(motion.status)
        if failed.size:
            index = int(failed[0])
            if done + index == 0:
                raise motion.failure(0)
            text = _("shown up to t = {t} s only: {why}")
            warnings.warn(
                text.format(t=f"{times[done + index - 1]:.6g}", why=motion.failure(index)),
                FilmWarning,
                stacklevel=2,
            )
            return times[: done + index]
        done += len(motion.times)
    return times


def spread_times(plan: Plan, start: float | None, end: float | None, count: int) -> FloatArray:
    """So many times, s, evenly spread over the dance or a part of it, as far as the dragon stands.

    Raises:
        InputError: if the end comes before the start.
        WalkError: if the dragon cannot stand at the start.
    """
    walk, first, last = asked_of(plan, start, end)
    in_order(first, last)
    sound = sound_times(walk, np.linspace(first, last, SAMPLES))
    return np.linspace(first, float(sound[-1]), count)


def film_path(path: Path) -> Path:
    """Where a film is written: a GIF beside `path`, with a warning, where MP4 needs an ffmpeg.

    Raises:
        InputError: for a file that is no film.
    """
    if path.suffix not in ENCODERS:
        text = _("a film is a file that ends in {known}, not {name}")
        raise InputError(text.format(known=", ".join(ENCODERS), name=path.name))
    if path.suffix == ".gif" or find_ffmpeg() is not None:
        return path
    other = path.with_suffix(".gif")
    text = _("no ffmpeg is here, so the film becomes {name}; for MP4: pip install 'benchdragon[video]'")
    warnings.warn(text.format(name=other.name), FilmWarning, stacklevel=2)
    return other


def write_film(film: Film, path: Path, look: Look, progress: Progress = silent) -> None:
    """Write a film as MP4 or GIF.

    Args:
        film: what is shown.
        path: its suffix says how.
        look: size, colours, and what is followed.
        progress: is called for each frame.

    Raises:
        InputError: for what a GIF cannot hold, or a bench that is not there.
        EncoderError: if ffmpeg fails.
        WalkError: if the dragon cannot stand at the first frame.
    """
    _check_follow(film.walk, look)
    if path.suffix == ".gif":
        _check_gif(film, look)
    times, plan = film.times, film.plan
    title = plan.title(language())
    ends = film.walk.motion(times[[0, -1]])
    place = Place.of(film.walk, ends, plan.disc.radius, plan.obstacles())
    scene = MovingScene(look, place, title, pace_text(film.speed_up))

    def frames() -> Iterator[memoryview]:
        done = 0
        for motion in film.walk.motions(times):
            for index in range(len(motion.times)):
                yield scene.frame(motion, index)
                done += 1
                progress(done / len(times), _("frame {n} of {count}").format(n=done, count=len(times)))

    about = f"plan sha256 {plan.sha256}; benchdragon {__version__}"
    name = "".join(sign for sign in title if sign.isprintable())
    with whole_file(path) as temporary:
        ENCODERS[path.suffix](temporary, Reel(look.size, film.fps, len(times), frames(), name, about))


def animate(
    plan: Plan, path: Path | str, *, start: float | None = None, end: float | None = None,
    fps: int | None = None, speed_up: float = 1.0, size: tuple[int, int] | None = None,
    theme: str = "light", follow: int | None = None, span: float = SPAN, force: bool = False,
    progress: Progress = silent,
) -> Path:  # fmt: skip
    """Write the dance of a plan as a film; the ending of the path says which: .mp4 or .gif.

    Args:
        plan: what is danced.
        path: of the film.
        start: s of the dance; None: where the plan's walk starts.
        end: s of the dance; None: where it ends. No frame comes after it.
        fps: frames a second; None: 30, for a GIF 20.
        speed_up: seconds of the dance in a second of the film.
        size: width and height, pixels, even numbers; None: 1920 by 1080, for a GIF 960 by 540.
        theme: "light" or "dark".
        follow: number of a bench, 1..N, that stays in the middle; None: all is seen at once.
        span: metres across the picture where a bench is followed.
        force: whether a file that is there already is replaced.
        progress: is called for each frame.

    Returns:
        Where the film is: a GIF beside `path`, with a warning, where MP4 lacks its ffmpeg.

    Raises:
        InputError: for what cannot be, and a file that is there already.
        WalkError: if the dragon cannot stand at the first frame.

    Examples:
        >>> plan = bd.read_plan("turn", {"dragon.benches": 5})
        >>> film = plan.animate(folder / "turn.gif", start=0.0, end=0.2, size=(160, 90))
        >>> film.name
        'turn.gif'
    """
    of_kind("plan", plan, Plan)
    path = film_path(Path(path))
    look = Look(size or SIZES[path.suffix], theme, follow, span)
    film = Film(plan, start, end, fps or RATES[path.suffix], speed_up)
    refuse_existing([path], force)
    write_film(film, path, look, progress)
    return path


def _check_gif(film: Film, look: Look) -> None:
    """Refuse what a GIF cannot hold."""
    if film.fps > MOST_FPS_GIF:
        text = _("a GIF has at most {most} frames a second, not {fps}")
        raise InputError(text.format(most=MOST_FPS_GIF, fps=film.fps))
    most = int(MOST_GIF_PIXELS / (look.size[0] * look.size[1]))
    if film.asked_frames > most:
        raise InputError(
            _(
                "a GIF of {width}x{height} pixels has at most {most} frames, not {count}: show a "
                "shorter part, speed it up, take a smaller size or fewer frames a second, or MP4"
            ).format(width=look.size[0], height=look.size[1], most=most, count=f"{film.asked_frames:g}")
        )


def _check_follow(walk: Walk, look: Look) -> None:
    """Refuse to follow a bench that the dragon has not."""
    if look.follow is not None and not 1 <= look.follow <= len(walk.dragon):
        text = _("benches have numbers from 1 to {most}, not {number}")
        raise InputError(text.format(most=len(walk.dragon), number=look.follow))


def still_paths(path: Path, times: Sequence[float]) -> list[Path]:
    """A file for each time: `path` itself for one, else with the seconds in its name."""
    if len(times) == 1:
        return [path]
    return [path.with_stem(f"{path.stem}-{t:.6g}s") for t in times]


def _instants(plan: Plan, times: FloatArray, look: Look) -> tuple[Motion, Place]:
    """The dance at each of `times` (s), and what holds all of them."""
    walk = plan.build()
    _check_follow(walk, look)
    motion = walk.motion(times)
    return motion, Place.of(walk, motion, plan.disc.radius, plan.obstacles())


def write_stills(
    plan: Plan, times: FloatArray, paths: Sequence[Path], look: Look, progress: Progress = silent
) -> None:
    """Write a picture of the dance at each of `times` (s), all to one scale.

    Raises:
        InputError: for too many, or a bench that is not there.
        WalkError: if the dragon cannot stand at one of them.
    """
    if len(times) > MOST_STILLS:
        text = _("at most {most} stills, not {count}")
        raise InputError(text.format(most=MOST_STILLS, count=len(times)))
    title = plan.title(language())
    motion, place = _instants(plan, times, look)
    for index, path in enumerate(paths):
        scene = Scene(look, place, title)
        scene.show(motion, index)
        write_picture(scene.figure, path, title, plan.sha256)
        progress((index + 1) / len(paths), path.name)


def write_sheet(plan: Plan, times: FloatArray, path: Path, look: Look, columns: int, rows: int) -> None:
    """Write all of `times` (s) as small pictures side by side, row by row.

    Raises:
        InputError: for a grid too large or too small, or a bench that is not there.
        WalkError: if the dragon cannot stand at one of them.
    """
    if not (1 <= columns <= MOST_SIDE and 1 <= rows <= MOST_SIDE):
        text = _("a sheet has 1 to {most} columns and rows, not {columns}x{rows}")
        raise InputError(text.format(most=MOST_SIDE, columns=columns, rows=rows))
    if len(times) > columns * rows:
        text = _("{count} instants do not fit a sheet of {columns}x{rows}")
        raise InputError(text.format(count=len(times), columns=columns, rows=rows))
    title = plan.title(language())
    motion, place = _instants(plan, times, look)
    figure = sheet(look, place, title, motion, columns, rows)
    write_picture(figure, path, title, plan.sha256)


def pace_text(speed_up: float) -> str:
    """How much faster than the dance a film is."""
    if speed_up == 1.0:
        return _("real time")
    return _("{factor} times as fast").format(factor=f"{speed_up:g}")
