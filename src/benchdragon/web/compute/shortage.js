// How much room is missing where people have too little: of the pair that lacks it first, and when. Twin of
// analysis/shortage.py.

import { doubles, withArena } from "./arena.js";
import { ANALYSIS_SHORTAGE, BOX } from "./constants.js";
import { boxes } from "./distance.js";
import { linspace, rounded } from "./numbers.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./room.js").Known} Known */
/** @typedef {import("./room.js").Need} Key */
/** @typedef {import("./walk.js").Walk} Walk */
/** What is asked for, by key, m. @typedef {Partial<Record<Key, number>>} Wanted */
/** The pair at some times: how far the two are apart with room on both sides and ahead, m. @typedef {{ headed: boolean, apart: (beside: number, ahead: number) => Float64Array }} Seen */
/** How much more than it must a pair keeps with a value of what is asked for, m. @typedef {(seen: Seen, value: number) => Float64Array} Slack */

/**
 * Of what a pair has too little when its room is tightest: see `Shortage` there.
 * @typedef {object} Shortage
 * @property {Key} key
 * @property {number} wanted m
 * @property {number} time s
 * @property {number} apart what the two then are from one another, m
 * @property {number} there the greatest value of the key with which they would keep their room, m
 */

const { CLOSER, DECIMALS, HALVINGS, LEVEL, SAMPLES } = ANALYSIS_SHORTAGE;

/**
 * What the pair that breaks a level of room first has too little of, until the end, s; null where too
 * little is missing to be told.
 * @param {Walk} walk that of the boards alone
 * @param {Known} broken
 * @param {number} margin that two benches must keep, m; an obstacle has its own
 * @param {Wanted} asked what the level asks for
 * @param {number} end
 * @returns {Shortage | null}
 */
export function shortage(walk, { contact, obstacle }, margin, asked, end) {
  if (contact.witness === null) return null;
  const [start, kept] = [contact.value, obstacle === null ? margin : obstacle.margin];
  const rows = contact.witness.benches.map((bench) => bench - 1);
  /** @template T @param {ArrayLike<number>} times @param {(seen: Seen) => T} use */
  const looked = (times, use) =>
    withArena(walk.engine, (arena) => use(seenAt(arena, walk, times, rows, obstacle)));
  const key = looked([start], (seen) => lackingOf(seen, kept, asked));
  const wanted = asked[key] ?? 0;
  const counted = obstacle === null ? 2 : 1;
  /** @type {Slack} */
  const slack = (seen, value) => {
    if (key === "beside") return seen.apart(value, 0).map((apart) => apart - kept);
    if (key === "ahead") return seen.apart(asked.beside ?? 0, value).map((apart) => apart - kept);
    return seen.apart(0, 0).map((apart) => apart - kept + counted * (wanted - value));
  };
  const times = linspace(0, 1, SAMPLES).map((share) => start + (end - start) * share ** 2);
  const first = looked(times, (seen) => leastOf(slack, wanted, seen)).at;
  const around = [times[Math.max(first - 1, 0)], times[Math.min(first + 1, SAMPLES - 1)]];
  const about = linspace(around[0], around[1], CLOSER);
  const { at } = looked(about, (seen) => leastOf(slack, wanted, seen));
  const time = Math.min(Math.max(rounded(about[at], DECIMALS), start), end);
  return looked([time], (seen) => {
    const there = leastOf(slack, wanted, seen).kept;
    return there >= wanted ? null : { key, wanted, time, apart: seen.apart(0, 0)[0], there };
  });
}

/** A pair of benches (rows), or one and an obstacle, at some times, s. @param {Arena} arena @param {Walk} walk @param {ArrayLike<number>} times @param {number[]} rows @param {Obstacle | null} obstacle @returns {Seen} */
function seenAt(arena, walk, times, rows, obstacle) {
  const motion = walk.motion(arena, times);
  const size = rows.length * BOX.BOX_COLUMNS;
  const boards = new Float64Array(times.length * size);
  for (let t = 0; t < times.length; t++)
    withArena(walk.engine, (own) => {
      const table = doubles(boxes(own, motion, t));
      rows.forEach((row, k) => {
        const box = table.subarray(row * BOX.BOX_COLUMNS, (row + 1) * BOX.BOX_COLUMNS);
        boards.set(box, t * size + k * BOX.BOX_COLUMNS);
      });
    });
  const headed = rows[0] === 0;
  const apart = (/** @type {number} */ beside, /** @type {number} */ ahead) =>
    withArena(walk.engine, (own) => {
      const table = own.array("d", times.length * rows.length, BOX.BOX_COLUMNS);
      const view = doubles(table);
      view.set(boards);
      for (let at = 0; at < view.length; at += BOX.BOX_COLUMNS) view[at + BOX.HALF_WIDTH] += beside;
      for (let at = 0; headed && at < view.length; at += size) {
        view[at + BOX.HALF_LENGTH] += 0.5 * ahead;
        view[at + BOX.CX] += 0.5 * ahead * view[at + BOX.UX];
        view[at + BOX.CY] += 0.5 * ahead * view[at + BOX.UY];
      }
      return obstacle === null ? pairsApart(own, table) : apartFrom(own, table, obstacle);
    });
  return { headed, apart };
}

/** How far boxes are apart, of which each two that follow one another are a pair, m. @param {Arena} arena @param {import("../engine.js").Numbers} table */
function pairsApart(arena, table) {
  const count = table.shape[0] / 2;
  const [first, second] = [0, 1].map((k) =>
    arena.whole(Array.from({ length: count }, (_pair, t) => 2 * t + k)),
  );
  const [gap, out] = [arena.array("d", count), arena.array("d", count)];
  arena.engine.call("bd_box_pair_distances", table, first, second, gap, out);
  return doubles(out).slice();
}

/** How far boxes are from an obstacle, m. @param {Arena} arena @param {import("../engine.js").Numbers} table @param {Obstacle} obstacle */
function apartFrom(arena, table, obstacle) {
  const { apart } = obstacle.nearest(arena, table);
  const forbidden = obstacle.forbids(arena, table);
  return apart.map((distance, t) => (forbidden[t] ? -Infinity : distance - obstacle.radius));
}

/** Which of the keys asked for lacks at the one time that is seen. @param {Seen} seen @param {number} margin @param {Wanted} asked @returns {Key} */
function lackingOf(seen, margin, asked) {
  const keys = /** @type {Key[]} */ (Object.keys(asked));
  if (!keys.includes("ahead")) return keys[0];
  const aside = seen.apart(asked.beside ?? 0, 0)[0] - margin;
  return !keys.includes("beside") || (seen.headed && aside > LEVEL) ? "ahead" : "beside";
}

/** The greatest value with which the pair keeps its room at all times seen, and when it least does. @param {Slack} slack @param {number} wanted @param {Seen} seen */
function leastOf(slack, wanted, seen) {
  const keeps = (/** @type {number} */ value) => slack(seen, value).every((more) => more > 0);
  let [kept, broken] = [0, wanted];
  if (keeps(broken)) kept = broken;
  else if (!keeps(kept)) broken = kept;
  else
    for (let halving = 0; halving < HALVINGS; halving++) {
      const middle = 0.5 * (kept + broken);
      if (keeps(middle)) kept = middle;
      else broken = middle;
    }
  const left = slack(seen, broken);
  const least = left.reduce((a, b) => Math.min(a, b));
  return { kept, at: left.findIndex((more) => more <= least + LEVEL) };
}
