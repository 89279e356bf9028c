// @ts-nocheck
// Made from analysis/unfinished.py by tools/make_twins.py; to make it again: make types

import { py } from "../compute/python.js";
import { _ } from "../words.js";

export class Unfinished {
  constructor(way, end) {
    this.way = way;
    this.end = end;
  }
  get text() {
    let text;
    if ((this.end == null)) {
      return this.told;
    }
    text = _("the dance ends before the tail is out of the turn: let the walk end at {end} s or later");
    return py.filled(text, { end: `${py.format(this.end, `.1f`)}` });
  }
  get told() {
    let text;
    text = _("the dance ends before the tail is out of the turn: the head lacks {way} m");
    return py.filled(text, { way: `${py.format(this.way, `.1f`)}` });
  }
}
