// Contact over time: the first, all of them, and the least clearance of a walk. Twin of
// analysis/contact.py.

import { answered } from "./answer.js";
import { OverBudgetError, aside } from "./budget.js";
import { ANALYSIS_CONTACT, LOW_POINTS, SEARCH } from "./constants.js";
import { withContactSearch } from "./contact_search.js";
import { lowPair, tightestPairs } from "./distance.js";
import { withArena } from "./arena.js";
import { silent } from "./tick.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./contact_search.js").ContactSearch} ContactSearch */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

/**
 * A span of time through which some pair of benches touches (or is nearer than the margin); its opening
 * is "undecided" for a graze that rounding leaves open, its closing null if it lasts to the end.
 * @typedef {{ opens: Answer, closes: Answer | null }} Window
 */

/**
 * The least distance seen, m, at which head position, of which benches (rows, from 0); no pair is nearer
 * than `floor`.
 * @typedef {{ distance: number, where: number, pair: [number, number], floor: number }} Best
 */

const { FRAYED, FIRST_REACH, WIDER, MOST_GRAZES, REFINING, REFINING_ON } = ANALYSIS_CONTACT;
/** Widths of brackets of clearances, m: the first that can be. @type {number[]} */
export const TOLERANCES = ANALYSIS_CONTACT.TOLERANCES;
const { MOST_SAMPLED } = LOW_POINTS;
const NONE = answered(Infinity, Infinity, Infinity, "m");

/**
 * All spans of time in start..end, s, in which two non-adjacent benches are nearer than margin, m.
 *
 * Never late and none left out: what lies outside of all windows is clear by bounds. Stops after `most`.
 * @param {Walk} walk
 * @param {number} start @param {number} end
 * @param {{ margin?: number, most?: number, progress?: Progress }} [options]
 */
export function contactWindows(walk, start, end, { margin = 0, most = 1000, progress = silent } = {}) {
  const all = (/** @type {ContactSearch} */ search) => windowsOf(search, most);
  return withContactSearch(walk, start, end, margin, progress, all, { whole: true });
}

/** The first windows that a search comes to, so many at most; if `sure`, none after one that is. @param {ContactSearch} search @param {number} most @param {boolean} [sure] */
async function windowsOf(search, most, sure = false) {
  const opened = touchingAtStart(search);
  /** @type {Window[]} */
  const windows = opened === null ? [] : [{ opens: opened, closes: null }];
  while (windows.length < most) {
    const last = windows[windows.length - 1];
    if (sure && last?.opens.status === "found") break;
    const touching = last !== undefined && last.closes === null;
    const [ending, note] = await search.search(touching ? SEARCH.TOUCH_END : SEARCH.FIRST_TOUCH);
    if (ending === SEARCH.CLEAR) break;
    const status = ending === SEARCH.FOUND ? "found" : "undecided";
    const [lower, upper] = [note[SEARCH.LOWER], note[SEARCH.UPPER]];
    takeDown(windows, search.answerAt(lower, upper, status, ...search.pair(note)), touching);
  }
  return windows;
}

/** Add to `windows` what opens, closes or grazes. @param {Window[]} windows @param {Answer} found @param {boolean} touching */
function takeDown(windows, found, touching) {
  const last = windows.length - 1;
  if (touching && found.status === "found")
    windows[last] = { opens: windows[last].opens, closes: found };
  else if (!touching && found.status === "found") windows.push({ opens: found, closes: null });
  else if (!touching && windows.length && belongs(windows[last], found))
    windows[last] = widened(windows[last], found);
  else if (!touching) windows.push({ opens: found, closes: found });
}

/** Whether a graze is but the frayed end of a window just closed. @param {Window} window @param {Answer} graze */
function belongs({ closes }, graze) {
  return closes !== null && graze.lower - closes.upper <= FRAYED;
}

/** A window with a graze joined to its end; a graze itself if it was one. @param {Window} window @param {Answer} graze */
function widened({ opens, closes }, { upper }) {
  if (opens.status === "undecided") {
    const graze = { ...opens, upper };
    return { opens: graze, closes: graze };
  }
  return { opens, closes: closes && { ...closes, upper } };
}

