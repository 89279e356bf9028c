// Ways past the first screen, for those who have a plan already, or come to look.

import { choice, make, signButton } from "./elements.js";
import { PAPER_QUESTIONS } from "./question_tales.js";
import { _, language } from "./words.js";

/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./planner.js").Planner} Planner */

/** The dance that each of the contest's questions begins with. */
const CONTEST = ["spiral-in", "spiral-in", "question-3", "turn", "turn"];

/** Those ways, in the language in use. @param {Planner} planner */
export function openings(planner) {
  const { presets } = planner;
  const look = (/** @type {string} */ name) => {
    const found = presets.find((preset) => preset.name === name);
    if (found) planner.change(structuredClone(/** @type {Plan} */ (found.plan)), true);
  };
  /** @type {[string, string][]} */
  const names = presets.map(({ name, title }) => [name, title[language()]]);
  const contest = PAPER_QUESTIONS.map((question, n) => {
    return signButton(String(n + 1), question.name(), () => {
      look(CONTEST[n]);
      planner.stories.open(question);
    });
  });
  return [
    make("details", {}, make("summary", {}, _("I have a plan already")), ...planner.files.opener()),
    make(
      "label",
      { class: "row" },
      _("Ready-made dances"),
      choice(_("Ready-made dances"), [["", _("choose one")], ...names], "", look),
    ),
    make("p", { id: "contest" }, _("The contest's questions (CUMCM 2024, problem A)")),
    make("div", { class: "row", role: "group", "aria-labelledby": "contest" }, ...contest),
  ];
}
