// @ts-nocheck
// Made from solve/imprecise.py by tools/make_twins.py; to make it again: make generate

import { BenchDragonError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { silent } from "./stages.js";
import { ALL, Deviations, Draw, chance, touches } from "./tolerance.js";

const DRAWS = 110;
const SEED = 1;
export const RISK = 0.05;
const MOST_ASIDE = 1.0;
class Chance {
  constructor(deviations, draws, hits) {
    this.deviations = deviations;
    this.draws = draws;
    this.hits = hits;
  }
  get most() {
    return py.at(chance(this.hits, this.draws), 2);
  }
  get shown() {
    return ((this.draws > 0) && (this.most < RISK));
  }
}
function deviationsOf(plan) {
  let others, said, usual;
  [usual, said] = py.list([new Deviations(...py.iter(ALL)), py.min(plan.people.imprecision, MOST_ASIDE)]);
  others = [usual.stray, usual.play, usual.height, usual.length, usual.width];
  return new Deviations(py.or(said, () => usual.aside), ...py.iter(others));
}
export async function chanceOf(plan, progress = silent) {
  let bare, deviations, hits, number;
  [bare, deviations, hits] = py.list([plan.without_square(), deviationsOf(plan), 0]);
  for (number of py.iter(py.range(DRAWS))) {
    try {
      hits = py.extend(hits, (await touches(bare, new Draw(deviations, SEED, number))));
    } catch (error) {
      if (error instanceof BenchDragonError) {
        return new Chance(deviations, 0, 0);
      } else
      throw error;
    }
    progress(((number + 1) / DRAWS), "");
    if ((py.at(chance(hits, DRAWS), 2) >= RISK)) {
      return new Chance(deviations, (number + 1), hits);
    }
  }
  return new Chance(deviations, DRAWS, hits);
}
