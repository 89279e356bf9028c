// The search of a walk for benches that come near an obstacle. Twin of analysis/obstacle_search.py.
//
// Where a bench stands is told by the route position of its own front handle, whatever the others do. So
// each size of bench is searched once, along the stretches of route that its benches walk.

import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { Arena, doubles, withArena } from "./arena.js";
import { spend } from "./budget.js";
import {
  ANALYSIS_CONTACT_SEARCH,
  ANALYSIS_OBSTACLE_SEARCH,
  ANALYSIS_ROUNDS,
  BOX,
  CURVE,
  DOUBTS,
  ROUNDING,
  SEARCH,
  STANDING,
  WALK_SEARCH,
} from "./constants.js";
import { assumedWithin, inOrder } from "./contact_search.js";
import { CORNERS, boxes, nearness } from "./distance.js";
import { UnsureError } from "./errors.js";
import { HeadTimes } from "./head_times.js";
import { evenly } from "./lists.js";
import { checkedOff, errorsAt, isNowhere, originOf, seamsOf, seenFrom } from "./nearby.js";
import { general } from "./number_format.js";
import { linkLength } from "./numbers.js";
import { boxDistances, nearestBoxes } from "./obstacle_distance.js";
import { Rounds, returns } from "./rounds.js";
import { fillWhole, kindsOf, searchRoom } from "./tables.js";
import { tick } from "./tick.js";
import { Placement, Walk } from "./walk.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./answer.js").Status} Status */
/** @typedef {import("./answer.js").Witness} Witness */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {[number, number]} Span of route positions, m */

/**
 * The benches of one size: its number, the benches (rows, from 0), and the span of route of each, m.
 * @typedef {{ k: number, benches: number[], spans: Span[] }} Stretch
 */

/**
 * Where a bench (row, from 0) comes to an obstacle: its front handle between lower and upper, m.
 * @typedef {{ bench: number, lower: number, upper: number, sure: boolean }} Touch
 */

/** How the search of a span ended, and between which positions, m. @typedef {[number, number, number]} Told */

const { BENCH, SPANS, SAMPLES, MOST_GRAZES, NARROW, MOST_STEPS } = ANALYSIS_OBSTACLE_SEARCH;
const { PLACED } = ANALYSIS_ROUNDS;
const { MOST_EVALUATIONS, MOST_LEAST_EVALUATIONS, SLACK, WIDTH } = ANALYSIS_CONTACT_SEARCH;

/** Boxes that stand, with scratch for as many: `standing.scratch_for`. @param {Arena} arena @param {Numbers} standing */
export function standingScratch(arena, standing) {
  const [count] = standing.shape;
  const [first, second, number] = [0, 1, 2].map(() => arena.array("q", count));
  const near = arena.array("d", Math.max(count, 2), BOX.BOX_COLUMNS);
  const members = fillWhole(arena.array("q", 1), 0n);
  return { boxes: standing, near, number, first, second, members };
}

/** A search of a walk from one time to another, s, for what comes near one obstacle. */
export class ObstacleSearch {
  /**
   * @param {Arena} arena which holds what lasts as long as the search
   * @param {Walk} walk
   * @param {Obstacle} obstacle
   * @param {number} start @param {number} end s; the dragon must be able to stand at both
   * @param {Progress} progress is told that it goes on
   */
  constructor(arena, walk, obstacle, start, end, progress) {
    inOrder(start, end);
    this.arena = arena;
    this.progress = progress;
    this.evaluations = 0;
    this.began = now();
    /** Head positions, m. @type {[number, number]} */
    this.heads = [walk.headPosition(start), walk.headPosition(end)];
    const placed = walk.placement(arena, this.heads); // throws where the dragon cannot stand
    /** Near the dance, m. */
    this.origin = originOf(placed);
    const [x, y] = this.origin;
    const still = isNowhere(this.origin);
    /** As given, but with coordinates counted from `origin`. */
    this.walk = seenFrom(arena, walk, this.origin);
    /** Likewise. */
    this.obstacle = still ? obstacle : obstacle.moved(0, [-x, -y]);
    this.placed = still ? placed : this.walk.placement(arena, this.heads);
    /** What computed distances count as off by at least, m. */
    this.slack = SLACK;
    /** Of the route. */
    this.seams = seamsOf(arena, this.walk.route.rows);
    const { kind, kinds } = kindsOf(arena, walk.dragon);
    this.kind = Array.from(kind.view, Number);
    this.kinds = kinds;
    this.boxes = this.obstacle.boxes(arena);
    this.standing = standingScratch(arena, this.boxes);
    const count = this.boxes.shape[0] + 1;
    this.search = searchRoom(arena, 2, count, count);
    this.times = new HeadTimes(this.walk, this.heads[0], start, end);
    /** Distance from the obstacle's boxes at which a bench is as near as it may be, m. */
    this.reach = obstacle.margin + obstacle.radius;
    this.stretches = this.#stretches();
    /** What computed distances may be off by that mattered so far, m. */
    this.off = this.slack;
  }

