// The evidence of a verdict, for those who check: each answer with its bracket, how it was established, where.

import { bracketed } from "./compute/answer.js";
import { figures } from "./compute/number_format.js";
import { shown, sure } from "./made/answer.js";
import { seconds } from "./made/number_format.js";
import { make, textButton } from "./elements.js";
import { _, language } from "./words.js";

/** @typedef {import("./messages").Answer} Answer */
/** @typedef {import("./messages").ObstacleRecord} ObstacleRecord */
/** @typedef {import("./messages").Verdict} Verdict */

/** @param {Answer["status"]} status */
function statusText(status) {
  return {
    proved: _("proved"),
    found: _("found"),
    infeasible: _("no solution"),
    undecided: _("undecided"),
    unlimited: _("unlimited"),
  }[status];
}

/** A size that was found, as the command line tells it: what is surely at most, or at least, so much. @param {Answer} answer @param {boolean} up */
export function sizeText(answer, up) {
  if (answer.value === null) return statusText(answer.status);
  return `${figures(sure(bracketed(answer), up), up)} ${answer.unit}`;
}

/** What a check found, as all texts tell it. @param {Answer} answer @param {boolean} up @param {number | null} limit */
function valueText(answer, up, limit) {
  if (answer.value === null)
    return answer.status === "found" ? _("no pair counts") : statusText(answer.status);
  return `${shown(bracketed(answer), up, limit)} ${answer.unit}`;
}

/** A size and how it was established. @param {Answer} answer @param {boolean} up */
export function answerText(answer, up) {
  const value = sizeText(answer, up);
  if (answer.value === null) return value;
  return _("{value} ({how})", { value, how: statusText(answer.status) });
}

/** A handle with its place, as the program names it; the bench is the last for the tail's rear. @param {number} handle @param {number} bench */
function handleText(handle, bench) {
  let where = _("between benches {a} and {b}", { a: handle, b: handle + 1 });
  if (handle === 0) where = _("front of bench 1");
  else if (handle === bench) where = _("rear of bench {bench}", { bench });
  return _("handle {handle} ({where})", { handle, where });
}

/** @param {Answer} answer */
function whereText({ witness }) {
  if (!witness) return "";
  const [a, b] = witness.benches;
  const time = witness.time === null ? "\u2013" : seconds(witness.time);
  if (witness.handle !== null)
    return _("{handle}, t = {time} s", { handle: handleText(witness.handle, a), time });
  return b
    ? _("benches {a} and {b}, t = {time} s", { a, b, time })
    : _("bench {a}, t = {time} s", { a, time });
}

/** @param {string} name @param {Answer | null} answer @param {string} value @param {((time: number) => void) | null} jump @param {string} [place] where and when, in words */
function row(name, answer, value, jump, place = answer ? whereText(answer) : "") {
  if (!answer)
    return make(
      "tr",
      {},
      make("th", { scope: "row" }, name),
      make("td", { colspan: "4" }, _("does not happen")),
    );
  const { lower, upper } = answer;
  const bracket =
    lower === null || upper === null
      ? "\u2013"
      : make("span", {}, String(lower), make("br"), String(upper));
  const time = answer.witness?.time ?? null;
  const where = time === null || jump === null ? place : textButton(place, () => jump(time));
  return make(
    "tr",
    {},
    make("th", { scope: "row" }, name),
    ...[value, bracket, statusText(answer.status), where].map((cell) => make("td", {}, cell)),
  );
}

/** The row of a size that was sought: its moment is of the dance with that size, which the player does not show. @param {string} name @param {Answer} answer */
export function limitRow(name, answer) {
  const where = whereText(answer);
  return row(
    name,
    answer,
    sizeText(answer, true),
    null,
    where && _("in the dance of that size: {where}", { where }),
  );
}

/** Rows of an obstacle: the least distance from it, and when a bench first comes too near. @param {ObstacleRecord} one @param {((time: number) => void) | null} go */
function obstacleRows({ shown: called, kind, margin, contact, distance }, go) {
  const name = called[language()];
  const least =
    kind === "venue"
      ? _("least distance from the edge of {name}", { name })
      : _("least distance from {name}", { name });
  const rows = [row(least, distance, valueText(distance, false, margin), go)];
  const near = _("margin from {name} not kept", { name });
  if (contact) rows.unshift(row(near, contact, valueText(contact, false, null), go));
  return rows;
}

/**
 * All numbers of a verdict, for those who check.
 * @param {Verdict} verdict
 * @param {Record<string, any>} limits those of its plan
 * @param {((time: number) => void) | null} go null where the player shows another dance
 */
export function evidence(verdict, limits, go) {
  const heads = [_("answer"), _("value"), _("bracket"), _("how established"), _("where and when")];
  const told = (/** @type {Answer | null} */ answer, up = false, limit = null) =>
    answer ? valueText(answer, up, typeof limit === "number" ? limit : null) : "";
  const { first_contact: contact, clearance, greatest_speed: speed } = verdict;
  const rows = [
    row(_("first contact"), contact, told(contact), go),
    row(_("least clearance"), clearance, told(clearance, false, limits.margin), go),
    row(_("greatest speed of a handle"), speed, told(speed, true, limits.speed), go),
    ...verdict.obstacles.flatMap((one) => obstacleRows(one, go)),
    ...verdict.peaks.map(({ name, text, peak }) =>
      row(text[language()], peak, told(peak, true, limits[name]), go),
    ),
  ];
  return make(
    "details",
    { class: "evidence" },
    make("summary", {}, _("for those who check: all numbers")),
    make("p", {}, verdict.sentence[language()]),
    make(
      "ul",
      {},
      ...[...verdict.findings, ...verdict.not_looked_at].map(({ text }) =>
        make("li", {}, text[language()]),
      ),
    ),
    make(
      "div",
      { class: "scroll" },
      make(
        "table",
        {},
        make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))),
        make("tbody", {}, ...rows),
      ),
    ),
    make(
      "p",
      { class: "source" },
      _(
        "Found: every bracket rests on bounds that allow for rounding; nothing is sampled. Proved: shown again in ball arithmetic, without the search. Walk from {start} s to {end} s; plan {hash}, benchdragon {version}.",
        {
          start: seconds(verdict.start ?? 0),
          end: seconds(verdict.end ?? 0),
          hash: verdict.plan_sha256.slice(0, 12),
          version: verdict.version,
        },
      ),
    ),
  );
}
