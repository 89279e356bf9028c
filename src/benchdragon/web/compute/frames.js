// A dance as evenly spaced frames, and how far they are off in between: twin of player/frames.py.

import { _ } from "../words.js";
import { doubles, withArena } from "./arena.js";
import { PLAYER_FRAMES, SPIRAL, MODEL_WALK, Status } from "./constants.js";
import { InputError } from "./errors.js";
import { general } from "./number_format.js";
import { linspace, rint } from "./numbers.js";
import { tick } from "./tick.js";

/** @typedef {import("./walk.js").Motion} Motion */
/** @typedef {import("./walk.js").Walk} Walk */

/**
 * Route positions and speeds of all handles, in quanta, handle by handle (handles, count).
 * @typedef {object} Frames
 * @property {number} start s
 * @property {number} step s
 * @property {number} count
 * @property {Int32Array} places
 * @property {Int32Array} speeds
 * @property {number} error the largest distance of an interpolated route position from the exact one, m
 * @property {boolean} leap whether they end because a bench leaps, or finds no place, soon after
 */

const { QUANTUM, NEAR, LEAP, TRIED, MOST_PLACES, FARTHEST, STEPS, SHARES } = PLAYER_FRAMES;

/**
 * Slices of times that need bounded memory, as `Walk.motions` cuts them: first and last of each.
 * @param {Walk} walk
 * @param {number} count
 */
function* slicesOf(walk, count) {
  let size = Math.max(1, Math.floor(MODEL_WALK.SLICE_PLACES / (walk.dragon.benches + 1)));
  if (size > SPIRAL.LANES) size -= size % SPIRAL.LANES;
  for (let first = 0; first < count; first += size)
    yield /** @type {[number, number]} */ ([first, Math.min(first + size, count)]);
}

/**
 * What all handles do at times, slice by slice: `use` sees it, and how many times come before it.
 * @param {Walk} walk
 * @param {Float64Array} times
 * @param {(motion: Motion, first: number) => void} use
 */
export async function inSlices(walk, times, use) {
  for (const [first, last] of slicesOf(walk, times.length)) {
    withArena(walk.engine, (arena) => {
      use(walk.motion(arena, times.subarray(first, last), { throws: false }), first);
    });
    await tick();
  }
}

/**
 * The fewest frames between two times, s, that are nowhere farther off than `most`, m.
 * They end early where the dragon can no longer stand, or a bench leaps.
 * @param {Walk} walk
 * @param {number} start
 * @param {number} end
 * @param {number} most
 * @param {readonly number[]} [shares] where between two frames that is looked at, as shares of the step; if
 *   nowhere, halfway between TRIED of them alone, and they may end up to a step before a leap
 * @returns {Promise<Frames>}
 */
export async function frames(walk, start, end, most, shares = SHARES) {
  checkFarthest(walk, start, end);
  let [until, leap] = [end, false];
  for (const step of STEPS) {
    const count = Math.max(Math.ceil((until - start) / step - 1e-9), 1) + 1;
    if (count * (walk.dragon.benches + 1) > MOST_PLACES) break;
    const even = (until - start) / (count - 1);
    const tried = (/** @type {number} */ among) => triedError(walk, start, even, among);
    if (step > NEAR && (count > 4 * TRIED || !shares.length) && tried(count) > most) continue;
    const { shot, errors } = await shotAt(walk, start, even, count, shares);
    const far = errors.findIndex((error) => !(error <= LEAP));
    if (far >= 0 && step > NEAR && (shares.length || !(await leaps(walk, shot, far)))) continue;
    if (far >= 0) [leap, until] = [true, start + even * (far + 1)];
    const sound = far >= 0 ? errors.subarray(0, far) : errors;
    if (!sound.length) continue;
    const seen = shares.length ? 0 : tried(sound.length + 1);
    const error = sound.reduce((worst, one) => Math.max(worst, one), seen);
    if (error <= most) return { ...firstFrames(shot, sound.length + 1), error, leap };
  }
  throw new InputError(
    _(
      "frames of {benches} benches from {start} s to {end} s would be off by more than {error} m or fill more than {most} positions: choose a shorter time",
      {
        benches: walk.dragon.benches,
        start: general(start),
        end: general(until),
        error: general(most),
        most: MOST_PLACES,
      },
    ),
  );
}

