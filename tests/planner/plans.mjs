// What compute/plan.js makes of plans: node plans.mjs MODULES ENGINE.wasm PLANS.json, its answers as JSON.
// Of each plan its hash, its data, its span, its route's rows, its places at some positions of the head.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, file, questions] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const [{ Engine }, { withArena, within, doubles }, { checked }] = await Promise.all([
  load("engine"),
  load("compute/arena"),
  load("compute/plan"),
]);
const engine = await Engine.load(readFileSync(file));

function tried(make) {
  try {
    return make();
  } catch (error) {
    return { error: error.message, kind: error.constructor.name };
  }
}

/** Boxes one after another as rows of 6. */
function rowsOf(flat) {
  return Array.from({ length: flat.length / 6 }, (_row, n) => flat.slice(6 * n, 6 * n + 6));
}

function walked(arena, plan) {
  const walk = plan.build(arena);
  const { rows, length } = walk.route;
  const found = { rows: Array.from(doubles(rows)), start: walk.start, length };
  const places = tried(() => {
    const head = walk.start + 0.3 * (length - walk.start);
    const placed = walk.placement(arena, [walk.start, head]);
    const tables = [placed.s, placed.x, placed.y, placed.ratio];
    return tables.map((table) => Array.from(doubles(table)));
  });
  const boxes = within(arena, () =>
    plan.obstacles().map((one) => rowsOf(Array.from(doubles(one.boxes)))),
  );
  const { times, speeds } = walk.profile;
  const moments = tried(() =>
    plan.moments().map(({ time, way, until }) => [time, way, until].map(String)),
  );
  const span = tried(() => plan.span(walk));
  return {
    ...found,
    places,
    span,
    boxes,
    times,
    speeds,
    moments,
    ways: tried(() => plan.ways().map(String)),
  };
}

const answers = JSON.parse(readFileSync(questions, "utf-8")).map((data) =>
  tried(() => {
    const plan = checked(data);
    const said = { sha256: plan.sha256, data: plan.data(), written: plan.own() };
    return { ...said, walk: tried(() => withArena(engine, (arena) => walked(arena, plan))) };
  }),
);
console.log(JSON.stringify(answers));
