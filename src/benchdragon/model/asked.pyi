# Made from benchdragon.model.asked by tools/make_methods.py; to make it again: make generate
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from benchdragon.analysis.contact import ClearanceCurve
    from benchdragon.analysis.contact import Window
    from benchdragon.analysis.swept import Enclosing
    from benchdragon.analysis.swept import SweptArea
    from benchdragon.model.answer import Answer
    from benchdragon.model.obstacle import Obstacle
    from benchdragon.player.page import Shown
    from benchdragon.progress import Progress
    from collections.abc import Sequence
    import numpy.typing as npt

class Asked:
    def clearance_curve(
        self,
        times: npt.ArrayLike | None = ...,
    ) -> ClearanceCurve: ...
    def contact_windows(
        self,
        start: float | None = ...,
        end: float | None = ...,
        *,
        margin: float = ...,
        most: int = ...,
        progress: Progress = ...,
    ) -> list[Window]: ...
    def enclosing(
        self,
        start: float | None = ...,
        end: float | None = ...,
        *,
        error: float = ...,
        progress: Progress = ...,
    ) -> Enclosing: ...
    def first_contact(
        self,
        start: float | None = ...,
        end: float | None = ...,
        *,
        margin: float = ...,
        progress: Progress = ...,
    ) -> Answer | None: ...
    def first_touch(
        self,
        obstacle: Obstacle,
        start: float | None = ...,
        end: float | None = ...,
    ) -> Answer | None: ...
    def greatest_speed(
        self,
        start: float | None = ...,
        end: float | None = ...,
        *,
        tolerance: float = ...,
        progress: Progress = ...,
    ) -> Answer: ...
    def least_clearance(
        self,
        start: float | None = ...,
        end: float | None = ...,
        *,
        within: float = ...,
        tolerances: Sequence[float] = ...,
        progress: Progress = ...,
    ) -> Answer: ...
    def least_distance(
        self,
        obstacle: Obstacle,
        start: float | None = ...,
        end: float | None = ...,
        *,
        tolerances: Sequence[float] = ...,
    ) -> Answer: ...
    def show(
        self,
    ) -> Shown: ...
    def swept_area(
        self,
        start: float | None = ...,
        end: float | None = ...,
        *,
        margin: float = ...,
        error: float = ...,
        progress: Progress = ...,
    ) -> SweptArea: ...
    def _repr_html_(
        self,
    ) -> str: ...
