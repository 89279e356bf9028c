// A long dance as its head's frames, and how the handle behind follows a handle: twin of
// player/following.py.

import { Table } from "../following.js";
import { doubles, withArena } from "./arena.js";
import { PLAYER_FOLLOWING, PLAYER_FRAMES, Status } from "./constants.js";
import { spread } from "./course.js";
import { checkFarthest, cubic, inSlices } from "./frames.js";
import { linspace, rint } from "./numbers.js";
import { tick } from "./tick.js";
import { Placement } from "./walk.js";

/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("./frames.js").Frames} Frames */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {import("../messages").FollowTable} FollowTable */

/**
 * The table of one length of link: the message, its nodes (ways, then rates, in FINE), the largest error
 * seen between nodes, m, and its reader.
 * @typedef {{ sent: FollowTable, nodes: Int32Array, error: number, reader: Table }} LinkTable
 */
/**
 * One stretch of a table.
 * @typedef {{ start: number, step: number, ways: Int32Array, rates: Int32Array, error: number }} LinkStretch
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

const { QUANTUM, STEPS, SHARES } = PLAYER_FRAMES;
const { FINE, LARGEST, SHARE, STRETCH, MOST_NODES, MOST_ALL, MOST_KINDS, NARROW, LOOK } =
  PLAYER_FOLLOWING;
/** As Python does it. @type {Care} */
export const CAREFUL = { compared: PLAYER_FOLLOWING.MOST_COMPARED, looks: PLAYER_FOLLOWING.MOST_LOOKS };

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
  checkFarthest(walk, start, end);
  const { link } = walk.dragon;
  const links = [...new Set(link)].sort((a, b) => a - b);
  if (links.length > MOST_KINDS) return null;
  const low = tailBench(walk, start) - QUANTUM;
  const high = walk.headPosition(end) + QUANTUM;
  /** @type {LinkTable[]} */
  const tables = [];
  for (const one of links) {
    const table = await linkTable(walk, link.indexOf(one), low, high);
    if (!table) return null;
    tables.push(table);
  }
  const head = headFrames(walk, start, end, 0.5 * most, shares.length ? shares : SHARES);
  if (!head) return null;
  const kinds = Array.from(link, (one) => links.indexOf(one));
  const readers = kinds.map((kind) => tables[kind].reader);
  const sum = tables.reduce((all, { error }) => all + error, head.error);
  const error = Math.max(await comparedError(walk, head, readers, care.compared), sum);
  if (!(error <= most)) return null;
  const looked = await lookAll(walk, head, readers, care.looks);
  return { head: { ...head, error }, tables, kinds, ...looked };
}

/** Route position of the last bench's front handle at a time, m. @param {Walk} walk @param {number} time */
function tailBench(walk, time) {
  return withArena(
    walk.engine,
    (arena) => doubles(walk.motion(arena, [time]).s)[walk.dragon.benches - 1],
  );
}

/** The fewest frames of the head's handle that are nowhere farther off than `most`, m. @param {Walk} walk @param {number} start @param {number} end @param {number} most @param {readonly number[]} shares @returns {Frames | null} */
function headFrames(walk, start, end, most, shares) {
  for (const step of STEPS) {
    const count = Math.max(Math.ceil((end - start) / step - 1e-9), 1) + 1;
    const times = linspace(start, end, count);
    const even = times[1] - times[0];
    const places = Int32Array.from(times.map((t) => rint(walk.headPosition(t) / QUANTUM)));
    const speeds = Int32Array.from(times.map((t) => rint(walk.profile.speed(t) / QUANTUM)));
    const head = { start, step: even, count, places, speeds, error: 0, leap: false };
    for (const share of shares)
      for (let k = 0; k < count - 1; k++) {
        const off = Math.abs(between(head, k, share) - walk.headPosition(times[k] + share * even));
        if (off > head.error) head.error = off;
      }
    if (head.error <= most) return head;
  }
  return null;
}

