// Numbers as sentences hold them: node formats.mjs MODULES ENGINE.wasm NUMBERS.json
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, , file] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const { ulp } = await load("compute/numbers");
const { decimals, figures, general, powered } = await load("compute/number_format");
const { known } = await load("made/number_format");

const numbers = JSON.parse(readFileSync(file, "utf8"));
const said = numbers.map((text) => {
  const value = Number(text);
  const step = String(ulp(value));
  return [
    decimals(value),
    decimals(value, 1),
    general(value),
    general(value, 17),
    powered(value, 1),
    figures(value, true),
    figures(value, false),
    known(value, value + 7e-4, "m/s", true, 1.25),
    known(value, value, "m", false, value + 1e-4),
    step,
  ];
});
console.log(JSON.stringify(said));
