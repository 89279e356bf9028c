"""Where every handle of a bench dragon is, and how fast, on any route: the one public door.

Its names stand in `__init__.pyi`. They are fetched on first use, so that `benchdragon --help` need not
wait for numba.
"""

import lazy_loader

from benchdragon.version import __version__ as __version__

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
