"""A sweep: the same table wherever it runs and however often it is broken off."""

import errno
import json
import multiprocessing
import random
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from benchdragon import parallel, read_sweep, sweep
from benchdragon.errors import InputError, MachineError
from benchdragon.files import FileRefusedError
from benchdragon.parallel import Place, processes, threads
from benchdragon.plans.schema import read_plan
from benchdragon.plans.toml import PlanError
from benchdragon.sweeps import rows as rows_module
from benchdragon.sweeps import sweep as subject
from benchdragon.sweeps.folder import Rows, opened, parts_in
from benchdragon.sweeps.points import grid_points, listed_points, sampled_points
from benchdragon.sweeps.questions import RandomDances
from benchdragon.sweeps.refine import Refinement
from benchdragon.sweeps.rows import Ask
from benchdragon.sweeps.sweep import Design, Sweep
from tests.sweeps import work

# Only what hangs takes so long, s.
HANGS = 120.0
PLAN = read_plan("spiral-in", ["dragon.benches=8", "disc.radius=4.5"])
SPAWN = multiprocessing.get_context("spawn")


@pytest.fixture(scope="module")
def whole() -> Sweep:
    """All of it in one go."""
    return work.swept()


def short(**named: Any) -> Sweep:
    """A sweep of three points."""
    given = {"vary": {"route.pitch": [0.45, 0.5, 0.55]}, "executor": threads(1), **named}
    return sweep(PLAN, **given)


