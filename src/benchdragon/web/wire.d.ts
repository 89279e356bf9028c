// Made from benchdragon.wire by tools/make_types.py; to make it again: make types

/**
 * The route as cubics between nodes.
 *
 * `packed` holds x, y (m, from `origin`) and heading (rad) of every node as float32, x of all nodes
 * first; see `frames.packed_bytes`.
 */
export interface Course {
  stretches: Array<Stretch>;
  origin: [number, number];
  packed: string;
}

/** A whole dance, as a player shows it. */
export interface Dance {
  version: string;
  plan_sha256: string;
  title: Texts;
  benches: Sizes;
  disc: number | null;
  centre: [number, number];
  course: Course;
  frames: Frames;
  occasions: Array<Occasion>;
  nearest: Nearest;
  tightness: Tightness;
  margin: number;
  speed_limit: number | null;
  ruling: Ruling | null;
}

/**
 * Route positions and speeds of all handles at evenly spaced times, packed.
 *
 * Handle by handle; see `frames.packed_frames`. Between them both are interpolated by cubics, and no
 * handle is then farther than `largest_error` (m) from its place, as looked at between frames.
 */
export interface Frames {
  start: number;
  step: number;
  count: number;
  quantum: number;
  packed: string;
  largest_error: number;
}

/**
 * When each bench comes nearest to one that is not its neighbour, as far as looked at.
 *
 * Distance, m (minus the depth of an overlap), time, s, and number of the other bench; 0 where it
 * never comes within `reach`.
 */
export interface Nearest {
  reach: number;
  distance: Array<number>;
  time: Array<number>;
  other: Array<number>;
}

/** Something that happens at a time; `benches` are numbers from 1. */
export interface Occasion {
  kind: "contact" | "tightest" | "fastest" | "joint" | "end";
  time: number;
  text: Texts;
  benches: Array<number>;
}

/** Whether a walk is safe, in one sentence; `decided` is false where that is open. */
export interface Ruling {
  safe: boolean;
  decided: boolean;
  text: Texts;
}

/** Sizes of every bench, m, bench 1 first. */
export interface Sizes {
  length: Array<number>;
  width: Array<number>;
  front_inset: Array<number>;
  rear_inset: Array<number>;
}

/** Nodes of a stretch of the route, evenly spaced: the next stretch begins where this ends. */
export interface Stretch {
  start: number;
  step: number;
  nodes: number;
}

/** A sentence in both languages. */
export interface Texts {
  en: string;
  zh: string;
}

/** Distance of the tightest pair, m, at evenly spaced times; capped at `Nearest.reach`. */
export interface Tightness {
  start: number;
  step: number;
  distance: Array<number>;
}

/** Something sent to a page; nothing else may stand in it. */
export interface Wire {
}
