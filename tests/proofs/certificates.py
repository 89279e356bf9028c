"""A small plan whose certificates take a tenth of a second: a bend of half a turn, a post beside it."""

import json
import tomllib
from functools import cache
from typing import Any

from benchdragon.analysis.certificate import certificate_of
from benchdragon.analysis.check import check
from benchdragon.plans.schema import Plan, checked

# Where the post stands, m: out of the way, where bench 1 comes to it, and where it is from the start.
ASIDE, IN_THE_WAY, ON_A_BENCH = (16.2, 1.0), (14.6, 1.0), (9.2, 0.0)
# Bench 3 comes nearer than this to bench 1 in the bend, m.
TOO_MUCH = 1.19
TEXT = """schema = 1
[dragon]
benches = 6
width = 0.2
head_length = 1.6
body_length = 1.6
tail_length = 1.6
front_inset = 0.1
rear_inset = 0.1
[[route.part]]
kind = "line"
length = 14
[[route.part]]
kind = "arc"
radius = 1
angle = 180
[[route.part]]
kind = "line"
length = 14
[walk]
start = 10
end = 18
[limits]
margin = {margin}
[[obstacle]]
name = "post"
kind = "circle"
centre = {post}
radius = 0.1
margin = 0.05
"""


def bend(post: tuple[float, float] = ASIDE, margin: float = 0.0) -> Plan:
    """The plan, with the post there, and benches that are to keep `margin` apart, m."""
    return checked(tomllib.loads(TEXT.format(post=list(post), margin=margin)), "bend")


@cache
def _text(post: tuple[float, float], margin: float) -> str:
    report = check(bend(post, margin), prove=True)
    return certificate_of(report.plan, report.claims).model_dump_json()


def written(post: tuple[float, float] = ASIDE, margin: float = 0.0) -> dict[str, Any]:
    """The JSON of its certificate, to be tampered with."""
    found: dict[str, Any] = json.loads(_text(post, margin))
    return found
