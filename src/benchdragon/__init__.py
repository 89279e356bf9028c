"""Position and speed of every handle of a bench dragon on any route: the public interface.

Its names stand in `__init__.pyi`. They are fetched on first use, so that `benchdragon --help` need not
wait for NumPy.
"""

import lazy_loader

from benchdragon.hosts.trouble import EngineError
from benchdragon.methods import Method
from benchdragon.version import __version__ as __version__

_fetch, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    """A public name.

    Raises:
        InputError: if the engine that is to serve cannot.
    """
    try:
        return _fetch(name)
    except EngineError as error:
        from benchdragon.errors import engine_advice

        raise engine_advice(error) from None


Method.fetch = __getattr__
