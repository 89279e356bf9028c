// The paper's questions, to be opened as stories in the planner: what they tell is computed first.

import { make, textButton } from "./elements.js";
import { PAPER_QUESTIONS } from "./question_tales.js";
import { Refusal } from "./standing.js";
import { _ } from "./words.js";

/** @typedef {import("./planner.js").Planner} Planner */
/** @typedef {import("./plan_form.js").Plan} Plan */
/** @typedef {import("./question_tales.js").Chapter} Chapter */
/** @typedef {import("./question_tales.js").PaperQuestion} PaperQuestion */
/** @typedef {import("./standing.js").Aside} Aside */

export class Stories {
  /** @param {Planner} planner */
  constructor(planner) {
    this.planner = planner;
    /** Who computes what a story tells. @type {Aside | null} */
    this.aside = null;
    /** The plan of the chapter that is told, or soon will be. @type {Plan | null} */
    this.plan = null;
    this.told = make("output", { class: "told" });
    this.cancel = textButton("", () => this.stop(), { hidden: true });
  }

  /** Their buttons, in the language in use. */
  controls() {
    this.cancel.textContent = _("cancel");
    if (this.aside) this.#tell(_("computing ..."));
    return make(
      "fieldset",
      { class: "stories" },
      make("legend", {}, _("The paper's five questions")),
      ...PAPER_QUESTIONS.map((question) => textButton(question.name(), () => this.open(question))),
      make("div", { class: "row" }, this.told, this.cancel),
    );
  }

  /** @param {string} text */
  #tell(text) {
    this.told.textContent = text;
    this.cancel.hidden = !this.aside;
  }

  /** Give up what is being computed, and tell no further chapter. */
  stop() {
    this.aside?.close();
    this.aside = null;
    this.plan = null;
    this.#tell("");
  }

  /** Another plan is on the page: a story of the one before is over. @param {Plan} plan */
  show(plan) {
    if ((this.plan || this.aside) && plan !== this.plan) this.stop();
  }

  /** Compute what a story tells, then tell it. @param {PaperQuestion} question */
  async open(question) {
    this.stop();
    const { answers, presets } = this.planner;
    const aside = answers.aside();
    this.aside = aside;
    this.#tell(_("computing ..."));
    const preset = (/** @type {string} */ name) =>
      structuredClone(/** @type {Plan} */ (presets.find((one) => one.name === name)?.plan));
    try {
      const ask = (/** @type {string} */ asked, /** @type {Plan} */ plan) =>
        aside.ask({ question: asked, plan });
      const chapters = await question.chapters(ask, preset);
      if (this.aside === aside) await this.#play(chapters);
    } catch (error) {
      if (error instanceof Refusal) this.#tell(error.message);
      else if (!(error instanceof DOMException && error.name === "AbortError")) throw error;
    } finally {
      aside.close();
    }
  }

  /** Show the plan of the first chapter, tell it, and go on to the next. @param {Chapter[]} chapters */
  async #play([{ plan, tale }, ...rest]) {
    this.aside = null;
    this.plan = plan;
    this.#tell(_("computing ..."));
    this.planner.change(plan, true);
    const shown = await this.planner.whenDanced(plan);
    const { player } = this.planner;
    if (!shown || !player || this.plan !== plan) return;
    this.#tell("");
    const told = tale(player.scene);
    if (!told) return;
    player.face.tell(told);
    const { story } = player.face;
    story.next = !rest.length
      ? null
      : () => {
          story.pause(true);
          if (this.plan === plan) this.#play(rest);
        };
  }
}
