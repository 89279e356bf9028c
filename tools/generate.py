"""Write every file of the repository that is made from other files of it: `make generate`.

Fonts, the pages' carried libraries, engine.wasm and the moving picture have targets of their own: they
need packages, minutes or a browser.
"""

import subprocess
import sys
from pathlib import Path
from typing import Protocol

from tools import (
    make_constants,
    make_keys,
    make_map,
    make_messages,
    make_methods,
    make_plan_keys,
    make_twins,
    make_types,
)


class Tool(Protocol):
    """A module that makes files."""

    def files(self) -> dict[Path, str] | dict[Path, bytes]:
        """What it makes: the same sources give the same bytes."""


# In this order: constants are those that scripts name, texts are those of all scripts, and the manual's
# tables are told by the catalogue.
TOOLS: dict[str, Tool] = {
    "types of methods": make_methods,
    "modules of pages": make_twins,
    "keys of plans": make_plan_keys,
    "types of messages": make_types,
    "constants of pages": make_constants,
    "catalogue": make_messages,
    "tables of keys": make_keys,
    "map of rooms": make_map,
}


def stale(tool: Tool) -> dict[Path, bytes]:
    """The files of a tool that are not as it makes them, and how it makes them."""
    found = {}
    for path, said in tool.files().items():
        made = said if isinstance(said, bytes) else said.encode()
        if not path.is_file() or path.read_bytes() != made:
            found[path] = made
    return found


def write(name: str) -> None:
    """Write what is stale of a tool, and say what was written."""
    found = stale(TOOLS[name])
    for path, said in found.items():
        path.write_bytes(said)
    print(f"{name}: {', '.join(path.name for path in found) or 'as before'}")


if __name__ == "__main__":
    for asked in sys.argv[1:]:
        write(asked)
    if not sys.argv[1:]:
        # A process each: what one writes, the next reads anew.
        for one in TOOLS:
            subprocess.run([sys.executable, "-m", "tools.generate", one], check=True)
