// Drum beats, holds, stops and starts of a plan: twin of plans/cues.py.

import { _, language } from "../words.js";
import { HOLDS, PLANS_CUES } from "./constants.js";
import { Fault, KeyedError, keyed } from "./errors.js";
import { HoldError, withHolds } from "./holds.js";
import { general } from "./number_format.js";

/** @typedef {import("./profile.js").Profile} Profile */
/** @typedef {import("./holds.js").Standing} Standing */
/** @typedef {Record<string, any>} CueTable a cue of a plan, filled */

/**
 * A cue in its time and place.
 * @typedef {object} Moment
 * @property {number} number of the cue in the plan, from 0
 * @property {CueTable} cue
 * @property {number} time s
 * @property {number} way of the head from the start of the dance, m
 * @property {number} until when the head goes on, s: `time` where it is not held, infinite where it stays
 */

/** @param {import("./holds.js").Trouble} trouble @param {Record<string, string>} values */
function troubleText(trouble, values) {
  switch (trouble) {
    case "overlap":
      return _("the head still stands for another cue then: set them farther apart");
    case "room":
      return _(
        "to stand there the head would have to brake harder than {rate} m/s^2: set it later",
        values,
      );
    case "unreachable":
      return _("the head never comes there");
    case "outside":
      return _("that is before the dance starts, at {start} s", values);
    default:
      return _("the dance is over by then: the head has stopped, and no start comes after");
  }
}

/** What is said of a cue in the language in use; its kind, if nothing is. @param {CueTable} cue */
export function cueName(cue) {
  const own = language() === "zh" ? cue.text_zh || cue.text : cue.text || cue.text_zh;
  if (own) return own;
  switch (cue.kind) {
    case "beat":
      return _("drum");
    case "hold":
      return _("hold");
    case "stop":
      return _("stop");
    case "start":
      return _("start");
    case "tempo":
      return _("tempo");
    default:
      return _("note");
  }
}

/** The head's speed with all that holds it. */
export class Paced {
  /** @param {Profile} profile @param {number} start of the dance, s @param {Standing[]} standings by the numbers of cues */
  constructor(profile, start, standings) {
    this.profile = profile;
    this.start = start;
    this.standings = standings;
  }

  /** When the head stops for good, s; infinite where it does not. */
  get end() {
    const last = this.standings[this.standings.length - 1];
    return last === undefined || last.end < Infinity ? Infinity : last.start;
  }

  /** How far the head is from where the dance starts at a time, m. @param {number} time */
  way(time) {
    return this.profile.distance(time) - this.profile.distance(this.start);
  }

  /** All cues, one after another; the time of one to which the head never comes is infinite. @param {CueTable[]} cues */
  moments(cues) {
    const held = new Map(this.standings.map((one) => [one.number, one]));
    /** @type {Moment[]} */
    const found = cues.map((cue, number) => {
      const stood = held.get(number);
      if (stood) return { number, cue, time: stood.start, way: stood.way, until: stood.end };
      const time = this.#time(cue);
      return { number, cue, time, way: cue.head ?? this.way(time), until: time };
    });
    return found.sort((a, b) => (a.time === b.time ? a.number - b.number : a.time - b.time));
  }

  /** When a cue is that holds nothing, s. @param {CueTable} cue */
  #time({ at, head }) {
    if (head === null) return at ?? 0;
    const here = this.standings.find((one) => Math.abs(one.way - head) <= HOLDS.SAME_PLACE);
    if (here) return here.start;
    return Math.max(this.profile.time(head + this.profile.distance(this.start)), this.start);
  }
}

/**
 * The head's speed with holds, stops and starts: `CuesTable.paced`.
 * @param {import("../engine.js").Engine} engine
 * @param {Record<string, any>} cues of a plan, filled
 * @param {Profile} profile without them
 * @param {number} start of the dance, s
 * @param {Record<string, any>} limits of the plan, filled
 */
export function paced(engine, cues, profile, start, limits) {
  const most = limits.head_acceleration;
  const rate = cues.acceleration ?? most;
  if (rate > most) {
    const values = { limit: general(most), rate: general(rate) };
    const text = _("at most limits.head_acceleration, {limit} m/s^2, is allowed, not {rate}", values);
    throw keyed("cues.acceleration", text);
  }
  /** @type {CueTable[]} */
  const all = cues.cue;
  const numbers = all.map((_cue, n) => n);
  const holding = numbers.filter((n) => all[n].kind === "hold" || all[n].kind === "stop");
  const holds = holding.map((n) => {
    return { way: all[n].head, at: all[n].at, seconds: all[n].hold || Infinity };
  });
  const starts = numbers.filter((n) => all[n].kind === "start" && all[n].at !== null);
  try {
    const times = starts.map((n) => all[n].at);
    const { profile: found, stood } = withHolds(
      engine, profile, start, holds, times, rate * (1 - PLANS_CUES.PRUDENCE),
    ); // prettier-ignore
    const stops = stood.filter((one) => holds[one.number].seconds === Infinity);
    refuseIdleStarts(starts, all, new Set(stops.map((one) => one.end)));
    return new Paced(
      found,
      start,
      stood.map((one) => ({ ...one, number: holding[one.number] })),
    );
  } catch (error) {
    if (!(error instanceof HoldError)) throw error;
    const text = troubleText(error.trouble, { rate: general(rate), start: general(start) });
    throw keyed(`cues.cue.${holding[error.number]}`, text);
  }
}

/** Refuse starts at which nothing starts. @param {number[]} starts @param {CueTable[]} all @param {Set<number>} used */
function refuseIdleStarts(starts, all, used) {
  const text = _("the head does not stand and wait then: a start needs a stop before it, and its own");
  const seen = new Set();
  const faults = [];
  for (const n of starts) {
    if (!used.has(all[n].at) || seen.has(all[n].at)) faults.push(new Fault(`cues.cue.${n}`, text));
    seen.add(all[n].at);
  }
  if (faults.length) throw new KeyedError(faults);
}
