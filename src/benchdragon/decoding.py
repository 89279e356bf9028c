"""What the bytes of a text file may say: UTF-8, UTF-16 with its mark, or an encoding of the region."""

import codecs
from collections.abc import Iterable, Iterator
from itertools import chain


def readings(data: bytes, others: Iterable[str]) -> Iterator[str]:
    """Each text that bytes can be, the likeliest first; `others` are encodings tried after UTF-8.

    With the mark of UTF-16 they are that or nothing.
    """
    wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    for encoding in ("utf-16",) if wide else chain(("utf-8-sig",), others):
        try:
            yield data.decode(encoding)
        except (UnicodeDecodeError, LookupError):
            continue
