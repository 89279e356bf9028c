"""engine.wasm, run by Wasmtime: the kernels where no library was built.

Arrays that a call is given are copied into the module's memory and back, but those that lie there
already (`Instance.array`). A memory of 32-bit addresses never moves here, as there is room from the
start for all that it may ever hold. An instance serves one thread; each has its own.
"""

import atexit
import ctypes
import functools
import json
import math
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple, TypeVar, cast
from weakref import WeakSet

import numpy as np
import numpy.typing as npt

from benchdragon.hosts import built, compiled
from benchdragon.hosts.arguments import DTYPES, Block, address
from benchdragon.hosts.signature import signature
from benchdragon.hosts.trouble import EngineError, Trouble

Function = TypeVar("Function", bound=Callable[..., object])

# What 32-bit addresses reach, in bytes; so much room for copies is kept from call to call, more is not.
REACH, KEPT = 1 << 32, 1 << 24
# Copies and blocks begin at multiples of so many bytes.
ALIGNED = 16
HEADER = b"\0asm\1\0\0\0"


def told(code: bytes) -> dict[str, Any]:
    """What a module says of itself in its last section: its stamp, and its entries."""
    title = bytes([len(built.SECTION)]) + built.SECTION.encode()
    contents = [content for kind, content in sections(code) if kind == 0 and content.startswith(title)]
    found: dict[str, Any] = json.loads(contents[-1].removeprefix(title))
    return found


def sections(code: bytes) -> Iterator[tuple[int, bytes]]:
    """Kind and content of each section of a module."""
    at = len(HEADER)
    while at < len(code):
        kind, size, shift = code[at], 0, 0
        while True:  # a whole number, seven bits a byte, the lowest first
            at += 1
            size |= (code[at] & 0x7F) << shift
            shift += 7
            if code[at] < 0x80:
                break
        yield kind, code[at + 1 : at + 1 + size]
        at += 1 + size


def code_of_these_kernels() -> bytes:
    """The module.

    Raises:
        EngineError: if it was built from other kernels than these.
    """
    code = (built.ENGINE / built.MODULE).read_bytes()
    if told(code)["stamp"]["sources"] != built.source_hash():
        raise EngineError(Trouble.OTHER_SOURCES)
    return code


class Span(NamedTuple):
    """Bytes from one address up to another that a call takes; whether it may write them."""

    start: int
    end: int
    written: bool


class Host:
    """The module, compiled once and at work in an instance for each thread.

    Args:
        code: of the module.
    """

    def __init__(self, code: bytes) -> None:
        self._code, self._lock, self._threads = code, threading.Lock(), threading.local()
        self._made: tuple[Any, Any] | None = None
        self._instances = WeakSet[Instance]()
        atexit.register(self._leave)

    def _leave(self) -> None:
        """Leave to the system what is Wasmtime's: Python would free it when Wasmtime is gone."""
        for kept in (self._made, *self._instances):
            ctypes.pythonapi.Py_IncRef(ctypes.py_object(kept))

    def bound(self, function: Function) -> Function:
        """The entry of the module that was built from `function`."""
        block = Block(signature(function), signed_address)

        @functools.wraps(function)
        def wasm(*arguments: Any) -> Any:
            slots = block.read(arguments)
            return self.instance().call(block, slots)

        return cast("Function", wasm)

    def instance(self) -> "Instance":
        """The instance of this thread, made again after one failed.

        Raises:
            EngineError: if Wasmtime cannot be started.
        """
        found: Instance | None = getattr(self._threads, "instance", None)
        if found is None or found.broken:
            with self._lock:
                self._made = self._made or compiled.module(self._code)
            found = self._threads.instance = Instance(*self._made)
            self._instances.add(found)
        return found