  /**
   * The least distance of a bench from a box at the start, m: which bench, from 0. Minus infinity where a
   * bench stands where none may.
   */
  get atStart() {
    return withArena(this.walk.engine, (arena) => {
      const { apart } = boxDistances(arena, this.placed, this.obstacle, this.boxes);
      const bench = apart.reduce((least, one, i) => (one < apart[least] ? i : least), 0);
      return { apart: apart[bench], bench };
    });
  }

  /** What the least of these distances may be off by, m. */
  get offAtStart() {
    const { engine } = this.walk;
    const { off } = errorsAt(this.walk, this.heads[0], 0);
    const count = this.boxes.shape[0];
    let still = 0;
    for (let n = 0; n < count; n++)
      still = Math.max(still, engine.call("bd_rounding_still_error", this.boxes, n)[0]);
    return Math.max(this.slack, off.reduce((a, b) => Math.max(a, b), 0) + still);
  }

  /**
   * What each size of bench walks, followed to where the one of its size before it stood at the start, and
   * where its way comes to where it was, no more: then distances count as off by what rounds miss.
   */
  #stretches() {
    const s = doubles(this.placed.s);
    const { sizes } = this.kinds;
    const [count, view] = [sizes.shape[1], doubles(sizes)];
    const reaches = Array.from({ length: count }, (_kind, k) => Math.hypot(view[k], view[count + k]));
    const { engine, route, profile } = this.walk;
    const known = returns(engine, route.rows, Math.max(...reaches));
    return reaches.map((_reach, k) => {
      /** @type {Stretch} */
      const found = { k, benches: [], spans: [] };
      withArena(engine, (arena) => {
        const benches = this.kind.flatMap((kind, bench) => (kind === k ? [bench] : []));
        const alone = new Walk(this.walk.dragon.only(arena, benches[0]), route, profile);
        const rounds = new Rounds(alone, known);
        for (const [n, bench] of benches.entries()) {
          const [start, last] = [s[2 * bench], s[2 * bench + 1]];
          const end = n ? Math.min(last, s[2 * benches[n - 1]]) : last;
          if (!(end > start)) continue;
          const { spans, missed } = rounds.new(start, end);
          for (const span of spans) {
            found.benches.push(bench);
            found.spans.push(span);
          }
          if (missed) this.slack = Math.max(this.slack, 2 * missed + PLACED);
        }
      });
      return found;
    });
  }

  /** A note for kernels, of zeros but for some columns. @param {Record<number, number>} [known] */
  note(known = {}) {
    const note = this.arena.full([SEARCH.NOTES], 0);
    for (const [column, value] of Object.entries(known)) doubles(note)[Number(column)] = value;
    return note;
  }

  /**
   * Search spans for benches of size k; what is told of each span that was searched.
   * @param {number} k
   * @param {number} goal
   * @param {Span[]} spans
   * @param {number} tolerance
   * @param {Numbers} note
   */
  async run(k, goal, spans, tolerance, note) {
    /** @type {Told[]} */
    const told = [];
    const most = goal === SEARCH.LEAST ? MOST_LEAST_EVALUATIONS : MOST_EVALUATIONS;
    for (let first = 0; first < spans.length; first += SPANS) {
      const before = doubles(note)[SEARCH.EVALUATIONS];
      const [ending, found] = withArena(this.walk.engine, (arena) => {
        const some = arena.table(spans.slice(first, first + SPANS), 2);
        const out = arena.array("d", some.shape[0], STANDING.SPAN_COLUMNS);
        const [ended] = arena.engine.call(
          "bd_standing_search_spans", this.#bench(arena, k), this.standing, this.search, goal, some,
          this.reach, tolerance || this.slack, WIDTH, most, note, out,
        ); // prettier-ignore
        return [ended, doubles(out).slice()];
      });
      this.noteOff(doubles(note)[SEARCH.OFF]);
      const made = doubles(note)[SEARCH.EVALUATIONS] - before;
      this.evaluations += made;
      spend(BENCH * (made + Math.min(SPANS, spans.length - first)) * this.standing.boxes.shape[0]);
      for (let n = 0; n < found.length; n += STANDING.SPAN_COLUMNS)
        told.push([
          found[n + STANDING.ENDING],
          found[n + STANDING.SPAN_LOWER],
          found[n + STANDING.SPAN_UPPER],
        ]);
      if (ending === WALK_SEARCH.ASTRAY || ending === SEARCH.FALLEN)
        throw this.#stopped(doubles(note)[SEARCH.LOWER]);
      if (goal === SEARCH.LEAST && ending === SEARCH.FOUND) break;
      await tick();
      this.progress(0, "");
    }
    return told;
  }

  /** Take note of what a distance that matters may be off by, m. @param {number} off */
  noteOff(off) {
    this.off = Math.max(this.off, off <= this.slack ? off : checkedOff(off));
  }

  /** Lower the least distance that is known by what is seen at the ends of spans. @param {number} k @param {Span[]} spans @param {Numbers} note */
  look(k, spans, note) {
    withArena(this.walk.engine, (arena) =>
      arena.engine.call(
        "bd_standing_look_along", this.#bench(arena, k), this.standing, this.search,
        arena.table(spans, 2), note,
      ),
    ); // prettier-ignore
  }

  /** One bench of size k on the route. @param {Arena} arena @param {number} k */
  #bench(arena, k) {
    const { view, shape } = this.kinds.sizes;
    const sizes = [0, 1, 2, 3].map((n) => Number(view[n * shape[1] + k]));
    const link = arena.vector([linkLength(sizes[0], sizes[2], sizes[3])]);
    const { rows } = this.walk.route;
    return { rows, link, sizes: arena.table(sizes.map((size) => [size]), 1), seams: this.seams }; // prettier-ignore
  }

  /** Why a bench could not be followed past the end of what its search had shown, m. @param {number} sound */
  #stopped(sound) {
    const error = this.walk.firstFailure(evenly(...this.heads, SAMPLES));
    const values = { s: general(sound) };
    return (
      error ??
      new UnsureError(
        _("past s = {s} m it could not be shown that every bench follows without a leap", values),
      )
    );
  }

  /** Head positions, m, between which a bench's front handle surely goes from lower to upper. @param {number} bench @param {number} lower @param {number} upper @returns {[number, number]} */
  headAt(bench, lower, upper) {
    const [low, high] = this.heads;
    if (bench === 0) return [Math.max(lower, low), Math.min(upper, high)];
    return withArena(this.walk.engine, (arena) => {
      const line = this.walk.dragon.first(arena, bench);
      /** @type {[number, number]} */
      let ends = [low, high];
      // By what errors are at the ends, then by what they are there.
      for (let pass = 0; pass < 2; pass++) {
        const off = ends.map((head) => this.#handleOff(bench, head));
        ends = [this.#bracket(line, lower - off[0])[0], this.#bracket(line, upper + off[1])[1]];
      }
      return ends;
    });
  }

  /** What the last handle of some benches may be off by along the route, m, as positions tell it. @param {number} benches @param {number} head */
  #handleOff(benches, head) {
    const { engine, route } = this.walk;
    const { errors } = errorsAt(this.walk, head);
    const [drift, doubt] = engine.call("bd_drift_head_drift", route.rows, head);
    const view = doubles(route.rows);
    let counted = Math.abs(head);
    for (let n = 0; n < view.length; n += CURVE.COLUMNS) {
      if (view[n + CURVE.KIND] !== CURVE.SPIRAL) continue;
      const outmost = Math.max(Math.abs(view[n + CURVE.U_START]), Math.abs(view[n + CURVE.U_END]));
      counted += view[n + CURVE.P] * (1 + outmost * outmost);
    }
    const off = this.slack + errors[benches] + Math.abs(drift) + doubt;
    return off + ANALYSIS_OBSTACLE_SEARCH.COUNTED * ROUNDING.HALF_UNIT * counted;
  }

  /** Head positions, m, between which the last handle of the first benches comes to s. @param {Dragon} line @param {number} s */
  #bracket(line, s) {
    let [low, high] = this.heads;
    let guess = 0.5 * (low + high);
    const fine = 4 * DOUBTS.UNIT * Math.max(Math.abs(low), Math.abs(high), 1);
    for (let step = 0; step < MOST_STEPS && high - low > 2 * fine; step++) {
      if (!(low < guess && guess < high)) guess = 0.5 * (low + high);
      const { at, ratio } = this.#lastHandle(line, guess);
      const ahead = at - s;
      if (ahead >= 0) high = guess;
      else low = guess;
      const side = step % 4 < 3 ? (ahead >= 0 ? -fine : fine) : 0;
      guess = step % 8 < 7 ? guess - ahead / ratio + side : 0.5 * (low + high);
    }
    return [low, high];
  }

  /** Where the last handle of some benches is, m, and its speed over the head's. @param {Dragon} line @param {number} head */
  #lastHandle(line, head) {
    return withArena(this.walk.engine, (arena) => {
      const placed = new Placement(arena, line, this.walk.route, [head]);
      return { at: doubles(placed.s)[line.benches], ratio: doubles(placed.ratio)[line.benches] };
    });
  }

  /**
   * A time between those at which the head is at lower and at upper; how a bench then stands.
   * @param {number} lower @param {number} upper
   * @param {Status} status
   * @param {number} bench
   */
  answer(lower, upper, status, bench) {
    const [value, early, late, known] = this.times.told(lower, upper, status);
    const grazed = known === "found" && late - early > NARROW; // then it surely touches at the end
    const more = { status: known, witness: this.witness(upper, bench), ...this.told() };
    return answered(grazed ? late : value, early, late, "s", more);
  }

  /** What answers rest on, and what they took. */
  told() {
    const { off, evaluations, began } = this;
    return { assumptions: assumedWithin(off), evaluations, seconds: now() - began };
  }

  /**
   * How a bench (row, from 0) stands to the obstacle with the head at s.
   *
   * Where it stands wholly inside of one the gap is minus the distance. Of a bench outside of the venue
   * the point is the corner that is farthest out, and the gap minus how far.
   * @param {number} s
   * @param {number} bench
   * @returns {Witness}
   */
  witness(s, bench) {
    const { obstacle, walk } = this;
    return withArena(walk.engine, (arena) => {
      const placed = walk.placement(arena, [s], { throws: false });
      const { BOX_COLUMNS } = BOX;
      const box = doubles(boxes(arena, placed)).slice(bench * BOX_COLUMNS, (bench + 1) * BOX_COLUMNS);
      const table = arena.table([box, ...obstacle.boxRows()], BOX_COLUMNS);
      const alone = arena.table([box], BOX_COLUMNS);
      const [which] = nearestBoxes(arena, alone, this.boxes).which;
      const near = nearness(arena.engine, table, 0, 1 + which);
      let gap = (near.distance <= 0 ? near.gap : near.distance) - obstacle.radius;
      if (gap > 0 && obstacle.forbids([box[BOX.CX], box[BOX.CY]])) gap = -gap;
      const [, feature] = near.features.find(([owner]) => owner === 1) ?? [1, ""];
      const out = obstacle.kind === "venue" ? farthestOut(arena, table, obstacle) : null;
      const [x, y] = out?.point ?? near.points[0];
      return {
        time: this.times.at(s),
        s,
        benches: [bench + 1],
        point: [x + this.origin[0], y + this.origin[1]],
        gap: out?.gap ?? gap,
        features: [[bench + 1, out?.feature ?? feature]],
        handle: null,
        obstacle: obstacle.name,
      };
    });
  }

  /**
   * Where benches first come nearer than they may, each in its own span; soonest ones first. And where
   * they graze before, within rounding. A graze that runs into a touch is its beginning.
   */
  async touches() {
    /** @type {Array<[number, Touch]>} */
    const found = [];
    for (const { k, benches, spans } of this.stretches)
      for (const { n, ...touch } of await this.#touched(k, spans))
        found.push([
          touch.lower - doubles(this.placed.s)[2 * benches[n]],
          { bench: benches[n], ...touch },
        ]);
    return found.sort(([a], [b]) => a - b).map(([, touch]) => touch);
  }

  /**
   * Which spans are touched in, between which positions, m, and whether surely; grazes too.
   * @param {number} k
   * @param {Span[]} spans
   */
  async #touched(k, spans) {
    /** @type {Map<number, Array<{ n: number, lower: number, upper: number, sure: boolean }>>} */
    const found = new Map();
    const left = spans.map(([start, end]) => /** @type {Span} */ ([start, end]));
    let rows = spans.map((_span, n) => n);
    for (let graze = 0; graze < MOST_GRAZES; graze++) {
      const note = this.note();
      const some = rows.map((n) => left[n]);
      const told = await this.run(k, SEARCH.FIRST_TOUCH, some, 0, note);
      this.arena.drop(note);
      rows.forEach((n, at) => takeDown(found, n, told[at]));
      const grazed = rows.map((n, at) => ({ n, told: told[at] }));
      rows = grazed.flatMap(({ n, told: [ending, , upper] }) => {
        if (ending !== SEARCH.GRAZE) return [];
        left[n][0] = upper;
        return upper < left[n][1] ? [n] : [];
      });
      if (!rows.length) return [...found.values()].flat();
    }
    const values = { name: this.obstacle.name };
    throw new UnsureError(
      _("benches come within rounding of {name} too often to be followed on", values),
    );
  }

  /** The first bench of size k that walks over s with its front handle. @param {number} k @param {number} s */
  benchAt(k, s) {
    const { benches, spans } = this.stretches[k];
    return benches[spans.findIndex(([start, end]) => start <= s && s <= end)];
  }
}

