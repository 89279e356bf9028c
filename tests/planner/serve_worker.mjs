// A Worker's life: node serve_worker.mjs MODULES ENGINE.wasm PLANS.json, what came of it as JSON. Of the plans
// one is small, and the length of benches of the other takes more memory to find than a question may.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, wasm, file] = process.argv.slice(2);
const { MOST_HELD, serve } = await import(pathToFileURL(`${modules}/compute/worker.js`));
const { small, large: huge } = JSON.parse(readFileSync(file, "utf8"));

const PAGE = 65_536;
const engines = [];
let empty = false;
let calls = 0;
let called = () => {};
const instantiate = WebAssembly.instantiate;
WebAssembly.instantiate = async (module) => {
  const { exports } = await instantiate(module);
  const malloc = (bytes) => (empty ? 0 : exports.malloc(bytes));
  engines.push({ exports, calls: 0 });
  const mine = engines.at(-1);
  const counted = Object.entries(exports).map(([name, value]) => [
    name,
    typeof value === "function"
      ? (...values) => (mine.calls++, calls++, called(), value(...values))
      : value,
  ]);
  return { exports: { ...Object.fromEntries(counted), malloc } };
};

const engine = await WebAssembly.compile(readFileSync(wasm));
const rest = () => new Promise((resolve) => setTimeout(resolve, 500));

/** A Worker that is ready: what it says, and how it is asked. */
async function begun() {
  const heard = [];
  const waiting = [];
  const port = {
    postMessage: (said) => {
      if ("progress" in said) return;
      heard.push(said.id ?? null);
      waiting.shift()?.(said);
    },
  };
  const next = () => new Promise((resolve) => waiting.push(resolve));
  const ready = next();
  serve(port);
  port.onmessage({ data: { engine, words: {}, version: "1" } });
  await ready;
  let id = 0;
  const ask = (question = "verdict", plan = small) => {
    const said = next();
    port.onmessage({ data: { id: ++id, question, language: "en", plan } });
    return said;
  };
  /** Ask, and give up after so many calls of kernels; how many there were until the next was answered, which takes `next` calls. */
  const giveUp = async (question, plan, after, next) => {
    const before = calls;
    const asked = ++id;
    called = () => {
      if (calls - before < after) return;
      called = () => {};
      port.onmessage({ data: { cancel: asked } });
    };
    port.onmessage({ data: { id: asked, question, language: "en", plan } });
    await ask();
    return calls - before - next;
  };
  return { heard, ask, giveUp };
}

await begun();
await rest();
const warmed = engines.pop().calls;
const { heard, ask, giveUp } = await begun();
const asked = await ask(); // while it warms up
engines[0].exports.memory.grow(Math.ceil(MOST_HELD / PAGE));
const large = await ask();
await rest();
const after = engines.length;
empty = true;
const without = await ask();
empty = false;
const again = await ask();
const over = await ask("limit/length", huge);
const last = await ask();
const counted = async (question) => {
  const started = calls;
  await ask(question);
  return calls - started;
};
const dance = await counted("dance");
const given = await giveUp("dance", small, 0.2 * dance, await counted("verdict"));
process.stdout.write(
  JSON.stringify({ warmed, asked, large, after, without, again, over, last, heard, dance, given }),
);
process.exit();
