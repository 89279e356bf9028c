// @ts-nocheck
// Made from plans/source.py by tools/make_twins.py; to make it again: make generate

import { InputError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";

const MOST_SIGNS = 200;
const MOST_FAULTS = 20;
export class Fault {
  constructor(key, text) {
    this.key = key;
    this.text = text;
  }
  get message() {
    let said;
    said = (py.startswith(this.text, this.key) ? this.text : `${py.str(this.key)}: ${py.str(this.text)}`);
    if ((py.len(this.key) > MOST_SIGNS)) {
      said = py.replace(said, this.key, `${py.str(py.slice(this.key, null, MOST_SIGNS))}...`);
    }
    return said;
  }
}
export class KeyedError extends InputError {
  constructor(faults) {
    super(py.join("\n", py.list(faults).map((fault) => py.str(fault))));
    this.faults = py.list(faults);
  }
}
export class Faults {
  constructor() {
    this.found = [];
  }
  tried(key, make) {
    try {
      return make();
    } catch (error) {
      if (error instanceof KeyedError) {
        this.found = py.extend(this.found, error.faults);
      } else
      if (error instanceof InputError) {
        py.append(this.found, new Fault(key, py.str(error)));
      } else
      throw error;
    }
    return null;
  }
}
export class Source {
  constructor(name = "plan", text = "", settings = [], folder = /** @type {any} */ (null), rounded = [], passed = [], setBy = "--set") {
    this.name = name;
    this.text = text;
    this.settings = settings;
    this.folder = folder;
    this.rounded = rounded;
    this.passed = passed;
    this.set_by = setBy;
  }
  sentences(faults, others = 0) {
    let lines, more, said, told;
    [told, more] = py.list([py.slice(faults, null, MOST_FAULTS), py.add(py.len(py.slice(faults, MOST_FAULTS, null)), others)]);
    lines = linesOf(this.text, py.set_of(py.list(told).map((fault) => fault.key)));
    said = py.list(told).map((fault) => `${py.str(_place(this, fault.key, lines))}: ${py.str(fault)}`);
    if (py.truth(more)) {
      py.append(said, py.filled(_("and {count} more"), { count: more }));
    }
    return py.join("\n", said);
  }
}
const _place = (source) => source.name;
const linesOf = () => null;
