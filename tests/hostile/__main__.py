"""`python -m tests.hostile FROM TO`: strangers' plans of these seeds, and what came of questions.

What came of each is a line of RECORD, in which a later run goes on where one ended, and asks again what
was at fault; what all of them came to is told, and written to COUNTS.
"""

import json
import os
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import asdict
from hashlib import sha256
from pathlib import Path
from typing import Any

from benchdragon.budget import MEMORY
from benchdragon.files import whole_file
from tests.hostile.children import (
    BESIDE,
    ENDLESS,
    NOT_SAFE,
    PLAN_WRONG,
    UNDECIDED,
    WRONG,
    asked,
    load,
    questions_of,
)
from tests.hostile.plans import hostile

SHARE = 0.1
RECORD, COUNTS = Path("out/hostile.jsonl"), Path("out/hostile.txt")
Row = dict[str, Any]


def main(arguments: list[str]) -> int:
    """Try what was not tried yet, and say what all came to; 1 if one did what it must not."""
    first, last = map(int, arguments)
    found: list[Row] = []
    load()
    try:
        found.extend(tried(range(first, last)))
    finally:
        told = counted(found)
        with whole_file(COUNTS) as path:
            path.write_text(
                f"of {last - first} plans, from seed {first} on:\n{told}\n", encoding="utf-8"
            )
        print(told)
    return 1 if any(row["fault"] for row in found) else 0


def tried(seeds: Iterable[int]) -> Iterator[Row]:
    """What came of each question, which is asked where the record does not say it."""
    RECORD.parent.mkdir(exist_ok=True)
    known = {(row["plan"], row["question"]): row for row in recorded() if not row["fault"]}
    with RECORD.open("a", encoding="utf-8") as record:
        for seed in seeds:
            text = hostile(seed)
            plan = sha256(text.encode("utf-8", "replace")).hexdigest()[:16]
            for question in questions_of(seed):
                row = known.get((plan, question))
                if row is None:
                    found = asdict(asked(text, question, SHARE))
                    row = {"seed": seed, "plan": plan, "question": question, **found}
                    record.write(json.dumps(row) + "\n")
                    record.flush()
                if row["fault"]:
                    print(f"seed {seed}, {question}: {row['fault']}", flush=True)
                yield row


def recorded() -> list[Row]:
    """What the record says, without a last line that was cut short."""
    if not RECORD.exists():
        return []
    text = RECORD.read_bytes()
    os.truncate(RECORD, text.rfind(b"\n") + 1)
    return [json.loads(line) for line in text.splitlines(keepends=True) if line.endswith(b"\n")]


def counted(rows: list[Row]) -> str:
    """What questions came to, in words."""
    counts: Counter[str] = Counter({"plans": len({row["seed"] for row in rows})})
    seconds, memory = 0.0, 0
    for row in rows:
        counts["questions tried"] += 1
        counts[_name(row)] += 1
        counts["faults"] += bool(row["fault"])
        seconds, memory = max(seconds, row["seconds"]), max(memory, row["memory"])
    lines = [f"{name}: {number}" for name, number in counts.items()]
    lines.append(f"longest: {seconds:.1f} CPU s, of {ENDLESS} that are allowed")
    stated = SHARE * MEMORY + BESIDE
    lines.append(f"most memory: {memory / 1e6:.0f} MB, of {stated / 1e6:.0f} that are stated")
    return "\n".join(lines)


def _name(row: Row) -> str:
    code = row["code"]
    if row["over"]:
        return "over budget"
    if code in (WRONG, PLAN_WRONG):
        return "refused"
    if code is None:
        return "failed"
    return "undecided" if code == UNDECIDED else "answered" if code <= NOT_SAFE else "no solution"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
