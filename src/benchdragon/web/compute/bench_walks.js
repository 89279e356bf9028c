// What each bench does in a dance: where it starts, how it turns and how fast, what comes nearest. The host
// of kernels/bench_walks.py and kernels/bench_nearness.py, as analysis/bench_walks.py is.

import { copied, doubles, withArena, withArenaAsync, wholes } from "./arena.js";
import { hold, question, spend } from "./budget.js";
import { ANALYSIS_BENCH_WALKS, BENCH_NEARNESS, BENCH_WALKS, BENDS, BOX, SPIRAL } from "./constants.js";
import { linspace } from "./numbers.js";
import { silent, tick } from "./tick.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {"left" | "right" | "straight"} Turning */
/** @typedef {"wait" | "walk" | "hurry" | "run"} Pace */
/** @typedef {"left" | "right" | "front" | "rear"} Side */

/**
 * A time in which a bench keeps turning one way at one pace.
 * @typedef {object} Stretch
 * @property {number} start s
 * @property {number} end s
 * @property {Turning} turning to which side its front handle's route bends
 * @property {Pace} pace of its front handle
 * @property {number} way how far that handle goes, m
 * @property {number} angle by how much the route turns under that handle, rad, left positive
 * @property {[number, number]} speeds the least and the greatest of that handle seen, m/s
 */

/**
 * When a bench of another coil comes nearest: one that is farther away than STRAIGHT in a line.
 * @typedef {object} Tightest
 * @property {number} time s
 * @property {number} bench number of the other
 * @property {Side} side on which side of this bench it then is
 * @property {number} lower no such bench comes nearer than this at any time, m
 * @property {number} upper so near that one is then, m
 * @property {[number, number]} place where this bench's front handle then is, m
 */

/**
 * What one bench does.
 * @typedef {object} BenchWalk
 * @property {number} bench its number, from 1, the head's
 * @property {[number, number]} place where its front handle is when the dance starts, m
 * @property {number} heading of the bench then, rad
 * @property {number[]} box its rectangle then, a row of kernels/box.py
 * @property {Stretch[]} stretches one after another, from the start of the dance to its end
 * @property {Tightest | null} tightest null where no bench of another coil comes within the distance looked for
 * @property {number | null} before number of the bench before it; null for the head
 * @property {number | null} behind number of the bench behind it; null for the tail
 * @property {number | null} left number of the bench on its left at the end; null where none is near
 * @property {number | null} right the same on its right
 */

const { STILL, STEP, MOST_LOOKED } = ANALYSIS_BENCH_WALKS;
/** @type {Pace[]} */
const PACES = ["wait", "walk", "hurry", "run"];
/** In the order of kernels/bench_nearness.py. @type {Side[]} */
const SIDES = ["left", "right", "front", "rear"];
// Places that are computed at a time, and benches of which the tightest moments are found: after each the
// page is heard.
const [PLACES, BENCHES] = [60_000, 20];

/**
 * What each bench of a plan's walk does over a span, s, the head's first, and where along the route each
 * front handle is at both ends, m.
 * @param {Plan} plan
 * @param {Walk} walk
 * @param {[number, number]} span
 * @param {Progress} [progress]
 */
export function benchWalks(plan, walk, span, progress = silent) {
  const gates = gatesOf(plan.tables.people);
  return question(() =>
    withArenaAsync(walk.engine, (arena) => walkedOver(arena, walk, gates, span, progress)),
  );
}

/** @param {Arena} arena @param {Walk} walk @param {number[]} gates @param {[number, number]} span @param {Progress} progress */
async function walkedOver(arena, walk, gates, [start, end], progress) {
  const { benches } = walk.dragon;
  const times = timesOf(walk, start, end);
  const { turned, ...bends } = bendsOf(arena, walk);
  const line = {
    rows: walk.route.rows, links: walk.dragon.links, sizes: walk.dragon.sizes, ...bends,
    gates: arena.vector(gates),
  }; // prettier-ignore
  const known = await seenOf(arena, walk, line, times, (share) => progress(0.8 * share, ""));
  const stretches = stretchesOf(arena, line.rows, turned, end, known);
  const tightest = await tightestOf(arena, walk, line, times, known, (share) =>
    progress(0.8 + 0.2 * share, ""),
  );
  const [first, last] = [start, end].map((time) => standingAt(walk, time));
  /** @type {BenchWalk[]} */
  const found = Array.from({ length: benches }, (_bench, k) => {
    const [left, right] = last.beside[k];
    return {
      bench: k + 1, place: first.places[k], heading: first.headings[k], box: first.boxes[k],
      stretches: stretches[k], tightest: tightest[k], before: k || null,
      behind: k + 1 < benches ? k + 2 : null, left, right,
    }; // prettier-ignore
  });
  return { benches: found, s: [first.s, last.s] };
}

