// Better turns: the engine's search over a family, then exact figures of what it found. Twin of solve/turn.py,
// turn_goal.py and turn_question.py, but for fronts of turns, which the command line finds.

import { leastClearance } from "../made/contact.js";
import { leastDistance } from "../made/obstacles.js";
import { QUANTITIES, givenLimits } from "../made/quantities.js";
import { part } from "../made/stages.js";
import { _ } from "../words.js";
import { answered, now } from "./answer.js";
import { TurnRoute } from "../made/plan_routes.js";
import { doubles, withArena, withArenaAsync } from "./arena.js";
import { within } from "./arrays.js";
import { question } from "./budget.js";
import { BOX, QUESTION, SOLVE_TURN, SOLVE_TURN_GOAL, TURN_QUESTION, TURN_TRIAL } from "./constants.js";
import { OwnQuestion } from "./engine_question.js";
import { InputError, NoSolutionError, finite, positive } from "./errors.js";
import { greatestHeadSpeed } from "./head_speed.js";
import { builtDragon } from "./plan.js";
import { greatestOf } from "./speed.js";
import { silent } from "./tick.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./answer.js").Answer} Answer */
/** @typedef {import("./obstacle.js").Obstacle} Obstacle */
/** @typedef {import("./plan.js").Plan} Plan */
/** @typedef {import("./tick.js").Progress} Progress */
/** @typedef {import("../made/turns.js").Turn} Turn */
/** @typedef {"length" | "way" | "speed" | "disc" | "acceleration"} Objective */

/**
 * What is sought of a turn, and what it must keep besides the plan's limits.
 * @typedef {object} TurnGoal
 * @property {Objective} [objective]
 * @property {number} [least_radius] of any bend, m
 * @property {number} [longest] length of the turn itself, m
 * @property {number} [longest_way] whole way inside the disc, m
 */

/**
 * The best turn that was found.
 * @typedef {object} BestTurn
 * @property {Plan} plan the plan with this turn
 * @property {Turn} turn the turn itself
 * @property {Answer} objective its value; no bound on better ones is known
 * @property {number} length of the turn itself, m
 * @property {number} way whole way inside the disc, m
 * @property {Answer | null} headSpeed the greatest constant head speed under the plan's limits; null without
 *   a limit
 * @property {Answer} clearance the least over the whole manoeuvre
 * @property {string[]} active names of the limits that it just keeps: see LIMITS
 */

/** A turn that was found: its unknowns, what was seen of each of TURN_TRIAL.KINDS, and by what share a limit
 * is exceeded. @typedef {{ x: number[], figures: number[], exceeds: number }} Seen */

const { SEARCHED, NARROWINGS, DEEP, ACTIVE, RATE, DISTANCE } = SOLVE_TURN;
const { EXCEEDED, PRUDENCE, DEEPEST, WIDEST, LONGEST_EASE, WIDER } = SOLVE_TURN_GOAL;
const { APART, BEND, BESIDE, KINDS, LIMIT, LONG, MORE, RATES, REACH, TOLD, WAY } = TURN_TRIAL;
const FAMILIES = ["arc-arc", "arc-line-arc", "arc-arc-arc"]; // in the order of turn_trial.TWO_ARCS
/** The figure that is to be small. @type {Record<Objective, number>} */
const SOUGHT = {
  way: WAY,
  length: LONG,
  disc: REACH,
  speed: QUANTITIES.get("speed").kind,
  acceleration: QUANTITIES.get("total_acceleration").kind,
};
/** Limits by the figures that they limit, in the order in which they are told. @type {Array<[number, string]>} */
const LIMITS = [
  [BEND, "radius"],
  [REACH, "disc"],
  [LONG, "length"],
  [WAY, "way"],
  ...[...QUANTITIES.values()].map(({ kind, name }) => /** @type {[number, string]} */ ([kind, name])),
  [APART, "clearance"],
  [BESIDE, "obstacles"],
];

/** A goal, checked, with what it leaves out. @param {TurnGoal} goal @returns {Required<TurnGoal>} */
function wholeGoal(goal) {
  const { objective = "way", least_radius = 0, longest = Infinity, longest_way = Infinity } = goal;
  if (!(objective in SOUGHT)) {
    const values = { known: Object.keys(SOUGHT).join(", "), name: objective };
    throw new InputError(_("wanted one of {known}, not {name}", values));
  }
  finite("least_radius", least_radius, "m");
  for (const [name, value] of Object.entries({ longest, longest_way }))
    if (Number.isFinite(value)) positive(name, value, "m");
  return { objective, least_radius, longest, longest_way };
}

