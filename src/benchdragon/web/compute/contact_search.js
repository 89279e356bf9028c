// A search along a walk for pairs of benches: its steps, the kernels' search of each, and its answers.
// Twin of analysis/contact_search.py.

import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { Arena, copied, doubles, withArena } from "./arena.js";
import { left, spend } from "./budget.js";
import {
  ANALYSIS_CONTACT_SEARCH,
  CELLS,
  COURSE,
  FAMILY,
  QUESTION,
  ROUTE,
  SEARCH,
  WALK_SEARCH,
} from "./constants.js";
import { boxes, nearness } from "./distance.js";
import { InputError, UnsureError, finite, notNegative } from "./errors.js";
import { HeadTimes } from "./head_times.js";
import { checkedOff, errorsAt, originOf, seenFrom } from "./nearby.js";
import { atMost, general } from "./number_format.js";
import { Rounds, repeats } from "./rounds.js";
import { Tables, walkTables, wholeAt } from "./tables.js";
import { tick } from "./tick.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./answer.js").Status} Status */
/** @typedef {import("./answer.js").Witness} Witness */
/** @typedef {import("./rounds.js").Span} Span */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {[number, number, number, number]} Limits margin, slack, width, m; most evaluations a step */

const { SLACK, WIDTH, MOST_EVALUATIONS, MOST_LEAST_EVALUATIONS, SAMPLES_AHEAD } =
  ANALYSIS_CONTACT_SEARCH;
const { CALL, SEARCHED } = WALK_SEARCH;
const { UNKNOWN } = FAMILY;

/** What answers rest on whose distances may be off by so much, m. @param {number} off */
export function assumedWithin(off) {
  const values = { slack: atMost(off) };
  return [_("computed distances are within {slack} m of the exact ones", values)];
}

/** Check two times, s. @param {number} start @param {number} end */
export function inOrder(start, end) {
  if (finite("end", end, "s") >= finite("start", start, "s")) return;
  const values = { end: general(end), start: general(start) };
  throw new InputError(_("the end ({end} s) must not come before the start ({start} s)", values));
}

/** So many numbers that rise by even factors from one to another. @param {number} low @param {number} high @param {number} count */
function geometric(low, high, count) {
  const [a, b] = [Math.log10(low), Math.log10(high)];
  return Array.from({ length: count }, (_number, n) => {
    if (n === 0 || n === count - 1) return n ? high : low;
    return 10 ** (a + ((b - a) * n) / (count - 1));
  });
}

/** Chains of so many handles that the question at hand may still march, in one step. @param {number} handles */
export function mostEvaluations(handles) {
  return Math.trunc(Math.min(Math.max(left() / (SEARCHED * handles), 1), MOST_EVALUATIONS));
}

/**
 * Search on for `goal`, in wider room where it is wanted; how that ended.
 * @param {Tables} tables
 * @param {number} goal
 * @param {Limits} limits those of kernels/walk_search.py
 * @param {Numbers} note likewise
 * @param {(ending: number) => void} tell hears how each call ended
 */
export async function runSearch(tables, goal, limits, note, tell) {
  const handles = tables.count + 1;
  let [margin, slack, width, most] = limits;
  for (;;) {
    const [known, before] = [tables.work, doubles(note)[SEARCH.EVALUATIONS]];
    most = Math.min(most, mostEvaluations(handles));
    const [ending] = tables.engine.call(
      "bd_walk_search_search_walk", tables.walk, tables.room, goal, margin, slack, width, most, note,
    ); // prettier-ignore
    const chains = doubles(note)[SEARCH.EVALUATIONS] - before;
    const marched = chains * wholeAt(tables.course.tally, COURSE.PLACED);
    spend(CALL + SEARCHED * marched + Math.max(tables.work - known, 0));
    tell(ending);
    if (ending === WALK_SEARCH.CROWDED) tables.widen();
    else if (ending !== QUESTION.MORE) return ending;
    else await tick();
  }
}

