// People are not exact: how likely benches touch when handles stray, pins have play, benches vary. What
// solve/tolerance.py asks of the engine, asked by the page.

import { finiteOrNone } from "../made/number_format.js";
import { refuse } from "../made/random_dance.js";
import { part } from "../made/stages.js";
import { _ } from "../words.js";
import { withArena } from "./arena.js";
import { memory, question } from "./budget.js";
import { DANCE_MEMORY, QUESTION, SOLVE_TOLERANCE } from "./constants.js";
import { OwnQuestion } from "./engine_question.js";
import { InputError, UnsureError, WalkError } from "./errors.js";
import { builtDragon } from "./plan.js";
import { limit } from "./size.js";
import { PlanFamily, QUESTIONS, kernelFamily } from "./size_family.js";

/** @typedef {import("../engine.js").Engine} Engine */
/** @typedef {import("./plan.js").Plan} Plan */
/** How far from exact dances are, as in kernels/random_numbers.py, and the seed of them. @typedef {{ by?: number[], seed?: number }} Drawn */

const { NEEDED, TOUCHES } = DANCE_MEMORY;
const { ALL, CONFIDENCE, RISKS } = SOLVE_TOLERANCE;
/** How many random dances are walked. */
const DRAWS = 100;

/** What is answered about a dance of that number: its pitch, m, or if it touches. @param {Engine} engine @param {Plan} plan @param {number} guess m; NaN: if it touches @param {number} number @param {Drawn} drawn @param {() => void} tell */
async function answered(engine, plan, guess, number, { by = ALL, seed = 1 }, tell) {
  /** @type {ConstructorParameters<typeof OwnQuestion>[2]} */
  const opened = (arena, open) => {
    const [what, sought] = guess > 0 ? [NEEDED, QUESTIONS.pitch] : [TOUCHES, QUESTIONS.width];
    const walk = plan.build(arena);
    const [first, last] = plan.span(walk).map((time) => walk.headPosition(time));
    const made = kernelFamily(arena, new PlanFamily(engine, plan, sought, 0), walk);
    const limits = [what, plan.tables.limits.margin, first, last, guess, seed, number, memory(), ...by];
    return open(made.family, made.walk, arena.vector(limits));
  };
  const asked = new OwnQuestion(engine, "bd_dance_question_*_dance", opened, [[DANCE_MEMORY.FIGURES]]);
  try {
    let ending = QUESTION.MORE;
    while (ending === QUESTION.MORE) {
      tell();
      ending = await asked.step();
    }
    refuse(ending, guess, number + 1);
    return asked.numbers(0)[DANCE_MEMORY.RESULT];
  } finally {
    asked.free();
  }
}

/** That a dance touches whose exact dragon cannot stand at the start. @param {unknown} error */
function falls(error) {
  if (error instanceof WalkError) return 1;
  throw error;
}

/** @param {Engine} engine @param {Plan} plan @param {() => void} progress */
async function exactPitch(engine, plan, progress) {
  const { route, disc, walk, dragon } = plan.tables;
  if (route.kind === "spiral-in" && disc.radius === null && walk.end === null)
    throw new InputError(_("say how far in the head comes: set disc.radius=4.5, for example"));
  if (withArena(engine, (arena) => builtDragon(arena, dragon).benches) < 3)
    throw new InputError(_("no benches of this dragon can touch: no two are non-adjacent"));
  const found = await limit(engine, plan.withoutSquare(), "pitch", { progress });
  if (found.status === "found" || found.status === "unlimited") return found.value;
  throw new UnsureError(_("no pitch was found with which this dragon is free of contact"));
}

/** What random dances need: see `Tolerance` of solve/tolerance.py. @param {Engine} engine @param {Plan} plan @param {Drawn & { draws?: number, progress: (share: number, text: string) => void }} options */
export async function tolerance(engine, plan, { draws = DRAWS, progress, ...drawn }) {
  const exact = await exactPitch(engine, plan, () => progress(0, ""));
  const [walked, needed] = [plan.withValues({ "route.pitch": exact }), new Float64Array(draws)];
  let hits = 0;
  for (let number = 0; number < draws; number++) {
    const tell = () => progress(number / draws, "");
    needed[number] = await question(() => answered(engine, walked, exact, number, drawn, tell));
    hits += await question(() => answered(engine, plan, NaN, number, drawn, tell)).catch(falls);
  }
  progress(1, "");
  return { exact, needed: needed.sort(), hits };
}

/** How much room imprecise people need, with all deviations together. @param {import("./questions.js").Asked} asked @returns {Promise<import("../messages").MarginsFound>} */
export async function margins({ engine, plan, progress }) {
  const told = part(progress, 0, 1, _("random dances"));
  const { exact, needed, hits } = await tolerance(engine, plan, { progress: told });
  const [lower, upper] = engine.call("bd_binomial_chance_bounds", hits, DRAWS, CONFIDENCE);
  return {
    draws: DRAWS,
    exact: finiteOrNone(exact),
    pitch: plan.value("route.pitch"),
    chance: hits / DRAWS,
    chance_lower: lower,
    chance_upper: upper,
    pitch_for: RISKS.map((risk) => {
      const [allowed] = engine.call("bd_binomial_ranks", DRAWS, risk, CONFIDENCE);
      return { risk, pitch: allowed < 0 ? null : needed[DRAWS - 1 - allowed] };
    }),
  };
}
