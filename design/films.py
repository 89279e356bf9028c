"""Who makes films: matplotlib's own animation, or frames drawn over what stays.

The same scene, the contest's turn with 60 benches for six seconds, is made into a film twice: by
`FuncAnimation.save`, with the writers that matplotlib has for ffmpeg and for Pillow, and by
`export/film.py`. Said of each: CPU seconds a frame, those of ffmpeg among them, the most memory that a
process of its own takes, and the size of the file. H.264 is asked for with the same quality.

`FuncAnimation.save` draws everything of every frame, also where it is told to blit: that is done on
screens alone. Its writer for Pillow keeps all frames until the last. It has no progress that can be
heard beside a file that is whole or not there, and a film that is interrupted stays half written. On
the machine of benchmarks/RESULTS.md it took 2.2 times the CPU of `export/film.py` for H.264, 5 times
for a GIF, and 410 MB for that beside 170. It would save `encoders.py` and 30 lines of `write_film`; the
scene, which is most of it, is drawn with matplotlib's artists either way. So films stay as they are.
"""

import os
import resource
import sys
from collections.abc import Callable
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib as mpl
from matplotlib.animation import AbstractMovieWriter, FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.artist import Artist

from benchdragon.export.encoders import QUALITY, find_ffmpeg
from benchdragon.export.film import Film, write_film
from benchdragon.export.film_scene import Look, Place, Scene
from benchdragon.plans.schema import read_plan

SIZE = (960, 540)
FPS, SECONDS = 20, 6.0


def film() -> Film:
    """What is shown."""
    plan = read_plan("turn", {"dragon.benches": 60})
    return Film(plan, start=0.0, end=SECONDS, fps=FPS)


def by_matplotlib(path: Path) -> None:
    """Have matplotlib make the film."""
    shown, look = film(), Look(size=SIZE)
    walk = shown.walk
    motion = walk.motion(shown.times)
    scene = Scene(look, Place.of(walk, motion, shown.plan.disc.radius, ()), "")

    def draw(index: int) -> list[Artist]:
        scene.show(motion, index)
        return []

    mpl.rcParams["animation.ffmpeg_path"] = find_ffmpeg() or "ffmpeg"
    options = ["-crf", str(QUALITY), "-preset", "veryfast", "-tune", "animation", "-pix_fmt", "yuv420p"]
    made = FuncAnimation(scene.figure, draw, frames=len(shown.times), blit=True)
    writer: AbstractMovieWriter = PillowWriter(fps=FPS)
    if path.suffix == ".mp4":
        writer = FFMpegWriter(fps=FPS, codec="libx264", extra_args=options)
    made.save(path, writer=writer, dpi=scene.figure.dpi)


def by_export(path: Path) -> None:
    """Make the film as the package does."""
    write_film(film(), path, Look(size=SIZE))


def measured(make: Callable[[Path], None], path: Path) -> tuple[float, float]:
    """CPU seconds that a film takes, and the most memory, MB; in a process of its own."""
    before = os.times()
    make(path)
    after = os.times()
    used = sum(b - a for a, b in zip(before[:4], after[:4], strict=True))
    return used, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main() -> None:
    """Print what each takes."""
    if find_ffmpeg() is None:
        sys.exit("no ffmpeg here")
    count = len(film().times)
    print(f"{count} frames of {SIZE[0]} x {SIZE[1]}\n{'':26}  CPU s a frame   MB   file, kB")
    with TemporaryDirectory() as folder, get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        for suffix in (".mp4", ".gif"):
            for name, make in (("matplotlib", by_matplotlib), ("export/film.py", by_export)):
                path = Path(folder) / f"{make.__name__}{suffix}"
                used, most = pool.apply(measured, (make, path))
                size = path.stat().st_size / 1000.0
                print(
                    f"{name + ' ' + suffix:26} {used / count:13.3f} {most:6.0f} {size:8.0f}", flush=True
                )


if __name__ == "__main__":
    main()
