// What each bench does in a dance: where it starts, how it turns and how fast, what comes nearest. Twin of
// analysis/bench_walks.py.

import { doubles, withArena } from "./arena.js";
import { TightestSearch, beside } from "./bench_nearness.js";
import { Bends } from "./bends.js";
import { question } from "./budget.js";
import { ANALYSIS_BENCH_WALKS, BOX, MODEL_WALK } from "./constants.js";
import { crossings } from "./crossings.js";
import { boxes } from "./distance.js";
import { linspace } from "./numbers.js";
import { countBelow, countUpTo } from "./profile.js";
import { followed } from "./stretches.js";
import { silent, tick } from "./tick.js";

/** @typedef {import("./bench_nearness.js").Looks} Looks */
/** @typedef {import("./bench_nearness.js").Tightest} Tightest */
/** @typedef {import("./bends.js").Turning} Turning */
/** @typedef {import("./crossings.js").Crossing} Crossing */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./stretches.js").Piece} Piece */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {"wait" | "walk" | "hurry" | "run"} Pace */

/**
 * A time in which a bench keeps turning one way at one pace.
 * @typedef {object} Stretch
 * @property {number} start s
 * @property {number} end s
 * @property {Turning} turning to which side its front handle's route bends
 * @property {Pace} pace of its front handle
 * @property {number} way how far that handle goes, m
 * @property {number} angle by how much the route turns under that handle, rad, left positive
 * @property {[number, number]} speeds the least and the greatest of that handle seen, m/s
 */

/**
 * What one bench does.
 * @typedef {object} BenchWalk
 * @property {number} bench its number, from 1, the head's
 * @property {[number, number]} place where its front handle is when the dance starts, m
 * @property {number} heading of the bench then, rad
 * @property {number[]} box its rectangle then, a row of kernels/box.py
 * @property {Stretch[]} stretches one after another, from the start of the dance to its end
 * @property {Tightest | null} tightest null where no bench of another coil comes within the distance looked for
 * @property {number | null} before number of the bench before it; null for the head
 * @property {number | null} behind number of the bench behind it; null for the tail
 * @property {number | null} left number of the bench on its left at the end; null where none is near
 * @property {number | null} right the same on its right
 */

const { STILL, STEP, MOST_KEPT } = ANALYSIS_BENCH_WALKS;
/** @type {Pace[]} */
const PACES = ["wait", "walk", "hurry", "run"];
// Places that are computed at a time: after each the page is heard.
const PLACES = 60_000;
// Benches of which the tightest moments are found at a time.
const BENCHES = 20;

/**
 * What each bench of a plan's walk does over a span, s, the head's first, and where along the route each
 * front handle is at both ends, m.
 * @param {Plan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {Progress} [progress]
 */
export function benchWalks(plan, walk, span, progress = silent) {
  return question(() => walkedOver(plan, walk, span, progress));
}

/** @param {Plan} plan @param {Walk} walk @param {[number, number]} span @param {Progress} progress */
async function walkedOver(plan, walk, [start, end], progress) {
  const { benches } = walk.dragon;
  const times = timesOf(walk, start, end);
  const gates = gatesOf(plan.tables.people);
  const bends = new Bends(walk.route);
  const seen = new Seen(walk, times, bends.at, gates);
  for (const [first, last] of slices(times.length, benches)) {
    await seen.slice(first, last);
    progress((0.8 * last) / times.length, "");
  }
  const ends = endsOf(walk, start, end);
  const whole = new Whole(bends, gates, times, seen.speeds, ends.s);
  /** @type {BenchWalk[]} */
  const found = [];
  for (let k = 0; k < benches; k++) {
    const [left, right] = ends.sides[k];
    found.push({
      bench: k + 1, place: ends.places[k], heading: ends.headings[k], box: ends.boxes[k],
      stretches: whole.stretches(k, seen.crossed(k)), tightest: seen.near.tightest(k),
      before: k || null, behind: k + 1 < benches ? k + 2 : null, left, right,
    }); // prettier-ignore
    if (k % BENCHES) continue;
    progress(0.8 + (0.2 * k) / benches, "");
    await tick();
  }
  return { benches: found, s: ends.s };
}

/** Speeds from which the next pace begins, m/s, ascending. @param {Record<string, number>} people */
function gatesOf({ hurry_from: hurry, run_from }) {
  const run = Math.max(run_from, STILL);
  return [STILL, Math.min(Math.max(hurry, STILL), run), run];
}

/** Times from start to end, s, STEP apart or more, and those at which the head's speed bends. @param {Walk} walk @param {number} start @param {number} end */
function timesOf(walk, start, end) {
  const most = Math.max(Math.floor(MOST_KEPT / walk.dragon.benches), 2);
  const count = Math.min(Math.ceil((end - start) / STEP), most);
  const knots = walk.profile.times.filter((time) => start < time && time < end).slice(0, most);
  const even = end > start ? linspace(start, end, count + 1) : Float64Array.of(start);
  return Float64Array.from(new Set([...even, ...knots])).sort();
}

/** The first and the last time of slices, each from the last of the one before it. @param {number} count of times @param {number} benches */
function slices(count, benches) {
  const per = Math.max(Math.floor(MODEL_WALK.SLICE_PLACES / (benches + 1)), 2);
  /** @type {Array<[number, number]>} */
  const found = [];
  for (let first = 0; first < Math.max(count - 1, 1); first += per)
    found.push([first, Math.min(first + per, count - 1)]);
  return found;
}

