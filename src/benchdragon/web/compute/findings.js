// What a walk does that its plan forbids, in words, under codes that do not change. Twin of
// analysis/findings.py.

import { _ } from "../words.js";
import { keeps, mostOf, shown } from "./answer.js";
import { general, known, seconds } from "./number_format.js";
import { rounded } from "./numbers.js";
import { givenFrom, runsOn } from "./not_looked_at.js";
import { handlePlace } from "./numbering.js";
import { QUANTITIES, givenLimits } from "./quantities.js";

/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./check.js").CheckedPlan} CheckedPlan */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./obstacles.js").ObstacleAnswers} ObstacleAnswers */
/** @typedef {import("./quantities.js").QuantityName} QuantityName */
/** @typedef {import("./room.js").RoomLevel} RoomLevel */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {keyof typeof CODES} Kind */

/**
 * Something that a walk must not do, or that could not be decided.
 * @typedef {object} Finding
 * @property {Kind} kind
 * @property {number | null} time when, s
 * @property {number[]} benches which
 * @property {number} value what came out, m, m/s, m/s^2 or rad/s
 * @property {number} limit what was to be kept
 * @property {() => string} text in words, in the language in use
 * @property {boolean} decided whether it surely does; else that was left open
 * @property {Obstacle | null} obstacle what stands in the way
 */

/** Codes under which kinds of findings are known for good. */
export const CODES = {
  contact: "BD101",
  margin: "BD102",
  walk: "BD103",
  route: "BD104",
  sway: "BD105",
  imprecision: "BD106",
  people: "BD107",
  speed: "BD201",
  acceleration: "BD202",
  lateral_acceleration: "BD203",
  total_acceleration: "BD204",
  turning_rate: "BD205",
  head_acceleration: "BD206",
  most_speed: "BD207",
  venue: "BD301",
  venue_margin: "BD302",
  obstacle: "BD303",
  obstacle_margin: "BD304",
};

// What obstacles, and the venue, are called to which a plan gives no name.
const NAMELESS = /^obstacle (\p{Nd}+)$/u;
const NAMELESS_VENUE = "venue";

/** A number of the program's for an obstacle without a name; null for one with a name. @param {Obstacle} obstacle */
function ownName({ name, kind }) {
  const nameless = NAMELESS.exec(name);
  if (nameless && kind !== "venue") return _("obstacle {n}", { n: nameless[1] });
  return kind === "venue" && name === NAMELESS_VENUE ? _("the venue") : null;
}

/** What an obstacle is called in a sentence, in the language in use: in Chinese between quotes. @param {Obstacle} obstacle */
export function named(obstacle) {
  return ownName(obstacle) ?? _("{called}", { called: obstacle.name });
}

/** What an obstacle is called where it stands alone, in the language in use. @param {Obstacle} obstacle */
export function shownName(obstacle) {
  return ownName(obstacle) ?? obstacle.name;
}

/**
 * What a walk does that its plan forbids, from the first time of the span, s, to the second.
 * @param {CheckedPlan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {{ contact: Answer | null, obstacles: ObstacleAnswers[], room: RoomLevel[],
 *   peaks: Partial<Record<QuantityName, Answer>> }} found
 */
export function allFindings(plan, walk, span, { contact, obstacles, peaks, room }) {
  const limits = givenLimits(plan.tables.limits);
  const names = /** @type {QuantityName[]} */ (Object.keys(limits)).filter((name) => peaks[name]);
  return [
    ...routeFindings(plan, walk, span[0]),
    ...contactFindings(contact, plan.tables.limits.margin),
    ...obstacles.flatMap(obstacleFindings),
    ...headFindings(walk, span, plan.tables.limits.head_acceleration),
    ...names.flatMap((name) =>
      limitFindings(name, /** @type {Answer} */ (peaks[name]), Number(limits[name])),
    ),
    ...carryingFindings(plan.tables.people.most_speed, /** @type {Answer} */ (peaks.speed)),
    ...roomFindings(room),
  ];
}

/** Whether the dragon is never as a whole on the route that the plan gives. @param {CheckedPlan} plan @param {Walk} walk @param {number} time @returns {Finding[]} */
function routeFindings(plan, walk, time) {
  const value = walk.route.length - givenFrom(plan, walk);
  const limit = walk.dragon.extent;
  if (!runsOn(walk) || limit <= value) return [];
  const words = { route: known(value, value, "m", false), dragon: known(limit, limit, "m", true) };
  const text = () =>
    plan.tables.route.kind === "drawn"
      ? _(
          "the drawn route is {route} m long, the dragon {dragon} m: at no time is all of it on the route; where the drawing is in another unit, say so by survey.unit",
          words,
        )
      : _(
          "the route is {route} m long, the dragon {dragon} m: at no time is all of it on the route",
          words,
        );
  const benches = [walk.dragon.benches];
  return [{ kind: "route", time, benches, value, limit, text, decided: true, obstacle: null }];
}

