// A head that stands still at places or times: twin of model/holds.py.

import { arena, doubles, rowOf, wholes, withArena } from "./arena.js";
import { HOLDS, MODEL_HOLDS } from "./constants.js";
import { InputError } from "./errors.js";
import { SpeedProfile } from "../made/profile.js";
import { stretchesOf } from "./stretches.js";

/** That the head stands still: where, m from where the walk begins, or from when on, s; for how long, s. */
/** @typedef {{ way: number | null, at: number | null, seconds: number }} Hold */
/** Where, m from where the walk begins, and when, s, the head stands for a hold (number, from 0). */
/** @typedef {{ number: number, way: number, start: number, end: number }} Standing */
/** @typedef {"overlap" | "room" | "unreachable" | "outside" | "over"} Trouble */

/** What the kernel says of a hold that cannot be, from 1 on. @type {Trouble[]} */
const TROUBLES = ["overlap", "room", "unreachable", "outside", "over"];

/** A hold that cannot be: the number of it, from 0, and what kind of trouble it is. */
export class HoldError extends InputError {
  /** @param {number} number @param {Trouble} trouble */
  constructor(number, trouble) {
    super(trouble);
    this.number = number;
    this.trouble = trouble;
  }
}

/** A profile from a time on as squared speeds along the way: see kernels/holds.py. @param {SpeedProfile} profile @param {number} start */
function piecesOf(profile, start) {
  const end = Math.max(profile.times[profile.times.length - 1], start);
  const cut = stretchesOf(profile, start, end);
  const found = cut.map(({ times, ways, speeds: [v, w] }) => {
    const [a, b] = ways.map((way) => way - cut[0].ways[0]);
    return [a, b, v * v, w * w, b > a ? 0 : times[1] - times[0]];
  });
  const square = profile.speed(end) ** 2;
  return [...found, [found[found.length - 1][1], Infinity, square, square, 0]];
}

/**
 * A profile with holds in it, and where and when each is, one after another.
 * @param {SpeedProfile} profile of the walk without holds, whose speeds stay those at its places
 * @param {number} start when the walk begins, s
 * @param {Hold[]} holds in any order
 * @param {number[]} starts times, s, at which a head starts that stands until then
 * @param {number} rate at which the head brakes and starts, m/s^2
 */
export function withHolds(profile, start, holds, starts, rate) {
  const { engine } = arena();
  const pieces = piecesOf(profile, start);
  const asked = holds.map(({ way, at, seconds }) => [way ?? Infinity, at ?? Infinity, seconds]);
  for (let room = MODEL_HOLDS.KNOTS * (pieces.length + holds.length + 1); ; room *= 2) {
    const found = withArena(engine, (arena) => {
      const held = {
        pieces: arena.table(pieces, HOLDS.PIECE_COLUMNS),
        starts: arena.vector([...starts].sort((a, b) => a - b)),
        holds: arena.table(asked, HOLDS.HOLD_COLUMNS),
        knots: arena.array("d", room, HOLDS.KNOT_COLUMNS),
        stood: arena.array("d", holds.length, HOLDS.STOOD_COLUMNS),
        waiting: arena.array("q", holds.length),
        counts: arena.array("q", HOLDS.COUNTS),
      };
      const [trouble] = engine.call("bd_holds_hold_head", held, start, rate);
      const counts = wholes(held.counts);
      if (counts[HOLDS.SHORT]) return null;
      if (trouble !== HOLDS.FINE) throw new HoldError(counts[HOLDS.TOLD], TROUBLES[trouble - 1]);
      const knots = rowsOf(held.knots).slice(0, counts[HOLDS.KNOTS]);
      const stood = rowsOf(held.stood).map(([number, way, start, end]) => ({
        number,
        way,
        start,
        end,
      }));
      const [times, speeds] = [HOLDS.TIME, HOLDS.SPEED].map((n) => knots.map((knot) => knot[n]));
      return /** @type {const} */ ([new SpeedProfile(times, speeds), stood]);
    });
    if (found) return found;
  }
}

/** The rows of a table. @param {import("../engine.js").Numbers} table */
function rowsOf(table) {
  return Array.from({ length: table.shape[0] }, (_row, n) => Array.from(doubles(rowOf(table, n))));
}
