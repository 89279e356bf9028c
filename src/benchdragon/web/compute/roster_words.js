// What people write into the cells of a list: numbers of benches, names, phones, headings. Twin of
// rosters/words.py.

import { ROSTERS_WORDS } from "./constants.js";

/** @typedef {"number" | "name" | "household" | "phone" | "remarks"} Kind */
/** A bench as a list names it: its number, the head or the tail. @typedef {{ number: number, end: "" | "head" | "tail" }} Place */

// What Python takes for white: in texts and patterns of JavaScript a mark of byte order is too.
const WHITE =
  "\\t\\n\\v\\f\\r \\x1c-\\x1f\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000";
const SPACES = new RegExp(`[${WHITE}]+`, "gu");
const AROUND = new RegExp(`^[${WHITE}]+|[${WHITE}]+$`, "gu");

/** What columns are called, in lower case and without spaces; of two columns of numbers the one holds whose heading stands first here. @type {Record<Kind, string>} */
const SPELLINGS = {
  number:
    "板凳号 板凳编号 凳号 桥号 节号 第几桥 第几节 桥次 节次 板号 龙身号 桥 节 板凳 凳 号 bench benchno benchnumber qiao jie section number no nr # 编号 号码 序号",
  name: "姓名 名字 名单 人名 人员 队员 成员 人员姓名 队员姓名 抬龙人 扛龙人 舞龙人 迎龙人 抬凳人 扛凳人 参加人 参与人 name names fullname bearer bearers person people carrier carriers carriedby",
  household: "户 户主 户名 户主姓名 家庭 家庭户 人家 household householder family house home",
  phone:
    "电话 手机 联系电话 联系方式 手机号 手机号码 电话号码 联系手机 phone phonenumber phoneno mobile mobilephone tel telephone cell contact",
  remarks: "备注 说明 附注 注 其他 remarks remark notes note comments comment",
};
const KINDS = /** @type {Kind[]} */ (Object.keys(SPELLINGS));
const HEADINGS = KINDS.map((kind) => SPELLINGS[kind].split(" "));
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
const NUMERALS = [...Object.keys(DIGITS), ...Object.keys(TENS), "廿卅"].join("");
const ITEM = new RegExp(
  "^(?:第|bench|benches|qiao|jie|section|number|no\\.?|nr\\.?|#)*" +
    `([0-9]{1,9}(?:\\.0+)?|[${NUMERALS}]{1,9})号?(?:板凳|桥|节|凳|块|条|张)?号?$`,
  "u",
);
// 一百二 may be 102 or 120.
const SHORTENED = /[百千佰仟][一二三四五六七八九]$/u;
const TO = /[-~–—‒−]+|至|到|to/gu;
const TO_APART = new RegExp(`[${WHITE}]*(-|~|–|—|至|到)[${WHITE}]*`, "gu");
const AND = new RegExp(`[、,;/&+${WHITE}]|和|及|与|and`, "u");
const PHONE =
  /(?<![0-9])(?:(?:\+?86[- ]?)?1[0-9]{2}[- ]?[0-9]{4}[- ]?[0-9]{4}|0[0-9]{2,3}[- ]?[0-9]{7,8}|\+?[0-9](?:[-() ]{0,2}[0-9]){6,14})(?![0-9])/gu;
const EMPTY = new RegExp(`\\([电话:]*[${WHITE}]*\\)`, "gu");
const PARTS = /[、，,;；/／|\\\n\r\t+＋&＆]+/u;
// Family names of two signs, after which one sign is a given name.
const TWO_SIGNS = new Set(
  "欧阳司马上官诸葛东方皇甫尉迟公孙慕容令狐夏侯司徒司空端木南宫长孙宇文轩辕百里独孤".match(/../gu),
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

/** `text` on one line, without signs that show nothing. @param {string} text */
export function clean(text) {
  const seen = Array.from(text.normalize("NFC")).filter(
    (sign) => sign.replace(SPACES, "") === "" || !/[\p{Cc}\p{Cf}\p{Cs}]/u.test(sign),
  );
  return wordsOf(seen.join("")).join(" ");
}

/** What a column of this heading holds, and its rank among those that hold the same. @param {string} text @returns {{ kind: Kind, rank: number } | null} */
export function heading(text) {
  const whole = plain(text);
  const word = whole.replace(/\(.*?\)|\[.*?\]|[:.。_*'"/-]/gu, "") || whole;
  const short = word.replace(/(?<=.)[0-9一二三四五六甲乙]$/u, "");
  for (const [n, words] of HEADINGS.entries())
    for (const each of [word, short])
      if (words.includes(each)) return { kind: KINDS[n], rank: words.indexOf(each) };
  return null;
}

/** The benches of a cell, as ranges of which both ends count; null where it is no number. @param {string} text @returns {Array<[Place, Place]> | null} */
export function places(text) {
  const whole = stripped(text.normalize("NFKC")).toLowerCase();
  /** @type {Array<[Place, Place]>} */
  const found = [];
  const parts = whole.replace(TO_APART, "$1").replace(TO, "-").split(AND);
  for (const part of parts.filter(Boolean)) {
    const said = part.split("-");
    const ends = said.flatMap((end) => placeOf(end) ?? []);
    if (ends.length !== said.length || ends.length > 2) return withSpaces(whole);
    found.push([ends[0], ends[ends.length - 1]]);
  }
  return found.length ? found : null;
}

/** A number whose words are apart: "bench 37", "第 37 桥". @param {string} whole */
function withSpaces(whole) {
  const joined = whole.replace(SPACES, "");
  return joined === whole ? null : places(joined);
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
function numeral(text) {
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
  return SUMS.test(plain(text));
}

/** The names of a cell. Spaces part Chinese names, but not the signs of one ("张　三"). @param {string} text */
export function namesOf(text) {
  if (NOBODY.has(plain(text))) return [];
  const found = text.replace(ORDINAL, "、").split(PARTS).flatMap((part) => {
    const words = wordsOf(part);
    return words.length && words.every(isChinese) ? joined(words) : [words.join(" ")];
  }); // prettier-ignore
  return found.map(clean).filter((name) => name && !NOBODY.has(plain(name)));
}

/** Whether it may be what somebody is called. @param {string} text */
export function isName(text) {
  return Array.from(text).length <= ROSTERS_WORDS.MOST_NAME && /\p{L}/u.test(text);
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
