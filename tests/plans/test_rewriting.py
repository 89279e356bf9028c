"""A plan file that is written again with other values keeps its comments and the order of its lines."""

from pathlib import Path

import pytest

from benchdragon.cli.main import run
from benchdragon.plans.rewriting import rewritten
from benchdragon.plans.schema import read_plan

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.dragon.toml"))
TEXT = """# Our dance. Width was measured by nobody.
schema = 1

[dragon]
benches = 8
width = "15 cm"  # m: (assumed)

[route]
kind = "spiral-in"  # inwards
at = [1.0, 2.0]  # m (proposed)
pitch = 1.2
clockwise = true  # as ever

[walk]
speed = 0.8  # m/s (proposed)
end = 12

[[obstacle]]  # ours
kind = "circle"
name = "井"
centre = [13, 8]
radius = 0.6
"""


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "ours.dragon.toml"
    path.write_text(TEXT, "utf-8")
    return path


def test_only_what_changes_is_written_anew(source: Path) -> None:
    plan = read_plan(str(source)).with_values({"route.at": [3.5, -1.25], "route.turned": 30.0})
    text = rewritten(plan, str(source))
    assert "at = [3.5, -1.25]  # m (proposed)\n" in text
    lines = [line for line in text.splitlines() if not line.startswith(("at = ", "turned = "))]
    assert lines == [line for line in TEXT.splitlines() if not line.startswith("at = ")]
    source.write_text(text, "utf-8")
    assert read_plan(str(source)) == plan


@pytest.mark.parametrize("speed", ["0.8", "1.0"])
def test_what_a_plan_does_not_say_any_more_goes(source: Path, speed: str) -> None:
    source.write_text(TEXT.replace("speed = 0.8", f"speed = {speed}"), "utf-8")
    plan = read_plan(str(source)).with_values({"walk.profile": [[0, 0.5], [9, 0.8]]})
    text = rewritten(plan, str(source))
    assert "speed = " not in text
    assert 'width = "15 cm"  # m: (assumed)\n' in text
    source.write_text(text, "utf-8")
    assert read_plan(str(source)).data() == plan.data()


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_a_plan_that_nobody_changed_is_the_same_text(path: Path) -> None:
    plan = read_plan(str(path))
    text = path.read_text("utf-8")
    assert rewritten(plan, str(path)) == (plan.toml() if "\nbase = " in text else text)


def test_a_plan_on_a_base_is_written_whole(source: Path) -> None:
    own = source.with_name("own.dragon.toml")
    own.write_text('schema = 1\nbase = "ours.dragon.toml"\n[walk]\nspeed = 0.7  # slow\n', "utf-8")
    plan = read_plan(str(own))
    assert rewritten(plan, str(own)) == plan.toml()


def test_the_best_place_is_written_beside_its_comments(source: Path) -> None:
    source.write_text(TEXT + "[venue]\nrectangle = [40, 30]  # m: measured\n", "utf-8")
    found = source.with_name("found.dragon.toml")
    assert run(["solve", "place", str(source), "-o", str(found), "--quiet"]) == 0
    text = found.read_text("utf-8")
    assert text.startswith(TEXT[: TEXT.index("schema")])
    for comment in ("(assumed)", "# inwards", "# m (proposed)", "# ours", "# m: measured"):
        assert comment in text
    assert read_plan(str(found)).route.at != (1.0, 2.0)


def test_what_was_added_to_a_placed_plan_is_named_when_it_is_placed_anew(
    source: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source.write_text(TEXT + "[venue]\nrectangle = [40, 30]\n", "utf-8")
    found = source.with_name("found.dragon.toml")
    line = [
        "solve",
        "place",
        str(source),
        "-o",
        str(found),
        "--quiet",
        "--lang",
        "en",
        "--force",
    ]
    assert run(line) == 0
    assert "WARNING" not in capsys.readouterr().err
    found.write_text(found.read_text("utf-8") + "[chalk]\nstray = 0.2\n", "utf-8")
    assert run(line) == 0
    assert "as they were in the one it replaces: [chalk]." in capsys.readouterr().err
