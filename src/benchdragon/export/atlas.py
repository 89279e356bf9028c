"""An atlas: a page of what sweeps came to, with the command that makes each."""

import datetime
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchdragon.export.document import (
    Block,
    Document,
    Heading,
    Inline,
    Listing,
    Picture,
    Reference,
    Table,
    say,
)
from benchdragon.export.publish import write_html
from benchdragon.figures.style import write_picture
from benchdragon.figures.sweep import sweep_picture
from benchdragon.figures.sweep_rows import Answered, answered, who_text
from benchdragon.i18n import _, language
from benchdragon.plans.keys import meaning
from benchdragon.progress import Progress, silent, stages
from benchdragon.sweeps.command import PLAN_FILE, POINTS_FILE, plan_words, sweep_command, unsaid
from benchdragon.sweeps.questions import STATES, Question
from benchdragon.sweeps.sweep import Sweep

# Digits of values, and of widths and times; of a plan's hash.
DIGITS, FEW_DIGITS, HASH = 10, 3, 12


def write_atlas(path: Path, sweeps: Mapping[str, Sweep], progress: Progress = silent) -> None:
    """Write one page, in the language in use, that needs nothing beside it.

    Args:
        path: of the page.
        sweeps: by the folder that the command of each names.
        progress: is called for each picture.

    Raises:
        MachineError: if it cannot be written.
    """
    stage = stages(progress, sum(len(sweep.questions) for sweep in sweeps.values()))
    with TemporaryDirectory() as name:
        for number, (folder, sweep) in enumerate(sweeps.items()):
            title = sweep.plan.title(language())
            for question in sweep.questions:
                stage(f"{folder}: {_(question.text)}")
                figure = sweep_picture(sweep, question.name, title)
                file = Path(name, f"{_name(number, question)}.svg")
                write_picture(figure, file, title, sweep.about["plan_sha256"])
        write_html(path, atlas(sweeps), Path(name))


def _name(number: int, question: Question) -> str:
    """The title of the picture of a sweep's question."""
    return f"{number + 1}-{question.name}"


def atlas(sweeps: Mapping[str, Sweep]) -> Document:
    """The page of some sweeps by their folders, in the language in use."""
    blocks: list[Block] = [
        say(
            "Each chapter is a sweep: the same questions, asked of a plan at many values of its "
            "keys. Curves are broken where other benches come to decide and the answer jumps; "
            "where there is no answer, pictures are hatched. The command of each chapter makes "
            "its sweep anew."
        )
    ]
    for number, (folder, sweep) in enumerate(sweeps.items()):
        blocks += _chapter(number, folder, sweep)
    date = datetime.date.today().isoformat()
    return Document(_("Atlas"), language(), date, tuple(blocks))


def _chapter(number: int, folder: str, sweep: Sweep) -> Iterator[Block]:
    """A sweep: its plan, its keys, its command, and each question."""
    keys = _(", ").join(sweep.keys)
    title = sweep.plan.title(language()) or _("a plan without a title")
    yield Heading(_("{title}: over {keys}").format(title=title, keys=keys), f"sweep-{number + 1}")
    yield say(
        "Plan {hash}, benchdragon {version}; {points} points{further}. {table} lists the keys.",
        hash=sweep.about["plan_sha256"][:HASH],
        version=sweep.about["made_by"]["benchdragon"],
        points=len(sweep.table),
        further=_further(sweep),
        table=Reference(f"keys-{number + 1}"),
    )
    yield from _how_made(folder, sweep)
    yield _keys_table(number, sweep)
    for question in sweep.questions:
        yield from _section(number, question, sweep)


def _how_made(folder: str, sweep: Sweep) -> Iterator[Block]:
    """The command of a sweep and the files that it reads, or why there is no command."""
    said = sweep_command(sweep, folder)
    known = unsaid(sweep) is None
    yield Listing(said) if known else say(said)
    if plan_words(sweep.plan) is None:
        yield say("{file}:", file=PLAN_FILE)
        yield Listing(sweep.plan.toml())
    points = sweep.about["points"]
    if known and points["grid"] is None and points["sample"] is None:
        text = _("{file}: the columns of the keys in the first {count} rows of {folder}.")
        yield say(text, file=POINTS_FILE, count=points["count"], folder=folder)


