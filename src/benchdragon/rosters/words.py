"""Parsing of a list's cells: numbers of benches, names, phones, headings."""

import re
import unicodedata
from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal

from benchdragon.rosters.names import TWO_SIGNS, parted, stands_in

Kind = Literal["number", "name", "household", "phone", "remarks"]

# Headings of columns, in lower case, without spaces and in simplified signs; of two columns of numbers
# the one holds whose heading stands first here.
SPELLINGS: dict[Kind, str] = {
    "number": """
        板凳号 板凳编号 凳号 桥号 节号 第几桥 第几节 桥次 节次 板号 龙身号 桥 节 板凳 凳 号 bench
        benchno benchnumber qiao jie section number no nr # 编号 号码 序号 桥编号 凳编号 桥序 凳序
        桥位 凳位 灯号 灯编号 灯序 灯次 灯位 板次 板序 第几凳 第几板 第几灯
    """,
    "name": """
        姓名 名字 名单 人名 人员 队员 成员 人员姓名 队员姓名 抬龙人 扛龙人 舞龙人 迎龙人 抬凳人 扛凳人
        参加人 参与人 name names fullname bearer bearers person people carrier carriers carriedby
        抬手 抬工 抬夫 抬者 抬人 抬的人 扛的人 谁抬 扛手 扛夫 后生 relief reliefs reserve reserves
        substitute substitutes
    """,
    "household": """
        户 户主 户名 户主姓名 家庭 家庭户 人家 household householder family house home 户长
        桥主 凳主 灯主
    """,
    "phone": """
        电话 手机 联系电话 联系方式 手机号 手机号码 电话号码 联系手机 phone phonenumber phoneno mobile
        mobilephone tel telephone cell contact
    """,
    "remarks": "备注 说明 附注 注 其他 remarks remark notes note comments comment",
}
# Headings of other columns, which are ignored: those of no bearers.
OTHER_HEADINGS = """
    性别 男女 年龄 岁数 生日 出生日期 村 村名 自然村 村组 村民小组 组 小组 组别 班 班组 班次 队 队别
    生产队 地址 住址 家庭住址 门牌 门牌号 职务 岗位 分工 身份证 身份证号 证件号 单位 日期 时间 颜色 签名
    签字 签到 衣服 服装 尺码 身高 体重 微信 微信号 联系人 紧急联系人 登记人 填表人 经办人 金额 捐款 人数
    age sex gender village address group team role shift date time size wechat signature
"""
OTHERS = frozenset(OTHER_HEADINGS.split())
# Words for bearers and their substitutes in each village.
CARRY = "[抬扛掌舞迎擎举执挑背驮托拿提撑]"
THINGS = "(?:板凳龙|板凳|龙灯|灯笼|花灯|龙|灯|桥|凳|板|节|杠)"
TURNS = (
    "(?:换班|换手|换肩|换抬|换桥|换灯|替换|替班|替补|替手|轮换|轮班|接班|接替|接手|候补|后备|备用|预备)"
)
WHO = "(?:人员|队员|人|手|者|员|夫|名单|姓名)"
EACH = f"(?:{CARRY}{THINGS}的?{WHO}?(?:姓名)?|{THINGS}(?:手|丁|夫)|{TURNS}抬?的?{WHO}?(?:姓名)?)"
BEARERS = re.compile(f"{EACH}(?:[和及与或、,&+]*{EACH})*")
PHONE_HEADING = re.compile(
    "(.*?)的?(?:联系)?(?:电话号码|电话|手机号码|手机号|手机|联系方式|phone|mobile|tel)"
)
# Traditional signs of headings and numbers.
SIMPLE = str.maketrans(
    "板橋號節龍燈戶電話機聯繫係備註說員隊與參編碼單換輪後補預時間齡職務組證"
    "點總計數塊條張兩貳陸頭東館區櫈無沒農曆陽舊陰",
    "板桥号节龙灯户电话机联系系备注说员队与参编码单换轮后补预时间龄职务组证"
    "点总计数块条张两贰陆头东馆区凳无没农历阳旧阴",
)
HEADINGS = {kind: tuple(words.split()) for kind, words in SPELLINGS.items()}
SUMS = re.compile(
    r"(合计|总计|共计|小计|总数|总人数|合共|(total|sum|subtotal)(?![a-z])|共.{0,4}[0-9]+.{0,3}$)"
)
NO_NAMES = "无 空 空缺 缺 暂缺 暂无 待定 未定 没有 tbd n/a na none nobody ? ?? - -- — —— /"
# Cells whose formula failed.
ERRORS = "#n/a #ref! #name? #value! #div/0! #num! #null! #getting_data #spill! #calc! err:502 err:508"
NOBODY = frozenset([*NO_NAMES.split(), *ERRORS.split()])
HEADS, TAILS = ("龙头", "龙首", "头", "head", "thehead"), ("龙尾", "尾", "尾巴", "tail", "thetail")
DIGITS = {sign: n for n, sign in enumerate("零一二三四五六七八九")} | {
    sign: n for n, sign in enumerate("〇壹贰叁肆伍陆柒捌玖")
} | {"两": 2}  # fmt: skip
TENS = {"十": 10, "百": 100, "千": 1000, "拾": 10, "佰": 100, "仟": 1000}
NUMERALS = "".join([*DIGITS, *TENS, "廿卅"])
# Positions of people at a bench, which its number may include.
SIDES = "(?:[左右前后中上下甲乙丙丁]|[abcd](?![a-z]))[边面侧手杠端]?"
ITEM = re.compile(
    r"[左右前后]?(?:第|bench|benches|qiao|jie|section|number|no[.:]?|nr[.:]?|#|板凳|桥|节|凳|板|灯|编?号)*"
    rf"([0-9]{{1,9}}(?:\.0+)?|[{NUMERALS}]{{1,9}})[号#]{{0,2}}(?:板凳|桥|节|凳|块|条|张|板|灯)?[号#]{{0,2}}"
    rf"(?:\(?(?:{SIDES})+|(?<=[号桥节凳块条张板灯])第?[{NUMERALS}0-9]{{1,2}}号?[位人])?"
)
SIDE_APART = re.compile(rf"(?<=[0-9号#桥节凳板灯])\s*-?\s*(?={SIDES}\)?(?:\s|$|[、,;/&+]))")
# 一百二 may be 102 or 120.
SHORTENED = re.compile("[百千佰仟][一二三四五六七八九]$")
DASH, TO = re.compile(r"\s*[-–—‒−]+\s*"), re.compile(r"\s*(?:~+|至|到|to)\s*")
AND = re.compile(r"[、,;/&+\s]|和|及|与|and")
SLASH = re.compile(r"([0-9]{1,9})\s*/\s*([0-9]{1,9})")
# A list that names so many places at a bench says bench 4, place 1 by 4-1.
MOST_PLACES = 4
PHONE = re.compile(
    r"(?<![0-9])(?:(?:\+?86[- ]?)?1[0-9]{2}[- ]?[0-9]{4}[- ]?[0-9]{4}"
    r"|0[0-9]{2,3}[- ]?[0-9]{7,8}|\+?[0-9](?:[-() ]{0,2}[0-9]){6,14})(?![0-9])"
)
PARTS = re.compile(r"[、，,;；。/／|\\\n\r\t+＋&＆]+")
# Words that join names where spaces part them.
BETWEEN = re.compile(r"(?<=\S)\s+(?:以及|和|与|與|及|跟|同|并|and)\s+(?=\S)", re.IGNORECASE)
ORDINAL = re.compile(r"(?<![0-9])[0-9]{1,3}[)）.、:：]\s*(?=[^0-9\s])")
MADE_A_DAY = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}|[0-9]{1,2}月[0-9]{1,2}日")
ROUNDED = re.compile(r"[0-9.]+e\+[0-9]+", re.IGNORECASE)
# What tables of text add to a phone that was a number.
DECIMALS = re.compile(r"(?<=[0-9])\.0+$")
# Unicode's "CJK ..." characters, radicals and strokes, and punctuation between and around them.
CHINESE = re.compile(
    "[\u2e80-\u2e99\u2e9b-\u2ef3\u31c0-\u31e3\u3400-\u4dbf\u4e00-\u9fff\uf900-\ufa6d\ufa70-\ufad9"
    "\U00020000-\U0003ffff·（）()]+"
)
# Signs of a name, and rows above the headings of a list.
MOST_NAME, MOST_TITLES = 60, 30


