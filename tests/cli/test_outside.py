"""Obstacles that lie outside the venue are warned of."""

from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.i18n import spoken_in

PLAN = """schema = 1
[dragon]
benches = 3
[route]
kind = "parts"
part = [{{ kind = "line", length = 12 }}]
at = [-6, 0]
[walk]
start = 9
end = 10
[venue]
rectangle = [28, 22]
[[obstacle]]
kind = "circle"
name = "well"
centre = {centre}
radius = 0.6
"""


@pytest.mark.parametrize(
    ("centre", "outside"), [("[9, 12]", True), ("[12, 9]", False), ("[9, 11.5]", False)]
)
@pytest.mark.parametrize("verb", [["check"], ["solve", "place"]])
def test_an_obstacle_outside_the_venue_is_warned_of(
    verb: list[str],
    centre: str,
    outside: bool,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / "ours.dragon.toml"
    path.write_text(PLAN.format(centre=centre), "utf-8")
    with spoken_in("en"):
        assert run([*verb, str(path), "--quiet"]) == 0
    said = capsys.readouterr().err
    assert ("well lies wholly outside the venue" in said) == outside, said