/** @param {Answer | null} contact @param {number} margin @returns {Finding[]} */
function contactFindings(contact, margin) {
  if (contact === null || contact.witness === null) return [];
  const { witness: near, value: time, status } = contact;
  const decided = status !== "undecided";
  const kind = near.gap > 0 || (margin && !decided) ? "margin" : "contact";
  const [a, b] = near.benches;
  const words = { a, b, t: seconds(time), margin: general(margin) };
  const text = () => {
    if (!decided)
      return _(
        "benches {a} and {b} come to {margin} m of one another at t = {t} s, too exactly to tell on which side",
        words,
      );
    if (kind === "contact") return _("benches {a} and {b} touch at t = {t} s", words);
    return _("benches {a} and {b} come nearer than {margin} m at t = {t} s", words);
  };
  const value = Math.max(near.gap, 0);
  return [{ kind, time, benches: near.benches, value, limit: margin, text, decided, obstacle: null }];
}

/** Whether a bench comes nearer to an obstacle than it may, and touches it or leaves the venue. @param {ObstacleAnswers} answers */
function obstacleFindings({ obstacle, contact, touch }) {
  return [
    ...obstacleFinding(obstacle, contact, obstacle.margin),
    ...obstacleFinding(obstacle, touch, 0),
  ];
}

/**
 * What a contact with an obstacle comes to, which has to be kept from by a margin.
 * @param {Obstacle} obstacle
 * @param {Answer | null} contact
 * @param {number} margin
 * @returns {Finding[]}
 */
function obstacleFinding(obstacle, contact, margin) {
  if (contact === null || contact.witness === null) return [];
  const { witness: near, value: time, lower, upper, status } = contact;
  const decided = status !== "undecided";
  const thing = obstacle.kind === "venue" ? "venue" : "obstacle";
  const kind = near.gap > 0 || (margin && !decided) ? /** @type {const} */ (`${thing}_margin`) : thing;
  const first = decided && lower === upper && upper === time && near.gap <= 0;
  const [bench] = near.benches;
  const words = { bench, t: seconds(time), margin: general(margin) };
  const text = () => obstacleText(kind, decided, first, { ...words, name: named(obstacle) });
  const value = Math.max(near.gap, 0);
  return [{ kind, time, benches: near.benches, value, limit: margin, text, decided, obstacle }];
}

/**
 * @param {"venue" | "obstacle" | "venue_margin" | "obstacle_margin"} kind
 * @param {boolean} decided
 * @param {boolean} first whether from the start on
 * @param {Record<string, string | number>} words
 */
function obstacleText(kind, decided, first, words) {
  if (!decided)
    return _(
      "bench {bench} comes to {margin} m of {name} at t = {t} s, too exactly to tell on which side",
      words,
    );
  if (first && kind === "venue")
    return _("bench {bench} stands outside {name} from the start on: {t} s", words);
  if (first)
    return _("bench {bench} touches {name}, or stands inside, from the start on: {t} s", words);
  switch (kind) {
    case "obstacle":
      return _("bench {bench} touches {name} at t = {t} s", words);
    case "obstacle_margin":
      return _("bench {bench} comes nearer than {margin} m to {name} at t = {t} s", words);
    case "venue":
      return _("bench {bench} leaves {name} at t = {t} s", words);
    default:
      return _("bench {bench} comes nearer than {margin} m to the edge of {name} at t = {t} s", words);
  }
}

/** Which levels of room are not kept, where benches alone keep theirs. @param {RoomLevel[]} room */
function roomFindings(room) {
  return room.length && room[0].first === null ? room.slice(1).flatMap(roomFinding) : [];
}

/** What a level of room that is not kept comes to, and from what first. @param {RoomLevel} level @returns {Finding[]} */
function roomFinding({ name: kind, first, margin, short }) {
  if (first === null || first.contact.witness === null || kind === "benches") return [];
  const { contact, obstacle } = first;
  const near = contact.witness;
  if (near === null) return [];
  const decided = contact.status !== "undecided";
  const limit = obstacle === null ? margin : obstacle.margin;
  const [a, b] = [near.benches[0], near.benches[near.benches.length - 1]];
  const words = { a, b, t: seconds(contact.value), margin: general(limit) };
  const text = () => {
    if (!decided)
      return _(
        "whether the margin of {margin} m at bench {a} is kept at t = {t} s is too close to tell",
        words,
      );
    const asked = askedFor(words.margin, short);
    return obstacle === null
      ? roomText(kind, { ...words, asked })
      : roomTextAt(kind, { ...words, asked, name: named(obstacle) });
  };
  const value = Math.max(near.gap, 0);
  return [{ kind, time: contact.value, benches: near.benches, value, limit, text, decided, obstacle }];
}

/** What is asked for, and how much of it is there for the pair that is named, at a time of its own: cut off at millimetres. @param {string} margin @param {import("./shortage.js").Shortage | null} short */
function askedFor(margin, short) {
  if (short === null) return _("{margin} m are asked for", { margin });
  const cut = (/** @type {number} */ value) => general(Math.floor(rounded(1000 * value, 6)) / 1000);
  return _(
    "{key} asks for {wanted} m; at t = {when} s, when these two are {apart} m apart, there is room for {there} m",
    {
      key: `people.${short.key}`,
      wanted: general(short.wanted),
      when: seconds(short.time),
      apart: cut(short.apart),
      there: cut(short.there),
    },
  );
}