/** A search along a walk from one head position to another. */
export class ContactSearch {
  /**
   * @param {Arena} arena which holds what lasts as long as the search; see `close`
   * @param {Walk} walk
   * @param {number} start head positions, m
   * @param {number} end
   * @param {number} margin m
   * @param {Progress} progress
   * @param {number} [since] the time at which it begins, s
   * @param {Span[]} [spans] of the head's way, m, that are searched: the whole, or what repeats nothing
   * @param {number} [until] the time at which it ends, s
   */
  constructor(
    arena,
    walk,
    start,
    end,
    margin,
    progress,
    since = -Infinity,
    spans = [[start, end]],
    until = Infinity,
  ) {
    this.arena = arena;
    this.start = start;
    this.end = end;
    this.margin = margin;
    this.progress = progress;
    this.evaluations = 0;
    this.began = now();
    /** Near the dance, m. */
    this.origin = withArena(walk.engine, (scratch) =>
      originOf(walk.placement(scratch, [start], { throws: false })),
    );
    /** As given, but with coordinates counted from `origin`. */
    this.walk = seenFrom(arena, walk, this.origin);
    /** When the head comes to positions of the search. */
    this.times = new HeadTimes(this.walk, start, since, until);
    /** What computed distances may be off by that mattered so far, m. */
    this.off = SLACK;
    this.spans = spans;
    this.span = 0;
    this.near = 0;
    /** @type {Tables | null} */
    this.made = null;
    this.walkTables = walkTables(arena, this.walk);
  }

  /** Look for all pairs that come within reach, m, from the start on. @param {number} reach */
  begin(reach) {
    this.near = reach + SLACK;
    this.#beginSpan(0);
  }

  /** Begin once more with what was begun. */
  again() {
    if (this.span) this.#beginSpan(0);
    else this.tables.again();
  }

