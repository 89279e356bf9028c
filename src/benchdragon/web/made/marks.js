// @ts-nocheck
// Made from analysis/marks.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";

const LEAST_EVERY = 0.1;
const SAME_MARK = 1e-06;
const MOST_MARKS = 5000;
const FARTHEST = 1.5;
const AT_MARK = 0.01;
const KINDS = ["step", "joint", "end", "start"];
export class Trail {
  constructor(route, low, start, high) {
    this.route = route;
    this.low = low;
    this.start = start;
    this.high = high;
  }
  get usual_every() {
    return py.max(1.0, _leastEvery(py.sub(this.high, this.low)));
  }
  every(said) {
    return ((said == null) ? this.usual_every : said);
  }
  marked(every) {
    let count, kinds, lags, room, rows, s, span;
    checkEvery(every);
    _checkCount(every, py.sub(this.high, this.low));
    [rows, span] = py.list([this.route.rows, py.sub(this.high, this.low)]);
    room = (py.add(py.ceil((span / every)), py.len(rows)) + 4);
    [s, kinds] = py.list([py.empty(room), py.empty(room, "q")]);
    lags = py.empty((2 * py.len(rows)));
    count = py.entry("bd_marks_lay_marks", rows, this.low, this.start, this.high, every, lags, s, kinds)[0];
    return [py.slice(s, null, count), py.list(py.tolist(py.slice(kinds, null, count))).map((kind) => py.at(KINDS, kind))];
  }
}
function checkEvery(every) {
  if (!((LEAST_EVERY <= every) && (every < Infinity))) {
    throw new InputError(py.filled(_("marks must be at least {least} m apart, not {value} m"), { least: `${py.format(LEAST_EVERY, `g`)}`, value: `${py.format(every, `g`)}` }));
  }
}
function _leastEvery(length) {
  return (py.ceil(((10.0 * length) / MOST_MARKS)) / 10.0);
}
function _checkCount(every, length) {
  if (((length / every) > MOST_MARKS)) {
    throw new InputError(py.filled(_("marks each {every} m on {length} m of route are more than {most}: ask for at least {needed} m between them"), { every: `${py.format(every, `g`)}`, length: `${py.format(length, `.1f`)}`, most: MOST_MARKS, needed: `${py.format(_leastEvery(length), `g`)}` }));
  }
}
function rounded(value, step) {
  return py.round((py.round((value / step)) * step), 6);
}
export function among(places, usual, s) {
  let gap, last, n, past;
  last = (py.len(places) - 1);
  n = py.min(py.max((py.int(py.searchsorted(places, py.add(s, SAME_MARK), "right")) - 1), 0), last);
  past = rounded(py.sub(s, py.at(places, n)), 0.01);
  if ((py.abs(past) < AT_MARK)) {
    return [(n + 1), 0.0];
  }
  gap = ((n < last) ? py.sub(py.at(places, (n + 1)), py.at(places, n)) : 0.0);
  if (((n < last) && (py.sub(py.at(places, (n + 1)), s) < AT_MARK))) {
    return [(n + 2), 0.0];
  }
  return (((past < 0.0) || (gap > (FARTHEST * usual))) ? null : [(n + 1), past]);
}
export function usualGap(places) {
  let gaps, half;
  gaps = py.or(py.sorted(py.list(py.pairwise(places)).map(([a, b]) => py.sub(b, a))), () => [0.0]);
  half = py.div(py.len(gaps), 2);
  return (py.truth(py.mod(py.len(gaps), 2)) ? py.at(gaps, half) : (0.5 * py.add(py.at(gaps, (half - 1)), py.at(gaps, half))));
}
