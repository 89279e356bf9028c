// What the permit annex tells of plans: node annex.mjs MODULES ENGINE.wasm PLANS.json
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, file, questions] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const [{ Engine }, { annex }, { checked }, { useWords }] = await Promise.all(
  ["engine", "compute/annex", "compute/plan", "words"].map(load),
);
const engine = await Engine.load(readFileSync(file));
const { plans, words } = JSON.parse(readFileSync(questions, "utf-8"));
useWords(words);
const answers = [];
for (const data of plans) {
  try {
    const shares = [];
    const progress = (share) => shares.push(share);
    const found = await annex({ engine, version: "1", plan: checked(data), progress });
    answers.push({ ...found, shares });
  } catch (error) {
    answers.push({ error: error.message });
  }
}
console.log(JSON.stringify(answers));
