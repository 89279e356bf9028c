// What is drawn of plans before their dances are computed: node sketches.mjs MODULES ENGINE.wasm PLANS.json,
// its lines as JSON.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, , plans] = process.argv.slice(2);
const { sketchOf } = await import(pathToFileURL(`${modules}/sketch.js`));
const said = JSON.parse(readFileSync(plans, "utf-8")).map(sketchOf);
process.stdout.write(JSON.stringify(said));
