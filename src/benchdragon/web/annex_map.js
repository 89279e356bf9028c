// The ground of a dance to scale, for the permit annex: what benches cover, the spectators' line, the square,
// and posts for marshals.

import { draw, make } from "./elements.js";
import { scaleOf } from "./paper.js";
import { compass, placed, standing } from "./sheet_map.js";
import { _, language } from "./words.js";

/** @typedef {import("./compute/annex.js").AnnexFacts} AnnexFacts */
/** @typedef {import("./compute/briefing.js").Briefing} Briefing */
/** @typedef {[number, number]} Point */

/** How tall the drawing is at most, mm, and how much ground there is about it. */
const [TALL, ROOM] = [170, 4];
/** Lines, marks and letters, mm. */
const [THIN, LINE, EDGE, POST, ENTRANCE, LETTERS] = [0.2, 0.5, 0.35, 2, 1.2, 2.6];
/** Lengths of the scale bar, m: the longest that is no longer than so many mm. */
const BARS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000];
const LONGEST = 60;

/** The drawing, and its scale: the 500 of 1:500. @param {Briefing} briefing @param {AnnexFacts} facts */
export function annexMap(briefing, { ground, posts }) {
  const around = boundsOf(briefing, ground.lines.flat());
  const scale = scaleOf(around, TALL);
  /** Metres of the ground to a millimetre. */
  const mm = scale / 1000;
  const [left, bottom, right, top] = [-ROOM, -ROOM, ROOM, ROOM].map((more, n) => around[n] + more * mm);
  const svg = draw(
    "svg",
    {
      viewBox: `${left} ${-top} ${right - left} ${top - bottom}`,
      role: "img",
      "aria-label": _("The ground that benches cover, the spectators' line, the square and the posts"),
    },
    closed(ground.outlines, { class: "covered", "fill-rule": "evenodd", "stroke-width": THIN * mm }),
    route(briefing, THIN * mm),
    draw("g", { "stroke-width": String(EDGE * mm) }, ...briefing.ways.obstacles.map(standing)),
    closed(ground.lines, {
      class: "spectators",
      "stroke-width": LINE * mm,
      "stroke-dasharray": `${2 * mm} ${mm}`,
    }),
    ...namesOf(briefing, mm),
    ...posts.flatMap(({ point }, n) => spot(point, String(n + 1), POST * mm, "post")),
  );
  svg.style.width = `${(right - left) / mm}mm`;
  svg.style.setProperty("--digits", `${LETTERS * mm}px`);
  const figure = make("figure", { class: "ground" }, svg, compass(briefing.ground), bar(mm));
  figure.append(make("figcaption", {}, ...legend(ground.margin)));
  return { figure, scale };
}

/** What is drawn: left, bottom, right, top, m. @param {Briefing} briefing @param {Point[]} line @returns {[number, number, number, number]} */
function boundsOf({ ground, ways }, line) {
  const corners = ways.obstacles.flatMap(({ points, radius }) =>
    points.flatMap(([x, y]) => [
      [x - radius, y - radius],
      [x + radius, y + radius],
    ]),
  );
  const all = [...line, ...corners, ground.peg, ...ways.entrances];
  const [x, y] = [0, 1].map((n) => all.map((point) => point[n]));
  const least = (/** @type {number[]} */ some) => some.reduce((one, other) => Math.min(one, other));
  const most = (/** @type {number[]} */ some) => some.reduce((one, other) => Math.max(one, other));
  return [least(x), least(y), most(x), most(y)];
}

/** Closed lines as one shape. @param {Point[][]} rings @param {Record<string, string | number>} looks */
function closed(rings, looks) {
  const d = rings.map((ring) => `M${ring.map(placed).join("L")}Z`).join("");
  return draw("path", {
    d,
    ...Object.fromEntries(Object.entries(looks).map(([key, value]) => [key, String(value)])),
  });
}

/** @param {Briefing} briefing @param {number} wide m */
function route({ points }, wide) {
  const way = [];
  for (let n = 0; n < points.length; n += 2) way.push(placed([points[n], points[n + 1]]));
  return draw("path", {
    d: `M${way.join("L")}`,
    class: "way",
    fill: "none",
    "stroke-width": String(wide),
  });
}

/** The peg, entrances, and what obstacles are called. @param {Briefing} briefing @param {number} mm */
function namesOf({ ground, ways }, mm) {
  const [x, y] = ground.peg;
  const arm = ENTRANCE * mm;
  const d = `M${x - arm} ${-y}h${2 * arm}M${x} ${-y - arm}v${2 * arm}`;
  const above = (/** @type {string} */ text, /** @type {Point} */ [u, v]) =>
    letters(text, [u, v + 1.8 * mm], "name");
  return [
    draw("path", { class: "peg", d, "stroke-width": String(EDGE * mm) }),
    above(_("peg"), [x, y]),
    ...ways.entrances.flatMap((place, n) => [
      draw("path", {
        class: "gate",
        d: `M${placed([place[0] - arm, place[1]])}l${arm} ${-arm}l${arm} ${arm}l${-arm} ${arm}Z`,
      }),
      above(_("entrance {n}", { n: n + 1 }), place),
    ]),
    ...ways.obstacles
      .filter(({ kind }) => kind !== "venue")
      .map(({ points, radius, shown }) => {
        const top = points.reduce((most, point) => Math.max(most, point[1]), -Infinity) + radius;
        const middle = points.reduce((sum, point) => sum + point[0], 0) / points.length;
        return above(shown[language()], [middle, top - mm]);
      }),
  ];
}

/** A disc with a number in it. @param {Point} place @param {string} text @param {number} radius m @param {string} kind */
function spot([x, y], text, radius, kind) {
  const wide = String(0.15 * radius);
  const at = { cx: String(x), cy: String(-y), r: String(radius), "stroke-width": wide };
  const disc = draw("circle", { ...at, class: kind });
  return [disc, letters(text, [x, y - 0.45 * radius], "number")];
}

/** @param {string} text @param {Point} place @param {string} kind */
function letters(text, [x, y], kind) {
  const found = draw("text", { x: String(x), y: String(-y), class: kind, "text-anchor": "middle" });
  found.textContent = text;
  return found;
}

/** A bar as long as so many metres are on paper. @param {number} mm metres to a millimetre */
function bar(mm) {
  const metres = [...BARS].reverse().find((one) => one / mm <= LONGEST) ?? BARS[0];
  const line = make("span", { class: "bar" });
  line.style.width = `${metres / mm}mm`;
  return make("p", { class: "scale" }, line, ` ${metres} m`);
}

/** What lines and marks mean. @param {number} margin m */
function legend(margin) {
  const line = _("spectators' line, {margin} m from it", { margin });
  /** @type {Array<[string, string]>} */
  const signs = [
    ["covered", _("ground covered")],
    ["spectators", line],
    ["way", _("route")],
    ["post", _("post for a marshal")],
  ];
  return signs.map(([kind, text]) =>
    make("span", { class: "key" }, make("span", { class: `sign ${kind}` }), text),
  );
}
