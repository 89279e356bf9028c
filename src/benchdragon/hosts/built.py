"""What is built ahead of time from the kernels: where it lies, and what it must be built from."""

import hashlib
import os
import platform
import sys
from pathlib import Path

PACKAGE = Path(__file__).parents[1]
KERNELS = PACKAGE / "kernels"
# What builds library and module, and where these then lie.
ENGINE = PACKAGE / "engine"
# How entries are called: the one file of this room that decides about what is built.
CONVENTION = PACKAGE / "hosts" / "signature.py"
# The module of all kernels, and the section in which it says what it is.
MODULE, SECTION = "engine.wasm", "benchdragon"
# What a processor of level x86-64-v3 has, as Linux names it: nearly all since 2015. Wider vectors would
# gain an eighth at most, and one level gives the same bits on all machines (design/engine.py).
V3 = frozenset(["abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"])
PROCESSORS = Path("/proc/cpuinfo")


def source_hash() -> str:
    """A hash of the text of all kernels, of how they are called, and of what builds them."""
    files = (path for folder in (KERNELS, ENGINE) for path in folder.iterdir())
    sources = sorted(path for path in files if path.suffix in (".py", ".c"))
    text = b"".join(path.name.encode() + b"\0" + path.read_bytes() for path in (*sources, CONVENTION))
    return hashlib.sha256(text).hexdigest()[:16]


def processor() -> str:
    """The level of this machine's processor: x86-64-v3 where it is known to be that."""
    machine = platform.machine().lower().replace("amd64", "x86_64")
    if machine != "x86_64":
        return machine
    try:
        with PROCESSORS.open(encoding="utf-8") as lines:
            flags = next((line for line in lines if line.startswith("flags")), "")
    except OSError:
        flags = ""
    return "x86-64-v3" if set(flags.split()) >= V3 else "x86-64"


def user_folder() -> Path | None:
    """The user's own folder of what is built, for packages in read-only folders.

    None for a user without a home folder.
    """
    told = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")  # the latter by Windows
    usual = "Library/Caches" if sys.platform == "darwin" else ".cache"
    try:
        return (Path(told) if told else Path.home() / usual) / "benchdragon"
    except RuntimeError:
        return None