/** Where benches are at the start and at the end, s, and who is beside each then. @param {Walk} walk @param {number} start @param {number} end */
function endsOf(walk, start, end) {
  const at = (/** @type {number} */ time) =>
    withArena(walk.engine, (arena) => {
      const motion = walk.motion(arena, [time]);
      const [s, x, y] = [motion.s, motion.x, motion.y].map(({ view }) => Array.from(view, Number));
      const table = doubles(boxes(arena, motion));
      const rows = s.slice(1).map((_s, k) => {
        return Array.from(table.subarray(k * BOX.BOX_COLUMNS, (k + 1) * BOX.BOX_COLUMNS));
      });
      return { s, x, y, boxes: rows, sides: beside(motion) };
    });
  const [{ s, x, y, boxes: first }, { s: last, sides }] = [start, end].map(at);
  const rows = sides.map((_side, k) => k);
  const places = rows.map((k) => /** @type {[number, number]} */ ([x[k], y[k]]));
  // Of a bench: from its rear handle to its front one.
  const headings = rows.map((k) => Math.atan2(y[k] - y[k + 1], x[k] - x[k + 1]));
  return { s: [s, last], places, headings, boxes: first, sides };
}

/** What is seen of a dance at the times looked at. */
class Seen {
  /** @param {Walk} walk @param {Float64Array} times @param {number[]} places where the route changes its side, m @param {number[]} gates */
  constructor(walk, times, places, gates) {
    this.walk = walk;
    this.times = times;
    this.places = places;
    this.gates = gates;
    /** Of each bench's front handle at each time, m/s. */
    this.speeds = Array.from({ length: walk.dragon.benches }, () => new Float64Array(times.length));
    this.near = new TightestSearch(walk, 0);
    /** Crossings of each bench. @type {Crossing[][]} */
    this.passed = this.speeds.map(() => []);
  }

  /** Crossings of bench k (a row, from 0), one after another. @param {number} k */
  crossed(k) {
    return this.passed[k].sort((a, b) => a.time - b.time);
  }

  /** Look at a slice of the times, from number `first` to number `last`. @param {number} first @param {number} last */
  async slice(first, last) {
    const { benches } = this.walk.dragon;
    const count = last - first + 1;
    /** @type {Looks} */
    const looks = {
      distance: new Float64Array(count * benches),
      partner: new Int32Array(count * benches),
      headS: new Array(count),
      times: [...this.times.subarray(first, last + 1)],
    };
    const per = Math.max(Math.floor(PLACES / (benches + 1)), 1);
    for (let low = first; low < Math.max(last, first + 1); low += per) {
      const high = Math.min(low + per, last);
      const seen = this.#piece(low, high);
      looks.distance.set(seen.distance, (low - first) * benches);
      looks.partner.set(seen.partner, (low - first) * benches);
      seen.headS.forEach((s, n) => (looks.headS[low - first + n] = s));
      await tick();
    }
    this.near.look(looks);
  }

  /** @param {number} low @param {number} high number of the last time */
  #piece(low, high) {
    const { walk, speeds } = this;
    return withArena(walk.engine, (arena) => {
      const motion = walk.motion(arena, this.times.subarray(low, high + 1));
      const { count, speed } = motion;
      speeds.forEach((own, k) => own.set(speed.subarray(k * count, (k + 1) * count), low));
      for (const one of crossings(walk, motion, this.places, this.gates))
        this.passed[one.handle].push(one);
      return this.near.seen(motion);
    });
  }
}

/** A dance of which stretches are told. */
class Whole {
  /** @param {Bends} bends @param {number[]} gates @param {Float64Array} times @param {Float64Array[]} speeds @param {number[][]} ends route positions of handles at the start and at the end, m */
  constructor(bends, gates, times, speeds, ends) {
    this.bends = bends;
    this.gates = gates;
    this.times = times;
    this.speeds = speeds;
    this.ends = ends;
  }

  /** The stretches of bench k (a row, from 0). @param {number} k @param {Crossing[]} bounds @returns {Stretch[]} */
  stretches(k, bounds) {
    const { times, bends } = this;
    const [speed, [first, last]] = [this.speeds[k], this.ends.map((s) => s[k])];
    let turning = countUpTo(bends.at, first);
    let pace = countUpTo(this.gates, speed[0]);
    /** @type {Piece[]} */
    const pieces = [{ time: times[0], s: first, speed: speed[0], turning, pace }];
    for (const { time, s, speed: fast, bend, next } of bounds) {
      if (bend) turning = next;
      else pace = next;
      pieces.push({ time, s, speed: fast, turning, pace });
    }
    const end = times[times.length - 1];
    const alike = pieces.map((one) => ({ ...one, turning: this.#firstAlike(one.turning) }));
    const kept = followed(alike, end);
    kept.push({ time: end, s: last, speed: speed[speed.length - 1], turning: 0, pace: 0 });
    const angles = bends.angle(kept.map(({ s }) => s));
    return kept
      .slice(0, -1)
      .map((one, n) => this.#stretch(k, one, kept[n + 1], angles[n + 1] - angles[n]));
  }

  /** The number of the first turning that is alike. @param {number} turning */
  #firstAlike(turning) {
    const { turnings } = this.bends;
    return turnings.indexOf(turnings[turning]);
  }

  /** @param {number} k @param {Piece} one @param {Piece} after @param {number} angle @returns {Stretch} */
  #stretch(k, one, after, angle) {
    const [low, high] = [countBelow(this.times, one.time), countUpTo(this.times, after.time)];
    let [least, most] = [Math.min(one.speed, after.speed), Math.max(one.speed, after.speed)];
    for (const speed of this.speeds[k].subarray(low, high)) {
      least = Math.min(least, speed);
      most = Math.max(most, speed);
    }
    return {
      start: one.time, end: after.time, turning: this.bends.turnings[one.turning],
      pace: PACES[one.pace], way: after.s - one.s, angle, speeds: [least, most],
    }; // prettier-ignore
  }
}
