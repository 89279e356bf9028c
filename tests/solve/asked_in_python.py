"""The engine's question about a size, asked of Python's own entries: what they call may be replaced."""

import pytest

from benchdragon.kernels import size_question

ENTRIES = "open_size", "close_size", "seek_size", "read_size", "step_size"


def in_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let plain Python answer the question, by the engine's other entries."""
    for name in ENTRIES:
        entry = getattr(size_question, name)
        monkeypatch.setattr(size_question, name, getattr(entry, "__wrapped__", entry))
