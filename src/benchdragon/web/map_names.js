// Names on a small map: each beside what it names, on the map, and clear of edges and of one another.

/** @typedef {[number, number]} Point */
/** Left, top, right and bottom, as the picture has them. @typedef {[number, number, number, number]} Box */

/** What a text names: its middle, and half its width and height. @typedef {{ at: Point, half: Point }} Named */
/** @type {WeakMap<Element, Named>} */
const things = new WeakMap();

// Where a name may stand beside what it names, the best first: x to the right, y downwards.
const AROUND = /** @type {Point[]} */ (
  [[0, -1], [0, 1], [1, -1], [-1, -1], [1, 1], [-1, 1], [1, 0], [-1, 0]]
); // prettier-ignore
// What it costs a place that it lies off the map, on another name, on an edge, or on what is marked, and
// that it comes later.
const [OFF, NAMED, EDGED, MARKED, LATER] = [100, 20, 10, 3, 0.01];
// Room between a name and what it names, as a share of the name's height.
const ROOM = 0.15;

/** Have a text name what lies about a point, within so much of it. @param {SVGTextElement} text @param {Point} at @param {Point} half */
export function naming(text, at, half) {
  things.set(text, { at, half });
  return text;
}

/** Move all names of a picture that stands in the page to their best places. @param {SVGSVGElement} svg @param {Point[][]} edges rings through which no name runs */
export function arrange(svg, edges) {
  const { x, y, width, height } = svg.viewBox.baseVal;
  /** @type {Box} */
  const map = [x, y, x + width, y + height];
  const texts = [...svg.querySelectorAll("text")].filter((text) => things.has(text));
  const sizes = texts.map((text) => text.getBBox());
  const marks = texts.map((text) => boxOf(/** @type {Named} */ (things.get(text))));
  /** @type {Box[]} */
  const taken = [];
  texts.forEach((text, n) => {
    const { at, half } = /** @type {Named} */ (things.get(text));
    const { width: w, height: h } = sizes[n];
    const cost = (/** @type {Box} */ box, /** @type {number} */ k) =>
      OFF * Number(!within(box, map)) +
      NAMED * taken.filter((other) => meet(box, other)).length +
      EDGED * edges.filter((ring) => crosses(ring, box)).length +
      MARKED * marks.filter((mark) => meet(box, mark)).length +
      LATER * k;
    const places = AROUND.map(([u, v]) => {
      const middle = at[0] + u * (half[0] + ROOM * h + 0.5 * w);
      const left = Math.min(Math.max(middle - 0.5 * w, map[0]), Math.max(map[2] - w, map[0]));
      const top = at[1] + v * (half[1] + ROOM * h + 0.5 * h) - 0.5 * h;
      return /** @type {Box} */ ([left, top, left + w, top + h]);
    });
    const costs = places.map(cost);
    const best = places[costs.indexOf(Math.min(...costs))];
    taken.push(best);
    for (const [name, off] of [
      ["x", best[0] - sizes[n].x],
      ["y", best[1] - sizes[n].y],
    ])
      text.setAttribute(String(name), String(Number(text.getAttribute(String(name))) + Number(off)));
  });
}

/** @param {Named} named @returns {Box} */
function boxOf({ at: [x, y], half: [wide, tall] }) {
  return [x - wide, y - tall, x + wide, y + tall];
}

/** Whether two boxes have ground in common. @param {Box} one @param {Box} other */
function meet(one, other) {
  return one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3];
}

/** @param {Box} one @param {Box} other */
function within(one, other) {
  return one[0] >= other[0] && one[1] >= other[1] && one[2] <= other[2] && one[3] <= other[3];
}

/** Whether a ring of points runs through a box. @param {Point[]} ring @param {Box} box */
function crosses(ring, box) {
  const [left, top, right, bottom] = box;
  const corners = [[left, top], [right, top], [left, bottom], [right, bottom]]; // prettier-ignore
  return ring.some(([ax, ay], n) => {
    const [bx, by] = ring[(n + 1) % ring.length];
    const span = /** @type {Box} */ ([
      Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by),
    ]); // prettier-ignore
    if (!(span[0] <= right && left <= span[2] && span[1] <= bottom && top <= span[3])) return false;
    const sides = corners.map(([x, y]) => Math.sign((bx - ax) * (y - ay) - (by - ay) * (x - ax)));
    return Math.min(...sides) <= 0 && Math.max(...sides) >= 0;
  });
}
