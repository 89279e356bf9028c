// What the command line does and the page does not: the very commands, to be copied.

import { make } from "./elements.js";
import { _ } from "./words.js";

/** The name under which plan files are saved. */
export const PLAN_FILE = "dance.dragon.toml";

/** What is asked in the page where it can be, and its command where it cannot. */
const QUESTIONS = {
  verdict: { text: () => _("whether the walk is safe"), command: `check ${PLAN_FILE}` },
  "job/prove": { text: () => _("prove the verdict"), command: `check ${PLAN_FILE} --prove` },
  "limit/pitch": { text: () => _("smallest pitch"), command: `solve pitch ${PLAN_FILE}` },
  "job/turn": { text: () => _("best turn"), command: `solve turn ${PLAN_FILE}` },
  "job/speed": { text: () => _("greatest head speed"), command: `solve speed ${PLAN_FILE}` },
  "job/pace": {
    text: () => _("slow down only where it must"),
    command: `solve speed ${PLAN_FILE} --pace slow.dragon.toml`,
  },
  "job/margins": {
    text: () => _("tolerance for people who are not exact"),
    command: `margins ${PLAN_FILE}`,
  },
};
const FILES = [
  { text: () => _("player (a page)"), command: `view ${PLAN_FILE} -o dance.html` },
  {
    text: () => _("positions, as tables and pictures"),
    command: `motion ${PLAN_FILE} -o motion --format xlsx,csv,png`,
  },
  {
    text: () => _("moment of contact, as a table and a picture"),
    command: `check ${PLAN_FILE} -o check`,
  },
  { text: () => _("film"), command: `animate ${PLAN_FILE} -o dance.mp4` },
];

/** Put text where it can be pasted from. @param {string} text @param {HTMLElement} shown where it stands on the page */
async function copy(text, shown) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Browsers give pages from disk no clipboard: select it, and let the old way copy.
    getSelection()?.selectAllChildren(shown);
    document.execCommand("copy");
  }
}

/** @param {string} text @param {string} command */
function row(text, command) {
  const shown = make("code", { tabindex: "0" }, `benchdragon ${command}`);
  const told = make("output", { class: "told" });
  const button = make("button", { type: "button", "aria-label": _("copy: {text}", { text }) });
  button.append(_("copy"));
  button.addEventListener("click", async () => {
    await copy(`benchdragon ${command}`, shown);
    told.textContent = _("copied");
  });
  return make("li", {}, make("span", { class: "name" }, text), shown, button, told);
}

/** The commands for all that a page cannot answer. @param {(question: string) => boolean} has what it can */
export function commandList(has) {
  const questions = Object.entries(QUESTIONS).filter(([name]) => !has(name));
  const wanted = [...questions.map(([, one]) => one), ...FILES];
  return make(
    "details",
    { class: "commands" },
    make("summary", {}, _("On the command line")),
    make("p", { class: "source" }, _("Save the plan file, and beside it run:")),
    make("ul", {}, ...wanted.map(({ text, command }) => row(text(), command))),
  );
}
