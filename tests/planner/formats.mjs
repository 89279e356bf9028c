// Numbers as sentences hold them: node formats.mjs MODULES ENGINE.wasm NUMBERS.json
import { readFileSync } from "node:fs";
import { ulp } from "../../src/benchdragon/web/compute/exact.js";
import { decimals, general, powered } from "../../src/benchdragon/web/compute/number_format.js";

const numbers = JSON.parse(readFileSync(process.argv[4], "utf8"));
const said = numbers.map((text) => {
  const value = Number(text);
  const step = String(ulp(value));
  return [
    decimals(value),
    decimals(value, 1),
    general(value),
    general(value, 17),
    powered(value, 1),
    step,
  ];
});
console.log(JSON.stringify(said));
