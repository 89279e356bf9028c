"""What this machine offers: versions, fonts, the engine, and programs that later verbs can use."""

import math
import platform
import time
from dataclasses import dataclass
from importlib import metadata, util

from benchdragon.errors import engine_advice
from benchdragon.export.encoders import find_ffmpeg
from benchdragon.figures.style import FONT_FILES
from benchdragon.hosts import compiled, native
from benchdragon.hosts.serving import NATIVE, PLAIN, serving
from benchdragon.hosts.trouble import EngineError
from benchdragon.i18n import N_, _, language
from benchdragon.planner.printing import find_browser
from benchdragon.version import __version__

LIBRARIES = (
    "numpy", "scipy", "wasmtime", "matplotlib", "pydantic", "click", "rich", "XlsxWriter",
    "python-calamine",
)  # fmt: skip
EXTRAS = {
    N_("extra data"): ("xarray", "pyarrow", "h5netcdf", "h5py"),
    N_("extra prove"): ("flint",),
    N_("extra video"): ("imageio_ffmpeg",),
}


@dataclass(frozen=True)
class Finding:
    """One line of the doctor: what, how it stands, and whether that is all right."""

    name: str
    value: str
    good: bool


def findings() -> list[Finding]:
    """All facts that help when something does not work."""
    found = [
        Finding("benchdragon", __version__, True),
        Finding("python", platform.python_version(), True),
        Finding(N_("platform"), platform.platform(), True),
        Finding(N_("language"), language(), True),
    ]
    found += [Finding(name, metadata.version(name), True) for name in LIBRARIES]
    for label, names in EXTRAS.items():
        extra = label.removeprefix("extra ")
        missing = [name for name in names if util.find_spec(name) is None]
        advice = _("missing {names}: pip install 'benchdragon[{extra}]'").format(
            names=", ".join(missing), extra=extra
        )
        found.append(Finding(label, advice if missing else ", ".join(names), not missing))
    fonts = [path for path in FONT_FILES if path.is_file()]
    found.append(
        Finding(N_("fonts"), ", ".join(path.name for path in fonts), len(fonts) == len(FONT_FILES))
    )
    found += engine()
    ffmpeg = find_ffmpeg()
    found.append(Finding("ffmpeg", ffmpeg or _("not found: films become GIFs"), ffmpeg is not None))
    browser = find_browser()
    without = _("not found (only sheets --pdf needs one)")
    return [*found, Finding(N_("browser"), browser or without, browser is not None)]


def advice() -> list[str]:
    """What a reader who is no programmer can make of it, a sentence each, in the language in use."""
    if not all(path.is_file() for path in FONT_FILES):
        return [
            _("The package's fonts are missing: unpack its folder again, and type pip install . there.")
        ]
    return [
        _(
            "All that sheets, chalk plan, drum and player need is here. What begins with - is for "
            "other things: films, proofs, other tables."
        )
    ]


# Times of the dance that are timed, in steps of a second; how often: the least counts.
PLACED, ROUNDS = 32, 3


def engine() -> list[Finding]:
    """Which engine serves the kernels and why, how to get the faster one, and how fast it is."""
    try:
        name = serving().name
    except EngineError as error:
        return [Finding(N_("engine"), str(engine_advice(error)), False)]
    if name == NATIVE:
        text = _("library built ahead of time: {path}").format(path=native.find_library())
    elif name == PLAIN:
        text = _("plain Python, as BENCHDRAGON_ENGINE says")
    else:
        folder = compiled.kept_folder()
        text = _(
            "engine.wasm; a library is about twice as fast: pip install 'benchdragon[build]', "
            "and with a C compiler (gcc) `python -m benchdragon.engine` builds it"
        )
        if folder is None:
            text += "; " + _(
                "there is no folder for compiled code that can be written and is yours alone, so each "
                "start takes half a second more; set XDG_CACHE_HOME to a folder of your own"
            )
    try:
        speed = _("{count} ns to place a handle").format(count=f"{1e9 * seconds_a_handle():.0f}")
    except EngineError as error:
        return [Finding(N_("engine"), str(engine_advice(error)), False)]
    return [Finding(N_("engine"), text, name != PLAIN), Finding(N_("speed"), speed, True)]


def seconds_a_handle() -> float:
    """What the engine takes for a handle at one time of the contest's dance, s."""
    from benchdragon.plans.schema import read_plan

    walk = read_plan("spiral-in").build()
    times = [float(second) for second in range(PLACED)]
    best = math.inf
    for _round in range(ROUNDS):
        start = time.perf_counter()
        walk.motion(times)
        best = min(best, time.perf_counter() - start)
    return best / (PLACED * (len(walk.dragon) + 1))