/** The contact in which a walk starts, if it does. @param {ContactSearch} search */
function touchingAtStart(search) {
  const [near] = tightestAt(search);
  if (!near) return null;
  const [i, j] = near.benches.map((number) => number - 1);
  const off = search.offAt(search.start, i, j);
  if (near.distance > search.margin - off) return null;
  search.noteOff(off);
  return search.answerAt(search.start, search.start, "found", i, j);
}

/** The tightest pair at the start, if there is one. @param {ContactSearch} search */
function tightestAt({ walk, start }) {
  return withArena(walk.engine, (arena) =>
    tightestPairs(walk.placement(arena, [start], { throws: false })),
  );
}

/**
 * The first time in start..end, s, at which two non-adjacent benches touch, or are nearer than a margin,
 * m; null if never. All is clear up to `lower`, and at `upper` a pair surely is; "undecided" is a graze
 * within rounding.
 * @param {Walk} walk
 * @param {number} start @param {number} end
 * @param {{ margin?: number, progress?: Progress }} [options]
 */
export async function firstContact(walk, start, end, { margin = 0, progress = silent } = {}) {
  const one = (/** @type {ContactSearch} */ search) => windowsOf(search, 1);
  const [first] = await withContactSearch(walk, start, end, margin, progress, one);
  return first ? first.opens : null;
}

/**
 * `firstContact`, or if that is a graze the first that is none, if there is one.
 * @param {Walk} walk
 * @param {number} start @param {number} end
 * @param {{ margin: number, progress?: Progress }} options
 */
export async function firstSureContact(walk, start, end, { margin, progress = silent }) {
  const first = await firstContact(walk, start, end, { margin, progress });
  if (first === null || first.status !== "undecided") return first;
  const again = () => progress(1, "");
  const sure = (/** @type {ContactSearch} */ search) => windowsOf(search, MOST_GRAZES, true);
  const windows = await withContactSearch(walk, start, end, margin, again, sure);
  return windows.find(({ opens }) => opens.status === "found")?.opens ?? first;
}

/**
 * The least clearance, m, of any two non-adjacent benches from start to end, s.
 *
 * 0 where benches overlap; infinite for a dragon of one or two benches. The bracket is as wide as the
 * first of `tolerances`, m, or where benches keep one distance for a while as one of the others. Nothing
 * beyond `within` metres is looked for.
 * @param {Walk} walk
 * @param {number} start @param {number} end
 * @param {{ within?: number, tolerances?: number[], progress?: Progress }} [options]
 * @returns {Promise<Answer>}
 */
export function leastClearance(
  walk,
  start,
  end,
  { within = Infinity, tolerances = TOLERANCES, progress = silent } = {},
) {
  return withContactSearch(walk, start, end, 0, progress, async (search) => {
    if (walk.dragon.benches < 3) return NONE;
    return least(search, guess(search), within, tolerances);
  });
}

/**
 * The least clearance, m, as it is seen here and there from start to end, s, where no benches come nearer
 * than `floor`, m, as far as is known: no search is made.
 * @param {Walk} walk
 * @param {number} start @param {number} end
 * @param {number} floor
 * @returns {Promise<Answer>}
 */
export function seenClearance(walk, start, end, floor) {
  return withContactSearch(walk, start, end, 0, silent, async (search) => {
    if (walk.dragon.benches < 3) return NONE;
    const best = guess(search);
    return clearanceAnswer(search, { ...best, floor: Math.min(floor, best.distance) });
  });
}

/**
 * The least clearance, some distance being known: see `leastClearance`.
 * @param {ContactSearch} search
 * @param {Best} best
 * @param {number} within
 * @param {number[]} tolerances
 */
