"""A skeleton of the contest's five questions, to be filled in: a script of cells, or a notebook."""

import json
from collections.abc import Iterator

from benchdragon.i18n import N_, _

# Texts, and after each the code of its cell. The code runs as it is: what is not computed yet is NaN.
CELLS = (
    (
        N_(
            "# The bench dragon: CUMCM 2024, problem A\n\n"
            "Replace what is marked by TODO, and run all of it again: each part writes its workbook "
            "and grades itself. Handles are numbered from 0: the head's front handle, then the front "
            "handle of each of the 222 benches behind it, last the tail's rear one. Lengths are in m, "
            "times in s."
        ),
        """
import math

import numpy as np

import benchdragon as bd

HANDLES = 224
LINKS = [3.41 - 2 * 0.275] + 222 * [2.20 - 2 * 0.275]
NOT_YET = math.nan
""",
    ),
    (
        N_(
            "## 1. Where is every handle, and how fast?\n\n"
            "The pitch is 0.55 m. The head starts 16 pitches from the centre, at (8.8, 0), and coils "
            "in clockwise at 1 m/s. What is given stands there; find the rest: where the head is at a "
            "time, every handle from the one before it, and its speed."
        ),
        """
def coil(times, pitch=0.55):
    x, y, speed = np.full((3, len(times), HANDLES), NOT_YET)  # TODO
    x[:, 0], y[:, 0], speed[:, 0] = 16 * pitch, 0.0, 1.0  # TODO: true at 0 s alone
    return x, y, speed


bd.write_result1("result1.xlsx", *coil(np.arange(0.0, 301.0)), force=True)
print(bd.compare("result1.xlsx"))
""",
    ),
    (
        N_(
            "## 2. When do benches first touch?\n\n"
            "Benches are 0.30 m wide; their ends reach 0.275 m beyond their holes."
        ),
        """
contact = NOT_YET  # TODO

bd.write_result2("result2.xlsx", *coil([contact]), force=True)
print(bd.grade("contact", contact))
print(bd.compare("result2.xlsx"))
""",
    ),
    (
        N_(
            "## 3. The smallest pitch\n\n"
            "With which the head comes to the edge of a disc of radius 4.5 m, and no benches touch."
        ),
        """
pitch = NOT_YET  # TODO

print(bd.grade("pitch", pitch))
""",
    ),
    (
        N_(
            "## 4. The turn\n\n"
            "The pitch is 1.7 m. Within the disc the dragon turns on two arcs, the first of twice the "
            "radius of the second, tangent to one another and to both spirals; the head enters the "
            "disc at 0 s. Find how long the turn is, and where all handles are from -100 s to 100 s."
        ),
        """
def turn(times):
    x, y, speed = np.full((3, len(times), HANDLES), NOT_YET)  # TODO
    speed[:, 0] = 1.0
    return x, y, speed


length = NOT_YET  # TODO

print(bd.grade("turn-length", length))
bd.write_result4("result4.xlsx", *turn(np.arange(-100.0, 101.0)), force=True)
print(bd.compare("result4.xlsx"))
""",
    ),
    (
        N_(
            "## 5. How fast may the head walk?\n\n"
            "No handle may be faster than 2 m/s on the way of question 4."
        ),
        """
head_speed = NOT_YET  # TODO

print(bd.grade("head-speed", head_speed))
""",
    ),
)


def script() -> str:
    """The skeleton as a Python file in cells, in the language in use."""
    return "\n\n".join(part.strip("\n") for part in _parts()) + "\n"


def _parts() -> Iterator[str]:
    for text, code in CELLS:
        yield "# %% [markdown]\n" + "\n".join(f"# {line}".rstrip() for line in _(text).splitlines())
        yield f"# %%\n{code.strip()}"


def notebook() -> str:
    """The same as a Jupyter notebook."""
    cells = []
    for n, (text, code) in enumerate(CELLS):
        told = {"cell_type": "markdown", "id": f"text-{n}", "metadata": {}, "source": _(text)}
        run = {"cell_type": "code", "id": f"code-{n}", "metadata": {}, "source": code.strip()}
        cells += [told, {**run, "execution_count": None, "outputs": []}]
    kernel = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    book = {"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(book, ensure_ascii=False, indent=1) + "\n"
