"""Plans as addresses of the planner hold them, made without a page."""

import base64
import json
import zlib
from hashlib import sha256
from typing import Any

from benchdragon.plans.schema import Plan


def _as_browsers_write(value: Any) -> Any:
    """Data as pages order and write it: keys sorted, none without a value, whole numbers as such."""
    if isinstance(value, dict):
        return {key: _as_browsers_write(value[key]) for key in sorted(value) if value[key] is not None}
    if isinstance(value, list | tuple):
        return [_as_browsers_write(one) for one in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def letters(plan: Plan) -> str:
    """A plan as the letters behind `#plan=`: a checksum, and all of its keys, deflated."""
    data = _as_browsers_write(plan.data())
    text, told = (
        json.dumps(one, ensure_ascii=False, separators=(",", ":")) for one in (data, ["", data])
    )
    packer = zlib.compressobj(9, wbits=-zlib.MAX_WBITS)
    packed = packer.compress(told.encode()) + packer.flush()
    return base64.urlsafe_b64encode(sha256(text.encode()).digest()[:4] + packed).decode().rstrip("=")
