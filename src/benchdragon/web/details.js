// What is behind the verdict's word: each finding in plain words, what mends it, and all numbers for who checks.

import { make, textButton } from "./elements.js";
import { evidence, limitRow } from "./evidence.js";
import { BRIEF } from "./made/check.js";
import { distinct, mendable, orNothing, remedies } from "./remedies.js";
import { Refusal } from "./standing.js";
import { STATE_SIGNS } from "./telling.js";
import { markText, nearestText, notChecked, stateOf, wordOf } from "./verdict_word.js";
import { N_, _, decimals, language } from "./words.js";

/** @typedef {import("./messages").Answer} Answer */
/** @typedef {import("./messages").Finding} Finding */
/** @typedef {import("./messages").Verdict} Verdict */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./remedies.js").Ask} Ask */
/** @typedef {import("./standing.js").Answers} Answers */

/**
 * What is told of a plan.
 * @typedef {object} Told
 * @property {Plan} plan
 * @property {Verdict | null} found its verdict, if there is one
 * @property {string} sentence that in words, or why there is none
 * @property {((time: number) => void) | null} jump to a time of its dance; null where the player shows another
 * @property {(plan: Plan) => void} take another plan in its place
 */

/** Findings in plain words, beside those that verdicts tell in few; what leaders never meet stays as it is. @type {Record<string, string>} */
const PLAIN = {
  speed: N_("bench {a} is as fast as {value} m/s at {t} s; {limit} m/s are allowed"),
  most_speed: N_("bench {a} is as fast as {value} m/s at {t} s; it can be carried at {limit} m/s"),
};
const ROOM = ["sway", "imprecision", "people"];

/** Two decimals; what is too much is rounded up. @param {number | null} size @param {boolean} [up] */
function few(size, up = false) {
  return decimals(up ? Math.ceil(100 * (size ?? 0) - 1e-9) / 100 : (size ?? 0), 2);
}

/** A finding as people read it. @param {Finding} finding @param {Verdict} verdict */
function plainText({ kind, decided, text, benches, time, value, limit, obstacle }, { obstacles }) {
  const alone = ROOM.includes(kind) && obstacle;
  const plain = alone
    ? N_("bench {a} has too little room at {name} at {t} s")
    : (BRIEF.get(kind) ?? PLAIN[kind]);
  if (!plain || !decided || time === null) return text[language()];
  const [a, b] = [benches[0], benches[benches.length - 1]];
  const name = obstacles.find((one) => one.name === obstacle)?.shown[language()] ?? "";
  const most = few(limit);
  const words = {
    a,
    b,
    name,
    t: decimals(time, 1),
    value: few(value, true),
    limit: most,
    margin: most,
  };
  return _(plain, words);
}

/** A finding with the way to its moment, and room for what mends it. @param {Finding} finding @param {Verdict} verdict @param {Told["jump"]} jump */
function item(finding, verdict, jump) {
  const { time } = finding;
  const slot = make("div", { class: "remedies" });
  const see = textButton(_("show the moment"), () => jump?.(time ?? 0));
  if (jump && time !== null) slot.append(see);
  if (mendable(finding))
    slot.append(make("span", { class: "told" }, _("looking for what mends it ...")));
  return { finding, slot, element: make("li", {}, make("p", {}, plainText(finding, verdict)), slot) };
}

/** What the plan after a change would be said to be. @param {Verdict} found */
function afterText(found) {
  const said = [`${STATE_SIGNS[stateOf(found)]} ${wordOf(found)}`, markText(found)];
  return _("then: {word}", { word: said.filter(Boolean).join(", ") });
}

/**
 * Look for what mends each finding, and offer it.
 * @param {Ask} ask @param {Told & { found: Verdict }} told @param {Answer | null} smallest
 * @param {ReturnType<typeof item>[]} items @param {(plan: Plan) => void} take
 */
