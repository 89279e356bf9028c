// A dragon on a route: where every handle is and how fast, at any time. Twin of model/walk.py and
// model/placement.py.

import { _ } from "../words.js";
import { doubles, flat, withArena, wholes } from "./arena.js";
import { hold, spend } from "./budget.js";
import { CURVE, MODEL_PLACEMENT, ROUTE, Status } from "./constants.js";
import { InputError, WalkError, finite } from "./errors.js";
import { general } from "./number_format.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {Omit<import("../made/curves.js").Route, "joints"> & { joints: Float64Array }} Route */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("../made/profile.js").SpeedProfile} SpeedProfile */
/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../engine.js").Numbers} Numbers */

const { PLACE } = MODEL_PLACEMENT;
// How near to the last sound place a failure is told, m: FAILURE_TOLERANCE of model/walk.py.
const FAILURE_NEAR = 1e-9;

/**
 * The dragon with its head at T route positions. Its tables are as kernels march, a row a handle:
 * (handles, T); one that fails holds NaN from the handle that found no place on.
 */
export class Placement {
  /**
   * @param {Arena} arena which holds the tables
   * @param {Dragon} dragon
   * @param {Route} route
   * @param {ArrayLike<number>} headS route positions of the head's handle, m
   */
  constructor(arena, dragon, route, headS) {
    this.arena = arena;
    this.dragon = dragon;
    this.route = route;
    this.headS = Float64Array.from(headS);
    this.handles = dragon.benches + 1;
    this.count = headS.length;
    spend(this.handles * this.count);
    hold(PLACE * this.handles * this.count);
    const table = () => arena.array("d", this.handles, this.count);
    this.row = arena.array("q", this.handles, this.count);
    this.u = table();
    this.x = table();
    this.y = table();
    /** Speed of every handle over the head's. */
    this.ratio = table();
    const failed = arena.array("q", 2, this.count);
    const [at, none] = [arena.vector(headS), arena.array("d", 0, 0)];
    const { row, u, x, y, ratio } = this;
    const places = { row, u, x, y, ratio, tx: none, ty: none, failed };
    arena.engine.call("bd_chain_march", route.rows, dragon.links, at, 0, this.count, places);
    const ended = wholes(failed);
    arena.drop(at, none, failed);
    /** How each ended, a `Status`. */
    this.status = ended.slice(0, this.count);
    /** The bench that found no place; 0 where none, or the head, failed. */
    this.failedBench = ended.slice(this.count);
    /** @type {Numbers | null} */
    this.positions = null;
  }

  /** Route position of every handle, m, (handles, T). */
  get s() {
    if (!this.positions) {
      this.positions = this.arena.array("d", this.handles, this.count);
      const { row, u, positions, route } = this;
      this.arena.engine.call("bd_route_positions", route.rows, flat(row), flat(u), flat(positions));
    }
    return this.positions;
  }

  /** Number of the first position that fails; -1 if none does. */
  get firstFailed() {
    return this.status.findIndex((status) => status !== Status.OK);
  }

  /** The WalkError that describes how position number i failed. @param {number} i */
  failure(i) {
    const [head, bench] = [this.headS[i], this.failedBench[i]];
    if (!bench) return new WalkError(this.status[i], bench, head, head, metres(this.route.length));
    const s = doubles(this.s)[(bench - 1) * this.count + i];
    return new WalkError(this.status[i], bench, s, head, metres(this.dragon.link[bench - 1]));
  }

  /** Throw the WalkError of the first position that failed, if one did. */
  check() {
    if (this.firstFailed >= 0) throw this.failure(this.firstFailed);
  }
}

/** Places and speeds of all handles at T times. */
export class Motion extends Placement {
  /**
   * @param {Arena} arena
   * @param {Walk} walk what moved
   * @param {ArrayLike<number>} times s
   * @param {ArrayLike<number>} headS
   */
  constructor(arena, walk, times, headS) {
    super(arena, walk.dragon, walk.route, headS);
    this.walk = walk;
    this.times = Float64Array.from(times);
    /** Speed of the head's handle, m/s, (T,). */
    this.headSpeed = this.times.map((t) => walk.profile.speed(t));
  }

  /** Speed of every handle along the route, m/s, (handles, T). */
  get speed() {
    const found = doubles(this.ratio).slice();
    for (let i = 0; i < found.length; i++) found[i] *= this.headSpeed[i % this.count];
    return found;
  }

