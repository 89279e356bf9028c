// @ts-nocheck
// Made from errors.py by tools/make_twins.py; to make it again: make generate

import { BenchDragonError, InputError, _with } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";

export class WalkError extends BenchDragonError {
  constructor(status, bench, s, head, size, t = /** @type {any} */ (null)) {
    super(status, bench, s, head, size, t);
    this.status = status;
    this.bench = bench;
    this.s = s;
    this.head = head;
    this.size = size;
    this.t = t;
  }
  at(t) {
    let when;
    when = (py.isfinite(t) ? t : null);
    return new WalkError(this.status, this.bench, this.s, this.head, this.size, when);
  }
  get message() {
    return advice(this);
  }
}
const ADVICE = py.dict([[1, N_("{when} the head would stand at s = {s} m, before the route starts; begin the walk later or begin the route with a line or an inward spiral, which run on behind their start")], [2, N_("{when} the head would walk past the end of the route, which is {size} long (s = {s} m); end the walk earlier or lengthen the route")], [3, N_("{when} bench {bench} has no place: its front handle stands at s = {s} m and no point of the route behind it is one link ({size}) away; shorten the dragon, or begin the route with a line or an inward spiral, which run on behind their start")], [4, N_("{when} bench {bench} (link {size}) folds: with its front handle at s = {s} m it stands square to the route, where the speed ratio runs away; end the walk before that (in a plan by disc.radius or walk.end), or use gentler curves or shorter benches")], [5, N_("{when} bench {bench} cannot follow an arc: with its front handle at s = {s} m its link ({size}) is longer than the arc's diameter; use a larger radius or shorter benches")]]);
function advice(error) {
  let text, when;
  if ((error.t == null)) {
    when = py.filled(_("with the head at s = {head} m"), { head: `${py.format(error.head, `.6g`)}` });
  }
  else {
    when = py.filled(_("at t = {t} s"), { t: `${py.format(error.t, `.6g`)}` });
  }
  text = _(py.at(ADVICE, error.status));
  return py.filled(text, { when: when, bench: error.bench, s: `${py.format(error.s, `.6g`)}`, size: error.size });
}
export function finite(name, value, unit = "") {
  let number, text;
  number = asNumber(name, value);
  if (!py.isfinite(number)) {
    text = _("{name} must be finite, not {value}");
    throw new InputError(py.filled(text, { name: name, value: _with(value, unit) }));
  }
  return number;
}
export function positive(name, value, unit = "") {
  let number, text;
  number = finite(name, value, unit);
  if ((number <= 0.0)) {
    text = _("{name} must be positive, not {value}");
    throw new InputError(py.filled(text, { name: name, value: _with(value, unit) }));
  }
  return number;
}
export function notNegative(name, value, unit = "") {
  let number, text;
  number = finite(name, value, unit);
  if ((number < 0.0)) {
    text = _("{name} must not be negative, but is {value}");
    throw new InputError(py.filled(text, { name: name, value: _with(value, unit) }));
  }
  return number;
}
export function inOrder(start, end) {
  let text;
  if ((finite("end", end, "s") < finite("start", start, "s"))) {
    text = _("the end ({end} s) must not come before the start ({start} s)");
    throw new InputError(py.filled(text, { end: `${py.format(end, `g`)}`, start: `${py.format(start, `g`)}` }));
  }
}
const asNumber = (_name, value) => value;
