"""What installers run to put the kernels' library into a wheel."""

import os
import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.scripts import script

ROOT = Path(__file__).parents[2]


def test_the_builder_finds_what_an_isolated_installer_put_elsewhere(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    module: Any = script("hatch_build.py")
    seen: list[str] = []

    def build(_line: list[str], env: dict[str, str], check: bool) -> SimpleNamespace:
        seen.extend(env["PYTHONPATH"].split(os.pathsep))
        return SimpleNamespace(returncode=1)

    monkeypatch.setattr(subprocess, "run", build)
    monkeypatch.setenv("PYTHONPATH", "/where/numba/is")
    app = SimpleNamespace(display_warning=lambda _text: None)
    hook = module.KernelsHook(str(ROOT), {}, None, None, str(ROOT), "wheel", app)
    hook.initialize("standard", {})
    hook.finalize("standard", {}, "")
    assert seen == [str(ROOT / "src"), "/where/numba/is"]
