// @ts-nocheck
// Made from analysis/chalk_line.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";

const TAPE = 30.0;
const SAME = 0.02;
const STEP = 0.05;
const HALVINGS = 30;
const BEFORE = 1e-07;
export class Trail {
  constructor(route, low, start, high) {
    this.route = route;
    this.low = low;
    this.start = start;
    this.high = high;
  }
}
class Piece {
  constructor(row, low, high, star) {
    this.row = row;
    this.low = low;
    this.high = high;
    this.star = star;
  }
  *[Symbol.iterator]() {
    yield* [this.row, this.low, this.high, this.star];
  }
}
export class Crossing {
  constructor(s, tape, kind) {
    this.s = s;
    this.tape = tape;
    this.kind = kind;
  }
  *[Symbol.iterator]() {
    yield* [this.s, this.tape, this.kind];
  }
}
export class Line {
  constructor(trail, peg) {
    let own, pieces;
    this._rows = trail.route.rows;
    this._table = py.tolist(trail.route.rows);
    this._trail = trail;
    this.stakes = [];
    this._reach = [];
    own = py.list(py.range(py.len(this._table))).map((j) => this._own(j));
    pieces = py.list(py.enumerate(own)).map(([j, star]) => this._piece(j, star));
    this.pieces = py.list(pieces).flatMap((one) => (((one.low < one.high)) ? [one] : []));
    if ((!py.truth(this.stakes) && py.truth(this._turns_about(peg)))) {
      py.append(this.stakes, peg);
      py.append(this._reach, TAPE);
    }
    this.pieces = py.list(this.pieces).map((one) => py.replaced(one, { star: this._star(one) }));
  }
  seen(places) {
    let found, out;
    out = py.empty([py.len(places), 4]);
    py.entry("bd_route_evaluate", this._rows, py.array(places), out);
    found = py.tolist(out);
    return found;
  }
  star(s) {
    return py.next(py.list(this.pieces).flatMap((one) => (((s <= one.high)) ? [one.star] : [])), py.at(this.pieces, -1).star);
  }
  stray(a, b) {
    let ends, high, low, most, one;
    ends = [];
    for (one of py.iter(this.pieces)) {
      [low, high] = py.list([py.max(a, one.low), py.min(b, one.high)]);
      if ((low < high)) {
        ends = py.extend(ends, [low, py.max(low, py.sub(high, BEFORE))]);
      }
    }
    most = py.max([0.0, ...py.iter(py.list(this.seen(ends)).map(([_x, _y, _heading, bend]) => py.abs(bend)))]);
    return ((0.125 * (py.sub(b, a) ** 2)) * most);
  }
  joints(a, b) {
    return py.list(py.pairwise(this.pieces)).flatMap(([one, after]) => (((!py.eq(this._part(one), this._part(after)) && ((a < after.low) && (after.low < b)))) ? [after.low] : []));
  }
  crossings(star, spokes, turned) {
    let found, one;
    found = [];
    for (one of py.iter(this.pieces)) {
      if (py.eq(one.star, star)) {
        if (py.truth(this._own_centre(one.row, star))) {
          found = py.extend(found, this._of_spiral(one, spokes, turned));
        }
        else {
          found = py.extend(found, this._of_any(one, spokes, turned));
        }
      }
    }
    return found;
  }
  reach(star) {
    return py.max(py.list(this.pieces).flatMap((one) => ((py.eq(one.star, star)) ? [this._away(one, py.at(this.stakes, star))] : [])));
  }
  _part(piece) {
    let part;
    part = py.at(py.at(this._table, piece.row), 1);
    return part;
  }
  _piece(j, star) {
    let low, row, trail;
    [row, trail] = py.list([py.at(this._table, j), this._trail]);
    low = ((j === 0) ? trail.low : py.max(trail.low, py.at(row, 2)));
    return new Piece(j, low, py.min(trail.high, py.add(py.at(row, 2), py.at(row, 3))), star);
  }
  _centre(j) {
    let bend, heading, row, x, y;
    row = py.at(this._table, j);
    if (py.eq(py.at(row, 0), 3.0)) {
      return [py.at(row, 7), py.at(row, 8)];
    }
    bend = py.at(row, 10);
    if ((!py.eq(py.at(row, 0), 1.0) || ((py.abs(bend) * py.at(row, 3)) < (2.0 * Math.PI)))) {
      return null;
    }
    heading = py.at(row, 9);
    [x, y] = py.list([py.sub(py.at(row, 7), (py.sin(heading) / bend)), py.add(py.at(row, 8), (py.cos(heading) / bend))]);
    return [x, y];
  }
  _own(j) {
    let centre, n, piece, stake;
    [centre, piece] = py.list([this._centre(j), this._piece(j, -1)]);
    if (((centre == null) || (piece.low >= piece.high))) {
      return -1;
    }
    for ([n, stake] of py.iter(py.enumerate(this.stakes))) {
      if ((py.dist(stake, centre) < SAME)) {
        py.set(this._reach, n, py.max(py.at(this._reach, n), this._away(piece, centre)));
        return n;
      }
    }
    py.append(this.stakes, centre);
    py.append(this._reach, this._away(piece, centre));
    return (py.len(this.stakes) - 1);
  }
  _own_centre(j, star) {
    let row;
    row = py.at(this._table, j);
    if (!py.eq(py.at(row, 0), 3.0)) {
      return false;
    }
    return (py.dist([py.at(row, 7), py.at(row, 8)], py.at(this.stakes, star)) < 1e-09);
  }
  _star(piece) {
    let n, stake;
    if ((piece.star >= 0)) {
      return piece.star;
    }
    for ([n, stake] of py.iter(py.enumerate(this.stakes))) {
      if ((this._away(piece, stake) <= py.add(py.at(this._reach, n), SAME))) {
        return n;
      }
    }
    return -1;
  }
  _samples(piece) {
    let count, step;
    count = (py.ceil((py.sub(piece.high, piece.low) / STEP)) + 1);
    step = (py.sub(piece.high, piece.low) / count);
    return [...py.iter(py.list(py.range(count)).map((n) => py.add(piece.low, (step * n)))), piece.high];
  }
  _away(piece, stake) {
    return py.max(py.list(this._sampled(piece)).map(([x, y, _h, _k]) => py.hypot(py.sub(x, py.at(stake, 0)), py.sub(y, py.at(stake, 1)))));
  }
  _sampled(piece) {
    return this.seen(this._samples(piece));
  }
  _turns_about(peg) {
    let _bend, _heading, angle, before, off, one, turned, x, y;
    [turned, before] = py.list([0.0, NaN]);
    for (one of py.iter(this.pieces)) {
      for ([x, y, _heading, _bend] of py.iter(this._sampled(one))) {
        off = [py.sub(x, py.at(peg, 0)), py.sub(y, py.at(peg, 1))];
        if (!((SAME < py.hypot(py.at(off, 0), py.at(off, 1))) && (py.hypot(py.at(off, 0), py.at(off, 1)) <= TAPE))) {
          return false;
        }
        angle = py.atan2(py.at(off, 1), py.at(off, 0));
        if (!py.isnan(before)) {
          turned = py.extend(turned, py.remainder(py.sub(angle, before), (2.0 * Math.PI)));
        }
        before = angle;
      }
    }
    return (py.abs(turned) >= ((2.0 * Math.PI) - 1e-06));
  }
  _of_spiral(piece, spokes, turned) {
    let angles, at, ends, first, high, k, low, n, out, row, tapes;
    row = py.at(this._table, piece.row);
    ends = py.list([piece.low, piece.high]).map((s) => py.entry("bd_curve_parameter_at", this._rows, piece.row, py.sub(s, py.at(row, 2)))[0]);
    angles = [];
    tapes = [];
    for (n of py.iter(py.range(spokes))) {
      first = (py.at(row, 11) * py.sub(py.add(turned, (((2.0 * Math.PI) * n) / spokes)), py.at(row, 9)));
      low = py.ceil((py.sub(py.min(ends), first) / (2.0 * Math.PI)));
      high = py.floor((py.sub(py.max(ends), first) / (2.0 * Math.PI)));
      for (k of py.iter(py.range(low, (high + 1)))) {
        py.append(angles, py.add(first, ((2.0 * Math.PI) * k)));
        py.append(tapes, (n + 1));
      }
    }
    if (!py.truth(angles)) {
      return [];
    }
    out = py.empty(py.len(angles));
    at = py.array(py.list(angles).map((_angle) => piece.row), "q");
    py.entry("bd_route_positions", this._rows, at, py.array(angles), out);
    return py.list(py.zip(py.tolist(out), tapes)).map(([s, tape]) => new Crossing(s, tape, ""));
  }
  _of_any(piece, spokes, turned) {
    let _half, ahead, angle, at, below, highs, i, lows, middles, n, places, points, sides, start, tape, tapes;
    [places, points] = py.list([this._samples(piece), this._sampled(piece)]);
    lows = [];
    highs = [];
    tapes = [];
    for (n of py.iter(py.range(spokes))) {
      angle = py.add(turned, (((2.0 * Math.PI) * n) / spokes));
      sides = py.list(points).map((one) => this._side(piece.star, angle, one));
      for (i of py.iter(py.range((py.len(sides) - 1)))) {
        ahead = this._ahead(piece.star, angle, py.at(points, i));
        if ((!py.eq((py.at(sides, i) < 0.0), (py.at(sides, (i + 1)) < 0.0)) && (ahead > 0.0))) {
          py.append(lows, py.at(places, i));
          py.append(highs, py.at(places, (i + 1)));
          py.append(tapes, (n + 1));
        }
      }
    }
    if (!py.truth(lows)) {
      return [];
    }
    for (_half of py.iter(py.range(HALVINGS))) {
      middles = py.list(py.zip(lows, highs)).map(([a, b]) => (0.5 * py.add(a, b)));
      [at, start] = py.list([this.seen(middles), this.seen(lows)]);
      for ([i, tape] of py.iter(py.enumerate(tapes))) {
        angle = py.add(turned, (((2.0 * Math.PI) * (tape - 1)) / spokes));
        below = (this._side(piece.star, angle, py.at(start, i)) < 0.0);
        if (py.eq((this._side(piece.star, angle, py.at(at, i)) < 0.0), below)) {
          py.set(lows, i, py.at(middles, i));
        }
        else {
          py.set(highs, i, py.at(middles, i));
        }
      }
    }
    return py.list(py.zip(lows, tapes)).map(([s, tape]) => new Crossing(s, tape, ""));
  }
  _side(star, angle, at) {
    let x, y;
    [x, y] = py.list(py.at(this.stakes, star));
    return py.sub((py.cos(angle) * py.sub(py.at(at, 1), y)), (py.sin(angle) * py.sub(py.at(at, 0), x)));
  }
  _ahead(star, angle, at) {
    let x, y;
    [x, y] = py.list(py.at(this.stakes, star));
    return py.add((py.cos(angle) * py.sub(py.at(at, 0), x)), (py.sin(angle) * py.sub(py.at(at, 1), y)));
  }
}
