// One dance whose people are not exact: where its benches come nearest, and whether they touch. Twin of
// solve/random_dance.py; how lines stray is in strayed.js.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { hold, spend } from "./budget.js";
import { EVERY_PAIR, SEARCH, SOLVE_RANDOM_DANCE, WALK_SEARCH } from "./constants.js";
import { mostEvaluations } from "./contact_search.js";
import { greatest } from "./dragon.js";
import { BenchDragonError, InputError } from "./errors.js";
import { evenly, firstRows, least } from "./lists.js";
import { general } from "./number_format.js";
import { searchRoom } from "./tables.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./dance_bound.js").Part} Part */
/** @typedef {import("./dragon.js").Dragon} Dragon */

/** A place of the head by its distance from the walk's start, m, or from its end; the first `count` benches are looked at. @typedef {{ after: number, left: number, count: number }} Hint */
/** Benches i < j (rows, from 0) so far apart, m (minus a depth), with the head at s, m. @typedef {{ distance: number, s: number, i: number, j: number }} Meeting */

const { HINT_STEP, SHRINKS, PARTS, AROUND, BEYOND, LAST, STEP, WIDTH, MOST_EVALUATIONS } =
  SOLVE_RANDOM_DANCE;
const { PARTNERS, MOST_PLACES, MOST_PAIRS, STEPS, PAIR, PLACED } = SOLVE_RANDOM_DANCE;
const { SEARCHED } = WALK_SEARCH;
/** What is nearer to touching than this, m, touches. */
export const { GRAZE } = SOLVE_RANDOM_DANCE;
// Handles times head positions that are placed at a time: memory of a page is never given back.
const PLACES = 100_000;

/** A dance in which some bench cannot follow the one before it. */
export class CannotFollowError extends BenchDragonError {}

/** The first of meetings in order of distance. @param {Meeting[]} meetings */
export function nearestOf(meetings) {
  return meetings.reduce((best, one) => {
    const nearer = one.distance < best.distance || (one.distance === best.distance && one.s < best.s);
    return nearer ? one : best;
  });
}

/** A dance to be searched. */
export class RandomDance {
  /**
   * @param {Arena} arena which holds its arrays
   * @param {Dragon} dragon the benches
   * @param {Numbers} rows the line, as the kernels see it
   * @param {Float64Array} aside how far to the left of the line each handle walks, m; empty: on it
   * @param {[number, number]} ends the head's first and last place along the line, m
   * @param {(wanted: number) => Part[]} open parts of the way outside which no benches come so near, m
   */
  constructor(arena, dragon, rows, aside, [start, end], open) {
    this.engine = arena.engine;
    this.dragon = dragon;
    this.rows = rows;
    this.aside = arena.vector(aside);
    this.start = start;
    this.end = end;
    this.open = open;
    const steps = this.#count(this.#whole, HINT_STEP);
    const handles = dragon.benches + 1;
    if (handles * steps > MOST_PLACES || 0.5 * handles ** 2 * steps > MOST_PAIRS)
      throw new InputError(_("the walk is too long, or the dragon, for random dances"));
  }