async function least(search, best, within, tolerances) {
  if (search.start === search.end) return clearanceAnswer(search, best);
  const sampled = search.walk.dragon.benches <= MOST_SAMPLED;
  let reach = sampled ? best.distance : FIRST_REACH;
  if (!best.distance) {
    search.begin(0);
    await search.walkThrough(); // whether the dragon can walk all the way
  }
  while (best.distance > 0) {
    reach = Math.min(reach, best.distance, within);
    search.begin(reach);
    if (!sampled) [best] = await lowered(search, best, reach, Infinity); // seen at the start alone
    best = await bracketed(search, best, reach, tolerances);
    if (best.distance <= reach) break;
    if (reach >= within) {
      const { assumptions, evaluations } = search.told();
      return answered(Infinity, best.floor, Infinity, "m", { assumptions, evaluations });
    }
    reach *= WIDER;
  }
  return clearanceAnswer(search, best);
}

/** A low distance, looked for here and there, so that what is farther need not be searched. @param {ContactSearch} search @returns {Best} */
function guess(search) {
  const { start, end, walk } = search;
  const still = start === end;
  if (still || walk.dragon.benches > MOST_SAMPLED) {
    const [{ distance, benches }] = tightestAt(search);
    const apart = Math.max(distance, 0);
    return {
      distance: apart,
      where: start,
      pair: [benches[0] - 1, benches[1] - 1],
      floor: still ? apart : 0,
    };
  }
  const [distance, where, i, j] = search.spans
    .map((span) => lowPair(walk, ...span))
    .reduce((low, one) => (one[0] < low[0] ? one : low));
  return { distance: Math.max(distance, 0), where, pair: [i, j], floor: 0 };
}

/**
 * What a pass makes that refines a bracket to the tolerance of number n; null where that is too dear.
 * @template T
 * @param {number} n
 * @param {() => Promise<T>} pass
 */
export async function refined(n, pass) {
  try {
    return await aside(n ? REFINING_ON : REFINING, pass);
  } catch (error) {
    if (error instanceof OverBudgetError) return null;
    throw error;
  }
}

/**
 * `best`, or what is lower within `reach`, bracketed as the first tolerance that can be says. What is too
 * dear is given up. A last pass, of whatever width, sees the rest of the walk.
 * @param {ContactSearch} search
 * @param {Best} best
 * @param {number} reach
 * @param {number[]} tolerances
 */
async function bracketed(search, best, reach, tolerances) {
  const pass = (/** @type {number} */ tolerance) => {
    search.again();
    return lowered(search, best, Math.min(reach, best.distance), tolerance);
  };
  for (const [n, tolerance] of tolerances.entries()) {
    const found = await refined(n, () => pass(tolerance));
    if (found?.[1]) return found[0];
    best = found?.[0] ?? best;
  }
  return (await pass(Infinity))[0];
}

/**
 * `best`, or what is lower within `reach` from here on, and whether its floor was found.
 * @param {ContactSearch} search
 * @param {Best} best
 * @param {number} reach
 * @param {number} tolerance
 * @returns {Promise<[Best, boolean]>}
 */
async function lowered(search, best, reach, tolerance) {
  const known = { [SEARCH.NEAREST]: reach, [SEARCH.FLOOR]: Infinity };
  const [ending, note] = await search.search(SEARCH.LEAST, known, tolerance);
  const closed = ending === SEARCH.CLEAR;
  const nearest = note[SEARCH.NEAREST];
  if (nearest < reach) {
    const [distance, where] = [Math.max(nearest, 0), note[SEARCH.UPPER]];
    best = { distance, where, pair: search.pair(note), floor: 0 };
  }
  const floor = Math.max(Math.min(note[SEARCH.FLOOR], nearest - tolerance), 0);
  return [{ ...best, floor: closed ? floor : 0 }, closed || best.distance === 0];
}

/** @param {ContactSearch} search @param {Best} best */
function clearanceAnswer(search, { distance, where, pair, floor }) {
  search.noteOff(search.offAt(where, ...pair));
  const lower = Math.max(floor - search.off, 0);
  const witness = search.witness(where, ...pair);
  const upper = upperEnd(distance || witness.gap, search.off);
  return answered(distance, lower, upper, "m", { witness, ...search.told() });
}

/** The most, m, that bodies are apart at a distance, or at minus a depth, m, that may be off by `off`. @param {number} gap @param {number} off */
export function upperEnd(gap, off) {
  return gap > 0 ? gap + off : Math.max(gap + Math.SQRT2 * off, 0);
}
