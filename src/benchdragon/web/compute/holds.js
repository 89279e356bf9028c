// A head that stands still at places or times: twin of model/holds.py.

import { MODEL_HOLDS } from "./constants.js";
import { InputError } from "./errors.js";
import { Profile } from "./profile.js";

/** That the head stands still: where, m from where the walk begins, or from when on, s; for how long, s. */
/** @typedef {{ way: number | null, at: number | null, seconds: number }} Hold */
/** Where, m from where the walk begins, and when, s, the head stands for a hold (number, from 0). */
/** @typedef {{ number: number, way: number, start: number, end: number }} Standing */
/** A moment of the walk: s, m from where it begins, m/s. */
/** @typedef {{ time: number, way: number, speed: number }} Knot */
/** @typedef {"overlap" | "room" | "unreachable" | "outside" | "over"} Trouble */

/** A hold that cannot be: the number of it, from 0, and what kind of trouble it is. */
export class HoldError extends InputError {
  /** @param {number} number @param {Trouble} trouble */
  constructor(number, trouble) {
    super(trouble);
    this.number = number;
    this.trouble = trouble;
  }
}

/** A part of the way, m, along which the squared speed changes evenly; or a rest of some seconds. */
class WayPiece {
  /** @param {number} first @param {number} last @param {number} before @param {number} after @param {number} rest */
  constructor(first, last, before, after, rest = 0) {
    this.first = first;
    this.last = last;
    this.before = before;
    this.after = after;
    this.rest = rest;
  }

  /** The squared speed at a place on the piece. @param {number} way */
  square(way) {
    if (this.before === this.after) return this.before;
    const share = (way - this.first) / (this.last - this.first);
    return this.before + share * (this.after - this.before);
  }

  /** Where the squared speed is that of a head which stands at `way` and gains `slope` a metre. @param {number} way @param {number} slope */
  meets(way, slope) {
    const change = this.after - this.before;
    const own = change === 0 ? 0 : change / (this.last - this.first);
    return own === slope ? Infinity : way + this.square(way) / (slope - own);
  }
}

/** A profile from a time on as squared speeds along the way; the last piece has no end. @param {Profile} profile @param {number} start */
function wayPieces(profile, start) {
  const end = Math.max(profile.times[profile.times.length - 1], start);
  const cut = end > start ? profile.stretches(start, end) : [];
  const found = cut.map(({ times, ways, speeds: [v, w] }) => {
    const [a, b] = ways.map((way) => way - cut[0].ways[0]);
    return new WayPiece(a, b, v * v, w * w, b > a ? 0 : times[1] - times[0]);
  });
  const way = found.length ? found[found.length - 1].last : 0;
  const square = profile.speed(end) ** 2;
  return [...found, new WayPiece(way, Infinity, square, square)];
}

/** The knots of a walk so far. */
class Pace {
  /** @param {WayPiece[]} pieces @param {number} rate @param {number[]} starts @param {Knot} first */
  constructor(pieces, rate, starts, first) {
    this.pieces = pieces;
    this.rate = rate;
    this.starts = starts;
    this.knots = [first];
    /** @type {Standing[]} */
    this.stood = [];
  }

  /** @returns {Knot} */
  get now() {
    return this.knots[this.knots.length - 1];
  }

  /** Whether the head stands for good. */
  get over() {
    return this.stood.length > 0 && this.stood[this.stood.length - 1].end === Infinity;
  }