class Instance:
    """The module at work: its memory, and calls of its entries.

    Args:
        engine: Wasmtime's.
        module: compiled by it.

    Attributes:
        broken: whether a call did not come to its end, which leaves its memory as it was then.

    Raises:
        EngineError: if the system has no room for its memory.
    """

    def __init__(self, engine: Any, module: Any) -> None:
        import wasmtime

        self._store, self.broken = wasmtime.Store(engine), False
        self._troubles = wasmtime.WasmtimeError, wasmtime.Trap
        try:
            self._exports = wasmtime.Instance(self._store, module, []).exports(self._store)
        except self._troubles as trouble:
            raise EngineError(Trouble.NO_WASMTIME, first_line(trouble)) from None
        self._run("_initialize")
        memory = cast("Any", self._exports["memory"]).data_ptr(self._store)
        self._base = ctypes.addressof(memory.contents)
        self._given_back = deque[int]()
        self._kept, self._size = 0, 0
        self._blocks: dict[str, tuple[int, memoryview]] = {}

    def array(self, shape: Sequence[int], code: str) -> npt.NDArray[Any]:
        """An uninitialised array in the memory, of a code of DTYPES.

        Raises:
            MemoryError: if there is none.
        """
        self._free()
        return np.asarray(Held(self, self._room(8 * math.prod(shape)), self._base, tuple(shape), code))

    def give_back(self, at: int) -> None:
        """Free room, once it is this thread's turn."""
        self._given_back.append(at)

    def call(self, block: Block, slots: list[Any]) -> Any:
        """Call an entry; what it returns.

        Raises:
            MemoryError: if there is none for its arrays or its scratch.
            EngineError: if it breaks off.
        """
        self._free()
        outside = self._addressed(block, slots)
        spans = list(joined(span for _slot, span in outside))
        total = sum(rounded(span.end - span.start) for span in spans)
        copies = self._scratch(total) if spans else 0
        try:
            at, places = copies, list[int]()
            for span in spans:
                ctypes.memmove(self._base + at, span.start, span.end - span.start)
                places.append(at)
                at += rounded(span.end - span.start)
            for slot, span in outside:
                n = next(n for n, each in enumerate(spans) if each.start <= span.start < each.end)
                slots[slot] = places[n] + span.start - spans[n].start
            result = self._entered(block, slots)
            for span, place in zip(spans, places, strict=True):
                if span.written:
                    ctypes.memmove(span.start, self._base + place, span.end - span.start)
            return result
        finally:
            if copies and copies != self._kept:
                self.give_back(copies)

    def _addressed(self, block: Block, slots: list[Any]) -> list[tuple[int, Span]]:
        """Turn addresses in the memory into the module's own; the slots and spans of all others."""
        outside = []
        for slot, dimensions in block.arrays:
            start = abs(slots[slot])
            if self._base <= start < self._base + REACH:
                slots[slot] = start - self._base
                continue
            size = 8 * math.prod(slots[slot + 1 : slot + 1 + dimensions])
            if size:
                outside.append((slot, Span(start, start + size, slots[slot] > 0)))
            else:
                slots[slot] = 0
        return outside

    def _entered(self, block: Block, slots: Sequence[Any]) -> Any:
        if block.symbol not in self._blocks:
            at = self._room(block.size)
            place = (ctypes.c_char * block.size).from_address(self._base + at)
            self._blocks[block.symbol] = at, memoryview(place).cast("B")
        at, buffer = self._blocks[block.symbol]
        block.fill(buffer, slots)
        return block.result(buffer, self._run(block.symbol, at))

    def _scratch(self, size: int) -> int:
        """Room for the copies of a call."""
        if size > KEPT:
            return self._room(size)
        if size > self._size:
            if self._size:
                self._run("free", self._kept)
            self._size = 0
            self._kept = self._room(max(size, min(2 * size, KEPT)))
            self._size = max(size, min(2 * size, KEPT))
        return self._kept

    def _room(self, size: int) -> int:
        """The address of newly allocated bytes; MemoryError if there are none."""
        at = self._run("malloc", max(size, 1)) & (REACH - 1) if size < REACH // 2 else 0
        if not at:
            raise MemoryError(f"engine.wasm has no room for {size} bytes more")
        return at

    def _free(self) -> None:
        while self._given_back:
            self._run("free", self._given_back.popleft())

    def _run(self, name: str, *numbers: int) -> Any:
        function = cast("Any", self._exports[name])
        try:
            return function(self._store, *numbers)
        except self._troubles as trouble:
            self.broken = True
            raise EngineError(Trouble.BROKEN_OFF, f"{name}: {first_line(trouble)}") from None


class Held:
    """Memory of an array in an instance, freed when nothing refers to it any more."""

    def __init__(
        self, instance: Instance, at: int, base: int, shape: tuple[int, ...], code: str
    ) -> None:
        self._instance, self._at = instance, at
        self.__array_interface__ = {
            "data": (base + at, False), "shape": shape, "typestr": DTYPES[code].str, "version": 3,
        }  # fmt: skip

    def __del__(self) -> None:
        self._instance.give_back(self._at)


def joined(spans: Iterator[Span]) -> Iterator[Span]:
    """Spans without overlaps that hold the same bytes: what a call sees twice stays one thing."""
    whole: Span | None = None
    for span in sorted(spans):
        if whole is None or span.start >= whole.end:
            if whole is not None:
                yield whole
            whole = span
        else:
            whole = Span(whole.start, max(whole.end, span.end), whole.written or span.written)
    if whole is not None:
        yield whole


def rounded(size: int) -> int:
    """The least multiple of ALIGNED that holds so many bytes."""
    return -(-size // ALIGNED) * ALIGNED


def signed_address(array: npt.NDArray[Any]) -> int:
    """Where an array's numbers lie; as a negative number where the array is read-only."""
    return address(array) if array.flags.writeable else -address(array)


def first_line(trouble: Exception) -> str:
    """The line of Wasmtime's message that says what happened, without where."""
    lines = [line.strip() for line in str(trouble).splitlines() if line.strip()]
    return next((line for line in reversed(lines) if "trap:" in line), lines[0] if lines else "")
