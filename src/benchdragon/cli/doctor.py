"""What this machine offers: versions, fonts, cache, and programs that later verbs can use."""

import os
import platform
import shutil
from dataclasses import dataclass
from importlib import metadata, util

from benchdragon.cli.options import no_cache
from benchdragon.export.encoders import find_ffmpeg
from benchdragon.figures.style import FONT_FILES
from benchdragon.i18n import N_, _, language
from benchdragon.kernels import jit, native
from benchdragon.version import __version__

LIBRARIES = (
    "numpy",
    "numba",
    "scipy",
    "matplotlib",
    "pydantic",
    "click",
    "rich",
    "XlsxWriter",
    "python-calamine",
)
EXTRAS = {
    N_("extra data"): ("xarray", "pyarrow", "h5netcdf", "h5py"),
    N_("extra prove"): ("flint",),
    N_("extra video"): ("imageio_ffmpeg",),
}
PROGRAMS = {N_("browser"): ("chromium", "google-chrome", "firefox")}


@dataclass(frozen=True)
class Finding:
    """One line of the doctor: what, how it stands, and whether that is all right."""

    name: str
    value: str
    good: bool


def findings() -> list[Finding]:
    """Everything worth knowing when something does not work."""
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
    found.append(kernels())
    ffmpeg = find_ffmpeg()
    found.append(Finding("ffmpeg", ffmpeg or _("not found: films become GIFs"), ffmpeg is not None))
    for name, programs in PROGRAMS.items():
        path = next((place for place in map(shutil.which, programs) if place), None)
        found.append(Finding(name, path or _("not found (nothing needs it yet)"), path is not None))
    return found


def advice() -> list[str]:
    """What a reader who is no programmer can make of it, a sentence each, in the language in use."""
    if not all(path.is_file() for path in FONT_FILES):
        return [
            _("The package's fonts are missing: unpack its folder again, and type pip install . there.")
        ]
    said = [
        _(
            "All that sheets, chalk plan, drum and player need is here. What begins with - is for "
            "other things: films, proofs, other tables."
        )
    ]
    if jit.ENGINE != jit.NATIVE:
        said.append(
            _(
                "The first questions take some minutes, for the kernels are compiled then: wait. With "
                "a C compiler (gcc), pip install . does so once for all."
            )
        )
    return said


def kernels() -> Finding:
    """Which engine serves the kernels, and why."""
    if jit.ENGINE == jit.NATIVE:
        return Finding(
            N_("kernels"),
            _("library built ahead of time: {path}").format(path=native.find_library()),
            True,
        )
    if jit.ENGINE == jit.PLAIN:
        return Finding(N_("kernels"), _("plain Python, as BENCHDRAGON_ENGINE says"), False)
    cache = jit.CACHE_FOLDER or no_cache()
    if os.environ.get(jit.VARIABLE):
        why = _("compiled by numba, as BENCHDRAGON_ENGINE says: {cache}")
    else:
        why = _(
            "compiled by numba, as no library here was built from these kernels for this processor "
            "(`python -m benchdragon.engine` builds it): {cache}"
        )
    return Finding(N_("kernels"), why.format(cache=cache), jit.CACHE_FOLDER is not None)