/** The engine's question about the best turn of a plan's family: kernels/turn_question.py. */
class TurnQuestion extends OwnQuestion {
  /** @param {Engine} engine @param {Plan} plan @param {Required<TurnGoal>} goal */
  constructor(engine, plan, goal) {
    const { route, dragon, turn } = plan.tables;
    if (route.kind !== "turn")
      throw new InputError(_("a best turn is sought for plans whose route is a turn"));
    const narrowest = withArena(engine, (arena) =>
      Math.max(WIDER * 0.5 * builtDragon(arena, dragon).longest_link, goal.least_radius),
    );
    const bounds = boundsOf(turn, goal, TurnRoute.disc(plan.tables), narrowest);
    const opened = (/** @type {import("./arena.js").Arena} */ arena, /** @type {any} */ open) => {
      const whole = builtDragon(arena, dragon);
      const { sizes, links } = whole.first(arena, Math.min(MORE, whole.benches));
      const obstacles = plan.obstacles().map((obstacle) => route.unplaced(obstacle));
      const boxes = obstacles.map((obstacle) => Array.from(doubles(obstacle.boxes(arena))));
      const border = [0];
      for (const rows of boxes) border.push(border[border.length - 1] + rows.length / BOX.BOX_COLUMNS);
      const standing = arena.array("d", border[boxes.length], BOX.BOX_COLUMNS);
      doubles(standing).set(boxes.flat());
      const keep = obstacles.map(({ kind, radius, margin }) => [radius + margin, sideOf(kind)]);
      return open(
        arena.vector(toldOf(plan, goal, narrowest)), arena.vector(bounds.map(([low]) => low)),
        arena.vector(bounds.map(([, high]) => high)), sizes, links,
        standing, arena.whole(border), arena.table(keep, 2),
      ); // prettier-ignore
    };
    const told = [[TURN_QUESTION.FIGURES], [bounds.length], [KINDS]];
    super(engine, "bd_turn_question_*_turn", opened, told);
    this.plan = plan;
    this.goal = goal;
    /** What is seen is corrected by: rates are so many times that, distances so many m less. */
    this.factors = Array(KINDS)
      .fill(1)
      .fill(1 + PRUDENCE, 0, RATES)
      .fill(0, APART, BESIDE + 1);
  }

  /** How many turns were tried. */
  get tried() {
    return this.numbers(0)[TURN_QUESTION.TRIED];
  }

  /** The best turn all over the family, or downhill from some unknowns. @param {number[] | null} x @param {Progress} progress @param {string} text @returns {Promise<Seen>} */
  async sought(x, progress, text) {
    const what = x ? TURN_QUESTION.NEAR : TURN_QUESTION.ALL;
    withArena(this.engine, (arena) =>
      this.call("seek", this.handle, what, arena.vector(x ?? Array.from(this.numbers(1))), arena.vector(this.factors)),
    ); // prettier-ignore
    while ((await this.step()) === QUESTION.MORE) progress(this.numbers(0)[TURN_QUESTION.SHARE], text);
    const [figures, found, seen] = [0, 1, 2].map((n) => Array.from(this.numbers(n)));
    return { x: found, figures: seen, exceeds: figures[TURN_QUESTION.EXCEEDS] };
  }

  /** Tell the engine by how much what is seen flatters a turn like this, and somewhat more. @param {number[]} seen @param {number[]} exact @param {number} prudence */
  correct(seen, exact, prudence) {
    seen.forEach((value, kind) => {
      if (!Number.isFinite(value) || !Number.isFinite(exact[kind])) return;
      if (kind < RATES) this.factors[kind] = (exact[kind] / value) * (1 + prudence);
      else if (kind === APART || kind === BESIDE)
        this.factors[kind] = Math.max(exact[kind] - value + prudence, 0);
    });
  }

  /** By what share exact figures exceed their limits, by the limits' names; where there are such. @param {number[]} exact @returns {Array<[string, number]>} */
  exceeded(exact) {
    return withArena(this.engine, (arena) => {
      const exceeds = arena.array("d", KINDS);
      this.call("judge", this.handle, arena.vector(exact), exceeds);
      const shares = /** @type {Float64Array} */ (exceeds.view);
      return LIMITS.filter(([kind]) => shares[kind] > -1).map(([kind, name]) => [name, shares[kind]]);
    });
  }
}

