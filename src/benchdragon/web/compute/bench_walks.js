// What each bench does in a dance: of analysis/bench_walks.py what gives way to the page's reader.

import { arena as here, doubles, withArena, wholes } from "./arena.js";
import { hold, spend } from "./budget.js";
import { BENCH_NEARNESS, BENCH_WALKS, BOX, SPIRAL } from "./constants.js";
import { py } from "./python.js";
import { tick } from "./tick.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */

// Places that are computed at a time, and benches of which the tightest moments are found: after each the
// page is heard.
const [PLACES, BENCHES] = [60_000, 20];

/** @typedef {Record<"rows" | "links" | "sizes" | "bends" | "sides" | "gates", Numbers>} Line */
/** @typedef {{ pieces: Numbers, benches: Numbers, tally: Numbers, at: Numbers, places: import("./arena.js").Placements }} Known */

/** What is seen of a walk at these times, s. @param {Walk} walk @param {Line} line @param {Float64Array} times @param {Progress} progress */
export async function _seen(walk, line, times, progress) {
  const [arena, { benches, lever }] = [here(), walk.dragon];
  /** @type {Known} */
  const known = {
    pieces: arena.array("d", benches, BENCH_WALKS.PACE_PIECE_COLUMNS),
    benches: arena.full([benches, BENCH_WALKS.BENCH_ROW_COLUMNS], 0),
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
      const [passed, work] = py.entry("bd_bench_walks_count_passed", line, seen);
      spend(work);
      makeRoom(arena, known, passed);
      const [sound] = py.entry(
        "bd_bench_walks_look_at_benches", line, seen, first, BENCH_NEARNESS.REACH,
        BENCH_NEARNESS.OTHER_COIL, lever, known,
      ); // prettier-ignore
      if (!sound) walk.placement(own, [doubles(known.at)[0]]); // throws
    });
    progress(first / times.length, "");
    await tick();
  }
  return known;
}

/** Room for so many pieces more. @param {Arena} arena @param {Known} known @param {number} more */
function makeRoom(arena, known, more) {
  const { pieces, benches, tally } = known;
  const room = Math.max(wholes(tally)[0], benches.shape[0]) + more;
  if (room <= pieces.shape[0]) return;
  hold(8 * room * BENCH_WALKS.PACE_PIECE_COLUMNS);
  known.pieces = arena.array("d", room, BENCH_WALKS.PACE_PIECE_COLUMNS);
  doubles(known.pieces).set(doubles(pieces));
  arena.drop(pieces);
}

/** What comes nearest to each bench, as rows of kernels/bench_nearness.py. @param {Walk} walk @param {Line} line @param {Float64Array} times @param {number} apart @param {Known} known @param {Progress} progress @returns {Promise<number[][]>} */
export async function _nearest(walk, line, times, apart, known, progress) {
  const [{ benches }, heads] = [walk.dragon, walk.head_position(times)];
  const [boxes, out] = [
    py.empty([2, BOX.BOX_COLUMNS]),
    py.empty([benches, BENCH_NEARNESS.TIGHTEST_COLUMNS]),
  ];
  for (let k = 0; k < benches; k += BENCHES) {
    const stop = Math.min(k + BENCHES, benches);
    py.entry("bd_bench_nearness_find_tightest", line, heads, k, stop, apart, known, boxes, out);
    progress(k / benches, "");
    await tick();
  }
  return py.tolist(out);
}

/** x and y of all handles at a time, s, m, each (handles, 1). @param {Walk} walk @param {number} time */
export function _handles(walk, time) {
  const { x, y } = walk.motion(here(), [time]);
  return [x, y];
}
