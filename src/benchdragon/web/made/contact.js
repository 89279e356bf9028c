// @ts-nocheck
// Made from analysis/contact.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { Answer } from "./answer.js";
import { TOLERANCES, contactSearch } from "./contact_search.js";
import { silent } from "./stages.js";

const askedOf = (of, start, end, walk = of) => [walk, start, end];
const FRAYED = 1e-05;
const NONE = new Answer(Infinity, Infinity, Infinity, "m", "found", null, [], 0, 0.0);
const MOST_GRAZES = 100;
class Window {
  constructor(opens, closes) {
    this.opens = opens;
    this.closes = closes;
  }
}
export async function contactWindows(walk, start = /** @type {any} */ (null), end = /** @type {any} */ (null), margin = 0.0, most = 1000, progress = silent) {
  return py.scoped(async () => {
    let search;
    [walk, start, end] = py.list(askedOf(walk, start, end));
    search = contactSearch(walk, start, end, margin, progress, true);
    try {
      return (await _windows(search, most));
    } finally {
      search.free();
    }
  });
}
async function _windows(search, most, sure = false) {
  let ending, found, touching, windows;
  windows = [];
  while (((py.len(windows) < most) && !(py.truth(sure) && py.truth(windows) && (py.at(windows, -1).opens.status === "found")))) {
    touching = (py.bool(windows) && (py.at(windows, -1).closes == null));
    ending = (await search.find((py.truth(touching) ? 1 : 0)));
    if (py.eq(ending, 0)) {
      break;
    }
    found = search.moment((py.eq(ending, 1) ? "found" : "undecided"));
    _takeDown(windows, found, touching);
  }
  return windows;
}
function _takeDown(windows, found, touching) {
  if ((py.truth(touching) && (found.status === "found"))) {
    py.set(windows, -1, new Window(py.at(windows, -1).opens, found));
  }
  else {
    if ((!py.truth(touching) && (found.status === "found"))) {
      py.append(windows, new Window(found, null));
    }
    else {
      if ((!py.truth(touching) && py.truth(windows) && py.truth(_belongs(py.at(windows, -1), found)))) {
        py.set(windows, -1, _widened(py.at(windows, -1), found));
      }
      else {
        if (!py.truth(touching)) {
          py.append(windows, new Window(found, found));
        }
      }
    }
  }
}
function _belongs(window, graze) {
  return ((window.closes != null) && (py.sub(graze.lower, window.closes.upper) <= FRAYED));
}
function _widened(window, graze) {
  let opens;
  if ((window.opens.status === "undecided")) {
    opens = py.replaced(window.opens, { upper: graze.upper });
    return new Window(opens, opens);
  }
  return new Window(window.opens, ((window.closes == null) ? null : py.replaced(window.closes, { upper: graze.upper })));
}
async function firstContact(walk, start = /** @type {any} */ (null), end = /** @type {any} */ (null), margin = 0.0, progress = silent) {
  return py.scoped(async () => {
    let search, windows;
    [walk, start, end] = py.list(askedOf(walk, start, end));
    search = contactSearch(walk, start, end, margin, progress);
    try {
      windows = (await _windows(search, 1));
    } finally {
      search.free();
    }
    return (py.truth(windows) ? py.at(windows, 0).opens : null);
  });
}
export async function firstSureContact(walk, start, end, margin, search = /** @type {any} */ (null), progress = silent) {
  return py.scoped(async () => {
    let again, first, windows;
    if ((search == null)) {
      first = (await firstContact(walk, start, end, margin, progress));
    }
    else {
      first = search(walk, start, end, margin, progress);
    }
    if (((first == null) || (first.status !== "undecided"))) {
      return first;
    }
    again = contactSearch(walk, start, end, margin, silent);
    try {
      windows = (await _windows(again, MOST_GRAZES, true));
    } finally {
      again.free();
    }
    return py.next(py.list(windows).flatMap((window) => (((window.opens.status === "found")) ? [window.opens] : [])), first);
  });
}
export async function leastClearance(walk, start = /** @type {any} */ (null), end = /** @type {any} */ (null), within = Infinity, tolerances = TOLERANCES, progress = silent) {
  return py.scoped(async () => {
    let bracket, search;
    [walk, start, end] = py.list(askedOf(walk, start, end));
    search = contactSearch(walk, start, end, 0.0, progress, undefined, tolerances);
    try {
      if ((py.len(walk.dragon) < 3)) {
        return NONE;
      }
      if (py.eq((await search.find(2, [within])), 34)) {
        bracket = [Infinity, py.float(py.at(search.figures, 10)), Infinity];
        return search.answer(bracket, "m", "found", false);
      }
      return _clearance(search);
    } finally {
      search.free();
    }
  });
}
export async function seenClearance(walk, start, end, floor) {
  return py.scoped(async () => {
    let search;
    search = contactSearch(walk, start, end, 0.0, silent);
    try {
      if ((py.len(walk.dragon) < 3)) {
        return NONE;
      }
      (await search.find(4));
      return _clearance(search, floor);
    } finally {
      search.free();
    }
  });
}
function _clearance(search, floor = /** @type {any} */ (null)) {
  let best, least, upper;
  best = py.float(py.at(search.figures, 9));
  least = ((floor == null) ? py.float(py.at(search.figures, 10)) : py.min(floor, best));
  upper = upperEnd(py.or(best, () => search.witness().gap), search.off);
  return search.answer([best, py.max(py.sub(least, search.off), 0.0), upper], "m", "found");
}
function upperEnd(gap, off) {
  return ((gap > 0.0) ? py.add(gap, off) : py.max(py.add(gap, (py.sqrt(2.0) * off)), 0.0));
}
