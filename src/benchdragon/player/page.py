"""The player as one HTML file: the page's own modules, style and words put into it, and the dance.

The file fetches nothing, and its content security policy forbids it.
"""

import html
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchdragon.analysis.asked import asked_of
from benchdragon.analysis.check import check
from benchdragon.errors import BenchDragonError, InputError, brief
from benchdragon.files import whole_file
from benchdragon.i18n import _, language
from benchdragon.inlining import chinese, html_page
from benchdragon.kernels.status import Status
from benchdragon.model.walk import Motion, Walk
from benchdragon.plans.schema import Plan
from benchdragon.player import messages
from benchdragon.player.scene import Span, judged_dance, plain_dance

PAGE = "start.js"
STYLES = ("style.css", "explain.css", "print.css")
# Bytes that a file may have for up to 1,000 benches; larger dragons get this for each thousand.
MOST_BYTES = 10_000_000
# In a notebook: bytes, and benches times seconds (about 10 s of work).
MOST_FRAMED, MOST_SHOWN = 3_000_000, 500_000
# Of a motion at one time, so many seconds are shown before and after it, as far as the dragon can be
# placed at so many times among them.
BESIDE, TRIED = 5.0, 50


def player_page(dance: messages.Dance, spoken: str | None = None) -> str:
    """The page that shows a dance, beginning in a language ("en" or "zh"; None: that in use)."""
    spoken = spoken or language()
    title = getattr(dance.title, spoken) or "benchdragon"
    held = {"words": chinese(PAGE), "dance": dance.model_dump(mode="json")}
    return html_page("player.html.jinja", PAGE, STYLES, spoken, held, title=title)


def write_player(path: Path, dance: messages.Dance) -> None:
    """Write the player of a dance.

    Raises:
        InputError: if it would grow beyond MOST_BYTES for each thousand benches.
    """
    page = player_page(dance).encode()
    most = MOST_BYTES * max(1.0, len(dance.benches.length) / 1000.0)
    if len(page) > most:
        text = _("the player would have {size} MB, more than {most} MB: choose a shorter time")
        raise InputError(text.format(size=f"{len(page) / 1e6:.1f}", most=f"{most / 1e6:.1f}"))
    with whole_file(path) as temporary:
        temporary.write_bytes(page)


def framed(dance: messages.Dance, height: int = 560) -> str:
    """The player inside a frame, for a page that is not ours: a notebook."""
    page = html.escape(player_page(dance), quote=True)
    return (
        f'<iframe sandbox="allow-scripts" title="benchdragon" srcdoc="{page}" '
        f'style="width:100%;height:{height}px;border:0"></iframe>'
    )


@dataclass(frozen=True)
class Shown:
    """What the cell of a notebook shows, as HTML."""

    html: str

    def _repr_html_(self) -> str:
        return self.html


def show(motion: Motion | Walk | Plan) -> Shown:
    """A dance in a player, for the cell of a notebook.

    Of a motion the walk from its first time to its last is shown, of one time alone the seconds around
    it; of a walk or a plan the whole of it, of a plan as it is judged by `check`. What cannot be shown
    comes as text, with why.

    Raises:
        InputError: if it is not one of these.

    Examples:
        >>> player = bd.show(bd.read_plan("turn", {"dragon.benches": 5, "walk.end": 20.0}))
        >>> player.html[:7]
        '<iframe'
    """
    if not isinstance(motion, Motion | Walk | Plan):
        text = _("motion must be a Motion, a Walk or a Plan, not {value}")
        raise InputError(text.format(value=brief(motion)))
    try:
        return Shown(framed(_dance(motion)))
    except BenchDragonError as error:
        return Shown(f"<pre>{html.escape(repr(motion))}\n{html.escape(str(error))}</pre>")


def _dance(of: Motion | Walk | Plan) -> messages.Dance:
    """What is shown; InputError if too large for a notebook, WalkError if it never stands."""
    too_large = InputError(
        _("this dance is too large for a notebook: take a shorter time or fewer benches")
    )
    if isinstance(of, Motion):
        walk, span = of.walk, _span(of)
    else:
        walk, start, end = asked_of(of)
        span = Span(start, end)
    if (span.end - span.start) * len(walk.dragon) > MOST_SHOWN:
        raise too_large
    dance = judged_dance(of, check) if isinstance(of, Plan) else plain_dance(walk, span)
    if len(dance.frames.packed) + len(dance.course.packed) > MOST_FRAMED:
        raise too_large
    return dance


def _span(motion: Motion) -> Span:
    """From the first to the last time at which the dragon stands; around it, if that is one."""
    sound = motion.times[motion.status == Status.OK]
    if not sound.size:
        motion.check()
        raise InputError(_("there is no time to show"))
    start, end = float(sound.min()), float(sound.max())
    if end - start > 1e-3:
        return Span(start, end)
    around = start + BESIDE * np.linspace(-1.0, 1.0, 2 * TRIED + 1)
    stands = motion.walk.motion(around, throw=False).status == Status.OK
    failed = np.flatnonzero(~stands) - TRIED
    low = int(failed[failed < 0].max(initial=-TRIED - 1)) + 1
    high = int(failed[failed > 0].min(initial=TRIED + 1)) - 1
    if low >= high:
        raise InputError(_("there is no time to show"))
    return Span(float(around[TRIED + low]), float(around[TRIED + high]))
