// What mends a finding: the least change of one size, looked for and checked by verdicts before it is offered.

import { SOLVE_WISHES } from "./compute/constants.js";
import { valueOf } from "./number_control.js";
import { withValue } from "./plan_form.js";
import { PageFault, Refusal } from "./standing.js";
import { TOUCHES, badness } from "./verdict_word.js";
import { _, decimals } from "./words.js";

/** @typedef {import("./messages").Answer} Answer */
/** @typedef {import("./messages").Finding} Finding */
/** @typedef {import("./messages").Verdict} Verdict */
/** @typedef {import("./plan_form.js").Plan} Plan */

/** A changed plan, its verdict, and the change in words. @typedef {{ plan: Plan, found: Verdict, text: string }} Remedy */
/** Somebody who answers; null where there is no answer. @typedef {(question: string, plan: Plan) => Promise<any>} Ask */
/**
 * What is to be mended.
 * @typedef {object} Wrong
 * @property {Ask} ask
 * @property {Plan} plan
 * @property {Verdict} before its verdict
 * @property {Finding} finding one of it
 * @property {Answer | null} smallest the smallest pitch of the plan, where it has one
 */

/** A pitch is raised by so many centimetres at most. */
const MOST_RAISED = 128;
/** Speeds in so many steps for a metre a second. */
const SPEEDS = 20;
/** The way to the place with the most room is cut into so many parts. */
const PARTS = 16;
/** Where a dance is moved, from the right on to the left about. */
const ARROWS = "\u2192\u2197\u2191\u2196\u2190\u2199\u2193\u2198";

const [BENCHES, ROOM] = ["benches", "room"];
/** Kinds of findings that are one thing which is wrong. @type {Record<string, string>} */
const ABOUT = { contact: BENCHES, margin: BENCHES, sway: ROOM, imprecision: ROOM, people: ROOM };

/** What a finding is about. @param {Finding} finding */
function aboutOf({ kind, obstacle }) {
  return `${ABOUT[kind] ?? kind.replace("_margin", "")} ${obstacle ?? ""}`;
}

/** Of findings about one thing one: the gravest that is decided. @param {Finding[]} findings */
export function distinct(findings) {
  /** @type {Map<string, Finding>} */
  const kept = new Map();
  for (const one of findings) {
    const other = kept.get(aboutOf(one));
    if (!other || (one.decided && (!other.decided || TOUCHES.includes(one.kind))))
      kept.set(aboutOf(one), one);
  }
  return [...kept.values()];
}

/** Who answers, or says null where there is no answer to that. @param {Ask} ask @returns {Ask} */
export function orNothing(ask) {
  return async (question, plan) => {
    try {
      return await ask(question, plan);
    } catch (error) {
      if (error instanceof Refusal && !(error instanceof PageFault)) return null;
      throw error;
    }
  };
}

/** Whether a finding is gone from a changed plan, and nothing took its place: see `badness`. @param {Wrong} wrong @param {Verdict | null} after */
function mends({ before, finding }, after) {
  if (!after || !after.decided) return false;
  const [had, has] = [before, after].map(({ findings }) => findings.map(aboutOf));
  if (has.includes(aboutOf(finding))) return false;
  return badness(after) < badness(before) || has.every((one) => had.includes(one));
}

/** The verdict on a changed plan, if that mends what is wrong. @param {Wrong} wrong @param {Plan} plan @returns {Promise<Verdict | null>} */
async function mended(wrong, plan) {
  const after = await wrong.ask("verdict", plan);
  return mends(wrong, after) ? after : null;
}

/** A change of a size in words. @param {string} name @param {number} from @param {number} to @param {string} unit */
function changeText(name, from, to, unit) {
  const [before, after] = [from, to].map((size) => decimals(size, 2));
  return _("{name} {before} \u2192 {after} {unit}", { name, before, after, unit });
}

/** Draw the coil wider, by as few centimetres as mend it. @param {Wrong} wrong @returns {Promise<Remedy | null>} */
async function wider(wrong) {
  const { plan, finding, smallest } = wrong;
  const pitch = valueOf(plan, "route.pitch");
  if (typeof pitch !== "number" || finding.obstacle) return null;
  const whole = Math.floor(100 * pitch + 1e-9);
  /** @param {number} by centimetres */
  const at = async (by) => {
    const size = (whole + by) / 100;
    const changed = withValue(plan, "route.pitch", size);
    const found = await mended(wrong, changed);
    return found && { plan: changed, found, text: changeText(_("spiral pitch"), pitch, size, "m") };
  };
  const sought = Math.ceil(100 * (smallest?.upper ?? 0) - 1e-9) - whole;
  const known = ABOUT[finding.kind] === BENCHES && sought > 0 ? await at(sought) : null;
  return known ?? least(at, MOST_RAISED);
}

/**
 * What is found with the fewest steps: twice as many each time, then between the last two.
 * @template Found
 * @param {(steps: number) => Promise<Found | null>} at
 * @param {number} most
 */
