"""One term a concept: the glossary of the manual, and the catalogue held to it."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cache
from itertools import groupby
from pathlib import Path

import pytest
from babel.messages.catalog import Catalog
from babel.messages.pofile import read_po

from benchdragon.i18n import LOCALE_FOLDER

ROOT = Path(__file__).parent.parent
CATALOGUE = LOCALE_FOLDER / "zh_CN" / "LC_MESSAGES" / "benchdragon.po"
ROW = re.compile(r"^\| (?!---)(.+?) \| (.+?) \| (.+?) \|(.*)\|$", re.MULTILINE)
HEADS = {"term", "术语"}
MOST_TERMS = 80

# What is a name and no word: places for values, keys, files, options, tables, families of turns, plans
# that are built in and command lines.
NAMES = re.compile(
    r"\{.*?\}|%\(\w+\)\w"
    r"|\b[A-Za-z_*]+(?:\.[A-Za-z_{]+\}?)+(?: = \"[\w-]+\")?"
    r"|\bKEY=|--[\w-]+|\[+[\w.]+\]+|\barc(?:-arc|-line)+\b"
    r"|\b(?:coil-in|coil-out|figure-eight|three-plum-blossoms|double-door|straight-dragon|tail-swing)\b"
    r"|\bspiral-in\b|\bbenchdragon [a-z]+ [a-z]+"
)
# Where an English word of the glossary is used in another sense, and why.
OTHER_SENSES = {
    r"turns of the spiral|turns of both spirals": "once around a spiral: 圈",
    r"turns at the start|turns from the centre|\{turns\} turns": "once around a spiral: 圈",
    r"\bin this link\b|\bThe link says\b|\blinks lead\b|\bfor links in\b": "of a page, or of a folder",
    r"\bcode of the link\b|\bThis link\b|\bno link leads\b|\bpaste its link\b": "of a page",
    r"\bclosed by its bracket\b": "a sign of TOML",
    r"\btolerance must lie\b": "the name of an argument",
    r"\bbenches must be a list of Bench\b|\ba Line, Arc, Spiral, Clothoid or \w+": "classes",
    r"^turn left$|^turn right$": "what a bearer does: 拐",
    r"\bit sweeps\b|\bBoth sweep\b|\bmay sweep\b": "an angle that is turned through",
    r"\barc length\b": "length of any curve: 弧长",
    r"\b[Cc]halk plan": "a drawing of the ground: 放样图",
    r"^\{where\} is not a known key$": "to who writes the plan it is a name: 名字",
    r"^send this dance$": "the label of a button: 发给大家 says what is sent by where it stands",
    r"^spiral pitch$": "the label of a slider: 螺距 alone says it",
}
# Chinese terms that say one thing: they appear only beside their English term, or a form of it.
EXACT = {
    "clearance": "clearance",
    "signed gap": "signed gap",
    "pin play": "pin play",
    "margin": "margin",
    "tolerance": "tolerance",
    "evaluation": "evaluat",
}
RETIRED_ENGLISH = {
    "walkable": "safe",
    "looks?": "evaluations",
    "placings?": "evaluations",
    "places": "positions",
    "neighbours": "non-adjacent benches",
    "trodden": "the route that is walked",
    "slips?": "deviations",
    "road": "method",
    "gap (?!is)": "clearance, or signed gap",
    "way inside": "path inside",
    "least distance(?! from)": "least clearance",
    r"clear(?! away)": "free of contact",
}
# What docstrings and comments do not say, and what they say in its place.
RETIRED_IN_SOURCES = {
    "how (?:that|it|the search) ended": "exit status",
    "here and there": "sampled",
    "(?:is|are|be|was|were) told": "is called with, reported, listed or given",
    "wants?|wanted": "needs, requires, expected",
    "what stands": "obstacles, or what it is",
    "looks? at|looked at|a look|looks between": "samples, evaluates or searches",
    "looked for": "searched, sought",
    "c[oa]mes? about": "occurs, arises, is derived",
    "comes? out(?! again)|came out": "result, answer",
    "slips? of the pen": "input error",
    "for what (?:is|are) no(?:ne)?": "if it is not, for an invalid",
    "leaves? open|left open": "undecided",
    "nobody|somebody|everybody|whoever": "who it is: no reader, another process, the user",
    "but for": "except, up to",
    "goes by|gone by|to and fro|far out": "uses, alternating, far from the origin",
    "likewise|hence|shall|anew": "the same, so that, must, again",
    "at the door": "on input",
    "trodden": "walked",
    "strewn|frayed": "sampled; cut into pieces",
    r"what [\w' ]{1,40} (?:is|are) called": "name, title, label",
    "what (?:people|dancers) call": "name, title",
    "how far off": "error, tolerance",
    "what is said|what was (?:said|shown)": "text, note, error; proved claim",
}
RETIRED_CHINESE = {
    "间隙": "间距、分离量或销孔游隙",
    "可行": "安全",
    "畅通": "无碰撞",
    "区间算术": "球算术",
    "封闭公式": "闭式解",
    "解析解": "闭式解",
    "解析式": "闭式解",
    "转动速度": "角速度",
    "播放页": "播放器",
    "影片": "视频",
    "回旋线": "缓和曲线",
    "未判定": "未能判定",
    "总加速度": "合加速度",
    "行走": "行进",
    "假定": "假设",
}


def rows(language: str) -> list[tuple[str, str]]:
    """The first two columns of all tables of a language's glossary."""
    text = (ROOT / "docs" / language / "glossary.md").read_text("utf-8")
    return [(row[0], row[1]) for row in ROW.findall(text) if row[0] not in HEADS]


