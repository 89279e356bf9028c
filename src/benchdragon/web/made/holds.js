// @ts-nocheck
// Made from model/holds.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

export class Hold {
  constructor(way = /** @type {any} */ (null), at = /** @type {any} */ (null), seconds = Infinity) {
    this.way = way;
    this.at = at;
    this.seconds = seconds;
  }
}
