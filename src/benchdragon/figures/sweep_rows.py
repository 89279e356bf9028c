"""The rows of a sweep as pictures take them: answers, who decides each, and why there is none."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from benchdragon.figures.style import drawable
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.keys import meaning
from benchdragon.sweeps.questions import CLEAR, LOST, REFUSED, UNWALKABLE, Question
from benchdragon.sweeps.sweep import Sweep

Bools = npt.NDArray[np.bool_]
Ints = npt.NDArray[np.int64]
# What decides an answer: two benches, a handle, or nothing.
Who = tuple[int, ...]
# How it is hatched where there is no answer, by the reason.
HATCHES = {
    CLEAR: "..",
    UNWALKABLE: "////",
    "infeasible": "xxxx",
    REFUSED: "\\\\\\\\",
    "unlimited": "||||",
    "undecided": "----",
    LOST: "++++",
}
# Ways to have an answer; others have none, nor has one of these without a finite value.
ANSWERED = ("found", "proved", "undecided")
# Tol's muted colours, told apart by colour-blind people too; and that of all who are named no more.
COLOURS = (
    "#CC6677", "#332288", "#117733", "#88CCEE", "#882255", "#44AA99", "#999933", "#AA4499", "#DDCC77",
)  # fmt: skip
OTHERS = "#888888"


@dataclass(frozen=True)
class Answered:
    """What a question came to at some points.

    Attributes:
        question: it.
        keys: values of each key that varies, (n,); of a key with texts their numbers in `texts`.
        texts: of keys whose values are texts, in order.
        value: the answers, NaN where there is none, (n,).
        lower: with `upper` their brackets, (n,); for points without contact `lower` is the end of the
            walk.
        upper: see lower.
        why: why there is no answer, one of HATCHES; "" where there is one, (n,).
        who: what decides, numbers in `names`; -1 for nothing, (n,).
        names: of all that decide anywhere.
    """

    question: Question
    keys: Mapping[str, FloatArray]
    texts: Mapping[str, tuple[str, ...]]
    value: FloatArray
    lower: FloatArray
    upper: FloatArray
    why: npt.NDArray[Any]
    who: Ints
    names: tuple[Who, ...]

    @property
    def known(self) -> Bools:
        """Where there is an answer, (n,)."""
        found: Bools = self.why == ""
        return found

    def part(self, chosen: Any) -> Self:
        """Some of the points, by their numbers or a mask."""
        return replace(
            self,
            keys={key: values[chosen] for key, values in self.keys.items()},
            **{name: getattr(self, name)[chosen] for name in ("value", "lower", "upper", "why", "who")},
        )

    def colours(self) -> tuple[str, ...]:
        """A colour for each of `names`: the most frequent have one of their own."""
        often = [who for who, _count in Counter(self.who[self.who >= 0].tolist()).most_common()]
        rank = {who: n for n, who in enumerate(often)}
        return tuple(
            COLOURS[rank[who]] if rank.get(who, len(COLOURS)) < len(COLOURS) else OTHERS
            for who in range(len(self.names))
        )


def answered(sweep: Sweep, name: str) -> Answered:
    """The answers to one question; keys that have one value are left out, unless all have."""
    question = next(one for one in sweep.questions if one.name == name)
    keys: dict[str, FloatArray] = {}
    texts: dict[str, tuple[str, ...]] = {}
    for key in sweep.keys:
        keys[key], words = _numbers(sweep.table[key].to_pylist())
        texts |= {key: words} if words else {}
    varying = {key: values for key, values in keys.items() if (values != values[0]).any()}
    value = sweep.column(f"{name}.value")
    status = np.array([one or "" for one in sweep.texts(f"{name}.status")])
    sound = np.isin(status, ANSWERED) & np.isfinite(value)
    who, names = _deciders(sweep, name, sound)
    return Answered(
        question, varying or keys, texts, np.where(sound, value, np.nan), sweep.column(f"{name}.lower"),
        sweep.column(f"{name}.upper"), np.where(sound, "", status), who, names,
    )  # fmt: skip


def _numbers(values: list[Any]) -> tuple[FloatArray, tuple[str, ...]]:
    """Values as numbers; of texts, their places among those that there are, which come too."""
    if not any(isinstance(value, str) for value in values):
        return np.array(values, dtype=np.float64), ()
    words = tuple(dict.fromkeys(map(str, values)))
    place = {word: n for n, word in enumerate(words)}
    return np.array([place[str(value)] for value in values], dtype=np.float64), words


def _deciders(sweep: Sweep, name: str, sound: Bools) -> tuple[Ints, tuple[Who, ...]]:
    """Who decides at each point, as numbers, and who these are: pairs of benches, or handles."""
    one, two, handle = (sweep.column(f"{name}.{field}") for field in ("bench_1", "bench_2", "handle"))
    found: list[Who] = []
    for n in range(len(sound)):
        if not sound[n]:
            found.append(())
        elif two[n] == two[n]:
            found.append((int(one[n]), int(two[n])))
        else:
            found.append((int(handle[n]),) if handle[n] == handle[n] else ())
    names = tuple(sorted(set(found) - {()}))
    place = {who: n for n, who in enumerate(names)} | {(): -1}
    return np.array([place[who] for who in found], dtype=np.int64), names


def key_label(sweep: Sweep, key: str) -> str:
    """A key with its unit, for an axis."""
    unit = meaning(sweep.plan, key).unit
    return f"{key} ({unit})" if unit else key


def value_label(question: Question) -> str:
    """What is asked, with its unit, for an axis."""
    return f"{_(question.text)} ({question.unit})" if question.unit else _(question.text)


def said(found: Answered, key: str, value: float) -> str:
    """A value of a key as readers know it."""
    return drawable(found.texts[key][int(value)]) if key in found.texts else f"{value:.6g}"


def who_text(who: Who) -> str:
    """Who decides, in words."""
    if len(who) == 1:
        return _("handle {number}").format(number=who[0])
    return _("benches {a} and {b}").format(a=who[0], b=who[1])
