// @ts-nocheck
// Made from analysis/shortage.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _Seen } from "../compute/shortage.js";

const SAMPLES = 200;
const CLOSER = 50;
const DECIMALS = 2;
const LEVEL = 1e-06;
const HALVINGS = 50;
class Shortage {
  constructor(key, wanted, time, apart, there) {
    this.key = key;
    this.wanted = wanted;
    this.time = time;
    this.apart = apart;
    this.there = there;
  }
}
class _Need {
  constructor(key, wanted, margin, counted, beside) {
    this.key = key;
    this.wanted = wanted;
    this.margin = margin;
    this.counted = counted;
    this.beside = beside;
  }
  slack(seen, value) {
    let more;
    if ((this.key === "beside")) {
      return py.list(seen.apart(value, 0.0)).map((apart) => py.sub(apart, this.margin));
    }
    if ((this.key === "ahead")) {
      return py.list(seen.apart(this.beside, value)).map((apart) => py.sub(apart, this.margin));
    }
    more = (this.counted * py.sub(this.wanted, value));
    return py.list(seen.apart(0.0, 0.0)).map((apart) => py.add(py.sub(apart, this.margin), more));
  }
  kept(seen, value) {
    return (py.min(this.slack(seen, value)) > 0.0);
  }
}
export function shortage(walk, broken, margin, asked, end) {
  let _at, _room, about, at, contact, counted, kept, key, need, obstacle, rows, shares, start, there, tightest, times, when;
  [contact, obstacle] = py.list(broken);
  if ((contact.witness == null)) {
    return null;
  }
  [start, rows] = py.list([contact.value, py.list(contact.witness.benches).map((bench) => (bench - 1))]);
  kept = ((obstacle == null) ? margin : obstacle.margin);
  key = _lacking(new _Seen(walk, [start], rows, obstacle), kept, asked);
  counted = ((obstacle == null) ? 2.0 : 1.0);
  need = new _Need(key, py.at(asked, key), kept, counted, py.get(asked, "beside", 0.0));
  shares = py.tolist(py.linspace(0.0, 1.0, SAMPLES));
  times = py.list(shares).map((share) => py.add(start, (py.sub(end, start) * (share * share))));
  [_room, at] = py.list(_least(need, new _Seen(walk, times, rows, obstacle)));
  about = py.tolist(py.linspace(py.at(times, py.max((at - 1), 0)), py.at(times, py.min((at + 1), (SAMPLES - 1))), CLOSER));
  [_room, at] = py.list(_least(need, new _Seen(walk, about, rows, obstacle)));
  when = py.min(py.max(py.round(py.at(about, at), DECIMALS), start), end);
  tightest = new _Seen(walk, [when], rows, obstacle);
  [there, _at] = py.list(_least(need, tightest));
  if ((there >= need.wanted)) {
    return null;
  }
  return new Shortage(key, need.wanted, when, py.at(tightest.apart(0.0, 0.0), 0), there);
}
function _lacking(seen, margin, asked) {
  let aside, keys;
  keys = py.list(asked);
  if (!py.has(keys, "ahead")) {
    return py.at(keys, 0);
  }
  aside = py.sub(py.at(seen.apart(py.get(asked, "beside", 0.0), 0.0), 0), margin);
  return ((!py.has(keys, "beside") || (py.truth(seen.headed) && (aside > LEVEL))) ? "ahead" : "beside");
}
function _least(need, seen) {
  let _halving, broken, kept, least, middle, slack;
  [kept, broken] = py.list([0.0, need.wanted]);
  if (py.truth(need.kept(seen, broken))) {
    kept = broken;
  }
  else {
    if (!py.truth(need.kept(seen, kept))) {
      broken = kept;
    }
    else {
      for (_halving of py.iter(py.range(HALVINGS))) {
        middle = (0.5 * py.add(kept, broken));
        if (py.truth(need.kept(seen, middle))) {
          kept = middle;
        }
        else {
          broken = middle;
        }
      }
    }
  }
  slack = need.slack(seen, broken);
  least = py.min(slack);
  return [kept, py.next(py.list(py.enumerate(slack)).flatMap(([n, more]) => (((more <= py.add(least, LEVEL))) ? [n] : [])))];
}
