// Replays a recording in Node, see recording.py: node replay_node.mjs ENGINE.js ENGINE.wasm FOLDER ROUNDS.
// Of several rounds the fastest counts: the first ones run before the module is compiled to the end.
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

import { replay } from "./replay.js";

const [loader, file, folder, rounds] = process.argv.slice(2);
const { Engine } = await import(pathToFileURL(loader));
const engine = await Engine.load(readFileSync(file));
const calls = JSON.parse(readFileSync(`${folder}/calls.json`, "utf-8"));
const before = readFileSync(`${folder}/before.bin`);
const least = {};
for (let round = 0; round < Number(rounds); round++) {
  const memory = new Uint8Array(before).buffer;
  for (const [entry, seconds] of Object.entries(replay(engine, calls, memory)))
    least[entry] = Math.min(least[entry] ?? Infinity, seconds);
  writeFileSync(`${folder}/replayed.bin`, new Uint8Array(memory));
}
console.log(JSON.stringify(least));
