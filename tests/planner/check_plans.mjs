// Checks plans: node check_plans.mjs ENGINE.wasm QUESTIONS.json
import { readFileSync } from "node:fs";
import { Engine } from "../../src/benchdragon/web/engine.js";
import { withArenaAsync } from "../../src/benchdragon/web/compute/arena.js";
import { check } from "../../src/benchdragon/web/compute/check.js";
import { BenchDragonError } from "../../src/benchdragon/web/compute/errors.js";
import { checkedPlan } from "../../src/benchdragon/web/compute/plan.js";
import { verdictOf } from "../../src/benchdragon/web/compute/records.js";
import { useWords } from "../../src/benchdragon/web/words.js";

const [, , wasm, file] = process.argv;
const engine = await Engine.load(readFileSync(wasm));
const { plans, words, quick, version } = JSON.parse(readFileSync(file, "utf8"));
useWords(words);

/** The verdict on a plan in plain data, or why there is none. */
async function judged(data) {
  try {
    const plan = checkedPlan(data);
    return await withArenaAsync(engine, async (arena) => {
      const walk = plan.build(arena);
      return { verdict: verdictOf(await check(plan, walk, plan.span(walk), { quick }), version) };
    });
  } catch (error) {
    if (!(error instanceof BenchDragonError)) throw error;
    return { error: error.constructor.name, text: error.message };
  }
}

const said = [];
for (const { data, rounds } of plans) {
  let found;
  let milliseconds = Infinity;
  for (let round = 0; round < rounds; round++) {
    const began = performance.now();
    found = await judged(data);
    milliseconds = Math.min(milliseconds, performance.now() - began);
  }
  said.push({ ...found, milliseconds, bytes: engine.exports.memory.buffer.byteLength });
}
console.log(JSON.stringify(said));