async function least(at, most) {
  let [bad, good] = [0, 1];
  let found = await at(good);
  while (!found && good < most) {
    [bad, good] = [good, 2 * good];
    found = await at(good);
  }
  while (found && good - bad > 1) {
    const middle = Math.floor((bad + good) / 2);
    const less = await at(middle);
    if (less) [good, found] = [middle, less];
    else bad = middle;
  }
  return found;
}

/** Walk more slowly, the same way. @param {Wrong} wrong @returns {Promise<Remedy | null>} */
async function slower(wrong) {
  const { ask, plan } = wrong;
  const { walk, limits, people, cues } = plan;
  if (walk.profile?.length || cues?.cue?.length) return null;
  const most = Math.min(limits.speed ?? Infinity, people?.most_speed ?? Infinity);
  const asked = most < Infinity ? withValue(plan, "limits.speed", most) : plan;
  const greatest = (await ask("job/speed", asked))?.lower ?? 0;
  const speed = Math.floor(SPEEDS * greatest + 1e-9) / SPEEDS;
  if (speed <= 0 || speed >= walk.speed) return null;
  let changed = withValue(plan, "walk.speed", speed);
  for (const end of ["start", "end"])
    // where the head is then stays
    if (walk[end]) changed = withValue(changed, `walk.${end}`, (walk[end] * walk.speed) / speed);
  const found = await mended(wrong, changed);
  return found && { plan: changed, found, text: changeText(_("head speed"), walk.speed, speed, "m/s") };
}

/** Have bearers walk under their benches, not beside them. @param {Wrong} wrong @returns {Promise<Remedy | null>} */
async function under(wrong) {
  const { plan } = wrong;
  const beside = plan.people?.beside ?? 0;
  const room = Math.ceil(50 * Math.max(0, SOLVE_WISHES.SHOULDERS - plan.dragon.width) - 1e-9) / 100;
  if (room >= beside) return null;
  const changed = withValue(plan, "people.beside", room);
  if (changed.people.source) changed.people.source.beside = "";
  const found = await mended(wrong, changed);
  const text = changeText(_("bearers under their benches: room beside"), beside, room, "m");
  return found && { plan: changed, found, text };
}

/** How far a dance is moved and turned, in words. @param {number[]} from place and angle @param {number[]} to */
function moveText(from, to) {
  const [x, y, turned] = to.map((one, n) => one - from[n]);
  const ahead = Math.round((4 * Math.atan2(y, x)) / Math.PI);
  const words = { way: decimals(Math.hypot(x, y), 2), arrow: ARROWS[(ahead + 8) % 8] };
  if (Math.abs(turned) < 0.05) return _("move the dragon {way} m {arrow}", words);
  const angle = `${decimals(Math.abs(turned), 1)}\u00b0 ${turned > 0 ? "\u21ba" : "\u21bb"}`;
  return _("move the dragon {way} m {arrow}, swing it round {angle}", { ...words, angle });
}

/** Move the dance towards where it has the most room, no farther than it takes. @param {Wrong} wrong @returns {Promise<Remedy | null>} */
async function moved(wrong) {
  const { plan, before, finding } = wrong;
  if (!finding.obstacle || !before.obstacles.some(({ kind }) => kind === "venue")) return null;
  const best = (await wrong.ask("place", plan))?.plan.route;
  if (!best) return null;
  const from = [...(plan.route.at ?? [0, 0]), plan.route.turned ?? 0];
  const round = ((((best.turned - from[2]) % 360) + 540) % 360) - 180;
  const whole = [best.at[0] - from[0], best.at[1] - from[1], round];
  /** @param {number} parts of the whole way */
  const at = async (parts) => {
    const to = from.map((one, n) => Number((one + (whole[n] * parts) / PARTS).toFixed(3)));
    const changed = structuredClone(plan);
    Object.assign(changed.route, { at: to.slice(0, 2), turned: to[2] });
    const found = await mended(wrong, changed);
    return found && { plan: changed, found, text: moveText(from, to) };
  };
  const most = await at(PARTS);
  const asGood = async (/** @type {number} */ parts) => {
    const one = await at(parts);
    return one && most && badness(one.found) <= badness(most.found) ? one : null;
  };
  return most && least(asGood, PARTS);
}

/** Ways to mend a kind of finding. @type {Record<string, ((wrong: Wrong) => Promise<Remedy | null>)[]>} */
const WAYS = {
  contact: [wider],
  margin: [wider],
  sway: [wider, moved],
  imprecision: [wider, moved],
  people: [wider, moved, under],
  obstacle: [moved],
  obstacle_margin: [moved],
  venue: [moved],
  venue_margin: [moved],
  speed: [slower],
  most_speed: [slower],
  acceleration: [slower],
  lateral_acceleration: [slower],
  total_acceleration: [slower],
  turning_rate: [slower],
};

/** Whether there is a way to look for. @param {Finding} finding */
export function mendable({ kind }) {
  return kind in WAYS;
}

/** What mends a finding, found one after another. @param {Wrong} wrong */
export async function* remedies(wrong) {
  for (const way of WAYS[wrong.finding.kind]) {
    const found = await way(wrong);
    if (found) yield found;
  }
}