/** @param {"sway" | "imprecision" | "people"} kind @param {Record<string, string | number>} words */
function roomText(kind, words) {
  switch (kind) {
    case "sway":
      return _("benches {a} and {b} have no room to sway at t = {t} s: {asked}", words);
    case "imprecision":
      return _("benches {a} and {b} have no room for imprecision at t = {t} s: {asked}", words);
    default:
      return _("the people of benches {a} and {b} have no room at t = {t} s: {asked}", words);
  }
}

/** The same towards what stands still. @param {"sway" | "imprecision" | "people"} kind @param {Record<string, string | number>} words */
function roomTextAt(kind, words) {
  switch (kind) {
    case "sway":
      return _("bench {a} has no room to sway at {name} at t = {t} s: {asked}", words);
    case "imprecision":
      return _("bench {a} has no room for imprecision at {name} at t = {t} s: {asked}", words);
    default:
      return _("the people of bench {a} have no room at {name} at t = {t} s: {asked}", words);
  }
}

/** Whether the head changes its speed faster than it may. @param {Walk} walk @param {[number, number]} span @param {number} limit @returns {Finding[]} */
function headFindings(walk, [start, end], limit) {
  const stretches = walk.profile.stretches(start, end);
  const value = stretches.reduce((most, { rate }) => Math.max(most, Math.abs(rate)), 0);
  if (value <= mostOf(limit)) return [];
  const steepest = stretches.find(({ rate }) => Math.abs(rate) === value);
  const time = steepest ? steepest.times[0] : start;
  const said = known(value, value, "m/s^2", true, limit);
  const words = { t: seconds(time), value: said, limit: general(limit) };
  const text = () =>
    _(
      "the head changes its speed by {value} m/s^2 from t = {t} s on, the limit being {limit} m/s^2",
      words,
    );
  const kind = "head_acceleration";
  return [{ kind, time, benches: [1], value, limit, text, decided: true, obstacle: null }];
}

/** A value and its limit with six digits, or as many as show the difference. @param {number} value @param {number} limit */
function toldApart(value, limit) {
  let digits = 6;
  while (digits < 17 && general(value, digits) === general(limit, digits)) digits++;
  return { value: general(value, digits < 17 ? digits : 6), limit: general(limit) };
}

/** Whether what is limited exceeds its limit, or may. @param {QuantityName} name @param {Answer} peak @param {number} limit @returns {Finding[]} */
function limitFindings(name, peak, limit) {
  const kept = keeps(peak, limit);
  const near = peak.witness;
  if (kept || near === null) return [];
  const text = () => limitText(name, peak, limit, kept === false);
  const { value } = peak;
  const decided = kept !== null;
  return [
    { kind: name, time: near.time, benches: near.benches, value, limit, text, decided, obstacle: null },
  ];
}

/** @param {QuantityName} name @param {Answer} peak @param {number} limit @param {boolean} exceeded */
function limitText(name, peak, limit, exceeded) {
  const words = {
    ...peakWords(peak, limit, exceeded),
    what: QUANTITIES[name].text(),
    unit: peak.unit,
  };
  if (!exceeded)
    return _("whether the {what} keeps to {limit} {unit} is undecided: {value} {unit} was seen", words);
  if (name === "speed")
    return _(
      "handle {handle} ({where}) moves at {value} m/s at t = {t} s, the limit being {limit} m/s",
      words,
    );
  if (peak.witness?.handle != null)
    return _(
      "{what} is {value} {unit} at handle {handle} ({where}) at t = {t} s, the limit being {limit} {unit}",
      words,
    );
  return _(
    "{what} at bench {bench} is {value} {unit} at t = {t} s, the limit being {limit} {unit}",
    words,
  );
}

/** Where, when and how great a peak is. @param {Answer} peak @param {number} limit @param {boolean} exceeded */
function peakWords(peak, limit, exceeded) {
  const { witness, value } = peak;
  const [handle, bench] = [witness?.handle ?? 0, witness?.benches[0] ?? 0];
  const where = handlePlace(handle, bench);
  const t = seconds(witness?.time ?? NaN);
  const told = exceeded
    ? { value: shown(peak, true, limit), limit: general(limit) }
    : toldApart(value, limit);
  return { handle, bench, where, t, ...told };
}

/** Whether a handle is faster than people can carry a bench, or may be. @param {number | null} most @param {Answer} peak @returns {Finding[]} */
function carryingFindings(most, peak) {
  if (most === null) return [];
  const carried = () =>
    _(
      "handle {handle} ({where}) moves at {value} m/s at t = {t} s; a bench can be carried at {limit} m/s at most",
      peakWords(peak, most, true),
    );
  return limitFindings("speed", peak, most).map((one) => ({
    ...one,
    kind: "most_speed",
    text: one.decided ? carried : one.text,
  }));
}
