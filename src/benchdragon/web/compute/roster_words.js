// What people write into the cells of a list: numbers of benches, names, phones, headings. Twin of
// rosters/words.py.

import { ROSTERS_WORDS } from "./constants.js";
import { TWO_SIGNS, parted, standsIn } from "./roster_names.js";

/** @typedef {"number" | "name" | "household" | "phone" | "remarks"} Kind */
/** A bench as a list names it: its number, the head or the tail. @typedef {{ number: number, end: "" | "head" | "tail" }} Place */

// What Python takes for white: in texts and patterns of JavaScript a mark of byte order is too.
const WHITE =
  "\\t\\n\\v\\f\\r \\x1c-\\x1f\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000";
const SPACES = new RegExp(`[${WHITE}]+`, "gu");
const AROUND = new RegExp(`^[${WHITE}]+|[${WHITE}]+$`, "gu");

/** What columns are called, in lower case, without spaces and in simplified signs; of two columns of numbers the one holds whose heading stands first here. @type {Record<Kind, string>} */
const SPELLINGS = {
  number:
    "板凳号 板凳编号 凳号 桥号 节号 第几桥 第几节 桥次 节次 板号 龙身号 桥 节 板凳 凳 号 bench benchno benchnumber qiao jie section number no nr # 编号 号码 序号 桥编号 凳编号 桥序 凳序 桥位 凳位 灯号 灯编号 灯序 灯次 灯位 板次 板序 第几凳 第几板 第几灯",
  name: "姓名 名字 名单 人名 人员 队员 成员 人员姓名 队员姓名 抬龙人 扛龙人 舞龙人 迎龙人 抬凳人 扛凳人 参加人 参与人 name names fullname bearer bearers person people carrier carriers carriedby 抬手 抬工 抬夫 抬者 抬人 抬的人 扛的人 谁抬 扛手 扛夫 后生 relief reliefs reserve reserves substitute substitutes",
  household:
    "户 户主 户名 户主姓名 家庭 家庭户 人家 household householder family house home 户长 桥主 凳主 灯主",
  phone:
    "电话 手机 联系电话 联系方式 手机号 手机号码 电话号码 联系手机 phone phonenumber phoneno mobile mobilephone tel telephone cell contact",
  remarks: "备注 说明 附注 注 其他 remarks remark notes note comments comment",
};
const KINDS = /** @type {Kind[]} */ (Object.keys(SPELLINGS));
const HEADINGS = KINDS.map((kind) => SPELLINGS[kind].split(" "));
// What other columns are called: those of no bearers, with which nothing is done.
const OTHERS = new Set(
  "性别 男女 年龄 岁数 生日 出生日期 村 村名 自然村 村组 村民小组 组 小组 组别 班 班组 班次 队 队别 生产队 地址 住址 家庭住址 门牌 门牌号 职务 岗位 分工 身份证 身份证号 证件号 单位 日期 时间 颜色 签名 签字 签到 衣服 服装 尺码 身高 体重 微信 微信号 联系人 紧急联系人 登记人 填表人 经办人 金额 捐款 人数 age sex gender village address group team role shift date time size wechat signature".split(
    " ",
  ),
);
// Who carries, and who takes turns with them, in the words of each village.
const CARRY = "[抬扛掌舞迎擎举执挑背驮托拿提撑]";
const THINGS = "(?:板凳龙|板凳|龙灯|灯笼|花灯|龙|灯|桥|凳|板|节|杠)";
const TURNS =
  "(?:换班|换手|换肩|换抬|换桥|换灯|替换|替班|替补|替手|轮换|轮班|接班|接替|接手|候补|后备|备用|预备)";
const WHO = "(?:人员|队员|人|手|者|员|夫|名单|姓名)";
const EACH = `(?:${CARRY}${THINGS}的?${WHO}?(?:姓名)?|${THINGS}(?:手|丁|夫)|${TURNS}抬?的?${WHO}?(?:姓名)?)`;
const BEARERS = new RegExp(`^${EACH}(?:[和及与或、,&+]*${EACH})*$`, "u");
const PHONE_HEADING =
  /^(.*?)的?(?:联系)?(?:电话号码|电话|手机号码|手机号|手机|联系方式|phone|mobile|tel)$/u;
