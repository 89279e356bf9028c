// Checks plans: node check_plans.mjs MODULES ENGINE.wasm QUESTIONS.json, verdicts as JSON. With "cancel"
// each is given up where its progress is first told.
import { readFileSync } from "node:fs";
import { Engine } from "../../src/benchdragon/web/engine.js";
import { withArenaAsync } from "../../src/benchdragon/web/compute/arena.js";
import { check } from "../../src/benchdragon/web/compute/check.js";
import { BenchDragonError } from "../../src/benchdragon/web/compute/errors.js";
import { checkedPlan } from "../../src/benchdragon/web/compute/plan.js";
import { verdictOf } from "../../src/benchdragon/web/compute/records.js";
import { useWords } from "../../src/benchdragon/web/words.js";

const [wasm, file] = process.argv.slice(3);
const engine = await Engine.load(readFileSync(wasm));
const { plans, words, quick, version, rounds, cancel } = JSON.parse(readFileSync(file, "utf8"));
useWords(words);

class Cancelled extends Error {}

function progress() {
  if (cancel) throw new Cancelled("given up");
}

/** The verdict on a plan in plain data, or why there is none. */
async function judged(data) {
  try {
    const plan = checkedPlan(data);
    return await withArenaAsync(engine, async (arena) => {
      const walk = plan.build(arena);
      const report = await check(plan, walk, plan.span(walk), { quick, progress });
      return { verdict: verdictOf(report, version) };
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
    const began = performance.now();
    found = await judged(data);
    milliseconds.push(performance.now() - began);
    bytes.push(engine.exports.memory.buffer.byteLength);
  }
  said.push({ found, bytes, milliseconds });
}
console.log(JSON.stringify(said));
