// @ts-nocheck
// Made from explain/timetable_text.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { countedIn, scoreOf } from "./beats.js";
import { Clock, lasting } from "./clock.js";
import { stopsOf, stopsSentence } from "./stops.js";
import { whereabouts } from "./whereabouts.js";

const NONE = "-";
class TimetableText {
  constructor(name, columns, rows, lines) {
    this.name = name;
    this.columns = columns;
    this.rows = rows;
    this.lines = lines;
  }
}
export function timetableText(plan, walk, span, ground, passings) {
  let clock, columns, count, end, lines, rows, score, start, tail;
  [start, end] = py.list(span);
  [clock, tail] = py.list([new Clock(plan.cues.clock, start), py.list(passings).some((row) => (row.tail != null))]);
  columns = [_("place"), _("where it is"), _("way (m)"), _("head"), _("tail")];
  count = (py.truth(tail) ? py.len(columns) : (py.len(columns) - 1));
  rows = py.list(passings).map((row) => py.slice(_cells(plan, row, clock, ground), null, count));
  score = scoreOf(plan, start, end);
  lines = [py.filled(_("The whole dance lasts {long}."), { long: lasting(py.sub(end, start)) }), clock.legend, stopsSentence(stopsOf(walk, start, end), clock), py.filled(_("Drum: {tempo}."), { tempo: tempoText(plan, score) }), ...py.iter(_countIn(score, start)), ...py.iter(toldSentences(passings)), ground.ways_legend];
  return new TimetableText((py.truth(tail) ? _("When head and tail pass") : _("When the head passes")), py.slice(columns, null, count), py.tuple(rows), py.tuple(py.list(lines).flatMap((line) => ((py.truth(line)) ? [line] : []))));
}
function _cells(plan, row, clock, ground) {
  let head, where;
  function at(time) {
    return ((time == null) ? NONE : clock.tell(time));
  }
  head = at(row.head);
  if (((row.until != null) && (row.head != null) && (row.until > row.head))) {
    head = py.filled(_("{start} to {end}"), { start: head, end: at(row.until) });
  }
  where = whereabouts(plan, ground, row.point);
  return [row.name, where, `${py.format(row.way, `z.2f`)}`, head, at(row.tail)];
}
function* _countIn(score, start) {
  let first, text;
  first = py.slice(countedIn(score).runs, null, 1);
  if ((py.truth(first) && (py.at(first, 0).start < start))) {
    text = _("The sound file counts {beats} beats in: the head sets out on the next one.");
    yield py.filled(text, { beats: py.at(first, 0).beats() });
  }
}
function toldSentences(passings) {
  let said;
  if (py.list(passings).every((row) => (row.tail == null))) {
    return [_("The dance ends before the tail comes as far as any of these: only the head is told of, by its front handle.")];
  }
  said = [_("The head is there with its front handle, the tail with its last handle: then all have passed. The tail's own sheet tells of its front handle, which is there a little earlier.")];
  if (py.list(passings).some((row) => ((row.head == null) || (row.tail == null)))) {
    py.append(said, _("-: the head, or the tail, does not pass there while the dance lasts."));
  }
  return said;
}
function tempoText(plan, score) {
  let tempo, text;
  tempo = `${py.format(score.tempo, `.4g`)}`;
  if (!py.truth(score.by_step)) {
    return py.filled(_("{tempo} beats a minute, as the plan says"), { tempo: tempo });
  }
  text = _("{tempo} beats a minute: a step of {step} cm a beat at the head's speed");
  return py.filled(text, { tempo: tempo, step: `${py.format((100.0 * plan.people.step), `g`)}` });
}
