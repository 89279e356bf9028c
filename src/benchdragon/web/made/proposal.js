// @ts-nocheck
// Made from solve/proposal.py by tools/make_twins.py; to make it again: make generate

import { withPeople } from "../compute/dragon.js";
import { InputError, NoSolutionError, PlanError, UnsureError } from "../compute/error_kinds.js";
import { checked } from "../compute/plan.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { checked as judged } from "./check.js";
import { firstSureContact } from "./contact.js";
import { WalkError } from "./errors.js";
import { greatestHeadSpeed } from "./head_speed.js";
import { foundLimit } from "./size.js";
import { Square } from "./square_room.js";
import { part, silent } from "./stages.js";
import { refuse, roundedDown, roundedUp } from "./wishes.js";

const NAME = "benchdragon new";
const AGAIN = 2;
const VENUE_MARGIN = 0.5;
const CORNERS = 90;
const KINDS = ["turn", "spiral-in"];
const AHEAD = [0.5, 0.3];
const SIZE_STEP = 0.1;
const SPEED_STEP = 0.05;
const DISCS = [2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 10.0];
const WIDE = 2.0;
const ENOUGH = 60;
const ROUNDS = py.dict([["turn", [2.0, 1.0, 0.5, 0.0]], ["spiral-in", [6.0, 4.0, 3.0, 2.0, 1.0, 0.5]]]);
const LED = py.dict([["turn", [0.0]], ["spiral-in", [2.0, 0.5]]]);
const MOST_REFUSED = 4;
const MOST_SIZES = 3;
const SPARE = 0.025;
const ANGLES = 180;
const SIZES = ["length", "width", "front_inset", "rear_inset"];
class Proposal {
  constructor(plan, report, slower) {
    this.plan = plan;
    this.report = report;
    this.slower = slower;
  }
  get less_ahead() {
    return (this.plan.people.ahead < py.at(AHEAD, 0));
  }
}
export class TooSmall {
  constructor(kind, rectangle, radius, benches, under = false) {
    this.kind = kind;
    this.rectangle = rectangle;
    this.radius = radius;
    this.benches = benches;
    this.under = under;
  }
}
class _Dance {
  constructor(square, plan, room) {
    this.square = square;
    this.plan = plan;
    this.room = room;
  }
  get radius() {
    return py.at(this.square.circle(), 2);
  }
}
export async function propose(wishes, progress = silent) {
  return py.scoped(async () => {
    let least, less, n, smallest, text, trades, tried, walked;
    refuse(wishes);
    _refuseGround(wishes);
    trades = _trades(wishes);
    for ([n, less] of py.iter(py.enumerate(trades))) {
      walked = ((less.street == null) ? ROUNDS : LED);
      tried = (await _tried(less, walked, part(progress, (n / py.len(trades)), ((n + 1.0) / py.len(trades)))));
      if ((tried.found != null)) {
        return tried.found;
      }
    }
    wishes = py.at(trades, -1);
    if (py.truth(tried.fits)) {
      text = _("a dance was found that fits the square, but it does not pass the check: try narrower benches");
      throw new UnsureError(text);
    }
    least = (await _least(wishes));
    if (!py.truth(least)) {
      text = _("no dance of these benches was found among the pitches and turning discs that were tried: try narrower benches, or holes nearer to their ends");
      throw new InputError(text);
    }
    progress(0.9, _("how large a square it takes"));
    smallest = py.min(least, (dance) => dance.radius);
    return (await _tooSmall(wishes, smallest, (await _fitsUnder(wishes))));
  });
}
export async function benchesOutAgain(wishes, progress = silent) {
  refuse(wishes);
  progress(0.0, _("how many benches come out again"));
  return (await _fitting(py.replaced(wishes, { rounds: 1 }), "turn"));
}
function _trades(wishes) {
  let found;
  found = ((wishes.rounds > 1) ? [py.replaced(wishes, { kind: "turn" })] : []);
  py.append(found, py.replaced(wishes, { rounds: 1 }));
  return ((wishes.street == null) ? found : py.add(found, py.list(found).map((one) => py.replaced(one, { street: null }))));
}
class _Tried {
  constructor(found, fits) {
    this.found = found;
    this.fits = fits;
  }
}
async function _tried(wishes, walked, progress) {
  let ahead, dance, first, fits, found, kind, last, n, refused, rounds, sized, sorts;
  sorts = py.list(_kinds(wishes)).flatMap((kind) => py.list(AHEAD).map((ahead) => [kind, ahead]));
  [fits, refused] = py.list([false, 0]);
  for ([n, [kind, ahead]] of py.iter(py.enumerate(sorts))) {
    progress((n / py.len(sorts)), _("pitch and disc"));
    for (sized of py.iter((await _sized(wishes, kind, ahead, py.at(py.at(walked, kind), -1))))) {
      progress(((n + 0.5) / py.len(sorts)), _("place on the square"));
      first = (await _placed(wishes, sized, py.at(py.at(walked, kind), -1)));
      if (((first == null) || (first.room < 0.0))) {
        continue;
      }
      fits = true;
      for (rounds of py.iter(py.at(walked, kind))) {
        last = py.eq(rounds, py.at(py.at(walked, kind), -1));
        if ((!py.truth(last) && py.truth(_tooWide(wishes, sized, rounds)))) {
          continue;
        }
        dance = (py.truth(last) ? first : (await _placed(wishes, sized, rounds)));
        if (((dance == null) || (dance.room < 0.0))) {
          continue;
        }
        found = (await _walked(wishes, dance.plan));
        refused = py.extend(refused, 1);
        if (((found != null) || ((wishes.street != null) && py.eq(refused, MOST_REFUSED)))) {
          return new _Tried(found, fits);
        }
      }
    }
  }
  return new _Tried(null, fits);
}
function _kinds(wishes) {
  return ((wishes.kind == null) ? KINDS : [wishes.kind]);
}
async function _least(wishes) {
  let dance, found, kind, sized;
  found = [];
  for (kind of py.iter(_kinds(wishes))) {
    for (sized of py.iter((await _sized(wishes, kind, py.at(AHEAD, -1))))) {
      dance = (await _placed(wishes, sized, py.at(py.at(ROUNDS, kind), -1)));
      if ((dance != null)) {
        py.append(found, dance);
      }
    }
  }
  return found;
}
function _tooWide(wishes, sized, rounds) {
  let disc, inner, link, narrow, outer, pitch;
  [pitch, disc] = py.list([sized.value("route.pitch"), sized.value("disc.radius")]);
  inner = py.add(disc, (rounds * pitch));
  link = py.sub(wishes.length, (2.0 * wishes.inset));
  outer = py.sqrt(py.add((inner * inner), (((wishes.benches * link) * pitch) / Math.PI)));
  narrow = (2.0 * py.or(wishes.radius, () => 0.0));
  if ((wishes.rectangle != null)) {
    narrow = py.min(wishes.rectangle);
  }
  else {
    if ((wishes.boundary != null)) {
      narrow = py.min(py.list(py.zip(...py.iter(wishes.boundary))).map((sides) => py.sub(py.max(sides), py.min(sides))));
    }
  }
  return ((outer > py.add(inner, pitch)) && ((2.0 * py.sub(outer, pitch)) > narrow));
}
async function _fitsUnder(wishes) {
  let shortest, under;
  if ((wishes.carry === "under")) {
    return false;
  }
  under = py.replaced(wishes, { carry: "under" });
  try {
    refuse(under);
  } catch (error) {
    if (error instanceof InputError) {
      return false;
    } else
    throw error;
  }
  shortest = py.dict(py.list(py.items(ROUNDS)).map(([kind, rounds]) => [kind, py.slice(rounds, -1, null)]));
  return ((await _tried(under, shortest, silent)).found != null);
}
function _refuseGround(wishes) {
  let across, area, bench, corners, longest, most, needed, text, turns, words;
  wishes.plan(py.at(_kinds(wishes), 0), 1.0, 1.0, py.at(AHEAD, -1));
  corners = wishes.corners;
  turns = py.zip(corners, [...py.iter(py.slice(corners, 1, null)), py.at(corners, 0)]);
  area = (0.5 * py.abs(py.sum(py.list(turns).map(([[x, y], [toX, toY]]) => py.sub((x * toY), (y * toX))))));
  bench = (wishes.length * wishes.width);
  if (((py.div(wishes.benches, 2) * bench) > area)) {
    text = _("{count} benches do not fit on this square, however they dance: every second one alone takes {needed} m² in all, and the square has {area} m², enough for {most} benches at most");
    [needed, most] = py.list([(py.div(wishes.benches, 2) * bench), ((2 * py.int((area / bench))) + 1)]);
    words = py.dict([["needed", `${py.format(needed, `.1f`)}`], ["area", `${py.format(area, `.1f`)}`], ["most", most]]);
    throw new NoSolutionError(py.filled(text, { count: wishes.benches, ...py.object(words) }));
  }
  across = py.hypot(...py.iter(py.list(py.zip(...py.iter(corners))).map((sides) => py.sub(py.max(sides), py.min(sides)))));
  longest = py.max(wishes.length, wishes.head_length);
  if ((longest > across)) {
    text = _("a bench of {length} m does not fit on this square, which is {across} m across");
    throw new NoSolutionError(py.filled(text, { length: `${py.format(longest, `g`)}`, across: `${py.format(across, `.2f`)}` }));
  }
}
function _begun(plan, rounds) {
  let _start, disc, end, pitch, way;
  [pitch, disc] = py.list([plan.value("route.pitch"), plan.value("disc.radius")]);
  if ((plan.route.kind === "spiral-in")) {
    return plan.with_value("route.start_turn", roundedUp(py.add((disc / pitch), rounds), 0.01));
  }
  way = (((2.0 * Math.PI) * rounds) * py.add(disc, ((0.5 * rounds) * pitch)));
  plan = plan.with_value("walk.start", (0.0 - roundedUp((way / plan.walk.speed), 1.0)));
  [_start, end] = py.list(plan.span(plan.build()));
  return plan.with_value("walk.end", roundedUp(end, 1.0));
}
async function _sized(wishes, kind, ahead, rounds = /** @type {any} */ (null)) {
  let best, disc, dragon, few, first, found, least, link, pitch, share, wide;
  few = py.replaced(wishes, { benches: py.min(wishes.benches, ENOUGH), roster: "", rounds: 1 });
  link = py.sub(py.max(wishes.length, wishes.head_length), (2.0 * wishes.inset));
  wide = py.add(wishes.width, (2.0 * wishes.beside));
  dragon = ((wishes.benches * py.sub(wishes.length, (2.0 * wishes.inset))) / Math.PI);
  first = (py.add(wide, wishes.between) * ((kind === "turn") ? 2.0 : 1.0));
  found = [];
  for (share of py.iter(DISCS)) {
    disc = roundedUp((share * py.max(link, wide)), SIZE_STEP);
    best = py.slice(py.sorted(found), null, MOST_SIZES);
    if ((py.eq(py.len(best), MOST_SIZES) && (py.add((disc * disc), (dragon * first)) > py.at(py.at(best, -1), 0)))) {
      break;
    }
    least = roundedUp(first, SIZE_STEP);
    if (((rounds != null) && py.truth(_neverFits(wishes, kind, least, disc, ahead, rounds)))) {
      continue;
    }
    pitch = py.max((await _pitch(few, kind, first, disc, ahead)), least);
    if ((pitch <= (WIDE * first))) {
      py.append(found, [py.add((disc * disc), (dragon * pitch)), pitch, disc]);
    }
  }
  return py.list(py.slice(py.sorted(found), null, MOST_SIZES)).map(([_room, pitch, disc]) => wishes.plan(kind, pitch, disc, ahead));
}
function _trial(wishes, kind, pitch, disc, ahead) {
  let data, plan, sizes, wide;
  plan = wishes.plan(kind, pitch, disc, ahead).without_square();
  data = plan.data();
  wide = py.tolist(withPeople(plan.dragon.build(), plan.people).sizes);
  sizes = py.list(py.range(2)).map((n) => py.dict(py.list(py.zip(SIZES, wide)).map(([name, row]) => [name, py.at(row, n)])));
  py.set(data, "dragon", py.dict([["bench", [py.at(sizes, 0), py.union(py.at(sizes, 1), py.dict([["count", (wishes.benches - 1)]]))]]]));
  py.set(py.at(data, "limits"), "margin", wishes.between);
  if ((kind === "spiral-in")) {
    py.set(py.at(data, "route"), "start_turn", ((disc / pitch) + 6.0));
  }
  py.pop(data, "people");
  return checked(data, NAME);
}
async function _pitch(wishes, kind, first, disc, ahead) {
  let found, trial;
  try {
    trial = _trial(wishes, kind, (1.25 * first), disc, ahead);
    if (((kind === "spiral-in") && py.truth((await _touches(trial.with_value("route.pitch", (WIDE * first))))))) {
      return Infinity;
    }
    found = (await foundLimit(trial, "pitch", undefined, (0.1 * SIZE_STEP)));
  } catch (error) {
    if (error instanceof PlanError || error instanceof WalkError || error instanceof UnsureError) {
      return Infinity;
    } else
    throw error;
  }
  if ((found.status === "unlimited")) {
    return 0.0;
  }
  return ((found.status === "found") ? roundedUp(found.upper, SIZE_STEP) : Infinity);
}
async function _touches(plan) {
  let end, start, walk;
  walk = plan.build();
  [start, end] = py.list(plan.span(walk));
  return ((await firstSureContact(walk, start, end, plan.limits.margin)) != null);
}
async function _placed(wishes, sized, rounds) {
  let begun, dance, speed;
  try {
    begun = _begun(sized, rounds);
    dance = _roomiest(wishes, begun);
    if ((dance.room < 0.0)) {
      return dance;
    }
    speed = (await _speed(wishes, begun));
    if (py.eq(speed, sized.walk.speed)) {
      return dance;
    }
    return _roomiest(wishes, _begun(sized.with_value("walk.speed", speed), rounds));
  } catch (error) {
    if (error instanceof WalkError || error instanceof UnsureError || error instanceof PlanError) {
      return null;
    } else
    throw error;
  }
}
function _roomiest(wishes, plan) {
  let pose, square;
  square = new Square(plan);
  if (!py.truth(_mayFit(square, wishes))) {
    return new _Dance(square, plan, -Infinity);
  }
  pose = square.roomiest(silent);
  return new _Dance(square, square.at(pose), py.sub(square.room(pose), SPARE));
}
function _neverFits(wishes, kind, pitch, disc, ahead, rounds) {
  let plan;
  plan = wishes.plan(kind, pitch, disc, ahead);
  try {
    return !py.truth(_mayFit(new Square(_begun(plan, rounds)), wishes));
  } catch (error) {
    if (error instanceof WalkError || error instanceof UnsureError || error instanceof PlanError) {
      return false;
    } else
    throw error;
  }
}
function _mayFit(square, wishes) {
  let angle, box, high, kept, left, low, more, right;
  kept = square.venue.margin;
  if ((wishes.radius != null)) {
    return ((0.999 * py.at(square.circle(), 2)) <= py.sub(wishes.radius, kept));
  }
  box = py.list(py.zip(...py.iter(wishes.corners))).map((side) => py.sub(py.max(side), py.min(side)));
  more = py.sub(((py.hypot(...py.iter(box)) * Math.PI) / (2.0 * ANGLES)), (2.0 * kept));
  for (angle of py.iter(py.range(ANGLES))) {
    [left, right, low, high] = py.list(square.extent(py.float(angle)));
    if (((py.sub(right, left) <= py.add(py.max(box), more)) && (py.sub(high, low) <= py.add(py.min(box), more)))) {
      return true;
    }
  }
  return false;
}
async function _speed(wishes, plan) {
  let most;
  most = py.min((await greatestHeadSpeed(plan)).lower, wishes.speed);
  return py.or(roundedDown(most, SPEED_STEP), () => roundedDown(most, 0.001));
}
async function _led(wishes, plan) {
  let led;
  try {
    led = plan.with_values(py.dict([["route.street", wishes.street], ["walk.start", null], ["walk.end", null]]));
    return led.with_value("walk.speed", (await _speed(wishes, led)));
  } catch (error) {
    if (error instanceof WalkError || error instanceof UnsureError || error instanceof PlanError) {
      return null;
    } else
    throw error;
  }
}
async function _walked(wishes, plan) {
  let _start, end, led;
  if ((wishes.rounds > AGAIN)) {
    plan = plan.with_values(py.dict([["route.rounds", wishes.rounds], ["walk.end", null]]));
    [_start, end] = py.list(plan.span(plan.build()));
    plan = plan.with_value("walk.end", roundedUp(end, 1.0));
  }
  led = ((wishes.street == null) ? plan : (await _led(wishes, plan)));
  return ((led == null) ? null : (await _passing(wishes, led)));
}
async function _passing(wishes, plan) {
  let report, walk;
  walk = plan.build();
  report = (await judged(plan, walk, plan.span(walk)));
  return (py.truth(report.safe) ? new Proposal(plan, report, (plan.walk.speed < wishes.speed)) : null);
}
async function _tooSmall(wishes, dance, under) {
  let extents, kept, kind, long, radius, rectangle, short, sides;
  extents = py.list(py.range(ANGLES)).map((angle) => dance.square.extent(py.float(angle)));
  sides = py.list(extents).map((x) => py.sorted([py.sub(py.at(x, 1), py.at(x, 0)), py.sub(py.at(x, 3), py.at(x, 2))], undefined, true));
  kept = (2.0 * (py.add(py.add(VENUE_MARGIN, wishes.stray), SPARE) + 0.01));
  [long, short] = py.list(py.min(sides, (pair) => (py.add(py.at(pair, 0), kept) * py.add(py.at(pair, 1), kept))));
  radius = (py.add(dance.radius, (0.5 * kept)) / py.cos((Math.PI / CORNERS)));
  kind = ((dance.plan.route.kind === "turn") ? "turn" : "spiral-in");
  rectangle = [roundedUp(py.add(long, kept), SIZE_STEP), roundedUp(py.add(short, kept), SIZE_STEP)];
  return new TooSmall(kind, rectangle, roundedUp(radius, SIZE_STEP), (await _fitting(wishes, kind)), under);
}
async function _fitting(wishes, kind) {
  let fits, found, middle, notFit, sizes;
  sizes = (await _sized(wishes, kind, py.at(AHEAD, -1)));
  [fits, notFit] = py.list([1, wishes.benches]);
  while ((py.sub(notFit, fits) > 1)) {
    middle = py.div(py.add(fits, notFit), 2);
    if (((await _fewer(wishes, kind, sizes, middle)) == null)) {
      notFit = middle;
    }
    else {
      fits = middle;
    }
  }
  found = ((fits > 1) ? (await _fewer(wishes, kind, sizes, fits)) : null);
  return (((found == null) || ((await _walked(wishes, found)) == null)) ? 0 : fits);
}
async function _fewer(wishes, kind, sizes, benches) {
  let dance, disc, fewer, one, pitch, sized;
  fewer = py.replaced(wishes, { benches: benches });
  for (one of py.iter(sizes)) {
    [pitch, disc] = py.list([one.value("route.pitch"), one.value("disc.radius")]);
    sized = fewer.plan(kind, pitch, disc, one.people.ahead);
    dance = (await _placed(fewer, sized, py.at(py.at(ROUNDS, kind), -1)));
    if (((dance != null) && (dance.room >= 0.0))) {
      return dance.plan;
    }
  }
  return null;
}