  /** @param {number} n */
  #beginSpan(n) {
    this.made?.free();
    const [first, last] = this.spans[(this.span = n)];
    const { engine } = this.walk;
    const tail = withArena(engine, (scratch) => {
      const s = doubles(this.walk.placement(scratch, [first], { throws: false }).s);
      return s[s.length - 2];
    });
    this.made = new Tables(engine, this.walkTables, first, last, this.near, tail);
    this.made.begin();
  }

  /** What it works on; made for the margin, if nothing was begun. */
  get tables() {
    if (!this.made) this.begin(this.margin);
    return /** @type {Tables} */ (this.made);
  }

  /** Give back what it works on. */
  close() {
    this.made?.free();
    this.made = null;
  }

  /** A note for kernels, of zeros but for some columns. @param {Record<number, number>} [known] */
  note(known = {}) {
    const note = this.arena.full([SEARCH.NOTES], 0);
    for (const [column, value] of Object.entries(known)) doubles(note)[Number(column)] = value;
    return note;
  }

  /** Walk through all steps in which pairs may come within reach: throws if the dragon cannot. */
  async walkThrough() {
    const note = this.note();
    while ((await this.#run(WALK_SEARCH.SEEK, note, 0)) === SEARCH.FOUND);
  }

  /**
   * Search on for `goal`; how that ended: CLEAR, at the very end, or as kernels/search.py says; and the
   * note.
   * @param {number} goal
   * @param {Record<number, number>} [known] columns of the note at first
   * @param {number} [tolerance] that of LEAST, m
   * @returns {Promise<[number, Float64Array]>}
   */
  async search(goal, known = {}, tolerance = 0) {
    const note = this.note(known);
    const ending = await this.#run(goal, note, tolerance);
    const found = copied(note);
    this.arena.drop(note);
    this.evaluations += found[SEARCH.EVALUATIONS];
    if (ending === SEARCH.FALLEN)
      throw this.stopped(found[SEARCH.LOWER], this.tables.way(COURSE.STEP_END));
    return [ending, found];
  }

  /** Search until it has come to something. @param {number} goal @param {Numbers} note @param {number} tolerance */
  async #run(goal, note, tolerance) {
    const most = tolerance ? MOST_LEAST_EVALUATIONS : MOST_EVALUATIONS;
    /** @type {Limits} */
    const limits = [this.margin, tolerance || SLACK, WIDTH, most];
    const tell = (/** @type {number} */ told) => {
      const gone = told === QUESTION.MORE ? this.tables.way(COURSE.AT) - this.start : -1;
      if (gone >= 0) this.progress(gone / (this.end - this.start), "");
    };
    let ending = await runSearch(this.tables, goal, limits, note, tell);
    while (ending === SEARCH.CLEAR && this.span + 1 < this.spans.length) {
      this.#beginSpan(this.span + 1);
      ending = await runSearch(this.tables, goal, limits, note, tell);
    }
    this.noteOff(doubles(note)[SEARCH.OFF]);
    if (ending === WALK_SEARCH.ASTRAY) throw this.#astray();
    const { length } = this.walk.route;
    if (ending === SEARCH.CLEAR && this.end > length + ROUTE.END_SLACK)
      throw this.stopped(length, this.end);
    return ending;
  }

  /** Why benches were not shown to follow. */
  #astray() {
    const [at, sound] = [COURSE.AT, COURSE.SOUND].map((column) => this.tables.way(column));
    if (at < sound) return this.stopped(at, sound);
    const cell = doubles(this.tables.ground.measures)[CELLS.CELL];
    return this.stopped(sound, sound + 2 * cell);
  }

  /** Why the walk could not be followed past head position `sound`, looked for up to `until`. @param {number} sound @param {number} until */
  stopped(sound, until) {
    // A bench may stand square to the route for a tenth of a millimetre only, and then leap.
    const reach = Math.max(Math.min(until, this.end) - sound, UNKNOWN);
    const ahead = geometric(UNKNOWN, reach, SAMPLES_AHEAD).map((far) => sound + far);
    const error = this.walk.firstFailure([sound, ...ahead]);
    if (error !== null && error.head <= sound + 2 * UNKNOWN) return error;
    const t = general(this.times.at(sound));
    return new UnsureError(
      _("past t = {t} s it could not be shown that every bench follows without a leap", { t }),
    );
  }

  /**
   * How benches i and j (rows, from 0) stand with the head at s.
   * @param {number} s @param {number} i @param {number} j
   * @returns {Witness}
   */
  witness(s, i, j) {
    return withArena(this.walk.engine, (arena) => {
      const table = boxes(arena, this.walk.placement(arena, [s], { throws: false }));
      const near = nearness(arena.engine, table, i, j);
      const [[owner]] = near.features;
      const [x, y] = near.points[near.benches.indexOf(owner)];
      /** @type {[number, number]} */
      const point = [x + this.origin[0], y + this.origin[1]];
      const { benches, distance: gap, features } = near;
      return { time: this.times.at(s), s, benches, point, gap, features, handle: null, obstacle: null };
    });
  }

  /** Take note of what a distance that matters may be off by, m. @param {number} off */
  noteOff(off) {
    this.off = Math.max(this.off, checkedOff(off));
  }

  /** What the distance of benches i and j (rows, from 0) may be off by with the head at s, m. @param {number} s @param {number} i @param {number} j */
  offAt(s, i, j) {
    const { off } = errorsAt(this.walk, s);
    return Math.max(SLACK, off[i] + off[j]);
  }

  /** The benches (rows, from 0) of a kernel's note. @param {Float64Array} note @returns {[number, number]} */
  pair(note) {
    const count = this.walk.dragon.benches;
    const [n, j] = [note[SEARCH.PAIR], note[SEARCH.PAIR] % count];
    return [(n - j) / count, j];
  }

  /**
   * A time between those at which the head is at lower and at upper, benches i and j meeting.
   * @param {number} lower @param {number} upper
   * @param {Status} status
   * @param {number} i @param {number} j
   */
  answerAt(lower, upper, status, i, j) {
    const [value, early, late, known] = this.times.told(lower, upper, status);
    const witness = this.witness(upper, i, j);
    return answered(value, early, late, "s", { status: known, witness, ...this.told() });
  }

  /** What answers rest on, and what they took. */
  told() {
    const { off, evaluations, began } = this;
    return { assumptions: assumedWithin(off), evaluations, seconds: now() - began };
  }
}

/**
 * What `use` makes of a search of the walk from start to end, s, for which the dragon must stand at the
 * start: of the whole of it, or but of what repeats nothing before it (see rounds.js).
 * @template T
 * @param {Walk} walk
 * @param {number} start @param {number} end s
 * @param {number} margin m
 * @param {Progress} progress
 * @param {(search: ContactSearch) => Promise<T>} use
 * @param {{ whole?: boolean }} [options]
 * @returns {Promise<T>}
 */
export async function withContactSearch(
  walk,
  start,
  end,
  margin,
  progress,
  use,
  { whole = false } = {},
) {
  notNegative("margin", margin, "m");
  inOrder(start, end);
  withArena(walk.engine, (arena) => walk.motion(arena, [start])); // throws where it cannot stand there
  const arena = new Arena(walk.engine);
  const [a, b] = [walk.headPosition(start), walk.headPosition(end)];
  let search = null;
  try {
    /** @type {Span[]} */
    const spans = whole ? [[a, b]] : new Rounds(walk, repeats(walk.route.rows)).new(a, b).spans;
    search = new ContactSearch(arena, walk, a, b, margin, progress, start, spans, end);
    return await use(search);
  } finally {
    search?.close();
    arena.free();
  }
}
