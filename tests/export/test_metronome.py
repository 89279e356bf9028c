"""The drum as a sound file: every beat at its own sample."""

import wave
from pathlib import Path

import numpy as np
import pytest

from benchdragon.analysis.beats import Run, Score
from benchdragon.errors import InputError
from benchdragon.export.metronome import LENGTH, SLICE_SECONDS, sound, sounds_of, write_track

SCORE = Score(
    100.0, True,
    (
        Run(-2.0, 30.0, 0.61, 4, False), Run(36.1, 38.54, 0.61, 4, True),
        Run(38.54, 64.3, 0.37, 3, False),
    ),
    (-2.0, 30.0, 60.123),
)  # fmt: skip


def samples(path: Path) -> tuple[np.ndarray, int]:
    with wave.open(str(path)) as made:
        assert (made.getnchannels(), made.getsampwidth()) == (1, 2)
        rate = made.getframerate()
        return np.frombuffer(made.readframes(made.getnframes()), "<i2").astype(float), rate


@pytest.mark.parametrize("rate", [22_050, 44_100])
def test_every_beat_begins_at_its_own_sample(tmp_path: Path, rate: int) -> None:
    path = tmp_path / "beat.wav"
    write_track(path, SCORE, (-2.0, 64.3), rate)
    heard, found = samples(path)
    assert (found, len(heard)) == (rate, round((66.3 + LENGTH) * rate))
    wanted = [-2.0, 30.0, 60.123]
    wanted += [-2.0 + 0.61 * n for n in range(53) if -2.0 + 0.61 * n < 30.0]
    wanted += [36.1 + 0.61 * n for n in range(4)] + [38.54 + 0.37 * n for n in range(70)]
    wanted = [time for time in wanted if time < 64.3 - 1e-9]
    # Sounds begin at once and fade: an onset is where it is much louder than in the 5 ms before. None
    # is heard while another begins within its length: those are compared apart.
    starts = np.unique([round((time + 2.0) * rate) for time in wanted])
    alone = starts[np.diff(starts, prepend=-rate) > LENGTH * rate]
    assert len(alone) > 120
    for start in alone.tolist():
        assert not heard[max(start - 3, 0) : start].any()
        assert abs(heard[start]) > 8000
    # And there is no other: what lies beyond the length of a sound after each is silent.
    quiet = np.ones(len(heard), dtype=bool)
    for start in starts.tolist():
        quiet[start : start + round(LENGTH * rate)] = False
    assert quiet.any()
    assert not heard[quiet].any()


def test_sounds_tell_bars_counting_and_strokes_apart(tmp_path: Path) -> None:
    names = [name for _time, name in sounds_of(SCORE, -2.0)]
    assert names[:6] == ["drum", "beat", "beat", "beat", "bar", "beat"]
    assert names.count("count") == 4
    assert names.count("drum") == 3
    path = tmp_path / "beat.wav"
    write_track(path, SCORE, (-2.0, 64.3))
    heard, rate = samples(path)
    at = round(38.1 * rate)
    np.testing.assert_allclose(heard[at : at + 500], sound("count", rate)[:500].round(), atol=0.5)


def test_slices_leave_no_seam(tmp_path: Path) -> None:
    score = Score(60.0, False, (Run(SLICE_SECONDS - 0.05, SLICE_SECONDS + 3.0, 1.0, 4, False),), ())
    path = tmp_path / "beat.wav"
    write_track(path, score, (0.0, SLICE_SECONDS + 3.0))
    heard, rate = samples(path)
    at, whole = round((SLICE_SECONDS - 0.05) * rate), sound("bar", rate).round()
    np.testing.assert_array_equal(heard[at : at + len(whole)], whole)


def test_a_track_is_bounded_and_whole_or_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="at most 4 hours"):
        write_track(tmp_path / "beat.wav", SCORE, (0.0, 15_000.0))
    assert not list(tmp_path.iterdir())