def counted(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Numbers of the points that are asked from here on."""
    asked: list[int] = []
    ask = Ask.row

    def row(self: Ask, number: int, values: Any) -> Any:
        asked.append(number)
        return ask(self, number, values)

    monkeypatch.setattr(Ask, "row", row)
    return asked


def test_each_row_is_that_of_its_point(whole: Sweep) -> None:
    points = grid_points(work.VARY)
    assert whole.table["point"].to_pylist() == list(range(len(points)))
    for number, (pitch, radius) in enumerate(points[n] for n in range(len(points))):
        assert whole.table["route.pitch"][number].as_py() == pitch
        assert whole.table["disc.radius"][number].as_py() == radius
    ask = Ask(
        work.PLAN,
        (("route.pitch", "float64"), ("disc.radius", "float64")),
        ("first_contact",),
        RandomDances(),
    )
    for number in (0, 7, 33, 80):
        row = ask.row(number, points[number])
        found = whole.table.slice(number, 1).to_pylist()[0]
        assert all(found[name] == cell for name, cell in row.items() if not name.endswith("seconds"))


def test_there_are_answers_of_every_kind(whole: Sweep) -> None:
    statuses = {*whole.texts("first_contact.status"), *whole.texts("greatest_speed.status")}
    assert statuses == {"found", "clear", "refused", "unwalkable", "undecided"}
    for name in work.ASKED:
        for status, message in zip(
            whole.texts(f"{name}.status"), whole.texts(f"{name}.message"), strict=True
        ):
            assert bool(message) == (status not in {"found", "clear"})


@pytest.mark.parametrize(("place", "kept"), [(processes(1), 1), (processes(2), 0), (threads(3), 1)])
def test_the_table_is_the_same_wherever_it_is_computed(
    whole: Sweep, place: Place, kept: int, tmp_path: Path
) -> None:
    output = tmp_path if kept else None
    assert work.swept(output, place).numbers().equals(whole.numbers())


def test_an_executor_of_the_caller_serves_and_stays_open(whole: Sweep) -> None:
    with ThreadPoolExecutor(2) as executor:
        assert work.swept(executor=executor).numbers().equals(whole.numbers())
        assert executor.submit(len, "abc").result() == 3


def test_a_sweep_that_is_killed_again_and_again_comes_to_the_same(tmp_path: Path, whole: Sweep) -> None:
    moments = random.Random(1)
    for _killed in range(10):
        before = len(parts_in(tmp_path)) if tmp_path.exists() else 0
        run = SPAWN.Process(target=work.sweep_in_small_parts, args=(tmp_path,))
        run.start()
        end = time.monotonic() + HANGS
        wanted = before + moments.randint(1, work.PARTS)
        while len(parts_in(tmp_path)) < wanted:
            assert time.monotonic() < end, "it hangs"
            time.sleep(0.001)
        time.sleep(0.02 * moments.random())
        run.kill()
        run.join()
        found = read_sweep(tmp_path)
        assert not found.complete
        assert found.numbers().equals(whole.numbers().take(found.table["point"]))
    assert work.swept(tmp_path).numbers().equals(whole.numbers())
    assert read_sweep(tmp_path).numbers().equals(whole.numbers())


def test_what_has_a_row_is_not_asked_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, whole: Sweep
) -> None:
    class EnoughError(Exception):
        pass

    def stop(share: float, _text: str) -> None:
        if share > 0.3:
            raise EnoughError

    asked = counted(monkeypatch)
    with pytest.raises(EnoughError):
        work.swept(tmp_path, progress=stop)
    kept = read_sweep(tmp_path)
    assert not kept.complete
    assert kept.table["point"].to_pylist() == sorted(kept.table["point"].to_pylist())
    first = set(asked)
    asked.clear()
    assert work.swept(tmp_path).numbers().equals(whole.numbers())
    assert sorted(asked) == sorted(set(range(85)) - set(kept.table["point"].to_pylist()))
    assert first & set(kept.table["point"].to_pylist())
    asked.clear()
    assert work.swept(tmp_path).complete
    assert asked == []


def test_a_disk_that_is_full_is_told_and_the_sweep_goes_on_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, whole: Sweep
) -> None:
    write = parquet.write_table
    written: list[Path] = []

    def full(table: Any, path: Path, **named: Any) -> None:
        if written:
            raise OSError(errno.ENOSPC, "No space left on device")
        written.append(path)
        write(table, path, **named)

    with monkeypatch.context() as patch:
        patch.setattr(parquet, "write_table", full)
        patch.setattr("benchdragon.sweeps.folder.MOST_ROWS", 10)
        with pytest.raises(MachineError) as told:
            work.swept(tmp_path)
    assert (
        str(told.value)
        == f"{tmp_path / 'part-00000001.parquet'} could not be written: the disk is full"
    )
    assert 0 < len(read_sweep(tmp_path).table) < 85
    assert work.swept(tmp_path).numbers().equals(whole.numbers())


def test_a_lost_point_is_a_row(monkeypatch: pytest.MonkeyPatch) -> None:
    def lost(_work: Any, items: Any, _place: Any) -> Any:
        for item in items[:]:
            yield [item], parallel.Lost("it died")

    monkeypatch.setattr(subject, "in_blocks", lost)
    found = short()
    assert found.texts("first_contact.status") == ["lost"] * 3
    assert found.texts("first_contact.message") == ["it died"] * 3
    assert found.column("route.pitch").tolist() == [0.45, 0.5, 0.55]


def test_a_worker_of_another_version_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rows_module, "made_by", lambda: {b"benchdragon": b"0.0"})
    with pytest.raises(
        MachineError, match=r"^a worker runs another version of benchdragon than this one$"
    ):
        short()


def test_another_version_does_not_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    short(output=tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr(subject, "made_by", lambda: {b"benchdragon": b"0.0", b"kernels": b"00"})
        with pytest.raises(FileRefusedError, match="holds a sweep of another version of benchdragon"):
            short(output=tmp_path)
    assert short(output=tmp_path).complete


@pytest.mark.parametrize(
    ("what", "changed"),
    [
        ("other points", {"vary": {"route.pitch": [0.45, 0.5]}}),
        ("other points", {"vary": {"route.pitch": [0.45, 0.5, 0.56]}}),
        ("other points", {"vary": {"disc.radius": [0.45, 0.5, 0.55]}}),
        ("other points", {"vary": listed_points({"route.pitch": [0.45, 0.5, 0.55]})}),
        ("other questions", {"ask": ["clearance"]}),
        ("other questions", {"ask": ["first_contact", "greatest_speed"]}),
        ("another refinement", {"refinement": Refinement(most=4)}),
    ],
)
def test_a_folder_is_of_one_sweep(tmp_path: Path, what: str, changed: dict[str, Any]) -> None:
    short(output=tmp_path)
    with pytest.raises(FileRefusedError) as refused:
        short(output=tmp_path, **changed)
    assert str(refused.value) == f"{tmp_path} holds a sweep of {what}: choose another folder"


def test_a_folder_is_of_one_plan_and_its_random_dances(tmp_path: Path) -> None:
    few = RandomDances(draws=2)
    short(output=tmp_path, ask=["tolerance"], dances=few)
    with pytest.raises(FileRefusedError, match="holds a sweep of other random dances"):
        short(output=tmp_path, ask=["tolerance"], dances=replace(few, seed=2))
    with pytest.raises(FileRefusedError, match="holds a sweep of another plan"):
        sweep(
            PLAN.with_value("dragon.benches", 9), {"route.pitch": [0.45, 0.5, 0.55]}, ["tolerance"],
            output=tmp_path, dances=few, executor=threads(1),
        )  # fmt: skip


def test_dances_make_no_difference_to_other_questions(tmp_path: Path) -> None:
    short(output=tmp_path)
    assert short(output=tmp_path, dances=RandomDances(seed=7)).complete


def test_a_dataset_holds_the_table(whole: Sweep) -> None:
    data = whole.to_xarray()
    assert dict(data.sizes) == {key: len(values) for key, values in work.VARY.items()}
    for key, values in work.VARY.items():
        assert data[key].values.tolist() == values
    for name in work.ASKED:
        for field in ("value", "lower", "upper", "bench_1", "time", "seconds"):
            array = data[name if field == "value" else f"{name}.{field}"]
            assert array.dims == tuple(work.VARY)
            np.testing.assert_array_equal(array.values.ravel(), whole.column(f"{name}.{field}"))
        assert data[f"{name}.status"].values.ravel().tolist() == whole.texts(f"{name}.status")
    at = {"route.pitch": 0.5, "disc.radius": 2.0}
    radii = work.VARY["disc.radius"]
    number = work.VARY["route.pitch"].index(0.5) * len(radii) + radii.index(2.0)
    assert float(data["greatest_speed.lower"].sel(at)) == whole.column("greatest_speed.lower")[number]
    assert data["first_contact"].attrs == data["first_contact.upper"].attrs == {"units": "s"}
    assert data["greatest_speed"].attrs == {"units": "m/s"}
    assert data.attrs["plan"] == whole.plan.sha256


def test_a_dataset_tells_the_version_that_made_it_and_not_that_which_reads_it(tmp_path: Path) -> None:
    found = short()
    about = {**found.about, "made_by": {**found.about["made_by"], "benchdragon": "0.0.1"}}
    assert Sweep(about, found.table).to_xarray().attrs["benchdragon"] == "0.0.1"


def test_only_a_complete_grid_is_a_dataset() -> None:
    found = short(vary=listed_points({"route.pitch": [0.45, 0.5]}))
    cut = Sweep(short().about, short().table.slice(0, 2))
    for one in (found, cut):
        with pytest.raises(
            InputError, match=r"^only a complete grid has a value at each place of a dataset$"
        ):
            one.to_xarray()


def test_a_data_frame_holds_the_table(whole: Sweep) -> None:
    frame = whole.to_dataframe()
    assert frame.index.name == "point"
    assert frame["route.pitch"].tolist() == whole.table["route.pitch"].to_pylist()
    assert list(frame.columns) == whole.table.column_names[1:]


def test_a_sweep_is_read_again(tmp_path: Path) -> None:
    found = short(output=str(tmp_path))
    again = read_sweep(str(tmp_path))
    assert again.table.equals(found.table)
    assert again.about == json.loads(json.dumps(found.about)) == found.about
    assert again.plan == PLAN
    assert again.keys == ("route.pitch",)
    assert [question.name for question in again.questions] == ["first_contact"]
    assert again.complete
    assert "first_contact.seconds" not in again.numbers().column_names
    assert np.isnan(found.column("first_contact.value")).all()


def test_a_sweep_that_has_only_begun_is_read(tmp_path: Path) -> None:
    with opened(tmp_path, {**short().about, "finished": False}):
        found = read_sweep(tmp_path)
    assert (len(found.table), found.complete) == (0, False)
    assert found.table.schema == short().table.schema.remove_metadata()


def test_whole_numbers_texts_and_samples_have_columns_of_their_kinds() -> None:
    found = short(
        vary={"dragon.benches": [8, 9], "disc.radius": [4.5, 5], "route.pitch": [0.5, "wide"]}
    )
    kinds = [found.table.schema.field(name).type for name in found.keys]
    assert kinds == [pa.int64(), pa.float64(), pa.string()]
    assert found.texts("first_contact.status") == ["clear", "refused"] * 4


def test_samples_are_swept() -> None:
    points = sampled_points({"route.pitch": (0.4, 0.6), "dragon.benches": (8, 12)}, 6)
    found = short(vary=points)
    assert list(zip(*(found.table[key].to_pylist() for key in points.keys), strict=True)) == [
        points[number] for number in range(6)
    ]


def test_progress_rises_to_one(tmp_path: Path) -> None:
    told: list[tuple[float, str]] = []
    short(progress=lambda share, text: told.append((share, text)))
    shares = [share for share, _text in told]
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert told[-1][1].startswith("3 of 3 points, ")
    assert told[-1][1].endswith(" a second, 0 s left")


def test_a_plan_that_is_wrong_at_all_points_is_refused_before_anything_is_made(tmp_path: Path) -> None:
    output = tmp_path / "output"
    for vary in ({"route.pitch": [-1, -2]}, {"route.pich": [0.5]}):
        with pytest.raises(PlanError, match=next(iter(vary))):
            short(vary=vary, output=output)
    assert not output.exists()


def test_a_plan_that_is_right_at_some_points_is_asked_wherever_they_stand() -> None:
    """One value in twenty of the last key is right, as 1 of 20 in each of as many rows."""
    pitches = [*(-1.0 - n for n in range(19)), 0.5]
    Design(PLAN, grid_points({"disc.radius": range(4, 24), "route.pitch": pitches}), ("width",)).check()
    Design(PLAN, listed_points({"route.pitch": [-1.0] * 999 + [0.5]}), ("width",)).check()


def test_what_cannot_be_asked_is_refused() -> None:
    with pytest.raises(InputError, match="ask: expected some of"):
        short(ask=["wide"])
    with pytest.raises(InputError, match="expected 1 to 10000000 points"):
        short(vary={})
    with pytest.raises(InputError, match="plan must be a Plan"):
        sweep("spiral-in", {"route.pitch": [1]})  # type: ignore[arg-type]


DESIGNS: dict[str, dict[str, Any]] = {
    "grid": {"vary": {"route.pitch": [0.5, 0.55, 0.6]}},
    "list": {"vary": listed_points({"route.pitch": [0.5, 0.55], "dragon.width": [0.2, 0.3]})},
    "sample": {"vary": sampled_points({"route.pitch": (0.5, 0.6)}, 3, 7, "sobol")},
    "refined": {
        "vary": {"route.pitch": [0.5, 0.6]},
        "ask": ["clearance"],
        "refinement": Refinement(40, 1e-6),
    },
    "dances": {"vary": {"route.pitch": [0.5, 0.6]}, "ask": ["tolerance"], "dances": RandomDances(2)},
}


@pytest.mark.parametrize("name", DESIGNS)
def test_every_kind_of_sweep_goes_on(name: str, tmp_path: Path) -> None:
    """A part is taken away, and the mark that it came to its end."""
    options = DESIGNS[name]
    once = short(output=tmp_path, **options)
    refined = options["refinement"].most if name == "refined" else 0
    assert len(once.table) == once.about["points"]["count"] + refined
    assert (once.complete, read_sweep(tmp_path).complete) == (True, True)
    part = parts_in(tmp_path)[-1]
    table = parquet.read_table(part)
    parquet.write_table(table.slice(0, len(table) - 1), part)
    (tmp_path / "sweep.json").write_text(json.dumps({**once.about, "finished": False}), "utf-8")
    assert not read_sweep(tmp_path).complete
    again = short(output=tmp_path, **options)
    assert again.complete
    assert again.numbers().equals(once.numbers())


def lose_first(folder: Path, name: str) -> None:
    """Let the answer of the first point be lost, and the sweep not finished."""
    part, *_others = parts_in(folder)  # a slow machine writes several
    table = parquet.read_table(part)
    states = ["lost", *table[f"{name}.status"].to_pylist()[1:]]
    column = table.column_names.index(f"{name}.status")
    spoilt = table.set_column(column, f"{name}.status", pa.array(states))
    parquet.write_table(spoilt.replace_schema_metadata(table.schema.metadata), part)
    assert read_sweep(folder).texts(f"{name}.status")[0] == "lost"


def test_what_was_lost_is_asked_again(tmp_path: Path) -> None:
    once = short(output=tmp_path)
    lose_first(tmp_path, "first_contact")
    before = len(parts_in(tmp_path))
    again = short(output=tmp_path)
    assert again.numbers().equals(once.numbers())
    assert len(parts_in(tmp_path)) == before + 1


def test_what_a_refinement_rests_on_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else the points that come after would be others than those that are there."""
    options = {**DESIGNS["refined"], "refinement": Refinement(8, 1e-6)}
    short(output=tmp_path, **options)
    lose_first(tmp_path, "clearance")
    before, asked = read_sweep(tmp_path), counted(monkeypatch)
    assert len(before.table) == 10
    assert short(output=tmp_path, **options).table.equals(before.table)
    assert asked == []


def test_parts_do_not_carry_the_points(tmp_path: Path) -> None:
    few, many = tmp_path / "few", tmp_path / "many"
    short(vary={"route.pitch": [0.5, 0.6]}, output=few)
    design = Design(
        PLAN, grid_points({"route.pitch": [0.5 + 1e-7 * n for n in range(100_000)]}), ("width",)
    )
    with opened(many, design.about()):
        rows = Rows(design.about(), many)
        rows.add(design.work.lost([(0, (0.5,))], "why"))
        rows.write()
    sizes = [parts_in(folder)[0].stat().st_size for folder in (few, many)]
    assert sizes[1] < 2 * sizes[0]
