"""Puts the kernels' library into a wheel, where numba and a C compiler are at hand."""

import os
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class KernelsHook(BuildHookInterface):  # type: ignore[type-arg]
    """Builds the library; without it numba compiles the kernels on first use."""

    def dependencies(self) -> list[str]:
        """What the builder imports."""
        return ["lazy-loader>=0.4", "numba>=0.61"]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build into a folder that lasts as long as the wheel is made."""
        if version == "editable":  # there `make` builds, and again after each change
            return
        self.folder = tempfile.TemporaryDirectory()
        # Before the builder's own: an installer that builds apart says there where numba is.
        paths = [str(Path(self.root, "src")), *filter(None, [os.environ.get("PYTHONPATH")])]
        done = subprocess.run(
            [sys.executable, "-m", "benchdragon.engine", self.folder.name],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
            check=False,
        )
        built = list(Path(self.folder.name).glob("kernels-*.so"))
        if done.returncode or not built:
            self.app.display_warning("no library of the kernels: numba will compile them on first use")
            return
        build_data["force_include"][str(built[0])] = f"benchdragon/engine/{built[0].name}"
        build_data["pure_python"] = False
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        build_data["tag"] = f"py3-none-{platform}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Throw the folder away."""
        del build_data, artifact_path
        if version != "editable":
            self.folder.cleanup()
