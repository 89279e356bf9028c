// What Python does otherwise than JavaScript, for the modules that tools/make_twins.py makes: what is true,
// equal or part of something, places from the end, signs beyond 16 bits, formats, regular expressions. What
// is given to it may be anything.
// @ts-nocheck

import { decimals, general, powered } from "./number_format.js";
import { integerRatio, lcm, linspace, rint, rounded, ulp } from "./numbers.js";
import { isPrintable, pythonRepr, pythonText } from "./python_text.js";

const WHITE = "\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000";
const LINE_END = /\r\n|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]/u;
const CATEGORIES =
  "Lu Ll Lt Lm Lo Mn Mc Me Nd Nl No Pc Pd Ps Pe Pi Pf Po Sm Sc Sk So Zs Zl Zp Cc Cf Cs Co";

/** The same object for keys that hold the same. */
function interned(known, key) {
  if (typeof key !== "object" || key === null) return key;
  const name = JSON.stringify(isTuple(key) ? [...key] : key);
  if (!known.has(name)) known.set(name, key);
  return known.get(name);
}

/** A value that cannot be, in a sentence of its own. */
export class ValueError extends Error {}

class Dict extends Map {
  #known = new Map();
  has(key) {
    return super.has(interned(this.#known, key));
  }
  get(key, otherwise = null) {
    const own = interned(this.#known, key);
    return super.has(own) ? super.get(own) : otherwise;
  }
  set(key, value) {
    return super.set(interned(this.#known, key), value);
  }
}

class Sets extends Set {
  #known = new Map();
  has(value) {
    return super.has(interned(this.#known, value));
  }
  add(value) {
    return super.add(interned(this.#known, value));
  }
}

class Match {
  constructor(found) {
    this.found = found;
  }
  group(n = 0) {
    const said = typeof n === "string" ? this.found.groups?.[n] : this.found[n];
    return said ?? null;
  }
  groups() {
    return this.found.slice(1).map((one) => one ?? null);
  }
  start() {
    return py.len(this.found.input.slice(0, this.found.index));
  }
  end() {
    return this.start() + py.len(this.found[0]);
  }
}

class Pattern {
  constructor(source, flags) {
    this.all = new RegExp(source, `gu${flags}`);
    this.whole = new RegExp(`(?<![\\s\\S])(?:${source})(?![\\s\\S])`, `u${flags}`);
    this.first = new RegExp(`(?<![\\s\\S])(?:${source})`, `u${flags}`);
  }
  #found(pattern, text) {
    pattern.lastIndex = 0;
    const found = pattern.exec(text);
    return found && new Match(found);
  }
  fullmatch(text) {
    return this.#found(this.whole, text);
  }
  match(text) {
    return this.#found(this.first, text);
  }
  search(text) {
    return this.#found(this.all, text);
  }
  finditer(text) {
    return [...text.matchAll(this.all)].map((found) => new Match(found));
  }
  findall(text) {
    return [...text.matchAll(this.all)].map((found) => {
      const groups = found.slice(1).map((one) => one ?? "");
      return groups.length > 1 ? groups : (groups[0] ?? found[0]);
    });
  }
  sub(by, text) {
    let [said, end] = ["", 0];
    for (const found of text.matchAll(this.all)) {
      const put =
        typeof by === "string"
          ? by.replace(/\\(\d)/g, (_all, n) => found[n] ?? "")
          : by(new Match(found));
      said += text.slice(end, found.index) + put;
      end = found.index + found[0].length;
    }
    return said + text.slice(end);
  }
  split(text, most = 0) {
    const [said, all] = [[], [...text.matchAll(this.all)]];
    let end = 0;
    for (const found of most ? all.slice(0, most) : all) {
      said.push(text.slice(end, found.index));
      end = found.index + found[0].length;
    }
    return [...said, text.slice(end)];
  }
}

function isTuple(value) {
  return typeof value === "object" && value !== null && Symbol.iterator in value;
}

/** A text without the signs at its ends that are white or of `signs`. */
function stripped(text, signs) {
  const own = signs ? signs.replace(/[\\\]^-]/g, "\\$&") : WHITE;
  return text.replace(new RegExp(`^[${own}]+|[${own}]+$`, "gu"), "");
}

/** Which comes first: below 0 for `a`. */
function compared(a, b) {
  if (!isTuple(a) || typeof a === "string") return a < b ? -1 : a > b ? 1 : 0;
  const [one, other] = [[...a], [...b]];
  for (let n = 0; n < Math.min(one.length, other.length); n++) {
    const found = compared(one[n], other[n]);
    if (found) return found;
  }
  return one.length - other.length;
}

/** The first or last of some. */
function most(sign, given) {
  const [over, key, otherwise] = given;
  const plain = given.length > 1 && key !== undefined && typeof key !== "function";
  const rank = typeof key === "function" ? key : (one) => one;
  const all = plain ? given : py.list(over);
  if (!all.length) return otherwise;
  return all.reduce((best, one) => (sign * compared(rank(one), rank(best)) > 0 ? one : best));
}

/** @type {Record<string, (...given: any[]) => any>} */
export const py = {
  // What is true, equal, and part of something.
  truth: (a) =>
    typeof a !== "object" || a === null
      ? Boolean(a) || Number.isNaN(a)
      : Array.isArray(a)
        ? a.length > 0
        : a instanceof Map || a instanceof Set
          ? a.size > 0
          : true,
  bool: (a) => py.truth(a),
  or: (a, b) => (py.truth(a) ? a : b()),
  and: (a, b) => (py.truth(a) ? b() : a),
  eq(a, b) {
    if (a === b || typeof a !== "object" || typeof b !== "object" || !a || !b) return a === b;
    if (a instanceof Set) return a.size === b.size && [...a].every((one) => b.has(one));
    if (a instanceof Map)
      return a.size === b.size && [...a].every(([k, v]) => b.has(k) && py.eq(v, b.get(k)));
    const [one, other] = [Object.values(a), Object.values(b)];
    return one.length === other.length && one.every((each, n) => py.eq(each, other[n]));
  },
  has(all, a) {
    if (typeof all === "string") return all.includes(a);
    if (all instanceof Map || all instanceof Set) return all.has(a);
    return isTuple(all) ? [...all].some((one) => py.eq(one, a)) : Object.hasOwn(all, a);
  },
  is: (a, kind) =>
    ({
      str: typeof a === "string",
      bool: typeof a === "boolean",
      int: Number.isInteger(a),
      float: typeof a === "number",
      list: Array.isArray(a),
      tuple: Array.isArray(a),
      dict: typeof a === "object" && a !== null && !Array.isArray(a) && !(a instanceof Date),
    })[kind],
  // Lists and texts by places.
  iter(a) {
    if (py.isTable(a)) return py.tolist(a);
    return isTuple(a) || typeof a === "string" ? (a instanceof Map ? a.keys() : a) : Object.keys(a);
  },
  list: (a) => (a == null ? [] : [...py.iter(a)]),
  tuple: (a) => py.list(a),
  isTable: () => false, // what is known of arrays, arrays.js adds
  shape: (a) => a?.shape ?? (isTuple(a) ? [a.length, ...py.shape(a[0])] : []),
  // Objects.
  vars: (a) => a,
  type: (a) => a.constructor,
  keep(a, name, value) {
    Object.defineProperty(a, name, { value, configurable: true });
    return value;
  },
  len: (a) =>
    typeof a === "string"
      ? /[\ud800-\udfff]/.test(a)
        ? [...a].length
        : a.length
      : (a.shape?.[0] ?? a.size ?? py.list(a).length),
  at(a, n) {
    if (py.isTable(a)) return py.cell(a, n);
    if (a instanceof Match) return a.group(n);
    if (a instanceof Map) return a.get(n);
    if (Array.isArray(a) || ArrayBuffer.isView(a)) return a.at(n);
    return isTuple(a) || typeof a === "string" ? [...a].at(n) : a[n];
  },
  slice(a, start, end) {
    const [from, to] = [start ?? 0, end ?? undefined];
    if (py.isTable(a)) return py.rows(a, from, to);
    return typeof a === "string" ? [...a].slice(from, to).join("") : py.list(a).slice(from, to);
  },
  set(a, n, value) {
    if (py.isTable(a)) py.put(a, n, value);
    else if (a instanceof Map) a.set(n, value);
    else a[Array.isArray(a) && n < 0 ? a.length + n : n] = value;
  },
  pop(a, n = -1, otherwise = null) {
    if (Array.isArray(a)) return a.splice(n, 1)[0];
    const found = py.get(a, n, otherwise);
    if (a instanceof Map || a instanceof Set) a.delete(n);
    else delete a[n];
    return found;
  },
  append: (a, one) => void a.push(one),
  index: (a, one) =>
    typeof a === "string"
      ? py.len(a.slice(0, a.indexOf(one)))
      : py.list(a).findIndex((each) => py.eq(each, one)),
  count: (a, one, from = 0, to = undefined) =>
    typeof a === "string"
      ? py.slice(a, from, to).split(one).length - 1
      : py.list(a).filter((each) => py.eq(each, one)).length,
  extend: (a, b) => (Array.isArray(a) ? (a.push(...py.iter(b)), a) : a + b),
  enumerate: (a, start = 0) => py.list(a).map((one, n) => [n + start, one]),
  zip(...lists) {
    const all = lists.map(py.list);
    return Array.from({ length: Math.min(...all.map((one) => one.length)) }, (_none, n) =>
      all.map((one) => one[n]),
    );
  },
  range(a, b, step = 1) {
    const [start, end] = b === undefined ? [0, a] : [a, b];
    return Array.from(
      { length: Math.max(0, Math.ceil((end - start) / step)) },
      (_none, n) => start + n * step,
    );
  },
  pairwise: (a) => py.zip(py.list(a), py.list(a).slice(1)),
  islice: (a, count) => py.list(a).slice(0, count),
  next: (a, otherwise = null) => {
    const [first] = py.iter(a);
    return first === undefined ? otherwise : first;
  },
  groupby(a, key = (one) => one) {
    const found = [];
    for (const one of py.iter(a)) {
      const last = found[found.length - 1];
      if (last && py.eq(last[0], key(one))) last[1].push(one);
      else found.push([key(one), [one]]);
    }
    return found;
  },
  sorted(a, key = (one) => one, reverse = false) {
    const sign = reverse ? -1 : 1;
    return py.list(a).sort((one, other) => sign * compared(key(one), key(other)));
  },
  max: (...given) => most(1, given),
  min: (...given) => most(-1, given),
  sum: (a, start = 0) => py.list(a).reduce((sum, one) => sum + Number(one), start),
  // Sets and dicts; plain objects are dicts, too.
  set_of: (a) => py.list(a).reduce((all, one) => all.add(one), new Sets()),
  frozenset: (a) => py.set_of(a),
  dict: (a) => py.items(a ?? []).reduce((all, [key, value]) => all.set(key, value), new Dict()),
  fromkeys: (a, value = null) => py.dict(py.list(a).map((key) => [key, value])),
  object: (a) => Object.fromEntries(py.items(a)),
  items: (a) => (isTuple(a) ? [...a] : Object.entries(a)),
  keys: (a) => py.list(a),
  values: (a) => (a instanceof Map ? [...a.values()] : Object.values(a)),
  get: (a, key, otherwise = null) => (a != null && py.has(a, key) ? py.at(a, key) : otherwise),
  setdefault(a, key, value = null) {
    if (!py.has(a, key)) py.set(a, key, value);
    return py.at(a, key);
  },
  add: (a, b) =>
    b === undefined
      ? undefined
      : a instanceof Set
        ? void a.add(b)
        : Array.isArray(a)
          ? [...a, ...b]
          : a + b,
  merge(a, b) {
    if (typeof a === "number") return a | b;
    for (const one of a instanceof Set ? py.iter(b) : py.items(b))
      if (a instanceof Set) a.add(one);
      else py.set(a, one[0], one[1]);
    return a;
  },
  union: (a, b) => py.merge(a instanceof Set ? py.set_of(a) : py.dict(a), b),
  both: (a, b) => py.set_of(py.list(a).filter((one) => py.has(b, one))),
  sub: (a, b) =>
    typeof a === "object" ? py.set_of(py.list(a).filter((one) => !py.has(b, one))) : a - b,
  times: (a, b) => (Array.isArray(a) ? Array.from({ length: b }, () => a).flat() : a.repeat(b)),
  replaced: (a, changed) => Object.assign(Object.create(Object.getPrototypeOf(a)), a, changed),
  // Numbers.
  abs: Math.abs,
  floor: Math.floor,
  ceil: Math.ceil,
  isfinite: Number.isFinite,
  ulp,
  lcm,
  as_integer_ratio: integerRatio,
  isnan: Number.isNaN,
  exp: Math.exp,
  log: Math.log,
  linspace,
  sqrt: Math.sqrt,
  copysign: (a, b) => (b < 0 || Object.is(b, -0) ? -Math.abs(a) : Math.abs(a)),
  hypot: Math.hypot,
  atan2: Math.atan2,
  cos: Math.cos,
  sin: Math.sin,
  dist: ([a, b], [c, d]) => Math.hypot(a - c, b - d),
  degrees: (a) => (a * 180) / Math.PI,
  radians: (a) => a * (Math.PI / 180),
  remainder: (a, b) => a - b * rint(a / b),
  mod: (a, b) => ((a % b) + b) % b,
  div: (a, b) => (typeof a === "bigint" ? a / b : Math.floor(a / b)),
  divmod: (a, b) => [Math.floor(a / b), py.mod(a, b)],
  round: (a, digits = 0) => (digits ? rounded(a, digits) : rint(a)),
  int: (a) => Math.trunc(Number(a)),
  float(a) {
    if (typeof a !== "string") return Number(a);
    const number = Number(a.replace(/^([-+]?)inf$/, "$1Infinity"));
    if (!a.trim() || (Number.isNaN(number) && a !== "nan")) throw new ValueError(a);
    return number;
  },
  perf_counter: () => performance.now() / 1000,
  // Texts.
  str: (a) => (typeof a === "number" ? String(a) : (a?.message ?? pythonText(a))),
  repr: (a) => (typeof a === "string" ? pythonRepr(a) : String(a)),
  ord: (a) => a.codePointAt(0),
  chr: String.fromCodePoint,
  format(a, spec) {
    const [, digits, kind] = /^z?0?(?:\.?([0-9]+))?([efgXd]?)$/.exec(spec) ?? [];
    if (kind === "d") return String(a).padStart(Number(digits ?? 0), "0");
    if (kind === "X") return a.toString(16).toUpperCase().padStart(Number(digits), "0");
    if (kind === "e") return powered(a, Number(digits));
    return kind === "f" ? decimals(a, Number(digits)) : general(a, Number(digits ?? 6));
  },
  filled: (text, values) =>
    text.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? py.str(values[name]) : whole)),
  join: (mark, a) => py.list(a).join(mark),
  split: (a, by, most_) =>
    a instanceof Pattern
      ? a.split(by, most_)
      : by == null
        ? a.split(new RegExp(`[${WHITE}]+`, "u")).filter(Boolean)
        : a.split(by),
  splitlines: (a) =>
    a.endsWith("\n") || LINE_END.test(a.slice(-1))
      ? a.split(LINE_END).slice(0, -1)
      : a
        ? a.split(LINE_END)
        : [],
  strip: (a, signs = "") => stripped(a, signs),
  partition(a, by) {
    const n = a.indexOf(by);
    return n < 0 ? [a, "", ""] : [a.slice(0, n), by, a.slice(n + by.length)];
  },
  startswith: (a, by) => [by].flat().some((one) => a.startsWith(one)),
  endswith: (a, by) => [by].flat().some((one) => a.endsWith(one)),
  decode: (a, encoding) =>
    encoding === "latin-1"
      ? Array.from(a, (byte) => String.fromCharCode(byte)).join("")
      : new TextDecoder(encoding, { ignoreBOM: true }).decode(a),
  lower: (a) => a.toLowerCase(),
  upper: (a) => a.toUpperCase(),
  replace: (a, one, other) => a.replaceAll(one, () => other),
  translate: (a, table) =>
    [...a]
      .map((sign) => table.get(sign.codePointAt(0), sign))
      .map((one) => (typeof one === "number" ? String.fromCodePoint(one) : one))
      .join(""),
  isprintable: isPrintable,
  isalpha: (a) => /^\p{L}+$/u.test(a),
  isspace: (a) => new RegExp(`^[${WHITE}]+$`, "u").test(a),
  normalize: (form, a) => a.normalize(form),
  category: (a) => CATEGORIES.split(" ").find((one) => new RegExp(`\\p{${one}}`, "u").test(a)) ?? "Cn",
  pattern: (source, flags) => new Pattern(source, flags),
};
