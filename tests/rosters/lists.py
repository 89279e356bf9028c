"""Lists of names as files of each kind."""

import csv
import io
import zipfile
from collections.abc import Sequence
from datetime import datetime
from html import escape

import xlsxwriter

Cells = Sequence[Sequence[object]]

CONTENT = (
    '<?xml version="1.0" encoding="UTF-8"?><office:document-content'
    ' xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0"'
    ' xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0"'
    ' xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0" office:version="1.2">'
    "<office:body><office:spreadsheet>{tables}</office:spreadsheet></office:body>"
    "</office:document-content>"
)
ODS_TYPE = "application/vnd.oasis.opendocument.spreadsheet"

MANIFEST = (
    '<?xml version="1.0" encoding="UTF-8"?>'
    '<manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0">'
    f'<manifest:file-entry manifest:full-path="/" manifest:media-type="{ODS_TYPE}"/>'
    "</manifest:manifest>"
)


def csv_bytes(rows: Cells, encoding: str = "utf-8-sig", mark: str = ",") -> bytes:
    """A table of text."""
    text = io.StringIO(newline="")
    csv.writer(text, delimiter=mark).writerows(rows)
    return text.getvalue().encode(encoding)


def xlsx_bytes(rows: Cells, *more: tuple[str, Cells], merged: Sequence[str] = ()) -> bytes:
    """A workbook with a sheet of `rows`, then more sheets by name; cells of `merged` are joined."""
    file = io.BytesIO()
    book = xlsxwriter.Workbook(file, {"in_memory": True})
    book.set_properties({"created": datetime(2026, 2, 17)})
    for name, cells in (("名单", rows), *more):
        sheet = book.add_worksheet(name)
        for n, row in enumerate(cells):
            sheet.write_row(n, 0, row)
    for area in merged:
        top = int(area.partition(":")[0][1:]) - 1
        book.worksheets()[0].merge_range(area, rows[top][ord(area[0]) - ord("A")])
    book.close()
    return file.getvalue()


def ods_cell(cell: object) -> str:
    """A cell as OpenDocument writes it."""
    if cell in ("", None):
        return "<table:table-cell/>"
    kind = (
        f'office:value-type="float" office:value="{cell}"'
        if isinstance(cell, int | float)
        else 'office:value-type="string"'
    )
    return f"<table:table-cell {kind}><text:p>{escape(str(cell))}</text:p></table:table-cell>"


def ods_bytes(rows: Cells, tail: str = "") -> bytes:
    """An OpenDocument sheet of `rows`, with `tail` after them."""
    lines = "".join(f"<table:table-row>{''.join(map(ods_cell, row))}</table:table-row>" for row in rows)
    return zipped(
        {
            "mimetype": ODS_TYPE,
            "META-INF/manifest.xml": MANIFEST,
            "content.xml": CONTENT.format(
                tables=f'<table:table table:name="名单">{lines}{tail}</table:table>'
            ),
        }
    )


def zipped(parts: dict[str, str]) -> bytes:
    """A zip file of parts."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in parts.items():
            archive.writestr(name, text)
    return file.getvalue()