@dataclass(frozen=True)
class Place:
    """A bench as a list names it: its number, the head or the tail."""

    number: int = 0
    end: Literal["", "head", "tail"] = ""


def plain(text: str) -> str:
    """`text` in half-width signs and lower case, without spaces."""
    return re.sub(r"\s+", "", unicodedata.normalize("NFKC", text)).lower()


def simple(text: str) -> str:
    """`text` plainly and in simplified signs: as headings and numbers are compared."""
    return plain(text).translate(SIMPLE)


def clean(text: str) -> str:
    """`text` on one line, without signs that show nothing."""
    seen = "".join(
        sign for sign in unicodedata.normalize("NFC", text)
        if sign.isspace() or unicodedata.category(sign) not in ("Cc", "Cf", "Cs")
    )  # fmt: skip
    return " ".join(seen.split())


def heading(text: str) -> tuple[Kind, int] | None:
    """What a column of this heading holds, and its rank among those that hold the same."""
    whole = simple(text)
    word = re.sub(r"\(.*?\)|\[.*?\]|[:.。_*'\"/-]", "", whole) or whole
    short = re.sub(r"(?<=.)[0-9一二三四五六甲乙丙丁左右前后]$", "", word)
    for kind, words in HEADINGS.items():
        for each in (word, short):
            if each in words:
                return kind, words.index(each)
    if any(BEARERS.fullmatch(each) for each in (word, short)):
        return "name", len(HEADINGS["name"])
    phone = PHONE_HEADING.fullmatch(short)
    whose = heading(phone[1]) if phone and phone[1] else None
    return ("phone", len(HEADINGS["phone"])) if whose and whose[0] in ("name", "household") else None


