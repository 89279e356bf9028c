// How papers tell times: of day where the plan says when the dance starts, else since it starts. Twin of
// analysis/clock.py.

import { _ } from "../words.js";
import { ANALYSIS_CLOCK } from "./constants.js";

const TIME_OF_DAY = /^([01]?[0-9]|2[0-3]):([0-5][0-9])(?::([0-5][0-9]))?$/;

/** The one rule for times on papers, to a second. */
export class Clock {
  /** @param {string} said the time of day at which the dance starts, "18:30"; "" if the plan says none @param {number} start of the dance, s of the plan */
  constructor(said, start) {
    this.said = said;
    this.start = start;
  }

  /** A time, s of the plan: of day, h:mm:ss; else since the dance starts, m:ss. @param {number} time */
  tell(time) {
    const found = TIME_OF_DAY.exec(this.said);
    if (!found) return minutes(time - this.start);
    const [hours, past, more] = found.slice(1).map((part) => Number(part ?? 0));
    const seconds = whole(3600 * hours + 60 * past + more + time - this.start) % ANALYSIS_CLOCK.DAY;
    const places = [Math.floor(seconds / 60) % 60, seconds % 60].map(twoDigits);
    return [Math.floor(seconds / 3600), ...places].join(":");
  }

  /** What times on a paper are, in the language in use: said once on each. */
  get legend() {
    if (!this.said) return _("Times are minutes and seconds since the dance starts.");
    return _("Times are times of day; the dance starts at {clock}.", { clock: this.said });
  }
}

/** A duration as minutes and seconds, m:ss. @param {number} seconds */
function minutes(seconds) {
  const all = whole(seconds);
  return `${Math.floor(all / 60)}:${twoDigits(all % 60)}`;
}

/** The nearest second, of two as near the later. @param {number} seconds */
function whole(seconds) {
  return Math.floor(seconds + 0.5);
}

/** @param {number} n */
function twoDigits(n) {
  return String(n).padStart(2, "0");
}
