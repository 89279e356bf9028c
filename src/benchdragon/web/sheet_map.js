// A small map of a dance on paper: the square, the route, and the track of one bench, or where all start.

import { draw, make } from "./elements.js";
import { Ground } from "./made/ground.js";
import { arrange, naming } from "./map_names.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {[number, number]} Point */

// Widths of lines and sizes of marks, mm of paper, on a map as wide as that.
const [THIN, EDGE, BOLD, MARK] = [0.15, 0.35, 0.9, 1.5];
// How wide and tall a map is about, mm, by which lines are drawn so wide.
/** @type {Record<string, [number, number]>} */
const SIZES = { a4: [150, 90], quarter: [85, 45], lanyard: [62, 45] };
// Every so manyth bench is numbered, where numbers are so far apart, mm; and how tall they are.
const NUMBERED = [1, 2, 5, 10, 20, 50, 100, 200, 500];
const [NUMBER_ROOM, DIGITS] = [5, 2.5];
// No letters on paper are smaller, CSS pixels: 7 points.
const LEAST = (7 / 72) * 96;
// Of an obstacle's name so many signs at most; a cross's arm, mm.
const [MOST_SIGNS, CROSS] = [16, 1.4];
// Papers that were made: each has its own names for what is drawn once and used by all of its maps.
let made = 0;
/** The venue's edges on maps. @type {WeakMap<Element, Point[][]>} */
const edges = new WeakMap();

/** Of points the coordinates as the picture has them, with y downwards. @param {Point} point */
export function placed([x, y]) {
  return `${x.toFixed(3)},${(-y).toFixed(3)}`;
}

/** What all maps of a dance share. */
export class SheetMaps {
  /** @param {Briefing} briefing @param {string} paper "a4", "quarter" or "lanyard" */
  constructor(briefing, paper) {
    this.briefing = briefing;
    made++;
    this.square = `sheet-square-${made}`;
    this.line = `sheet-way-${made}`;
    /** The points of the route, m. @type {Point[]} */
    this.way = [];
    for (let n = 0; n < briefing.points.length; n += 2)
      this.way.push([briefing.points[n], briefing.points[n + 1]]);
    const [low, high] = this.#bounds();
    const size = [high[0] - low[0], high[1] - low[1]].map((side) => Math.max(side, 1e-3));
    /** Metres of the dance to a millimetre of a map, about. */
    this.unit = Math.max(size[0] / SIZES[paper][0], size[1] / SIZES[paper][1]);
    const around = 3 * MARK * this.unit;
    const [x, y] = [low[0] - around, -high[1] - around];
    this.viewBox = [x, y, size[0] + 2 * around, size[1] + 2 * around]
      .map((n) => n.toFixed(3))
      .join(" ");
  }

