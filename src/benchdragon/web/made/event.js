// @ts-nocheck
// Made from plans/event.py by tools/make_twins.py; to make it again: make generate

import { ValueError, py } from "../compute/python.js";
import { _ } from "../words.js";

export function entrance(numbers) {
  let said;
  if (((py.len(numbers) > 2) && (py.at(numbers, 2) <= 0.0))) {
    said = _("expected a width of more than 0 m, not {value}");
    throw new ValueError(py.filled(said, { value: `${py.format(py.at(numbers, 2), `g`)}` }));
  }
  return numbers;
}
export class EventTable {
  get places() {
    return py.list(this.entrances).map((numbers) => [py.at(numbers, 0), py.at(numbers, 1)]);
  }
  get widths() {
    return py.list(this.entrances).map((numbers) => ((py.len(numbers) > 2) ? py.at(numbers, 2) : null));
  }
}
