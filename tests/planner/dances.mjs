// The dances of plans: node dances.mjs MODULES ENGINE.wasm QUESTIONS.json; each with how long it took, ms.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, file, questions] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const [{ Engine }, { checked }, { danceOf, SKETCH }, { Scene, unpackedScene }, { Table }] =
  await Promise.all(["engine", "compute/plan", "compute/scene", "scene", "following"].map(load));
const [{ withArenaAsync }, { check }, { judgedDance }, { verdictOf }] = await Promise.all(
  ["compute/arena", "compute/check", "compute/questions", "made/records"].map(load),
);
const engine = await Engine.load(readFileSync(file));
const { memory } = engine.exports;

/** The dance with what a check of its plan found. */
function judged(plan, dance) {
  return withArenaAsync(engine, async (arena) => {
    const walk = plan.build(arena);
    const report = await check(plan, walk, plan.span(walk));
    return judgedDance(dance, verdictOf(report), plan.obstacles());
  });
}

async function danced({ plan: data, shown = SKETCH, rounds = 1, at, judge }) {
  let least = Infinity;
  for (let round = 0; ; round++) {
    const begun = performance.now();
    const plan = checked(data);
    const dance = await danceOf(engine, plan, shown);
    const { sent, nodes, framed, tables } = judge ? await judged(plan, dance) : dance;
    least = Math.min(least, performance.now() - begun);
    if (round + 1 < rounds) continue;
    const readers = tables.map((table, i) => new Table(sent.following.tables[i], table));
    const scene = new Scene(sent, nodes, framed, readers);
    const stand = scene.stand(at ?? sent.frames.start, scene.room());
    const lists = {
      nodes,
      places: scene.places,
      speeds: scene.speeds,
      s: stand.s,
      x: stand.x,
      v: stand.v,
    };
    const plain = Object.entries(lists).map(([name, list]) => [name, Array.from(list)]);
    const followed = tables.map((table) => Array.from(table));
    return { sent, followed, ...Object.fromEntries(plain), least, memory: memory.buffer.byteLength };
  }
}

/** The frames of a dance that Python sent. */
async function unpacked(sent) {
  const { places, speeds } = await unpackedScene(sent);
  return { places: Array.from(places), speeds: Array.from(speeds) };
}

const answers = [];
for (const question of JSON.parse(readFileSync(questions, "utf-8"))) {
  try {
    answers.push(await (question.sent ? unpacked(question.sent) : danced(question)));
  } catch (error) {
    answers.push({ error: error.message, kind: error.constructor.name });
  }
}
console.log(JSON.stringify(answers));
