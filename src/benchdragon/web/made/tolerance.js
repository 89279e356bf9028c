// @ts-nocheck
// Made from solve/tolerance.py by tools/make_twins.py; to make it again: make generate

import { InputError, UnsureError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { WalkError, notNegative } from "./errors.js";
import { answered } from "./random_dance.js";
import { foundLimit } from "./size.js";
import { silent } from "./stages.js";

const whole = (_name, value) => value;
const MOST_SEED = 9007199254740991;
const CONFIDENCE = 0.95;
export const RISKS = [0.5, 0.1, 0.05, 0.02];
export class Deviations {
  constructor(aside = 0.0, stray = 0.0, play = 0.0, height = 0.0, length = 0.0, width = 0.0) {
    this.aside = aside;
    this.stray = stray;
    this.play = play;
    this.height = height;
    this.length = length;
    this.width = width;
    this.__post_init__();
  }
  __post_init__() {
    let name, value;
    for ([name, value] of py.iter(py.items(py.vars(this)))) {
      if ((notNegative(name, value, "m") > 1.0)) {
        throw new InputError(py.filled(_("{name} must be at most 1 m"), { name: name }));
      }
    }
  }
}
export const ALL = [0.02, 0.02, 0.01, 0.1, 0.02, 0.005];
export class Draw {
  constructor(deviations, seed, number) {
    this.deviations = deviations;
    this.seed = seed;
    this.number = number;
    this.__post_init__();
  }
  __post_init__() {
    whole("seed", this.seed, 0, MOST_SEED);
  }
  get _by() {
    return py.list(py.values(py.vars(this.deviations)));
  }
  async ask(plan, what, guess = NaN) {
    let limits;
    limits = py.dict([[0, what], [4, guess], [5, this.seed], [6, this.number], ...py.items(py.dict(py.enumerate(this._by, 8)))]);
    return (await answered(plan, limits));
  }
}
export async function touches(plan, draw) {
  return py.scoped(async () => {
    try {
      return ((await draw.ask(plan, 1)) > 0.0);
    } catch (error) {
      if (error instanceof WalkError) {
        return true;
      } else
      throw error;
    }
  });
}
export async function neededPitch(plan, draw, guess) {
  return py.scoped(async () => {
    return (await draw.ask(plan.with_value("route.pitch", guess), 0, guess));
  });
}
export function chance(hits, count, confidence = CONFIDENCE) {
  return [(hits / count), ...py.iter(py.entry("bd_binomial_chance_bounds", hits, count, confidence))];
}
export class Tolerance {
  constructor(deviations, seed, exact, needed, hits = /** @type {any} */ (null)) {
    this.deviations = deviations;
    this.seed = seed;
    this.exact = exact;
    this.needed = needed;
    this.hits = hits;
  }
  touching(pitch = /** @type {any} */ (null), confidence = CONFIDENCE) {
    let count, hits;
    count = py.len(this.needed);
    if ((pitch != null)) {
      hits = py.sub(count, py.int(py.searchsorted(this.needed, pitch, "right")));
    }
    else {
      if ((this.hits != null)) {
        hits = this.hits;
      }
      else {
        throw new InputError(_("the dances were not walked at the plan's own pitch"));
      }
    }
    return chance(hits, count, confidence);
  }
  pitch_for(risk, confidence = CONFIDENCE) {
    let _least, allowed, count;
    count = py.len(this.needed);
    [allowed, _least] = py.list(py.entry("bd_binomial_ranks", count, risk, confidence));
    return ((allowed >= 0) ? py.float(py.at(this.needed, py.sub((count - 1), allowed))) : Infinity);
  }
}
export async function exactPitch(plan, progress = silent) {
  let found;
  if (((plan.route.kind === "spiral-in") && (plan.disc.radius == null) && (plan.walk.end == null))) {
    throw new InputError(_("say how far in the head comes: set disc.radius=4.5, for example"));
  }
  if ((py.len(plan.dragon.build()) < 3)) {
    throw new InputError(_("no benches of this dragon can touch: no two are non-adjacent"));
  }
  found = (await foundLimit(plan.without_square(), "pitch", undefined, undefined, progress));
  if (py.has(py.set_of(["found", "unlimited"]), found.status)) {
    return found.value;
  }
  throw new UnsureError(_("no pitch was found with which this dragon is free of contact"));
}