  /** The WalkError that describes how time number i failed. @param {number} i */
  failure(i) {
    return super.failure(i).at(this.times[i]);
  }
}

/** A dragon, the route it walks, and the head's speed. */
export class Walk {
  /**
   * @param {Dragon} dragon
   * @param {Route} route
   * @param {SpeedProfile} profile
   * @param {number} [start] route position of the head's handle at time 0, m
   */
  constructor(dragon, route, profile, start = 0) {
    this.engine = route.engine;
    this.dragon = dragon;
    this.route = route;
    this.profile = profile;
    this.start = start;
    if (Math.abs(finite("start", start, "m")) > CURVE.MOST_METRES)
      throw new InputError(_("start must lie within 1e8 m, not at {s} m", { s: general(start) }));
  }

  /** The same for several times. @param {ArrayLike<number>} times */
  head_position(times) {
    return Float64Array.from(times, (t) => this.headPosition(t));
  }

  /** Route position of the head's handle at a time, m. @param {number} t */
  headPosition(t) {
    return this.start + this.profile.distance(t);
  }

  /** When the head comes to route position s, m; infinite where it never does. @param {number} s */
  time_at(s) {
    return this.profile.time(s - this.start);
  }

  /**
   * The dragon with its head at route positions s, m, whenever that may be.
   * @param {Arena} arena
   * @param {ArrayLike<number>} s
   * @param {{ throws?: boolean }} [options] whether the first position that fails throws, at its time
   */
  placement(arena, s, { throws = true } = {}) {
    const placed = new Placement(arena, this.dragon, this.route, s);
    if (throws && placed.firstFailed >= 0) throw this.failure(placed, placed.firstFailed);
    return placed;
  }

  /** The WalkError of position number i of a placement on this walk. @param {Placement} placed @param {number} i */
  failure(placed, i) {
    return Placement.prototype.failure.call(placed, i).at(this.time_at(placed.headS[i]));
  }

  /**
   * Where the dragon first cannot stand, its head at or between increasing positions, m; null if it can.
   * @param {ArrayLike<number>} at
   */
  first_failure(at) {
    const { length } = this.route;
    const placed = this.tried_(Array.from(at, (s) => Math.min(s, length)));
    const n = placed.firstFailed;
    if (n < 0) {
      const end = new WalkError(Status.AFTER_ROUTE, 0, length, length, metres(length));
      return at[at.length - 1] > length + ROUTE.END_SLACK ? end.at(this.time_at(length)) : null;
    }
    let stands = placed.headS[Math.max(n - 1, 0)];
    let fails = placed.headS[n];
    for (;;) {
      const middle = 0.5 * (stands + fails);
      if (!(stands < middle && middle < fails - 0.5 * FAILURE_NEAR)) break;
      if (this.tried_([middle]).firstFailed >= 0) fails = middle;
      else stands = middle;
    }
    return withArena(this.engine, (arena) => {
      return this.failure(this.placement(arena, [fails], { throws: false }), 0);
    });
  }

  /** How placements end; their tables are given back. @param {number[]} at */
  tried_(at) {
    return withArena(this.engine, (arena) => {
      const { headS, firstFailed } = this.placement(arena, at, { throws: false });
      return { headS, firstFailed };
    });
  }

  /** The head's route position, m, when the last handle has come to route position s (m). @param {number} s */
  head_where_tail(s) {
    return withArena(this.engine, (arena) => {
      const places = arena.placements(this.dragon.benches + 1, 1);
      const [{ rows }, { links }, at] = [this.route, this.dragon, arena.array("d", 1)];
      return this.engine.call("bd_local_minima_head_where_tail", rows, links, finite("s", s, "m"), at, places)[0]; // prettier-ignore
    });
  }

  /**
   * Where every handle is, and how fast, at `times`, s.
   * @param {Arena} arena
   * @param {ArrayLike<number>} times
   * @param {{ throws?: boolean, headS?: ArrayLike<number> }} [options] `throws`: whether the first time
   *   that fails throws; `headS`: the head's route positions, found in another way
   */
  motion(arena, times, { throws = true, headS } = {}) {
    const at = headS ?? Float64Array.from(times, (t) => this.headPosition(t));
    const motion = new Motion(arena, this, times, at);
    if (throws) motion.check();
    return motion;
  }
}

/** @param {number} length */
function metres(length) {
  return `${general(length)} m`;
}
