// The kinds of routes that a plan may have, and where on each the head stands and comes to: twin of
// plans/routes.py.

import { _ } from "../words.js";
import { CURVE, PLANS_ROUTES, SURVEYS_LINES, TURN_FAMILIES } from "./constants.js";
import { Route, joinedParts, partOf, radians, spiralBetween, startPose } from "./curves.js";
import { greatest } from "./dragon.js";
import { Faults, InputError, KeyedError, keyed } from "./errors.js";
import { fitted, withoutRepeats } from "./fitting.js";
import { builtFormation, checkStep, programme, refuseTight, wholeDragonOn } from "./formations.js";
import { general } from "./number_format.js";
import { builtTurn } from "./turns.js";

/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./curves.js").Part} Part */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {Record<string, any>} Tables */
/** A route before it is moved to its place, and where on it the head stands at time 0, m. */
/** @typedef {{ route: Route, start: number }} Built */

/** @param {Arena} arena @param {Tables} data @returns {Built} */
function spiralIn(arena, { route: { pitch, start_turn, clockwise }, disc: { radius } }) {
  const k = pitch / (2 * Math.PI);
  const end = radius === null ? 0 : radius / k;
  const start = 2 * Math.PI * start_turn;
  if (end >= start)
    throw keyed(
      "disc.radius",
      _("disc.radius ({disc} m) must be smaller than the radius of start_turn ({start} m)", {
        disc: general(radius),
        start: general(start * k),
      }),
    );
  const spiral = partOf(CURVE.SPIRAL, [pitch, start, end, clockwise ? 1 : -1]);
  return { route: new Route(arena, [spiral]), start: 0 };
}

/** Radius of the turning space, m: the paper's, if the plan does not say. @param {Tables} data */
export function discOf({ disc }) {
  return disc.radius ?? 4.5;
}

/** The turn of a plan, checked. @param {Arena} arena @param {Tables} data @param {Dragon | null} dragon */
export function turnOf({ engine }, data, dragon) {
  const disc = discOf(data);
  const turn = tried("turn", () => builtTurn(engine, data.turn, data.route.pitch, disc));
  for (const [name, radius] of /** @type {Array<[string, number]>} */ ([
    ["entry_radius", turn.joints.entry],
    ["exit_radius", turn.joints.exit],
  ]))
    if (radius > disc)
      throw keyed(
        `turn.${name}`,
        _("turn.{name} ({radius} m) must not exceed disc.radius ({disc} m)", {
          name,
          radius: general(radius),
          disc: general(disc),
        }),
      );
  const { extent, leastRadius } = turn;
  if (extent > disc + PLANS_ROUTES.FITS)
    throw keyed(
      "turn",
      _("the turn reaches {reach} m from the centre, out of a disc of {disc} m", {
        reach: general(extent, 4),
        disc: general(disc),
      }),
    );
  const link = longestLink(dragon);
  if (2 * leastRadius <= link)
    throw keyed(
      "turn",
      _(
        "a bench with {link} m between its handles cannot follow a bend of {radius} m radius: it must be wider than {least} m",
        { link: general(link), radius: general(leastRadius, 4), least: general(0.5 * link) },
      ),
    );
  return turn;
}

/** What `make` makes; an error of its own is one of the key. @template T @param {string} key @param {() => T} make */
function tried(key, make) {
  try {
    return make();
  } catch (error) {
    if (error instanceof InputError) throw keyed(key, error.message);
    throw error;
  }
}

/** The longest link, m; 0 where benches cannot be. @param {Dragon | null} dragon */
function longestLink(dragon) {
  return dragon ? greatest(dragon.link) : 0;
}

/** @param {Arena} arena @param {Tables} data @param {Dragon | null} dragon @returns {Built} */
function turnRoute(arena, data, dragon) {
  const turn = turnOf(arena, data, dragon);
  const route = turn.route(arena, (dragon ? dragon.extent : 0) + TURN_FAMILIES.TRAIL);
  return { route, start: route.joints[1] };
}

/** The curve of a part of a plan, at the origin. @param {Tables} part */
function builtPart({ kind, length, start_curvature: a, end_curvature: b, ...part }) {
  switch (kind) {
    case "line":
      return partOf(CURVE.LINE, [length]);
    case "arc":
      return partOf(CURVE.ARC, [part.radius, radians(part.angle)]);
    case "spiral": {
      const { pitch, start_radius: from, end_radius: to, clockwise } = part;
      return spiralBetween(pitch, from, to, to < from !== clockwise);
    }
    default:
      return partOf(kind === "clothoid" ? CURVE.CLOTHOID : CURVE.LOG_SPIRAL, [length, a, b]);
  }
}

/** @param {Arena} arena @param {Tables} data @returns {Built} */
function partsRoute(arena, { route: { part, start, heading } }) {
  const faults = new Faults();
  /** @type {Part[]} */
  const parts = [];
  part.forEach((/** @type {Tables} */ one, /** @type {number} */ i) => {
    const made = faults.tried(`route.part.${i}`, () => builtPart(one));
    if (made) parts.push(made);
  });
  if (faults.found.length) throw new KeyedError(faults.found);
  if (start !== null || heading !== null) {
    const pose = startPose(arena.engine, parts[0]);
    const [x, y] = start ?? [pose.x, pose.y];
    const turned = heading === null ? pose.heading : radians(heading);
    [parts[0]] = joinedParts(arena.engine, [parts[0]], 0, 1, { x, y, heading: turned });
  }
  return { route: Route.joined(arena, parts), start: 0 };
}

