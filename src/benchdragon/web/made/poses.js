// @ts-nocheck
// Made from kernels/route_parts.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

export class Pose {
  constructor(x, y, heading) {
    this.x = x;
    this.y = y;
    this.heading = heading;
  }
  *[Symbol.iterator]() {
    yield* [this.x, this.y, this.heading];
  }
}
