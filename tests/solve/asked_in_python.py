"""Questions of the engine asked of Python's own entries: what they call may be replaced."""

import pytest

from benchdragon.kernels import (
    contact_question,
    obstacle_question,
    question,
    random_dance_question,
    size_question,
    speed_question,
)

ENTRIES = {
    obstacle_question: [
        "open_obstacle",
        "seek_obstacle",
        "step_obstacle",
        "read_obstacle",
        "read_found",
        "read_ways",
    ],
    question: ["close_question"],
    contact_question: ["open_contact", "seek_contact", "read_contact", "step_contact"],
    speed_question: ["open_peak", "read_peak", "step_peak"],
    size_question: ["open_size", "seek_size", "read_size", "step_size"],
    random_dance_question: ["open_dance", "read_dance", "step_dance"],
}


def in_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let plain Python answer questions, by the engine's other entries."""
    for module, names in ENTRIES.items():
        for name in names:
            entry = getattr(module, name)
            monkeypatch.setattr(module, name, getattr(entry, "__wrapped__", entry))