def is_other(text: str) -> bool:
    """Whether a heading is known to be of neither people nor benches."""
    return re.sub(r"\(.*?\)|[:：]", "", simple(text)) in OTHERS


def places(text: str, halved: Collection[int] = ()) -> list[tuple[Place, Place]] | None:
    """The benches of a cell, as ranges of which both ends count; None where it is no number.

    4-1 is a place at bench 4, as is each a-b of a bench a that is `halved`: see `with_places`.
    """
    found = _ranges(text, halved)
    if found is None:
        return None
    return [(low, low if dash and _is_place(low, high, halved) else high) for dash, low, high in found]


def with_places(text: str) -> set[int]:
    """The benches whose first place a cell names: 4 of 4-1."""
    found = [(low, high) for dash, low, high in _ranges(text) or () if dash]
    return {low.number for low, high in found if low.number and high == Place(1)}


def doubtful(text: str, halved: Collection[int]) -> bool:
    """Whether a cell may name benches or a place: 1-2, where other benches are halved, and 1 is not."""
    dashed = SLASH.sub(r"\1-\2", unicodedata.normalize("NFKC", text))
    found = [(low, high) for dash, low, high in _ranges(dashed) or () if dash and halved]
    return any(
        not (low.end or high.end or low.number in halved) and low.number < high.number <= MOST_PLACES
        for low, high in found
    )


def _is_place(low: Place, high: Place, halved: Collection[int]) -> bool:
    if low.end or high.end or not high.number:
        return False
    return low.number in halved or high.number <= min(low.number - 1, MOST_PLACES)


def without_dashes(text: str) -> str:
    """A cell of a number with 至 in place of dashes."""
    return DASH.sub("至", text.replace("/", "-"))