/** Where frames have the head at a share of the step behind frame k, m. @param {Frames} head @param {number} k @param {number} share */
function between({ places, speeds, step }, k, share) {
  const rise = QUANTUM * step;
  return cubic(
    places[k] * QUANTUM,
    places[k + 1] * QUANTUM,
    speeds[k] * rise,
    speeds[k + 1] * rise,
    share,
  );
}

/** Where a page has the head's handle at a time, m. @param {Frames} head @param {number} time */
function headAt(head, time) {
  const along = Math.min(Math.max((time - head.start) / head.step, 0), head.count - 1);
  const k = Math.min(Math.trunc(along), head.count - 2);
  return between(head, k, along - k);
}

/** The table of the link of a bench (row, from 0), from route position low to high, m, or null. @param {Walk} walk @param {number} bench @param {number} low @param {number} high */
async function linkTable(walk, bench, low, high) {
  const { route } = walk;
  const [from, to] = [Math.max(low, -route.extension), Math.min(high, route.length)];
  const edges = edgesOf(walk, bench, from, to);
  /** @type {LinkStretch[]} */
  const found = [];
  let nodes = 0;
  for (let n = 1; n < edges.length; n++) {
    const piece = linkStretch(walk, bench, edges[n - 1], edges[n]);
    if (!piece || nodes > MOST_ALL) return null;
    nodes += piece.ways.length;
    found.push(piece);
    await tick();
  }
  return tableOf(walk.dragon.link[bench], found);
}

/** Stretches as one table. @param {number} link @param {LinkStretch[]} found @returns {LinkTable} */
function tableOf(link, found) {
  const count = found.reduce((sum, { ways }) => sum + ways.length, 0);
  const nodes = new Int32Array(2 * count);
  let at = 0;
  for (const { ways, rates } of found) {
    nodes.set(ways, at);
    nodes.set(rates, count + at);
    at += ways.length;
  }
  const stretches = found.map(({ start, step, ways }) => ({ start, step, nodes: ways.length }));
  const sent = { link, stretches, fine: FINE, packed: "" };
  const error = found.reduce((worst, piece) => Math.max(worst, piece.error), 0);
  return { sent, nodes, error, reader: new Table(sent, nodes) };
}

/**
 * One bench with its front handle at places: where its rear handle is, and its speed over the front's.
 * @param {Walk} walk
 * @param {number} bench
 * @param {Float64Array} at
 */
function onePlaced(walk, bench, at) {
  return withArena(walk.engine, (arena) => {
    const placed = new Placement(arena, walk.dragon.only(arena, bench), walk.route, at);
    const rear = (/** @type {Float64Array} */ table) => table.slice(at.length);
    const sound = placed.status.every((status) => status === Status.OK);
    return { s: rear(doubles(placed.s)), ratio: rear(doubles(placed.ratio)), sound };
  });
}

/** Where stretches end: at joints, where the next handle is at a joint, and in between. @param {Walk} walk @param {number} bench @param {number} low @param {number} high */
function edgesOf(walk, bench, low, high) {
  const { joints } = walk.route;
  const left = joints.slice();
  const right = joints.map((joint) => joint + 2 * LARGEST + walk.dragon.link[bench]);
  for (let halving = 0; halving < 60; halving++) {
    const middle = left.map((a, i) => 0.5 * (a + right[i]));
    const { s } = onePlaced(walk, bench, middle.map((at) => Math.min(Math.max(at, low), high))); // prettier-ignore
    middle.forEach((at, i) => {
      if (s[i] < joints[i] && at < high) left[i] = at;
      else right[i] = at;
    });
  }
  const rears = left.map((a, i) => 0.5 * (a + right[i]));
  const borders = [low, ...joints, ...rears].sort((a, b) => a - b);
  const inner = borders.filter(
    (at, i) => i > 0 && at - borders[i - 1] > NARROW && at > low + NARROW && at < high - NARROW,
  );
  return spread([low, ...inner, high], STRETCH);
}

