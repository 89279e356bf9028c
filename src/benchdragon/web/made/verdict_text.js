// @ts-nocheck
// Made from analysis/check.py by tools/make_twins.py; to make it again: make types

import { py } from "../compute/python.js";
import { N_, _ } from "../words.js";
import { shown, sure, vanishing } from "./answer.js";
import { named } from "./findings.js";
import { PROOFS } from "./left_open.js";
import { seconds } from "./number_format.js";
import { called } from "./people.js";
import { QUANTITIES, givenLimits } from "./quantities.js";
import { ASKED, shownName } from "./room_levels.js";

const AFTER_NEXT = 2;
const BRIEF = py.dict([["contact", N_("benches {a} and {b} touch at {t} s")], ["margin", N_("benches {a} and {b} come nearer than the {margin} m asked for at {t} s")], ["obstacle", N_("bench {a} touches {name} at {t} s")], ["obstacle_margin", N_("bench {a} comes nearer than {margin} m to {name} at {t} s")], ["venue", N_("bench {a} leaves {name} at {t} s")], ["venue_margin", N_("bench {a} comes nearer than {margin} m to the edge of {name} at {t} s")], ["sway", N_("benches {a} and {b} have no room to sway at {t} s")], ["imprecision", N_("benches {a} and {b} have no room for imprecision at {t} s")], ["people", N_("the people of benches {a} and {b} have no room at {t} s")]]);
export function peakText(name) {
  return py.filled(_("greatest {what}"), { what: _(py.at(QUANTITIES, name).text) });
}
export function sentence(report, told = /** @type {any} */ (null)) {
  let count, text;
  if (py.truth(report.safe)) {
    return py.filled(_("Safe: {tightest}"), { tightest: _kept(report, told) });
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
function _kept(report, told) {
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
    py.append(said, py.filled(_("fastest handle {speed} m/s of {limit} m/s allowed"), { speed: speedText(report), limit: `${py.format(limits.speed, `g`)}` }));
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
    py.append(said, py.filled(_("not looked at: {what}"), { what: what }));
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
