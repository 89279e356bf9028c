// A dance as evenly spaced frames, and how far they are off in between: the host of kernels/frames.py, as
// player/frames.py is.

import { _ } from "../words.js";
import { doubles, withArena, withArenaAsync } from "./arena.js";
import { spend } from "./budget.js";
import { FRAMES, PLAYER_FRAMES } from "./constants.js";
import { InputError } from "./errors.js";
import { general } from "./number_format.js";
import { linspace, rint } from "./numbers.js";
import { tick } from "./tick.js";

/** @typedef {import("./walk.js").Walk} Walk */

/**
 * Speeds and route positions of all handles, in quanta, handle by handle (handles, count).
 * @typedef {object} Frames
 * @property {number} start s
 * @property {number} step s
 * @property {number} count
 * @property {Int32Array} numbers speeds, then places: `Scene` of web/scene.js takes these
 * @property {Int32Array} places
 * @property {Int32Array} speeds
 * @property {number} error the largest distance of an interpolated route position from the exact one, m
 * @property {boolean} leap whether they end because a bench leaps, or finds no place, soon after
 */

const { LEAP, CLOSE, BEFORE, TRIED, MOST_PLACES, FARTHEST, STEPS, SHARES } = PLAYER_FRAMES;
// Places that are computed at a time: after each the page is heard.
const PLACES = 60_000;

/**
 * The fewest frames between two times, s, that are nowhere farther off than `most`, m.
 * They end early where the dragon can no longer stand, or a bench leaps.
 * @param {Walk} walk
 * @param {number} start
 * @param {number} end
 * @param {number} most
 * @param {readonly number[]} [shares] where between two frames that is looked at, as shares of the step; if
 *   nowhere, halfway between TRIED of them alone, and they end up to a step before a leap
 * @returns {Promise<Frames>}
 */
export async function frames(walk, start, end, most, shares = SHARES) {
  checkFarthest(walk, start, end);
  const { link, benches } = walk.dragon;
  let [until, leap] = [end, false];
  for (let tried = 0; tried < STEPS.length && until > start;) {
    const times = evenTimes(start, until, STEPS[tried]);
    if (times.length * (benches + 1) > MOST_PLACES) break;
    const seen = shares.length ? 0 : await triedError(walk, times);
    if (seen > most && ++tried) continue;
    const shot = await shotAt(walk, link, times, shares, most);
    if (shot.error <= most) return taken(shot, times.length, Math.max(shot.error, seen), leap);
    const before = await beforeLeap(walk, times, shot.errors);
    const kept = Math.min(Math.floor((before - start) / shot.step), times.length - 2) + 1;
    const cut = before < until && kept > 1 && !shares.length;
    const off = cut ? await triedError(walk, times.subarray(0, kept)) : Infinity;
    if (off <= most) return taken(shot, kept, off, true);
    if (before < until) [until, leap] = [before, true];
    else tried++;
  }
  throw new InputError(
    _(
      "frames of {benches} benches from {start} s to {end} s would be off by more than {error} m or fill more than {most} positions: choose a shorter time",
      { benches, start: general(start), end: general(until), error: general(most), most: MOST_PLACES },
    ),
  );
}

/** Refuse a walk from start to end, s, that goes beyond FARTHEST; where the tail's front handle starts, m. @param {Walk} walk @param {number} start @param {number} end */
export function checkFarthest(walk, start, end) {
  const s = withArena(walk.engine, (arena) => doubles(walk.motion(arena, [start]).s).slice());
  const tail = s.reduce((least, one) => Math.min(least, one), Infinity);
  const far = Math.max(-tail, walk.headPosition(end));
  if (far > FARTHEST)
    throw new InputError(
      _("a player shows {most} m of a route, and this walk goes to {far} m", {
        most: general(FARTHEST),
        far: general(far),
      }),
    );
  return s[s.length - 2];
}

/** Times from start to end, s, evenly spaced by so much, s, or a little less. @param {number} start @param {number} end @param {number} step */
export function evenTimes(start, end, step) {
  return linspace(start, end, Math.max(Math.ceil((end - start) / step - 1e-9), 1) + 1);
}

