// Where benches are as near to an obstacle as they may be, to be drawn: twin of model/outline.py.

/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {[number, number]} Point */
/** A chord of the raw outline, and where others cross it, as shares of it. */
/** @typedef {{ a: Point, b: Point, cuts: Array<[number, Point]> }} Chord */

// The angle between corners of a circle that is drawn, rad; chords of one outline that are compared.
const ARC_STEP = Math.PI / 64;
const MOST_CHORDS_DRAWN = 3000;
// What chords of arcs may be nearer than the arcs, as a share.
const NEARER = 1e-3;

/**
 * Where benches are as near as they may be: closed rings, m; or none. Of the venue they lie inside its
 * edge; none are left where its margin leaves no room.
 * @param {Obstacle} obstacle
 * @returns {Point[][]}
 */
export function marginRings({ kind, outline, radius, margin }) {
  if (!margin) return [];
  if (kind === "circle") {
    const from = /** @type {Point} */ ([outline[0][0] + radius + margin, outline[0][1]]);
    return [arcAbout(outline[0], from, 2 * Math.PI).slice(0, -1)];
  }
  const way = kind === "line" ? thereAndBack(outline) : turnedLeft(outline, kind !== "venue");
  const raw = rawOutline(way, margin, (2 * Math.PI) / MOST_CHORDS_DRAWN);
  const chords = raw.map((a, i) => ({ a, b: raw[(i + 1) % raw.length], cuts: [] }));
  cutChords(chords);
  const far = margin * (1 - NEARER);
  const kept = chords.flatMap(partsOf).filter(([a, b]) => {
    const middle = /** @type {Point} */ ([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
    return distanceFrom(way, middle) >= far;
  });
  return chained(kept);
}

/** An open line as an outline without an inside. @param {Point[]} points */
function thereAndBack(points) {
  return [...points, ...points.slice(1, -1).reverse()];
}

/** Corners in the order in which what is wanted lies to the right. @param {Point[]} outline @param {boolean} outside */
function turnedLeft(outline, outside) {
  const twice = outline.reduce((sum, [x, y], i) => {
    const [nextX, nextY] = outline[(i + 1) % outline.length];
    return sum + x * nextY - y * nextX;
  }, 0);
  return twice > 0 === outside ? outline : [...outline].reverse();
}

/** Points of an arc about a centre from a point on, both ends too. @param {Point} centre @param {Point} from @param {number} sweep rad @param {number} [step] */
function arcAbout([cx, cy], [x, y], sweep, step = ARC_STEP) {
  const count = Math.max(Math.ceil(Math.abs(sweep) / Math.max(step, ARC_STEP) - 1e-9), 1);
  return Array.from({ length: count + 1 }, (_point, n) => {
    const [c, s] = [Math.cos((sweep * n) / count), Math.sin((sweep * n) / count)];
    const [dx, dy] = [x - cx, y - cy];
    return /** @type {Point} */ ([cx + c * dx - s * dy, cy + s * dx + c * dy]);
  });
}

/** All sides moved to the right, joined by arcs about corners; it may cross itself. @param {Point[]} way @param {number} away m @param {number} step */
function rawOutline(way, away, step) {
  const count = way.length;
  const headings = way.map(([x, y], i) => {
    const [toX, toY] = way[(i + 1) % count];
    return Math.atan2(toY - y, toX - x);
  });
  return way.flatMap((corner, i) => {
    const before = headings[(i + count - 1) % count];
    let turn = headings[i] - before;
    turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
    if (turn < -Math.PI + 1e-9) turn = Math.PI; // the end of an open line
    /** @type {Point} */
    const from = [corner[0] + away * Math.sin(before), corner[1] - away * Math.cos(before)];
    const arc = arcAbout(corner, from, turn, step * count);
    return turn > 0 ? arc : [arc[0], corner, arc[arc.length - 1]];
  });
}

/** Note where chords cross one another. @param {Chord[]} chords */
function cutChords(chords) {
  chords.forEach((one, i) => {
    const [ax, ay, ux, uy] = [one.a[0], one.a[1], one.b[0] - one.a[0], one.b[1] - one.a[1]];
    for (let j = i + 2; j < chords.length; j++) {
      const { a, b, cuts } = chords[j];
      if (i === 0 && j === chords.length - 1) continue;
      if (Math.max(a[0], b[0]) < Math.min(ax, ax + ux) || Math.min(a[0], b[0]) > Math.max(ax, ax + ux))
        continue;
      const [vx, vy] = [b[0] - a[0], b[1] - a[1]];
      const cross = ux * vy - uy * vx;
      if (!cross) continue;
      const s = ((a[0] - ax) * vy - (a[1] - ay) * vx) / cross;
      const t = ((a[0] - ax) * uy - (a[1] - ay) * ux) / cross;
      if (!(s > 0 && s < 1 && t > 0 && t < 1)) continue;
      /** @type {Point} */
      const point = [ax + s * ux, ay + s * uy];
      one.cuts.push([s, point]);
      cuts.push([t, point]);
    }
  });
}

/** A chord in the parts between its cuts. @param {Chord} chord @returns {Array<[Point, Point]>} */
function partsOf({ a, b, cuts }) {
  const points = [a, ...cuts.sort(([s], [t]) => s - t).map(([, point]) => point), b];
  return points.slice(1).map((point, n) => [points[n], point]);
}

/** How far a point lies from an outline, m. @param {Point[]} way @param {Point} point */
function distanceFrom(way, [x, y]) {
  let least = Infinity;
  way.forEach(([ax, ay], i) => {
    const [bx, by] = way[(i + 1) % way.length];
    const [dx, dy, px, py] = [bx - ax, by - ay, x - ax, y - ay];
    const at = Math.min(Math.max((px * dx + py * dy) / (dx * dx + dy * dy), 0), 1);
    least = Math.min(least, Math.hypot(px - at * dx, py - at * dy));
  });
  return least;
}

/** Parts that lead from one to the next, as rings. @param {Array<[Point, Point]>} parts */
function chained(parts) {
  const next = new Map(parts.map((part) => [part[0], part]));
  /** @type {Point[][]} */
  const rings = [];
  while (next.size) {
    const [first] = next.values();
    /** @type {Point[]} */
    const ring = [];
    for (let part = first; part && next.delete(part[0]);) {
      ring.push(part[0]);
      part = /** @type {[Point, Point]} */ (next.get(part[1]));
      if (!part) break;
    }
    if (ring.length > 2) rings.push(ring);
  }
  return rings;
}