  /** The lower left and the upper right corner of all that is shown, m. @returns {Point[]} */
  #bounds() {
    const corners = this.briefing.ways.obstacles.flatMap(({ points, radius }) =>
      points.flatMap(([x, y]) => /** @type {Point[]} */ ([[x - radius, y - radius], [x + radius, y + radius]])),
    ); // prettier-ignore
    const { ground, ways } = this.briefing;
    const all = [...this.way, ground.peg, ...ways.entrances, ...corners];
    return [Math.min, Math.max].map(
      (most) =>
        /** @type {Point} */ (
          [0, 1].map((n) => all.reduce((one, point) => most(one, point[n]), all[0][n]))
        ),
    );
  }

  /** What maps draw from: it must stand in the page beside them. */
  shared() {
    const { low, high, obstacles } = this.briefing.ways;
    const way = draw("path", {
      id: this.line,
      d: `M${this.way.map(placed).join("L")}`,
      pathLength: String(high - low),
      fill: "none",
    });
    const square = draw("g", { id: this.square, "stroke-width": String(EDGE * this.unit) });
    square.append(...obstacles.map((one) => standing(one)));
    return draw("svg", { class: "shared", "aria-hidden": "true" }, draw("defs", {}, way, square));
  }

  /** The square and the route. @param {string} name for those who cannot see it @param {Node[]} more */
  #map(name, ...more) {
    const thin = String(THIN * this.unit);
    const svg = draw(
      "svg",
      { viewBox: this.viewBox, role: "img", "aria-label": name },
      draw("use", { href: `#${this.square}` }),
      draw("use", { href: `#${this.line}`, class: "way", "stroke-width": thin }),
      ...more,
      ...this.#names(),
    );
    svg.style.setProperty("--digits", `${DIGITS * this.unit}px`);
    const venues = this.briefing.ways.obstacles.filter(({ kind }) => kind === "venue");
    edges.set(svg, venues.map(({ points }) => points.map(([x, y]) => [x, -y]))); // prettier-ignore
    return make("figure", { class: "map" }, svg, compass(this.briefing.ground));
  }

  /** The peg, entrances, and what obstacles are called. */
  #names() {
    const { unit } = this;
    const { ground, ways } = this.briefing;
    const [x, y] = [ground.peg[0], -ground.peg[1]];
    const arm = CROSS * unit;
    const d = `M${x - arm} ${y}h${2 * arm}M${x} ${y - arm}v${2 * arm}`;
    const cross = draw("path", { class: "peg", d, "stroke-width": String(EDGE * unit) });
    const found = [cross, this.#name(_("peg"), [x, y], [arm, arm])];
    for (const [n, [u, v]] of ways.entrances.entries()) {
      const at = { cx: u.toFixed(3), cy: (-v).toFixed(3), r: String(arm) };
      found.push(draw("circle", { ...at, class: "peg", "stroke-width": String(EDGE * unit) }));
      found.push(this.#name(_("entrance {n}", { n: n + 1 }), [u, -v], [arm, arm]));
    }
    for (const { kind, points, radius, shown } of ways.obstacles) {
      if (kind === "venue") continue;
      const [low, high] = [Math.min, Math.max].map((most) =>
        [0, 1].map((k) => most(...points.map((point) => point[k]))),
      );
      const [u, v] = [0, 1].map((k) => 0.5 * (low[k] + high[k]));
      const [wide, tall] = [0, 1].map((k) => 0.5 * (high[k] - low[k]) + radius);
      const told = Array.from(shown[language()]).slice(0, MOST_SIGNS).join("");
      found.push(this.#name(told, [u, -v], [wide, tall]));
    }
    return found;
  }

  /** A name of what lies about a place of the picture. @param {string} name @param {Point} at @param {Point} half its width and height @param {string} [kind] */
  #name(name, at, half, kind = "name") {
    const text = draw("text", { x: at[0].toFixed(3), y: at[1].toFixed(3), class: kind });
    text.textContent = name;
    return naming(text, at, half);
  }

  /** The tracks of benches (numbers, from 1): discs where they start, arrows' heads where they end; named where they are several. @param {{ bench: number, called: string }[]} benches */
  tracks(benches) {
    const { low, high, s, ends } = this.briefing.ways;
    const { unit } = this;
    let moves = false;
    const drawn = benches.flatMap(({ bench, called }, n) => {
      const [first, last] = s.map((at) => at[bench - 1]);
      const [start, end] = ends.map((at) => at.slice(3 * bench - 3, 3 * bench));
      moves ||= last > first;
      const track = draw("use", {
        href: `#${this.line}`,
        class: "track",
        // Who goes the same way is seen below.
        "stroke-width": String((BOLD + 0.9 * (benches.length - 1 - n)) * unit),
        "stroke-dasharray": `0 ${first - low} ${last - first} ${high - low}`,
      });
      const mark = MARK * unit;
      const name = this.#name(called, [start[0], -start[1]], [mark, mark]);
      const one = draw(
        "g",
        { class: n ? "other" : "own" },
        track,
        disc(start, mark),
        this.#arrow(end),
        ...(benches.length > 1 ? [name] : []),
      );
      return [one];
    });
    const map = this.#map(_("map with your way"), ...drawn);
    map.append(legend(moves));
    return map;
  }

  /** An arrow's head at a place, to its heading. @param {number[]} end */
  #arrow([x, y, heading]) {
    const turned = (-heading * 180) / Math.PI;
    const size = MARK * this.unit;
    const transform = `translate(${placed([x, y])}) rotate(${turned.toFixed(2)}) scale(${size})`;
    return draw("path", { class: "mark", d: "M1.4 0L-1 1.1L-1 -1.1Z", transform });
  }

  /** The chalk plan: tapes with their numbers, ticks, and letters at places that have a name. @param {import("./compute/briefing.js").ChalkPlan} chalk @param {Record<string, string>} letters */
  chalk({ stars, legs, ticks }, letters) {
    const { unit } = this;
    const { turned } = this.briefing.ground;
    const spokes = stars.flatMap(({ stake: [x, y], spokes: count, reach }) =>
      Array.from({ length: count }, (_spoke, k) => {
        const angle = turned + (2 * Math.PI * k) / count;
        const [u, v] = [Math.cos(angle), Math.sin(angle)];
        const far = reach + 2.5 * unit;
        const number = this.#number([x + far * u, y + far * v], String(k + 1));
        return [this.#tape([x, y], [x + reach * u, y + reach * v]), number];
      }).flat(),
    );
    const tapes = legs.flatMap(({ start, end }, n) => {
      const [x, y] = [0, 1].map((k) => 0.5 * (start[k] + end[k]));
      return [this.#tape(start, end), this.#number([x, y + 2 * unit], String(n + 1))];
    });
    const marks = ticks.flatMap(({ point: [x, y], star, out, kind }) => {
      // Letters stand towards the stake: beyond the ticks are the spokes' numbers.
      const [u, v] = star < 0 ? [x, y - 1] : stars[star].stake;
      const share = (2.5 * unit) / Math.max(Math.hypot(u - x, v - y), unit);
      const letter = kind
        ? [this.#number([x + share * (u - x), y + share * (v - y)], letters[kind])]
        : [];
      return [tickSign([x, y], out, 0.6 * unit), ...letter];
    });
    return this.#map(_("The route, tapes and ticks"), ...spokes, ...tapes, ...marks);
  }

  /** @param {Point} from @param {Point} to */
  #tape(from, to) {
    const width = { "stroke-width": String(THIN * this.unit) };
    return draw("path", { class: "tape", d: `M${placed(from)}L${placed(to)}`, ...width });
  }

  /** A number or a letter at a place. @param {Point} place @param {string} said */
  #number([x, y], said) {
    const at = { x: x.toFixed(3), y: (-y + 0.4 * DIGITS * this.unit).toFixed(3) };
    const text = draw("text", { ...at, class: "number middle" });
    text.textContent = said;
    return text;
  }

  /** Where all benches start, with as many numbers as find room. @param {(bench: number) => string} called */
  starts(called) {
    const { briefing, unit } = this;
    const [s] = briefing.ways.s;
    const least = s.slice(1).reduce((gap, at, n) => Math.min(gap, Math.abs(s[n] - at)), Infinity);
    const each =
      NUMBERED.find((n) => (n * least) / unit >= NUMBER_ROOM) ?? NUMBERED[NUMBERED.length - 1];
    const { count_head: counted } = briefing.people;
    const marks = briefing.benches.flatMap(({ bench, place: [x, y] }) => {
      const dot = disc([x, y], 0.6 * unit);
      const number = counted ? bench : bench - 1;
      const end = !counted && (bench === 1 || bench === briefing.benches.length);
      if (!end && number % each) return [dot];
      const dotted = 0.6 * unit;
      const said = end ? called(bench) : String(number);
      return [dot, this.#name(said, [x, -y], [dotted, dotted], "number")];
    });
    return this.#map(
      _("The square, the route, and where the front handle of each bench starts"),
      ...marks,
    );
  }
}

