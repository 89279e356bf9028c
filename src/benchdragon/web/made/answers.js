// @ts-nocheck
// Made from plans/answers.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { ValueError, py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { numeral } from "./roster_words.js";
import { quantity } from "./units.js";

export const MOST_LENGTH = 20.0;
export const MOST_WIDTH = 2.0;
const CARRIES = py.dict([["beside", N_("beside")], ["under", N_("under")]]);
const CARRY_SIGNS = py.dict([["旁", N_("beside")], ["边", N_("beside")], ["侧", N_("beside")], ["下", N_("under")], ["底", N_("under")]]);
const ROUND = py.pattern("^(?:r|半径)", "");
const UNITS = py.dict([["m", py.dict([["m", 1.0], ["cm", 0.01], ["mm", 0.001], ["km", 1000.0], ["米", 1.0], ["公尺", 1.0], ["厘米", 0.01], ["公分", 0.01], ["毫米", 0.001]])], ["s", py.dict([["s", 1.0], ["min", 60.0], ["h", 3600.0], ["ms", 0.001], ["秒", 1.0], ["分", 60.0], ["分钟", 60.0], ["小时", 3600.0]])], ["m/s", py.dict([["m/s", 1.0], ["km/h", 0.2777777777777778], ["cm/s", 0.01], ["m/min", 0.016666666666666666], ["米/秒", 1.0], ["米每秒", 1.0], ["米/分", 0.016666666666666666], ["米/分钟", 0.016666666666666666], ["米每分钟", 0.016666666666666666], ["米", 1.0], ["每秒", 1.0]])], ["m/s²", py.dict([["m/s^2", 1.0], ["m/s²", 1.0], ["cm/s^2", 0.01], ["cm/s²", 0.01], ["米/秒²", 1.0]])], ["°/s", py.dict([["deg/s", 1.0], ["°/s", 1.0], ["rad/s", 57.29577951308232], ["度/秒", 1.0]])]]);
const COUNTED = py.pattern("(?:个人|人|个|条|桥|节|张|块|benches|bench|people)(?=\\n?(?![\\s\\S]))", "");
const EACH_SECOND = py.pattern("^每秒", "");
const NUMERAL = py.pattern("[零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅]+", "");
const NUMBER = py.pattern("[-+]?(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:e[-+]?[0-9]+)?", "");
const METRES_AND = py.pattern("([0-9]+)(?:米|m)([0-9]{1,2})(?:公分|厘米|cm)?", "");
const MIXED = py.pattern("[0-9]+[零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅]+|[零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅]+[0-9]+", "");
const TWO = py.pattern("[0-9.][\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]+[0-9.]|([^0-9.\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]+)[0-9.]+\\1(?=\\n?(?![\\s\\S]))", "");
const REMARK = py.pattern("(?<=[^\\n])\\([^()]*\\)(?=\\n?(?![\\s\\S]))", "");
const ABOUT = py.pattern("^(?:大约|大概|差不多|约|about)|(?:左右|上下)(?=\\n?(?![\\s\\S]))", "");
const ENDED = py.pattern("[。.,]+(?=\\n?(?![\\s\\S]))", "");
const SPACED = py.pattern("(?<=[0-9零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅米m])[\\t-\\r\\x1c-\\x20\\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]+(?=[0-9零一二三四五六七八九〇壹贰叁肆伍陆柒捌玖两十百千拾佰仟廿卅])", "");
const TIMES = py.pattern("[×*乘,，]", "");
function plainly(text) {
  let typed;
  typed = py.lower(py.join("", py.split(py.replace(py.normalize("NFKC", text), "−", "-"))));
  typed = ABOUT.sub("", REMARK.sub("", ENDED.sub("", typed)));
  function digits(found) {
    let number;
    number = numeral(py.at(found, 0));
    return ((number == null) ? py.at(found, 0) : py.str(number));
  }
  return NUMERAL.sub(digits, typed);
}
export function numberIn(text, unit) {
  let number, parts, plain, said;
  said = py.lower(py.strip(py.normalize("NFKC", text)));
  if ((py.truth(MIXED.search(said)) || py.truth(TWO.search(said)))) {
    return null;
  }
  plain = ((unit === "m/s") ? EACH_SECOND.sub("", plainly(said)) : plainly(said));
  plain = (py.truth(unit) ? plain : COUNTED.sub("", plain));
  parts = ((unit === "m") ? METRES_AND.fullmatch(plain) : null);
  if (py.truth(parts)) {
    plain = `${py.str(py.at(parts, 1))}.${py.str(py.at(parts, 2))}`;
  }
  try {
    number = (py.truth(NUMBER.fullmatch(plain)) ? py.float(plain) : quantity(plain, py.get(UNITS, unit, py.dict([]))));
  } catch (error) {
    if (error instanceof ValueError) {
      return null;
    } else
    throw error;
  }
  return (((py.is(number, "float")) && py.isfinite(number)) ? number : null);
}
function _refused(wanted, called, text, example = "", least = 0.0, most = 0.0) {
  let ends;
  ends = py.dict([["least", `${py.format(least, `g`)}`], ["most", `${py.format(most, `g`)}`]]);
  return new InputError(py.filled(wanted, { option: called, text: py.repr(text), example: example, ...py.object(ends) }));
}
function countIn(called, text, example, least, most) {
  let found, wanted;
  found = numberIn(text, "");
  if (((found == null) || !py.eq(found, py.floor(found)) || (found < 0.0))) {
    wanted = _("{option}: expected a whole number such as {example}, not {text}");
    throw _refused(wanted, called, text, example);
  }
  if (!((least <= found) && (found <= most))) {
    wanted = _("{option}: expected {least} to {most}, not {text}");
    throw _refused(wanted, called, text, example, least, most);
  }
  return py.int(found);
}
function _lengthIn(called, text, example, least, most) {
  let found, hint, plain, wanted;
  found = numberIn(text, "m");
  if (((found != null) && ((least <= found) && (found <= most)))) {
    return found;
  }
  plain = plainly(text);
  if (((found != null) && (found > most) && py.truth(NUMBER.fullmatch(plain)))) {
    hint = _("{option}: {text} would be metres, at most {most}: write {text}cm for centimetres");
    throw new InputError(py.filled(hint, { option: called, text: plain, most: `${py.format(most, `g`)}` }));
  }
  wanted = _("{option}: expected a length from {least} cm to {most} m, such as {example}, not {text}");
  throw _refused(wanted, called, text, example, (100.0 * least), most);
}
function _speedIn(called, text, example, least, most) {
  let found, wanted;
  found = numberIn(text, "m/s");
  if (((found == null) || !((least <= found) && (found <= most)))) {
    wanted = _("{option}: expected a speed of 0.05 to {most} m/s, such as {example}, not {text}");
    throw _refused(wanted, called, text, example, least, most);
  }
  return found;
}
function _squareIn(called, text, example, least, most) {
  let first, parts, plain, second, sides, typed, wanted;
  typed = py.strip(py.normalize("NFKC", text));
  plain = plainly(((py.len(SPACED.findall(typed)) === 1) ? SPACED.sub("x", typed) : typed));
  if (py.truth(ROUND.match(plain))) {
    return _lengthIn(called, ROUND.sub("", plain), "r12", least, most);
  }
  sides = (py.has(plain, "长") ? py.replace(py.replace(plain, "宽", "x"), "长", "") : plain);
  parts = py.list(py.split(TIMES.sub("x", sides), "x")).flatMap((part) => ((py.truth(part)) ? [part] : []));
  if ((py.len(parts) !== 2)) {
    wanted = _("{option}: expected length and width with an x between ({example}), not {text}");
    throw _refused(wanted, called, text, example);
  }
  [first, second] = py.list(parts);
  return [_lengthIn(called, first, "30", least, most), _lengthIn(called, second, "20", least, most)];
}
function _carryIn(called, text, example) {
  let found, name, number, said, wanted, word;
  said = plainly(text);
  for ([number, [name, word]] of py.iter(py.enumerate(py.items(CARRIES), 1))) {
    if (py.has([name, _(word), py.str(number)], said)) {
      return name;
    }
  }
  found = py.sorted(py.set_of(py.list(py.items(CARRY_SIGNS)).flatMap(([sign, name]) => ((py.has(said, sign)) ? [name] : []))));
  if ((py.len(found) === 1)) {
    return py.at(found, 0);
  }
  wanted = _("{option}: expected beside (1) or under (2), for example {example}, not {text}");
  throw _refused(wanted, called, text, example);
}
class Question {
  constructor(option, label, text, why, kind, example, keys, usually = "", least = 0.01, most = 0.0) {
    this.option = option;
    this.label = label;
    this.text = text;
    this.why = why;
    this.kind = kind;
    this.example = example;
    this.keys = keys;
    this.usually = usually;
    this.least = least;
    this.most = most;
  }
  get name() {
    return py.replace(py.slice(this.option, 2, null), "-", "_");
  }
  usual(said) {
    if (py.startswith(this.usually, "+")) {
      return `${py.format(py.add(py.at(said, "bench_length"), py.float(this.usually)), `g`)}`;
    }
    return this.usually;
  }
  answer(called, text) {
    let hint, mixed;
    mixed = MIXED.search(py.normalize("NFKC", text));
    if (py.truth(mixed)) {
      hint = _("{option}: {mixed} is partly in digits and partly in words: write {example}");
      throw new InputError(py.filled(hint, { option: called, mixed: py.repr(py.at(mixed, 0)), example: this.example }));
    }
    if ((this.kind === "carry")) {
      return _carryIn(called, text, this.example);
    }
    if ((this.kind === "count")) {
      return countIn(called, text, this.example, this.least, this.most);
    }
    if ((this.kind === "square")) {
      return _squareIn(called, text, this.example, this.least, this.most);
    }
    if ((this.kind === "speed")) {
      return _speedIn(called, text, this.example, this.least, this.most);
    }
    return _lengthIn(called, text, this.example, this.least, this.most);
  }
}
export const QUESTIONS = [new Question("--benches", N_("Benches"), N_("How many benches, head and tail included?"), N_("the whole dragon, head and tail included"), "count", "120", ["dragon.benches"], "", 2, 500), new Question("--bench-length", N_("Length of a bench"), N_("How long is a bench, in metres (1.5, or 150cm)?"), N_("the dragon's length, and how tightly it can bend"), "length", "1.5", ["dragon.body_length"], "", 0.01, 20.0), new Question("--bench-width", N_("Width of a bench"), N_("How wide is a bench, in metres (0.15, or 15cm)?"), N_("how near the rounds of the coil can lie"), "length", "15cm", ["dragon.width"], "20cm", 0.01, 2.0), new Question("--head-length", N_("Length of the head's bench"), N_("How long is the head's bench, in metres?"), N_("it carries the dragon's head, and is often longer"), "length", "2", ["dragon.head_length"], "+0.5", 0.01, 20.0), new Question("--inset", N_("From the end to the hole"), N_("How far are the holes from the ends of a bench, in metres?"), N_("benches swivel about the pins in their holes"), "length", "15cm", ["dragon.front_inset", "dragon.rear_inset"], "0.15", 0.01, 2.0), new Question("--square", N_("The square"), N_("How long and wide is the square, in metres (30x20; r12 if it is round, 12 m from its middle to its edge)?"), N_("the whole dance stays on it"), "square", "30x20", ["venue.rectangle", "venue.boundary"], "", 0.01, 2000.0), new Question("--bearers", N_("People at a bench"), N_("How many people carry a bench?"), N_("they need room along it"), "count", "2", [], "2", 1, 8), new Question("--carry", N_("Where they walk"), N_("Do they walk beside the bench (1) or under it (2)?"), N_("beside it they need more room between the rounds"), "carry", "1", [], "1", 0.01, 0.0), new Question("--speed", N_("Speed of the head"), N_("How fast may the head walk, in metres a second?"), N_("0.8 is a calm walk"), "speed", "0.8", ["walk.speed"], "0.8", 0.05, 10.0), new Question("--most-speed", N_("Greatest speed"), N_("How fast can a bench be carried at most, in metres a second?"), N_("those behind may have to be faster than the head"), "speed", "1.5", ["people.most_speed", "limits.speed"], "1.5", 0.05, 10.0), new Question("--sway", N_("Sway"), N_("How far does a bench sway to a side when it is carried ten steps, in metres?"), N_("it is assumed unless you measured it"), "length", "5cm", ["people.sway"], "5cm", 0.0, 1.0), new Question("--imprecision", N_("Imprecision"), N_("How far do bearers stray from a line that they follow, in metres?"), N_("it is assumed unless you measured it"), "length", "10cm", ["people.imprecision"], "10cm", 0.0, 1.0)];
export function wished(said, given) {
  let isRound, square;
  square = py.at(said, "square");
  isRound = (py.is(square, "float"));
  return py.dict([["benches", py.at(said, "benches")], ["length", py.at(said, "bench_length")], ["width", py.at(said, "bench_width")], ["head_length", py.at(said, "head_length")], ["inset", py.at(said, "inset")], ["rectangle", (py.truth(isRound) ? null : square)], ["radius", (py.truth(isRound) ? square : null)], ["bearers", py.at(said, "bearers")], ["carry", py.at(said, "carry")], ["speed", py.at(said, "speed")], ["most_speed", py.at(said, "most_speed")], ["sway", py.at(said, "sway")], ["imprecision", py.at(said, "imprecision")], ["measured", py.list(["sway", "imprecision"]).flatMap((name) => ((py.has(given, name)) ? [name] : []))]]);
}