/** Refuse a walk from start to end, s, that goes beyond FARTHEST. @param {Walk} walk @param {number} start @param {number} end */
export function checkFarthest(walk, start, end) {
  const tail = withArena(walk.engine, (arena) => {
    const s = doubles(walk.motion(arena, [start]).s);
    return s.reduce((least, one) => Math.min(least, one), Infinity);
  });
  const far = Math.max(-tail, walk.headPosition(end));
  if (far > FARTHEST)
    throw new InputError(
      _("a player shows {most} m of a route, and this walk goes to {far} m", {
        most: general(FARTHEST),
        far: general(far),
      }),
    );
}

/** The largest error halfway between TRIED frames and the next, m: no more than that of all. @param {Walk} walk @param {number} start @param {number} step @param {number} count */
function triedError(walk, start, step, count) {
  const before = linspace(0, count - 2, TRIED).map((n) => start + step * rint(n));
  const times = [...before].flatMap((t) => [t, t + step]);
  return withArena(walk.engine, (arena) => {
    const ends = walk.motion(arena, times, { throws: false });
    const middles = walk.motion(arena, before.map((t) => t + 0.5 * step), { throws: false }); // prettier-ignore
    const [s, v, exact] = [doubles(ends.s).slice(), ends.speed, doubles(middles.s)];
    let worst = 0;
    for (let k = 0; k < exact.length; k++) {
      const middle = cubic(s[2 * k], s[2 * k + 1], v[2 * k] * step, v[2 * k + 1] * step, 0.5);
      const error = Math.abs(middle - exact[k]);
      if (error > worst) worst = error;
    }
    return worst;
  });
}

/** A cubic's value at a share f of a step; slopes are those of a step. @param {number} a @param {number} b @param {number} riseA @param {number} riseB @param {number} f */
export function cubic(a, b, riseA, riseB, f) {
  return a + f * f * (3 - 2 * f) * (b - a) + f * (1 - f) * ((1 - f) * riseA - f * riseB);
}

/**
 * Frames at evenly spaced times; the error between each frame and the next, m, not a number where the
 * dragon does not stand all along.
 * @param {Walk} walk
 * @param {number} start
 * @param {number} step
 * @param {number} count
 * @param {readonly number[]} shares
 */
async function shotAt(walk, start, step, count, shares) {
  const times = linspace(start, start + step * (count - 1), count);
  const size = (walk.dragon.benches + 1) * count;
  const shot = { start, step, count, places: new Int32Array(size), speeds: new Int32Array(size) };
  const fallen = new Uint8Array(count);
  await inSlices(walk, times, (motion, first) => quantise(motion, first, shot, fallen));
  const errors = new Float64Array(count - 1);
  for (let k = 0; k < count - 1; k++) errors[k] = fallen[k] || fallen[k + 1] ? NaN : 0;
  for (const share of shares) {
    const between = times.subarray(0, count - 1).map((t) => t + share * step);
    await inSlices(walk, between, (motion, first) => widenErrors(errors, shot, motion, first, share));
  }
  if (!shares.length) widenByLeaps(errors, shot);
  return { shot, errors };
}

/** @typedef {Pick<Frames, "start" | "step" | "count" | "places" | "speeds">} Shot */

/**
 * Put what a slice tells into frames, and mark the times at which some handle has no place.
 * @param {Motion} motion
 * @param {number} first number of its first frame
 * @param {Shot} shot
 * @param {Uint8Array} fallen
 */
