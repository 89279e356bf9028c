// Checks plans: node check_plans.mjs MODULES ENGINE.wasm QUESTIONS.json, verdicts as JSON. With "cancel"
// each is given up where its progress is told for that time.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, wasm, file] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const { Engine } = await load("engine");
const { withArenaAsync } = await load("compute/arena");
const { check } = await load("compute/check");
const { BenchDragonError } = await load("compute/errors");
const { checked } = await load("compute/plan");
const { verdictOf } = await load("made/records");
const { useWords } = await load("words");

const engine = await Engine.load(readFileSync(wasm));
const { plans, words, rounds, cancel } = JSON.parse(readFileSync(file, "utf8"));
useWords(words);

class Cancelled extends Error {}

let told = 0;

function progress() {
  if (++told === cancel) throw new Cancelled("given up");
}

/** The verdict on a plan in plain data, or why there is none. */
async function judged(data) {
  try {
    const plan = checked(data);
    return await withArenaAsync(engine, async (arena) => {
      const walk = plan.build(arena);
      const report = await check(plan, walk, plan.span(walk), { progress });
      return { verdict: verdictOf(report) };
    });
  } catch (error) {
    if (!(error instanceof BenchDragonError || error instanceof Cancelled)) throw error;
    return { kind: error.constructor.name, error: error.message };
  }
}

const said = [];
for (const data of plans) {
  let found;
  const [bytes, milliseconds] = [[], []];
  for (let round = 0; round < rounds; round++) {
    const before = process.cpuUsage();
    told = 0;
    found = await judged(data);
    const { user, system } = process.cpuUsage(before);
    milliseconds.push((user + system) / 1000);
    bytes.push(engine.exports.memory.buffer.byteLength);
  }
  said.push({ found, bytes, milliseconds, told });
}
console.log(JSON.stringify(said));