  /** @returns {Part} */
  get #whole() {
    return { start: this.start, end: this.end, count: this.dragon.benches };
  }

  /** Parts of the way outside which no benches come within a margin, m, or what counts as that. @param {number} margin */
  #open(margin) {
    return this.open(margin + 2 * GRAZE);
  }

  /** How many head positions no farther apart than that share of the shortest link. @param {Part} part @param {number} share */
  #count({ start, end }, share) {
    return 2 + Math.trunc((end - start) / (share * least(this.dragon.link)));
  }

  /** These positions, m. @param {Part} part @param {number} share */
  #grid(part, share) {
    return evenly(part.start, part.end, this.#count(part, share));
  }

  /** Links, offsets of handles, and sizes of the first benches. @param {Arena} arena @param {number} count */
  #leading(arena, count) {
    const { dragon, aside } = this;
    const { length, width, front_inset, rear_inset } = dragon;
    const columns = [length, width, front_inset, rear_inset].map((size) => size.subarray(0, count));
    const beside = aside.size ? firstRows(aside, count + 1) : aside;
    return [firstRows(dragon.links, count), beside, arena.table(columns, count)];
  }

  /** Where benches come about nearest, only where some may come within a margin, m; where none can, near the end. @param {number} margin */
  lowMeeting(margin) {
    const { benches: count } = this.dragon;
    const opened = this.#open(margin);
    const last = { start: Math.max(this.start, this.end - LAST), end: this.end, count };
    const parts = opened.length ? opened : [last];
    const seen = parts.map((part) => {
      const at = this.#grid(part, HINT_STEP);
      return { at, count: part.count, ...this.nearest(at, part.count) };
    });
    const best = nearestOf(seen.map(({ meeting }) => meeting));
    const { at, t, ...found } = seen.find(({ meeting }) => meeting === best) ?? seen[0];
    return this.#lowest(at.slice(Math.max(t - 1, 0), t + 2), found.count);
  }

  /** The head's place, as told to a dance with another pitch. @param {Meeting} meeting @returns {Hint} */
  hint({ s, j }) {
    return { after: s - this.start, left: this.end - s, count: j + 1 + BEYOND };
  }

  /** Where benches come about nearest around a place known from another pitch. @param {Hint} hint */
  meetingNear({ after, left, count }) {
    const { start, end } = this;
    const around = AROUND * greatest(this.dragon.link);
    const within = (/** @type {number} */ s) => Math.min(Math.max(s, start), end);
    const [one, other] = [within(start + after), within(end - left)];
    const centres = Math.abs(other - one) < 0.1 * around ? [one] : [one, other];
    return nearestOf(
      centres.map((s) =>
        this.#lowest(evenly(within(s - around), within(s + around), PARTS + 1), count),
      ),
    );
  }

  /** The lowest meeting of the first benches with the head at these places, or about it. @param {number[]} at @param {number} count */
  #lowest(at, count) {
    let { meeting: best, t } = this.nearest(at, count);
    for (let shrink = 0; shrink < SHRINKS; shrink++) {
      const [low, high] = [at[Math.max(t - 1, 0)], at[Math.min(t + 1, at.length - 1)]];
      at = evenly(low, high, PARTS + 1);
      const found = this.nearest(at, Math.min(count, best.j + 1 + BEYOND));
      t = found.t;
      best = nearestOf([best, found.meeting]);
    }
    return best;
  }

  /**
   * The nearest pair of the first benches with the head at any of these places, m, in order, and at which.
   * @param {number[]} at @param {number} count
   * @returns {{ meeting: Meeting, t: number }}
   */
  nearest(at, count) {
    const used = Math.min(count, this.dragon.benches);
    hold(PLACED * (used + 1) * at.length);
    spend((used + 1 + 0.5 * PAIR * used ** 2) * at.length);
    const slots = Math.max(2, Math.floor(PLACES / (used + 1)));
    const found = [];
    for (let first = 0; first < at.length; first += slots)
      found.push({ first, ...this.#nearestIn(at.slice(first, first + slots), used) });
    const best = nearestOf(found.map(({ meeting }) => meeting));
    const block = found.find(({ meeting }) => meeting === best) ?? found[0];
    return { meeting: best, t: block.first + block.t };
  }

  /** @param {number[]} at @param {number} count */
  #nearestIn(at, count) {
    return withArena(this.engine, (arena) => {
      const [links, aside, sizes] = this.#leading(arena, count);
      const places = arena.placements(count + 1, at.length);
      const [stood] = this.engine.call(
        "bd_perturbed_place_along", this.rows, links, aside, arena.vector(at), places,
      ); // prettier-ignore
      if (stood < at.length) throw stopped(at[stood]);
      const [distance, t, i, j] = this.engine.call("bd_box_nearest_pair", sizes, places.x, places.y);
      return { meeting: { distance, s: at[t], i, j }, t };
    });
  }

  /**
   * The first place at which benches come nearer than a margin, m, or all but; null if nowhere. None is
   * missed; a pair that comes within GRAZE of the margin may count.
   * @param {number} margin
   * @returns {Meeting | null}
   */
  touch(margin) {
    for (const part of this.#open(margin)) {
      const { ending, note } = this.#search(part, margin);
      if (ending === SEARCH.CLEAR) continue;
      const j = note[SEARCH.PAIR] % part.count;
      const i = (note[SEARCH.PAIR] - j) / part.count;
      return { distance: margin, s: note[SEARCH.UPPER], i, j };
    }
    return null;
  }

  /** Search a part of the walk: see `every_pair.search_all_pairs`. @param {Part} part @param {number} margin */
  #search(part, margin) {
    const at = this.#grid(part, STEP);
    let partners = PARTNERS;
    let found = { ending: /** @type {number} */ (SEARCH.CLEAR), note: new Float64Array(SEARCH.NOTES) };
    for (let n = 0; n < at.length - 1 && found.ending === SEARCH.CLEAR; n += STEPS) {
      const some = at.slice(n, n + STEPS + 1);
      while (
        (found = this.#searchSteps(part.count, partners, some, margin)).ending === EVERY_PAIR.CROWDED
      )
        partners *= 4;
    }
    if (found.ending === SEARCH.FALLEN) throw stopped(found.note[SEARCH.UPPER]);
    return found;
  }

  /** Search some steps of the head with room for so many pairs of a bench. @param {number} benches @param {number} partners @param {number[]} at @param {number} margin */
  #searchSteps(benches, partners, at, margin) {
    const pairs = Math.min(partners * benches, (benches * (benches - 1)) / 2);
    hold(8 * SEARCH.DEPTH * pairs);
    const found = withArena(this.engine, (arena) => {
      const [links, aside, sizes] = this.#leading(arena, benches);
      const [first, second] = [arena.array("q", pairs), arena.array("q", pairs)];
      const note = arena.full([SEARCH.NOTES], 0);
      const most = Math.min(MOST_EVALUATIONS, mostEvaluations(benches + 1));
      const [ending] = this.engine.call(
        "bd_every_pair_search_all_pairs", searchRoom(arena, benches + 1, benches, pairs),
        SEARCH.FIRST_TOUCH, this.rows, links, aside, sizes, arena.vector(at),
        first, second, margin, GRAZE, WIDTH, most, note,
      ); // prettier-ignore
      return { ending, note: doubles(note).slice() };
    });
    const chains = at.length + found.note[SEARCH.EVALUATIONS];
    spend(SEARCHED * (benches + 1) * chains + 0.5 * PAIR * benches ** 2 * at.length);
    return found;
  }
}

/** That a bench cannot follow with the head so far, m, or farther. @param {number} s */
export function stopped(s) {
  return new CannotFollowError(
    _("with the head at {s} m or after a bench cannot follow", { s: general(s, 4) }),
  );
}
