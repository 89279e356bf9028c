// @ts-nocheck
// Made from analysis/left_open.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { N_ } from "../words.js";
import { Finding, nameWords } from "./findings.js";
import { Obstacle } from "./obstacle.js";
import { QUANTITIES } from "./speed.js";

export const DEAR = N_("that takes more work than a question may");
export const HIDDEN = N_("rounding hides it");
export const PROOFS = py.dict([["contact", N_("whether and when benches touch")], ["clearance", N_("least clearance")], ["speed", N_("greatest speed")]]);
export function openFinding(asked, limit, why) {
  let kind, name, quantity, sentence, words;
  if ((asked instanceof Obstacle)) {
    sentence = N_("whether benches keep their distance from {name} is undecided: {why}");
    [kind, words] = py.list([((asked.kind === "venue") ? "venue" : "obstacle"), nameWords(asked)]);
    [limit, name] = py.list([asked.margin, asked.name]);
  }
  else {
    if (py.has(QUANTITIES, asked)) {
      sentence = N_("whether the {what} keeps to {limit} {unit} is undecided: {why}");
      [quantity, kind, name] = py.list([py.at(QUANTITIES, asked), asked, ""]);
      words = py.dict([["what", quantity.text], ["unit", quantity.unit], ["limit", `${py.format(limit, `.6g`)}`]]);
    }
    else {
      sentence = N_("whether there is room for people is undecided: {why}");
      [kind, words, name] = py.list([asked, py.dict([]), ""]);
    }
  }
  words = py.merge(words, py.dict([["why", why]]));
  return new Finding(kind, null, [], 0.0, limit, sentence, words, false, name);
}