/** Speeds from which the next pace begins, m/s, ascending. @param {Record<string, number>} people */
function gatesOf({ hurry_from: hurry, run_from }) {
  const run = Math.max(run_from, STILL);
  return [STILL, Math.min(Math.max(hurry, STILL), run), run];
}

/** Times from start to end, s, STEP apart or more, and those at which the head's speed bends. @param {Walk} walk @param {number} start @param {number} end */
function timesOf(walk, start, end) {
  const most = Math.max(Math.floor(MOST_LOOKED / walk.dragon.benches), 2);
  const count = Math.min(Math.ceil((end - start) / STEP), most);
  const knots = walk.profile.times.filter((/** @type {number} */ time) => start < time && time < end);
  const even = end > start ? linspace(start, end, count + 1) : Float64Array.of(start);
  return Float64Array.from(new Set([...even, ...knots])).sort();
}

/** Where the route bends to which side, and by how much it has turned. @param {Arena} arena @param {Walk} walk */
function bendsOf(arena, { engine, route }) {
  const count = route.rows.shape[0];
  const [at, sides] = [arena.array("d", 2 * count), arena.array("q", 2 * count)];
  const turned = arena.array("d", count);
  const [found] = engine.call("bd_bends_find_bends", route.rows, at, sides, turned);
  const bends = arena.vector(doubles(at).slice(0, found));
  return { bends, sides: arena.whole(wholes(sides).slice(0, found)), turned };
}

/** @typedef {Record<"rows" | "links" | "sizes" | "bends" | "sides" | "gates", Numbers>} Line */
/** @typedef {{ pieces: Numbers, benches: Numbers, tally: Numbers, at: Numbers, places: import("./arena.js").Placements }} Known */

/** What is seen of a walk at these times, s. @param {Arena} arena @param {Walk} walk @param {Line} line @param {Float64Array} times @param {(share: number) => void} heard */
async function seenOf(arena, walk, line, times, heard) {
  const { benches, lever } = walk.dragon;
  /** @type {Known} */
  const known = {
    pieces: arena.array("d", benches, BENCH_WALKS.PIECE_COLUMNS),
    benches: arena.full([benches, BENCH_WALKS.BENCH_COLUMNS], 0),
    tally: arena.whole([0]),
    at: arena.array("d", SPIRAL.LANES),
    places: arena.placements(benches + 1, SPIRAL.LANES),
  };
  const per = Math.max(Math.floor(PLACES / (benches + 1)), 1);
  for (let first = 0; first < Math.max(times.length - 1, 1); first += per) {
    withArena(walk.engine, (own) => {
      const motion = walk.motion(own, times.subarray(first, first + per + 1));
      const { s, ratio, x, y } = motion;
      const [at, heads] = [own.vector(motion.times), own.vector(motion.headS)];
      const seen = { times: at, heads, paces: own.vector(motion.headSpeed), s, ratio, x, y };
      const [passed, work] = walk.engine.call("bd_bench_walks_count_passed", line, seen);
      spend(work);
      makeRoom(arena, known, passed);
      const [sound] = walk.engine.call(
        "bd_bench_walks_look_at_benches", line, seen, first, BENCH_NEARNESS.REACH,
        BENCH_NEARNESS.STRAIGHT, lever, known,
      ); // prettier-ignore
      if (!sound) walk.placement(own, [doubles(known.at)[0]]); // throws
    });
    heard(first / times.length);
    await tick();
  }
  return known;
}