/**
 * Frames of handles so linked at times, s, a step apart: `table` holds a speed, then a place of each. How far
 * off each is, m, until the next. No more is looked at once one is off by more than `most`, m; if nothing
 * is, it is looked for leaps alone.
 * @param {Walk} walk
 * @param {ArrayLike<number>} links
 * @param {Float64Array} times
 * @param {readonly number[]} shares
 * @param {number} [most]
 * @param {number} [apart] the step, s, if that is not the mean one
 */
export function shotAt(walk, links, times, shares, most = Infinity, apart = undefined) {
  const [count, handles, start] = [times.length, links.length + 1, times[0]];
  const step = apart ?? (times[count - 1] - start) / (count - 1);
  const per = Math.max(Math.floor(PLACES / handles), FRAMES.SLOTS);
  const leap = shares.length ? Infinity : LEAP;
  return withArenaAsync(walk.engine, async (arena) => {
    const [frames, errors] = [arena.array("q", handles, count), arena.full([count], 0)];
    const [at, linked] = [arena.array("d", FRAMES.SLOTS), arena.vector(links)];
    const shot = { frames, errors, at, places: arena.placements(handles, FRAMES.SLOTS) };
    let error = 0;
    for (let look = 0; look <= shares.length && error <= most; look++) {
      const share = look ? shares[look - 1] : 0;
      const looked = times.map((time) => time + share * step);
      const heads = arena.vector(looked.map((time) => walk.headPosition(time)));
      const speeds = arena.vector(looked.map((time) => walk.profile.speed(time)));
      const last = look ? count - 1 : count;
      for (let first = 0; first < last; first += per) {
        const until = Math.min(first + per, last);
        spend(handles * (until - first));
        walk.engine.call("bd_frames_look_at_frames", walk.route.rows, linked, heads, speeds, first, until, share, step, leap, shot); // prettier-ignore
        await tick();
      }
      arena.drop(heads, speeds);
      error = doubles(errors).reduce((worst, one) => Math.max(worst, one), 0);
    }
    const { buffer, byteOffset } = frames.view;
    const table = new Int32Array(buffer, byteOffset, 2 * frames.size).slice();
    return { start, step, handles, table, error, errors: doubles(errors).slice(0, -1) };
  });
}

/** The first frames of a shot. @param {Awaited<ReturnType<typeof shotAt>>} shot @param {number} count @param {number} error @param {boolean} leap @returns {Frames} */
export function taken({ start, step, handles, table, errors }, count, error, leap) {
  const [size, width] = [handles * count, 2 * errors.length + 2];
  const numbers = new Int32Array(2 * size);
  const [speeds, places] = [numbers.subarray(0, size), numbers.subarray(size)];
  for (let i = 0, n = 0; i < handles; i++) {
    for (let k = i * width; n < (i + 1) * count; n++) {
      speeds[n] = table[k++];
      places[n] = table[k++];
    }
  }
  return { start, step, count, numbers, places, speeds, error, leap };
}

/** The largest error halfway between TRIED frames and the next, m, where the dragon stands. @param {Walk} walk @param {Float64Array} times */
async function triedError(walk, times) {
  const few = Array.from(linspace(0, times.length - 2, TRIED), rint);
  const pairs = Float64Array.from(few.flatMap((k) => [times[k], times[k + 1]]));
  const { errors } = await shotAt(walk, walk.dragon.link, pairs, [0.5], Infinity, times[1] - times[0]);
  return errors.filter((error, n) => n % 2 === 0 && error < Infinity).reduce((worst, one) => Math.max(worst, one), 0); // prettier-ignore
}

/** When frames at these times, s, are to end, as a bench leaps behind the first far off; infinite if none. @param {Walk} walk @param {Float64Array} times @param {Float64Array} errors */
async function beforeLeap(walk, times, errors) {
  const far = errors.findIndex((error) => error > LEAP);
  if (far < 0) return Infinity;
  const close = evenTimes(times[far], times[far + 1], CLOSE);
  const looked = await shotAt(walk, walk.dragon.link, close, [0.5]);
  const leap = looked.errors.findIndex((error) => error > LEAP);
  return leap < 0 ? Infinity : close[leap] - BEFORE;
}
