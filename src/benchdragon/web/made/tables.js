// @ts-nocheck
// Made from plans/tables.py by tools/make_twins.py; to make it again: make generate

import { brief } from "../compute/errors.js";
import { ValueError, py } from "../compute/python.js";
import { _ } from "../words.js";
import { Arc, Clothoid, Line, LogSpiral, Spiral } from "./curves.js";
import { threePieces, twoArcs } from "./turns.js";

const ROOMY = 0.9;
export function oneLine(text) {
  if ((py.truth(text) && (py.isspace(text) || !py.isprintable(text)))) {
    throw new ValueError(py.filled(_("wanted text that can be printed on one line, not {text}"), { text: brief(text) }));
  }
  return text;
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
    return new Arc(this.radius, py.radians(this.angle));
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