TERMS = dict(rows("en"))


def plural(term: str) -> str:
    """A pattern of a term as whole words, in the singular and in the plural."""
    stem = re.escape(term)
    if term.endswith("y") and term[-2] not in "aeiou":
        stem = f"{stem[:-1]}(?:y|ies)"
    else:
        stem += "(?:es)?" if re.search(r"(?:ch|sh|s|x)$", term) else "s?"
    return rf"\b{stem}\b"


def messages() -> Iterator[tuple[str, str]]:
    """Each English text of the program with its Chinese one."""
    with CATALOGUE.open("rb") as source:
        known: Catalog = read_po(source, locale="zh_CN")
    for message in known:
        forms = [message.id] if isinstance(message.id, str) else message.id
        for form in forms:
            if form:
                yield form, str(message.string)


def terms_in(english: str) -> list[str]:
    """The terms that a text uses, longest first; what a longer one takes up counts for it alone."""
    rest = re.sub("|".join(OTHER_SENSES), " ", english)
    rest = NAMES.sub(" ", rest)
    found = []
    for term in sorted(TERMS, key=len, reverse=True):
        rest, count = re.subn(plural(term), "\0", rest, flags=re.IGNORECASE)
        if count:
            found.append(term)
    return found


def faults(english: str, chinese: str) -> list[str]:
    """The terms of an English text whose Chinese the translation does not use."""
    return [
        term
        for term in terms_in(english)
        if not any(word in chinese for word in TERMS[term].split(" / "))
    ]


def test_both_languages_list_the_same_terms_in_the_same_order() -> None:
    english, chinese = rows("en"), rows("zh")
    assert english == [(term, word) for word, term in chinese]
    assert len(TERMS) == len(english)
    assert 35 <= len(TERMS) <= MOST_TERMS


def test_no_two_terms_share_their_chinese_word() -> None:
    words = [word for cell in TERMS.values() for word in cell.split(" / ")]
    assert sorted(words) == sorted(set(words))


def test_each_translation_uses_the_words_of_the_glossary() -> None:
    wrong = {english: found for english, chinese in messages() if (found := faults(english, chinese))}
    assert wrong == {}


@pytest.mark.parametrize("term", EXACT)
def test_a_chinese_term_with_one_meaning_stands_for_nothing_else(term: str) -> None:
    wrong = [
        (english, chinese)
        for english, chinese in messages()
        if TERMS[term] in chinese and EXACT[term] not in english.lower()
    ]
    assert wrong == []


