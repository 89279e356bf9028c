"""Why the papers of a dance are set by fpdf2, and not printed by a browser from HTML.

Both set the same sheets here: 120 benches with their people, an A4 page each, Chinese names, what each
bench does, and its QR code. The browser is spared the small maps, which fpdf2 draws besides. Below:

1. what a user has to install;
2. how long the sheets take, from their texts to the file, the browser's start included;
3. which fonts the file holds, once where the HTML names this package's font file, once where it leaves
   the font to the machine, and how many of the names' signs that are on the sheets can be read back;
4. how long a line of 100 mm is on the page;
5. whether the same plan gives the same bytes a second time.

The browser is the faster one, and told its fonts and its page it sets the sheets to the same scale.
What decides is what a user must have: the browser's folder is many times fpdf2 and the fonts together.
And the file of fpdf2 is a function of the plan: no date, and no font of the machine. Where no browser
is found, this page says so and shows fpdf2 alone.
"""

import hashlib
import shutil
import subprocess
import time
from collections.abc import Callable
from datetime import date
from html import escape
from importlib.metadata import distribution
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import cast

import segno
from fpdf import FPDF
from pypdf import PdfReader
from pypdf.generic import DictionaryObject
from pypdfium2 import PdfDocument

from benchdragon.analysis.check import check
from benchdragon.figures.style import FONT_FILES
from benchdragon.i18n import spoken_in
from benchdragon.plans.roster import roster_of
from benchdragon.plans.schema import read_plan
from benchdragon.sheets.benches import bench_sheets
from benchdragon.sheets.briefing import Briefing, briefing_of
from benchdragon.sheets.cards import write_benches
from benchdragon.sheets.checked import Record, foundation
from benchdragon.sheets.options import Options

PLAN = Path(__file__).parent.parent / "examples" / "12_village.dragon.toml"
ADDRESS = "https://dragon.example/village"
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
# Where Debian and Google put theirs.
PLACES = (Path("/usr/lib/chromium"), Path("/opt/google/chrome"))
# What fpdf2 brings along; Pillow and fonttools come with matplotlib too.
PACKAGES = ("fpdf2", "defusedxml", "fonttools", "pillow")
RULE = 100.0
POINT = 25.4 / 72.0
REPEATS = 3
Job = Callable[[Path], None]


def briefing() -> Briefing:
    """What the sheets of the example are made from."""
    plan = read_plan(str(PLAN), [f"people.address={ADDRESS}"])
    roster = roster_of(plan)
    record = Record(sha256=foundation(plan, roster), date=date.today(), version="", verdict={})
    return briefing_of(check(plan), roster, record)


def folder_size(path: Path) -> float:
    """All files of a folder, MB."""
    return sum(one.stat().st_size for one in path.rglob("*") if one.is_file()) / 1e6


def package_size(name: str) -> float:
    """All files of an installed package, MB."""
    found = distribution(name)
    paths = (Path(str(found.locate_file(file))) for file in found.files or ())
    return sum(path.stat().st_size for path in paths if path.is_file()) / 1e6


def page(briefing: Briefing, *, own_font: bool) -> str:
    """The sheets as HTML, a page each; with this package's font, or with what the machine has."""
    face = "body { font-family: sans-serif; }"
    if own_font:
        face = (
            f"@font-face {{ font-family: Own; src: url('{Path(FONT_FILES[0]).as_uri()}'); }} "
            "body { font-family: Own; }"
        )
    parts = []
    for sheet in bench_sheets(briefing, "bench", phones=False, most=1):
        (entry,) = sheet.entries
        code = segno.make(f"{ADDRESS}#bench={entry.bench}", error="m").svg_inline(scale=3)
        lines = "".join(f"<p>{escape(line)}</p>" for line in (*entry.people, *entry.text.lines))
        parts.append(f"<section><h1>{escape(entry.called)}</h1>{code}{lines}</section>")
    style = f"@page {{ size: A4; margin: 12mm; }} section {{ break-after: page; }} {face}"
    return f"<!doctype html><meta charset=utf-8><style>{style}</style>{''.join(parts)}"