/** @param {Arena} arena @param {Tables} data @param {Dragon | null} dragon @returns {Built} */
function formationRoute(arena, data, dragon) {
  const parts = builtFormation(arena.engine, data.route, "route", longestLink(dragon));
  const route = new Route(arena, parts);
  return { route, start: dragonOn(route, data, dragon) };
}

/** @param {Arena} arena @param {Tables} data @param {Dragon | null} dragon @returns {Built} */
function programmeRoute(arena, data, dragon) {
  const { formation, radius } = data.route;
  const [faults, link] = [new Faults(), longestLink(dragon)];
  faults.tried("route.radius", () => refuseTight("route.radius", radius, link));
  const steps = formation.map((/** @type {Tables} */ one, /** @type {number} */ i) => {
    const key = `route.formation.${i}`;
    return faults.tried(key, () => {
      const parts = builtFormation(arena.engine, one, key, link);
      tried(`${key}.turned`, () => checkStep(one));
      return { parts, at: one.at, turned: radians(one.turned) };
    });
  });
  if (faults.found.length) throw new KeyedError(faults.found);
  const route = new Route(arena, programme(arena.engine, steps, radius));
  return { route, start: dragonOn(route, data, dragon) };
}

/** Where the head stands with the tail at the route's start, m; 0 where the plan says another. @param {Route} route @param {Tables} data @param {Dragon | null} dragon */
function dragonOn(route, data, dragon) {
  return data.walk.position !== null || !dragon ? 0 : wholeDragonOn(route, dragon);
}

/** @param {Arena} arena @param {Tables} data @param {Dragon | null} dragon @returns {Built} */
function drawnRoute(arena, { route: table }, dragon) {
  const parts = drawnParts(arena.engine, table, longestLink(dragon));
  const [kind, x, y, heading] = parts[0];
  if (table.closed) {
    const once = new Route(arena, parts);
    const laps = Math.ceil((dragon ? dragon.extent : 0) / once.length);
    if ((laps + 1) * parts.length > SURVEYS_LINES.MOST_CURVES)
      throw keyed(
        "route",
        _(
          "the dragon goes round the drawing {laps} times, with {count} bends a round: too many; draw it larger, or allow a larger deviation",
          { laps, count: parts.length },
        ),
      );
    const all = Array.from({ length: laps + 1 }, () => parts).flat();
    return { route: new Route(arena, all), start: laps * once.length };
  }
  if (kind === CURVE.LINE) return { route: new Route(arena, parts), start: 0 };
  const { RUN_UP } = PLANS_ROUTES;
  /** @type {[number, number]} */
  const behind = [x - RUN_UP * Math.cos(heading), y - RUN_UP * Math.sin(heading)];
  const before = partOf(CURVE.LINE, [RUN_UP], behind, heading);
  return { route: new Route(arena, [before, ...parts]), start: RUN_UP };
}

/** The parts of the route along a drawing; `link` is the longest of a bench, m. @param {import("../engine.js").Engine} engine @param {Tables} table @param {number} link */
function drawnParts(engine, table, link) {
  const { points, piece, closed, least_radius, smooth, deviation, drawn_within: off } = table;
  const least = Math.max(least_radius ?? 0, 0.5 * link * (1 + PLANS_ROUTES.FOLDS));
  if (piece?.length)
    throw keyed(
      "route",
      _(
        "this page does not compute routes of surveyed pieces: the command line does, by benchdragon check",
      ),
    );
  if (!points?.length) throw keyed("route", _("a drawn route needs points, or a file beside the plan"));
  const line = { points: withoutRepeats(points, closed), closed, off };
  return fitted(engine, line, smooth, deviation, least);
}

const KINDS = {
  "spiral-in": spiralIn,
  turn: turnRoute,
  parts: partsRoute,
  formation: formationRoute,
  programme: programmeRoute,
  drawn: drawnRoute,
};

/**
 * The route of a plan where it is danced, and where on it the head stands at time 0, m.
 * @param {Arena} arena which holds the route
 * @param {Tables} data the plan's tables, filled
 * @param {Dragon | null} dragon null where its benches cannot be
 * @returns {Built}
 */
export function builtRoute(arena, data, dragon) {
  const { kind, at, turned } = data.route;
  const built = KINDS[/** @type {keyof typeof KINDS} */ (kind)](arena, data, dragon);
  if (at === null && turned === 0) return built;
  return { route: built.route.moved(arena, radians(turned), at ?? [0, 0]), start: built.start };
}

/** The head's route position at the end of the walk, m. @param {Tables} data @param {Walk} walk */
export function lastPosition({ route: { kind } }, walk) {
  if (kind !== "turn") return walk.route.length;
  const { joints } = walk.route;
  return walk.headWhereTail(joints[joints.length - 2]);
}
