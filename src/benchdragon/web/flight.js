// Flights of the camera: a calm way from what it shows to what it shall show.

/** @typedef {import("./camera.js").Camera} Camera */
/** What a camera shall show: the middle, m, and CSS pixels a metre. @typedef {{x: number, y: number, scale: number}} View */

/** How long a flight takes, s. */
const FLIGHT = 0.9;

export class Flight {
  /** @param {Camera} camera @param {() => View} goal where it goes, which may move */
  constructor({ x, y, scale }, goal) {
    this.from = { x, y, scale };
    this.goal = goal;
    this.passed = 0;
  }

  /** Move the camera on; whether it has arrived. @param {Camera} camera @param {number} seconds */
  step(camera, seconds) {
    this.passed += seconds;
    const along = Math.min(this.passed / FLIGHT, 1);
    const { x, y, scale } = between(this.from, this.goal(), along * along * (3 - 2 * along));
    camera.x = x;
    camera.y = y;
    camera.scale = scale;
    return along >= 1;
  }

  /** Be there at once. @param {Camera} camera */
  cut(camera) {
    this.passed = FLIGHT;
    this.step(camera, 0);
  }
}

/** A view on the way between two, on which no place of the picture turns round. @param {View} from @param {View} to @param {number} share @returns {View} */
function between(from, to, share) {
  const scale = from.scale * (to.scale / from.scale) ** share;
  const even = Math.abs(Math.log(to.scale / from.scale)) < 0.01;
  const left = even ? 1 - share : (1 / scale - 1 / to.scale) / (1 / from.scale - 1 / to.scale);
  return { x: to.x + left * (from.x - to.x), y: to.y + left * (from.y - to.y), scale };
}
