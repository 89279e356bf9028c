// What the page says of the texts of plan files: node doors.mjs MODULES ENGINE.wasm TEXTS.json, its answers as JSON.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, , file] = process.argv.slice(2);
const { openedPlan } = await import(pathToFileURL(`${modules}/compute/questions.js`));

function said(text) {
  try {
    return { plan: openedPlan(text) };
  } catch (error) {
    return { error: error.message, kind: error.constructor.name };
  }
}

const answers = JSON.parse(readFileSync(file)).map(said);
console.log(JSON.stringify([...answers, { foreign: {}.foreign ?? null }]));
