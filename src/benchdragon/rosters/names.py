"""Recognition of Chinese names: family names, and placeholders for a missing name."""

import re

# Family names of two signs, after which one sign or two are the given name.
TWO_SIGNS_SPELT = (
    "欧阳司马上官诸葛东方皇甫尉迟公孙慕容令狐夏侯司徒司空端木南宫长孙宇文轩辕百里独孤申屠呼延闻人歐陽"
    "諸葛東方公孫長孫軒轅獨孤聞人"
)
TWO_SIGNS = frozenset(re.findall("..", TWO_SIGNS_SPELT))
# The usual ones of one sign, in simplified and traditional signs, except those that begin many words.
ONE_SIGN = frozenset(
    "赵钱孙李周吴郑王冯陈褚卫蒋沈韩杨朱秦尤许何吕施张孔曹严华金魏陶姜戚谢邹喻柏窦章苏潘葛奚范彭郎鲁韦"
    "昌马苗凤方俞任袁柳鲍史唐费廉岑薛雷贺倪汤滕殷罗毕郝邬安常于傅卞齐康伍余元卜顾孟黄穆萧尹姚邵湛汪祁"
    "毛狄臧计成戴谈宋庞熊纪舒屈项祝董梁杜阮蓝闵席季麻贾路娄江童颜郭梅盛林刁钟徐邱骆高夏蔡田樊胡凌霍虞"
    "万支柯昝管卢莫房裘缪干应宗丁宣邓郁单杭洪包诸左石崔吉龚程嵇邢裴陆荣翁荀惠甄曲封储靳段巫焦巴牧车侯"
    "班仇甘厉祖武符刘景詹龙叶幸司韶黎薄白怀蒲卓蔺屠池乔胥闻莘党翟谭贡姬申扶冉宰郦桑桂濮牛寿边燕浦尚温"
    "庄晏柴瞿阎充慕连茹习艾鱼容易慎戈廖耿匡文寇欧殳沃隆巩聂晁敖冷辛阚那简饶曾沙鞠巢关蒯荆游竺楼肖斯佘"
    "付覃邝佟代闫苟衣苑阳鄢粟区黃趙錢孫鄭馮陳衛蔣韓楊許呂張嚴華謝鄒竇蘇範魯韋馬鳳賀湯羅畢鄔齊顧蕭談龐"
    "紀項藍閔賈婁顏鐘鍾駱萬盧繆鄧單諸龔榮陸儲車厲劉龍葉喬聞黨譚貢酈邊溫莊閻連習魚歐聶饒關遊樓吳"
)
# Signs of a Chinese name, at most, and of several that are joined; what joins two of them.
MOST_SIGNS, MOST_JOINED = 4, 200
JOINERS = re.compile(r"以及|[和与與及跟同并\-—–~]")
LATIN = re.compile("[A-Z][a-z]+(?: [A-Z][a-z]+){1,2}")
CHINESE = re.compile("[\u3400-\u4dbf\u4e00-\u9fff\U00020000-\U0003ffff]+")

# Placeholders for a missing name, normalised as for `stands_in`.
WORDS = """
    本人 自己 户主 户主本人 本户 本家 家人 家属 全家 同户 同户主 替补 候补 备用 后备 预备 机动 轮换 轮流
    换班 换人 待补 待通知 待安排 待确认 未知 不详 不清楚 不知道 保密 另定 另行通知 抽签 外请 请人 雇人
    有人 没人 缺人 空位 测试 某人 无名 姓名 名字 unknown someone somebody reserve substitute relief
    亲戚 朋友 亲友 邻居 民工 小工 工人 学生 年轻人 小伙子 村干部 儿子 侄子 女婿 外甥 弟弟 哥哥 兄弟 父亲
    今天 明天 后天 今晚 明晚 若干 若干人 多人 几人 数人
"""
STANDING_IN = frozenset(WORDS.split())
# 某某, 张某, XXX, 李×, ***.
BLANKS = re.compile(
    "[\u4e00-\u9fff]{0,2}(?:某+人?|[x×*○□■_]+)"
    "|(?:人员?|名单)?[待未暂](?:定|补|缺|安排|通知|确认|落实)(?:中|者|人员?)?"
)
NUMERAL = "[0-9〇零一二两三四五六七八九十百千廿卅]"
HOUR = "(?:[早晚]上?|上午|中午|下午|夜里?|凌晨|早晨)?"
DAYS = re.compile(
    rf"(?:农历|阴历|公历|阳历|旧历|今年|明年|{NUMERAL}{{2,4}}年)?"
    rf"(?:(?:[正冬腊闰]|{NUMERAL}{{1,3}})月)?(?:初?{NUMERAL}{{1,9}}[日号]?)?{HOUR}"
    rf"|(?:大?年)?(?:初{NUMERAL}{{1,3}}|三十){HOUR}|[正七]月半{HOUR}|(?:空?缺)?{NUMERAL}{{1,4}}个?人"
    rf"|(?:除夕|春节|元旦|元宵节?|上元节?|清明|端午|中秋|重阳|冬至|正月|腊月|星期[一二三四五六日天]){HOUR}夜?"
)
# Signs that repeat the cell above, or at the left.
DITTO = "同上 同前 上同 仝 仝上 〃 \" '' ” “ ′′ 々 ditto do. do same sameasabove"
ABOVE = frozenset(DITTO.split())
LEFT = frozenset(["同左"])


def stands_in(word: str) -> bool:
    """Whether a word (plain, in simplified signs) is a placeholder for a name."""
    return (
        word in STANDING_IN or word in ABOVE or word in LEFT
        or any(pattern.fullmatch(word) for pattern in (BLANKS, DAYS))
    )  # fmt: skip


def like_person(name: str) -> bool:
    """Whether it looks like the name of one person: a family name, and one given sign or two more."""
    if not CHINESE.fullmatch(name) or len(name) > MOST_SIGNS:
        return False
    return len(name) > 2 if name[:2] in TWO_SIGNS else len(name) in (2, 3) and name[0] in ONE_SIGN


def like_people(name: str) -> bool:
    """Whether it looks like a name in any script: two or three words in Latin letters, too."""
    return like_person(name) or LATIN.fullmatch(name) is not None


def like_two(name: str) -> bool:
    """Whether two names may stand in it with nothing between them: 张三李四."""
    both = any(like_person(name[:n]) and like_person(name[n:]) for n in (2, 3))
    return both and not like_person(name)


def parted(name: str) -> list[str]:
    """The names of people that a word between them joins, 张三和李四; else the text alone."""
    for found in JOINERS.finditer(name) if len(name) <= MOST_JOINED else ():
        head, rest = name[: found.start()].strip(), name[found.end() :].strip()
        if like_person(head) and all(map(like_person, others := parted(rest))):
            return [head, *others]
    return [name]
