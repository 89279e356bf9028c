// Memory for searches along walks: what kernels/walk_search.py works on, made and made wider. Twin of
// analysis/tables.py.

import { _ } from "../words.js";
import { Arena, doubles, wholes } from "./arena.js";
import { hold } from "./budget.js";
import {
  ANALYSIS_TABLES,
  BEGINNING,
  CELLS,
  COURSE,
  CURVE,
  OWN_ROOM,
  ROUNDING,
  SEARCH,
  SPIRAL,
  STEP_BOUNDS,
  WALK_SEARCH,
} from "./constants.js";
import { InputError, UnsureError } from "./errors.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {{ sizes: Numbers, group: Numbers }} Kinds */
/** @typedef {ReturnType<typeof walkTables>} WalkTables */

const { MOST_SIZES, MOST_CELLS, PLACES, A_CELL, AT_FIRST, PAIRS, MEMBERS, DOUBTS } = ANALYSIS_TABLES;
const { WIDER } = OWN_ROOM;
const { BOX_WORK, PARTNER_WORK } = WALK_SEARCH;

/** A whole number of a list. @param {Numbers} list @param {number} n */
export function wholeAt(list, n) {
  return Number(list.view[n]);
}

/** Set a whole number of a list. @param {Numbers} list @param {number} n @param {number} value */
export function setWhole(list, n, value) {
  /** @type {BigInt64Array} */ (list.view)[n] = BigInt(value);
}

/** Let all of a list of whole numbers be one. @param {Numbers} list @param {bigint} value */
export function fillWhole(list, value) {
  /** @type {BigInt64Array} */ (list.view).fill(value);
  return list;
}

/**
 * The kind of each bench of a dragon, and the kinds: sizes (4, kinds), and the group of each.
 * @param {Arena} arena
 * @param {Pick<Dragon, "sizes" | "benches">} dragon
 * @returns {{ kind: Numbers, kinds: Kinds }}
 */
export function kindsOf(arena, { sizes, benches }) {
  const most = Math.min(MOST_SIZES, benches);
  const [found, kind] = [arena.array("d", 4, most), arena.array("q", benches)];
  const group = arena.array("q", most);
  const [count] = arena.engine.call("bd_kinds_find_kinds", sizes, found, kind, group);
  if (count > most) {
    const values = { most: MOST_SIZES, count: differentColumns(sizes) };
    throw new InputError(
      _("contacts can be searched for at most {most} different sizes, not {count}", values),
    );
  }
  const rows = [0, 1, 2, 3].map((n) => doubles(found).slice(n * most, n * most + count));
  const kinds = { sizes: arena.table(rows, count), group: arena.whole(wholes(group).slice(0, count)) };
  arena.drop(found, group);
  return { kind, kinds };
}

/** @param {Numbers} table */
function differentColumns({ view, shape: [rows, columns] }) {
  const said = Array.from({ length: columns }, (_column, j) =>
    Array.from({ length: rows }, (_row, i) => view[i * columns + j]).join(),
  );
  return new Set(said).size;
}

/**
 * A dragon on its route, as kernels want them.
 * @param {Arena} arena
 * @param {Walk} walk
 */
export function walkTables(arena, { dragon, route }) {
  const { kind, kinds } = kindsOf(arena, dragon);
  const ahead = arena.array("d", dragon.benches);
  let before = 0;
  const view = doubles(ahead);
  dragon.link.forEach((link, n) => {
    view[n] = before;
    before += link;
  });
  const lever = arena.vector([dragon.lever]);
  const benches = { links: dragon.links, sizes: dragon.sizes, kind, ahead, lever };
  return { rows: route.rows, benches, kinds };
}

/**
 * A grid of cells `side` metres wide with room for so many places, none of them put in yet.
 * @param {Arena} arena
 * @param {number} places
 * @param {number} side m
 */