async function offer(ask, { plan, found: before }, smallest, items, take) {
  for (const { finding, slot } of items.filter((one) => mendable(one.finding))) {
    const looking = /** @type {HTMLElement} */ (slot.lastElementChild);
    const wrong = { ask, plan, before, finding, smallest };
    let count = 0;
    for await (const { plan: mended, found, text } of remedies(wrong)) {
      count++;
      const remedy = textButton(text, () => take(mended), { class: "remedy" });
      remedy.append(make("small", {}, afterText(found)));
      looking.before(remedy);
    }
    looking.textContent = count ? "" : _("no single change was found that mends it");
  }
}

/** The smallest pitch says something: the spiral ends at a disc. @param {Plan} plan */
function hasPitch({ route, disc }) {
  if (route.street || route.rounds > 1) return false; // it is sought for one coil alone
  return route.kind === "turn" || (route.kind === "spiral-in" && disc?.radius != null);
}

/** What is known of the smallest pitch, for people. @param {Plan} plan @param {Answer} found */
function pitchText({ route }, { upper }) {
  return _("smallest pitch with which benches keep apart: {least} m; this plan has {own} m", {
    least: few(upper, true),
    own: few(route.pitch),
  });
}

/** What is told where there is a verdict. @param {Told & { found: Verdict }} told @param {(do_: () => void) => void} leave @param {Ask} ask */
function explained(told, leave, ask) {
  const { found, plan, jump, take } = told;
  const go = jump && ((/** @type {number} */ time) => leave(() => jump(time)));
  const items = distinct(found.findings).map((one) => item(one, found, go));
  const pitch = make("li", { hidden: true });
  const numbers = evidence(found, plan.limits ?? {}, go);
  const open = notChecked(found).map((text) => make("li", {}, text));
  const nearest = nearestText(found);
  const body = [
    make("ul", { class: "findings" }, ...items.map(({ element }) => element)),
    make("ul", {}, ...(nearest ? [make("li", {}, nearest)] : []), pitch),
    ...(open.length ? [make("p", {}, _("not checked:")), make("ul", {}, ...open)] : []),
    numbers,
  ];
  const look = async () => {
    const smallest = hasPitch(plan) ? await ask("limit/pitch", plan) : null;
    if (smallest) {
      numbers.querySelector("tbody")?.append(limitRow(_("smallest pitch"), smallest));
      pitch.textContent = smallest.upper === null ? "" : pitchText(plan, smallest);
      pitch.hidden = !pitch.textContent;
    }
    await offer(ask, told, smallest, items, (mended) => leave(() => take(mended)));
  };
  return { head: `${STATE_SIGNS[stateOf(found)]} ${wordOf(found)}`, body, look };
}

/**
 * Open the details of a verdict over the page.
 * @param {HTMLElement} root @param {Answers} answers @param {Told} told
 */
export function showDetails(root, answers, told) {
  const aside = answers.aside();
  const leave = (/** @type {() => void} */ go) => {
    dialog.close();
    go();
  };
  const ask = orNothing(async (question, plan) =>
    answers.has(question) ? aside.ask({ question, plan }) : null,
  );
  const { found } = told;
  const { head, body, look } = found
    ? explained({ ...told, found }, leave, ask)
    : { head: _("no verdict"), body: [make("p", {}, told.sentence)], look: async () => {} };
  const dialog = make(
    "dialog",
    { class: "details", "aria-label": _("details"), onclose: () => (aside.close(), dialog.remove()) },
    make("form", { method: "dialog" }, make("button", {}, _("close"))), // where nothing moves it
    make("h2", { class: found ? stateOf(found) : "none" }, head),
    ...body,
  );
  root.append(dialog);
  dialog.showModal();
  look().catch((error) => {
    if (error instanceof Refusal) dialog.append(make("p", {}, error.message));
    else if (error.name !== "AbortError") throw error;
  });
  return dialog;
}
