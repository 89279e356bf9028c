"""What papers and public programs answer to the contest's questions, and mistakes that lead there.

Numbers are quoted as they are printed, in metres and seconds; of a workbook, the moment at which its
dragon stands, as `compare` finds it. Sources were read in November 2026.
"""

from dataclasses import dataclass
from typing import Literal

from benchdragon.i18n import N_, _
from benchdragon.paper.grading import TASKS, WANTED, figures_agreeing
from benchdragon.paper.wrong_numbers import Wrong

QUESTIONS = ("contact", "pitch", "turn-length", "head-speed")
Verdict = Literal["right", "mistake", "unexplained"]

# The side to which a number may be rounded and still keep benches apart, or handles within the limit.
SAFE_SIDE = {"contact": -1.0, "pitch": 1.0, "head-speed": -1.0}


@dataclass(frozen=True)
class Source:
    """A paper or a program.

    Attributes:
        who: authors, or the account that published it.
        where: a DOI, an address, or a repository of GitHub.
        said: task, and the number as it is printed, in SI units.
        note: what else is to be said of it; "" if nothing.
    """

    who: str
    where: str
    said: tuple[tuple[str, str], ...]
    note: str = ""


@dataclass(frozen=True)
class Claim:
    """A number of a source beside the exact one.

    Attributes:
        source: whose it is.
        task: "contact" (s), "pitch" (m), "turn-length" (m) or "head-speed" (m/s).
        said: the number, as printed.
        exact: the exact one.
        verdict: "right" to the digits printed, "mistake" where one leads to it, else "unexplained".
        finding: the verdict in words.
    """

    source: Source
    task: str
    said: str
    exact: float
    verdict: Verdict
    finding: str

    @property
    def command(self) -> str:
        """The command that grades the number."""
        return f"benchdragon compare {self.task}={self.said}"


SOURCES = (
    Source("Nie, Zhao", "CITATION.cff", (("pitch", "0.452"),)),
    Source(
        "Zhang, Shang, Lin 2025", "doi:10.25236/icmmct.2025.021",
        (("contact", "412.478"), ("pitch", "0.45035")),
    ),
    Source("Shi, Wei, Zhang 2025", "doi:10.54097/rq3xkw77", (("pitch", "0.43"),)),
    Source(
        "Luo, Xiao, Zhong", "housingscience.org/volume-46-issue-4", (("contact", "416"),)
    ),
    Source(
        "UESTC 2024", "doi:10.12179/1672-4550.20240676",
        (("turn-length", "11.7915"), ("head-speed", "0.9670")),
        N_("both are of a turn of its own, which the abstract does not describe"),
    ),
    Source(
        "discovery.researcher.life", "discovery.researcher.life/topic/matrix-transformer/10286325",
        (("contact", "566.2"),),
        N_("no contact until then; but the contest's spiral ends after 442.59 m"),
    ),
    Source(
        "CUMCM A163", "dxs.moe.gov.cn",
        (("contact", "412.473894"), ("pitch", "0.450338"), ("head-speed", "1.246266")),
    ),
    Source(
        "CUMCM A178", "dxs.moe.gov.cn, 1977937",
        (
            ("contact", "412.4739"), ("pitch", "0.4000"), ("turn-length", "13.621"),
            ("turn-length", "12.936"), ("turn-length", "8.443"), ("head-speed", "1.2462"),
        ),
    ),
    Source(
        "cny123222", "github.com/cny123222/CUMCM-2024A-Bench-Dragon",
        (("contact", "412.473837767"), ("pitch", "0.450337"), ("head-speed", "1.246266356")),
    ),
    Source(
        "jiebro0721", "github.com/jiebro0721/cumcm-2024a-bench-dragon",
        (
            ("contact", "412.473838"), ("pitch", "0.45033645"), ("turn-length", "13.621245"),
            ("head-speed", "1.24626636"),
        ),
    ),
    Source(
        "Arctic1010", "github.com/Arctic1010/CUMCM2024-A",
        (("contact", "412.473838"), ("pitch", "0.450337"), ("head-speed", "1.283843")),
    ),
    Source(
        "PHTPSN", "github.com/PHTPSN/2024CUMCM-A",
        (("contact", "412.473838"), ("pitch", "0.417138"), ("head-speed", "1.244612")),
    ),
    Source(
        "Robin567-Li", "github.com/Robin567-Li/CUMCM2024A",
        (("contact", "412.4738"), ("pitch", "0.417137"), ("turn-length", "13.6212449")),
    ),
    Source(
        "BrassWrench", "github.com/BrassWrench/CUMCM2024",
        (("contact", "413"), ("contact", "412.580327"), ("pitch", "0.45"), ("head-speed", "0.773423")),
        N_("one contact is of the paper, the other of the workbook"),
    ),
    Source(
        "XinYU20040412",
        "github.com/XinYU20040412/Operation-Regulation-of-Bench-Dragon-Dance-Based-on-Recursive-Model",
        (
            ("contact", "412.50"), ("contact", "412.48"), ("pitch", "0.420"), ("pitch", "0.448697"),
            ("head-speed", "1.58"),
        ),
        N_("contact as in the paper and as on its first page; pitches of two models"),
    ),
    Source(
        "qianliq", "github.com/qianliq/CUMCM2024",
        (("contact", "412.473633"), ("head-speed", "1.247010")),
    ),
    Source(
        "walker4869", "github.com/walker4869/CUMCM-2024-Problem-A",
        (("contact", "413.000000"), ("pitch", "0.451")),
    ),
    Source(
        "Adrn1n", "github.com/Adrn1n/2024CUMCM",
        (
            ("contact", "412.6"), ("pitch", "0.421"), ("turn-length", "13.48"),
            ("head-speed", "1.24"),
        ),
    ),
    Source(
        "Neo-0-Gu", "github.com/Neo-0-Gu/CUMCM-2024-BenchDragon",
        (
            ("contact", "413"), ("pitch", "0.445"), ("turn-length", "13.6148"),
            ("head-speed", "1.24"),
        ),
    ),
    Source(
        "Jiadezhende", "github.com/Jiadezhende/CUMCM2024_A",
        (("contact", "424.850097"), ("pitch", "0.4243")),
        N_("angles of handles are multiples of 0.01 rad there"),
    ),
    Source(
        "weiyuanli788", "github.com/weiyuanli788/CUMCM_2024_A_Code",
        (("pitch", "0.965235"), ("head-speed", "1.414214")),
        N_("handles in its workbook are 0.022 m apart: its benches are not rigid"),
    ),
    Source(
        "julymiaw", "github.com/julymiaw/CUMCM2024A",
        (("contact", "412.473901"), ("pitch", "0.420217")),
    ),
    Source("Quantum009", "github.com/Quantum009/CUMCM2024A", (("contact", "412.480000"),)),
    Source(
        "jianjian-ops", "github.com/jianjian-ops/Bench-Dragon-Data-Analysis",
        (("contact", "414.000000"),),
    ),
    Source("ap0stader", "github.com/ap0stader/2024CUMCM", (("contact", "412.48"),)),
    Source("zty2004", "github.com/zty2004/CUMCM2024", (("contact", "412.473843"),)),
)  # fmt: skip


