// A dance as the player shows it, computed here: twin of player/scene.py. Its lists of numbers come beside
// the message, not packed into it.

import { scoreOf } from "../made/beats.js";
import { edgeLeft } from "../made/entrances.js";
import { shownName } from "../made/findings.js";
import { cued, ending, jointsPassed } from "../made/occasions.js";
import { village } from "../made/people.js";
import { _, both, language } from "../words.js";
import { doubles, withArena, withArenaAsync } from "./arena.js";
import { question } from "./budget.js";
import { FRAMES, PLAYER_FRAMES, PLAYER_SCENE } from "./constants.js";
import { course } from "./course.js";
import { InputError, finite } from "./errors.js";
import { CAREFUL, following } from "./follow.js";
import { frames } from "./frames.js";
import { nearness } from "./nearness.js";
import { general } from "./number_format.js";
import { rounded } from "./numbers.js";
import { silent } from "./tick.js";

/** @typedef {import("./follow.js").Following} Following */
/** @typedef {import("./frames.js").Frames} Frames */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("../messages").Dance} Dance */
/** @typedef {import("../messages").Occasion} Occasion */

/**
 * What part of a walk is shown, and how carefully: see `Span` of player/scene.py.
 * @typedef {{ start: number, end: number, mostError?: number, shares?: readonly number[], times?: number,
 *   care?: import("./follow.js").Care }} Shown
 */

/**
 * A dance, and the lists that `Scene` of web/scene.js takes beside it: `new Scene(sent, nodes, framed, tables)`
 * with `new Table(sent.following.tables[i], tables[i])` of each.
 * @typedef {{ sent: Dance, nodes: Float32Array, framed: Int32Array, tables: Int32Array[] }} Unpacked
 */

/** How carefully a dance is shown first, until a finer one is computed: see `Shown`. */
export const SKETCH = {
  mostError: 0.002,
  shares: [],
  times: 120,
  care: { compared: 20_000, looks: 4_000_000 },
};

/**
 * The dance of a walk: its only occasions are joints, and an end where the benches cannot follow.
 * @param {Walk} walk
 * @param {Shown} shown
 * @param {Progress} [progress]
 * @returns {Promise<Unpacked>}
 */
async function plainDance(walk, shown, progress = silent) {
  const { start, end, mostError = PLAYER_SCENE.MOST_ERROR, times = PLAYER_SCENE.MOST_TIMES } = shown;
  checkSpan(walk, start, end);
  progress(0, _("computing positions"));
  const { shot, behind } = await shotOf(walk, { ...shown, mostError });
  progress(0.4, _("finding benches near one another"));
  const { nearest, tightness } = await nearness(walk, shot, times);
  progress(0.8, _("drawing the route"));
  const way = wayOf(walk, shot);
  const last = shot.start + shot.step * (shot.count - 1);
  const sent = {
    version: "",
    plan_sha256: "",
    title: { en: "", zh: "" },
    benches: sizesOf(walk),
    disc: null,
    centre: walk.route.centre,
    course: { stretches: way.stretches, origin: way.origin, packed: "" },
    frames: {
      start: shot.start,
      step: shot.step,
      count: shot.count,
      quantum: FRAMES.QUANTUM,
      packed: "",
      largest_error: shot.error + way.error,
      everywhere: shown.shares?.length !== 0,
    },
    following: behind && followingMessage(behind),
    occasions: [...joints(walk, shot, behind), ...(shot.leap ? [ending(last)] : [])],
    nearest,
    tightness,
    margin: 0,
    speed_limit: null,
    obstacles: [],
    ground: [],
    verdict: null,
    beats: null,
    papers: null,
    village: null,
    north: false,
    entrances: [],
  };
  const tables = behind ? behind.tables.map((table) => table.nodes) : [];
  return { sent, nodes: way.nodes, framed: shot.numbers, tables };
}

/** Whether a dance is long: frames of all its handles would take too long to find. @param {Walk} walk @param {Shown} shown */
function isLong(walk, { start, end }) {
  return walk.dragon.benches * (end - start) > PLAYER_SCENE.LONG;
}

/**
 * Frames of all handles; of a long dance, if it can be told so, the head's, and how all follow.
 * @param {Walk} walk
 * @param {Shown & { mostError: number }} shown
 * @returns {Promise<{ shot: Frames, behind: Following | null }>}
 */
async function shotOf(walk, shown) {
  const { start, end, mostError, shares = PLAYER_FRAMES.SHARES, care = CAREFUL } = shown;
  const most = 0.9 * mostError;
  const behind = isLong(walk, shown) ? await following(walk, start, end, most, shares, care) : null;
  return { shot: behind?.head ?? (await frames(walk, start, end, most, shares)), behind };
}

