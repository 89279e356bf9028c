// @ts-nocheck
// Made from explain/proposal.py by tools/make_twins.py; to make it again: make generate

import { py } from "../compute/python.js";
import { _ } from "../words.js";
import { lasting } from "./clock.js";
import { courseOf } from "./course.js";

export function proposalLines(found, wishes, again) {
  let course, lines, longer, text;
  course = courseOf(found.plan);
  lines = [py.filled(_("All {count} benches fit."), { count: wishes.benches })];
  if ((course.rounds >= 1.0)) {
    text = _("The dragon begins coiled: it stands in {rounds} rounds before it sets out.");
    py.append(lines, py.filled(text, { rounds: `${py.format(course.rounds, `.1f`)}` }));
  }
  else {
    py.append(lines, _("The dragon begins uncoiled: it stands in less than one round."));
  }
  text = _("The head walks {way} m in {time}, in towards the middle; it does not come out again.");
  if (py.truth(course.out)) {
    text = _("The head walks {way} m in {time}: in, round, and out again.");
  }
  if (py.truth(course.inside)) {
    text = _("The head walks {way} m in {time}: it stands inside at first, turns, and comes out. The dance ends when the tail has turned; then all walk on out.");
  }
  py.append(lines, py.filled(text, { way: `${py.format(course.way, `.0f`)}`, time: lasting(course.seconds) }));
  lines = py.extend(lines, _roundsLines(found, wishes));
  if (py.truth(found.plan.route.after_street)) {
    py.append(lines, _("It comes by the street, which stays as it was."));
  }
  lines = py.extend(lines, leftLines(found, wishes));
  if (py.truth(found.less_ahead)) {
    text = _("Before the head there is {room} m of room, less than usual, so that all of them fit.");
    py.append(lines, py.filled(text, { room: `${py.format(found.plan.people.ahead, `g`)}` }));
  }
  if (py.truth(found.slower)) {
    text = _("The head walks at {speed} m/s, or benches behind it would be too fast.");
    py.append(lines, py.filled(text, { speed: `${py.format(found.plan.walk.speed, `g`)}` }));
  }
  longer = _longer(wishes);
  if (py.truth(course.short)) {
    text = _("WARNING: {time} is hardly a dance. It gets longer with {ways}.");
    py.append(lines, py.filled(text, { time: lasting(course.seconds), ways: longer }));
  }
  else {
    if (!py.truth(course.out)) {
      py.append(lines, py.filled(_("Room to come out again, or for longer: {ways}."), { ways: longer }));
    }
  }
  if (py.truth(again)) {
    text = _("With {count} benches it comes out again: no more of them have the room.");
    py.append(lines, py.filled(text, { count: again }));
  }
  return lines;
}
export function leftLines(found, wishes) {
  if (((wishes.street == null) || py.truth(found.plan.route.after_street))) {
    return [];
  }
  return [_("No dance of these benches was found to which the street leads: it is left out.")];
}
function _roundsLines(found, wishes) {
  let kept, text;
  if ((wishes.rounds === 1)) {
    return [];
  }
  kept = ((found.plan.route.kind === "turn") ? found.plan.value("route.rounds") : 1);
  text = _("No dance of {rounds} rounds was found that fits: it coils once.");
  if ((kept > 1)) {
    text = _("It coils in and out {rounds} times.");
  }
  return [py.filled(text, { rounds: wishes.rounds })];
}
export function refusalLines(wishes, found) {
  let length, lines, text, values, width;
  [length, width] = py.list(py.list(found.rectangle).map((side) => `${py.format(side, `g`)}`));
  text = _("{benches} benches do not fit on this square: the dance that takes the least room of those tried needs {length} m by {width} m, room for people and margins included.");
  if ((wishes.radius != null)) {
    text = _("{benches} benches do not fit on this square: the dance that takes the least room of those tried needs a radius of {radius} m, room for people and margins included.");
  }
  values = py.dict([["benches", wishes.benches], ["length", length], ["width", width]]);
  lines = [py.filled(text, { ...py.object(values), radius: `${py.format(found.radius, `g`)}` })];
  if (py.truth(wishes.obstacles)) {
    py.append(lines, _("That is a square on which nothing else stands."));
  }
  if (py.truth(found.under)) {
    py.append(lines, _("All of them fit if their bearers walk under them, not beside them."));
  }
  if (py.truth(found.benches)) {
    py.append(lines, py.filled(_("A dragon of {count} such benches fits."), { count: found.benches }));
  }
  return lines;
}
function _longer(wishes) {
  let under;
  under = ((wishes.carry === "beside") ? [_("bearers under their benches")] : []);
  return py.join(_(", or "), [_("fewer benches"), ...py.iter(under), _("a larger square")]);
}