def claims() -> list[Claim]:
    """Every number of every source, judged; each mistake is computed."""
    exact = {task: TASKS[task][0]()[0] for task in QUESTIONS}
    wrong = {task: list(TASKS[task][1](exact[task])) for task in QUESTIONS}
    return [
        Claim(source, task, said, exact[task], *_judged(task, said, exact[task], wrong[task]))
        for source in SOURCES
        for task, said in source.said
    ]


def _judged(task: str, said: str, exact: float, wrong: list[Wrong]) -> tuple[Verdict, str]:
    """The verdict on a number; of mistakes that lead to it, the one that comes nearest."""
    if text := _right(task, said, exact):
        return "right", text
    near = [(abs(value - float(said)), text) for value, text in wrong if _leads_to(value, said)]
    if near:
        return "mistake", min(near, key=lambda one: one[0])[1]
    return "unexplained", _("unexplained: no mistake that is known here leads to it")


def _unit(said: str) -> float:
    """A unit of the last digit that is printed, a little more for rounding."""
    return (1.0 + 1e-9) * 10.0 ** -len(said.partition(".")[2])


def _right(task: str, said: str, exact: float) -> str:
    """In what way a number is right, in words; "" if it is not."""
    off = float(said) - exact
    if abs(off) <= 0.5 * _unit(said):
        return _("right to its digits")
    if figures_agreeing(float(said), exact) >= WANTED:
        return _("right to {count} figures").format(count=figures_agreeing(float(said), exact))
    if abs(off) < _unit(said) and off * SAFE_SIDE.get(task, 0.0) > 0.0:
        return _("right, rounded to the safe side")
    return ""


def _leads_to(value: float, said: str) -> bool:
    """Whether a mistake's number is the one that is printed, rounded in whatever way."""
    off = abs(value - float(said))
    return off < _unit(said) or figures_agreeing(float(said), value) >= WANTED
