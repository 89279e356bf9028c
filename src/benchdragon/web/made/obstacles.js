// @ts-nocheck
// Made from analysis/obstacles.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { shown } from "./answer.js";
import { TOLERANCES } from "./contact_search.js";
import { ObstacleSearch } from "./obstacle_search.js";

const askedOf = (of, start, end, walk = of) => [walk, start, end];
export async function touching(walk, obstacle, start, end) {
  let search;
  search = new ObstacleSearch(walk, obstacle, start, end);
  try {
    return (await search.touches());
  } finally {
    search.free();
  }
}
export async function leastDistance(walk, obstacle, start = /** @type {any} */ (null), end = /** @type {any} */ (null), tolerances = TOLERANCES) {
  return py.scoped(async () => {
    let search;
    [walk, start, end] = py.list(askedOf(walk, start, end));
    search = new ObstacleSearch(walk, obstacle, start, end);
    try {
      return (await search.least_distance(tolerances));
    } finally {
      search.free();
    }
  });
}
export class ObstacleAnswers {
  constructor(obstacle, contact, distance, touch = /** @type {any} */ (null)) {
    this.obstacle = obstacle;
    this.contact = contact;
    this.distance = distance;
    this.touch = touch;
  }
  get distance_text() {
    return shown(this.distance, false, this.obstacle.margin);
  }
}
export async function obstacleAnswers(walk, obstacle, start, end, tolerances = TOLERANCES) {
  return py.scoped(async () => {
    let answers, bare, contact, distance, near;
    distance = (await leastDistance(walk, obstacle, start, end, tolerances));
    if ((distance.lower > obstacle.margin)) {
      return new ObstacleAnswers(obstacle, null, distance);
    }
    answers = (await touching(walk, obstacle, start, end));
    contact = (py.truth(answers) ? py.at(answers, -1) : null);
    near = ((contact == null) ? null : contact.witness);
    if (((distance.value > 0.0) || (near == null) || (near.gap <= 0.0))) {
      return new ObstacleAnswers(obstacle, contact, distance);
    }
    bare = (await touching(walk, py.replaced(obstacle, { margin: 0.0 }), start, end));
    return new ObstacleAnswers(obstacle, contact, distance, (py.truth(bare) ? py.at(bare, -1) : null));
  });
}
