// Of analysis/crowd.py and analysis/running.py what looks at all benches at a time.

import { nearestBoxes } from "../made/obstacle_distance.js";
import { doubles, withArena, within } from "./arena.js";
import { boxes } from "./distance.js";

/** @typedef {import("./walk.js").Walk} Walk */

/** How far the nearest bench is from an entrance at a time, s, in m; not more than 0 within it. @param {Walk} walk @param {number} time @param {import("./obstacle.js").Obstacle} shape @returns {number} */
export function awayAt(walk, time, shape) {
  return withArena(walk.engine, (arena) => {
    const table = boxes(arena, walk.motion(arena, [time]));
    const [away] = within(arena, () => nearestBoxes(table, shape));
    return doubles(away).reduce((least, one) => Math.min(least, one)) - shape.radius;
  });
}

/** Where handles are at a time, s, that go at a speed, m/s, or faster: x, y, m, and the speed. @param {Walk} walk @param {number} time @param {number} runFrom @returns {Array<[number, number, number]>} */
export function runners(walk, time, runFrom) {
  return withArena(walk.engine, (arena) => {
    const motion = walk.motion(arena, [time]);
    const [x, y, speed] = [doubles(motion.x), doubles(motion.y), motion.speed];
    /** @type {Array<[number, number, number]>} */
    const found = [];
    speed.forEach((one, i) => {
      if (one >= runFrom) found.push([x[i], y[i], one]);
    });
    return found;
  });
}
