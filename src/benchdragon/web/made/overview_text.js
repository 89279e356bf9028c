// @ts-nocheck
// Made from explain/overview_text.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { tightestLine } from "./bench_text.js";
import { kept } from "./check.js";
import { Clock, lasting } from "./clock.js";
import { comingLines } from "./coming.js";
import { called } from "./people.js";
import { levelLine, plainAsked } from "./room_text.js";
import { whereabouts } from "./whereabouts.js";

const REACH = 1.5;
const MOST_TIGHT = 3;
const TIGHT_APART = 3.0;
class OverviewText {
  constructor(verdict, tightest, coming, leaving, room, starts) {
    this.verdict = verdict;
    this.tightest = tightest;
    this.coming = coming;
    this.leaving = leaving;
    this.room = room;
    this.starts = starts;
  }
}
export function overviewText(report, benches, ground) {
  let clock, coming, leaving, span, text;
  [clock, span] = py.list([new Clock(report.plan.cues.clock, report.start), [report.start, report.end]]);
  text = py.filled(_("{all}."), { all: kept(report, clock) });
  [coming, leaving] = py.list(comingLines(report.plan, report.walk, span, ground));
  return new OverviewText([py.filled(_("Safe for the whole dance: {long}."), { long: lasting(py.sub(report.end, report.start)) }), py.add(py.upper(py.slice(text, null, 1)), py.slice(text, 1, null)), clock.legend], py.tuple(_tightest(report, benches, ground, clock)), py.tuple(coming), py.tuple(leaving), py.tuple(py.list(report.room).map((level) => levelLine(level, plainAsked))), py.tuple(py.list(benches).map((one) => whereabouts(report.plan, ground, one.place))));
}
function* _tightest(report, benches, ground, clock) {
  let _gap, bench, elsewhere, near, seen, text, tightest, told;
  function name(bench) {
    return called(report.plan.people, bench, py.len(benches));
  }
  near = py.list(benches).flatMap((one) => ((py.truth(one.tightest)) ? [[one.tightest.upper, one.bench, one.tightest]] : []));
  told = py.set_of();
  seen = [];
  for ([_gap, bench, tightest] of py.iter(py.sorted(near, (one) => py.slice(one, null, 2)))) {
    elsewhere = py.list(seen).every((place) => (py.dist(tightest.place, place) >= TIGHT_APART));
    if (((py.len(seen) < MOST_TIGHT) && py.truth(elsewhere) && !py.has(told, bench) && !py.has(told, tightest.bench))) {
      told = py.merge(told, py.set_of([bench, tightest.bench]));
      py.append(seen, tightest.place);
      yield py.filled(_("{bench} ({place}): {tightest}"), { bench: name(bench), place: whereabouts(report.plan, ground, tightest.place), tightest: tightestLine(tightest, clock, name, true) });
    }
  }
  if (!py.truth(seen)) {
    text = _("No bench of another coil comes within about {reach} m of any: for that nobody need watch.");
    yield py.filled(text, { reach: `${py.format(REACH, `g`)}` });
  }
}