def _ranges(text: str, halved: Collection[int] = ()) -> list[tuple[bool, Place, Place]] | None:
    """The ranges of a cell, and whether a dash, or the stroke of 4/1, stands between their ends."""
    whole = unicodedata.normalize("NFKC", text).strip().lower().translate(SIMPLE)
    slash = SLASH.fullmatch(whole)
    if slash and (int(slash[1]) in halved or int(slash[2]) <= int(slash[1])):
        whole = f"{slash[1]}-{slash[2]}"
    joined = TO.sub("~", DASH.sub("-", SIDE_APART.sub("", whole)))
    found = []
    for part in filter(None, AND.split(joined)):
        said = re.split("[-~]", part)
        ends = [place for end in said if (place := _place(end)) is not None]
        if len(ends) != len(said) or len(ends) > 2:
            return _with_spaces(whole)
        found.append(("-" in part, ends[0], ends[-1]))
    return found or None


def _with_spaces(whole: str) -> list[tuple[bool, Place, Place]] | None:
    """A number whose words are apart: "bench 37", "第 37 桥"."""
    joined = "".join(whole.split())
    return _ranges(joined) if joined != whole else None


def _place(text: str) -> Place | None:
    word = text.strip("()[].:")
    if word in HEADS or word in TAILS:
        return Place(end="head" if word in HEADS else "tail")
    match = ITEM.fullmatch(word)
    number = None if match is None else numeral(match[1])
    return None if number is None else Place(number)


def numeral(text: str) -> int | None:
    """A number in digits, or as Chinese write it: 三十七, 一百零五, 一二〇."""
    if text[0] in "0123456789":
        return int(float(text))
    if all(sign in DIGITS for sign in text):
        return int("".join(str(DIGITS[sign]) for sign in text))
    if not all(sign in DIGITS or sign in TENS or sign in "廿卅" for sign in text):
        return None
    if SHORTENED.search(text):
        return None
    total, digit = 0, None
    for sign in text.replace("廿", "二十").replace("卅", "三十"):
        if sign in DIGITS:
            digit = DIGITS[sign]
        else:
            total, digit = total + (1 if digit is None else digit) * TENS[sign], None
    return total + (digit or 0)


def is_sum(text: str) -> bool:
    """Whether a cell begins what was added up."""
    return SUMS.match(simple(text)) is not None


def names_of(text: str) -> tuple[str, ...]:
    """The names of a cell. Spaces part Chinese names, but not the signs of one ("张　三")."""
    if simple(text) in NOBODY:
        return ()
    found = []
    for part in PARTS.split(BETWEEN.sub("、", ORDINAL.sub("、", text))):
        words = part.split()
        if words and all(_chinese(word) for word in words):
            found += [name for word in _joined(words) for name in parted(word)]
        else:
            found += parted(" ".join(words))
    names = [clean(name) for name in found]
    return tuple(name for name in names if name and simple(name) not in NOBODY)


def is_name(text: str) -> bool:
    """Whether it may be a person's name."""
    return (
        len(text) <= MOST_NAME and any(sign.isalpha() for sign in text) and not stands_in(simple(text))
    )


def without_phones(text: str) -> tuple[str, tuple[str, ...]]:
    """A text without the phone numbers in it, and these."""
    half = unicodedata.normalize("NFKC", text)
    found = tuple(match[0] for match in PHONE.finditer(half))
    return (re.sub(r"\([电话:]*\s*\)", "", PHONE.sub(" ", half)).strip(" :") if found else text), found


def _chinese(word: str) -> bool:
    return CHINESE.fullmatch(word) is not None


def _joined(words: list[str]) -> list[str]:
    """Names among words: two signs that stand alone are one name, and one after a family's two."""
    found: list[str] = []
    alone = False
    for word in words:
        if alone and len(word) == 1:
            found[-1] += word
            alone = False
        else:
            found.append(word)
            alone = len(word) == 1 or word in TWO_SIGNS
    return found
