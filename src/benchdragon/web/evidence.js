// The evidence of a verdict: each answer with its bracket, how it was established, and where.

import { make } from "./elements.js";
import { _, language, decimals } from "./words.js";

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

/** An answer's value, as far as its bracket says. @param {Answer} answer */
export function valueText(answer) {
  if (answer.value === null)
    return answer.status === "found" ? _("no pair counts") : statusText(answer.status);
  const width = answer.lower === null || answer.upper === null ? 0 : answer.upper - answer.lower;
  let digits = width > 0 ? Math.min(Math.max(Math.ceil(-Math.log10(width)), 2), 9) : 6;
  // Rounding must not carry a value out of its own bracket.
  while (width > 0 && digits < 9 && !within(answer, Number(answer.value.toFixed(digits)))) digits++;
  return `${decimals(answer.value, digits)} ${answer.unit}`;
}

/** @param {Answer} answer @param {number} value */
function within({ lower, upper }, value) {
  return lower !== null && upper !== null && lower <= value && value <= upper;
}

/** An answer's value and how it was established. @param {Answer} answer */
export function answerText(answer) {
  const value = valueText(answer);
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
  const time = witness.time === null ? "\u2013" : decimals(witness.time, 3);
  if (witness.handle !== null)
    return _("{handle}, t = {time} s", { handle: handleText(witness.handle, a), time });
  return b
    ? _("benches {a} and {b}, t = {time} s", { a, b, time })
    : _("bench {a}, t = {time} s", { a, time });
}

/** @param {string} name @param {Answer | null} answer @param {((time: number) => void) | null} jump */
function row(name, answer, jump) {
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
  const where =
    time === null || jump === null
      ? whereText(answer)
      : make("button", { type: "button", onclick: () => jump(time) }, whereText(answer));
  return make(
    "tr",
    {},
    make("th", { scope: "row" }, name),
    ...[valueText(answer), bracket, statusText(answer.status), where].map((cell) =>
      make("td", {}, cell),
    ),
  );
}

/** Rows of an obstacle: the least distance from it, and when a bench first comes too near. @param {ObstacleRecord} one @param {((time: number) => void) | null} go */
function obstacleRows({ shown, kind, contact, distance }, go) {
  const name = shown[language()];
  const least =
    kind === "venue"
      ? _("least distance from the edge of {name}", { name })
      : _("least distance from {name}", { name });
  const rows = [row(least, distance, go)];
  if (contact) rows.unshift(row(_("margin from {name} not kept", { name }), contact, go));
  return rows;
}

/**
 * A dialog with the evidence.
 * @param {Verdict} verdict
 * @param {Answer | null} pitch
 * @param {((time: number) => void) | null} jump null where the player shows another dance
 */
export function evidenceDialog(verdict, pitch, jump) {
  const go =
    jump &&
    ((/** @type {number} */ time) => {
      dialog.close();
      jump(time);
    });
  const heads = [_("answer"), _("value"), _("bracket"), _("how established"), _("where and when")];
  const rows = [
    row(_("first contact"), verdict.first_contact, go),
    row(_("least clearance"), verdict.clearance, go),
    row(_("greatest speed of a handle"), verdict.greatest_speed, go),
    ...verdict.obstacles.flatMap((one) => obstacleRows(one, go)),
    ...verdict.peaks.map(({ text, peak }) => row(text[language()], peak, go)),
    ...(pitch && pitch.plan_sha256 === verdict.plan_sha256
      ? [row(_("smallest pitch"), pitch, go)]
      : []),
  ];
  const dialog = make(
    "dialog",
    { class: "evidence", "aria-label": _("evidence"), onclose: () => dialog.remove() },
    make("h2", {}, verdict.sentence[language()]),
    ...verdict.findings.map(({ text }) => make("p", {}, text[language()])),
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
          start: decimals(verdict.start ?? 0, 1),
          end: decimals(verdict.end ?? 0, 1),
          hash: verdict.plan_sha256.slice(0, 12),
          version: verdict.version,
        },
      ),
    ),
    make("form", { method: "dialog" }, make("button", {}, _("close"))),
  );
  return dialog;
}
