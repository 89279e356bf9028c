// What plans may be: node solve_plans.mjs MODULES ENGINE.wasm QUESTIONS.json, its answers as JSON. With
// "cancel" each is given up where its progress is first told; "rounds" tells how often each is asked; "most"
// of a question is what it may take.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, file, questions] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const { Engine } = await load("engine");
const { withArenaAsync } = await load("compute/arena");
const { speak, useWords } = await load("words");
const { checked } = await load("compute/plan");
const { BenchDragonError } = await load("compute/errors");
const size = await load("made/size");
const head = await load("made/head_speed");
const turning = await load("made/best_turn");
const { TurnGoal } = await load("made/turn_goal");
const { tolerance } = await load("compute/long_questions");
const { ALL } = await load("made/tolerance");
const { MOST_HELD } = await load("compute/worker");
const { QUESTIONS } = await load("compute/questions");
const { left, question } = await load("compute/budget");
let engine = await Engine.load(readFileSync(file));
const {
  asked,
  words,
  language,
  rounds = 1,
  cancel = false,
} = JSON.parse(readFileSync(questions, "utf-8"));
useWords(words ?? {});
speak(language ?? "en");

class Cancelled extends Error {}

function progress() {
  if (cancel) throw new Cancelled("given up");
}

const ASKED = {
  limit: (plan, { size: name, margin, tolerance: width }) =>
    withArenaAsync(engine, () => size.foundLimit(plan, name, margin, width, progress)),
  speed: (plan, { tolerance }) =>
    withArenaAsync(engine, () => head.greatestHeadSpeed(plan, tolerance, progress)),
  pace: paced,
  turn: turned,
  margins: drawn,
  page: (plan, { question: name, wishes }) =>
    QUESTIONS[name]({ engine, version: "1", plan, wishes, progress }),
};

/** A pace, and the plan walked at it. */
async function paced(plan) {
  const pace = await withArenaAsync(engine, () => head.slowed(plan, progress));
  return { ...pace, sha256: head.withPace(plan, pace).sha256 };
}

/** The best turn, in plain data. */
async function turned(plan, goal) {
  const { objective, least_radius, longest, longest_way } = goal;
  const {
    plan: found,
    turn,
    ...rest
  } = await withArenaAsync(engine, () =>
    turning.bestTurn(plan, new TurnGoal(objective, least_radius, longest, longest_way), progress),
  );
  return { ...rest, turn: found.turn, pieces: turn.pieces, sha256: found.sha256 };
}

/** What random dances need, in plain data. */
async function drawn(plan, { by = ALL, draws, seed = 1 }) {
  return withArenaAsync(engine, () => tolerance(plan, by, draws, seed, progress));
}

/** An answer, or why there is none. */
async function answered({ data, name, options }) {
  try {
    return await ASKED[name](checked(data), options ?? {});
  } catch (error) {
    if (!(error instanceof BenchDragonError || error instanceof Cancelled)) throw error;
    return { error: error.message, kind: error.constructor.name };
  }
}

/** The same where a question may take so much, and what it took. */
function limited(one) {
  const ask = async () => ({ found: await answered(one), spent: one.most.work - left() });
  return question(ask, 1, one.most);
}

/** What JSON knows no word for, as Python reads it. */
function plain(_key, value) {
  return typeof value === "number" && !Number.isFinite(value) ? String(value) : value;
}

const said = [];
for (const one of asked) {
  let [found, spent] = [null, null];
  const [bytes, milliseconds] = [[], []];
  for (let round = 0; round < rounds; round++) {
    const began = performance.now();
    if (one.most) ({ found, spent } = await limited(one));
    else found = await answered(one);
    milliseconds.push(performance.now() - began);
    bytes.push(engine.exports.memory.buffer.byteLength);
  }
  const [held] = engine.call("bd_memory_held"); // by questions that are not closed
  if (engine.held > MOST_HELD) engine = await Engine.load(readFileSync(file)); // as the Worker does
  said.push({ found, spent, held, bytes, milliseconds });
}
console.log(JSON.stringify(said, plain));