  /** Go on to the hold that comes first of those waiting, and stand; its number. @param {Hold[]} holds @param {Set<number>} waiting */
  standNext(holds, waiting) {
    const { now } = this;
    const [way, placed] = leastOf(waiting, (n) => holds[n].way);
    const [at, timed] = leastOf(waiting, (n) => holds[n].at);
    if (this.over) throw new HoldError(Math.min(...waiting), "over");
    if (this.stood.length && way <= now.way + MODEL_HOLDS.SAME_PLACE)
      throw new HoldError(placed, "overlap");
    if (at < now.time || (this.stood.length && at === now.time && at < Infinity))
      throw new HoldError(timed, this.stood.length ? "overlap" : "outside");
    if (this.#brakesTooLate(way)) throw new HoldError(placed, "room");
    const ahead = this.ahead(way);
    const last = ahead.length ? ahead[ahead.length - 1] : now;
    const reached = way < Infinity ? last.time : Infinity;
    if (at < reached) {
      this.knots.push(...this.#braked(timed, at, ahead));
      this.#stand(timed, holds[timed]);
      return timed;
    }
    if (reached === Infinity) throw new HoldError(placed, "unreachable");
    this.knots.push(...ahead);
    this.#stand(placed, holds[placed]);
    return placed;
  }

  /** Whether the head is faster now than braking until a place allows. @param {number} way */
  #brakesTooLate(way) {
    const { now } = this;
    return way > MODEL_HOLDS.SAME_PLACE && now.speed ** 2 > 2 * this.rate * (way - now.way);
  }

  /**
   * The knots from now to a place where the head is to stand, or for ever on.
   * The last is at an infinite time where the head never comes to that place.
   * @param {number} target
   */
  ahead(target) {
    const { now } = this;
    if (target - now.way <= MODEL_HOLDS.SAME_PLACE) return [];
    const found = [now];
    const before = () => found[found.length - 1];
    for (const piece of this.pieces) {
      const [first, last] = [Math.max(piece.first, now.way), Math.min(piece.last, target)];
      if (piece.rest && now.way < piece.first && piece.first < target)
        found.push({ time: before().time + piece.rest, way: piece.first, speed: 0 });
      if (last <= first) continue;
      for (const way of this.#cuts(piece, first, last, target))
        found.push(...reachedKnot(before(), way, this.#speed(piece, way, target)));
    }
    return found.slice(1);
  }

  /** Places on a piece at which the squared speed bends, and where it ends. @param {WayPiece} piece @param {number} first @param {number} last @param {number} target */
  #cuts(piece, first, last, target) {
    const slope = 2 * this.rate;
    /** @type {Array<[number, number]>} */
    const lines = [];
    if (this.stood.length) lines.push([this.now.way, slope]);
    if (target < Infinity) lines.push([target, -slope]);
    const cuts = lines.map(([way, along]) => piece.meets(way, along));
    if (lines.length === 2) cuts.push(0.5 * (this.now.way + target));
    const inside = cuts.filter((cut) => first < cut && cut < last);
    if (last < Infinity) inside.push(last);
    return [...new Set(inside)].sort((a, b) => a - b);
  }

  /** The speed at a place, which nothing that is held exceeds. @param {WayPiece} piece @param {number} way @param {number} target */
  #speed(piece, way, target) {
    let square = Math.min(piece.square(way), 2 * this.rate * (target - way));
    if (this.stood.length) square = Math.min(square, 2 * this.rate * (way - this.now.way));
    return Math.sqrt(Math.max(square, 0));
  }

  /**
   * The knots until the head stands at a time, braking before as late as it can.
   * @param {number} number
   * @param {number} at
   * @param {Knot[]} ahead
   * @returns {Knot[]}
   */
  #braked(number, at, ahead) {
    const early = [this.now, ...ahead].filter((knot) => knot.time < at);
    const knots = early.length ? early : [this.now];
    const rest = ahead.filter((knot) => knot.time >= at);
    const last = knots[knots.length - 1];
    const fast = rest.length ? steadySpeed(rest[0], last, at) : last.speed;
    knots.push({ time: at, way: NaN, speed: fast });
    if (at === last.time && !this.stood.length) return [];
    for (let n = knots.length - 1; n > 0; n--) {
      const { time: t, way, speed: v } = knots[n - 1];
      const { time: u, speed: w } = knots[n];
      const [before, after] = [v - this.rate * (at - t), w - this.rate * (at - u)];
      if (before > 0) continue;
      const brakes = before === 0 ? t : t + ((u - t) * before) / (before - after);
      const speed = this.rate * (at - brakes);
      const place = way + 0.5 * (v + speed) * (brakes - t);
      const stops = place + 0.5 * speed * (at - brakes);
      const begins = t < brakes && brakes < at ? [{ time: brakes, way: place, speed }] : [];
      return [...knots.slice(1, n), ...begins, { time: at, way: stops, speed: 0 }];
    }
    throw new HoldError(number, "room");
  }

  /** Stand from now on, for as long as a hold says. @param {number} number @param {Hold} hold */
  #stand(number, hold) {
    const now = { ...this.now, speed: 0 };
    this.knots[this.knots.length - 1] = now;
    let end = now.time + hold.seconds;
    if (hold.seconds === Infinity) end = this.starts.find((time) => time >= now.time) ?? Infinity;
    this.stood.push({ number, way: now.way, start: now.time, end });
    if (now.time < end && end < Infinity) this.knots.push({ time: end, way: now.way, speed: 0 });
  }
}

/** The least of a measure, infinite where there is none, and whose it is. @param {Set<number>} waiting @param {(n: number) => number | null} measure @returns {[number, number]} */
function leastOf(waiting, measure) {
  const numbers = [...waiting].sort((a, b) => a - b);
  const values = numbers.map((n) => measure(n) ?? Infinity);
  const least = Math.min(...values);
  return [least, numbers[values.indexOf(least)]];
}

/** The speed at a time between two knots. @param {Knot} after @param {Knot} before @param {number} at */
function steadySpeed(after, before, at) {
  const share = Number.isFinite(after.time) ? (at - before.time) / (after.time - before.time) : 0;
  return before.speed + share * (after.speed - before.speed);
}

/** The knot at a place, m, at a speed, m/s; none where it is no later than the one before. @param {Knot} before @param {number} way @param {number} speed */
function reachedKnot(before, way, speed) {
  const [ahead, pace] = [way - before.way, 0.5 * (before.speed + speed)];
  const time = before.time + (pace ? ahead / pace : Infinity);
  return time > before.time ? [{ time, way, speed }] : [];
}

/**
 * A profile with holds in it, and where and when each is, one after another.
 * @param {Profile} profile of the walk without holds, whose speeds stay those at its places
 * @param {number} start when the walk begins, s
 * @param {Hold[]} holds in any order
 * @param {number[]} starts times, s, at which a head starts that stands until then
 * @param {number} rate at which the head brakes and starts, m/s^2
 */
export function withHolds(profile, start, holds, starts, rate) {
  const pieces = wayPieces(profile, start);
  const sorted = [...starts].sort((a, b) => a - b);
  const first = { time: start, way: 0, speed: Math.sqrt(pieces[0].before) };
  const pace = new Pace(pieces, rate, sorted, first);
  const waiting = new Set(holds.map((_hold, n) => n));
  while (waiting.size) waiting.delete(pace.standNext(holds, waiting));
  if (!pace.over) pace.knots.push(...pace.ahead(Infinity));
  const times = pace.knots.map(({ time }) => time);
  return { profile: new Profile(times, pace.knots.map(({ speed }) => speed)), stood: pace.stood }; // prettier-ignore
}
