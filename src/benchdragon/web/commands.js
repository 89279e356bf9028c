// What the command line does and the page does not: the very commands, to be copied.

import { make } from "./elements.js";
import { planName } from "./names.js";
import { _ } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */

/** What stands for the name of the plan's files in a command; and its own file. */
const NAME = "{name}";
const PLAN_FILE = `${NAME}.dragon.toml`;

/** What is asked in the page where it can be, and its command where it cannot. */
const QUESTIONS = {
  verdict: { text: () => _("whether the walk is safe"), command: `check ${PLAN_FILE}` },
  "job/prove": { text: () => _("prove the verdict"), command: `check ${PLAN_FILE} --prove` },
  "limit/pitch": { text: () => _("smallest pitch"), command: `solve pitch ${PLAN_FILE}` },
  "job/turn": { text: () => _("best turn"), command: `solve turn ${PLAN_FILE}` },
  "job/speed": { text: () => _("greatest head speed"), command: `solve speed ${PLAN_FILE}` },
  "job/pace": {
    text: () => _("slow down only where it must"),
    command: `solve speed ${PLAN_FILE} --pace -o ${NAME}-slow.dragon.toml`,
  },
  "job/margins": {
    text: () => _("tolerance for people who are not exact"),
    command: `margins ${PLAN_FILE}`,
  },
};
const FILES = [
  { text: () => _("player (a page)"), command: `view ${PLAN_FILE} -o ${NAME}.html` },
  {
    text: () => _("positions, as tables and pictures"),
    command: `motion ${PLAN_FILE} -o ${NAME}-motion --format xlsx,csv,png`,
  },
  {
    text: () => _("moment of contact, as a table and a picture"),
    command: `check ${PLAN_FILE} -o ${NAME}-check`,
  },
  {
    text: () => _("all papers as PDF: sheets, overview, timetable, chalk plan, permit annex"),
    command: `sheets ${PLAN_FILE} -o ${NAME}-papers.html --pdf ${NAME}-papers`,
  },
  { text: () => _("film"), command: `view ${PLAN_FILE} -o ${NAME}.mp4` },
];

/** Put text where it can be pasted from. @param {string} text @param {HTMLElement} shown where it stands on the page */
export async function copy(text, shown) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Browsers give pages from disk no clipboard: select it, and let the old way copy.
    getSelection()?.selectAllChildren(shown);
    document.execCommand("copy");
  }
}

/** @param {string} text @param {string} command @param {() => Plan} plan */
function row(text, command, plan) {
  const shown = make("code", { tabindex: "0" });
  const tell = () => {
    shown.textContent = `benchdragon ${command.replaceAll(NAME, planName(plan()))}`;
  };
  const told = make("output", { class: "told" });
  const button = make("button", { type: "button", "aria-label": _("copy: {text}", { text }) });
  button.append(_("copy"));
  button.addEventListener("click", async () => {
    tell();
    await copy(shown.textContent ?? "", shown);
    told.textContent = _("copied");
  });
  const item = make("li", {}, make("span", { class: "name" }, text), shown, button, told);
  tell();
  return { item, tell };
}

/**
 * The commands for all that a page cannot answer, and how they are told anew of another plan.
 * @param {(question: string) => boolean} has what it can
 * @param {() => Plan} plan that on the page
 */
export function commandList(has, plan) {
  const questions = Object.entries(QUESTIONS).filter(([name]) => !has(name));
  const wanted = [...questions.map(([, one]) => one), ...FILES];
  const rows = wanted.map(({ text, command }) => row(text(), command, plan));
  const element = make(
    "details",
    { class: "commands" },
    make("summary", {}, _("On the command line")),
    make("p", { class: "source" }, _("Save the plan file, and beside it run:")),
    make("ul", {}, ...rows.map(({ item }) => item)),
  );
  return { element, tell: () => rows.forEach(({ tell }) => tell()) };
}