// Traditional signs of headings and numbers, and the simplified ones.
const TRADITIONAL = Array.from(
  "板橋號節龍燈戶電話機聯繫係備註說員隊與參編碼單換輪後補預時間齡職務組證點總計數塊條張兩貳陸頭東館區櫈無沒農曆陽舊陰",
);
const SIMPLE = Array.from(
  "板桥号节龙灯户电话机联系系备注说员队与参编码单换轮后补预时间龄职务组证点总计数块条张两贰陆头东馆区凳无没农历阳旧阴",
);
const SUMS =
  /^(合计|总计|共计|小计|总数|总人数|合共|(total|sum|subtotal)(?![a-z])|共.{0,4}[0-9]+.{0,3}$)/u;
const NO_NAMES = "无 空 空缺 缺 暂缺 暂无 待定 未定 没有 tbd n/a na none nobody ? ?? - -- — —— /";
// What spreadsheets write into cells whose formula failed.
const ERRORS =
  "#n/a #ref! #name? #value! #div/0! #num! #null! #getting_data #spill! #calc! err:502 err:508";
const NOBODY = new Set([...NO_NAMES.split(" "), ...ERRORS.split(" ")]);
const HEADS = ["龙头", "龙首", "头", "head", "thehead"];
const TAILS = ["龙尾", "尾", "尾巴", "tail", "thetail"];
/** @type {Record<string, number>} */
const DIGITS = { 两: 2 };
for (const digits of ["零一二三四五六七八九", "〇壹贰叁肆伍陆柒捌玖"])
  Array.from(digits).forEach((sign, n) => (DIGITS[sign] = n));
/** @type {Record<string, number>} */
const TENS = { 十: 10, 百: 100, 千: 1000, 拾: 10, 佰: 100, 仟: 1000 };
export const NUMERALS = [...Object.keys(DIGITS), ...Object.keys(TENS), "廿卅"].join("");
// Where somebody stands at a bench, which the number of it may say too.
const SIDES = "(?:[左右前后中上下甲乙丙丁]|[abcd](?![a-z]))[边面侧手杠端]?";
const ITEM = new RegExp(
  "^[左右前后]?(?:第|bench|benches|qiao|jie|section|number|no[.:]?|nr[.:]?|#|板凳|桥|节|凳|板|灯|编?号)*" +
    `([0-9]{1,9}(?:\\.0+)?|[${NUMERALS}]{1,9})[号#]{0,2}(?:板凳|桥|节|凳|块|条|张|板|灯)?[号#]{0,2}` +
    `(?:\\(?(?:${SIDES})+|(?<=[号桥节凳块条张板灯])第?[${NUMERALS}0-9]{1,2}号?[位人])?$`,
  "u",
);
const SIDE_APART = new RegExp(
  `(?<=[0-9号#桥节凳板灯])[${WHITE}]*-?[${WHITE}]*(?=${SIDES}\\)?(?:[${WHITE}]|$|[、,;/&+]))`,
  "gu",
);
// 一百二 may be 102 or 120.
const SHORTENED = /[百千佰仟][一二三四五六七八九]$/u;
const DASH = new RegExp(`[${WHITE}]*[-–—‒−]+[${WHITE}]*`, "gu");
const TO = new RegExp(`[${WHITE}]*(?:~+|至|到|to)[${WHITE}]*`, "gu");
const AND = new RegExp(`[、,;/&+${WHITE}]|和|及|与|and`, "u");
const STROKE = `([0-9]{1,9})[${WHITE}]*/[${WHITE}]*([0-9]{1,9})`;
const [SLASH, SLASHES] = [new RegExp(`^${STROKE}$`, "u"), new RegExp(STROKE, "gu")];
const PHONE =
  /(?<![0-9])(?:(?:\+?86[- ]?)?1[0-9]{2}[- ]?[0-9]{4}[- ]?[0-9]{4}|0[0-9]{2,3}[- ]?[0-9]{7,8}|\+?[0-9](?:[-() ]{0,2}[0-9]){6,14})(?![0-9])/gu;
const EMPTY = new RegExp(`\\([电话:]*[${WHITE}]*\\)`, "gu");
const PARTS = /[、，,;；。/／|\\\n\r\t+＋&＆]+/u;
// Words that join names where spaces part them.
const BETWEEN = new RegExp(
  `(?<=[^${WHITE}])[${WHITE}]+(?:以及|和|与|與|及|跟|同|并|and)[${WHITE}]+(?=[^${WHITE}])`,
  "giu",
);
const ORDINAL = new RegExp(`(?<![0-9])[0-9]{1,3}[)）.、:：][${WHITE}]*(?=[^0-9${WHITE}])`, "gu");
// What Unicode calls "CJK ...": signs, radicals, strokes.
const CHINESE = /^[\p{Unified_Ideograph}\u2e80-\u2ef3\u31c0-\u31e3\uf900-\ufaff\u{2f800}-\u{2fa1f}]$/u;
export const MADE_A_DAY = /^(?:[0-9]{4}-[0-9]{2}-[0-9]{2}|[0-9]{1,2}月[0-9]{1,2}日)$/u;
export const ROUNDED = /^[0-9.]+e\+[0-9]+$/iu;
/** What tables of text add to a phone that was a number. */
export const DECIMALS = /(?<=[0-9])\.0+$/u;