export function emptyGrid(arena, places, side) {
  const buckets = 2 ** Math.max(4, 32 - Math.clz32(2 * places - 1));
  return {
    side: arena.vector([side]),
    heads: fillWhole(arena.array("q", buckets), 0n),
    nexts: arena.array("q", places),
    columns: arena.array("q", places),
    rows: arena.array("q", places),
  };
}

/**
 * Room for searches of up to so many handles, members and pairs: `search.room`.
 * @param {Arena} arena
 * @param {number} handles @param {number} members @param {number} pairs
 */
export function searchRoom(arena, handles, members, pairs) {
  const { DEPTH } = SEARCH;
  return {
    at: arena.array("d", DEPTH),
    places: arena.placements(handles, DEPTH),
    handles: arena.array("d", handles, STEP_BOUNDS.HANDLE_COLUMNS),
    sweeps: arena.array("d", members, STEP_BOUNDS.BENCH_COLUMNS),
    boxes: arena.array("d", DEPTH * members, CELLS.RADIUS),
    off: arena.array("d", DEPTH * members),
    lanes: arena.array("d", handles),
    errors: arena.array("d", handles),
    alive: arena.array("q", DEPTH, pairs),
    kept: arena.array("q", DEPTH),
  };
}

/** What a search along a walk works on. */
export class Tables {
  /**
   * @param {import("../engine.js").Engine} engine
   * @param {WalkTables} walk what is searched
   * @param {number} first head positions, m, between which it is; the dragon must be able to stand at
   *   the first
   * @param {number} last likewise
   * @param {number} reach distance of benches, m, within which pairs are wanted
   * @param {number} tail about the route position of the last bench with the head at `first`, m, or less
   */
  constructor(engine, walk, first, last, reach, tail) {
    this.engine = engine;
    this.walk = walk;
    this.span = [first, last];
    this.reach = reach;
    this.begun = first;
    const { rows, benches } = walk;
    this.count = benches.kind.size;
    const view = doubles(rows);
    const at = view.length - rows.shape[1];
    const end = view[at + CURVE.S_START] + view[at + CURVE.LENGTH];
    const cell = BEGINNING.CELL_SHARE * doubles(benches.links).reduce((a, b) => Math.min(a, b));
    const ahead = Math.floor(Math.min(last, end) / cell) - Math.floor(tail / cell);
    this.wanted = Math.max(ahead, 0) + 2;
    this.cells = Math.min(this.wanted, MOST_CELLS);
    const most = Math.min(A_CELL * this.cells, AT_FIRST);
    this.most = { parts: most, pairs: most, doubts: DOUBTS };
    this.benchPairs = PAIRS;
    this.members = Math.min(MEMBERS, this.count);
    this.arena = new Arena(engine);
    this.meetingArena = new Arena(engine);
    this.groundArena = new Arena(engine);
    this.block = this.#newBlock();
    this.course = {
      way: this.arena.array("d", COURSE.COURSE),
      tally: fillWhole(this.arena.array("q", COURSE.TALLY), 0n),
    };
    this.crowd = {
      hulls: this.arena.array("d", this.count, CELLS.HULL_COLUMNS),
      grid: emptyGrid(this.arena, this.count, this.#side()),
      found: this.arena.array("q", this.count),
    };
    this.meeting = this.#newMeeting();
    this.search = this.#newSearch();
    this.ground = this.#newGround();
    this.grids = this.#newGrids();
  }

  /** Dragons at the borders of steps to come. */
  #newBlock() {
    const handles = this.count + 1;
    const slots = Math.max(2, Math.min(SPIRAL.LANES, Math.floor(PLACES / handles)));
    return {
      at: this.arena.array("d", slots),
      places: this.arena.placements(handles, slots),
      s: this.arena.array("d", handles, slots),
    };
  }

