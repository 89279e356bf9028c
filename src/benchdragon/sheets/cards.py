"""The benches' sheets as PDF pages: A4, quarters of it to cut, cards to hang round the neck."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from fpdf.enums import MethodReturnValue

from benchdragon.analysis.findings import shown_name
from benchdragon.export.typeset import Typeset, breakable
from benchdragon.files import whole_bytes
from benchdragon.i18n import N_, _, language
from benchdragon.progress import Progress, silent
from benchdragon.sheets.benches import Entry, Sheet, bench_sheets
from benchdragon.sheets.briefing import Briefing, listed
from benchdragon.sheets.options import Options
from benchdragon.sheets.qr import bench_address, draw_qr
from benchdragon.sheets.small_map import Frame, SmallMap

POINT = 25.4 / 72.0
# Height of a line, as a share of the size of its type.
LEADING = 1.3
# Room after a block, as a share of its lines' height.
AFTER = 0.25
# What is tried until a sheet fits, as shares of the format's size of type: by day, and by night.
DAY, NIGHT = (1.0, 0.93, 0.86, 0.8, 0.74), (1.5, 1.4, 1.3, 1.2, 1.1)
# Room for the foot, mm.
FOOT = 4.0
# Marks that tell where to cut, mm.
CUT = 6.0
# Benches of a household on one sheet, where sheets are large and the type is not.
MOST_BENCHES = 2
# Their map is lower, by this share, so that all their text finds room.
MAP_OF_SEVERAL = 0.75
# People of a bench who have a line each where that leaves too little room; who are named at all then.
MOST_LINES, MOST_NAMES = 2, 24
# A map is as tall as that, mm, or there is none; type that is still too large shrinks by this share.
LEAST_MAP, SMALLER = 25.0, 0.9
# Where names are written by hand.
BLANK = 22 * "_"
MORE, CROWDED = N_("And so on: the rest is in the player."), N_("There is no room here for the rest.")


@dataclass(frozen=True)
class Layout:
    """How sheets of a format lie on an A4 page, mm and points.

    Attributes:
        frames: of what is seen first; with `backs` those of what is seen after.
        backs: frames of the back, else ().
        cuts: lines to cut along: x and y of both ends.
        fold: a line to fold along, for each frame.
        edge: white on all sides of a frame.
        size: of type.
        code: side of the QR code.
        map: least height of the map.
    """

    frames: tuple[Frame, ...]
    backs: tuple[Frame, ...]
    cuts: tuple[tuple[float, float, float, float], ...]
    edge: float
    size: float
    code: float
    map: float


def _marks(xs: Sequence[float], ys: Sequence[float]) -> tuple[tuple[float, float, float, float], ...]:
    """Short lines at the crossings of cuts."""
    lines = []
    for x in xs:
        for y in ys:
            lines += [(x - CUT / 2, y, x + CUT / 2, y), (x, y - CUT / 2, x, y + CUT / 2)]
    return tuple(lines)


CARD = Frame(19.0, 24.5, 86.0, 124.0)
LAYOUTS = {
    "a4": Layout((Frame(0.0, 0.0, 210.0, 297.0),), (), (), 14.0, 14.0, 38.0, 85.0),
    "quarter": Layout(
        tuple(Frame(x, y, 105.0, 148.5) for y in (0.0, 148.5) for x in (0.0, 105.0)), (),
        _marks((0.0, 105.0, 210.0), (0.0, 148.5, 297.0)), 7.0, 8.5, 25.0, 42.0,
    ),
    "lanyard": Layout(
        tuple(Frame(CARD.x, CARD.y + k * CARD.height, CARD.width, CARD.height) for k in (0, 1)),
        tuple(
            Frame(CARD.x + CARD.width, CARD.y + k * CARD.height, CARD.width, CARD.height)
            for k in (0, 1)
        ),
        _marks((19.0, 105.0, 191.0), (24.5, 148.5, 272.5)), 5.0, 8.5, 24.0, 40.0,
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Block:
    """Words one under another: size as a share of the type's, and whether they are bold.

    Of `spare` ones the last go first, where there is no room for all. `entry` is the number of the
    sheet's bench that they are about.
    """

    text: str
    share: float = 1.0
    bold: bool = False
    spare: bool = False
    entry: int = 0


@dataclass(frozen=True)
class _Laid:
    """The layout of a sheet: the text above and below its map, the share of the type, mm left."""

    head: list[Block]
    facts: list[Block]
    share: float
    tall: float


class Cards(Typeset):
    """The benches' sheets of a dance.

    Args:
        briefing: of the dance.
        paper: "a4", "quarter" or "lanyard".
        night: whether the type is large.
        text: all that will be set, for signs that the package's fonts lack.
    """

    def __init__(self, briefing: Briefing, paper: str, night: bool, text: str) -> None:
        super().__init__(briefing.checked_on, text)
        self._briefing, self._layout = briefing, LAYOUTS[paper]
        self._shares = NIGHT if night else DAY
        self._night = night
        self._map = SmallMap(briefing)
        self._address = briefing.plan.people.address
        self._more = _(MORE if self._address else CROWDED)
        self._heights: dict[tuple[float, Block, float], float] = {}
        self.set_auto_page_break(False)
        self.set_margin(0.0)
        self.c_margin = 0.0
        self.set_title(briefing.plan.title(language()))
        self.set_lang("zh-Hans" if language() == "zh" else "en")

    def write_all(self, sheets: Sequence[Sheet], progress: Progress = silent) -> None:
        """Set all sheets."""
        frames, front = len(self._layout.frames), self._inner(self._layout.frames[0])
        self.add_page()
        laid = [self._laid(front, sheet) for sheet in sheets]
        usual = min(
            (one.tall for one in laid if one.tall >= self._layout.map),
            default=min((one.tall for one in laid if one.tall >= LEAST_MAP), default=0.0),
        )
        for n, (sheet, one) in enumerate(zip(sheets, laid, strict=True)):
            if n % frames == 0:
                if n:
                    self.add_page()
                self._cuts()
            self._sheet(sheet, one, usual, n % frames)
            progress((n + 1) / len(sheets), "")

    def _cuts(self) -> None:
        self.set_draw_color(120)
        self.set_line_width(0.15)
        for line in self._layout.cuts:
            self.line(*line)
        if self._layout.backs:
            self.set_dash_pattern(dash=1.0, gap=1.5)
            for back in self._layout.backs:
                self.line(back.x, back.y + CUT, back.x, back.y + back.height - CUT)
            self.set_dash_pattern()

    def _sheet(self, sheet: Sheet, laid: _Laid, usual: float, place: int) -> None:
        """Set a sheet; maps are as tall as usual wherever they can be."""
        backs = self._layout.backs
        self._front(self._inner(self._layout.frames[place]), sheet, laid, min(laid.tall, usual))
        if backs:
            self._back(self._inner(backs[place]), _all_facts(sheet))

    def _inner(self, frame: Frame) -> Frame:
        edge = self._layout.edge
        return Frame(
            frame.x + edge, frame.y + edge, frame.width - 2.0 * edge, frame.height - 2.0 * edge
        )

    def _laid(self, frame: Frame, sheet: Sheet) -> _Laid:
        """How a sheet finds room in a frame: words above and below a map, if there is room for one."""
        facts = [] if self._layout.backs else _all_facts(sheet)
        least = self._layout.map * (1.0 if len(sheet.entries) == 1 else MAP_OF_SEVERAL)
        head, facts, share = self._fitting(frame, _heads(sheet), facts, least)
        words = self._head_height(frame, head, share) + self._height(frame.width, facts, share)
        return _Laid(head, facts, share, frame.height - FOOT - words)

    def _front(self, frame: Frame, sheet: Sheet, laid: _Laid, tall: float) -> None:
        """What is seen first."""
        y = self._head(frame, laid.head, laid.share, sheet.entries[0].bench)
        if tall >= LEAST_MAP:
            area = Frame(frame.x, y, frame.width, tall)
            benches = [entry.bench for entry in sheet.entries]
            self._map.draw(self, area, benches, [entry.called for entry in sheet.entries])
        self._blocks(frame.x, y + tall, frame.width, laid.facts, laid.share)
        self._foot(frame)

    def _back(self, frame: Frame, facts: list[Block]) -> None:
        """The back, as `_front`."""
        _none, facts, share = self._fitting(frame, [[]], facts, 0.0)
        self._blocks(frame.x, frame.y, frame.width, facts, share)
        self._foot(frame)

    def _fitting(
        self, frame: Frame, heads: list[list[Block]], facts: list[Block], beside: float
    ) -> tuple[list[Block], list[Block], float]:
        """Head, facts and share of the type that find room in a frame, with so much beside them, mm."""
        for head, kept, share, spared in self._versions(heads, facts):
            tall = self._head_height(frame, head, share) + self._height(frame.width, kept, share)
            if tall + (0.0 if spared else beside) <= frame.height - FOOT:
                break
        return head, kept, share

    def _versions(
        self, heads: list[list[Block]], facts: list[Block]
    ) -> Iterator[tuple[list[Block], list[Block], float, bool]]:
        """Heads, facts, shares of the type, and whether all beside is spared; the best first.

        What gives way, in this order: the size of type, a line for each of many people, without a code
        what is beside, facts that may be spared, people but the first, what is beside, other facts, and
        the size of type again. Where what is beside goes from a sheet of several benches, all else
        comes back if there is room.
        """
        whole = facts
        for head in heads[:2]:
            for share in self._shares:
                yield head, facts, share, False
        # Who has no code to see the times by needs them more than the map.
        for share in () if self._address else self._shares:
            yield head, facts, share, True
        while any(block.spare for block in facts):
            facts = _fewer(facts, self._more, lambda block: block.spare)
            yield head, facts, share, not self._address
        for head in heads[2:]:
            yield head, facts, share, not self._address
        for share in self._shares if whole and whole[-1].entry else ():
            yield head, whole, share, True
        yield head, facts, share, True
        while any(block.text != self._more for block in facts):
            facts = _fewer(facts, self._more, lambda _block: True)
            yield head, facts, share, True
        while True:
            share *= SMALLER
            yield head, facts, share, True

    def _beside_code(self, frame: Frame) -> float:
        """The width that the QR code leaves, mm."""
        return frame.width - (self._layout.code if self._address else 0.0)

    def _head_height(self, frame: Frame, head: list[Block], share: float) -> float:
        tall = self._height(self._beside_code(frame), head[:-1], share)
        if self._address and head:
            tall = max(tall, self._layout.code)
        return tall + self._height(frame.width, head[-1:], share)

    def _head(self, frame: Frame, head: list[Block], share: float, bench: int) -> float:
        """Who it is and what they do in a line, with the QR code beside; how far down it comes, mm."""
        y = self._blocks(frame.x, frame.y, self._beside_code(frame), head[:-1], share)
        if self._address:
            code = self._layout.code
            x = frame.x + frame.width - code
            draw_qr(self, bench_address(self._address, bench), x, frame.y, code)
            y = max(y, frame.y + code)
        return self._blocks(frame.x, y, frame.width, head[-1:], share)

    def _font(self, block: Block, share: float) -> float:
        """Choose the type of a block; the height of its lines, mm."""
        size = self._layout.size * share * block.share
        self.set_font("Noto", "B" if block.bold or self._night else "", size)
        return size * POINT * LEADING

    def _height(self, width: float, blocks: Sequence[Block], share: float) -> float:
        """How much room blocks take, mm."""
        return sum(self._block_height(width, block, share) for block in blocks)

    def _block_height(self, width: float, block: Block, share: float) -> float:
        """The same of one, measured once."""
        key = width, block, share
        if key not in self._heights:
            line = self._font(block, share)
            words: Any = self.multi_cell(
                width, line, breakable(block.text), align="L", dry_run=True,
                output=MethodReturnValue.HEIGHT,
            )  # fmt: skip
            self._heights[key] = float(words) + AFTER * line
        return self._heights[key]

    def _blocks(self, x: float, y: float, width: float, blocks: Sequence[Block], share: float) -> float:
        """Set blocks; how far down they come, mm."""
        self.set_text_color(0)
        for block in blocks:
            line = self._font(block, share)
            self.set_xy(x, y)
            self.multi_cell(width, line, breakable(block.text), align="L")
            y = self.get_y() + AFTER * line
        return y

    def _foot(self, frame: Frame) -> None:
        """Of which plan it is, and when that was checked."""
        self.set_font("Noto", "", 6.5)
        self.set_text_color(60)
        self.set_xy(frame.x, frame.y + frame.height - 3.0)
        self.cell(frame.width, 3.0, self._briefing.foot, align="R")
        self.set_text_color(0)


def _heads(sheet: Sheet) -> list[list[Block]]:
    """The text above the map: a line for each of the people; then all of many in one, then fewer."""
    most = max(len(entry.people) for entry in sheet.entries)
    return [
        _head(sheet, None),
        *(_head(sheet, n) for n in range(min(most, MOST_NAMES), 0, -1) if most > MOST_LINES),
    ]


def _head(sheet: Sheet, most: int | None) -> list[Block]:
    """Who it is, and last what they do in a line; with a number, so many people in one block."""
    title = _("household: {name}").format(name=sheet.title)
    head = [Block(title, 1.3, bold=True)] if sheet.title else []
    alone = len(sheet.entries) == 1
    for entry in sheet.entries:
        people, size = entry.people, 1.9
        if people and not (most is None and alone):
            people, size = (listed(people, most or MOST_NAMES),), 1.3
        head += [
            Block(entry.title, 2.6 if alone else 1.8, bold=True),
            *(Block(person, size, bold=True) for person in people),
            *([] if people else [Block(_("Names: {blank}").format(blank=BLANK), 1.3)]),
            Block(entry.text.quick, 1.35 if alone else 1.1, bold=True),
        ]
    return head


def _all_facts(sheet: Sheet) -> list[Block]:
    """All else of a sheet."""
    facts = [
        replace(block, entry=n)
        for n, entry in enumerate(sheet.entries)
        for block in _facts(entry, len(sheet.entries))
    ]
    return [*facts, Block(sheet.entries[-1].text.times, 0.85, entry=len(sheet.entries) - 1)]


def _facts(entry: Entry, entries: int) -> list[Block]:
    """All else, under the bench's name if there are several."""
    name = [Block(entry.called, 1.0, bold=True)] if entries > 1 else []
    text = entry.text
    return [
        *name,
        *(Block(line, 1.0, bold=True) for line in text.people),
        Block(text.tightest),
        *([Block(entry.marks)] if entry.marks else []),
        *(Block(line, spare=bool(entry.marks)) for line in text.place),
        *([Block(entry.kin, spare=True)] if entry.kin else []),
        *(Block(line, spare=True) for line in text.stretches),
        *(Block(line, 0.85, spare=True) for line in text.paces),
    ]


def _fewer(facts: list[Block], more: str, spare: Callable[[Block], bool]) -> list[Block]:
    """The same without one that may be spared, and a word to its bench that there is more.

    It is the last of the bench of which most are left.
    """
    sparable = [n for n, block in enumerate(facts) if block.text != more and spare(block)]
    left = Counter(facts[n].entry for n in sparable)
    last = max(sparable, key=lambda n: (left[facts[n].entry], n))
    entry = facts[last].entry
    kept = [block for block in facts[:last] if block.text != more or block.entry != entry]
    rest = [block for block in facts[last + 1 :] if block.text != more or block.entry != entry]
    return [*kept, Block(more, entry=entry), *rest]


def write_benches(
    path: Path, briefing: Briefing, options: Options, progress: Progress = silent
) -> None:
    """Write the benches' sheets of a dance."""
    most = MOST_BENCHES if options.paper == "a4" and not options.night else 1
    sheets = bench_sheets(briefing, options.by, options.phones, most)
    names = [shown_name(one) for one in briefing.plan.obstacles()]
    cards = Cards(briefing, options.paper, options.night, repr((sheets, names)))
    cards.write_all(sheets, progress)
    with whole_bytes(path) as made:
        made.write(bytes(cards.output()))
