// @ts-nocheck
// Made from explain/room.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { named } from "./findings.js";
import { seconds } from "./number_format.js";
import { askedText, shownName } from "./room_levels.js";

const PLAIN = py.dict([["sway", N_("{value} cm to each side")], ["imprecision", N_("{value} cm to each side")], ["beside", N_("{value} cm on each side of a bench")], ["ahead", N_("{value} cm before the head")]]);
export function levelLine(level, asked = askedText) {
  let benches, contact, name, obstacle, text;
  name = shownName(level);
  if (py.truth(level.asked)) {
    name = py.filled(_("{name}: {asked}"), { name: name, asked: asked(level) });
  }
  if ((level.first == null)) {
    return py.filled(_("{name}: kept"), { name: name });
  }
  [contact, obstacle] = py.list(level.first);
  benches = ((contact.witness == null) ? [] : contact.witness.benches);
  if ((level.kept == null)) {
    text = _("{name}: too close to tell at t = {t} s");
  }
  else {
    if ((obstacle != null)) {
      text = _("{name}: first broken at t = {t} s by bench {a} at {obstacle}");
    }
    else {
      text = _("{name}: first broken at t = {t} s by benches {a} and {b}");
      if (py.truth(level.asked)) {
        text = _("{name}: first broken at t = {t} s by benches {a} and {b}; side by side they need {between} m between them");
      }
      if (((level.short != null) && (level.short.key === "ahead"))) {
        text = _("{name}: first broken at t = {t} s by benches {a} and {b}; what lacks is the room before the head's bench");
      }
    }
  }
  return py.filled(text, { name: name, t: seconds(contact.value), a: (py.truth(benches) ? py.at(benches, 0) : 0), b: (py.truth(benches) ? py.at(benches, -1) : 0), obstacle: ((obstacle == null) ? "" : named(obstacle)), between: `${py.format(level.between, `g`)}` });
}
export function plainAsked(level) {
  let one, said, text, what;
  said = [];
  for (one of py.iter(level.asked)) {
    text = _("{what}, assumption");
    if (py.truth(one.source)) {
      text = _("{what}, {source}");
    }
    what = py.filled(_(py.at(PLAIN, one.key)), { value: `${py.format(py.round((100.0 * one.value), 6), `g`)}` });
    py.append(said, py.filled(text, { what: what, source: one.source }));
  }
  return py.join(_("; "), said);
}