  /** Begin the walk at its first position: nothing is known yet of the route ahead. */
  begin() {
    const [begun] = this.engine.call(
      "bd_beginning_begin_walk", this.walk, this.room, this.span[0], this.span[1], this.reach,
    ); // prettier-ignore
    if (!begun) throw new UnsureError(_("it could not be shown that the dragon stands all along"));
  }

  /** Room for the route ahead. */
  #newGround() {
    const [arena, { rows }] = [this.groundArena, this.walk];
    const groups = this.#groups();
    const [cells, { parts, pairs, doubts }] = [this.cells, this.most];
    const boxes = groups * cells + parts;
    const columns = CELLS.HULL_COLUMNS + CELLS.TREE_COLUMNS + 1;
    hold(8 * (boxes * columns + 4 * pairs + cells * groups * (groups + 2)));
    return {
      counts: fillWhole(arena.array("q", CELLS.COUNTS), 0n),
      measures: arena.array("d", CELLS.MEASURES),
      groups: arena.array("d", groups, CELLS.WAYS + groups),
      spans: arena.array("d", groups * groups * rows.shape[0], 2),
      span_of: arena.array("q", cells, groups * groups),
      middles: arena.array("d", cells, 2),
      hulls: arena.array("d", boxes, CELLS.HULL_COLUMNS),
      tree: arena.array("q", boxes, CELLS.TREE_COLUMNS),
      partners: arena.array("q", pairs, 2),
      todo: arena.array("q", boxes),
      near: arena.array("q", pairs, 2),
      doubts: arena.array("q", doubts, 2),
      seams: arena.array("d", rows.shape[0], ROUNDING.SEAM_COLUMNS),
    };
  }

  /** Where its cells are. */
  #newGrids() {
    const [arena, whole] = [this.groundArena, this.#groups() * this.cells];
    return {
      middles: emptyGrid(arena, this.cells, this.#side()),
      boxes: emptyGrid(arena, whole, this.#side()),
      found: arena.array("q", whole),
    };
  }

  /** Number of the groups of kinds. */
  #groups() {
    return wholes(this.walk.kinds.group).reduce((a, b) => Math.max(a, b)) + 1;
  }

  /** Room for the route, of which nothing is known. */
  #renewGround() {
    this.groundArena.free();
    this.ground = this.#newGround();
    this.grids = this.#newGrids();
  }

  /** That of the squares of grids, m: about how far benches are looked for. */
  #side() {
    const { view, shape } = this.walk.kinds.sizes;
    let widest = 0;
    for (let k = 0; k < shape[1]; k++)
      widest = Math.max(widest, Math.hypot(Number(view[k]), Number(view[shape[1] + k])));
    return 2 * widest + this.reach;
  }

  /** Room for the pairs of a step. */
  #newMeeting() {
    const arena = this.meetingArena;
    const [first, second, mine, other] = [0, 1, 2, 3].map(() => arena.array("q", this.benchPairs));
    const members = arena.array("q", this.count);
    const place = fillWhole(arena.array("q", this.count), -1n);
    return { first, second, mine, other, members, place };
  }

  /** Room to search a step. */
  #newSearch() {
    return searchRoom(this.meetingArena, this.count + 1, this.members, this.benchPairs);
  }

  /** All of it but the walk, as kernels take it. */
  get room() {
    const { ground, grids, block, crowd, course, meeting, search } = this;
    return /** @type {any} */ ({ ground, grids, block, crowd, course, meeting, search });
  }

  /** What it took to come to know the route and to place dragons so far, in handles placed. */
  get work() {
    const [counts, tally] = [wholes(this.ground.counts), wholes(this.course.tally)];
    const known = BOX_WORK * counts[CELLS.BORDERS] + PARTNER_WORK * counts[CELLS.ENTRIES];
    return known + tally[COURSE.CHAINS] * this.count;
  }

  /** A measure of where the walk stands: a column of kernels/course.py. @param {number} column */
  way(column) {
    return doubles(this.course.way)[column];
  }

  /**
   * Let the walk begin at head position start, m, and end at `end`, both within the first one.
   *
   * What is known of the route stays known.
   * @param {number} start @param {number} end
   */
  go(start, end) {
    this.begun = start;
    doubles(this.course.way)[COURSE.GOAL] = Math.min(end, doubles(this.ground.measures)[CELLS.END]);
    this.again();
  }

  /** Let the walk begin once more where it last began. */
  again() {
    const way = doubles(this.course.way);
    way.fill(this.begun, 0, COURSE.GOAL);
    way.fill(this.begun, COURSE.GOAL + 1);
    fillWhole(this.course.tally, 0n);
  }

  /** Make room where it did not do: for the step at hand, or for the route, which begins anew. */
  widen() {
    if (!this.#enlarge()) return;
    const [at, goal] = [this.way(COURSE.AT), this.way(COURSE.GOAL)];
    this.begin();
    const way = doubles(this.course.way);
    for (const column of [COURSE.AT, COURSE.UPTO, COURSE.KNOWN, COURSE.SOUND]) way[column] = at;
    way[COURSE.GOAL] = goal;
  }

  /** Make room where it did not do; whether that is room for the route, nothing known of it. */
  #enlarge() {
    const counts = wholes(this.ground.counts);
    this.#enlargeCells(counts[CELLS.CELLS]);
    const whole = this.ground.groups.shape[0] * this.ground.middles.shape[0];
    const wanted = {
      parts: counts[CELLS.ROWS] - whole,
      pairs: Math.max(counts[CELLS.ENTRIES], counts[CELLS.NEAR]),
      doubts: counts[CELLS.DOUBTS],
    };
    let short = false;
    for (const name of /** @type {Array<keyof typeof wanted>} */ (Object.keys(wanted))) {
      if (wanted[name] <= this.most[name]) continue;
      this.most[name] = WIDER * wanted[name];
      short = true;
    }
    if (short || this.cells > this.ground.middles.shape[0]) {
      this.#renewGround();
      return true;
    }
    this.#enlargeMeeting();
    return false;
  }

  #enlargeMeeting() {
    const pairs = wholeAt(this.course.tally, COURSE.PAIRS);
    this.benchPairs = Math.max(this.benchPairs, WIDER * pairs);
    this.members = Math.max(this.members, Math.min(2 * pairs, this.count));
    const [kept, arena] = [this.meeting, this.meetingArena];
    this.meetingArena = new Arena(this.engine);
    this.meeting = this.#newMeeting();
    this.search = this.#newSearch();
    for (const name of /** @type {const} */ (["first", "second"])) {
      const view = /** @type {BigInt64Array} */ (this.meeting[name].view);
      view.set(/** @type {BigInt64Array} */ (kept[name].view));
    }
    arena.free();
  }

  /** Count on more cells if all are used. @param {number} used */
  #enlargeCells(used) {
    if (used < this.cells || this.wanted === this.cells) return;
    if (this.cells === MOST_CELLS) {
      const values = { most: MOST_CELLS };
      throw new UnsureError(
        _("the walk is too long to be searched: more than {most} cells of its route", values),
      );
    }
    this.cells = Math.min(WIDER * this.cells, MOST_CELLS);
  }

  /**
   * Work on another walk from now on, of as many benches of as many kinds: to be begun.
   *
   * Its route may be of another length and fill other rows, if not more.
   * @param {WalkTables} walk
   * @param {number} first @param {number} last @param {number} reach m
   */
  aim(walk, first, last, reach) {
    this.walk = walk;
    this.span = [first, last];
    this.reach = reach;
    this.begun = first;
    this.wanted = MOST_CELLS + 1; // it is not known how many cells the route has
    this.#renewGround();
  }

  /** Give all back. */
  free() {
    for (const arena of [this.arena, this.groundArena, this.meetingArena]) arena.free();
  }
}
