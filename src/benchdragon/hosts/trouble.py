"""What can be wrong with an engine."""

from enum import Enum


class Trouble(Enum):
    """Why an engine cannot serve, or broke off."""

    UNKNOWN = "its name is none"
    NO_LIBRARY = "no library was built from these kernels for this processor"
    OTHER_SOURCES = "engine.wasm was built from other kernels"
    NO_WASMTIME = "Wasmtime cannot be loaded or started"
    BROKEN_OFF = "a call did not come to its end"


class EngineError(Exception):
    """An engine cannot serve.

    Args:
        trouble: why.
        detail: the name that was given for an engine, or what Wasmtime says.
    """

    def __init__(self, trouble: Trouble, detail: str = "") -> None:
        super().__init__(trouble, detail)
        self.trouble, self.detail = trouble, detail

    def __str__(self) -> str:
        return f"{self.trouble.value}: {self.detail}" if self.detail else self.trouble.value
