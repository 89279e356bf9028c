// @ts-nocheck
// Made from surveys/alignment.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

export class Absorbed {
  constructor(joints, adjusted = 0, gap = 0.0, kink = 0.0, shift = 0.0, turn = 0.0) {
    this.joints = joints;
    this.adjusted = adjusted;
    this.gap = gap;
    this.kink = kink;
    this.shift = shift;
    this.turn = turn;
  }
}