/** How handles follow, as a page takes it. @param {Following} behind @returns {Dance["following"]} */
function followingMessage({ tables, kinds, fastest, when, speeds, change }) {
  return {
    tables: tables.map(({ sent }) => sent),
    kinds,
    fastest: Array.from(fastest, (speed) => rounded(speed, 4)),
    when: Array.from(when, (time) => rounded(time, 2)),
    speeds,
    change,
  };
}

/**
 * The dance of a plan, with what the plan says, and no verdict.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {Partial<Shown>} [shown] the whole walk where nothing is said
 * @param {Progress} [progress]
 * @returns {Promise<Unpacked>}
 */
export async function danceOf(engine, plan, shown = {}, progress = silent) {
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    const [start, end] = plan.span(walk);
    const dance = await question(() => plainDance(walk, { start, end, ...shown }, progress));
    const { start: first, step, count } = dance.sent.frames;
    const cues = cued(plan.moments(), first, first + step * (count - 1));
    const occasions = [...dance.sent.occasions, ...cues];
    const sent = {
      ...dance.sent,
      plan_sha256: plan.sha256,
      title: both(() => plan.title(language())),
      disc: plan.disc.radius,
      margin: plan.limits.margin,
      speed_limit: plan.limits.speed,
      obstacles: plan.obstacles().map((/** @type {Obstacle} */ one) => drawnObstacle(one, plan)),
      occasions: occasions.sort((a, b) => a.time - b.time),
      beats: beatsOf(plan, start, end),
      papers: "people" in plan.own() || "cues" in plan.own() ? { said: plan.cues.clock, start } : null,
      village: village(plan.people, walk.dragon.benches),
      north: plan.survey.crs !== null,
      entrances: plan.event.entrances,
    };
    return { ...dance, sent };
  });
}

/** @param {Walk} walk @param {number} start @param {number} end */
function checkSpan({ dragon: { benches } }, start, end) {
  if (finite("start", start, "s") >= finite("end", end, "s"))
    throw new InputError(
      _("the dance would end at {end} s, and must end after its start at {start} s", {
        end: general(end),
        start: general(start),
      }),
    );
  if (benches > PLAYER_SCENE.MOST_BENCHES)
    throw new InputError(
      _("a player shows at most {most} benches, not {count}", {
        most: PLAYER_SCENE.MOST_BENCHES,
        count: benches,
      }),
    );
}

/** The sizes of all benches, to a micrometre. @param {Walk} walk */
function sizesOf({ dragon }) {
  const all = (/** @type {Float64Array} */ sizes) => Array.from(sizes, (size) => rounded(size, 6));
  return {
    length: all(dragon.length),
    width: all(dragon.width),
    front_inset: all(dragon.front_inset),
    rear_inset: all(dragon.rear_inset),
  };
}

/** The route that is walked on in the frames, and somewhat more of it. @param {Walk} walk @param {Frames} shot */
function wayOf(walk, shot) {
  const { route } = walk;
  const tail = withArena(walk.engine, (arena) =>
    doubles(walk.motion(arena, [shot.start]).s).reduce((low, s) => Math.min(low, s), Infinity),
  );
  let head = -Infinity;
  for (let k = 0; k < shot.places.length; k++) if (shot.places[k] > head) head = shot.places[k];
  const { AROUND } = PLAYER_SCENE;
  const low = Math.max(tail - AROUND, -route.extension);
  return course(route, low, Math.min(head * FRAMES.QUANTUM + AROUND, route.length));
}

/** When head and tail pass the joints of the route. @param {Walk} walk @param {Frames} shot @param {Following | null} behind @returns {Occasion[]} */
function joints({ route }, { start, step, count, places }, behind) {
  const times = behind?.times ?? Float64Array.from({ length: count }, (_time, k) => start + step * k);
  const framed = (/** @type {number} */ first) =>
    Float64Array.from(places.subarray(first, first + count), (place) => place * FRAMES.QUANTUM);
  const ends = behind?.ends ?? [framed(0), framed(places.length - count)];
  return jointsPassed(route.joints.subarray(1, -1), times, ends);
}

/** The drum of a plan with cues. @param {Plan} plan @param {number} start @param {number} end */
function beatsOf(plan, start, end) {
  if (!("cues" in plan.own())) return null;
  const { tempo, runs, strokes } = scoreOf(plan, start, end);
  return { tempo, runs, strokes };
}

/** An obstacle of a plan as a page draws it, to a tenth of a millimetre. @param {Obstacle} obstacle @param {Plan} plan @returns {Dance["obstacles"][0]} */
function drawnObstacle(obstacle, plan) {
  const { kind, outline, radius, margin } = obstacle;
  const drawn = (/** @type {Array<[number, number]>} */ points) =>
    points.map(([x, y]) => /** @type {[number, number]} */ ([rounded(x, 4), rounded(y, 4)]));
  return {
    name: both(() => shownName(obstacle)),
    kind,
    points: drawn(outline),
    radius,
    margin,
    open: drawn(obstacle.open ?? []),
    left: kind === "venue" ? edgeLeft(plan).map(drawn) : [],
  };
}
