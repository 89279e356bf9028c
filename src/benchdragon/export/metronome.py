"""The drum of a dance as a sound file: 16 bits, one channel, every beat at its own sample."""

import math
import wave
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

from benchdragon.analysis.beats import Score, counted_in, score_of
from benchdragon.errors import InputError
from benchdragon.files import whole_file
from benchdragon.i18n import _
from benchdragon.plans.schema import Plan
from benchdragon.progress import Progress, silent

Samples = npt.NDArray[np.int16]

RATES = (22_050, 44_100)
# The longest track, s, and so many seconds of it are in memory at once.
MOST_SECONDS, SLICE_SECONDS = 4 * 3600.0, 30
# How long each sound is, s, its pitch, Hz, and its loudness, as a share of what a file holds; those
# of a beat, the first of a bar, a beat that counts in, and a stroke of the drum at a cue.
LENGTH = 0.12
SOUNDS = {"beat": (1000.0, 0.45), "bar": (1500.0, 0.6), "count": (2400.0, 0.35), "drum": (110.0, 0.95)}
FADING = 0.03
LOUDEST = 32_767


def sound(name: str, rate: int) -> npt.NDArray[np.float64]:
    """One of SOUNDS: a tone that begins at once and fades, (samples,)."""
    pitch, loudness = SOUNDS[name]
    t = np.arange(round(LENGTH * rate)) / rate
    fading = FADING * (2.0 if name == "drum" else 1.0)
    return loudness * LOUDEST * np.cos(2.0 * math.pi * pitch * t) * np.exp(-t / fading)


def sounds_of(score: Score, start: float) -> list[tuple[float, str]]:
    """Every sound of a score, at its time from `start` on, s; a stroke takes the beat's place."""
    found = {round(t - start, 9): (t - start, "drum") for t in score.strokes}
    for run in score.runs:
        for n in range(run.beats()):
            name = "count" if run.counted else "beat" if n % run.bar else "bar"
            time = run.time(n) - start
            found.setdefault(round(time, 9), (time, name))
    return sorted(found.values())


def write_drum(path: Path, plan: Plan, span: tuple[float, float], progress: Progress = silent) -> None:
    """Write the drum of a plan's dance over a span, s, after the beats that count in.

    Raises:
        InputError: for a dance of more than MOST_SECONDS.
    """
    start, end = span
    score = counted_in(score_of(plan, start, end))
    first = min([start, *(run.start for run in score.runs[:1])])
    write_track(path, score, (first, end), progress=progress)


def write_track(
    path: Path, score: Score, span: tuple[float, float], rate: int = RATES[0],
    progress: Progress = silent,
) -> None:  # fmt: skip
    """Write the drum of a dance over a span, s, as a WAV file; beat t starts at sample round(t rate).

    Raises:
        InputError: for a dance of more than MOST_SECONDS.
    """
    seconds = span[1] - span[0]
    if seconds > MOST_SECONDS:
        text = _("a track lasts at most {most} hours, not {seconds} s: choose a shorter dance")
        raise InputError(text.format(most=f"{MOST_SECONDS / 3600:g}", seconds=f"{seconds:.6g}"))
    total = round((seconds + LENGTH) * rate)
    with whole_file(path) as temporary, wave.open(str(temporary), "wb") as made:
        made.setnchannels(1)
        made.setsampwidth(2)
        made.setframerate(rate)
        for first, samples in _slices(sounds_of(score, span[0]), rate, total):
            progress(first / total, "")
            made.writeframes(samples.astype("<i2").tobytes())


def _slices(sounds: list[tuple[float, str]], rate: int, total: int) -> Iterator[tuple[int, Samples]]:
    """The samples slice by slice, with the number of the first of each."""
    made = {name: sound(name, rate) for name in SOUNDS}
    starts = [round(t * rate) for t, _name in sounds]
    size, length, n = SLICE_SECONDS * rate, round(LENGTH * rate), 0
    for first in range(0, total, size):
        count = min(size, total - first)
        mixed = np.zeros(count)
        while n < len(sounds) and starts[n] + length <= first:
            n += 1
        for start, (_t, name) in zip(starts[n:], sounds[n:], strict=True):
            if start >= first + count:
                break
            low, high = max(start, first), min(start + length, first + count)
            mixed[low - first : high - first] += made[name][low - start : high - start]
        yield first, np.clip(mixed, -LOUDEST, LOUDEST).round().astype(np.int16)
