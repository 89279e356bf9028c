// @ts-nocheck
// Made from model/rings.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

const NEAR = 1e-06;
const ROUND = 64;
export function outermost(rings) {
  return py.list(rings).flatMap((ring) => ((!py.list(rings).some((other) => ((other !== ring)) && py.truth(holds(other, py.at(ring, 0))))) ? [ring] : []));
}
export function lengthOf(ring) {
  return py.sum(py.list(py.pairwise(ring)).map(([a, b]) => py.dist(a, b)));
}
export function areaOf(ring) {
  let _others, twice, x, y;
  [[x, y], ..._others] = py.list(ring);
  twice = py.list(py.pairwise(ring)).map(([[ax, ay], [bx, by]]) => py.sub((py.sub(ax, x) * py.sub(by, y)), (py.sub(bx, x) * py.sub(ay, y))));
  return (0.5 * py.abs(py.sum(twice)));
}
export function holds(ring, place) {
  let crossed, x, y;
  [x, y] = py.list(place);
  crossed = py.list(py.pairwise(ring)).flatMap(([[ax, ay], [bx, by]]) => (((!py.eq((ay > y), (by > y)) && (x < py.add(ax, ((py.sub(y, ay) / py.sub(by, ay)) * py.sub(bx, ax)))))) ? [[ax, ay]] : []));
  return (py.mod(py.len(crossed), 2) === 1);
}
export function nearestOn(ring, place) {
  let ahead, along, away, ax, ay, bx, by, found, nearest, passed, way, x, y;
  [x, y] = py.list(place);
  [nearest, found, passed] = py.list([Infinity, 0.0, 0.0]);
  for ([[ax, ay], [bx, by]] of py.iter(py.pairwise(ring))) {
    way = py.hypot(py.sub(bx, ax), py.sub(by, ay));
    if ((way > 0.0)) {
      ahead = (py.add((py.sub(x, ax) * py.sub(bx, ax)), (py.sub(y, ay) * py.sub(by, ay))) / way);
      along = py.min(py.max(ahead, 0.0), way);
      away = py.hypot(py.sub(py.add(ax, ((along / way) * py.sub(bx, ax))), x), py.sub(py.add(ay, ((along / way) * py.sub(by, ay))), y));
      if ((away < nearest)) {
        [nearest, found] = py.list([away, py.add(passed, along)]);
      }
    }
    passed = py.extend(passed, way);
  }
  return [nearest, found];
}
export function placeOn(ring, along) {
  let ax, ay, bx, by, left, way;
  left = along;
  for ([[ax, ay], [bx, by]] of py.iter(py.pairwise(ring))) {
    way = py.hypot(py.sub(bx, ax), py.sub(by, ay));
    if (((0.0 < way) && (left <= way))) {
      return [py.add(ax, ((left / way) * py.sub(bx, ax))), py.add(ay, ((left / way) * py.sub(by, ay)))];
    }
    left = py.sub(left, way);
  }
  return py.at(ring, -1);
}
export function stretch(ring, begin, end) {
  let a, b, corners, inner, passed, whole;
  [whole, passed, corners] = py.list([lengthOf(ring), 0.0, []]);
  for ([a, b] of py.iter(py.pairwise(ring))) {
    corners = py.extend(corners, py.list([-whole, 0.0, whole]).map((lap) => [py.add(passed, lap), a]));
    passed = py.extend(passed, py.dist(a, b));
  }
  inner = py.list(py.sorted(corners)).flatMap(([along, a]) => ((((py.add(begin, NEAR) < along) && (along < py.sub(end, NEAR)))) ? [a] : []));
  return [placeOn(ring, py.mod(begin, whole)), ...py.iter(inner), placeOn(ring, py.mod(end, whole))];
}
export function ringOf(outline) {
  return [...py.iter(outline), py.at(outline, 0)];
}
export function roundRing(centre, radius) {
  let far, found, turns, x, y;
  [x, y] = py.list(centre);
  far = (radius / py.cos((Math.PI / ROUND)));
  turns = py.list(py.range(ROUND)).map((n) => (((2.0 * Math.PI) * n) / ROUND));
  found = py.list(turns).map((turn) => [py.add(x, (far * py.cos(turn))), py.add(y, (far * py.sin(turn)))]);
  return [...py.iter(found), py.at(found, 0)];
}
export function opening(ring, place, width) {
  let along, away, half;
  [away, along] = py.list(nearestOn(ring, place));
  half = (0.5 * width);
  return (((away <= half) && (width < lengthOf(ring))) ? [py.sub(along, half), py.add(along, half)] : null);
}
export function gateIn(ring, way, width) {
  let _share, at, here, hits, there;
  if (((width >= lengthOf(ring)) || py.truth(holds(ring, py.at(way, 0))))) {
    return null;
  }
  for ([here, there] of py.iter(py.pairwise(way))) {
    hits = _crossings(ring, here, there);
    if (py.truth(hits)) {
      [_share, at] = py.list(py.min(hits));
      return [py.sub(at, (0.5 * width)), py.add(at, (0.5 * width))];
    }
  }
  return null;
}
export function between(ring, spans) {
  let begin, end, found, laid, reach, whole;
  [whole, found] = py.list([lengthOf(ring), []]);
  laid = py.sorted(py.list(spans).map(([begin, end]) => [py.mod(begin, whole), py.sub(py.add(py.mod(begin, whole), end), begin)]));
  reach = py.sub(py.max(py.list(laid).map(([_begin, end]) => end), undefined, 0.0), whole);
  for ([begin, end] of py.iter(laid)) {
    if ((begin > reach)) {
      py.append(found, stretch(ring, reach, begin));
    }
    reach = py.max(reach, end);
  }
  return found;
}
function _crossings(ring, here, there) {
  let found, met, one, other, passed, side;
  [found, passed] = py.list([[], 0.0]);
  for ([one, other] of py.iter(py.pairwise(ring))) {
    side = py.dist(one, other);
    met = _met(here, there, one, other);
    found = py.extend(found, ((met == null) ? [] : [[py.at(met, 0), py.add(passed, (py.at(met, 1) * side))]]));
    passed = py.extend(passed, side);
  }
  return found;
}
function _met(here, there, one, other) {
  let across, ax, ay, bx, by, dx, dy, otherShare, share;
  [ax, ay, bx, by] = py.list([py.sub(py.at(there, 0), py.at(here, 0)), py.sub(py.at(there, 1), py.at(here, 1)), py.sub(py.at(other, 0), py.at(one, 0)), py.sub(py.at(other, 1), py.at(one, 1))]);
  [dx, dy, across] = py.list([py.sub(py.at(one, 0), py.at(here, 0)), py.sub(py.at(one, 1), py.at(here, 1)), py.sub((ax * by), (ay * bx))]);
  if ((across === 0.0)) {
    return null;
  }
  [share, otherShare] = py.list([(py.sub((dx * by), (dy * bx)) / across), (py.sub((dx * ay), (dy * ax)) / across)]);
  return ((((0.0 <= share) && (share <= 1.0)) && ((0.0 <= otherShare) && (otherShare <= 1.0))) ? [share, otherShare] : null);
}
