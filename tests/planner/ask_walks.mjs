// Answers questions about walks that are given as numbers: node ask_walks.mjs MODULES ENGINE.wasm QUESTIONS.json
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [modules, wasm, file] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(`${modules}/${name}.js`));
const { Engine } = await load("engine");
const { withArena, withArenaAsync, within } = await load("compute/arena");
const { CURVE } = await load("compute/constants");
const { contactWindows, firstSureContact, leastClearance } = await load("made/contact");
const { Dragon } = await load("compute/dragon");
const { BenchDragonError } = await load("compute/errors");
const { HeadTimes } = await load("made/head_times");
const { Obstacle } = await load("made/obstacle");
const { obstacleAnswers } = await load("made/obstacles");
const { QUANTITIES, greatest } = await load("made/speed");
const { SpeedProfile } = await load("made/profile");
const { Curve } = await load("compute/curve");
const { py } = await load("compute/python");
const { Walk } = await load("compute/walk");

const engine = await Engine.load(readFileSync(wasm));

/** A route by its rows, kinks and all. */
class Rows extends Curve {
  constructor(rows) {
    super();
    py.keep(this, "rows", rows);
  }
  seen_from(origin) {
    const rows = py.copy(this.rows);
    py.entry("bd_route_parts_settle_rows", rows, ...origin);
    return new Rows(rows);
  }
}

function routeOf(arena, rows) {
  return within(arena, () => new Rows(arena.table(rows, CURVE.COLUMNS)));
}

function walkOf(arena, { sizes, rows, times, speeds, start }) {
  const [length, width, front_inset, rear_inset] = sizes.map((column) => Float64Array.from(column));
  const dragon = new Dragon(arena, { length, width, front_inset, rear_inset });
  return new Walk(dragon, routeOf(arena, rows), new SpeedProfile(times, speeds), start);
}

const ASKED = {
  windows: (walk, start, end, { margin, most }) => contactWindows(walk, start, end, margin, most),
  contact: (walk, start, end, { margin }) => firstSureContact(walk, start, end, margin),
  clearance: (walk, start, end, { within, tolerances }) =>
    leastClearance(walk, start, end, within, tolerances),
  greatest: (walk, start, end, { quantity, tolerance, limit }) =>
    greatest(walk, QUANTITIES.get(quantity), start, end, tolerance, limit),
  obstacle: async (walk, start, end, { name, kind, outline, radius, margin }) => {
    const obstacle = new Obstacle(name, kind, outline, radius, margin);
    const { contact, distance, touch } = await obstacleAnswers(walk, obstacle, start, end);
    return { contact, distance, touch };
  },
  times: (walk, start, _end, { at }) => {
    const times = new HeadTimes(walk, walk.headPosition(start), start);
    return withArena(engine, (arena) => within(arena, () => at.map((s) => times.bracketed(s, s))));
  },
};

/** What JSON knows no word for, as Python reads it. */
function plain(_key, value) {
  return typeof value === "number" && !Number.isFinite(value) ? String(value) : value;
}

const said = [];
for (const { walk, name, start, end, options } of JSON.parse(readFileSync(file, "utf8"))) {
  let found;
  try {
    found = {
      found: await withArenaAsync(engine, (arena) =>
        ASKED[name](walkOf(arena, walk), start, end, options ?? {}),
      ),
    };
  } catch (error) {
    if (!(error instanceof BenchDragonError)) throw error;
    found = { error: error.constructor.name, text: error.message };
  }
  said.push(found);
}
console.log(JSON.stringify(said, plain));
