"""What numba makes of each function, kept as text: optimise.py makes one module of all of it.

numba by itself links each function with all that it calls, and makes machine code of all that for each,
to run it in the current process. That took 60 % of a build's time and 80 % of its memory.
"""

from collections.abc import Iterable
from typing import Any

from numba.core import cgutils, codegen, types
from numba.core.registry import CPUDispatcher

compiler: Any = codegen  # their annotations are partial
dispatcher: Any = CPUDispatcher
kinds: Any = types
tools: Any = cgutils


class Piece(compiler.JITCodeLibrary):  # type: ignore[misc]
    """The code of one function, and the pieces that it calls; nothing of it runs here."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.texts: list[str] = []

    def add_ir_module(self, ir_module: Any) -> None:
        """Keep a module of numba's as text."""
        self.texts.append(tools.normalize_ir_text(str(ir_module)))

    def finalize(self) -> None:
        """Neither link nor optimise."""
        self._finalized = True

    def get_pointer_to_function(self, _name: str) -> int:
        """No address, as of what is not there."""
        return 0


class Pieces(compiler.JITCPUCodegen):  # type: ignore[misc]
    """Makes pieces."""

    _library_class = Piece

    def set_env(self, _name: str, _environment: Any) -> None:
        """Tell no code where Python's objects lie."""


def keep_pieces() -> None:
    """Let numba make pieces of what it compiles in this process; nothing was compiled yet.

    And one of each function: numba by itself makes another for each whole number that a call names.
    """
    compiler.JITCPUCodegen = Pieces
    template = dispatcher.get_call_template

    def call_template(function: Any, arguments: Any, options: Any) -> Any:
        return template(function, tuple(map(kinds.unliteral, arguments)), options)

    dispatcher.get_call_template = call_template


def texts(pieces: Iterable[Piece]) -> list[str]:
    """The modules of pieces and of all that they call, each once."""
    found: dict[Piece, None] = {}
    todo = list(pieces)
    while todo:
        piece = todo.pop()
        if piece not in found:
            found[piece] = None
            todo += piece._linking_libraries
    return [text for piece in found for text in piece.texts]