@pytest.mark.parametrize("pattern", OTHER_SENSES)
def test_each_other_sense_still_occurs(pattern: str) -> None:
    for part in pattern.split("|"):
        assert any(re.search(part, english) for english, _chinese in messages()), part


@pytest.mark.parametrize("word", RETIRED_ENGLISH)
def test_no_message_uses_a_retired_english_word(word: str) -> None:
    used = [text for text, _ in messages() if re.search(rf"\b{word}\b", NAMES.sub(" ", text), re.I)]
    assert used == [], f"say {RETIRED_ENGLISH[word]}"


@pytest.mark.parametrize("word", RETIRED_CHINESE)
def test_no_translation_uses_a_retired_chinese_word(word: str) -> None:
    used = [text for _, text in messages() if word in text]
    assert used == [], f"say {RETIRED_CHINESE[word]}"


def pages(language: str) -> Iterator[tuple[str, str]]:
    """The prose of the manual and of the readme, without code."""
    readme = ROOT / {"en": "README.md", "zh": "README.zh-CN.md"}[language]
    for path in (readme, *sorted((ROOT / "docs" / language).glob("*.md"))):
        text = re.sub(
            r"^(`{3,}).*?^\1$|^\(.*\)=$", "", path.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE
        )
        yield path.name, re.sub(r"`[^`\n]*`", "", text)


@pytest.mark.parametrize("word", RETIRED_CHINESE)
def test_no_chinese_page_uses_a_retired_word(word: str) -> None:
    used = [name for name, text in pages("zh") if word in text]
    assert used == [], f"say {RETIRED_CHINESE[word]}"


@pytest.mark.parametrize(
    "word", ["walkable", "looks", "a look", "placings?", "but neighbours", "roads?"]
)
def test_no_english_page_uses_a_retired_word(word: str) -> None:
    used = [name for name, text in pages("en") if re.search(rf"\b{word}\b", text, re.I)]
    assert used == [], word


def prose(source: str) -> Iterator[str]:
    """Docstrings of a module, without names of arguments and code, and its comments."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            text = re.sub(r"^ +\w+: |`[^`]*`", " ", ast.get_docstring(node) or "", flags=re.MULTILINE)
            yield " ".join(text.split())
    found = [
        (token.start[0], token.string.strip("#: "))
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type == tokenize.COMMENT
    ]
    for _key, lines in groupby(enumerate(found), key=lambda one: one[1][0] - one[0]):
        yield " ".join(text for _index, (_row, text) in lines)


@cache
def sources() -> list[tuple[str, str]]:
    """Each docstring and comment of the package, with the file that it is in."""
    folder = ROOT / "src" / "benchdragon"
    return [
        (path.relative_to(folder).as_posix(), text)
        for path in sorted(folder.rglob("*.py"))
        for text in prose(path.read_text("utf-8"))
    ]


@pytest.mark.parametrize("word", RETIRED_IN_SOURCES)
def test_no_docstring_or_comment_uses_a_retired_word(word: str) -> None:
    used = [(name, text) for name, text in sources() if re.search(rf"\b(?:{word})\b", text, re.I)]
    assert used == [], f"say {RETIRED_IN_SOURCES[word]}"


def test_prose_is_docstrings_and_comments_and_no_code() -> None:
    source = (
        '"""Wanted: a name.\n\n    Args:\n        wanted: what `whoever` gives.\n"""\n'
        '# One\n# two.\n\nhence = "told"  # Three.\n'
    )
    assert list(prose(source)) == ["Wanted: a name. Args: what gives.", "One two.", "Three."]


def test_a_translation_that_leaves_its_term_is_seen() -> None:
    english = "least clearance of the head's benches, and how many evaluations it took"
    good = "龙头各节板凳的最小间距，以及求值次数"
    assert terms_in(english) == ["least clearance", "evaluation", "bench", "head"]
    assert faults(english, good) == []
    assert faults(english, good.replace("最小间距", "最小距离")) == ["least clearance"]
    assert faults(english, good.replace("龙头", "领头")) == ["head"]
