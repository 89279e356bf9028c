"""Pages of other PDF files, drawn by matplotlib, shown as they are on pages of a PDF."""

import io
from typing import cast

from pypdf import PdfReader, PdfWriter
from pypdf.generic import ArrayObject, DictionaryObject, IndirectObject, NameObject, StreamObject

# A point, mm.
MM = 25.4 / 72.0
# What a PDF page starts with; fpdf2 leaves other ends and joins of lines, widths, dashes and colours.
PLAIN = "0 J 0 j 1 w 10 M [] 0 d 0 G 0 g"
Box = tuple[float, float, float, float]


def size_of(file: bytes) -> tuple[float, float]:
    """Width and height of the first page of a PDF, mm."""
    box = PdfReader(io.BytesIO(file)).pages[0].mediabox
    return MM * float(box.width), MM * float(box.height)


def add_form(writer: PdfWriter, file: bytes) -> IndirectObject:
    """The first page of a PDF as a form that pages of `writer` can show, as often as they like."""
    picture = PdfReader(io.BytesIO(file)).pages[0]
    contents = picture.get_contents()
    if contents is None:
        raise AssertionError("matplotlib draws on its pages")
    form = StreamObject()
    form.set_data(contents.get_data())
    form[NameObject("/Type")] = NameObject("/XObject")
    form[NameObject("/Subtype")] = NameObject("/Form")
    form[NameObject("/BBox")] = picture.mediabox
    form[NameObject("/Resources")] = picture["/Resources"].clone(writer)
    return writer._add_object(form.flate_encode())


def show_form(
    writer: PdfWriter, page: int, form: IndirectObject, at: tuple[float, float], *, scale: float = 1.0,
    window: Box | None = None,
) -> None:  # fmt: skip
    """Show a form on a page: a stream after those of the page; before them, if it is in a window.

    Args:
        writer: of the PDF.
        page: from 0.
        form: as `add_form` gives it.
        at: where its lower left corner is, mm from the page's.
        scale: how much larger it is shown.
        window: left, bottom, width and height of what is shown of it, mm on the page.
    """
    shown = writer.pages[page]
    resources = cast("DictionaryObject", shown["/Resources"].get_object())
    forms = resources.setdefault(NameObject("/XObject"), DictionaryObject()).get_object()
    name = NameObject(f"/Drawn{len(forms)}")
    forms[name] = form
    clip = "" if window is None else " ".join(f"{side / MM:.4f}" for side in window) + " re W n "
    x, y = (f"{along / MM:.4f}" for along in at)
    show = StreamObject()
    show.set_data(f"q {PLAIN} {clip}{scale:.6f} 0 0 {scale:.6f} {x} {y} cm {name} Do Q".encode())
    before = shown.raw_get("/Contents")
    streams = list(before) if isinstance(before, ArrayObject) else [before]
    added = writer._add_object(show)
    shown[NameObject("/Contents")] = ArrayObject(
        [*streams, added] if window is None else [added, *streams]
    )
