// Who is near whom over a dance: the host of `see_near`, kernels/bench_nearness.py, as `_nearness` of
// player/scene.py is.

import { copied, withArena } from "./arena.js";
import { BENCH_NEARNESS, FRAMES, Neighbour, PLAYER_SCENE } from "./constants.js";
import { linspace, rounded } from "./numbers.js";
import { tick } from "./tick.js";

/** @typedef {import("./frames.js").Frames} Frames */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("../messages").Nearest} Nearest */
/** @typedef {import("../messages").Tightness} Tightness */

const { REACH } = PLAYER_SCENE;
const { NEAR, WHEN, NUMBER } = Neighbour;
const { NEAR_COLUMNS } = BENCH_NEARNESS;
// Times of one slice: after each the page is heard.
const NEAR_TIMES = 64;

/**
 * Each bench's tightest moment, and the tightest pair over time, at evenly spread times.
 * @param {Walk} walk
 * @param {Frames} shot
 * @param {number} most times
 * @param {() => void} [heard] after each slice
 * @returns {Promise<{ nearest: Nearest, tightness: Tightness }>}
 */
export async function nearness(walk, shot, most, heard = () => {}) {
  const { benches, sizes } = walk.dragon;
  const times = timesOf(shot, benches, most);
  let near = Array.from({ length: benches * NEAR_COLUMNS }, (_n, n) =>
    n % NEAR_COLUMNS ? 0 : Infinity,
  );
  /** @type {number[]} */
  const distance = [];
  for (let first = 0; first < times.length; first += NEAR_TIMES) {
    withArena(walk.engine, (arena) => {
      const { x, y, times: at } = walk.motion(arena, times.subarray(first, first + NEAR_TIMES), { throws: false }); // prettier-ignore
      const table = arena.table([near], NEAR_COLUMNS * benches);
      table.shape = [benches, NEAR_COLUMNS];
      const least = arena.array("d", at.length);
      const looked = arena.vector(at);
      walk.engine.call("bd_bench_nearness_see_near", sizes, x, y, looked, REACH, table, least);
      near = [...copied(table)];
      distance.push(...copied(least));
    });
    heard();
    await tick();
  }
  const column = (/** @type {number} */ first) => near.filter((_n, n) => n % NEAR_COLUMNS === first);
  return {
    nearest: {
      reach: REACH,
      distance: column(NEAR).map((least) => (Number.isFinite(least) ? rounded(least, 5) : 0)),
      time: column(WHEN).map((time) => rounded(time, 4)),
      other: column(NUMBER),
    },
    tightness: {
      start: shot.start,
      step: times[1] - times[0],
      distance: distance.map((least) => rounded(least, 4)),
    },
  };
}

/** A look each 0.25 m, and each 0.25 s, but so many at most. @param {Frames} shot @param {number} benches @param {number} most */
function timesOf({ start, step, count, places }, benches, most) {
  const end = start + step * (count - 1);
  const walked = FRAMES.QUANTUM * (places[count - 1] - places[0]);
  const wanted = 4 * Math.max(walked, end - start, 0.5);
  const allowed = Math.max(2, Math.floor(PLAYER_SCENE.MOST_DISTANCES / benches));
  return linspace(start, end, Math.trunc(Math.min(most, allowed, wanted)));
}
