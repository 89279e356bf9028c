// @ts-nocheck
// Made from plans/tables.py by tools/make_twins.py; to make it again: make generate

import { SizeError } from "../compute/dragon.js";
import { InputError, brief } from "../compute/error_kinds.js";
import { _built } from "../compute/plan_parts.js";
import { ValueError, py } from "../compute/python.js";
import { _ } from "../words.js";
import { Arc, Clothoid, Line, LogSpiral, Spiral } from "./curves.js";
import { SpeedProfile } from "./profile.js";
import { Fault, KeyedError } from "./source.js";
import { threePieces, twoArcs } from "./turns.js";

const ROOMY = 0.9;
export function oneLine(text) {
  let said;
  if ((py.truth(text) && (py.isspace(text) || !py.isprintable(text)))) {
    said = _("expected text that can be printed on one line, not {text}");
    throw new ValueError(py.filled(said, { text: brief(text) }));
  }
  return text;
}
export class DragonTable {
  build() {
    let bench, keys, size, text;
    try {
      return _built(this);
    } catch (error) {
      if (error instanceof SizeError) {
        keys = py.dict([]);
        for ([bench, size, text] of py.iter(error.faults)) {
          py.setdefault(keys, this._key(bench, size), text);
        }
        throw new KeyedError(py.list(py.items(keys)).map((each) => new Fault(...py.iter(each))));
      } else
      throw error;
    }
  }
  _key(bench, size) {
    let entry, last, one, place;
    for ([entry, one] of py.iter(py.enumerate(this.bench))) {
      if ((bench < one.count)) {
        return `dragon.bench.${py.str(entry)}.${py.str(size)}`;
      }
      bench = py.sub(bench, one.count);
    }
    last = (this.benches - 1);
    place = ((bench === 0) ? "head_" : (py.eq(bench, last) ? "tail_" : "body_"));
    return `dragon.${py.str(((size === "length") ? place : ""))}${py.str(size)}`;
  }
}
class CurvePart {
  
}
export class LinePart extends CurvePart {
  build() {
    return new Line(this.length);
  }
}
export class ArcPart extends CurvePart {
  build() {
    return new Arc(this.radius, py.radians(this.angle), undefined, undefined, undefined, true);
  }
}
export class ClothoidPart extends CurvePart {
  build() {
    return new Clothoid(this.length, this.start_curvature, this.end_curvature);
  }
}
export class SpiralPart extends CurvePart {
  build() {
    let ends, inward, mirrored;
    inward = (this.end_radius < this.start_radius);
    [ends, mirrored] = py.list([[this.start_radius, this.end_radius], !py.eq(inward, this.clockwise)]);
    return Spiral.between(this.pitch, ...py.iter(ends), [0.0, 0.0], 0.0, mirrored);
  }
}
export class LogSpiralPart extends CurvePart {
  build() {
    return new LogSpiral(this.length, this.start_curvature, this.end_curvature);
  }
}
export class TurnTable {
  build(pitch, disc) {
    let bend, entry, exit, radii, radius;
    entry = ((this.entry_radius == null) ? disc : this.entry_radius);
    exit = ((this.exit_radius == null) ? entry : this.exit_radius);
    if ((this.family === "arc-arc")) {
      return twoArcs(pitch, entry, exit, this.ratio, this.ease);
    }
    radii = this.radii;
    if ((radii == null)) {
      radius = (ROOMY * py.min(twoArcs(pitch, entry, exit, 1.0).least_radius, (0.5 * disc)));
      radii = [radius, radius];
    }
    bend = ((this.family === "arc-arc-arc") ? this.curvature : 0.0);
    return threePieces(pitch, entry, exit, radii, bend, this.ease);
  }
}
export class WalkTable {
  build() {
    let key, knots;
    knots = py.or(this.profile, () => [[0.0, this.speed]]);
    try {
      return new SpeedProfile(py.tuple(py.list(knots).map(([time, _v]) => time)), py.tuple(py.list(knots).map(([_t, speed]) => speed)));
    } catch (error) {
      if (error instanceof InputError) {
        key = (py.truth(this.profile) ? "walk.profile" : "walk.speed");
        throw new KeyedError([new Fault(key, py.str(error))]);
      } else
      throw error;
    }
  }
}
