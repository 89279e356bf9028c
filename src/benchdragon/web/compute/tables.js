// Benches of a dragon by their kinds, and the room that searches along walks begin with. Twin of
// analysis/tables.py.

import { _ } from "../words.js";
import { doubles, wholes } from "./arena.js";
import { ANALYSIS_TABLES, OWN_ROOM } from "./constants.js";
import { InputError } from "./errors.js";

/** @typedef {import("../engine.js").Numbers} Numbers */
/** @typedef {import("./arena.js").Arena} Arena */
/** @typedef {import("./dragon.js").Dragon} Dragon */
/** @typedef {import("./walk.js").Walk} Walk */
/** @typedef {{ sizes: Numbers, group: Numbers }} Kinds */
/** @typedef {ReturnType<typeof walkTables>} WalkTables */

const { MOST_SIZES } = ANALYSIS_TABLES;

/** Numbers in the order of the columns that they are told for. @param {Array<[number, number]>} told */
export function inColumns(told) {
  return told.sort(([a], [b]) => a - b).map(([, value]) => value);
}

/** The room that searches begin with, as the engine takes it. */
export function beginnings() {
  return inColumns([
    [OWN_ROOM.A_CELL, ANALYSIS_TABLES.A_CELL],
    [OWN_ROOM.AT_FIRST, ANALYSIS_TABLES.AT_FIRST],
    [OWN_ROOM.FIRST_PAIRS, ANALYSIS_TABLES.PAIRS],
    [OWN_ROOM.FIRST_MEMBERS, ANALYSIS_TABLES.MEMBERS],
    [OWN_ROOM.FIRST_DOUBTS, ANALYSIS_TABLES.DOUBTS],
    [OWN_ROOM.MOST_CELLS, ANALYSIS_TABLES.MOST_CELLS],
    [OWN_ROOM.PLACES, ANALYSIS_TABLES.PLACES],
  ]);
}

/**
 * The kind of each bench of a dragon, and the kinds: sizes (4, kinds), and the group of each.
 * @param {Arena} arena
 * @param {Pick<Dragon, "sizes" | "benches">} dragon
 * @returns {{ kind: Numbers, kinds: Kinds }}
 */
export function kindsOf(arena, { sizes, benches }) {
  const most = Math.min(MOST_SIZES, benches);
  const [found, kind] = [arena.array("d", 4, most), arena.array("q", benches)];
  const group = arena.array("q", most);
  const [count] = arena.engine.call("bd_kinds_find_kinds", sizes, found, kind, group);
  if (count > most) throw tooManyKinds(sizes);
  const rows = [0, 1, 2, 3].map((n) => doubles(found).slice(n * most, n * most + count));
  const kinds = { sizes: arena.table(rows, count), group: arena.whole(wholes(group).slice(0, count)) };
  arena.drop(found, group);
  return { kind, kinds };
}

/** That benches of these sizes, (4, benches), are of too many different ones. @param {Numbers} sizes */
export function tooManyKinds({ view, shape: [rows, columns] }) {
  const said = Array.from({ length: columns }, (_column, j) =>
    Array.from({ length: rows }, (_row, i) => view[i * columns + j]).join(),
  );
  const values = { most: MOST_SIZES, count: new Set(said).size };
  return new InputError(
    _("contacts can be searched for at most {most} different sizes, not {count}", values),
  );
}

/**
 * A dragon on its route, as kernels want them.
 * @param {Arena} arena
 * @param {Walk} walk
 */
export function walkTables(arena, { dragon, route }) {
  const { kind, kinds } = kindsOf(arena, dragon);
  const ahead = arena.array("d", dragon.benches);
  let before = 0;
  const view = doubles(ahead);
  dragon.link.forEach((link, n) => {
    view[n] = before;
    before += link;
  });
  const lever = arena.vector([dragon.lever]);
  const benches = { links: dragon.links, sizes: dragon.sizes, kind, ahead, lever };
  return { rows: route.rows, benches, kinds };
}