/** Room for so many pieces more. @param {Arena} arena @param {Known} known @param {number} more */
function makeRoom(arena, known, more) {
  const { pieces, benches, tally } = known;
  const room = Math.max(wholes(tally)[0], benches.shape[0]) + more;
  if (room <= pieces.shape[0]) return;
  hold(8 * room * BENCH_WALKS.PIECE_COLUMNS);
  known.pieces = arena.array("d", room, BENCH_WALKS.PIECE_COLUMNS);
  doubles(known.pieces).set(doubles(pieces));
  arena.drop(pieces);
}

/** The rows of a table that are told. @param {Numbers} table @param {number} [count] of them */
function* rowsOf({ view, shape: [all, columns] }, count = all) {
  for (let n = 0; n < count; n++)
    yield Array.from(view.subarray(n * columns, (n + 1) * columns), Number);
}

/** The stretches of each bench of a walk up to its end, s. @param {Arena} arena @param {Numbers} rows of the route @param {Numbers} turned @param {number} end @param {Known} known @returns {Stretch[][]} */
function stretchesOf(arena, rows, turned, end, known) {
  const out = arena.array("d", known.pieces.shape[0], BENCH_WALKS.STRETCH_COLUMNS);
  const [told] = arena.engine.call("bd_bench_walks_tell_stretches", rows, turned, end, known, out);
  /** @type {Stretch[][]} */
  const found = Array.from({ length: known.benches.shape[0] }, () => []);
  for (const [bench, start, until, side, pace, way, angle, slow, fast] of rowsOf(out, told)) {
    const turning = side === BENDS.LEFT ? "left" : side === BENDS.RIGHT ? "right" : "straight";
    const speeds = /** @type {[number, number]} */ ([slow, fast]);
    found[bench].push({ start, end: until, turning, pace: PACES[pace], way, angle, speeds });
  }
  return found;
}

/** The tightest moment of each bench; null where nothing comes within REACH. @param {Arena} arena @param {Walk} walk @param {Line} line @param {Float64Array} times @param {Known} known @param {(share: number) => void} heard */
async function tightestOf(arena, walk, line, times, known, heard) {
  const { benches } = walk.dragon;
  const heads = arena.vector(times.map((time) => walk.headPosition(time)));
  const boxes = arena.array("d", 2, BOX.BOX_COLUMNS);
  const out = arena.array("d", benches, BENCH_NEARNESS.TIGHTEST_COLUMNS);
  for (let k = 0; k < benches; k += BENCHES) {
    const stop = Math.min(k + BENCHES, benches);
    arena.engine.call("bd_bench_nearness_find_tightest", line, heads, k, stop, 0, known, boxes, out);
    heard(k / benches);
    await tick();
  }
  return Array.from(rowsOf(out), ([bench, side, lower, upper, head, early, late, ...at]) => {
    if (!bench) return null;
    const place = /** @type {[number, number]} */ (at);
    // Where the head stops for good, rounding may put its place beyond all that it comes to.
    const time = Math.min(Math.max(walk.time_at(head), times[early]), times[late]);
    return { time, bench, side: SIDES[side], lower, upper, place };
  });
}

/** Where benches are at a time, s, and who is beside each. @param {Walk} walk @param {number} time */
function standingAt(walk, time) {
  return withArena(walk.engine, (arena) => {
    const { benches, sizes } = walk.dragon;
    const motion = walk.motion(arena, [time]);
    const [table, found] = [arena.array("d", benches, BOX.BOX_COLUMNS), arena.array("q", benches, 2)];
    walk.engine.call("bd_bench_nearness_find_beside", sizes, motion.x, motion.y, table, found);
    const [s, x, y] = [motion.s, motion.x, motion.y].map(copied);
    const boxes = [...rowsOf(table)];
    return {
      s: [...s],
      boxes,
      places: boxes.map((_box, k) => /** @type {[number, number]} */ ([x[k], y[k]])),
      // Of a bench: from its rear handle to its front one.
      headings: boxes.map((_box, k) => Math.atan2(y[k] - y[k + 1], x[k] - x[k + 1])),
      beside: Array.from(rowsOf(found), ([left, right]) => [left || null, right || null]),
    };
  });
}
