// @ts-nocheck
// Made from solve/size.py by tools/make_twins.py; to make it again: make generate

import { InputError, PlanError } from "../compute/error_kinds.js";
import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { Answer } from "./answer.js";
import { standAlone } from "./contact_search.js";
import { notNegative } from "./errors.js";
import { HeadTimes } from "./head_times.js";
import { touching } from "./obstacles.js";
import { PlanFamily, question } from "./size_family.js";
import { SizeQuestion } from "./size_question.js";
import { silent } from "./stages.js";

const TOLERANCE = 1e-12;
const FAR = 10.0;
export async function foundLimit(plan, name, margin = /** @type {any} */ (null), tolerance = TOLERANCE, progress = silent) {
  return py.scoped(async () => {
    let began, ending, family, search;
    [began, family] = py.list([py.perf_counter(), _family(plan, name, margin, tolerance)]);
    search = new SizeQuestion(family, progress);
    try {
      ending = (await search.limit(family.first));
      return (await _limitAnswer(family, search, ending, began));
    } finally {
      search.free();
    }
  });
}
async function _limitAnswer(family, search, ending, began) {
  let bad, evaluations, good, lower, none, seconds, status, texts, unsure, upper, value, witness;
  [good, bad, value] = py.list(py.list([5, 6, 17]).map((column) => py.float(py.at(search.state, column))));
  [texts, evaluations] = py.list([_assumed(family, search.doubts), search.evaluations]);
  seconds = py.sub(py.perf_counter(), began);
  if (py.eq(ending, 5)) {
    none = (py.truth(search.doubts) ? "undecided" : "infeasible");
    return new Answer(NaN, -Infinity, Infinity, "m", none, null, texts, evaluations, seconds);
  }
  unsure = py.or(py.eq(ending, 6), () => search.in_doubt);
  bad = (py.eq(ending, 4) ? bad : (await search.surely_bad(good, bad)));
  status = (py.truth(unsure) ? "undecided" : (py.eq(ending, 4) ? "unlimited" : "found"));
  [lower, upper] = py.list(py.sorted([good, bad]));
  witness = (await _witness(family, search, bad));
  value = py.min(py.max(value, lower), upper);
  return new Answer(value, lower, upper, "m", status, witness, texts, evaluations, seconds);
}
function _family(plan, name, margin, tolerance = TOLERANCE) {
  let centre, family, kept;
  kept = notNegative("margin", ((margin == null) ? plan.limits.margin : margin), "m");
  family = new PlanFamily(plan, question(name), kept, tolerance);
  centre = ((plan.disc.radius == null) && (plan.walk.end == null));
  if (((name !== "disc") && (plan.route.kind === "spiral-in") && py.truth(centre))) {
    throw new InputError(_("say how far in the head comes: set disc.radius=4.5, for example"));
  }
  return family;
}
async function _witness(family, found, size) {
  let end, first, last, meeting, number, start, times, touches, walk;
  [meeting, number] = py.list([found.guide, found.blocked(size)]);
  if (((meeting == null) && (number == null))) {
    return null;
  }
  try {
    [walk, start, end] = py.list(family.walk(size));
  } catch (error) {
    if (error instanceof InputError || error instanceof PlanError) {
      return null;
    } else
    throw error;
  }
  if ((number != null)) {
    touches = (await touching(walk, py.at(family.plan.obstacles(), number), start, end));
    return (py.truth(touches) ? py.at(touches, -1).witness : null);
  }
  if ((meeting == null)) {
    return null;
  }
  [first, last] = py.list(py.tolist(walk.head_position([start, end])));
  times = new HeadTimes(walk, first, start);
  return standAlone(walk, times, py.min(meeting.s, last), meeting.i, meeting.j);
}
function _assumed(family, unsure) {
  let text, texts;
  texts = [py.filled(_("benches keep {margin} m"), { margin: `${py.format(family.margin, `g`)}` }), _("sizes beyond the bracket were not tried")];
  if (py.truth(family.plan.obstacles())) {
    text = _("the venue and obstacles count: other sizes may be safe as well, --range tries them; none over {far} times the plan's own was tried, and none that much smaller");
    py.append(texts, py.filled(text, { far: `${py.format(FAR, `g`)}` }));
  }
  return (py.truth(unsure) ? [...py.iter(texts), undecidedText(unsure)] : py.tuple(texts));
}
function undecidedText(sizes) {
  let text;
  text = _("{count} of the sizes tried, from {low} m to {high} m, are undecided");
  return py.filled(text, { count: py.len(sizes), low: `${py.format(py.min(sizes), `.6g`)}`, high: `${py.format(py.max(sizes), `.6g`)}` });
}
