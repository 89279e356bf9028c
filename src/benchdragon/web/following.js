// How the handles of a long dance follow the head: each stands where the one before it tells.

/** @typedef {import("./messages").FollowTable} FollowTable */

/** How much longer than the link the way back to the next handle is, by the place of a handle. */
export class Table {
  /**
   * @param {FollowTable} sent
   * @param {Int32Array} nodes ways of all nodes, then their changes along the route
   */
  constructor(sent, nodes) {
    this.link = sent.link;
    this.fine = sent.fine;
    this.stretches = sent.stretches;
    this.node = nodes;
    this.nodes = nodes.length / 2;
    this.firsts = new Int32Array(this.stretches.length);
    for (let i = 1; i < this.firsts.length; i++) {
      this.firsts[i] = this.firsts[i - 1] + this.stretches[i - 1].nodes;
    }
    /** Where the next handle stands, m. */
    this.s = 0;
    /** How far it goes a metre of this handle's way. */
    this.rate = 1;
    /** How that changes along the way of this handle, 1/m. */
    this.bend = 0;
  }

  #at = 0;

  /** Find `s`, `rate` and `bend` of the handle behind one at s. @param {number} s route position, m */
  look(s) {
    // Handle after handle the place is but a little farther back.
    while (this.#at > 0 && this.stretches[this.#at].start > s) this.#at--;
    const last = this.stretches.length - 1;
    while (this.#at < last && this.stretches[this.#at + 1].start <= s) this.#at++;
    const { start, step, nodes } = this.stretches[this.#at];
    const along = (s - start) / step;
    const k = Math.min(Math.max(Math.trunc(along), 0), nodes - 2);
    const first = this.firsts[this.#at] + k;
    const f = along - k;
    const rest = 1 - f;
    const { fine, node } = this;
    const rise = (node[first + 1] - node[first]) * fine;
    const r0 = node[this.nodes + first] * fine;
    const r1 = node[this.nodes + first + 1] * fine;
    const blend = f * f * (3 - 2 * f);
    const way = node[first] * fine + blend * rise + step * f * rest * (rest * r0 - f * r1);
    this.s = s - this.link - way;
    this.rate = 1 - ((6 * f * rest * rise) / step + rest * (1 - 3 * f) * r0 + f * (3 * f - 2) * r1);
    this.bend = -((6 * (1 - 2 * f) * rise) / step + (6 * f - 4) * r0 + (6 * f - 2) * r1) / step;
  }
}