def _further(sweep: Sweep) -> str:
    """What is to be said of points beside those that were asked for."""
    wanted = int(sweep.about["points"]["count"])
    more = len(sweep.table) - wanted
    if not sweep.complete:
        refined = sweep.about["refine"]
        wanted += refined["most"] if refined else 0
        return _(" of {wanted}: it is not complete").format(wanted=wanted)
    return _(", {more} of them where answers change most").format(more=more) if more else ""


def _keys_table(number: int, sweep: Sweep) -> Table:
    rows: list[tuple[Inline, ...]] = []
    for key in sweep.keys:
        about = meaning(sweep.plan, key)
        values = sweep.table[key].unique().to_pylist()
        if any(isinstance(value, str) for value in values):
            low, high = _(", ").join(map(str, values)), ""
        else:
            low, high = (f"{end:.{DIGITS}g}" for end in (min(values), max(values)))
        rows.append((key, _(about.text), about.unit, low, high, str(len(values))))
    names = (_("key"), _("meaning"), _("unit"), _("from"), _("to"), _("values"))
    return Table(
        f"keys-{number + 1}", _("What is varied."), names, (1.4, 2.4, 0.5, 1.0, 1.0, 0.7), tuple(rows)
    )


def _section(number: int, question: Question, sweep: Sweep) -> Iterator[Block]:
    """A question: its picture, how many answers of each kind, and the extreme ones."""
    name, text = _name(number, question), _(question.text)
    yield Heading(text, f"answers-{name}", level=2)
    states = Counter(str(state) for state in sweep.texts(f"{question.name}.status"))
    counted = _("; ").join(
        _("{state}: {count}").format(state=_(STATES[state]), count=count)
        for state, count in states.most_common()
    )
    found = answered(sweep, question.name)
    rows = tuple(_extremes(sweep, found))
    said = _("{picture}; answers: {counted}.")
    yield say(said, picture=Reference(name), counted=counted)
    yield Picture(
        name,
        _("{question} over {keys}: {count} points").format(
            question=text, keys=_(", ").join(found.keys), count=len(sweep.table)
        ),
    )
    if rows:
        value = f"{text} ({question.unit})" if question.unit else text
        columns = ("", value, _("width of the bracket"), *sweep.keys, _("who decides"), _("time (s)"))
        widths = (1.3, 1.4, 1.0, *[1.2] * len(sweep.keys), 1.4, 0.8)
        yield Table(f"extremes-{name}", _("The extreme answers."), columns, widths, rows, numbers=True)


def _extremes(sweep: Sweep, found: Answered) -> Iterator[tuple[Inline, ...]]:
    """The least and the greatest answer, that with the widest bracket, that which took longest."""
    places = np.flatnonzero(found.known)
    if not len(places):
        return
    wide = np.nan_to_num(found.upper - found.lower, posinf=np.inf)
    seconds = sweep.column(f"{found.question.name}.seconds")
    for text, at in (
        (_("least"), places[found.value[places].argmin()]),
        (_("greatest"), places[found.value[places].argmax()]),
        (_("widest bracket"), places[wide[places].argmax()]),
        (_("took longest"), places[seconds[places].argmax()]),
    ):
        values = (sweep.table[key][int(at)].as_py() for key in sweep.keys)
        keys = (value if isinstance(value, str) else f"{value:.{DIGITS}g}" for value in values)
        who = who_text(found.names[found.who[at]]) if found.who[at] >= 0 else ""
        yield (
            text, f"{found.value[at]:.{DIGITS}g}", f"{wide[at]:.{FEW_DIGITS}g}", *keys, who,
            f"{seconds[at]:.{FEW_DIGITS}g}",
        )  # fmt: skip
