// @ts-nocheck
// Made from model/formations.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { Route, curvesOf } from "./curves.js";
import { finite } from "./errors.js";

const FormationKind = { COIL_IN: 0, COIL_OUT: 1, FIGURE_EIGHT: 2, THREE_PLUM_BLOSSOMS: 3, DOUBLE_DOOR: 4, STRAIGHT_DRAGON: 5, TAIL_SWING: 6 };
const MOST_PARTS = 128;
const PART_COLUMNS = 8;
class Size {
  constructor(text, least, most, unit = "m") {
    this.text = text;
    this.least = least;
    this.most = most;
    this.unit = unit;
  }
  static __fields__ = [{ name: "text", default: null }, { name: "least", default: null }, { name: "most", default: null }, { name: "unit", default: "m" }];
}
class Smaller {
  constructor(size, factor, than, written) {
    this.size = size;
    this.factor = factor;
    this.than = than;
    this.written = written;
  }
  *[Symbol.iterator]() {
    yield* [this.size, this.factor, this.than, this.written];
  }
  static __fields__ = [{ name: "size", default: null }, { name: "factor", default: null }, { name: "than", default: null }, { name: "written", default: null }];
}
const PITCH = new Size(N_("distance between neighbouring turns of the spiral"), 0.1, 100.0, "m");
const OUTER = new Size(N_("radius at the outer end of the coil"), 1.0, 1000.0, "m");
const INNER = new Size(N_("radius at the inner end of the coil"), 0.5, 1000.0, "m");
const ROUNDS = new Size(N_("how many times it is walked round"), 1, 20, "");
const COILED = [new Smaller("inner_radius", 1.0, "outer_radius", "outer_radius"), new Smaller("pitch", 1.0, "outer_radius", "outer_radius")];
export class SizeError extends InputError {
  constructor(size, text) {
    super(text);
    this.size = size;
  }
}
class Formation {
  get name() {
    return this.constructor.name;
  }
  get sizes() {
    return this.constructor.sizes;
  }
  static smaller = [];
  get smaller() {
    return this.constructor.smaller;
  }
  static tightest = [];
  get tightest() {
    return this.constructor.tightest;
  }
  __post_init__() {
    let factor, most, name, other, size, text, than, value, values;
    for ([name, size] of py.iter(py.items(this.sizes))) {
      value = finite(name, this[name], size.unit);
      if (!((size.least <= value) && (value <= size.most))) {
        throw new SizeError(name, py.filled(_("{name} of {formation} must lie in {least} .. {most}, not at {value}"), { name: name, formation: this.name, value: py.strip(`${py.format(value, `g`)} ${py.str(size.unit)}`), least: `${py.format(size.least, `g`)}`, most: py.strip(`${py.format(size.most, `g`)} ${py.str(size.unit)}`) }));
      }
      if ((!py.truth(size.unit) && !py.eq(value, py.int(value)))) {
        text = _("{name} of {formation} must be a whole number, not {value}");
        throw new SizeError(name, py.filled(text, { name: name, formation: this.name, value: `${py.format(value, `g`)}` }));
      }
    }
    for ([name, factor, other, than] of py.iter(this.smaller)) {
      [value, most] = py.list([this[name], (factor * this[other])]);
      if ((value >= most)) {
        text = _("{name} of {formation} ({value} m) must be smaller than {than} ({most} m)");
        values = py.dict([["value", `${py.format(value, `g`)}`], ["than", than], ["most", `${py.format(most, `g`)}`]]);
        throw new SizeError(name, py.filled(text, { name: name, formation: this.name, ...py.object(values) }));
      }
    }
  }
  static defaults() {
    return py.dict(py.list(this.__fields__).map((field) => [field.name, field.default]));
  }
  static of(said) {
    let told;
    told = py.dict(py.list(this.defaults()).map((name) => [name, py.get(said, name)]));
    return new this(...py.iter(py.list(py.items(told)).map(([name, of]) => ((of == null) ? py.at(this.defaults(), name) : of))));
  }
  static kind() {
    return py.at(FormationKind, py.replace(py.upper(this.name), "-", "_"));
  }
  build() {
    let count, parts, sizes;
    parts = py.empty([MOST_PARTS, PART_COLUMNS]);
    sizes = py.array(py.list(this.sizes).map((name) => this[name]), "d");
    count = py.entry("bd_formations_formation_parts", py.type(this).kind(), sizes, py.get(this, "clockwise", false), parts)[0];
    return new Route(curvesOf(py.slice(parts, null, count)));
  }
  get narrowest() {
    return py.min(this.tightest, (size) => this[size], "");
  }
  get least_radius() {
    return leastRadius(this.build());
  }
}
function leastRadius(route) {
  let _where, bend;
  [bend, _where] = py.list(py.entry("bd_route_parts_tightest_bend", route.rows));
  return ((bend > 0.0) ? (1.0 / bend) : Infinity);
}
class CoilIn extends Formation {
  static name = "coil-in";
  get name() {
    return this.constructor.name;
  }
  static sizes = py.dict([["pitch", PITCH], ["outer_radius", OUTER], ["inner_radius", INNER]]);
  get sizes() {
    return this.constructor.sizes;
  }
  static smaller = COILED;
  get smaller() {
    return this.constructor.smaller;
  }
  static tightest = ["inner_radius"];
  get tightest() {
    return this.constructor.tightest;
  }
  constructor(pitch = 0.8, outerRadius = 12.0, innerRadius = 3.0, clockwise = true) {
    super();
    this.pitch = pitch;
    this.outer_radius = outerRadius;
    this.inner_radius = innerRadius;
    this.clockwise = clockwise;
    this.__post_init__();
  }
  static __fields__ = [{ name: "pitch", default: 0.8 }, { name: "outer_radius", default: 12.0 }, { name: "inner_radius", default: 3.0 }, { name: "clockwise", default: true }];
}
class CoilOut extends Formation {
  static name = "coil-out";
  get name() {
    return this.constructor.name;
  }
  static sizes = py.dict([["pitch", PITCH], ["inner_radius", INNER], ["outer_radius", OUTER]]);
  get sizes() {
    return this.constructor.sizes;
  }
  static smaller = COILED;
  get smaller() {
    return this.constructor.smaller;
  }
  static tightest = ["inner_radius"];
  get tightest() {
    return this.constructor.tightest;
  }
  constructor(pitch = 0.8, innerRadius = 3.0, outerRadius = 12.0, clockwise = true) {
    super();
    this.pitch = pitch;
    this.inner_radius = innerRadius;
    this.outer_radius = outerRadius;
    this.clockwise = clockwise;
    this.__post_init__();
  }
  static __fields__ = [{ name: "pitch", default: 0.8 }, { name: "inner_radius", default: 3.0 }, { name: "outer_radius", default: 12.0 }, { name: "clockwise", default: true }];
}
class DoubleDoor extends Formation {
  static name = "double-door";
  get name() {
    return this.constructor.name;
  }
  static sizes = py.dict([["pitch", PITCH], ["outer_radius", OUTER], ["inner_radius", INNER], ["between", new Size(N_("distance between the outer circles of the two coils"), 0.0, 1000.0)]]);
  get sizes() {
    return this.constructor.sizes;
  }
  static smaller = COILED;
  get smaller() {
    return this.constructor.smaller;
  }
  static tightest = ["inner_radius"];
  get tightest() {
    return this.constructor.tightest;
  }
  constructor(pitch = 0.8, outerRadius = 9.0, innerRadius = 2.5, between = 2.0, clockwise = true) {
    super();
    this.pitch = pitch;
    this.outer_radius = outerRadius;
    this.inner_radius = innerRadius;
    this.between = between;
    this.clockwise = clockwise;
    this.__post_init__();
  }
  static __fields__ = [{ name: "pitch", default: 0.8 }, { name: "outer_radius", default: 9.0 }, { name: "inner_radius", default: 2.5 }, { name: "between", default: 2.0 }, { name: "clockwise", default: true }];
}
class FigureEight extends Formation {
  static name = "figure-eight";
  get name() {
    return this.constructor.name;
  }
  static sizes = py.dict([["radius", new Size(N_("radius of the bends"), 0.5, 1000.0)], ["rounds", ROUNDS]]);
  get sizes() {
    return this.constructor.sizes;
  }
  static tightest = ["radius"];
  get tightest() {
    return this.constructor.tightest;
  }
  constructor(radius = 40.0, rounds = 1, clockwise = true) {
    super();
    this.radius = radius;
    this.rounds = rounds;
    this.clockwise = clockwise;
    this.__post_init__();
  }
  static __fields__ = [{ name: "radius", default: 40.0 }, { name: "rounds", default: 1 }, { name: "clockwise", default: true }];
  get loop() {
    return ((2.0 + (1.5 * Math.PI)) * this.radius);
  }
}
class ThreePlumBlossoms extends Formation {
  static name = "three-plum-blossoms";
  get name() {
    return this.constructor.name;
  }
  static sizes = py.dict([["radius", new Size(N_("radius of the petals"), 0.5, 1000.0)], ["waist", new Size(N_("radius of the bends between the petals"), 0.5, 1000.0)], ["rounds", ROUNDS]]);
  get sizes() {
    return this.constructor.sizes;
  }
  static smaller = [new Smaller("radius", (py.sqrt(3.0) / (2.0 - py.sqrt(3.0))), "waist", "6.46 * waist")];
  get smaller() {
    return this.constructor.smaller;
  }
  static tightest = ["waist", "radius"];
  get tightest() {
    return this.constructor.tightest;
  }
  constructor(radius = 18.0, waist = 6.0, rounds = 1, clockwise = true) {
    super();
    this.radius = radius;
    this.waist = waist;
    this.rounds = rounds;
    this.clockwise = clockwise;
    this.__post_init__();
  }
  static __fields__ = [{ name: "radius", default: 18.0 }, { name: "waist", default: 6.0 }, { name: "rounds", default: 1 }, { name: "clockwise", default: true }];
}
class StraightDragon extends Formation {
  static name = "straight-dragon";
  get name() {
    return this.constructor.name;
  }
  static sizes = py.dict([["length", new Size(N_("length of the line"), 1.0, 10000.0)]]);
  get sizes() {
    return this.constructor.sizes;
  }
  constructor(length = 300.0) {
    super();
    this.length = length;
    this.__post_init__();
  }
  static __fields__ = [{ name: "length", default: 300.0 }];
}
class TailSwing extends Formation {
  static name = "tail-swing";
  get name() {
    return this.constructor.name;
  }
  static sizes = py.dict([["swing", new Size(N_("how wide the tail swings from side to side"), 0.1, 1000.0)], ["radius", new Size(N_("radius of the bends"), 0.5, 1000.0)], ["swings", new Size(N_("how many times it swings from one side to the other"), 1, 100, "")], ["run", new Size(N_("length of the straight lines before and behind the bends"), 0.0, 10000.0)]]);
  get sizes() {
    return this.constructor.sizes;
  }
  static smaller = [new Smaller("swing", 2.0, "radius", "2 * radius")];
  get smaller() {
    return this.constructor.smaller;
  }
  static tightest = ["radius"];
  get tightest() {
    return this.constructor.tightest;
  }
  constructor(swing = 4.5, radius = 5.0, swings = 6, run = 260.0, clockwise = true) {
    super();
    this.swing = swing;
    this.radius = radius;
    this.swings = swings;
    this.run = run;
    this.clockwise = clockwise;
    this.__post_init__();
  }
  static __fields__ = [{ name: "swing", default: 4.5 }, { name: "radius", default: 5.0 }, { name: "swings", default: 6 }, { name: "run", default: 260.0 }, { name: "clockwise", default: true }];
}
export const FORMATIONS = py.dict([["coil-in", CoilIn], ["coil-out", CoilOut], ["figure-eight", FigureEight], ["three-plum-blossoms", ThreePlumBlossoms], ["double-door", DoubleDoor], ["straight-dragon", StraightDragon], ["tail-swing", TailSwing]]);
