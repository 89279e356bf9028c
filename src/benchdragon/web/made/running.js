// @ts-nocheck
// Made from analysis/running.py by tools/make_twins.py; to make it again: make generate

import { runners } from "../compute/crowd.js";
import { py } from "../compute/python.js";

const STEP = 0.25;
const MOST_LOOKS = 5000000;
const SQUARE = 1.0;
const APART = 5.0;
class Running {
  constructor(point, speed, time) {
    this.point = point;
    this.speed = speed;
    this.time = time;
  }
  *[Symbol.iterator]() {
    yield* [this.point, this.speed, this.time];
  }
}
export function runningStretches(walk, start, end, runFrom) {
  let found, left, one, square;
  left = _seen(walk, start, end, runFrom);
  found = [];
  for (one of py.iter(py.sorted(py.values(left), (seen) => -seen.speed))) {
    square = _square(...py.iter(one.point));
    if (py.has(left, square)) {
      py.append(found, one);
      _leaveOut(left, square);
    }
  }
  return py.tuple(found);
}
function _square(x, y) {
  return `${py.str(py.floor((x / SQUARE)))} ${py.str(py.floor((y / SQUARE)))}`;
}
function _leaveOut(left, first) {
  let i, j, other, reach, square, waiting, x, y;
  reach = py.ceil((APART / SQUARE));
  waiting = [py.pop(left, first)];
  while (py.truth(waiting)) {
    [x, y] = py.list(py.pop(waiting).point);
    for (i of py.iter(py.range(-reach, (reach + 1)))) {
      for (j of py.iter(py.range(-reach, (reach + 1)))) {
        square = _square(py.add(x, (i * SQUARE)), py.add(y, (j * SQUARE)));
        other = py.get(left, square);
        if (((other != null) && (py.dist([x, y], other.point) <= APART))) {
          py.append(waiting, py.pop(left, square));
        }
      }
    }
  }
}
function _seen(walk, start, end, runFrom) {
  let count, found, known, most, speed, square, time, x, y;
  most = py.max(py.div(MOST_LOOKS, (py.len(walk.dragon) + 1)), 2);
  count = py.min((py.ceil((py.sub(end, start) / STEP)) + 1), most);
  found = py.dict([]);
  for (time of py.iter(py.tolist(py.linspace(start, end, count)))) {
    for ([x, y, speed] of py.iter(runners(walk, time, runFrom))) {
      square = _square(x, y);
      known = py.get(found, square);
      if (((known == null) || (speed > known.speed))) {
        py.set(found, square, new Running([x, y], speed, time));
      }
    }
  }
  return found;
}