/** `text` without white signs around it. @param {string} text */
export function stripped(text) {
  return text.replace(AROUND, "");
}

/** The words of a text. @param {string} text */
function wordsOf(text) {
  return text.split(SPACES).filter(Boolean);
}

/** `text` in half-width signs and lower case, without spaces. @param {string} text */
export function plain(text) {
  return text.normalize("NFKC").replace(SPACES, "").toLowerCase();
}

/** `text` plainly and in simplified signs: as headings and numbers are compared. @param {string} text */
export function simple(text) {
  return simplified(plain(text));
}

/** @param {string} text */
function simplified(text) {
  return Array.from(text, (sign) => SIMPLE[TRADITIONAL.indexOf(sign)] ?? sign).join("");
}

/** `text` on one line, without signs that show nothing. @param {string} text */
export function clean(text) {
  const seen = Array.from(text.normalize("NFC")).filter(
    (sign) => sign.replace(SPACES, "") === "" || !/[\p{Cc}\p{Cf}\p{Cs}]/u.test(sign),
  );
  return wordsOf(seen.join("")).join(" ");
}

/** What a column of this heading holds, and its rank among those that hold the same. @param {string} text @returns {{ kind: Kind, rank: number } | null} */
export function heading(text) {
  const whole = simple(text);
  const word = whole.replace(/\(.*?\)|\[.*?\]|[:.。_*'"/-]/gu, "") || whole;
  const short = word.replace(/(?<=.)[0-9一二三四五六甲乙丙丁左右前后]$/u, "");
  for (const [n, words] of HEADINGS.entries())
    for (const each of [word, short])
      if (words.includes(each)) return { kind: KINDS[n], rank: words.indexOf(each) };
  const last = (/** @type {Kind} */ kind) => ({ kind, rank: HEADINGS[KINDS.indexOf(kind)].length });
  if (BEARERS.test(word) || BEARERS.test(short)) return last("name");
  const [, before] = PHONE_HEADING.exec(short) ?? [];
  const whose = before ? heading(before) : null;
  return whose && ["name", "household"].includes(whose.kind) ? last("phone") : null;
}

/** Whether a heading is known to be of something else than people and their benches. @param {string} text */
export function isOther(text) {
  return OTHERS.has(simple(text).replace(/\(.*?\)|[:：]/gu, ""));
}

/** The benches of a cell, as ranges of which both ends count; null where it is no number. 4-1 is a place at bench 4, as is each a-b of a bench a that is `halved`: see `withPlaces`. @param {string} text @param {Set<number>} [halved] @returns {Array<[Place, Place]> | null} */
export function places(text, halved = new Set()) {
  const found = rangesOf(text, halved);
  if (!found) return null;
  return found.map(({ dash, low, high }) => [low, dash && isPlace(low, high, halved) ? low : high]);
}

/** The benches whose first place a cell names: 4 of 4-1. @param {string} text */
export function withPlaces(text) {
  const found = (rangesOf(text) ?? []).filter(({ dash }) => dash);
  return found.flatMap(({ low, high }) => (low.number && high.number === 1 ? [low.number] : []));
}

/** Whether a cell may name benches or a place: 1-2, where other benches are halved, and 1 is not. @param {string} text @param {Set<number>} halved */
export function isDoubtful(text, halved) {
  const dashed = text.normalize("NFKC").replace(SLASHES, "$1-$2");
  const found = (rangesOf(dashed) ?? []).filter(({ dash }) => dash && halved.size);
  return found.some(
    ({ low, high }) =>
      !(low.end || high.end || halved.has(low.number)) &&
      low.number < high.number &&
      high.number <= ROSTERS_WORDS.MOST_PLACES,
  );
}

/** A cell of a number with 至 in place of dashes. @param {string} text */
export function withoutDashes(text) {
  return text.replaceAll("/", "-").replace(DASH, "至");
}

/** @param {Place} low @param {Place} high @param {Set<number>} halved */
function isPlace(low, high, halved) {
  if (low.end || high.end || !high.number) return false;
  return halved.has(low.number) || high.number <= Math.min(low.number - 1, ROSTERS_WORDS.MOST_PLACES);
}

/** The ranges of a cell, and whether a dash, or the stroke of 4/1, stands between their ends. @param {string} text @param {Set<number>} [halved] @returns {Array<{ dash: boolean, low: Place, high: Place }> | null} */
function rangesOf(text, halved = new Set()) {
  let whole = simplified(stripped(text.normalize("NFKC")).toLowerCase());
  const [, low, high] = SLASH.exec(whole) ?? [];
  if (low && (halved.has(Number(low)) || Number(high) <= Number(low))) whole = `${low}-${high}`;
  const joined = whole.replace(SIDE_APART, "").replace(DASH, "-").replace(TO, "~");
  const found = [];
  for (const part of joined.split(AND).filter(Boolean)) {
    const said = part.split(/[-~]/u);
    const ends = said.flatMap((end) => placeOf(end) ?? []);
    if (ends.length !== said.length || ends.length > 2) return withSpaces(whole);
    found.push({ dash: part.includes("-"), low: ends[0], high: ends[ends.length - 1] });
  }
  return found.length ? found : null;
}

/** A number whose words are apart: "bench 37", "第 37 桥". @param {string} whole */
function withSpaces(whole) {
  const joined = whole.replace(SPACES, "");
  return joined === whole ? null : rangesOf(joined);
}

/** @param {string} text @returns {Place | null} */
function placeOf(text) {
  const word = text.replace(/^[()[\].:]+|[()[\].:]+$/gu, "");
  if (HEADS.includes(word)) return { number: 0, end: "head" };
  if (TAILS.includes(word)) return { number: 0, end: "tail" };
  const match = ITEM.exec(word);
  const number = match && numeral(match[1]);
  return number === null ? null : { number, end: "" };
}

/** A number in digits, or as Chinese write it: 三十七, 一百零五, 一二〇. @param {string} text */
export function numeral(text) {
  if (/^[0-9]/u.test(text)) return Math.trunc(Number(text));
  const signs = Array.from(text);
  if (signs.every((sign) => sign in DIGITS)) return Number(signs.map((sign) => DIGITS[sign]).join(""));
  if (SHORTENED.test(text)) return null;
  let total = 0;
  /** @type {number | null} */
  let digit = null;
  for (const sign of text.replaceAll("廿", "二十").replaceAll("卅", "三十"))
    if (sign in DIGITS) digit = DIGITS[sign];
    else {
      total += (digit ?? 1) * TENS[sign];
      digit = null;
    }
  return total + (digit ?? 0);
}

/** Whether a cell begins what was added up. @param {string} text */
export function isSum(text) {
  return SUMS.test(simple(text));
}

/** The names of a cell. Spaces part Chinese names, but not the signs of one ("张　三"). @param {string} text */
export function namesOf(text) {
  if (NOBODY.has(simple(text))) return [];
  const found = text.replace(ORDINAL, "、").replace(BETWEEN, "、").split(PARTS).flatMap((part) => {
    const words = wordsOf(part);
    return words.length && words.every(isChinese) ? joined(words).flatMap(parted) : parted(words.join(" "));
  }); // prettier-ignore
  return found.map(clean).filter((name) => name && !NOBODY.has(simple(name)));
}

/** Whether it may be what somebody is called. @param {string} text */
export function isName(text) {
  const short = Array.from(text).length <= ROSTERS_WORDS.MOST_NAME;
  return short && /\p{L}/u.test(text) && !standsIn(simple(text));
}

/** A text without the phone numbers in it, and these. @param {string} text @returns {[string, string[]]} */
export function withoutPhones(text) {
  const half = text.normalize("NFKC");
  const found = half.match(PHONE) ?? [];
  if (!found.length) return [text, []];
  const rest = half.replace(PHONE, " ").replace(EMPTY, "");
  return [rest.replace(/^[ :]+|[ :]+$/gu, ""), found];
}

/** @param {string} word */
function isChinese(word) {
  return Array.from(word).every((sign) => CHINESE.test(sign) || "·（）()".includes(sign));
}

/** Names among words: two signs that stand alone are one name, and one after a family's two. @param {string[]} words */
function joined(words) {
  /** @type {string[]} */
  const found = [];
  let alone = false;
  for (const word of words) {
    const one = Array.from(word).length === 1;
    if (alone && one) {
      found[found.length - 1] += word;
      alone = false;
    } else {
      found.push(word);
      alone = one || TWO_SIGNS.has(word);
    }
  }
  return found;
}
