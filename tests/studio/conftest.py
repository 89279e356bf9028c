"""One studio for all tests that ask ordinary questions: its workers take seconds to start."""

from collections.abc import Iterator

import pytest

from benchdragon.studio.limits import Settings
from tests.studio.servers import Served, served


@pytest.fixture(scope="package")
def studio() -> Iterator[Served]:
    with served(Settings(port=0, workers=1)) as found:
        yield found