/** Ranges of the unknowns: joints, what the family has, and the clothoids' length if free. @param {Record<string, any>} turn @param {Required<TurnGoal>} goal @param {number} disc @param {number} narrowest m */
function boundsOf(turn, goal, disc, narrowest) {
  const joints = [turn.entry_radius, turn.exit_radius].map((radius) =>
    radius === null ? [DEEPEST * disc, disc] : [radius, radius],
  );
  const radius = [narrowest, Math.max(WIDEST * disc, 1.01 * narrowest)];
  /** @type {Record<string, number[][]>} */
  const inner = {
    "arc-arc": [[Math.log(0.2), Math.log(5)]],
    "arc-line-arc": [radius, radius],
    "arc-arc-arc": [radius, [-1 / narrowest, 1 / narrowest], radius],
  };
  const ease = goal.objective === "acceleration" ? [[0, LONGEST_EASE]] : [];
  return [...joints, ...inner[turn.family], ...ease];
}

/** What the engine is told, as kernels/turn_trial.py says. @param {Plan} plan @param {Required<TurnGoal>} goal @param {number} narrowest m */
function toldOf({ tables }, goal, narrowest) {
  const { turn, limits } = tables;
  const [told, sought] = [Array(TOLD).fill(Infinity), SOUGHT[goal.objective]];
  told[TURN_TRIAL.FAMILY] = FAMILIES.indexOf(turn.family);
  told[TURN_TRIAL.EASE] = goal.objective === "acceleration" ? NaN : turn.ease;
  told[TURN_TRIAL.PITCH] = tables.route.pitch;
  told[TURN_TRIAL.DISC] = TurnRoute.disc(tables);
  told[TURN_TRIAL.NARROWEST] = narrowest;
  told[TURN_TRIAL.LONGEST] = goal.longest;
  told[TURN_TRIAL.LONGEST_WAY] = goal.longest_way;
  told[TURN_TRIAL.HEAD] = tables.walk.speed;
  told[TURN_TRIAL.MARGIN] = limits.margin;
  told[TURN_TRIAL.SOUGHT] = sought;
  for (const [name, limit] of givenLimits({ limits })) told[LIMIT + QUANTITIES.get(name).kind] = limit;
  if (sought < RATES) told[LIMIT + sought] = Infinity;
  return told;
}

/** Where no bench may be: 1 inside, -1 outside, 0: nowhere but at the boxes. @param {string} kind */
function sideOf(kind) {
  return /** @type {Record<string, number>} */ ({ venue: -1, line: 0, circle: 0 })[kind] ?? 1;
}

/** What unknowns say in a plan's [turn]. @param {number[]} x @param {string} family @param {boolean} eased */
function tableOf(x, family, eased) {
  const [entry_radius, exit_radius, ...inner] = x;
  /** @type {Record<string, unknown>} */
  const said = { "turn.entry_radius": entry_radius, "turn.exit_radius": exit_radius };
  if (eased) said["turn.ease"] = inner.pop();
  if (family === "arc-arc") return { ...said, "turn.ratio": Math.exp(inner[0]) };
  if (family === "arc-arc-arc") [said["turn.curvature"]] = inner.splice(1, 1);
  return { ...said, "turn.radii": inner };
}

/**
 * The best turn of the plan's family for a wish, under the plan's limits.
 *
 * Limits are limits.speed with the head at walk.speed (or as fast as it may, if that is the wish), those of
 * accelerations and turning rates, limits.margin over the whole manoeuvre, until the tail is out, and the
 * margins of the venue and of obstacles. Joints that the plan says stay. The search is the same each time;
 * that nothing better exists is not shown.
 * @param {Engine} engine
 * @param {Plan} plan
 * @param {TurnGoal} [goal]
 * @param {{ progress?: Progress }} [options]
 * @returns {Promise<BestTurn>}
 */
export function bestTurn(engine, plan, goal = {}, { progress = silent } = {}) {
  const began = now();
  const wished = wholeGoal(goal);
  if (wished.objective === "speed" && plan.tables.limits.speed === null)
    throw new InputError(_("the plan has no limit of speed: set limits.speed=2, for example"));
  plan.pace(engine); // a wrong one is told before the search, not after it
  return question(async () => {
    const asked = new TurnQuestion(engine, plan, wished);
    try {
      const seen = await asked.sought(null, part(progress, 0, SEARCHED, ""), _("global search"));
      return await settled(asked, seen, part(progress, SEARCHED, 1, ""), began);
    } finally {
      asked.free();
    }
  });
}