/** One stretch with as many nodes as it needs to be off by less than its share. @param {Walk} walk @param {number} bench @param {number} low @param {number} high @returns {LinkStretch | null} */
function linkStretch(walk, bench, low, high) {
  const [link, most] = [walk.dragon.link[bench], SHARE / walk.dragon.benches];
  const inside = (high - low) * 1e-10; // rates at a border are those of this side
  for (let count = 3; count <= MOST_NODES; count = 2 * count - 1) {
    const at = linspace(low + inside, high - inside, 4 * count - 3);
    const placed = onePlaced(walk, bench, at);
    const ways = at.map((s, i) => s - placed.s[i] - link);
    const rates = placed.ratio.map((ratio) => 1 - ratio);
    const large = (/** @type {number} */ value) => !(Math.abs(value) <= LARGEST);
    if (!placed.sound || ways.some(large) || rates.some(large)) return null;
    const fine = (/** @type {Float64Array} */ table) =>
      Int32Array.from({ length: count }, (_node, n) => rint(table[4 * n] / FINE));
    const step = (high - low) / (count - 1);
    const piece = { start: low, step, ways: fine(ways), rates: fine(rates), error: 0 };
    const { reader } = tableOf(link, [piece]);
    at.forEach((s, i) => {
      reader.look(s);
      piece.error = Math.max(piece.error, Math.abs(reader.s - placed.s[i]));
    });
    if (piece.error <= most) return piece;
  }
  return null;
}

/** The largest distance of any handle from its place at times of all the dance, m. @param {Walk} walk @param {Frames} head @param {Table[]} readers @param {number} most handles times times */
async function comparedError(walk, head, readers, most) {
  const count = Math.max(Math.floor(most / (readers.length + 1)), 16);
  const last = head.step * (head.count - 1);
  // Shares of the dance that come near no frames' pattern.
  const share = (/** @type {number} */ n) => (n * 0.618034 + 0.5) % 1;
  const times = Float64Array.from({ length: count }, (_time, n) => head.start + last * share(n)).sort();
  let worst = 0;
  await inSlices(walk, times, (motion) => {
    const exact = doubles(motion.s);
    motion.times.forEach((time, t) => {
      let s = headAt(head, time);
      for (let i = 0, k = t; i < motion.handles; i++, k += motion.count) {
        const off = Math.abs(s - exact[k]);
        if (!(off <= worst)) worst = Number.isNaN(off) ? Infinity : off;
        if (i === readers.length) break;
        readers[i].look(s);
        s = readers[i].s;
      }
    });
  });
  return worst;
}

/** What comes out of a look at all handles, evenly spread over the dance. @param {Walk} walk @param {Frames} head @param {Table[]} readers @param {number} most handles times times */
async function lookAll(walk, head, readers, most) {
  const [benches, last] = [readers.length, head.start + head.step * (head.count - 1)];
  const count = Math.min((last - head.start) / LOOK, most / (benches + 1));
  const times = linspace(head.start, last, Math.max(Math.ceil(count), 2) + 1);
  const [fastest, when] = [new Float64Array(benches).fill(-Infinity), new Float64Array(benches)];
  const ends = /** @type {[Float64Array, Float64Array]} */ ([times.slice(), times.slice()]);
  const before = new Float64Array(benches + 1);
  let [low, high, change] = [Infinity, -Infinity, 0];
  for (let t = 0; t < times.length; t++) {
    const pace = walk.profile.speed(times[t]);
    let [s, ratio] = [walk.headPosition(times[t]), 1];
    ends[0][t] = s;
    for (let i = 0; i <= benches; i++) {
      const speed = ratio * pace;
      low = Math.min(low, speed);
      high = Math.max(high, speed);
      if (t) change = Math.max(change, Math.abs(speed - before[i]));
      before[i] = speed;
      if (i === benches) break;
      if (speed > fastest[i]) [fastest[i], when[i]] = [speed, times[t]];
      readers[i].look(s);
      ratio *= readers[i].rate;
      s = readers[i].s;
    }
    ends[1][t] = s;
    if (t % 64 === 63) await tick();
  }
  const speeds = /** @type {[number, number]} */ ([low, high]);
  return { fastest, when, speeds, change: change / (times[1] - times[0]), times, ends };
}
