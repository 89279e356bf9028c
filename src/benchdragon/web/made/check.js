// @ts-nocheck
// Made from analysis/check.py by tools/make_twins.py; to make it again: make generate

import { speedAtStart, toldIfOpen } from "../compute/left_open.js";
import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { keeps, shown, sure, vanishing } from "./answer.js";
import { firstSureContact, leastClearance, seenClearance } from "./contact.js";
import { allFindings, named } from "./findings.js";
import { PROOFS } from "./left_open.js";
import { notLookedAt } from "./not_looked_at.js";
import { seconds } from "./number_format.js";
import { obstacleAnswers } from "./obstacles.js";
import { called } from "./people.js";
import { ASKED, levelsAsked, roomLevels, shownName } from "./room_levels.js";
import { QUANTITIES, givenLimits, greatest, greatestSpeed } from "./speed.js";
import { silent, stages } from "./stages.js";
import { stopsOf } from "./stops.js";
import { unfinished } from "./unfinished.js";

const ROUNDING = 1e-11;
const RATE_TOLERANCE = 1e-06;
const AFTER_NEXT = 2;
class Report {
  constructor(plan, walk, start, end, firstContact, clearance, greatestSpeed, peaks, findings, obstacles = [], room = [], proved = false, seconds = 0.0, claims = [], speeds = [], unproved = [], unfinished = /** @type {any} */ (null), notLookedAt = []) {
    this.plan = plan;
    this.walk = walk;
    this.start = start;
    this.end = end;
    this.first_contact = firstContact;
    this.clearance = clearance;
    this.greatest_speed = greatestSpeed;
    this.peaks = peaks;
    this.findings = findings;
    this.obstacles = obstacles;
    this.room = room;
    this.proved = proved;
    this.seconds = seconds;
    this.claims = claims;
    this.speeds = speeds;
    this.unproved = unproved;
    this.unfinished = unfinished;
    this.not_looked_at = notLookedAt;
  }
  get safe() {
    return !py.truth(this.findings);
  }
  get stops() {
    return (py.truth(this.plan.cues.cue) ? stopsOf(this.walk, this.start, this.end) : null);
  }
  get decided() {
    return (!py.truth(this.findings) || py.list(this.findings).some((finding) => py.truth(finding.decided)));
  }
}
export async function checked(plan, walk, span, progress = silent, prover = /** @type {any} */ (null)) {
  let asked, began, clearance, contact, contacts, end, found, left, limited, obstacles, peaks, proved, room, speed, stage, start, told, until;
  began = py.perf_counter();
  [[start, end], asked] = py.list([span, levelsAsked(plan.people)]);
  stage = stages(progress, (py.truth(asked) ? 6 : 5));
  [contact, clearance] = py.list((await _nearness(plan, walk, span, stage, prover)));
  until = (((contact == null) || (contact.witness == null)) ? end : contact.upper);
  left = [];
  speed = (await _greatestSpeed(plan, walk, [start, until], stage(_("greatest speed"))));
  peaks = (await _limitedPeaks(plan, walk, [start, until], left, stage(_("other limits"))));
  told = stage(_("obstacles"));
  obstacles = (await _obstacles(plan, walk, [start, until], prover, left, told));
  room = [];
  if (py.truth(asked)) {
    told = stage(_("room for people"));
    {
      const caught = toldIfOpen(left, py.at(asked, -1));
      try {
        (await roomLevels(plan, walk, span, [contact, obstacles], room, py.bool(prover), told));
      } catch (error) {
        caught(error);
      } finally {
        caught.ended?.();
      }
    }
  }
  contacts = [contact, ...py.iter(py.list(obstacles).map((answers) => answers.contact))];
  contacts = py.extend(contacts, py.list(py.list(room).map((level) => level.first)).map((one) => py.and(one, () => py.at(one, 0))));
  proved = ((prover != null) && !py.truth(left));
  limited = py.dict([["speed", speed], ...py.items(peaks)]);
  found = allFindings(plan, walk, [start, until], contact, obstacles, limited, room);
  return new Report(plan, walk, start, end, contact, clearance, speed, peaks, [...py.iter(found), ...py.iter(left)], obstacles, py.tuple(room), py.and(proved, () => py.list(contacts).every((one) => ((one == null) || (one.status === "proved")))), py.sub(py.perf_counter(), began), ((prover == null) ? [] : py.tuple(prover.claims)), undefined, undefined, unfinished(plan, walk, end), notLookedAt(plan, walk, start, end));
}
async function _nearness(plan, walk, span, stage, prover) {
  let contact, end, last, margin, search, start, told, touching;
  [[start, end], margin] = py.list([span, plan.limits.margin]);
  told = stage(_("searching for contact"));
  search = ((prover == null) ? null : prover.contact);
  contact = (await firstSureContact(walk, start, end, margin, search, told));
  if (((touching = _noClearance(contact)) != null)) {
    return [contact, touching];
  }
  last = (((contact == null) || (contact.witness == null)) ? end : contact.upper);
  told = stage(_("clearance"));
  {
    const caught = toldIfOpen([]);
    try {
      return [contact, (await leastClearance(walk, start, last, undefined, undefined, told))];
    } catch (error) {
      caught(error);
    } finally {
      caught.ended?.();
    }
  }
  return [contact, (await seenClearance(walk, start, last, ((contact == null) ? margin : 0.0)))];
}
function _noClearance(contact) {
  if (((contact == null) || (contact.witness == null) || (contact.witness.gap > 0.0))) {
    return null;
  }
  if ((contact.status === "undecided")) {
    return null;
  }
  return py.replaced(contact, { value: 0.0, lower: 0.0, upper: 0.0, unit: "m" });
}
async function _obstacles(plan, walk, span, prover, left, progress) {
  let answers, found, known, n, obstacle;
  [found, known] = py.list([[], plan.obstacles()]);
  for ([n, obstacle] of py.iter(py.enumerate(known))) {
    progress((n / py.len(known)), named(obstacle));
    {
      const caught = toldIfOpen(left, obstacle);
      try {
        answers = (await obstacleAnswers(walk, obstacle, ...py.iter(span)));
        if ((prover != null)) {
          answers = prover.obstacle(walk, answers, ...py.iter(span));
        }
        py.append(found, answers);
      } catch (error) {
        caught(error);
      } finally {
        caught.ended?.();
      }
    }
  }
  return py.tuple(found);
}
async function _greatestSpeed(plan, walk, span, progress) {
  let end, limit, most, speed, start;
  [start, end] = py.list(span);
  {
    const caught = toldIfOpen([]);
    try {
      speed = (await greatestSpeed(walk, start, end, undefined, progress));
      for (limit of py.iter([plan.limits.speed, plan.people.most_speed])) {
        if (((limit != null) && (keeps(speed, limit) == null))) {
          most = (limit * (1.0 + ROUNDING));
          speed = (await greatest(walk, py.at(QUANTITIES, "speed"), start, end, undefined, most));
        }
      }
      return speed;
    } catch (error) {
      caught(error);
    } finally {
      caught.ended?.();
    }
  }
  return speedAtStart(walk, start);
}
async function _limitedPeaks(plan, walk, span, left, progress) {
  let end, limit, limits, n, name, peaks, start;
  limits = py.dict(py.list(py.items(givenLimits(plan))).flatMap(([name, limit]) => (((name !== "speed")) ? [[name, limit]] : [])));
  [peaks, [start, end]] = py.list([py.dict([]), span]);
  for ([n, [name, limit]] of py.iter(py.enumerate(py.items(limits)))) {
    {
      const caught = toldIfOpen(left, name, limit);
      try {
        py.set(peaks, name, (await greatest(walk, py.at(QUANTITIES, name), start, end, RATE_TOLERANCE, (limit * (1.0 + ROUNDING)))));
      } catch (error) {
        caught(error);
      } finally {
        caught.ended?.();
      }
    }
    progress(((n + 1) / py.len(limits)), "");
  }
  return peaks;
}
export function peakText(name) {
  return py.filled(_("greatest {what}"), { what: _(py.at(QUANTITIES, name).text) });
}
export function sentence(report, told = /** @type {any} */ (null)) {
  let count, text;
  if (py.truth(report.safe)) {
    return py.filled(_("Safe: {tightest}"), { tightest: kept(report, told) });
  }
  text = _briefly(py.min(report.findings, _soonest));
  count = py.len(report.findings);
  if ((count > 1)) {
    text = py.filled(_("{finding} (one of {count} findings)"), { finding: text, count: count });
  }
  if (!py.truth(report.decided)) {
    return py.filled(_("Undecided: {finding}"), { finding: text });
  }
  return py.filled(_("Not safe: {finding}"), { finding: text });
}
export const BRIEF = py.dict([["contact", N_("benches {a} and {b} touch at {t} s")], ["margin", N_("benches {a} and {b} come nearer than the {margin} m asked for at {t} s")], ["obstacle", N_("bench {a} touches {name} at {t} s")], ["obstacle_margin", N_("bench {a} comes nearer than {margin} m to {name} at {t} s")], ["venue", N_("bench {a} leaves {name} at {t} s")], ["venue_margin", N_("bench {a} comes nearer than {margin} m to the edge of {name} at {t} s")], ["sway", N_("benches {a} and {b} have no room to sway at {t} s")], ["imprecision", N_("benches {a} and {b} have no room for imprecision at {t} s")], ["people", N_("the people of benches {a} and {b} have no room at {t} s")]]);
function _soonest(found) {
  let time, touch;
  time = ((found.time == null) ? Infinity : found.time);
  touch = py.has(BRIEF, found.kind);
  return [!py.truth(found.decided), !py.truth(touch), (py.truth(touch) ? time : 0.0)];
}
function _briefly(found) {
  if ((!py.has(BRIEF, found.kind) || !py.truth(found.decided) || (found.time == null))) {
    return found.text;
  }
  if ((py.has(ASKED, found.kind) && py.truth(found.obstacle))) {
    return found.text;
  }
  return py.filled(_(py.at(BRIEF, found.kind)), { a: py.at(found.benches, 0), b: py.at(found.benches, -1), t: seconds(found.time), margin: `${py.format(found.limit, `g`)}`, name: (py.has(found.words, "name") ? found.said("name") : "") });
}
export function kept(report, told = /** @type {any} */ (null)) {
  let limits, name, near, quantity, said, text, what;
  [near, limits] = py.list([report.clearance.witness, report.plan.limits]);
  said = [_("no two benches come near one another")];
  if (((near != null) && (near.time != null) && (py.len(near.benches) === 2))) {
    said = [_tightest(report, near.time, near.benches, told)];
  }
  if (py.truth(limits.margin)) {
    py.append(said, py.filled(_("{margin} m were asked for"), { margin: `${py.format(limits.margin, `g`)}` }));
  }
  said = py.extend(said, _keptFrom(report));
  if (py.truth(report.room)) {
    text = _("room is kept {levels}");
    py.append(said, py.filled(text, { levels: py.join(_(", "), py.list(py.slice(report.room, 1, null)).map((one) => shownName(one))) }));
  }
  if ((limits.speed != null)) {
    text = _("fastest handle {speed} m/s of {limit} m/s allowed");
    py.append(said, py.filled(text, { speed: speedText(report), limit: `${py.format(limits.speed, `g`)}` }));
  }
  for (name of py.iter(report.peaks)) {
    quantity = py.at(QUANTITIES, name);
    py.append(said, py.filled(_("{what} at most {most} {unit} of {limit} {unit} allowed"), { what: _(quantity.text), most: peakShown(report, name), limit: `${py.format(py.at(givenLimits(report.plan), name), `g`)}`, unit: quantity.unit }));
  }
  if ((report.unfinished != null)) {
    py.append(said, ((told == null) ? report.unfinished.text : report.unfinished.told));
  }
  if (py.truth(report.unproved)) {
    what = py.join(_(", "), py.list(report.unproved).map((one) => _(py.at(PROOFS, one.kind))));
    py.append(said, py.filled(_("not proved: {what}"), { what: what }));
  }
  if (py.truth(report.not_looked_at)) {
    what = py.join(_(", "), py.list(report.not_looked_at).map((one) => one.brief));
    py.append(said, py.filled(_("not checked: {what}"), { what: what }));
  }
  return py.join(_("; "), said);
}
function _tightest(report, time, benches, told) {
  let a, b, gap, hidden, names, text;
  [[a, b], gap, hidden] = py.list([benches, clearanceText(report), vanishing(report.clearance)]);
  if ((py.truth(inOneCoil(benches)) && !py.truth(hidden))) {
    text = _("none come nearer than two with one between them, which keep {gap} m in the bends");
    return py.filled(text, { gap: gap });
  }
  if ((told == null)) {
    text = _("tightest {gap} m, bench {a} with bench {b}, at {t} s");
    if (py.truth(hidden)) {
      text = _("tightest less than {gap} m, bench {a} with bench {b}, at {t} s");
    }
    return py.filled(text, { gap: gap, a: a, b: b, t: seconds(time) });
  }
  text = _("tightest {gap} m, {a} with {b}, at {t}");
  if (py.truth(hidden)) {
    text = _("tightest less than {gap} m, {a} with {b}, at {t}");
  }
  names = py.list(benches).map((one) => called(report.plan.people, one, py.len(report.walk.dragon)));
  return py.filled(text, { gap: gap, a: py.at(names, 0), b: py.at(names, 1), t: told.tell(time) });
}
export function inOneCoil(benches) {
  return ((py.len(benches) === 2) && py.eq(py.abs(py.sub(py.at(benches, 0), py.at(benches, 1))), AFTER_NEXT));
}
function clearanceText(report) {
  return shown(report.clearance, false, report.plan.limits.margin);
}
function speedText(report) {
  return shown(report.greatest_speed, true, report.plan.limits.speed);
}
function peakShown(report, name) {
  return shown(py.at(report.peaks, name), true, py.at(givenLimits(report.plan), name));
}
function _keptFrom(report) {
  let asked, kept, near, one, said, stands, text, venue;
  venue = py.list(report.obstacles).flatMap((one) => (((one.obstacle.kind === "venue")) ? [one] : []));
  stands = py.list(report.obstacles).flatMap((one) => (((one.obstacle.kind !== "venue")) ? [one] : []));
  near = py.slice(py.sorted(stands, (one) => py.sub(sure(one.distance, false), one.obstacle.margin)), null, 1);
  said = [];
  for (one of py.iter([...py.iter(venue), ...py.iter(near)])) {
    text = _("at least {gap} m from {name}");
    if (py.has(venue, one)) {
      text = _("at least {gap} m from the edge of {name}");
    }
    else {
      if ((py.len(stands) > 1)) {
        text = _("at least {gap} m from {name}, the narrowest of {count} obstacles");
      }
    }
    if (py.truth(vanishing(one.distance))) {
      text = _("less than {gap} m from {name}");
      if (py.has(venue, one)) {
        text = _("less than {gap} m from the edge of {name}");
      }
    }
    kept = py.filled(text, { gap: shown(one.distance, false, one.obstacle.margin), name: named(one.obstacle), count: py.len(stands) });
    if (py.truth(one.obstacle.margin)) {
      asked = `${py.format(one.obstacle.margin, `g`)}`;
      kept = py.filled(_("{kept} ({margin} m asked for)"), { kept: kept, margin: asked });
    }
    py.append(said, kept);
  }
  return said;
}
