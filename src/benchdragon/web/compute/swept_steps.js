// The ways of benches cut into steps, each with an outline of what a bench covers: of analysis/swept_steps.py
// what has arrays there.

import { _ } from "../words.js";
import { doubles, withArena, wholes } from "./arena.js";
import { ANALYSIS_SWEPT_STEPS } from "./constants.js";
import { InputError, UnsureError } from "./errors.js";
import { general } from "./number_format.js";
import { linspace } from "./numbers.js";
import { tick } from "./tick.js";

/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {[number, number]} Point */
/** A stretch of the route, m. @typedef {[number, number]} Span */
/** A step: the corners of the bench at both ends, how far it comes beyond their hull at most, and how much of
 * the hull it does not cover, m. @typedef {{ corners: Point[], stray: number, fill: number, stands: boolean }} Step */

const { BATCH, FIRST_STEP, LEAST_STEP, MOST_STEPS, SLACK, FILL_SHARE, STRAY_SHARE } =
  ANALYSIS_SWEPT_STEPS;

/**
 * The corners of all steps of a walk over a span, s, each fine enough for an error, m; how far benches come
 * beyond their hulls at most, and any point of these is from what is covered, m.
 * @param {Walk} walk
 * @param {Span} span
 * @param {number} error
 * @param {Progress} progress
 */
export async function walkedSteps(walk, span, error, progress) {
  /** @type {Point[][]} */
  const corners = [];
  let [stray, needless] = [0, 0];
  const kinds = kindsOf(walk, span);
  for (const [n, { bench, spans }] of kinds.entries()) {
    let waiting = spans.flatMap((one) => firstSteps(one, walk.dragon.link[bench]));
    while (waiting.length) {
      if (corners.length + waiting.length > MOST_STEPS) throw tooMany(error);
      /** @type {Span[]} */
      const halves = [];
      for (let first = 0; first < waiting.length; first += BATCH) {
        const ends = waiting.slice(first, first + BATCH);
        for (const [i, step] of placedSteps(walk, bench, ends).entries()) {
          const sum = step.stray + step.fill;
          if (step.stray <= STRAY_SHARE * error && sum <= FILL_SHARE * error) {
            corners.push(step.corners);
            [stray, needless] = [Math.max(stray, step.stray), Math.max(needless, sum)];
          } else halves.push(...halved(walk, span, bench, ends[i], step));
        }
        progress(n / kinds.length, "");
        await tick();
      }
      waiting = halves;
    }
  }
  return { corners, stray: stray + SLACK, needless: needless + SLACK };
}

/** Benches by their sizes: one of each kind (from 0), and where front handles of that kind walk. @param {Walk} walk @param {Span} span s */
function kindsOf(walk, span) {
  const { dragon } = walk;
  const fronts = withArena(walk.engine, (arena) => [...doubles(walk.motion(arena, span).s)]);
  /** @type {Map<string, { bench: number, spans: Span[] }>} */
  const kinds = new Map();
  for (let bench = 0; bench < dragon.benches; bench++) {
    const { length, width, front_inset, rear_inset } = dragon;
    const key = [length, width, front_inset, rear_inset].map((sizes) => sizes[bench]).join();
    const kind = kinds.get(key) ?? { bench, spans: [] };
    kind.spans.push([fronts[2 * bench], fronts[2 * bench + 1]]);
    kinds.set(key, kind);
  }
  return [...kinds.values()].map(({ bench, spans }) => ({ bench, spans: merged(spans) }));
}

/** The union of stretches as stretches that are apart, ascending. @param {Span[]} spans */
function merged(spans) {
  /** @type {Span[]} */
  const found = [];
  for (const [from, to] of [...spans].sort((a, b) => a[0] - b[0])) {
    const last = found[found.length - 1];
    if (last && from <= last[1]) last[1] = Math.max(last[1], to);
    else found.push([from, to]);
  }
  return found;
}

/** @param {Span} span @param {number} link m @returns {Span[]} */
function firstSteps([low, high], link) {
  const count = Math.max(Math.ceil((high - low) / (FIRST_STEP * link)), 1);
  const borders = linspace(low, high, count + 1);
  return Array.from({ length: count }, (_step, n) => [borders[n], borders[n + 1]]);
}

/** The halves of a step that is not fine enough. @param {Walk} walk @param {Span} span @param {number} bench @param {Span} ends @param {Step} step @returns {Span[]} */
function halved(walk, [start, end], bench, [low, high], { stands }) {
  if (!stands || high - low <= LEAST_STEP) {
    const heads = linspace(walk.headPosition(start), walk.headPosition(end), BATCH);
    const unsure = new UnsureError(
      _(
        "a bench with {link} m between its handles leaps, or may leap, with its front handle at s = {s} m of the route: use gentler bends or shorter benches",
        { link: general(walk.dragon.link[bench]), s: general(low) },
      ),
    );
    throw walk.first_failure(heads) ?? unsure;
  }
  const middle = 0.5 * (low + high);
  return [
    [low, middle],
    [middle, high],
  ];
}

/** @param {number} error */
function tooMany(error) {
  return new InputError(
    _(
      "the area within {error} m takes more than {most} steps: allow a larger error, or ask for a shorter time or fewer sizes of benches",
      { error: general(error), most: MOST_STEPS },
    ),
  );
}

/** Steps of a bench (from 0) between route positions of its front handle, m. @param {Walk} walk @param {number} bench @param {Span[]} ends @returns {Step[]} */
function placedSteps({ engine, dragon, route }, bench, ends) {
  return withArena(engine, (arena) => {
    const count = 2 * ends.length;
    const [link, at] = [arena.vector([dragon.link[bench]]), arena.vector(ends.flat())];
    const [places, strays] = [arena.placements(2, count), arena.array("d", ends.length)];
    engine.call("bd_motion_bounds_place_chain", route.rows, link, at, 0, count, places);
    engine.call("bd_ground_covered_strays", route.rows, link, dragon.sizes, bench, places, strays);
    const [x, y, failed] = [doubles(places.x), doubles(places.y), wholes(places.failed)];
    const diagonal = Math.hypot(dragon.length[bench], dragon.width[bench]);
    return ends.map((_ends, n) => {
      const [one, other] = [2 * n, 2 * n + 1].map((slot) => {
        const [u, v] = [x[slot] - x[count + slot], y[slot] - y[count + slot]];
        const long = Math.hypot(u, v);
        return { x: x[slot], y: y[slot], u: u / long, v: v / long };
      });
      // What a chord leaves of an arc: the hull of a rectangle at two poses, turned by d, is nowhere farther
      // than d diameter / 4 from what it covers on its way.
      const fill = 0.25 * Math.hypot(other.u - one.u, other.v - one.v) * diagonal;
      const corners = [one, other].flatMap((pose) => cornersOf(dragon, bench, pose));
      const stands = failed[2 * n] === 0 && failed[2 * n + 1] === 0;
      return { corners, stray: doubles(strays)[n], fill, stands };
    });
  });
}

/** The corners of a bench (from 0) whose front handle is at x, y, and which points along u, v. @param {Walk["dragon"]} dragon @param {number} bench @param {{ x: number, y: number, u: number, v: number }} pose @returns {Point[]} */
function cornersOf({ length, width, front_inset: front }, bench, { x, y, u, v }) {
  const half = 0.5 * width[bench];
  return [front[bench], front[bench] - length[bench]].flatMap((along) =>
    [half, -half].map(
      (side) => /** @type {Point} */ ([x + along * u - side * v, y + along * v + side * u]),
    ),
  );
}
