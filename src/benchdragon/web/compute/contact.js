// Contact over time: the first, all of them, and the least clearance of a walk. Twin of
// analysis/contact.py.

import { answered } from "./answer.js";
import { OverBudgetError, aside } from "./budget.js";
import { ANALYSIS_CONTACT, ANALYSIS_CONTACT_SEARCH, CONTACT_MEMORY, SEARCH } from "./constants.js";
import { withContactSearch } from "./contact_search.js";
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

const { FRAYED, MOST_GRAZES } = ANALYSIS_CONTACT;
const { REFINING, REFINING_ON } = ANALYSIS_CONTACT_SEARCH;
/** Widths of brackets of clearances, m: the first that can be. @type {number[]} */
export const TOLERANCES = ANALYSIS_CONTACT_SEARCH.TOLERANCES;
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
  /** @type {Window[]} */
  const windows = [];
  while (windows.length < most) {
    const last = windows[windows.length - 1];
    if (sure && last?.opens.status === "found") break;
    const touching = last !== undefined && last.closes === null;
    const ending = await search.find(touching ? SEARCH.TOUCH_END : SEARCH.FIRST_TOUCH);
    if (ending === SEARCH.CLEAR) break;
    takeDown(windows, search.moment(ending === SEARCH.FOUND ? "found" : "undecided"), touching);
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

/**
 * The first time in start..end, s, at which two non-adjacent benches touch, or are nearer than a margin,
 * m; null if never. All is clear up to `lower`, and at `upper` a pair surely is; "undecided" is a graze
 * within rounding.
 * @param {Walk} walk
 * @param {number} start @param {number} end
 * @param {{ margin?: number, progress?: Progress }} [options]
 */
async function firstContact(walk, start, end, { margin = 0, progress = silent } = {}) {
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
  const use = async (/** @type {ContactSearch} */ search) => {
    if (walk.dragon.benches < 3) return NONE;
    if ((await search.find(SEARCH.LEAST, within)) !== CONTACT_MEMORY.FARTHER) return clearance(search);
    const { assumptions, evaluations } = search.rest();
    const floor = search.figure(CONTACT_MEMORY.FLOOR_AT);
    return answered(Infinity, floor, Infinity, "m", { assumptions, evaluations });
  };
  return withContactSearch(walk, start, end, 0, progress, use, { tolerances });
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
    await search.find(CONTACT_MEMORY.SEEN);
    return clearance(search, floor);
  });
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

/** The least clearance as it was found, or above what is known from elsewhere, m. @param {ContactSearch} search @param {number} [floor] */
function clearance(search, floor) {
  const best = search.figure(CONTACT_MEMORY.BEST);
  const least = floor === undefined ? search.figure(CONTACT_MEMORY.FLOOR_AT) : Math.min(floor, best);
  const witness = search.witness();
  const upper = upperEnd(best || witness.gap, search.off);
  return answered(best, Math.max(least - search.off, 0), upper, "m", { witness, ...search.rest() });
}

/** The most, m, that bodies are apart at a distance, or at minus a depth, m, that may be off by `off`. @param {number} gap @param {number} off */
function upperEnd(gap, off) {
  return gap > 0 ? gap + off : Math.max(gap + Math.SQRT2 * off, 0);
}
