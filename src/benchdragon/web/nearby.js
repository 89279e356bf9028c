// What is near what at the instant that a player shows, and in words.

import { clock, occasionText } from "./axis.js";
import { _, shortLength } from "./words.js";

/** @typedef {import("./player.js").Player} Player */
/** @typedef {import("./nearness.js").Boxes} Boxes */
/** @typedef {import("./nearness.js").Pair} Pair */
/** @typedef {import("./square.js").Beside} Beside */

/** So near to its time an event is here, s: the address gives times to a thousandth. */
const AT_EVENT = 1e-3;

/** The tightest pair; a story's own; at rest at an event the event's own, which may be near by the chain alone. @param {Player} player */
export function tightestOf({ boxes, playing, scene, time, face }) {
  const tightest = boxes.measure();
  const told = face.story.pair;
  if (told) return boxes.pair(...told);
  if (playing || face.story.open) return tightest;
  const here = scene.sent.occasions.find(
    (one) => one.benches.length === 2 && Math.abs(one.time - time) < AT_EVENT,
  );
  return here ? boxes.pair(here.benches[0] - 1, here.benches[1] - 1) : tightest;
}

/** At rest at an event of an obstacle: how its bench stands to that; or what a story is about. @param {Player} player */
export function meetingOf({ boxes, playing, scene, square, time, face }) {
  if (playing) return null;
  if (face.story.open) return face.story.met;
  const here = scene.sent.occasions.find(
    (one) => one.obstacle !== null && Math.abs(one.time - time) < AT_EVENT,
  );
  if (!here || here.obstacle == null) return null;
  return square.pair(boxes, here.benches[0] - 1, here.obstacle);
}

/** What touches on the square, where no benches do: it is what the ring is for. @param {Player} player @param {Beside | null} beside */
export function touchOf({ boxes, face, ringed }, beside) {
  if (face.story.open || !beside || beside.distance > boxes.touch) return null;
  return ringed && ringed.distance <= boxes.touch ? null : beside;
}

/** How near benches are to one another and to what stands on the square. @param {Player} player @param {Pair | null} tightest @param {Beside | null} beside */
export function nearnessText({ boxes, square }, tightest, beside) {
  const own = tightestText(tightest, boxes);
  return beside ? `${own}; ${square.text(beside, boxes.touch)}` : own;
}

/** What has happened since a time, s, joints aside, which are too many; "" if nothing. @param {Player} player @param {number} before */
export function passedText({ scene, time }, before) {
  return scene.sent.occasions
    .filter((one) => one.kind !== "joint" && before < one.time && one.time <= time)
    .map((one) => `t = ${clock(one.time)}. ${occasionText(one)}`)
    .join("; ");
}

/** @param {Pair | null} pair @param {Boxes} boxes */
function tightestText(pair, { count, reach, touch }) {
  if (count < 3) return _("no pair counts");
  if (!pair) return _("no other coil within {reach}", { reach: shortLength(reach) });
  const benches = { a: pair.i + 1, b: pair.j + 1 };
  if (pair.distance <= touch) return _("benches {a} and {b} touch", benches);
  return _("now nearest {gap}: benches {a} and {b}", { gap: shortLength(pair.distance), ...benches });
}
