// @ts-nocheck
// Made from model/profile.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _along } from "../compute/stretches.js";
import { _ } from "../words.js";
import { finite, notNegative } from "./errors.js";

const asList = (_name, values) => values;
const asNumbers = (_name, values) => values;
const asNumber = (_name, value) => value;
const MOST_SPEED = 100.0;
export class Stretches {
  constructor(times, ways, speeds, rates) {
    this.times = times;
    this.ways = ways;
    this.speeds = speeds;
    this.rates = rates;
  }
  *[Symbol.iterator]() {
    yield* [this.times, this.ways, this.speeds, this.rates];
  }
  moved(way) {
    return py.replaced(this, { ways: py.array(py.list(py.tolist(this.ways)).map(([a, b]) => [py.add(a, way), py.add(b, way)])) });
  }
  time(n, way) {
    let ahead, end, fast, first, last, share, slow, speed, start;
    [[first, last], [slow, fast]] = py.list([py.tolist(py.at(this.ways, n)), py.tolist(py.at(this.speeds, n))]);
    [[start, end], ahead] = py.list([py.tolist(py.at(this.times, n)), py.sub(way, first)]);
    share = ((ahead > 0.0) ? py.min((ahead / py.sub(last, first)), 1.0) : 0.0);
    speed = py.sqrt(py.add((slow * slow), (share * py.sub((fast * fast), (slow * slow)))));
    return py.float(((ahead > 0.0) ? py.min(py.add(start, ((2.0 * ahead) / py.add(slow, speed))), end) : start));
  }
}
function _ends(values) {
  return py.array([...py.iter(py.pairwise(py.tolist(values)))]);
}
export class SpeedProfile {
  constructor(times, speeds) {
    this.times = times;
    this.speeds = speeds;
    this.__post_init__();
  }
  __post_init__() {
    let name, t, text, v;
    for (name of py.iter(["times", "speeds"])) {
      this[name] = asList(name, this[name]);
    }
    if ((!py.eq(py.len(this.times), py.len(this.speeds)) || !py.truth(this.times))) {
      text = _("a speed profile needs as many times as speeds, at least one, not {a} and {b}");
      throw new InputError(py.filled(text, { a: py.len(this.times), b: py.len(this.speeds) }));
    }
    for (t of py.iter(this.times)) {
      finite("profile", t, "s");
    }
    for (v of py.iter(this.speeds)) {
      if ((notNegative("speed", v, "m/s") > MOST_SPEED)) {
        throw new InputError(py.filled(_("speed must be at most 100 m/s, not {v} m/s"), { v: `${py.format(v, `g`)}` }));
      }
    }
    if (py.list(py.zip(this.times, py.slice(this.times, 1, null))).some(([a, b]) => (b <= a))) {
      throw new InputError(_("the times of a speed profile must increase"));
    }
  }
  static constant(speed) {
    return new this([0.0], [speed]);
  }
  speed(t) {
    return py.asarray(py.interp(asNumbers("times", t), this.times, this.speeds));
  }
  acceleration(t) {
    return py.at(this._slopes, py.searchsorted(this.times, asNumbers("times", t), "right"));
  }
  distance(t) {
    return py.sub(this._from_first(asNumbers("times", t)), this._from_first(py.asarray(0.0)));
  }
  past(t, ways) {
    let numbers;
    numbers = [t, ...py.iter(this.times), ...py.iter(this.speeds), ...py.iter(ways)];
    return py.at(this._excess(py.list(numbers).map((number) => py.as_integer_ratio(number))), 0);
  }
  _excess(ratios) {
    let count, here, numbers, over, p, q, speeds, t, there, times, under, unit, way, ways;
    unit = py.lcm(...py.iter(py.list(ratios).map(([_over, under]) => under)));
    [t, ...numbers] = py.list(py.list(ratios).map(([over, under]) => (over * py.div(unit, under))));
    count = py.len(this.times);
    [times, speeds, ways] = py.list([py.slice(numbers, null, count), py.slice(numbers, count, (2 * count)), py.slice(numbers, (2 * count), null)]);
    [[there, p], [here, q]] = py.list(py.list([t, py.sub(t, t)]).map((at) => _walked(times, speeds, unit, at)));
    [over, under] = py.list([py.sub((there * q), (here * p)), (p * q)]);
    for (way of py.iter(ways)) {
      over = py.sub(over, ((py.add(way, way) * unit) * under));
    }
    return [over, ((py.add(unit, unit) * unit) * under)];
  }
  stretches(start, end) {
    let rates, speeds, times, ways;
    times = py.array([start, ...py.iter(py.list(this.times).flatMap((t) => ((((start < t) && (t < end))) ? [t] : []))), end]);
    [ways, speeds, rates] = py.list(_along(this, times));
    return new Stretches(_ends(times), _ends(ways), _ends(speeds), rates);
  }
  time(distance) {
    let ahead, knot, n, root, slope, speed, speeds, times, wanted;
    wanted = py.add(asNumber("distance", distance), py.float(this._from_first(py.asarray(0.0))));
    [times, speeds] = py.list([this.times, this.speeds]);
    n = py.int(py.searchsorted(this._sums, wanted, "left"));
    if (((n === 0) || py.eq(n, py.len(times)))) {
      [knot, speed] = py.list(((n === 0) ? [0, py.at(speeds, 0)] : [-1, py.at(speeds, -1)]));
      ahead = py.sub(wanted, py.float(py.at(this._sums, knot)));
      if ((py.truth(ahead) && !py.truth(speed))) {
        return py.copysign(Infinity, ahead);
      }
      return py.add(py.at(times, knot), (py.truth(ahead) ? (ahead / speed) : 0.0));
    }
    [ahead, slope] = py.list([py.sub(wanted, py.float(py.at(this._sums, (n - 1)))), py.float(py.at(this._slopes, n))]);
    speed = py.at(speeds, (n - 1));
    root = py.sqrt(py.max(py.add((speed * speed), ((2.0 * slope) * ahead)), 0.0));
    return py.min(py.add(py.at(times, (n - 1)), ((2.0 * ahead) / py.add(speed, root))), py.at(times, n));
  }
  __slopes_() {
    let inner;
    inner = py.list(_spans(this.times, this.speeds)).map(([a, b, v, w]) => (py.sub(w, v) / py.sub(b, a)));
    return py.array([0.0, ...py.iter(inner), 0.0]);
  }
  get _slopes() {
    return py.keep(this, "_slopes", this.__slopes_());
  }
  __sums_() {
    let a, b, sums, v, w;
    sums = [0.0];
    for ([a, b, v, w] of py.iter(_spans(this.times, this.speeds))) {
      py.append(sums, py.add(py.at(sums, -1), ((0.5 * py.add(w, v)) * py.sub(b, a))));
    }
    return py.array(sums);
  }
  get _sums() {
    return py.keep(this, "_sums", this.__sums_());
  }
  _from_first(t) {
    let dt, knot, slope, speed;
    knot = py.maximum((py.searchsorted(this.times, t, "right") - 1), 0);
    dt = py.sub(t, py.at(py.asarray(this.times), knot));
    slope = py.where((dt < 0.0), 0.0, py.at(this._slopes, (knot + 1)));
    speed = py.at(py.asarray(this.speeds), knot);
    speed = py.add(speed, ((0.5 * slope) * py.where((slope === 0.0), 0.0, dt)));
    return py.asarray(py.add(py.at(this._sums, knot), (speed * py.where((speed === 0.0), 0.0, dt))));
  }
}
function _spans(times, speeds) {
  return py.zip(times, py.slice(times, 1, null), speeds, py.slice(speeds, 1, null));
}
function _walked(times, speeds, unit, t) {
  let a, after, b, before, gone, span, twice, v, w;
  [before, after] = py.list([py.min(py.sub(t, py.at(times, 0)), py.sub(t, t)), py.max(py.sub(t, py.at(times, -1)), py.sub(t, t))]);
  twice = py.add((py.add(py.at(speeds, 0), py.at(speeds, 0)) * before), (py.add(py.at(speeds, -1), py.at(speeds, -1)) * after));
  for ([a, b, v, w] of py.iter(_spans(times, speeds))) {
    if ((t >= b)) {
      twice = py.extend(twice, (py.add(v, w) * py.sub(b, a)));
    }
    else {
      if ((t > a)) {
        [gone, span] = py.list([py.sub(t, a), py.sub(b, a)]);
        return [py.add((twice * span), (py.add((py.add(v, v) * span), (py.sub(w, v) * gone)) * gone)), span];
      }
    }
  }
  return [(twice * unit), unit];
}