function quantise(motion, first, { count, places, speeds }, fallen) {
  const [s, ratio, pace, width] = [
    doubles(motion.s),
    doubles(motion.ratio),
    motion.headSpeed,
    motion.count,
  ];
  motion.status.forEach((status, t) => (fallen[first + t] = Number(status !== Status.OK)));
  for (let i = 0, k = 0; i < motion.handles; i++) {
    for (let t = 0, at = i * count + first; t < width; t++, k++, at++) {
      places[at] = rint(s[k] / QUANTUM); // not a number becomes 0
      speeds[at] = rint((ratio[k] * pace[t]) / QUANTUM);
    }
  }
}

/**
 * Raise errors to the distance of frames from exact places at a share of each step.
 * @param {Float64Array} errors
 * @param {Shot} shot
 * @param {Motion} motion exact
 * @param {number} first number of the first of its steps
 * @param {number} f the share
 */
function widenErrors(errors, { step, count, places, speeds }, motion, first, f) {
  const [rest, blend, rise] = [1 - f, f * f * (3 - 2 * f), QUANTUM * step];
  const reach = f * rest;
  const [exact, width] = [doubles(motion.s), motion.count];
  for (let i = 0, k = 0; i < motion.handles; i++) {
    for (let t = first, at = i * count + first; t < first + width; t++, k++, at++) {
      const a = places[at] * QUANTUM;
      const b = places[at + 1] * QUANTUM;
      const bend = rest * (speeds[at] * rise) - f * (speeds[at + 1] * rise);
      const error = Math.abs(a + blend * (b - a) + reach * bend - exact[k]);
      if (error > errors[t]) errors[t] = error;
      else if (error !== error) errors[t] = NaN;
    }
  }
}

/** Whether a bench leaps or finds no place from a frame to the next, be they ever so near. @param {Walk} walk @param {Shot} shot @param {number} frame */
async function leaps(walk, { start, step }, frame) {
  const parts = Math.ceil(step / NEAR) * 8;
  const { errors } = await shotAt(walk, start + step * frame, step / parts, parts + 1, []);
  return errors.some((error) => !(error <= LEAP));
}

/** Raise errors to each leap of a handle from frame to frame, which its speeds do not explain. @param {Float64Array} errors @param {Shot} shot */
function widenByLeaps(errors, { step, count, places, speeds }) {
  const half = 0.5 * step;
  for (let first = 0; first < places.length; first += count) {
    for (let k = 0, at = first; k < count - 1; k++, at++) {
      const walked = half * (speeds[at] + speeds[at + 1]);
      const leap = Math.abs(places[at + 1] - places[at] - walked) * QUANTUM;
      if (leap > LEAP) errors[k] = leap;
    }
  }
}

/** The first frames alone. @param {Shot} shot @param {number} count */
function firstFrames(shot, count) {
  if (count === shot.count) return shot;
  const kept = (/** @type {Int32Array} */ table) => {
    const found = new Int32Array((table.length / shot.count) * count);
    for (let i = 0; i < found.length / count; i++)
      found.set(table.subarray(i * shot.count, i * shot.count + count), i * count);
    return found;
  };
  return { ...shot, count, places: kept(shot.places), speeds: kept(shot.speeds) };
}

/**
 * Frames as `Scene` of web/scene.js takes them: speeds, then positions, each as what it cannot foretell.
 * Twin of `packed_frames`, whose bytes these are.
 * @param {Frames} frames
 */
export function foretold({ places, speeds, count, step }) {
  const found = new Int32Array(2 * places.length);
  const half = 0.5 * step;
  for (let first = 0; first < places.length; first += count) {
    let [speed, rise] = [0, 0];
    for (let k = first; k < first + count; k++) {
      const change = speeds[k] - speed;
      found[k] = change - rise;
      [speed, rise] = [speeds[k], change];
      const walked = k > first ? Math.floor((speeds[k - 1] + speeds[k]) * half + 0.5) : 0;
      found[places.length + k] = places[k] - (k > first ? places[k - 1] : 0) - walked;
    }
  }
  return found;
}
