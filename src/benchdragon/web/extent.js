// How much ground a dance takes: what a camera is fitted to.

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./square.js").Square} Square */

/** Times spread over the whole dance. @param {Scene} scene */
export function spread({ start, end }) {
  return Array.from({ length: 9 }, (_unused, n) => start + (n / 8) * (end - start));
}

/**
 * Ground that the dragon takes at some times, the disc and the square: left, bottom, right, top, m.
 * @param {Scene} scene
 * @param {ReturnType<Scene["room"]>} stand scratch
 * @param {Square} square
 * @param {number[]} times
 * @param {number} room about all that, m
 * @returns {[number, number, number, number]}
 */
export function extent(scene, stand, square, times, room) {
  const { disc, centre } = scene.sent;
  /** @type {number[]} */
  const across = [];
  /** @type {number[]} */
  const up = [];
  for (const time of times) {
    const { x, y } = scene.stand(time, stand);
    across.push(Math.min(...x), Math.max(...x));
    up.push(Math.min(...y), Math.max(...y));
  }
  if (disc !== null) {
    across.push(centre[0] - disc, centre[0] + disc);
    up.push(centre[1] - disc, centre[1] + disc);
  }
  for (const [x, y] of square.corners()) {
    across.push(x);
    up.push(y);
  }
  return [
    Math.min(...across) - room,
    Math.min(...up) - room,
    Math.max(...across) + room,
    Math.max(...up) + room,
  ];
}
