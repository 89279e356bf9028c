"""The page of what sweeps came to, read as a browser reads it."""

import base64
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from bs4 import BeautifulSoup

from benchdragon import Plan, Points, Sweep, read_plan, sampled_points, sweep
from benchdragon.export.atlas import write_atlas
from benchdragon.sweeps.points import grid_points, listed_points

PLAN = read_plan("spiral-in", ["dragon.benches=25"])
PITCHES = [0.5, 0.52, 0.54]
TITLED = read_plan(
    "spiral-in", ["dragon.benches=25", 'meta.title="<b>&amp; "', 'meta.title_zh="<b>龙"']
)


def swept(plan: Plan, points: Points, *ask: str) -> Sweep:
    with ThreadPoolExecutor(2) as threads:
        return sweep(plan, points, ask or ("first_contact",), executor=threads)


@pytest.fixture(scope="module")
def sweeps() -> dict[str, Sweep]:
    return {
        "out/a": swept(PLAN, grid_points({"route.pitch": PITCHES}), "first_contact", "clearance"),
        "out/b": swept(
            TITLED, grid_points({"route.pitch": [-1.0, 0.4, 0.5], "dragon.width": [0.2, 0.3]})
        ),
        "out/c": swept(PLAN, sampled_points({"route.pitch": (0.4, 0.5)}, 4)),
        "out/d": swept(PLAN, listed_points({"walk.end": [1.0, 2.0]})),
    }  # fmt: skip


def written(sweeps: dict[str, Sweep], folder: Path) -> BeautifulSoup:
    path = folder / "atlas.html"
    told: list[tuple[float, str]] = []
    write_atlas(path, sweeps, lambda share, text: told.append((share, text)))
    assert len(told) == sum(len(one.questions) for one in sweeps.values())
    return BeautifulSoup(path.read_text("utf-8"), "html.parser")


def test_the_page_holds_a_numbered_picture_of_every_question(
    sweeps: dict[str, Sweep], tmp_path: Path, spoken: str
) -> None:
    page = written(sweeps, tmp_path)
    figures = page.find_all("figure")
    assert len(figures) == 5
    word = {"en": "Figure", "zh": "图"}[spoken]
    for number, figure in enumerate(figures, start=1):
        caption, image = figure.find("figcaption"), figure.find("img")
        assert caption is not None
        assert image is not None
        assert re.match(
            rf"{word} {number}\. .*route\.pitch|{word} {number}\. .*walk\.end", caption.get_text()
        )
        kind, _comma, data = str(image["src"]).partition(",")
        assert kind == "data:image/svg+xml;base64"
        assert base64.b64decode(data).startswith(b"<?xml")
    assert page.html is not None
    assert page.html["lang"] == {"en": "en", "zh": "zh-Hans"}[spoken]
    text = page.get_text()
    one, other = {"en": ("first contact", "首次碰撞"), "zh": ("首次碰撞", "first contact")}[spoken]
    assert one in text
    assert other not in text
    assert "http" not in "".join(str(tag.get("src") or tag.get("href")) for tag in page.find_all())


def test_each_chapter_has_its_plan_its_command_and_its_answers(
    sweeps: dict[str, Sweep], tmp_path: Path
) -> None:
    page = written(sweeps, tmp_path)
    commands = [pre.get_text() for pre in page.find_all("pre")]
    assert commands[0] == (
        "benchdragon sweep spiral-in --set dragon.benches=25 --vary route.pitch=0.5..0.54..0.02 "
        "--ask first_contact,clearance -o out/a"
    )
    assert "--sample 4 --seed 1 --method latin-hypercube" in commands[2]
    assert "--points points.parquet" in commands[3]
    text = re.sub(r"\s+", " ", page.get_text())
    assert "points.parquet: the columns of the keys in the first 2 rows of out/d." in text
    assert "3 points. Table 1 lists the keys." in text
    for one in sweeps.values():
        assert one.about["plan_sha256"][:12] in text
    assert "answers: found: 4; cannot be: 2." in text
    assert "no contact: 2" in text
    headings = [heading.get_text() for heading in page.find_all("h2")]
    assert headings[1:] == [
        "Coiling in: over route.pitch", "<b>&amp; : over route.pitch, dragon.width",
        "Coiling in: over route.pitch", "Coiling in: over walk.end",
    ]  # fmt: skip


def test_the_extreme_answers_are_those_of_the_rows(sweeps: dict[str, Sweep], tmp_path: Path) -> None:
    page = written(sweeps, tmp_path)
    found = sweeps["out/a"].column("first_contact.value")
    pitch = sweeps["out/a"].column("route.pitch")
    table = page.find(id="shown-extremes-1-first_contact")
    assert table is not None
    rows = [[cell.get_text() for cell in row.find_all("td")] for row in table.find_all("tr")[1:]]
    least, greatest = found.argmin(), found.argmax()
    assert rows[0][:2] == ["least", f"{found[least]:.10g}"]
    assert rows[0][3] == f"{pitch[least]:.10g}"
    assert rows[1][:2] == ["greatest", f"{found[greatest]:.10g}"]
    assert rows[1][3] == f"{pitch[greatest]:.10g}"
    pair = [int(sweeps["out/a"].column(f"first_contact.bench_{n}")[least]) for n in (1, 2)]
    assert rows[0][4] == f"benches {pair[0]} and {pair[1]}"
    assert page.find(id="shown-extremes-4-first_contact") is None  # no answer at all


def test_titles_are_words_and_no_marks(sweeps: dict[str, Sweep], tmp_path: Path) -> None:
    page = written(sweeps, tmp_path)
    assert page.find_all("b") == []


def test_a_plan_that_is_a_file_is_printed_and_what_is_missing_is_told(tmp_path: Path) -> None:
    plan = read_plan(str(Path(__file__).parents[2] / "examples" / "02_eight.dragon.toml"))
    made = swept(plan, grid_points({"walk.speed": [0.5, 1.0]}), "clearance")
    part = Sweep({**made.about, "finished": False}, made.table.slice(0, 1))
    page = written({"x": part}, tmp_path)
    printed = page.find_all("pre")[1].get_text()
    (tmp_path / "plan.dragon.toml").write_text(printed, encoding="utf-8")
    assert read_plan(str(tmp_path / "plan.dragon.toml")).sha256 == plan.sha256
    assert "1 points of 2: it is not complete" in re.sub(r"\s+", " ", page.get_text())


def test_where_no_command_makes_a_sweep_its_chapter_says_why(tmp_path: Path, spoken: str) -> None:
    made = swept(PLAN, grid_points({"meta.title": ["1"], "route.pitch": [0.5]}))
    page = written({"x": made}, tmp_path)
    assert page.find_all("pre") == []
    said = {
        "en": "No command line makes this sweep: --vary cannot say the values of meta.title.",
        "zh": "没有命令行能做这次扫描：--vary 写不出 meta.title 的值。",
    }[spoken]
    assert said in [paragraph.get_text() for paragraph in page.find_all("p")]
