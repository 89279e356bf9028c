// A long dance as its head's frames, and how the handle behind follows a handle: the host of
// kernels/following.py, as player/following.py is.

import { doubles, wholes, withArenaAsync } from "./arena.js";
import { spend } from "./budget.js";
import { FOLLOWING, FRAMES, PLAYER_FOLLOWING, PLAYER_FRAMES } from "./constants.js";
import { checkFarthest, evenTimes, shotAt, taken } from "./frames.js";
import { linspace } from "./numbers.js";
import { tick } from "./tick.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./frames.js").Frames} Frames */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("../messages").FollowTable} FollowTable */

/** In the engine: see `Tables` of kernels/following.py. @typedef {Record<"links" | "ends" | "stretches" | "nodes" | "kinds", Numbers>} Tables */
/**
 * The table of one length of link: the message, and its nodes (ways, then rates, in FINE).
 * @typedef {{ sent: FollowTable, nodes: Int32Array }} LinkTable
 */
/**
 * How all handles follow the head: see `Following` of player/following.py.
 * @typedef {object} Following
 * @property {Frames} head
 * @property {LinkTable[]} tables
 * @property {number[]} kinds
 * @property {Float64Array} fastest @property {Float64Array} when
 * @property {[number, number]} speeds @property {number} change
 * @property {Float64Array} times @property {[Float64Array, Float64Array]} ends
 */
/** How carefully: handles times times compared with exact places, and looked at for the greatest speeds. */
/** @typedef {{ compared: number, looks: number }} Care */

const { SHARE, MOST_ALL, MOST_KINDS, LOOK } = PLAYER_FOLLOWING;
/** As Python does it. @type {Care} */
export const CAREFUL = { compared: PLAYER_FOLLOWING.MOST_COMPARED, looks: PLAYER_FOLLOWING.MOST_LOOKS };
// Times looked at together: after each of these the page is heard.
const HEARD = 64;

/**
 * How the handles follow the head from start to end, s, nowhere farther off than `most`, m. Null where
 * tables cannot tell: a bench leaps or finds no place, links are of too many lengths, or the head changes
 * its speed too often.
 * @param {Walk} walk
 * @param {number} start
 * @param {number} end
 * @param {number} most
 * @param {readonly number[]} shares
 * @param {Care} [care]
 * @returns {Promise<Following | null>}
 */
export async function following(walk, start, end, most, shares, care = CAREFUL) {
  const { route } = walk;
  const low = Math.max(checkFarthest(walk, start, end) - FRAMES.QUANTUM, -route.extension);
  const high = Math.min(walk.headPosition(end) + FRAMES.QUANTUM, route.length);
  return withArenaAsync(walk.engine, async (arena) => {
    const { tables, off } = await tablesOf(arena, walk, low, high);
    if (!Number.isFinite(off)) return null;
    const head = await headFrames(walk, start, end, 0.5 * most, shares.length ? shares : PLAYER_FRAMES.SHARES); // prettier-ignore
    if (!head) return null;
    const error = Math.max(await comparedError(arena, walk, head, tables, care.compared), head.error + off); // prettier-ignore
    if (!(error <= most)) return null;
    const looked = await lookAll(arena, walk, head, tables, care.looks);
    return { head: { ...head, error }, tables: toldOf(tables), kinds: wholes(tables.kinds), ...looked };
  });
}

/** The fewest frames of the head's handle that are nowhere farther off than `most`, m. @param {Walk} walk @param {number} start @param {number} end @param {number} most @param {readonly number[]} shares @returns {Promise<Frames | null>} */
async function headFrames(walk, start, end, most, shares) {
  for (const step of PLAYER_FRAMES.STEPS) {
    const times = evenTimes(start, end, step);
    const shot = await shotAt(walk, [], times, shares, most);
    if (shot.error <= most) return taken(shot, times.length, shot.error, false);
  }
  return null;
}

/** The tables of all links, from route position low to high, m; their errors together, m, infinite where none can tell. @param {Arena} arena @param {Walk} walk @param {number} low @param {number} high */
async function tablesOf(arena, { engine, dragon, route }, low, high) {
  const links = [...new Set(dragon.link)].sort((a, b) => a - b);
  const room = Math.ceil((high - low) / FOLLOWING.LONGEST) + 2 * route.joints.length + 2;
  const tables = {
    links: arena.vector(links),
    ends: arena.whole(links.map(() => 0)),
    stretches: arena.array("d", links.length * room, FOLLOWING.STRETCH_COLUMNS),
    nodes: arena.array("q", 2, MOST_ALL),
    kinds: arena.whole(Array.from(dragon.link, (one) => links.indexOf(one))),
  };
  const most = SHARE / dragon.benches;
  const [joints, at, edges] = [arena.vector(route.joints), arena.array("d", 1), arena.array("d", room)];
  let off = links.length > MOST_KINDS ? Infinity : 0;
  for (let kind = 0; kind < links.length && Number.isFinite(off); kind++) {
    off += engine.call("bd_following_tabulate", route.rows, joints, kind, low, high, most, at, arena.placements(2, 1), edges, tables)[0]; // prettier-ignore
    await tick();
  }
  return { tables, off };
}

