// What each bench does in plans: node bench_walks.mjs MODULES ENGINE.wasm PLANS.json
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, file, questions] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const [{ Engine }, { withArenaAsync }, { briefed }, { checked }] = await Promise.all(
  ["engine", "compute/arena", "compute/briefing", "compute/plan"].map(load),
);
const [{ Sayings }, { called }, { speak, useWords }] = await Promise.all(
  ["sayings", "made/people", "words"].map(load),
);
const engine = await Engine.load(readFileSync(file));

/** What stands on the sheets of all benches, in a language. */
function sentences(told, spoken) {
  speak(spoken);
  const said = new Sayings(told, new Map());
  const name = (bench) => called(told.people, bench, told.benches.length);
  return told.benches.map((_one, k) => said.text(k + 1, name));
}

const { plans, words } = JSON.parse(readFileSync(questions, "utf-8"));
useWords(words);
const answers = [];
for (const { plan: data, span } of plans) {
  try {
    const plan = checked(data);
    const told = await withArenaAsync(engine, (arena) =>
      briefed(plan, plan.build(arena), span, () => {}),
    );
    answers.push({
      benches: told.benches,
      chalk: told.chalk,
      en: sentences(told, "en"),
      zh: sentences(told, "zh"),
      timetable: told.timetable,
      seconds: told.seconds,
    });
  } catch (error) {
    answers.push({ error: error.message, kind: error.constructor.name });
  }
}
console.log(JSON.stringify(answers));
