// A dance unpacked: where every handle is, and how fast, at any time.

import { Clock } from "./made/clock.js";
import { Table } from "./following.js";

/** @typedef {import("./messages").Dance} Dance */

/**
 * Places and speeds of all handles at one time.
 * @typedef {object} Stand
 * @property {number} time s
 * @property {Float64Array} s route positions, m
 * @property {Float64Array} v speeds, m/s
 * @property {Float64Array} a changes of speed, m/s², means over the frame
 * @property {Float64Array} x m
 * @property {Float64Array} y m
 */

const BYTES = 4;

/**
 * Four-byte numbers that were sent bytes of one rank after another, deflated, in base64.
 * @param {string} packed
 * @returns {Promise<ArrayBuffer>}
 */
async function unpacked(packed) {
  const squeezed = Uint8Array.from(atob(packed), (sign) => sign.charCodeAt(0));
  const stream = new Blob([squeezed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = planes.length / BYTES;
  const whole = new Uint8Array(planes.length);
  for (let rank = 0; rank < BYTES; rank++) {
    for (let i = 0; i < count; i++) whole[BYTES * i + rank] = planes[rank * count + i];
  }
  return whole.buffer;
}

/**
 * The dance that was sent.
 * @param {Dance} sent
 */
export async function unpackedScene(sent) {
  const tables = sent.following?.tables ?? [];
  const [course, frames, ...nodes] = await Promise.all([
    unpacked(sent.course.packed),
    unpacked(sent.frames.packed),
    ...tables.map(({ packed }) => unpacked(packed)),
  ]);
  return new Scene(
    sent,
    new Float32Array(course),
    foretold(new Int32Array(frames), sent.frames),
    tables.map((table, i) => new Table(table, new Int32Array(nodes[i]))),
  );
}

/**
 * Speeds, then positions, from what they add to what is foretold of them, in its place.
 * @param {Int32Array} told
 * @param {Dance["frames"]} frames
 */
function foretold(told, { count, step }) {
  const [size, half] = [told.length / 2, 0.5 * step];
  for (let first = 0; first < size; first += count) {
    let [speed, rise, place] = [0, 0, 0];
    for (let k = first; k < first + count; k++) {
      rise += told[k];
      const walked = k > first ? Math.floor((2 * speed + rise) * half + 0.5) : 0;
      speed += rise;
      place += walked + told[size + k];
      told[k] = speed;
      told[size + k] = place;
    }
  }
  return told;
}

export class Scene {
  /**
   * @param {Dance} sent
   * @param {Float32Array} nodes x, y, heading of the route's nodes
   * @param {Int32Array} numbers speeds, then positions, in quanta, handle by handle
   * @param {Table[]} tables how handles follow the one before, where the frames are the head's alone
   */
  constructor(sent, nodes, numbers, tables) {
    this.sent = sent;
    /** How papers tell times, where there are any. */
    this.papers = sent.papers ? new Clock(sent.papers.said, sent.papers.start) : null;
    this.tables = tables;
    const { start, step, count, quantum } = sent.frames;
    this.start = start;
    this.step = step;
    this.count = count;
    this.quantum = quantum;
    this.end = start + step * (count - 1);
    this.benches = sent.benches.length.length;
    this.handles = this.benches + 1;
    this.links = sent.benches.length.map(
      (length, i) => length - sent.benches.front_inset[i] - sent.benches.rear_inset[i],
    );
    this.nodes = nodes.length / 3;
    this.node = nodes;
    this.stretches = sent.course.stretches;
    this.firsts = new Int32Array(this.stretches.length);
    for (let i = 1; i < this.firsts.length; i++) {
      this.firsts[i] = this.firsts[i - 1] + this.stretches[i - 1].nodes;
    }
    /** How many handles have frames of their own. */
    this.framed = sent.following ? 1 : this.handles;
    this.speeds = numbers.subarray(0, this.framed * count);
    this.places = numbers.subarray(this.framed * count);
    this.fastest = this.#fastest();
    const { range, change } = this.#ranges();
    this.speedRange = range;
    this.greatestChange = change;
  }

  /** Greatest speed of every bench's front handle among the frames, m/s, and when, s. */
  #fastest() {
    if (this.sent.following) {
      const { fastest, when } = this.sent.following;
      return { speed: Float64Array.from(fastest), time: Float64Array.from(when) };
    }
    const speed = new Float64Array(this.benches);
    const time = new Float64Array(this.benches);
    for (let i = 0; i < this.benches; i++) {
      let best = i * this.count;
      for (let k = best; k < (i + 1) * this.count; k++) {
        if (this.speeds[k] > this.speeds[best]) best = k;
      }
      speed[i] = this.speeds[best] * this.quantum;
      time[i] = this.start + this.step * (best - i * this.count);
    }
    return { speed, time };
  }

  /** Least and greatest speed, m/s, and greatest change of speed, m/s², of all handles among the frames. */
  #ranges() {
    if (this.sent.following) {
      const { speeds: range, change } = this.sent.following;
      return { range, change };
    }
    let [low, high, change] = [Infinity, -Infinity, 0];
    for (let first = 0; first < this.speeds.length; first += this.count) {
      for (let k = first; k < first + this.count; k++) {
        low = Math.min(low, this.speeds[k]);
        high = Math.max(high, this.speeds[k]);
        if (k > first) change = Math.max(change, Math.abs(this.speeds[k] - this.speeds[k - 1]));
      }
    }
    /** @type {[number, number]} */
    const range = [low * this.quantum, high * this.quantum];
    return { range, change: (change * this.quantum) / this.step };
  }

  /** Room for what `stand` finds. @returns {Stand} */
  room() {
    const array = () => new Float64Array(this.handles);
    return { time: this.start, s: array(), v: array(), a: array(), x: array(), y: array() };
  }

  /**
   * Put every handle where it is at a time, s.
   * @param {number} time
   * @param {Stand} out
   */
  stand(time, out) {
    const along = Math.min(Math.max((time - this.start) / this.step, 0), this.count - 1);
    const k = Math.min(Math.floor(along), this.count - 2);
    const f = along - k;
    const rest = 1 - f;
    const blend = f * f * (3 - 2 * f);
    const { quantum, step, places, speeds, count } = this;
    for (let i = 0, at = k; i < this.framed; i++, at += count) {
      const way = (places[at + 1] - places[at]) * quantum;
      const v0 = speeds[at] * quantum;
      const v1 = speeds[at + 1] * quantum;
      out.s[i] = places[at] * quantum + blend * way + step * f * rest * (rest * v0 - f * v1);
      out.v[i] = v0 + f * (v1 - v0);
      out.a[i] = (v1 - v0) / step;
      this.#put(out.s[i], i, out.x, out.y);
    }
    this.#follow(out);
    out.time = time;
    return out;
  }

  /** Put every handle that has no frames behind the one before it. @param {Stand} out */
  #follow(out) {
    for (let i = this.framed; i < this.handles; i++) {
      const table = this.tables[this.sent.following?.kinds[i - 1] ?? 0];
      const v = out.v[i - 1];
      table.look(out.s[i - 1]);
      out.s[i] = table.s;
      out.v[i] = v * table.rate;
      out.a[i] = out.a[i - 1] * table.rate + v * v * table.bend;
      this.#put(out.s[i], i, out.x, out.y);
    }
  }

  /**
   * A point of the route, m.
   * @param {number} s route position, m
   * @returns {[number, number]}
   */
  point(s) {
    this.#put(s, 0, this.#x, this.#y);
    return [this.#x[0], this.#y[0]];
  }

  #x = new Float64Array(1);
  #y = new Float64Array(1);

  /**
   * @param {number} s
   * @param {number} i
   * @param {Float64Array} x
   * @param {Float64Array} y
   */
  #put(s, i, x, y) {
    const at = this.#stretch(s);
    const { start, step, nodes } = this.stretches[at];
    const along = (s - start) / step;
    const node = Math.min(Math.max(Math.trunc(along), 0), nodes - 2);
    const first = this.firsts[at] + node;
    const f = along - node;
    const rest = 1 - f;
    const blend = f * f * (3 - 2 * f);
    const reach = step * f * rest;
    const h0 = this.node[2 * this.nodes + first];
    const h1 = this.node[2 * this.nodes + first + 1];
    const [ox, oy] = this.sent.course.origin;
    const x0 = this.node[first];
    const y0 = this.node[this.nodes + first];
    x[i] =
      ox + x0 + blend * (this.node[first + 1] - x0) + reach * (rest * Math.cos(h0) - f * Math.cos(h1));
    y[i] =
      oy +
      y0 +
      blend * (this.node[this.nodes + first + 1] - y0) +
      reach * (rest * Math.sin(h0) - f * Math.sin(h1));
  }

  /** Number of the stretch that a route position lies on. @param {number} s */
  #stretch(s) {
    let low = 0;
    let high = this.stretches.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.stretches[middle].start <= s) low = middle;
      else high = middle;
    }
    return low;
  }
}
