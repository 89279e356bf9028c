"""The decorators of all kernels: which of them others call, and which make arrays.

Kernels are Python. Which host serves their entries is chosen in hosts/serving.py.
"""

from collections.abc import Callable
from typing import Any, TypeVar

from benchdragon.hosts.serving import serving

Function = TypeVar("Function", bound=Callable[..., object])

# All entries, by the module and name of each.
ENTRIES: dict[str, Callable[..., object]] = {}
# Makes compiled functions of kernels where these are built (engine/shims.py).
compiler: Callable[[Any], Any] | None = None


def allocates(function: Function) -> Function:
    """`function`, which makes arrays of its own or is given some by one that does.

    All others count no references to arrays, which would take an eighth of the time of searches.
    """
    marked: Any = function
    marked.allocates = True
    return function


def kernel(function: Function) -> Function:
    """`function`, called by kernels alone."""
    return function if compiler is None else compiler(function)


def entry(function: Function) -> Function:
    """`function`, called by Python as well: the serving host answers.

    Its annotations must state the layout of every array (arrays.py).
    """
    ENTRIES[f"{function.__module__}.{function.__name__}"] = function
    return serving().bound(function) if compiler is None else compiler(function)
