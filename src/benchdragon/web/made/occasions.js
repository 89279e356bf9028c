// @ts-nocheck
// Made from player/occasions.py by tools/make_twins.py; to make it again: make generate

import { bracketed } from "../compute/answer.js";
import { py } from "../compute/python.js";
import { N_, _, both } from "../words.js";
import { shown, vanishing } from "./answer.js";
import { inOneCoil } from "./check.js";
import { cueName } from "./cues.js";
import { named, touchText } from "./findings.js";

const QUANTUM = 0.0001;
const MOST_JOINTS = 200;
function occasion(kind, time, say, benches = [], obstacle = /** @type {any} */ (null)) {
  return ({ kind: kind, time: time, text: both(say), benches: py.list(benches), obstacle: obstacle });
}
export function jointsPassed(joints, times, ends) {
  let found, joint, n, s, says, tail, text;
  found = [];
  tail = N_("the tail passes joint {n} of the route");
  for ([s, says] of py.iter(py.zip(ends, [N_("the head passes joint {n} of the route"), tail]))) {
    for ([n, joint] of py.iter(py.enumerate(((py.len(joints) <= MOST_JOINTS) ? joints : []), 1))) {
      if (((py.add(py.at(s, 0), QUANTUM) < joint) && (joint < py.sub(py.at(s, -1), QUANTUM)))) {
        text = ((given0, given1) => () => _numbered(given0, given1))(says, n);
        py.append(found, occasion("joint", py.float(py.interp(joint, s, times)), text));
      }
    }
  }
  return found;
}
function _numbered(says, n) {
  return py.filled(_(says), { n: n });
}
export function ending(time) {
  return occasion("end", time, () => _("from here on the benches cannot follow"));
}
export function cued(moments, start, end) {
  return py.list(moments).flatMap((one) => ((((start <= one.time) && (one.time <= end))) ? [occasion("cue", one.time, ((given0) => () => cueName(given0))(one.cue))] : []));
}
export function occasionsFound(verdict, obstacles, margin, speedLimit) {
  let clearance, contact, fast, found, gap, least, most, near, says, saysMost, speed, text, time;
  [contact, clearance, speed] = py.list([verdict.first_contact, verdict.clearance, verdict.greatest_speed]);
  found = [];
  if (((contact != null) && (contact.witness != null))) {
    text = ((py.truth(_apart(contact)) && (margin > 0.0)) ? N_("margin not kept") : N_("first contact"));
    time = bracketed(contact).value;
    py.append(found, occasion("contact", time, () => _(text), contact.witness.benches));
  }
  else {
    if (((clearance != null) && (clearance.witness != null))) {
      [near, least] = py.list([clearance.witness, bracketed(clearance)]);
      [gap, says] = py.list([shown(least, false, margin), N_("tightest moment: {gap} m")]);
      if (py.truth(vanishing(least))) {
        says = N_("tightest moment: less than {gap} m");
      }
      else {
        if (py.truth(inOneCoil([...py.iter(near.benches)]))) {
          says = N_("nearest with one bench between: {gap} m");
        }
      }
      if ((near.time != null)) {
        py.append(found, occasion("tightest", near.time, () => py.filled(_(says), { gap: gap }), near.benches));
      }
    }
  }
  fast = ((speed == null) ? null : speed.witness);
  if (((speed != null) && (fast != null) && (fast.time != null))) {
    most = shown(bracketed(speed), true, speedLimit);
    saysMost = N_("fastest moment: {speed} m/s");
    py.append(found, occasion("fastest", fast.time, () => py.filled(_(saysMost), { speed: most }), fast.benches));
  }
  return py.add(found, _onTheSquare(verdict.obstacles, obstacles));
}
function _apart(contact) {
  let gap;
  gap = ((contact.witness == null) ? null : contact.witness.gap);
  return ((gap != null) && (gap > 0.0));
}
function _onTheSquare(records, obstacles) {
  let _room, clear, found, n, record;
  found = [];
  clear = [];
  for ([n, record] of py.iter(py.enumerate(records))) {
    if ((record.contact == null)) {
      py.append(clear, [py.sub(bracketed(record.distance).value, py.at(obstacles, n).margin), n]);
    }
    else {
      found = py.extend(found, _tooNear(record, record.contact, py.at(obstacles, n), n));
    }
  }
  for ([_room, n] of py.iter(py.slice(py.sorted(clear), null, 1))) {
    found = py.extend(found, _nearest(py.at(records, n).distance, py.at(obstacles, n), n));
  }
  return found;
}
function _nearest(distance, obstacle, n) {
  let edge, gap, least, says;
  [least, edge] = py.list([bracketed(distance), (obstacle.kind === "venue")]);
  says = (py.truth(edge) ? N_("nearest to the edge of {name}: {gap} m") : N_("nearest to {name}: {gap} m"));
  if (py.truth(vanishing(least))) {
    says = N_("nearest to {name}: less than {gap} m");
    if (py.truth(edge)) {
      says = N_("nearest to the edge of {name}: less than {gap} m");
    }
  }
  gap = shown(least, false, obstacle.margin);
  return _atObstacle(distance, obstacle, n, () => py.filled(_(says), { name: named(obstacle), gap: gap }));
}
function _tooNear(record, contact, obstacle, n) {
  let bench, found, near, says, touch;
  found = [];
  [touch, says] = py.list([contact, N_("margin from {name} not kept")]);
  if (py.truth(_apart(contact))) {
    found = py.extend(found, _atObstacle(contact, obstacle, n, () => py.filled(_(says), { name: named(obstacle) })));
    touch = record.distance;
  }
  near = touch.witness;
  if (((near != null) && (record.distance.value === 0.0))) {
    bench = py.at(near.benches, 0);
    found = py.extend(found, _atObstacle(touch, obstacle, n, () => touchText(bench, obstacle)));
  }
  return found;
}
function _atObstacle(answer, obstacle, n, say) {
  let near, time;
  near = answer.witness;
  if (((near == null) || (near.time == null))) {
    return [];
  }
  time = ((answer.unit === "s") ? bracketed(answer).value : near.time);
  return [occasion(((obstacle.kind === "venue") ? "venue" : "obstacle"), time, say, near.benches, n)];
}
export function tighten(nearest, clearance, start, end) {
  let a, b, bench, near, other, seen;
  near = ((clearance == null) ? null : clearance.witness);
  if (((clearance == null) || (clearance.value == null) || (near == null) || (near.time == null))) {
    return null;
  }
  if (!((start <= near.time) && (near.time <= end))) {
    return null;
  }
  [a, b] = py.list(near.benches);
  for ([bench, other] of py.iter([[a, b], [b, a]])) {
    seen = (py.truth(py.at(nearest.other, (bench - 1))) ? py.at(nearest.distance, (bench - 1)) : nearest.reach);
    if ((clearance.value < seen)) {
      py.set(nearest.distance, (bench - 1), py.round(clearance.value, 5));
      py.set(nearest.time, (bench - 1), py.round(near.time, 4));
      py.set(nearest.other, (bench - 1), other);
    }
  }
}