/** Tables as a page takes them. @param {Tables} tables @returns {LinkTable[]} */
function toldOf({ links, ends, stretches, nodes }) {
  const [all, rows, lasts] = [wholes(nodes), doubles(stretches), wholes(ends)];
  return Array.from(doubles(links), (link, kind) => {
    const told = [];
    let [from, to] = [Infinity, 0];
    for (let n = kind ? lasts[kind - 1] : 0; n < lasts[kind]; n++) {
      const [start, step, first, count] = rows.subarray(4 * n, 4 * n + 4);
      told.push({ start, step, nodes: count });
      [from, to] = [Math.min(from, first), first + count];
    }
    const own = [...all.slice(from, to), ...all.slice(MOST_ALL + from, MOST_ALL + to)];
    const sent = { link, stretches: told, fine: FOLLOWING.FINE, packed: "" };
    return { sent, nodes: Int32Array.from(own) };
  });
}

/** The largest distance of any handle from its place at times of all the dance, m. @param {Arena} arena @param {Walk} walk @param {Frames} head @param {Tables} tables @param {number} most handles times times */
async function comparedError(arena, walk, head, tables, most) {
  const [handles, last] = [walk.dragon.benches + 1, head.count - 1];
  const count = Math.max(Math.floor(most / handles), 16);
  // Shares of the dance that come near no frames' pattern.
  const share = (/** @type {number} */ n) => (n * 0.618034 + 0.5) % 1;
  const along = Float64Array.from({ length: count }, (_share, n) => last * share(n)).sort();
  const [shares, heads] = [along, along.map((n) => walk.headPosition(head.start + head.step * n))].map(
    (row) => arena.vector(row),
  );
  const [places, speeds] = [head.places, head.speeds].map((row) => arena.vector(row));
  const [at, placed] = [arena.array("d", FRAMES.SLOTS), arena.placements(handles, FRAMES.SLOTS)];
  const { links } = walk.dragon;
  let worst = 0;
  for (let first = 0; first < count; first += HEARD) {
    const until = Math.min(first + HEARD, count);
    spend(handles * (until - first));
    const [off] = walk.engine.call("bd_following_compare_followed", walk.route.rows, links, tables, places, speeds, head.step, shares, heads, first, until, at, placed); // prettier-ignore
    worst = Math.max(worst, off);
    await tick();
  }
  return worst;
}

/** What comes out of a look at all handles, evenly spread over the dance. @param {Arena} arena @param {Walk} walk @param {Frames} head @param {Tables} tables @param {number} most handles times times */
async function lookAll(arena, walk, head, tables, most) {
  const [{ benches }, last] = [walk.dragon, head.start + head.step * (head.count - 1)];
  const count = Math.min((last - head.start) / LOOK, most / (benches + 1));
  const times = linspace(head.start, last, Math.max(Math.ceil(count), 2) + 1);
  const at = times.map((time) => walk.headPosition(time));
  const [heads, paces] = [at, times.map((time) => walk.profile.speed(time))].map((row) => arena.vector(row)); // prettier-ignore
  const [found, ends] = [arena.array("d", 2, benches), arena.array("d", times.length)];
  const speeds = arena.array("d", benches + 1);
  let [low, high, change] = [Infinity, -Infinity, 0];
  for (let first = 0; first < times.length; first += HEARD) {
    const until = Math.min(first + HEARD, times.length);
    const seen = walk.engine.call("bd_following_look_at_followed", tables, heads, paces, first, until, found, ends, speeds); // prettier-ignore
    [low, high] = [Math.min(low, seen[0]), Math.max(high, seen[1])];
    change = Math.max(change, seen[2]);
    await tick();
  }
  const fastest = doubles(found).slice(0, benches);
  const when = doubles(found).slice(benches).map((n) => times[n]); // prettier-ignore
  const told = /** @type {[Float64Array, Float64Array]} */ ([at, doubles(ends).slice()]);
  return { fastest, when, speeds: /** @type {[number, number]} */ ([low, high]), change: change / (times[1] - times[0]), times, ends: told }; // prettier-ignore
}
