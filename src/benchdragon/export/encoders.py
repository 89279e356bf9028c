"""Frames into films: H.264 in MP4 through ffmpeg, animated GIF through Pillow."""

import itertools
import shutil
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any

from benchdragon.errors import MachineError, pipe_closed
from benchdragon.i18n import _
from benchdragon.parallel import interrupts_held

# Quality of H.264: 18 shows no difference to the eye.
QUALITY = 18
# Told which colours they are, players show those that were drawn.
COLOURS = (
    "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p,"
    "setparams=colorspace=bt709:color_primaries=bt709:color_trc=bt709"
)


class EncoderError(MachineError):
    """ffmpeg did not do what it was asked for."""


@dataclass(frozen=True)
class Reel:
    """Frames that follow one another.

    Attributes:
        size: width and height, pixels.
        fps: frames a second.
        count: how many there are.
        frames: pixels of each, red, green, blue, opacity; each is read before the next is made.
        title: kept in the file.
        about: kept in the file.
    """

    size: tuple[int, int]
    fps: int
    count: int
    frames: Iterator[memoryview]
    title: str
    about: str


def find_ffmpeg() -> str | None:
    """The ffmpeg that the extra `video` brings, else the one on the path; None without one."""
    try:
        import imageio_ffmpeg  # an optional extra

        found: str = imageio_ffmpeg.get_ffmpeg_exe()
    except (ImportError, RuntimeError):
        return shutil.which("ffmpeg")
    return found


def encode_mp4(path: Path, reel: Reel) -> None:
    """Write frames as H.264 that browsers play, and that begins to play before it is all there.

    Raises:
        EncoderError: with what ffmpeg says, if it fails.
    """
    command = [find_ffmpeg() or "ffmpeg", "-v", "error", "-nostdin", "-y"]
    command += ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", "{}x{}".format(*reel.size)]
    command += ["-r", str(reel.fps), "-i", "pipe:0", "-an"]
    command += ["-vf", COLOURS, "-c:v", "libx264", "-crf", str(QUALITY), "-tune", "animation"]
    # For flat colours half the time of the default, in as large a file.
    command += ["-preset", "veryfast"]
    command += ["-movflags", "+faststart"]
    command += ["-metadata", f"title={reel.title}", "-metadata", f"comment={reel.about}"]
    with TemporaryFile() as said:
        code = _piped([*command, "-f", "mp4", f"file:{path}"], reel.frames, said)
        if code:
            said.seek(0)
            lines = said.read().decode(errors="replace").split("\n")
            text = next((line for line in lines if line.strip()), str(code))
            raise EncoderError(_("ffmpeg failed: {text}").format(text=text))


@contextmanager
def _unread() -> Iterator[None]:
    """Let what is written to a program that has ended go."""
    try:
        yield
    except OSError as error:
        if not pipe_closed(error):
            raise


def _piped(command: list[str], frames: Iterator[memoryview], said: IO[bytes]) -> int:
    """Run a program on frames; its exit code. It ends with us, whatever happens."""
    process: subprocess.Popen[bytes] | None = None
    try:
        with interrupts_held():
            process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said
            )
        assert process.stdin is not None
        with _unread():  # it ended early, and says why
            for frame in frames:
                process.stdin.write(frame)
            process.stdin.close()
        return process.wait()
    finally:
        if process is not None:
            process.kill()  # does nothing to one that has ended
            with _unread():
                process.communicate()


def encode_gif(path: Path, reel: Reel) -> None:
    """Write frames as a GIF that runs for ever, in the 256 colours that suit its first frame."""
    from PIL import Image  # slow to import

    def images() -> Iterator[Image.Image]:
        palette: Image.Image | None = None
        pixels: Any
        for pixels in reel.frames:
            image = Image.frombuffer("RGBA", reel.size, pixels, "raw", "RGBA", 0, 1).convert("RGB")
            palette = palette or image.quantize(256, kmeans=1)  # else white is not quite white
            yield image.quantize(palette=palette, dither=Image.Dither.NONE)

    # A GIF counts hundredths of a second: remainders are carried over.
    ends = [round(100.0 * n / reel.fps) for n in range(reel.count + 1)]
    durations = [10 * (b - a) for a, b in itertools.pairwise(ends)]
    every = images()
    with path.open("wb") as file:  # Pillow would leave it open where it is interrupted
        next(every).save(
            file, "GIF", save_all=True, append_images=every, duration=durations, loop=0,
            comment=reel.about,
        )  # fmt: skip


ENCODERS: dict[str, Callable[[Path, Reel], None]] = {".mp4": encode_mp4, ".gif": encode_gif}