def rule_page() -> str:
    """A black bar of RULE mm as HTML."""
    bar = f"width: {RULE}mm; height: 5mm; background: black; print-color-adjust: exact"
    return f"<!doctype html><style>@page {{ size: A4; }}</style><div style='{bar}'></div>"


def own_rule(path: Path) -> None:
    """The same bar, by fpdf2."""
    pdf = FPDF()
    pdf.add_page()
    pdf.rect(20.0, 20.0, RULE, 5.0, style="F")
    pdf.output(str(path))


def printing(browser: str, html: str) -> Job:
    """What has a browser print a page."""

    def job(path: Path) -> None:
        source = path.with_suffix(".html")
        source.write_text(html, "utf-8")
        command = [
            browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
            f"--user-data-dir={path.parent / 'profile'}", f"--print-to-pdf={path}", source.as_uri(),
        ]  # fmt: skip
        subprocess.run(command, check=True, capture_output=True, timeout=120)

    return job


def seconds(job: Job, path: Path) -> float:
    """The least wall time of a few runs, s."""
    best = float("inf")
    for _run in range(REPEATS):
        start = time.perf_counter()
        job(path)
        best = min(best, time.perf_counter() - start)
    return best


def fonts_of(path: Path) -> str:
    """The fonts that a PDF holds."""
    names = set()
    for one in PdfReader(path).pages:
        fonts = cast("DictionaryObject", cast("DictionaryObject", one["/Resources"]).get("/Font", {}))
        for font in fonts.values():
            called = str(cast("DictionaryObject", font.get_object()).get("/BaseFont", "drawn signs"))
            names.add(called.rpartition("+")[2].lstrip("/"))
    return ", ".join(sorted(names))


def read_back(path: Path, briefing: Briefing) -> str:
    """How many of the names on the sheets stand in a PDF's text."""
    text = "".join("".join(one.extract_text().split()) for one in PdfReader(path).pages)
    people = [one.name for some in briefing.roster.benches.values() for one in some]
    return f"{sum(''.join(name.split()) in text for name in people)} of {len(people)} names"


def rule_length(path: Path) -> float:
    """How long the longest thing that is drawn is, mm."""
    document = PdfDocument(path)
    bounds = [one.get_bounds() for one in document[0].get_objects()]
    width = max((right - left for left, _low, right, _high in bounds if right - left < 500.0))
    document.close()
    return float(width) * POINT


def show(name: str, job: Job, rule: Job, folder: Path, briefing: Briefing) -> None:
    """Print what one way comes to."""
    first, second = folder / "first.pdf", folder / "second.pdf"
    took = seconds(job, first)
    time.sleep(1.1)  # a date in the file would show
    job(second)
    rule(folder / "rule.pdf")
    same = len({hashlib.sha256(path.read_bytes()).digest() for path in (first, second)}) == 1
    pages = len(PdfReader(first).pages)
    print(
        f"{name}: {pages} pages in {took:.1f} s, {first.stat().st_size / 1e6:.2f} MB; "
        f"{fonts_of(first)}; {read_back(first, briefing)}; {RULE:g} mm are "
        f"{rule_length(folder / 'rule.pdf'):.3f} mm; again {'the same' if same else 'other'} bytes"
    )


def main() -> None:
    """Print what each way takes and gives."""
    packages = {name: package_size(name) for name in PACKAGES}
    print("installed: " + ", ".join(f"{name} {size:.1f} MB" for name, size in packages.items()), end="")
    print(f", fonts of this package {sum(Path(one).stat().st_size for one in FONT_FILES) / 1e6:.1f} MB")
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    for place in filter(Path.is_dir, PLACES if browser else ()):
        print(
            f"a browser's own folder here: {folder_size(place):.0f} MB, without libraries that it wants"
        )
    with TemporaryDirectory() as name, spoken_in("zh"):
        folder, told = Path(name), briefing()
        show("fpdf2", lambda path: write_benches(path, told, Options()), own_rule, folder, told)
        if browser is None:
            print(f"no browser was found here ({', '.join(BROWSERS)}): nothing is said of printing")
            return
        for own_font in (True, False):
            title = f"browser, {'font of this package' if own_font else 'font of the machine'}"
            job = printing(browser, page(told, own_font=own_font))
            show(title, job, printing(browser, rule_page()), folder, told)


if __name__ == "__main__":
    main()