/** The best turn near one that was seen, by exact figures. @param {TurnQuestion} asked @param {Seen} seen @param {Progress} progress @param {number} began @returns {Promise<BestTurn>} */
async function settled(asked, seen, progress, began) {
  for (let n = 0; n < NARROWINGS && seen.exceeds <= EXCEEDED; n++) {
    const { best, exact } = await exactTurn(asked, seen, began);
    if (!exact) return best;
    asked.correct(seen.figures, exact, PRUDENCE * 4 ** n);
    seen = await asked.sought(seen.x, part(progress, n / NARROWINGS, 1, ""), _("local search"));
  }
  throw new NoSolutionError(_("no turn of this family was found that keeps the limits"));
}

/** A turn with its exact figures; these, too, if one of them exceeds a limit. @param {TurnQuestion} asked @param {Seen} seen @param {number} began @returns {Promise<{ best: BestTurn, exact: number[] | null }>} */
async function exactTurn(asked, { x, figures }, began) {
  const { engine, goal } = asked;
  const { objective } = goal;
  let plan = asked.plan.withValues(
    tableOf(x, asked.plan.tables.turn.family, objective === "acceleration"),
  );
  const disc = TurnRoute.disc(plan.tables);
  const { exact, clearance } = await exactFigures(engine, plan, figures, SOUGHT[objective]);
  const exceeds = asked.exceeded(exact);
  let [value, unit] = [exact[SOUGHT[objective]], "m"];
  if (objective === "disc") plan = plan.withValues({ "disc.radius": value });
  const limited = plan.tables.limits.speed !== null;
  const headSpeed = limited ? await greatestHeadSpeed(engine, plan) : null;
  if (objective === "speed") [value, unit] = [headSpeed?.value ?? NaN, "m/s"];
  if (objective === "acceleration") [value, unit] = [value * plan.tables.walk.speed ** 2, "m/s^2"];
  const told = {
    assumptions: [_("best that was found in this family; better ones may exist")],
    evaluations: asked.tried,
    seconds: now() - began,
  };
  const { turn, route } = plan.tables;
  const [made, way] = withArena(engine, (arena) =>
    within(arena, () => {
      const found = turn.build(route.pitch, disc);
      return [found, found.way(plan.tables.disc.radius ?? disc)];
    }),
  );
  const best = {
    plan,
    turn: made,
    objective: answered(value, value, value, unit, told),
    length: made.length,
    way,
    headSpeed,
    clearance,
    active: exceeds
      .filter(([name, over]) => over >= -ACTIVE && name !== objective)
      .map(([name]) => name),
  };
  return { best, exact: exceeds.some(([, over]) => over > EXCEEDED) ? exact : null };
}

/** What was seen made exact, on the safe side, and the least clearance. @param {Engine} engine @param {Plan} plan @param {number[]} seen @param {number} sought */
function exactFigures(engine, plan, seen, sought) {
  const within = Math.max(-1.2 * seen[APART], plan.tables.limits.margin, 0.05); // somewhat farther than was seen
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    const { joints } = walk.route;
    const [first, last] = [joints[1], walk.head_where_tail(joints[joints.length - 2])];
    const exact = [...seen];
    const limits = givenLimits(plan);
    for (const quantity of QUANTITIES.values())
      if (limits.has(quantity.name) || quantity.kind === sought)
        exact[quantity.kind] = (
          await greatestOf(walk, quantity, first, last, { tolerance: RATE })
        ).upper;
    const [start, end] = [walk.time_at(first), walk.time_at(last)];
    const clearance = await leastClearance(walk, start, end, within, [DISTANCE]);
    exact[APART] = -sure(clearance);
    const rooms = [];
    for (const obstacle of plan.obstacles()) {
      rooms.push(obstacle.margin - sure(await leastDistance(walk, obstacle, start, end, [DISTANCE])));
    }
    exact[BESIDE] = rooms.length ? Math.max(...rooms) : NaN;
    return { exact, clearance };
  });
}

/** At most a distance, m; where benches touch, as if they were DEEP in one another. @param {Answer} distance */
function sure({ value, lower }) {
  return value > 0 ? lower : -DEEP;
}
