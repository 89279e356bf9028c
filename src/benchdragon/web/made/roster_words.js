// @ts-nocheck
// Made from rosters/words.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { TWO_SIGNS, parted, standsIn } from "./roster_names.js";
const PATTERN_1 = py.pattern("[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]+", "");
const PATTERN_2 = py.pattern("\\([^\\n]*?\\)|\\[[^\\n]*?\\]|[:.。_*'\"/-]", "");
const PATTERN_3 = py.pattern("(?<=[^\\n])[0-9一二三四五六甲乙丙丁左右前后](?=\\n?(?![\\s\\S]))", "");
const PATTERN_4 = py.pattern("[-~]", "");
const PATTERN_5 = py.pattern("\\([^\\n]*?\\)|[:：]", "");
const PATTERN_6 = py.pattern("\\([电话:]*[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*\\)", "");

const OTHERS = py.set_of(["address", "age", "date", "gender", "group", "role", "sex", "shift", "signature", "size", "team", "time", "village", "wechat", "人数", "住址", "体重", "出生日期", "分工", "单位", "地址", "填表人", "家庭住址", "小组", "尺码", "岁数", "岗位", "年龄", "微信", "微信号", "性别", "捐款", "日期", "时间", "服装", "村", "村名", "村民小组", "村组", "班", "班次", "班组", "生产队", "生日", "男女", "登记人", "签到", "签名", "签字", "紧急联系人", "组", "组别", "经办人", "职务", "联系人", "自然村", "衣服", "证件号", "身份证", "身份证号", "身高", "金额", "门牌", "门牌号", "队", "队别", "颜色"]);
const BEARERS = py.pattern("(?:[抬扛掌舞迎擎举执挑背驮托拿提撑](?:板凳龙|板凳|龙灯|灯笼|花灯|龙|灯|桥|凳|板|节|杠)的?(?:人员|队员|人|手|者|员|夫|名单|姓名)?(?:姓名)?|(?:板凳龙|板凳|龙灯|灯笼|花灯|龙|灯|桥|凳|板|节|杠)(?:手|丁|夫)|(?:换班|换手|换肩|换抬|换桥|换灯|替换|替班|替补|替手|轮换|轮班|接班|接替|接手|候补|后备|备用|预备)抬?的?(?:人员|队员|人|手|者|员|夫|名单|姓名)?(?:姓名)?)(?:[和及与或、,&+]*(?:[抬扛掌舞迎擎举执挑背驮托拿提撑](?:板凳龙|板凳|龙灯|灯笼|花灯|龙|灯|桥|凳|板|节|杠)的?(?:人员|队员|人|手|者|员|夫|名单|姓名)?(?:姓名)?|(?:板凳龙|板凳|龙灯|灯笼|花灯|龙|灯|桥|凳|板|节|杠)(?:手|丁|夫)|(?:换班|换手|换肩|换抬|换桥|换灯|替换|替班|替补|替手|轮换|轮班|接班|接替|接手|候补|后备|备用|预备)抬?的?(?:人员|队员|人|手|者|员|夫|名单|姓名)?(?:姓名)?))*", "");
const PHONE_HEADING = py.pattern("([^\\n]*?)的?(?:联系)?(?:电话号码|电话|手机号码|手机号|手机|联系方式|phone|mobile|tel)", "");
const SIMPLE = py.dict([[26495, 26495], [27211, 26725], [34399, 21495], [31680, 33410], [40845, 40857], [29128, 28783], [25142, 25143], [38651, 30005], [35441, 35805], [27231, 26426], [32879, 32852], [32363, 31995], [20418, 31995], [20633, 22791], [35387, 27880], [35498, 35828], [21729, 21592], [38538, 38431], [33287, 19982], [21443, 21442], [32232, 32534], [30908, 30721], [21934, 21333], [25563, 25442], [36650, 36718], [24460, 21518], [35036, 34917], [38928, 39044], [26178, 26102], [38291, 38388], [40801, 40836], [32887, 32844], [21209, 21153], [32068, 32452], [35657, 35777], [40670, 28857], [32317, 24635], [35336, 35745], [25976, 25968], [22602, 22359], [26781, 26465], [24373, 24352], [20841, 20004], [36019, 36144], [38520, 38470], [38957, 22836], [26481, 19996], [39208, 39302], [21312, 21306], [27336, 20979], [28961, 26080], [27794, 27809], [36786, 20892], [26310, 21382], [38525, 38451], [33290, 26087], [38512, 38452]]);
const HEADINGS = py.dict([["number", ["板凳号", "板凳编号", "凳号", "桥号", "节号", "第几桥", "第几节", "桥次", "节次", "板号", "龙身号", "桥", "节", "板凳", "凳", "号", "bench", "benchno", "benchnumber", "qiao", "jie", "section", "number", "no", "nr", "#", "编号", "号码", "序号", "桥编号", "凳编号", "桥序", "凳序", "桥位", "凳位", "灯号", "灯编号", "灯序", "灯次", "灯位", "板次", "板序", "第几凳", "第几板", "第几灯"]], ["name", ["姓名", "名字", "名单", "人名", "人员", "队员", "成员", "人员姓名", "队员姓名", "抬龙人", "扛龙人", "舞龙人", "迎龙人", "抬凳人", "扛凳人", "参加人", "参与人", "name", "names", "fullname", "bearer", "bearers", "person", "people", "carrier", "carriers", "carriedby", "抬手", "抬工", "抬夫", "抬者", "抬人", "抬的人", "扛的人", "谁抬", "扛手", "扛夫", "后生", "relief", "reliefs", "reserve", "reserves", "substitute", "substitutes"]], ["household", ["户", "户主", "户名", "户主姓名", "家庭", "家庭户", "人家", "household", "householder", "family", "house", "home", "户长", "桥主", "凳主", "灯主"]], ["phone", ["电话", "手机", "联系电话", "联系方式", "手机号", "手机号码", "电话号码", "联系手机", "phone", "phonenumber", "phoneno", "mobile", "mobilephone", "tel", "telephone", "cell", "contact"]], ["remarks", ["备注", "说明", "附注", "注", "其他", "remarks", "remark", "notes", "note", "comments", "comment"]]]);
const SUMS = py.pattern("(合计|总计|共计|小计|总数|总人数|合共|(total|sum|subtotal)(?![a-z])|共[^\\n]{0,4}[0-9]+[^\\n]{0,3}(?=\\n?(?![\\s\\S])))", "");
const NOBODY = py.set_of(["#calc!", "#div/0!", "#getting_data", "#n/a", "#name?", "#null!", "#num!", "#ref!", "#spill!", "#value!", "-", "--", "/", "?", "??", "err:502", "err:508", "n/a", "na", "nobody", "none", "tbd", "—", "——", "待定", "无", "暂无", "暂缺", "未定", "没有", "空", "空缺", "缺"]);
const HEADS = ["龙头", "龙首", "头", "head", "thehead"];
const TAILS = ["龙尾", "尾", "尾巴", "tail", "thetail"];
const DIGITS = py.dict([["零", 0], ["一", 1], ["二", 2], ["三", 3], ["四", 4], ["五", 5], ["六", 6], ["七", 7], ["八", 8], ["九", 9], ["〇", 0], ["壹", 1], ["贰", 2], ["叁", 3], ["肆", 4], ["伍", 5], ["陆", 6], ["柒", 7], ["捌", 8], ["玖", 9], ["两", 2]]);
const TENS = py.dict([["十", 10], ["百", 100], ["千", 1000], ["拾", 10], ["佰", 100], ["仟", 1000]]);
export const NUMERALS = "零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅";
const ITEM = py.pattern("[左右前后]?(?:第|bench|benches|qiao|jie|section|number|no[.:]?|nr[.:]?|#|板凳|桥|节|凳|板|灯|编?号)*([0-9]{1,9}(?:\\.0+)?|[零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅]{1,9})[号#]{0,2}(?:板凳|桥|节|凳|块|条|张|板|灯)?[号#]{0,2}(?:\\(?(?:(?:[左右前后中上下甲乙丙丁]|[abcd](?![a-z]))[边面侧手杠端]?)+|(?<=[号桥节凳块条张板灯])第?[零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅0-9]{1,2}号?[位人])?", "");
const SIDE_APART = py.pattern("(?<=[0-9号#桥节凳板灯])[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*-?[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*(?=(?:[左右前后中上下甲乙丙丁]|[abcd](?![a-z]))[边面侧手杠端]?\\)?(?:[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]|(?=\\n?(?![\\s\\S]))|[、,;/&+]))", "");
const SHORTENED = py.pattern("[百千佰仟][一二三四五六七八九](?=\\n?(?![\\s\\S]))", "");
const DASH = py.pattern("[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*[-–—‒−]+[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*", "");
const TO = py.pattern("[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*(?:~+|至|到|to)[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*", "");
const AND = py.pattern("[、,;/&+\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]|和|及|与|and", "");
const SLASH = py.pattern("([0-9]{1,9})[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*/[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*([0-9]{1,9})", "");
const MOST_PLACES = 4;
const PHONE = py.pattern("(?<![0-9])(?:(?:\\+?86[- ]?)?1[0-9]{2}[- ]?[0-9]{4}[- ]?[0-9]{4}|0[0-9]{2,3}[- ]?[0-9]{7,8}|\\+?[0-9](?:[-() ]{0,2}[0-9]){6,14})(?![0-9])", "");
const PARTS = py.pattern("[、，,;；。/／|\\\\\\n\\r\\t+＋&＆]+", "");
const BETWEEN = py.pattern("(?<=[^\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000])[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]+(?:以及|和|与|與|及|跟|同|并|and)[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]+(?=[^\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000])", "i");
const ORDINAL = py.pattern("(?<![0-9])[0-9]{1,3}[)）.、:：][\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]*(?=[^0-9\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000])", "");
export const MADE_A_DAY = py.pattern("[0-9]{4}-[0-9]{2}-[0-9]{2}|[0-9]{1,2}月[0-9]{1,2}日", "");
export const ROUNDED = py.pattern("[0-9.]+e\\+[0-9]+", "i");
export const DECIMALS = py.pattern("(?<=[0-9])\\.0+(?=\\n?(?![\\s\\S]))", "");
const CHINESE = py.pattern("[⺀-⺙⺛-⻳㇀-㇣㐀-䶿一-鿿豈-舘並-龎𠀀-𿿿·（）()]+", "");
const MOST_NAME = 60;
class Place {
  constructor(number = 0, end = "") {
    this.number = number;
    this.end = end;
  }
}
export function plain(text) {
  return py.lower(PATTERN_1.sub("", py.normalize("NFKC", text)));
}
export function simple(text) {
  return py.translate(plain(text), SIMPLE);
}
export function clean(text) {
  let seen;
  seen = py.join("", py.list(py.normalize("NFC", text)).flatMap((sign) => (((py.isspace(sign) || !py.has(["Cc", "Cf", "Cs"], py.category(sign)))) ? [sign] : [])));
  return py.join(" ", py.split(seen));
}
export function heading(text) {
  let each, kind, phone, short, whole, whose, word, words;
  whole = simple(text);
  word = py.or(PATTERN_2.sub("", whole), () => whole);
  short = PATTERN_3.sub("", word);
  for ([kind, words] of py.iter(py.items(HEADINGS))) {
    for (each of py.iter([word, short])) {
      if (py.has(words, each)) {
        return [kind, py.index(words, each)];
      }
    }
  }
  if (py.list([word, short]).some((each) => py.truth(BEARERS.fullmatch(each)))) {
    return ["name", py.len(py.at(HEADINGS, "name"))];
  }
  phone = PHONE_HEADING.fullmatch(short);
  whose = ((py.truth(phone) && py.truth(py.at(phone, 1))) ? heading(py.at(phone, 1)) : null);
  return ((py.truth(whose) && py.has(["name", "household"], py.at(whose, 0))) ? ["phone", py.len(py.at(HEADINGS, "phone"))] : null);
}
export function isOther(text) {
  return py.has(OTHERS, PATTERN_5.sub("", simple(text)));
}
export function places(text, halved = []) {
  let found;
  found = _ranges(text, halved);
  if ((found == null)) {
    return null;
  }
  return py.list(found).map(([dash, low, high]) => [low, ((py.truth(dash) && py.truth(_isPlace(low, high, halved))) ? low : high)]);
}
export function withPlaces(text) {
  let found;
  found = py.list(py.or(_ranges(text), () => [])).flatMap(([dash, low, high]) => ((py.truth(dash)) ? [[low, high]] : []));
  return py.set_of(py.list(found).flatMap(([low, high]) => (((py.truth(low.number) && py.eq(high, new Place(1)))) ? [low.number] : [])));
}
export function doubtful(text, halved) {
  let dashed, found;
  dashed = SLASH.sub("\\1-\\2", py.normalize("NFKC", text));
  found = py.list(py.or(_ranges(dashed), () => [])).flatMap(([dash, low, high]) => (((py.truth(dash) && py.truth(halved))) ? [[low, high]] : []));
  return py.list(found).some(([low, high]) => (!(py.truth(low.end) || py.truth(high.end) || py.has(halved, low.number)) && ((low.number < high.number) && (high.number <= MOST_PLACES))));
}
function _isPlace(low, high, halved) {
  if ((py.truth(low.end) || py.truth(high.end) || !py.truth(high.number))) {
    return false;
  }
  return (py.has(halved, low.number) || (high.number <= py.min((low.number - 1), MOST_PLACES)));
}
export function withoutDashes(text) {
  return DASH.sub("至", py.replace(text, "/", "-"));
}
function _ranges(text, halved = []) {
  let ends, found, joined, part, place, said, slash, whole;
  whole = py.translate(py.lower(py.strip(py.normalize("NFKC", text))), SIMPLE);
  slash = SLASH.fullmatch(whole);
  if ((py.truth(slash) && (py.has(halved, py.int(py.at(slash, 1))) || (py.int(py.at(slash, 2)) <= py.int(py.at(slash, 1)))))) {
    whole = `${py.str(py.at(slash, 1))}-${py.str(py.at(slash, 2))}`;
  }
  joined = TO.sub("~", DASH.sub("-", SIDE_APART.sub("", whole)));
  found = [];
  for (part of py.iter(py.list(py.split(AND, joined)).filter((one) => py.truth(one)))) {
    said = PATTERN_4.split(part);
    ends = py.list(said).flatMap((end) => ((((place = _place(end)) != null)) ? [place] : []));
    if ((!py.eq(py.len(ends), py.len(said)) || (py.len(ends) > 2))) {
      return _withSpaces(whole);
    }
    py.append(found, [py.has(part, "-"), py.at(ends, 0), py.at(ends, -1)]);
  }
  return py.or(found, () => null);
}
function _withSpaces(whole) {
  let joined;
  joined = py.join("", py.split(whole));
  return (!py.eq(joined, whole) ? _ranges(joined) : null);
}
function _place(text) {
  let match, number, word;
  word = py.strip(text, "()[].:");
  if ((py.has(HEADS, word) || py.has(TAILS, word))) {
    return new Place(undefined, (py.has(HEADS, word) ? "head" : "tail"));
  }
  match = ITEM.fullmatch(word);
  number = ((match == null) ? null : numeral(py.at(match, 1)));
  return ((number == null) ? null : new Place(number));
}
export function numeral(text) {
  let digit, sign, total;
  if (py.has("0123456789", py.at(text, 0))) {
    return py.int(py.float(text));
  }
  if (py.list(text).every((sign) => py.has(DIGITS, sign))) {
    return py.int(py.join("", py.list(text).map((sign) => py.str(py.at(DIGITS, sign)))));
  }
  if (!py.list(text).every((sign) => (py.has(DIGITS, sign) || py.has(TENS, sign) || py.has("廿卅", sign)))) {
    return null;
  }
  if (py.truth(SHORTENED.search(text))) {
    return null;
  }
  [total, digit] = py.list([0, null]);
  for (sign of py.iter(py.replace(py.replace(text, "廿", "二十"), "卅", "三十"))) {
    if (py.has(DIGITS, sign)) {
      digit = py.at(DIGITS, sign);
    }
    else {
      [total, digit] = py.list([py.add(total, (((digit == null) ? 1 : digit) * py.at(TENS, sign))), null]);
    }
  }
  return py.add(total, py.or(digit, () => 0));
}
export function isSum(text) {
  return (SUMS.match(simple(text)) != null);
}
export function namesOf(text) {
  let found, names, part, words;
  if (py.has(NOBODY, simple(text))) {
    return [];
  }
  found = [];
  for (part of py.iter(py.split(PARTS, BETWEEN.sub("、", ORDINAL.sub("、", text))))) {
    words = py.split(part);
    if ((py.truth(words) && py.list(words).every((word) => py.truth(_chinese(word))))) {
      found = py.extend(found, py.list(_joined(words)).flatMap((word) => py.list(parted(word)).map((name) => name)));
    }
    else {
      found = py.extend(found, parted(py.join(" ", words)));
    }
  }
  names = py.list(found).map((name) => clean(name));
  return py.tuple(py.list(names).flatMap((name) => (((py.truth(name) && !py.has(NOBODY, simple(name)))) ? [name] : [])));
}
export function isName(text) {
  return ((py.len(text) <= MOST_NAME) && py.list(text).some((sign) => py.isalpha(sign)) && !py.truth(standsIn(simple(text))));
}
export function withoutPhones(text) {
  let found, half;
  half = py.normalize("NFKC", text);
  found = py.tuple(py.list(PHONE.finditer(half)).map((match) => py.at(match, 0)));
  return [(py.truth(found) ? py.strip(PATTERN_6.sub("", PHONE.sub(" ", half)), " :") : text), found];
}
function _chinese(word) {
  return (CHINESE.fullmatch(word) != null);
}
function _joined(words) {
  let alone, found, word;
  found = [];
  alone = false;
  for (word of py.iter(words)) {
    if ((py.truth(alone) && (py.len(word) === 1))) {
      py.set(found, -1, py.extend(py.at(found, -1), word));
      alone = false;
    }
    else {
      py.append(found, word);
      alone = ((py.len(word) === 1) || py.has(TWO_SIGNS, word));
    }
  }
  return found;
}
