"""A small dance with people, checked."""

from pathlib import Path

from benchdragon.analysis.bench_walks import BenchWalk, bench_walks
from benchdragon.analysis.check import Report, check
from benchdragon.plans.schema import Plan, read_plan
from benchdragon.rosters.roster import Person, Roster

PLAN = """schema = 1
base = "spiral-in"
[meta]
title = "Our dance"
title_zh = "我们的舞龙"
[dragon]
benches = 8
[route]
pitch = 1.2
start_turn = 4
[walk]
end = 12
[people]
count_head = false
unit = "qiao"
address = "https://dragon.test/ours"
"""
ROSTER = Roster(
    {
        1: (Person("张三", "张家", "138-0000-0001"), Person("李四", "李家", "138-0000-0002")),
        2: (Person("王五", "张家", "138-0000-0003"),),
        6: (Person("赵六", "赵家"),),
    },
    ("qiao 2 has nobody",),
)


def village(folder: Path, text: str = PLAN) -> Path:
    """The plan as a file."""
    path = folder / "ours.dragon.toml"
    path.write_text(text, "utf-8")
    return path


def checked(plan: Plan) -> tuple[Report, tuple[BenchWalk, ...]]:
    """A plan's check, and what each bench does."""
    report = check(plan)
    return report, bench_walks(plan, report.walk, (report.start, report.end))


def small(folder: Path, *settings: str) -> Report:
    """The check of the small dance."""
    return check(read_plan(str(village(folder)), settings))
