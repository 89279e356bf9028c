// Who is near whom over a dance: twin of `_nearness` in player/scene.py.

import { doubles, withArena, wholes } from "./arena.js";
import { PLAYER_FRAMES, PLAYER_SCENE, Status } from "./constants.js";
import { linspace, rounded } from "./numbers.js";
import { tick } from "./tick.js";

/** @typedef {import("./frames.js").Frames} Frames */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("./walk.js").Motion} Motion */
/** @typedef {import("../messages").Nearest} Nearest */
/** @typedef {import("../messages").Tightness} Tightness */

// Times of one slice: after each the page is heard.
const NEAR_TIMES = 64;

/**
 * Each bench's distance to the nearest bench that is no neighbour, m, and that bench's number, 0 for none:
 * `nearest_each` of analysis/distance.py. Both (times, benches); not numbers where the dragon cannot stand.
 * @param {Motion} motion
 * @param {number} reach m
 * @param {number} [straight] only pairs count that are farther apart, m, where the dragon stands in a line
 */
export function nearestEach(motion, reach, straight = -Infinity) {
  const { arena, dragon } = motion;
  const distance = arena.full([motion.count, dragon.benches], NaN);
  const partner = arena.array("q", motion.count, dragon.benches);
  /** @type {BigInt64Array} */ (partner.view).fill(-1n);
  motion.status.forEach((status, t) => {
    if (status !== Status.OK) return;
    const { x, y } = motion;
    arena.engine.call("bd_box_nearest_each", dragon.sizes, x, y, t, reach, straight, distance, partner);
  });
  return { distance, partner };
}

/**
 * Each bench's tightest moment, and the tightest pair over time, at evenly spread times.
 * @param {Walk} walk
 * @param {Frames} shot
 * @param {number} most times
 * @param {() => void} [heard] after each slice
 * @returns {Promise<{ nearest: Nearest, tightness: Tightness }>}
 */
export async function nearness(walk, shot, most, heard = () => {}) {
  const { benches } = walk.dragon;
  const times = timesOf(shot, benches, most);
  const best = new Float64Array(benches).fill(Infinity);
  const [when, other] = [new Float64Array(benches), new Int32Array(benches)];
  const distance = [];
  for (let first = 0; first < times.length; first += NEAR_TIMES) {
    const slice = times.subarray(first, first + NEAR_TIMES);
    distance.push(...withArena(walk.engine, (arena) => {
      const motion = walk.motion(arena, slice, { throws: false });
      return lookAt(motion, best, when, other);
    })); // prettier-ignore
    heard();
    await tick();
  }
  const { REACH } = PLAYER_SCENE;
  return {
    nearest: {
      reach: REACH,
      distance: Array.from(best, (least) => (Number.isFinite(least) ? rounded(least, 5) : 0)),
      time: Array.from(when, (time) => rounded(time, 4)),
      other: Array.from(other),
    },
    tightness: { start: shot.start, step: times[1] - times[0], distance },
  };
}

/** A look each 0.25 m, and each 0.25 s, but so many at most. @param {Frames} shot @param {number} benches @param {number} most */
function timesOf({ start, step, count, places }, benches, most) {
  const end = start + step * (count - 1);
  const walked = PLAYER_FRAMES.QUANTUM * (places[count - 1] - places[0]);
  const wanted = 4 * Math.max(walked, end - start, 0.5);
  const allowed = Math.max(2, Math.floor(PLAYER_SCENE.MOST_DISTANCES / benches));
  return linspace(start, end, Math.trunc(Math.min(most, allowed, wanted)));
}

/**
 * Notes which bench is nearest to each at these times; the least distance at each.
 * @param {Motion} motion
 * @param {Float64Array} best
 * @param {Float64Array} when
 * @param {Int32Array} other
 */
function lookAt(motion, best, when, other) {
  const { benches } = motion.dragon;
  const { distance, partner } = nearestEach(motion, PLAYER_SCENE.REACH);
  const [found, partners] = [doubles(distance), wholes(partner)];
  return Array.from(motion.times, (time, t) => {
    let least = PLAYER_SCENE.REACH;
    for (let i = 0, k = t * benches; i < benches; i++, k++) {
      if (found[k] < best[i]) [best[i], when[i], other[i]] = [found[k], time, partners[k] + 1];
      if (!(found[k] >= least)) least = found[k];
    }
    return rounded(least, 4);
  });
}