/**
 * Add to what was found in span n how its search ended.
 * @param {Map<number, Array<{ n: number, lower: number, upper: number, sure: boolean }>>} found
 * @param {number} n
 * @param {Told} told
 */
function takeDown(found, n, [ending, lower, upper]) {
  if (ending === SEARCH.CLEAR) return;
  const before = found.get(n) ?? [];
  found.set(n, before);
  const last = before[before.length - 1];
  const joined = last !== undefined && lower <= last.upper;
  if (joined) before.pop();
  before.push({ n, lower: joined ? last.lower : lower, upper, sure: ending === SEARCH.FOUND });
}

/**
 * The corner of the box in row 0 that is farthest beyond the venue's edge, the other rows: where it is,
 * minus how far out, m, and which it is; null where none is out.
 * @param {Arena} arena
 * @param {Numbers} table
 * @param {Obstacle} venue
 */
function farthestOut({ engine }, table, venue) {
  /** @type {{ point: [number, number], gap: number, feature: string } | null} */
  let farthest = null;
  for (const [k, feature] of CORNERS.entries()) {
    const [x, y] = engine.call("bd_box_corner", table, 0, k);
    if (!venue.forbids([x, y])) continue;
    let apart = Infinity;
    for (let n = 1; n < table.shape[0]; n++) {
      const [along, across] = engine.call("bd_box_offset", table, n, x, y);
      const box = doubles(table).subarray(n * BOX.BOX_COLUMNS);
      const ahead = Math.abs(along) - box[BOX.HALF_LENGTH];
      const aside = Math.abs(across) - box[BOX.HALF_WIDTH];
      apart = Math.min(apart, Math.hypot(Math.max(ahead, 0), Math.max(aside, 0)));
    }
    if (farthest === null || -apart < farthest.gap) farthest = { point: [x, y], gap: -apart, feature };
  }
  return farthest;
}