/** A tick, or a cross. @param {Point} place @param {boolean} out @param {number} size m */
function tickSign([x, y], out, size) {
  if (!out) return disc([x, y], size);
  const d = `M${x - size} ${-y - size}l${2 * size} ${2 * size}m${-2 * size} 0l${2 * size} ${-2 * size}`;
  return draw("path", { class: "cross", d, "stroke-width": String(0.6 * size) });
}

/** Have no letters on a map that stands in the page smaller than LEAST, and names in their places. @param {Element} map */
export function readable(map) {
  const svg = map.querySelector("svg");
  const scale = svg?.getScreenCTM()?.a;
  if (svg && scale) svg.style.setProperty("--least", `${LEAST / scale}px`);
  if (svg) arrange(svg, edges.get(svg) ?? []);
}

/** @param {number[]} place @param {number} radius m */
function disc([x, y], radius) {
  return draw("circle", { class: "mark", cx: x.toFixed(3), cy: (-y).toFixed(3), r: radius.toFixed(4) });
}

/** The venue's edge, or an obstacle. @param {Briefing["ways"]["obstacles"][number]} one */
export function standing({ kind, points, left, radius }) {
  if (kind === "circle") {
    const [[x, y]] = points;
    return draw("circle", { class: "stone", cx: String(x), cy: String(-y), r: String(radius) });
  }
  if (left.length)
    return draw("path", {
      class: "edge",
      d: left.map((line) => `M${line.map(placed).join("L")}`).join(""),
    });
  const shape = kind === "line" ? "polyline" : "polygon";
  const solid = kind !== "line" && kind !== "venue";
  return draw(shape, { class: solid ? "stone" : "edge", points: points.map(placed).join(" ") });
}

/** An arrow the way y points, and what is there. @param {Briefing["ground"]} ground */
export function compass(ground) {
  const turned = ((-ground.turned * 180) / Math.PI).toFixed(2);
  const d = "M8 11V3M8 0L5.6 4.2H10.4Z";
  const arrow = draw("path", { d, class: "compass", transform: `rotate(${turned} 8 5.5)` });
  const text = draw("text", { x: "8", y: "16.2", "text-anchor": "middle" });
  text.textContent = new Ground(ground.peg, ground.turned, ground.north, ground.venue).y_word;
  return draw("svg", { class: "compass", viewBox: "-4 0 24 17", "aria-hidden": "true" }, arrow, text);
}

/** What the marks mean that are there. @param {boolean} moves whether the bench does */
function legend(moves) {
  const sign = (/** @type {SVGElement} */ shape) =>
    draw("svg", { viewBox: "-2 -2 4 4", class: "sign", "aria-hidden": "true" }, shape);
  const end = sign(draw("path", { class: "mark", d: "M1.8 0L-1.2 1.4L-1.2 -1.4Z" }));
  return make(
    "figcaption",
    {},
    sign(disc([0, 0], 1.4)),
    make("span", {}, _("you start here")),
    ...(moves ? [end, make("span", {}, _("you end here"))] : []),
  );
}
