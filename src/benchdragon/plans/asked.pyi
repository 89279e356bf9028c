# Made from benchdragon.plans.asked by tools/make_methods.py; to make it again: make generate
from benchdragon.model.asked import Asked
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from benchdragon.analysis.bench_walks import BenchWalk
    from benchdragon.analysis.check import Report
    from benchdragon.analysis.proof import Claim
    from benchdragon.analysis.timetable import Passing
    from benchdragon.figures.plots import Panels
    from benchdragon.model.answer import Answer
    from benchdragon.model.walk import Walk
    from benchdragon.parallel import Place
    from benchdragon.progress import Progress
    from benchdragon.solve.place import PlacedDance
    from benchdragon.solve.tolerance import Deviations
    from benchdragon.solve.tolerance import Tolerance
    from benchdragon.solve.turn import BestTurn
    from benchdragon.solve.turn_goal import TurnGoal
    from benchdragon.sweeps.points import Points
    from benchdragon.sweeps.points import Value
    from benchdragon.sweeps.questions import RandomDances
    from benchdragon.sweeps.refine import Refinement
    from benchdragon.sweeps.sweep import Sweep
    from collections.abc import Iterable
    from collections.abc import Mapping
    from collections.abc import Sequence
    from concurrent.futures import Executor
    from matplotlib.figure import Figure
    from pathlib import Path
    from typing import Literal
    import numpy.typing as npt

class AskedPlan(Asked):
    def animate(
        self,
        path: Path | str,
        *,
        start: float | None = ...,
        end: float | None = ...,
        fps: int | None = ...,
        speed_up: float = ...,
        size: tuple[int, int] | None = ...,
        theme: str = ...,
        follow: int | None = ...,
        span: float = ...,
        force: bool = ...,
        progress: Progress = ...,
    ) -> Path: ...
    def bench_walks(
        self,
        walk: Walk | None = ...,
        span: tuple[float, float] | None = ...,
        *,
        apart: float = ...,
        progress: Progress = ...,
    ) -> tuple[BenchWalk, ...]: ...
    def best_place(
        self,
        *,
        progress: Progress = ...,
    ) -> PlacedDance: ...
    def best_turn(
        self,
        goal: TurnGoal | None = ...,
        *,
        progress: Progress = ...,
    ) -> BestTurn: ...
    def check(
        self,
        progress: Progress = ...,
        *,
        prove: bool = ...,
    ) -> Report: ...
    def greatest_head_speed(
        self,
        *,
        tolerance: float = ...,
        progress: Progress = ...,
    ) -> Answer: ...
    def limit(
        self,
        name: str,
        *,
        margin: float | None = ...,
        tolerance: float = ...,
        prove: bool = ...,
        progress: Progress = ...,
        claims: list[Claim] | None = ...,
    ) -> Answer: ...
    def plot(
        self,
        ax: Panels = ...,
        *,
        at: npt.ArrayLike | None = ...,
        colour: Literal["speed"] | None = ...,
    ) -> Figure: ...
    def smallest_pitch(
        self,
        *,
        margin: float | None = ...,
    ) -> Answer: ...
    def sweep(
        self,
        vary: Mapping[str, Iterable[Value]] | Points,
        ask: Sequence[str] = ...,
        *,
        output: Path | str | None = ...,
        dances: RandomDances | None = ...,
        refinement: Refinement | None = ...,
        executor: Executor | Place | None = ...,
        progress: Progress = ...,
    ) -> Sweep: ...
    def timetable(
        self,
        walk: Walk | None = ...,
        start: float | None = ...,
        end: float | None = ...,
    ) -> tuple[Passing, ...]: ...
    def tolerance(
        self,
        deviations: Deviations,
        draws: int = ...,
        *,
        seed: int = ...,
        own: bool = ...,
        executor: Executor | Place | None = ...,
        progress: Progress = ...,
    ) -> Tolerance: ...
