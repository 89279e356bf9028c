// What the page reads of numbers that people type: node typed.mjs MODULES ENGINE.wasm TEXTS.json, as JSON.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, , file] = process.argv.slice(2);
const { typedNumber } = await import(pathToFileURL(`${modules}/typed.js`));
console.log(
  JSON.stringify(JSON.parse(readFileSync(file)).map(([text, unit]) => typedNumber(text, unit))),
);
