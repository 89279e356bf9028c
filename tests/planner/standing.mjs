// A question that is asked again and again while a plan changes, in time that passes here as it is told to.
// Arguments: the folder of the page's modules; ms to an answer; edits as [ms, name of a plan].

import { pathToFileURL } from "node:url";

const [web, long, edits] = process.argv.slice(2);

let now = 0;
let waiting = [];
performance.now = () => now;
globalThis.setTimeout = (act, delay) => {
  const timer = { act, at: now + delay };
  waiting.push(timer);
  return timer;
};
globalThis.clearTimeout = (timer) => {
  waiting = waiting.filter((one) => one !== timer);
};

/** Let time pass until nothing waits any more. */
async function pass() {
  for (;;) {
    for (let n = 0; n < 20; n++) await null; // what promises bring about comes first
    if (!waiting.length) return;
    const next = waiting.reduce((one, other) => (other.at < one.at ? other : one));
    clearTimeout(next);
    now = next.at;
    next.act();
  }
}

const { Standing } = await import(pathToFileURL(`${web}/standing.js`));
const plans = {};
const said = [];
let given = 0;
const ask = (_plan, signal) =>
  new Promise((done, failed) => {
    const timer = setTimeout(done, Number(long));
    signal.addEventListener("abort", () => {
      clearTimeout(timer);
      given++;
      failed(new DOMException("", "AbortError"));
    });
  });
const standing = new Standing(
  ask,
  (_answer, plan) => said.push([plan.name, now]),
  (error) => said.push(String(error)),
);
for (const [at, name] of JSON.parse(edits))
  setTimeout(() => standing.renew((plans[name] ??= { name })), at);
await pass();
console.log(JSON.stringify({ said, given }));
